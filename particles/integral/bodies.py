"""Held points, of prescribed velocity and temperature: they form rigid bodies and walls    [RR98, Sec. IV]

A held point exchanges over its edges as all points do; its density evolves. The momentum and heat that edges
bring to it are the force on the body and its heat. The surface of a body of lattice points is a staircase;
points placed on the true surface avoid that.

The flux of eta lap v through a surface is the traction on a body that does not rotate. A body that rotates
at Omega feels an additional torque -2 eta Omega area, from edges inside: sum the torque over all its points.
"""
from typing import NamedTuple

import numpy as np

#: least distance of points from a surface, in spacings: nearer ones cut its edges or need short steps
CLEAR = 0.6


class Held(NamedTuple):
    """Points of indices `which` (m,), held at velocity v (m, 2) and temperature T (m,).

    T nan : the energy evolves, and only `heat` (m,) per time comes from outside. body (m,) : its number.
    """
    which: np.ndarray
    v: np.ndarray
    T: np.ndarray
    body: np.ndarray
    heat: np.ndarray


def held(which: np.ndarray, v: tuple[float, float] = (0.0, 0.0), T: float = np.nan,
         heat: float = 0.0) -> Held:
    """Hold points at one velocity and temperature. Raises ValueError: no points, a point twice, T <= 0."""
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
    """Several bodies, such as the two plates of a channel, without friction between them."""
    which, v, T, _, heat = (np.concatenate(column) for column in zip(*bodies, strict=True))
    return Held(which, v, T, np.repeat(np.arange(len(bodies)), [len(body.which) for body in bodies]), heat)


class Rows(NamedTuple):
    """Indices of the points on each side, without those in corners; empty where there is no side."""
    left: np.ndarray
    right: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    corners: np.ndarray


def with_sides(inner: np.ndarray, size: tuple[float, float],
               closed: tuple[bool, bool] = (False, True)) -> tuple[np.ndarray, Rows]:
    """Points (n, 2): rows of unit spacing on the sides of a box, then `inner`; and the indices of the rows.

    closed : whether x, y end at sides, not periodically. Triangulate with `triangulation.between`.
    The order of corners is lower left, lower right, upper left, upper right.
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
    """Points (n, 2) at about unit spacing on a circle around the origin."""
    n = round(2*np.pi*radius)
    angle = 2*np.pi*(np.arange(n) + 0.5)/n
    return radius*np.stack([np.cos(angle), np.sin(angle)], axis=1)


def with_disc(x: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Points on a circle around the origin, then those of x well outside; and the indices of the circle's."""
    circle, r = on_circle(radius), np.hypot(*x.T)
    return np.concatenate([circle, x[r > radius + CLEAR]]), np.arange(len(circle))
