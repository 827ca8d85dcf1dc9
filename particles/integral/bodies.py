"""Held points: frozen ones form a rigid body, rows of fixed ones a wall    [RR98, Sec. IV]

A held point exchanges over its edges as all points do; its velocity and temperature are given, its density
evolves. What the edges carry to it is the force on the body and its heat. A body of lattice points has a
staircase for a surface; points placed on the surface give the true one.

The flux of eta lap v through a surface is the traction on a body that does not turn. One that turns with
Omega feels a torque -2 eta Omega area besides, from edges inside: take the torque on all of its points.
"""
from typing import NamedTuple

import numpy as np

#: spacings between a surface and points off it: nearer ones would cut its edges or take short steps
CLEAR = 0.6


class Held(NamedTuple):
    """Points `which` (m,) held at v (m, 2) and T (m,); T nan: they get `heat` (m,), per time, and no other.

    body: its number.
    """
    which: np.ndarray
    v: np.ndarray
    T: np.ndarray
    body: np.ndarray
    heat: np.ndarray


def held(which: np.ndarray, v: tuple[float, float] = (0.0, 0.0), T: float = np.nan,
         heat: float = 0.0) -> Held:
    """Points of one velocity and temperature. ValueError: there are none, or one twice, or T <= 0."""
    which, velocity = np.asarray(which), np.asarray(v, float)
    if which.ndim != 1 or (len(which) and which.dtype.kind not in "iu") or (which < 0).any():
        raise ValueError(f"held points are named by whole numbers from 0 on, got {which}")
    if len(which) < 1 or len(np.unique(which)) < len(which):
        raise ValueError(f"{len(which)} points are to be held, {len(np.unique(which))} of them different: "
                         "name at least one, and each once")
    if T <= 0:
        raise ValueError(f"held points have T = {T:g}, which must be positive; leave it out: no heat passes")
    if velocity.shape != (2,) or not np.isfinite([*velocity, heat]).all() or np.isinf(T):
        raise ValueError(f"held points have v = {v}, heat = {heat}, T = {T}: give two components, and finite "
                         "numbers")
    return Held(which, np.tile(velocity, (len(which), 1)), np.full(len(which), float(T)),
                np.zeros(len(which), int), np.full(len(which), float(heat)))


def together(*bodies: Held) -> Held:
    """Several bodies, such as two plates of a channel; they do not rub against each other."""
    which, v, T, _, heat = (np.concatenate(column) for column in zip(*bodies, strict=True))
    return Held(which, v, T, np.repeat(np.arange(len(bodies)), [len(body.which) for body in bodies]), heat)


class Rows(NamedTuple):
    """Numbers of the points on each side, but for those in corners; empty where there is no side."""
    left: np.ndarray
    right: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    corners: np.ndarray


def with_sides(inner: np.ndarray, size: tuple[float, float],
               closed: tuple[bool, bool] = (False, True)) -> tuple[np.ndarray, Rows]:
    """Points (n, 2) with rows a spacing apart on the sides of a box, and which these are.

    closed : is there a side across x, across y? For triangles that end there, `triangulation.between`.
    Corners are numbered lower left, lower right, upper left, upper right.
    """
    along = [np.arange(1.0, n) - n/2 if shut else np.arange(n) + 0.5 - n/2
             for n, shut in zip(map(round, size), closed)]
    half, (across, up) = np.array(size)/2, closed
    left = np.stack([np.full(len(along[1]), -half[0]), along[1]], axis=1)[:across*len(along[1])]
    bottom = np.stack([along[0], np.full(len(along[0]), -half[1])], axis=1)[:up*len(along[0])]
    corners = half*np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])[:4*(across and up)]
    rows = [left, left*[-1, 1], bottom, bottom*[1, -1], corners]
    ends = np.cumsum([0, *map(len, rows)])
    return np.concatenate([*rows, inner]), Rows(*map(np.arange, ends[:-1], ends[1:]))


def on_circle(radius: float) -> np.ndarray:
    """Points (n, 2) about one apart on a circle."""
    n = round(2*np.pi*radius)
    angle = 2*np.pi*(np.arange(n) + 0.5)/n
    return radius*np.stack([np.cos(angle), np.sin(angle)], axis=1)


def with_disc(x: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) with a circle about the middle in place of those in it or near it, and which it has."""
    circle, r = on_circle(radius), np.hypot(*x.T)
    return np.concatenate([circle, x[r > radius + CLEAR]]), np.arange(len(circle))
