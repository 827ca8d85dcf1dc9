"""Entropy that stress and heat current produce    [RR98 Eqs 37, 38, 51]

What leaves i over an edge for j, momentum f and energy e, heats i by -(e - v_i.f) and j by e - v_j.f, so

    dS/dt = sum over edges [(e - v_j.f)/T_j - (e - v_i.f)/T_i]

Of forces F along edges that heat as they work it is F.(v_j - v_i)(1/T_i + 1/T_j)/2 + kappa k (T_j - T_i)^2
/T_i T_j, never negative. The continuum has sigma : grad v/T + kappa (grad T)^2/T^2 in each place.
"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from continuum.fluid import ConstEta, IdealGas, stress_tensor
from particles.integral.dih import Dih, Flow, NestedFluxes, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.weights import WendlandC2
from studies.build.setting import DISORDERS
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import ALONG, ETA, KAPPA, Spectral, smooth_flow

#: by name: as printed, and mended
WAYS = {"along edges": ALONG, "along edges, mended": Pairwise(), "nested": NestedFluxes()}
HOTTER = 8.0            # than in `smooth_flow` is the wave of T: 0.2 to 1.8
FINE = 64               # cells to the side for exact derivatives
DRAWS = 200             # random states
SPREAD, WIDEST = 0.5, np.log(3)     # of ln T: standard deviation of random states, bound of sought ones
FAST, STEPS = 1.0, 60   # bound of velocities of sought states, of the steps of a search


def produced(dih: Dih, flow: Flow) -> np.ndarray:
    """dS/dt by each edge, (E,)."""
    edges, (_, f, e) = dih.edges, dih.transport.fluxes(dih, flow)
    i, j = edges.i, edges.j
    to_i, to_j = -e + (flow.v[i]*f).sum(axis=1), e - (flow.v[j]*f).sum(axis=1)
    return to_i/flow.T[i] + to_j/flow.T[j]


def density(T: np.ndarray, grad_v: np.ndarray, grad_T: np.ndarray) -> np.ndarray:
    """sigma : grad v/T + kappa (grad T)^2/T^2, (n,), zeta = 0."""
    one = np.ones_like(T)
    friction = (stress_tensor(ETA*one, 0*one, grad_v)*grad_v).sum(axis=(1, 2))
    return friction/T + KAPPA*(grad_T**2).sum(axis=1)/T**2


def fluid(edges: Edges, transport: Any) -> Dih:
    """A gas with constant coefficients."""
    return Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), transport=transport)


def smooth(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rho, v, T = smooth_flow(x)
    return rho, v, 1 + HOTTER*(T - 1)


def exact_production() -> float:
    """Of that flow in the unit box, by derivatives that are exact."""
    exact, (_, v, T) = Spectral((FINE, FINE)), smooth(lattice((FINE, FINE), 1/FINE).x)
    return float(density(T, exact.grad(v), exact.grad(T)).mean())


State = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Entropy(Case):
    """A row for one way of transport on one set of points."""
    way: str
    make: Callable[[Points, Any], Edges]
    points: str
    cells: int
    h: float = 2.5
    seed: int = 1

    def run(self, report: Report, folder: Path) -> Outcome:
        kind = DISORDERS[self.points]
        points = kind.make((self.cells, self.cells), kind.size, self.seed)
        dih = fluid(self.make(points, WendlandC2.of(h=self.h)), WAYS[self.way])
        key = {"transport": self.way, "maker": self.make.__name__, "points": self.points,
               "state": type(self).__name__, "cells": self.cells, "seed": self.seed}
        return Outcome({"entropy": [key | self.row(dih, points)]})

    def row(self, dih: Dih, points: Points) -> dict[str, float]:
        """What is measured."""
        raise NotImplementedError


def seen(dih: Dih, state: State) -> tuple[Flow, np.ndarray]:
    """Fields, and what edges produce."""
    flow = dih.flow(dih.state(*state))
    return flow, produced(dih, flow)


def summed(q: np.ndarray) -> float:
    """Sum over the sum of sizes."""
    return float(q.sum()/np.abs(q).sum())


class Smooth(Entropy):
    """One wave along each axis; in 2D the production does not depend on the spacing."""

    def row(self, dih: Dih, points: Points) -> dict[str, float]:
        _, q = seen(dih, smooth(points.x/self.cells))
        return {"total": q.sum()/exact_production(), "least": summed(q), "negative": np.mean(q < 0)}


class Random(Entropy):
    """States without any correlation; total over what the points' own gradients produce."""

    def row(self, dih: Dih, points: Points) -> dict[str, float]:
        rng, edges, slope = np.random.default_rng(self.seed), dih.edges, NestedFluxes().gradient
        totals, sums, negative = [], [], []
        for _ in range(DRAWS):
            rho, v = rng.uniform(0.5, 1.5, points.n), rng.normal(0, 0.3, (points.n, 2))
            flow, q = seen(dih, (rho, v, np.exp(rng.normal(0, SPREAD, points.n))))
            own = density(flow.T, slope(edges, v), slope(edges, flow.T[:, None])[:, :, 0])
            totals.append(q.sum()/(edges.V@own))
            sums.append(summed(q))
            negative.append(np.mean(q < 0))
        return {"total": np.mean(totals), "least": min(sums), "negative": np.mean(negative)}


class Sought(Entropy):
    """The state of least production that a descent from a random one finds, T within a factor of 9."""
    cost = 3.0

    def row(self, dih: Dih, points: Points) -> dict[str, float]:
        n, one = points.n, np.ones(points.n)

        def production(fields: np.ndarray) -> np.ndarray:
            log_T, *v = fields.reshape(3, n)
            return seen(dih, (one, np.stack(v, axis=1), np.exp(log_T)))[1]
        bounds = np.repeat([WIDEST, FAST, FAST], n)
        start = np.random.default_rng(self.seed).uniform(-bounds, bounds)
        found = minimize(lambda fields: summed(production(fields)), start, options={"maxiter": STEPS},
                         bounds=np.stack([-bounds, bounds], axis=1))
        q = production(found.x)
        return {"total": np.nan, "least": summed(q), "negative": np.mean(q < 0)}
