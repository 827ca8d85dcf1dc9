"""Entropy that stress and heat current produce    [RR98 Eqs 37, 38, 51]

What leaves i over an edge for j, momentum f and energy e, heats i by -(e - v_i.f) and j by e - v_j.f, so

    dS/dt = sum over edges [(e - v_j.f)/T_j - (e - v_i.f)/T_i]

Of forces F along edges that heat as they work it is F.(v_j - v_i)(1/T_i + 1/T_j)/2 + kappa k (T_j - T_i)^2
/T_i T_j, never negative. The continuum has sigma : grad v/T + kappa (grad T)^2/T^2 in each place.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import Bounds, minimize

from continuum.fluid import ConstEta, IdealGas, stress_tensor
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from studies.operators.equations import ALONG, ETA, KAPPA, Spectral, smooth_flow
from studies.operators.scheme import PointSet

State = tuple[np.ndarray, np.ndarray, np.ndarray]       # rho (n,), v (n, 2), T (n,)
#: by name: as printed, and mended
WAYS = {"along edges": ALONG, "along edges, mended": Pairwise(), "nested": NestedFluxes()}
DRAWS, STEPS = 200, 60  # random states; steps of a search
SPREAD, WIDEST, FAST = 0.5, np.log(3), 1.0      # of ln T of random states; of ln T and v of sought ones


def produced(dih: Dih, state: State) -> np.ndarray:
    """dS/dt by each edge, (E,)."""
    edges, flow = dih.edges, dih.flow(dih.state(*state))
    (_, f, e), (v, T), i, j = dih.transport.fluxes(dih, flow), flow[1:3], edges.i, edges.j
    return ((v[i]*f).sum(axis=1) - e)/T[i] + (e - (v[j]*f).sum(axis=1))/T[j]


def share(dih: Dih, state: State) -> float:
    """Sum of what edges produce over the sum of its sizes."""
    q = produced(dih, state)
    return float(q.sum()/np.abs(q).sum())


def smooth(x: np.ndarray) -> State:
    """One wave along each axis of the unit box, T from 0.2 to 1.8."""
    rho, v, T = smooth_flow(x)
    return rho, v, 1 + 8*(T - 1)


def continuum() -> float:
    """Of that flow in two dimensions, where it does not depend on the size of the box; zeta = 0."""
    exact, (_, v, T) = Spectral((64, 64)), smooth(lattice((64, 64), 1/64).x)
    slope = exact.grad(v)
    friction = (stress_tensor(ETA*np.ones_like(T), 0*T, slope)*slope).sum(axis=(1, 2))
    return float(np.mean(friction/T + KAPPA*(exact.grad(T)**2).sum(axis=1)/T**2))


@dataclass(frozen=True, kw_only=True)
class Entropy(PointSet):
    """Of a smooth state, of random ones, or of the worst one that a descent from a random one finds."""
    way: str
    state: str
    table = "entropy"
    cost = 3.0

    def rows(self, points: Points, edges: Edges) -> Iterator[dict[str, Any]]:
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), transport=WAYS[self.way])
        every = np.array([produced(dih, state) for state in self.states(dih, points)])
        sums = every.sum(axis=1)
        yield {"transport": self.way, "state": self.state, "cells": self.counts[0],
               "total": sums[0]/continuum() if self.state == "smooth" else np.nan,
               "least": (sums/np.abs(every).sum(axis=1)).min(), "negative": np.mean(every < 0)}

    def states(self, dih: Dih, points: Points) -> Iterator[State]:
        """One, or many random ones."""
        n, rng = points.n, np.random.default_rng(self.seed)
        if self.state == "smooth":
            yield smooth(points.x/points.box)
        elif self.state == "sought":
            bounds = np.repeat([WIDEST, FAST, FAST], n)
            search: Any = minimize      # whose types know no options of one method
            found = search(lambda q: share(dih, unpacked(q)), rng.uniform(-bounds, bounds),
                           bounds=Bounds(-bounds, bounds), options={"maxiter": STEPS})
            yield unpacked(found.x)
        else:
            for _ in range(DRAWS):
                yield rng.uniform(0.5, 1.5, n), rng.normal(0, 0.3, (n, 2)), np.exp(rng.normal(0, SPREAD, n))


def unpacked(fields: np.ndarray) -> State:
    """Density 1, from ln T and velocities in one row."""
    log_T, *v = fields.reshape(3, -1)
    return np.ones_like(log_T), np.stack(v, axis=1), np.exp(log_T)
