"""The map of makers: what pressures, velocities and heat do over the areas of today's methods on points.

Smooth particles are asked as they run: pressures P push by -momentum(P), uniform ones heat by -P gradient(v),
heat flows by laplacian(T): the areas are those of `particles.smooth` themselves. L_i is the gradient of x, 1
where linear fields are exact; its deviator is that of P M, a stress which a fluid has not.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from math import sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.edge_makers import delaunay, exact
from particles.integral.points import Points, of_positions, wrapped
from particles.pairs import sweep
from particles.run import Plan, run
from particles.weights import WendlandC2
from studies.build import spam
from studies.build.scenes import Tile
from studies.build.setting import DISORDERS, Disorder
from studies.kit.case import Case, Outcome, Report

#: vortices that carry points: their speed, turns, and viscosity over the height
SPEED, TURNS, ETA = 0.2, 0.5, 0.01
Field = Callable[[np.ndarray], np.ndarray]      # of places (2, points)


class Operators(NamedTuple):
    """At places x (2, n): slopes (2, n) as pressures and as velocities have them, Laplacian (n,); L_i."""
    x: np.ndarray
    momentum: Callable[[Field], np.ndarray]
    gradient: Callable[[Field], np.ndarray]
    laplacian: Callable[[Field], np.ndarray]
    linear: np.ndarray


def of_particles(points: Points, weight: Any, transport: type) -> Operators:
    """Of smooth particles of unit mass, kappa = 1, no viscosity."""
    method = spam.fluid(weight, tuple(points.box), law=ConstEta(0.0, 1.0), transport=transport)
    sums, *_ = method.look(spam.at_rest(points.x, 1.0))
    around, n = sums.around, sums.n
    places = np.array([around.x, around.y])

    def respond(P: Any, u: Any = 0.0, v: Any = 0.0, T: Any = 1.0) -> np.ndarray:
        around.vx[:], around.vy[:], around.T[:] = u, v, T
        sums.threads(sweep, n, *sums.exchange(P + 0*around.x), around.pairs, sums.pull)
        return around.rho[:n]*sums.pull[:n, :3].T

    def gradient(f: Field) -> np.ndarray:
        return -np.array([respond(1.0, f(places))[2], respond(1.0, 0.0, f(places))[2]])
    return Operators(places[:, :n], lambda f: -respond(f(places))[:2], gradient,
                     lambda f: 10*respond(0.0, T=1 + 0.1*f(places))[2],
                     np.array([gradient(partial(np.take, indices=a, axis=0)) for a in (0, 1)]))


def of_edges(points: Points, weight: Any, make: Callable) -> Operators:
    """Of edges."""
    edges, x = make(points, weight), points.x.T

    def slopes(matrices: list, f: Field) -> np.ndarray:
        return np.array([matrix@f(x) for matrix in matrices])/edges.V
    return Operators(x, lambda f: slopes(edges.D, f), lambda f: slopes(edges.G, f),
                     lambda f: edges.lap(f(x)), edges.linear.transpose(2, 1, 0))


NAMES = ("sph", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM")
#: how, and of what; closed faces: of those that close and are exact the nearest to those of a weight
MAKERS: dict[str, tuple[Callable, Any]] = {name: (of_particles, spam.TODAY[name].transport) for name in NAMES}
MAKERS |= {"closed faces": (of_edges, exact), "delaunay": (of_edges, delaunay)}


def hexagonal(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """A triangular lattice, so many points along x, in a box of about that height."""
    columns, rows = counts[0], 2*round(counts[1]/sqrt(3))
    i, j = (q.ravel() for q in np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij"))
    a = sqrt(2/sqrt(3))
    box, x = a*np.array([columns, rows*sqrt(3)/2]), np.array([i + 0.25 + j % 2/2, (j + 0.5)*sqrt(3)/2])
    return of_positions(wrapped(a*x.T - box/2, box), box)


@cache
def flowed(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """Where classic particles are that vortices have carried for half of a turn."""
    L = float(counts[0])
    ready = spam.TODAY["sph"].ready(Tile(width=L, L=L, law=ConstEta(ETA*L, ETA*L)), seed)
    x, y = 2*np.pi/L*ready.start[:2]
    ready.start[2:4] = SPEED*np.array([np.sin(x)*np.cos(y), -np.cos(x)*np.sin(y)])
    done = run(ready.method, ready.start, Plan(dt=ready.dt, steps=round(TURNS*L/SPEED/ready.dt)))
    return of_positions(wrapped(done.state[:2].T, np.array([L, L])), (L, L))


SETS = {**DISORDERS, "hexagonal": Disorder("hexagonal", hexagonal), "flowed": Disorder("flowed", flowed)}


def size(q: np.ndarray) -> float:
    """Root of the mean square over points of numbers (..., n)."""
    return float(np.sqrt((q.reshape(-1, q.shape[-1])**2).sum(axis=0).mean()))


@dataclass(frozen=True, kw_only=True)
class MakerErrors(Case):
    """One maker of MAKERS on points of SETS, waves as long as the box; no row where edges cannot be made."""
    maker: str
    make: Callable
    kind: Any
    disorder: Disorder
    cells: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1e-3*self.cells**2

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.cells, self.cells), self.disorder.size, self.seed)
        try:
            row = errors(points, self.make(points, WendlandC2.of(h=3.0), self.kind))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({})
        key = {"maker": self.maker, "points": self.disorder.name, "cells": self.cells, "seed": self.seed}
        return Outcome({"makers": [key | row]})


def errors(points: Points, at: Operators) -> dict[str, float]:
    """Over the size of what is exact, means of waves along x and y."""
    L, eye, waves = at.linear, np.eye(2)[:, :, None], []
    for a in (0, 1):
        k = 2*np.pi/points.box[a]

        def sine(x: np.ndarray, a: int = a, k: float = k) -> np.ndarray:
            return np.sin(k*x[a])
        right = k*np.cos(k*at.x[a])*eye[a]
        lap = size(at.laplacian(sine) + k**2*sine(at.x))/size(k**2*sine(at.x))
        waves.append([*(size(slope(sine) - right)/size(right) for slope in (at.momentum, at.gradient)), lap])
    return {"closure": points.a*size(at.momentum(lambda x: 1 + 0*x[0])), "linear": size(L - eye)/sqrt(2),
            "deviator": size(L - eye*np.trace(L)/2)/sqrt(2),
            **dict(zip(("divergence", "gradient", "laplacian"), np.mean(waves, axis=0)))}
