"""Algebra and arithmetic of the printed formulas, as a case    [RR98 Eqs 21, 23, 42, 44]"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from particles.integral import fluctuating
from particles.integral.edge_makers import MAKERS
from particles.integral.points import lattice, random
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.steps import isothermal


def other_partner() -> float:
    """|Q - 2 kT Gamma| of the eta term of Eq. 42 on random points, Gamma a friction along edges, trace factor 2/d."""
    edges = MAKERS["delaunay"](random((8, 8), 0.5, 1), None)
    k = np.maximum(edges.k, 1e-3)       # any positive number: A and B make it up
    V, S2 = (edges.V[edges.i] + edges.V[edges.j])/2, (edges.S**2).sum(axis=1)
    pair = fluctuating.printed_stress(edges, 0.3, 0.0, 1.0, doubled=False, trace=1.0)
    A = 0.3*S2/(2*V)/k                  # 2D: S S (1 - 2/d) vanishes, B = 0
    wider = type(edges)(i=edges.i, j=edges.j, S=edges.S, k=k, apart=edges.apart, V=edges.V)
    due = 2*fluctuating.between(wider, A, 0*A, np.ones(len(A))).Gamma
    return float(abs(pair.Q - due).max()/abs(due).max())


def finer() -> float:
    """Variance of the literal noise over its due at the spacing 1/2 over that at 1, 2D: what a missing volume does."""
    found = []
    for a in (0.5, 1.0):
        edges = MAKERS["renormalised"](lattice((8, 8), a), Lucy.of(h=1.5*a))
        pair = fluctuating.printed_stress(edges, 0.3, 0.1, 1.0, doubled=True, volume=False)
        found.append(float(pair.Q.diagonal().sum()/(2*pair.Gamma.diagonal().sum())))
    return found[0]/found[1]


def half_step() -> float:
    """<u u> with increments of unit variance whatever the step, at dt/2 over that at dt: exact steady states of a decay."""
    def variance(dt: float) -> float:
        l = 0.1     # u' = (1 - l dt/2)/(1 + l dt/2) u + dt X/(1 + l dt/2), <X X> = 1
        return dt**2/((1 + l*dt/2)**2 - (1 - l*dt/2)**2)
    return variance(0.5)/variance(1.0)


def inner_k(k: float = 0.5) -> float:
    """<(tr Pi)^2>/<Pi_xy^2> of Eq. 23 in 3D without bulk viscosity, 6 (1 - k): an inner k is left over."""
    tensor = fluctuating.shear(3, 2/3*k).reshape(3, 3, 3, 3)
    return float(np.einsum("aacc->", tensor)/tensor[0, 1, 0, 1])


def wrong_sign() -> float:
    """Largest growth rate of sound at k = 0.4 with the sign of Eq. 21 as printed."""
    J, _ = isothermal(0.4)
    J[0] *= -1
    return float(np.linalg.eigvals(J).real.max())


def bulk(d: int) -> float:
    """Variance of the trace of X, over d^2: noise of a bulk viscosity that is not there."""
    return float(np.trace(fluctuating.shear(d, 2/3).reshape(d, d, d, d).trace(axis1=0, axis2=1)))/d**2


@dataclass(frozen=True, kw_only=True)
class Formulas(Case):
    """What printed formulas give, each a row of `formulas`."""

    @property
    def label(self) -> str:
        return "formulas"

    def run(self, report: Report, folder: Path) -> Outcome:
        values = {"growth of Eq. 21": wrong_sign(), "trace of Eq. 23": inner_k(), "partner of Eq. 42": other_partner(),
                  "step of Eq. 42": half_step(), "spacing of Eq. 42": finer(), "trace of Eq. 44": bulk(2)}
        return Outcome({"formulas": [{"name": name, "value": value} for name, value in values.items()]})
