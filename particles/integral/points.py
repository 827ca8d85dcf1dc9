"""Point sets in a box: lattice, jittered, random, relaxed; pairs of near points."""
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from particles.fields import check_plain
from particles.integral.interpolants import W, check, reach


@dataclass(frozen=True, kw_only=True)
class Points:
    """Points x (n, d) in a periodic box (d,) centred on the origin, with volumes V (n,) that fill it."""
    x: np.ndarray
    box: np.ndarray
    V: np.ndarray

    def __post_init__(self):
        check_plain("points", self.x, self.box, self.V)
        n, d = self.x.shape if self.x.ndim == 2 else (0, 0)
        if n < 2 or d not in (1, 2, 3) or self.box.shape != (d,) or self.V.shape != (n,):
            raise ValueError(f"need points (n >= 2, d = 1, 2, 3), box (d,) and V (n,); got {self.x.shape}, "
                             f"{self.box.shape}, {self.V.shape}")
        inside = (np.abs(self.x) <= self.box/2*(1 + 1e-12)).all(axis=1)
        bad = np.flatnonzero(~(inside & (self.V > 0)))
        if len(bad):
            i = bad[0]
            raise ValueError(f"point {i} at {self.x[i]}, of volume {self.V[i]}, is outside of the box "
                             f"{self.box}, centred on the origin, or has no volume: wrap it or widen the box")

    @property
    def n(self) -> int:
        return self.x.shape[0]

    @property
    def d(self) -> int:
        return self.x.shape[1]

    @property
    def a(self) -> float:
        """Mean spacing, (box volume/n)^(1/d)."""
        return float((np.prod(self.box)/self.n)**(1/self.d))


def of_positions(x: np.ndarray, box: Any) -> Points:
    """Points of equal volume."""
    check_plain("sides of a box", box)
    box = np.asarray(box, float)
    if not np.isfinite(box).all():
        raise ValueError(f"the box of points must be finite, got {box}")
    return Points(x=x, box=box, V=np.full(len(x), np.prod(box)/len(x)))


def lattice(counts: tuple[int, ...], a: float = 1.0) -> Points:
    """Square lattice of spacing a, with `counts` points along the axes."""
    if not all(count == int(count) for count in counts):
        raise ValueError(f"a lattice has whole numbers of points along its axes, got {counts}")
    axes = [(np.arange(c) + 0.5 - c/2)*a for c in counts]
    x = np.stack([q.ravel() for q in np.meshgrid(*axes, indexing="ij")], axis=1)
    return of_positions(x, np.array(counts)*a)


def jittered(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """Unit lattice with every coordinate shifted by up to `size`."""
    at = lattice(counts)
    x = at.x + np.random.default_rng(seed).uniform(-size, size, at.x.shape)
    return of_positions(wrapped(x, at.box), at.box)


def random(counts: tuple[int, ...], apart: float, seed: int) -> Points:
    """Random points, one per unit volume, none nearer than `apart`. ValueError: some find no place."""
    at = lattice(counts)
    rng, x = np.random.default_rng(seed), np.empty((0, at.d))
    for _ in range(400):
        new = rng.uniform(-at.box/2, at.box/2, (at.n - len(x), at.d))
        x = _thinned(np.concatenate([x, new]), at.box, apart)
        if len(x) == at.n:
            return of_positions(x, at.box)
    raise ValueError(f"{at.n - len(x)} of {at.n} points found no place {apart} spacings from all others: "
                     "take a smaller distance, up to 0.75 in a plane")


def _thinned(x: np.ndarray, box: np.ndarray, apart: float) -> np.ndarray:
    """Points without those nearer than `apart` to an earlier one that stays."""
    stays = np.ones(len(x), bool)
    tree = cKDTree(x + box/2, boxsize=box)
    for i, j in sorted(map(sorted, tree.query_pairs(apart))):
        if stays[i]:
            stays[j] = False
    return x[stays]


def wrapped(x: np.ndarray, box: np.ndarray) -> np.ndarray:
    """Positions wrapped into the box; separations, to the nearest image."""
    return x - box*np.round(x/box)


def pairs(points: Points, distance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """(i, j, x_j - x_i, r) of pairs i < j nearer than `distance`. ValueError: half the box or more; r = 0."""
    if 2*distance >= points.box.min():
        raise ValueError(f"the reach {distance:g} is wider than half of the box {points.box}: take more "
                         "points or a narrower weight")
    tree = cKDTree(points.x + points.box/2, boxsize=points.box*(1 + 1e-15))
    i, j = tree.query_pairs(distance, output_type="ndarray").T
    order = np.lexsort((j, i))
    i, j = i[order], j[order]
    apart = wrapped(points.x[j] - points.x[i], points.box)
    r = np.sqrt((apart**2).sum(axis=1))
    if len(r) and r.min() < 1e-9*points.a:
        k = int(np.argmin(r))
        raise ValueError(f"points {i[k]} and {j[k]} overlap at {points.x[i[k]]}: move one of them")
    return i, j, apart, r


def relaxed(points: Points, weight: Any, until: float = 2e-3, sweeps: int = 2000) -> Points:
    """Points moved by 0.12 a^2 c per sweep until a |c| < `until` everywhere; c_i = sum_j W(r_ij) dV e_ij is
    zero on a lattice. Raises ArithmeticError: a |c| is still larger after so many sweeps."""
    check(weight, points.d)
    for _ in range(sweeps):
        i, j, apart, r = pairs(points, reach(weight))
        pull, c = (W(weight, r)/r)[:, None]*apart, np.zeros_like(points.x)
        np.add.at(c, i, -pull*points.V[j, None])
        np.add.at(c, j, pull*points.V[i, None])
        worst = points.a*np.sqrt((c**2).sum(axis=1).max())
        if worst < until:
            return points
        points = of_positions(wrapped(points.x + 0.12*points.a**2*c, points.box), points.box)
    raise ArithmeticError(f"a |c| is still {worst:.3g} after {sweeps} sweeps, not below {until:g}: take "
                          "more, a wider weight, or less disorder")
