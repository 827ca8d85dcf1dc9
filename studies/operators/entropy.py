"""Entropy that stress and heat current produce    [RR98 Eqs 37, 38, 51]

What leaves i over an edge for j, momentum f and energy e, heats i by -(e - v_i.f) and j by e - v_j.f, so

    dS/dt = sum over edges [(e - v_j.f)/T_j - (e - v_i.f)/T_i]

Of forces F along edges that heat as they work it is F.(v_j - v_i)(1/T_i + 1/T_j)/2 + kappa k (T_j - T_i)^2
/T_i T_j, never negative. The continuum has sigma : grad v/T + kappa (grad T)^2/T^2 in each place.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from continuum.fluid import ConstEta, IdealGas, stress_tensor
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.weights import WendlandC2
from studies.build.setting import DISORDERS
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import ALONG, ETA, KAPPA, Spectral, smooth_flow

#: rho (n,), v (n, 2), T (n,)
State = tuple[np.ndarray, np.ndarray, np.ndarray]
#: by name: as printed, and mended
WAYS = {"along edges": ALONG, "along edges, mended": Pairwise(), "nested": NestedFluxes()}
HOTTER = 8.0            # than in `smooth_flow` is the wave of T: 0.2 to 1.8
FINE = (64, 64)         # cells of exact derivatives
DRAWS = 200             # random states
SPREAD, WIDEST = 0.5, np.log(3)     # of ln T: standard deviation of random states, bound of sought ones
FAST, STEPS = 1.0, 60   # bound of velocities of sought states, of the steps of a search


def produced(dih: Dih, state: State) -> np.ndarray:
    """dS/dt by each edge, (E,)."""
    edges, flow = dih.edges, dih.flow(dih.state(*state))
    (_, f, e), (v, T), i, j = dih.transport.fluxes(dih, flow), flow[1:3], edges.i, edges.j
    return ((v[i]*f).sum(axis=1) - e)/T[i] + (e - (v[j]*f).sum(axis=1))/T[j]


def summed(q: np.ndarray) -> float:
    """Sum over the sum of sizes."""
    return float(q.sum()/np.abs(q).sum())


def smooth(x: np.ndarray) -> State:
    """One wave along each axis of the unit box."""
    rho, v, T = smooth_flow(x)
    return rho, v, 1 + HOTTER*(T - 1)


def continuum() -> float:
    """Of that flow in two dimensions, where it does not depend on the size of the box; zeta = 0."""
    exact, (one, v, T) = Spectral(FINE), smooth(lattice(FINE, 1/FINE[0]).x)
    slope, one = exact.grad(v), np.ones_like(one)
    friction = (stress_tensor(ETA*one, 0*one, slope)*slope).sum(axis=(1, 2))
    return float(np.mean(friction/T + KAPPA*(exact.grad(T)**2).sum(axis=1)/T**2))


@dataclass(frozen=True, kw_only=True)
class Entropy(Case):
    """Of a smooth state, of random ones, or of the worst one that a descent from a random one finds."""
    way: str
    make: Callable[[Points, Any], Edges]
    points: str
    cells: int
    state: str
    seed: int = 1
    cost = 3.0

    def run(self, report: Report, folder: Path) -> Outcome:
        kind = DISORDERS[self.points]
        points = kind.make((self.cells, self.cells), kind.size, self.seed)
        dih = Dih(edges=self.make(points, WendlandC2.of(h=2.5)), eos=IdealGas(), law=ConstEta(ETA, KAPPA),
                  transport=WAYS[self.way])
        all_q = [produced(dih, state) for state in self.states(dih, points)]
        total = all_q[0].sum()/continuum() if self.state == "smooth" else np.nan
        return Outcome({"entropy": [{
            "transport": self.way, "maker": self.make.__name__, "points": self.points, "state": self.state,
            "cells": self.cells, "seed": self.seed, "total": total, "least": min(map(summed, all_q)),
            "negative": np.mean([q < 0 for q in all_q])}]})

    def states(self, dih: Dih, points: Points) -> Iterator[State]:
        n, rng = points.n, np.random.default_rng(self.seed)
        if self.state == "smooth":
            yield smooth(points.x/self.cells)
        elif self.state == "sought":
            bounds = np.repeat([WIDEST, FAST, FAST], n)
            found = minimize(lambda q: summed(produced(dih, unpacked(q))), rng.uniform(-bounds, bounds),
                             bounds=np.stack([-bounds, bounds], axis=1), options={"maxiter": STEPS})
            yield unpacked(found.x)
        else:
            for _ in range(DRAWS):
                yield rng.uniform(0.5, 1.5, n), rng.normal(0, 0.3, (n, 2)), np.exp(rng.normal(0, SPREAD, n))


def unpacked(fields: np.ndarray) -> State:
    """Density 1, from ln T and velocities in one row."""
    log_T, *v = fields.reshape(3, -1)
    return np.ones_like(log_T), np.stack(v, axis=1), np.exp(log_T)
