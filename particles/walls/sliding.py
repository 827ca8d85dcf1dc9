"""Lees-Edwards sides for fixed points: images slide past, faster by rate times height    [RR98, Sec. IV]

Images above have slid by s = rate height t = (m + theta) a along x. A point sees, at each place of the
lattice beyond the side, the two images next to it: one edge with the share 1 - theta of S and k, one with
theta. So nothing is lost, edges close at every s and volumes stay; no share is negative; what is exchanged is
continuous, and second order in the spacing. Each point exchanges in its own frame with images of velocity v +
rate height: which of two boxes is at rest does not matter.
"""
from typing import NamedTuple

import numpy as np

from continuum.jit import jit
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.neighbours import u32, u64
from particles.pairs import Stored

SYMMETRIC = 1e-12       # of S through the side: round-off of some ten edges


class Through(NamedTuple):
    """Entries of the stored edges through a side: which, up (1) or down (-1), share 1 - theta (0) or theta
    (1); S/2 and k of the whole edge; column and row of the place of the lattice to which it leads."""
    entry: np.ndarray
    up: np.ndarray
    second: np.ndarray
    sx: np.ndarray
    sy: np.ndarray
    k: np.ndarray
    column: np.ndarray
    row: np.ndarray


class SlidSides(NamedTuple):
    """Stored edges among the points and to images n.. of points `parent`, which are `up` (1) or down (-1).

    number[0] and number[1]: which image below and above a point has. through: what has to follow the sliding.
    """
    edges: Stored
    through: Through
    parent: np.ndarray
    up: np.ndarray
    number: np.ndarray
    counts: tuple[int, int]


def sides(points: Points, edges: Edges) -> SlidSides:
    """Edges of a periodic lattice with sliding images in place of the periodic ones above and below. Raises
    ValueError: no lattice, or edges that are not alike in all columns, or no mirror images in x."""
    counts = check_lattice(points)
    check_alike(points, edges, counts)
    i, j = np.concatenate([edges.i, edges.j]), np.concatenate([edges.j, edges.i])
    S, k = np.concatenate([edges.S, -edges.S])/2, np.concatenate([edges.k, edges.k])
    up = crossing(points, edges)
    up = np.concatenate([up, -up])
    # edges through a side stand there twice
    split = np.concatenate([np.arange(len(i)), np.flatnonzero(up)])
    second = np.arange(len(split)) >= len(i)
    order = np.lexsort((j[split], i[split]))
    split, second = split[order], second[order]
    i, j, S, k, up = (q[split] for q in (i, j, S, k, up))
    taken = np.bincount(i, minlength=points.n)
    stored = Stored((np.cumsum(taken) - taken).astype(u64), taken.astype(u32), j.astype(u32), S[:, 0].copy(),
                    S[:, 1].copy(), k)
    entry = np.flatnonzero(up)
    through = Through(entry, up[entry], second[entry].astype(int), S[entry, 0], S[entry, 1], k[entry],
                      j[entry]//counts[1], j[entry] % counts[1])
    return SlidSides(stored, through, *images(through, counts), counts)


def images(through: Through, counts: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Parents of the images, which way they lie, their numbers (2, n): all points of rows with edges."""
    n = counts[0]*counts[1]
    column, sides = np.arange(counts[0])[:, None]*counts[1], (-1, 1)
    found = [(column + np.unique(through.row[through.up == side])).ravel() for side in sides]
    parent, up = np.concatenate(found), np.repeat(sides, [len(points) for points in found])
    number = np.zeros((2, n), int)
    number[(up + 1)//2, parent] = n + np.arange(len(parent))
    return parent, up, number


def check_lattice(points: Points) -> tuple[int, int]:
    """Columns and rows of a lattice whose points are numbered column by column."""
    columns, rows = (len(np.unique(np.round(q/points.a, 6))) for q in points.x.T)
    place = np.stack([np.repeat(np.arange(columns), rows), np.tile(np.arange(rows), columns)], axis=1)
    if columns*rows != points.n or np.abs(points.x - points.x[0] - place*points.a).max() > 1e-9*points.a:
        raise ValueError(f"{points.n} points in {columns} columns and {rows} rows are no square lattice: "
                         "take one of `points.lattice`")
    return columns, rows


def crossing(points: Points, edges: Edges) -> np.ndarray:
    """1 for edges i -> j through the upper side, -1 through the lower, 0 for others."""
    beyond = (points.x[edges.i] + edges.apart - points.x[edges.j])[:, 1]
    return np.round(beyond/points.box[1]).astype(int)


def check_alike(points: Points, edges: Edges, counts: tuple[int, int]) -> None:
    """Refuse edges through the side that differ between columns, or whose S_x do not add up to zero."""
    up = crossing(points, edges)
    turn, through = np.where(up < 0, -1.0, 1.0)[up != 0, None], up != 0
    S, apart = turn*edges.S[through], turn*edges.apart[through]
    below = np.where(turn[:, 0] > 0, edges.i[through], edges.j[through])
    kinds = np.column_stack([below % counts[1], np.round(apart/points.a).astype(int)])
    _, kind, number = np.unique(kinds, axis=0, return_inverse=True, return_counts=True)
    mean = np.stack([np.bincount(kind.ravel(), s)/number for s in S.T], axis=1)
    size = np.abs(edges.S).sum(axis=1).max()
    if (number != counts[0]).any() or np.abs(S - mean[kind.ravel()]).max() > SYMMETRIC*size:
        raise ValueError("edges through the side differ from column to column: take edges of a weight, not "
                         "of a triangulation, which chooses diagonals")
    worst = np.abs(np.bincount(below, S[:, 0], points.n)).max()
    if worst > SYMMETRIC*size:
        raise ValueError(f"edges through the side have a sum of S_x of {worst:.3g} at a point, which must be "
                         "zero: take edges that are their own mirror images in x, as those of a weight")


@jit
def slide(offset, through, number, columns, rows, edges):
    """Let the images above have slid by `offset` spacings."""
    m = int(np.floor(offset))
    theta = offset - m
    for e in range(len(through.entry)):
        entry, up, second = through.entry[e], through.up[e], through.second[e]
        share = theta if second else 1 - theta
        edges.sx[entry], edges.sy[entry] = share*through.sx[e], share*through.sy[e]
        edges.k[entry] = share*through.k[e]
        parent = ((through.column[e] - up*(m + second)) % columns)*rows + through.row[e]
        edges.near[entry] = number[(up + 1)//2, parent]
