"""Errors of discrete gradients and Laplacians on point sets as cases    [RR98 Eqs 1-6, 28-32, 45]"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from particles.integral.edges import Edges
from particles.integral.points import Points, irregularity, jittered, lattice, off_lattice, random, relaxed
from particles.weights import WendlandC2
from studies.kit.case import Case, Outcome, Report


@dataclass(frozen=True, kw_only=True)
class OperatorErrors(Case):
    """Relative rms errors of gradient and Laplacian of a plane wave along x, in 2D.

    make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings; wavelength in spacings. Where no edges of the
    kind exist the row has no errors.
    """
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    wavelength: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 2e-5*self.wavelength*BREADTH*self.h**2 + (3.0 if self.disorder.name == "relaxed" else 0.0)

    @property
    def label(self) -> str:
        return f"{self.maker} {self.weight.__name__} h {self.h:g}, {self.disorder.name}, wavelength {self.wavelength}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        key = {"maker": self.maker, "weight": self.weight.__name__, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "seed": self.seed, "a_over_h": 1/self.h, "h_over_lambda": self.h/self.wavelength}
        try:
            edges = self.make(points, self.weight.of(h=self.h))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"operators": [{**key, **dict.fromkeys(("gradient", "laplacian", "closure", "linear"), np.nan)}]})
        gradient, laplacian = wave_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)
        return Outcome({"operators": [{**key, "gradient": gradient, "laplacian": laplacian,
                                       "closure": float(np.abs(edges.closure).max()),
                                       "linear": float(np.abs(edges.linear - np.eye(2)).max())}]})


def wave_errors(edges: Edges, x: np.ndarray, k: float) -> tuple[float, float]:
    """Rms errors of grad and lap of sin kx over the rms of the true ones; both phases, so that no point is special."""
    grad, lap = [], []
    for phase in (0.0, np.pi/2):
        f, slope = np.sin(k*x + phase), k*np.cos(k*x + phase)
        found = edges.grad(f)
        grad.append((found[:, 0] - slope)**2 + found[:, 1]**2)
        lap.append((edges.lap(f) + k**2*f)**2)
    V = edges.V/edges.V.sum()
    rms = [float(np.sqrt(V@np.mean(q, axis=0))) for q in (grad, lap)]
    return rms[0]/(k/np.sqrt(2)), rms[1]/(k**2/np.sqrt(2))
