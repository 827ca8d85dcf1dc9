"""Errors of discrete gradients and Laplacians of plane waves, as cases    [RR98 Eqs 1-6, 10-14, 28-36, 45]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from particles.integral.edge_makers import plain
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.weights import Lucy
from studies.build.disorder import BREADTH, Disorder
from studies.kit.case import Case, Outcome, Report

#: how a gradient is taken over the edges
FORMS = ("single", "sum", "difference")
ERRORS = ("gradient", "laplacian", "closure", "linear")


@dataclass(frozen=True, kw_only=True)
class OperatorErrors(Case):
    """Relative rms errors of gradient and Laplacian of a plane wave along x, in 2D.

    make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings; wavelength in
    spacings. Where no edges of the kind exist the row has no errors.
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
        settling = 3.0*(self.disorder.name == "relaxed")
        return 2e-5*self.wavelength*BREADTH*self.h**2 + settling

    @property
    def label(self) -> str:
        edges = f"{self.maker} {self.weight.__name__} h {self.h:g}"
        return f"{edges}, {self.disorder.name}, wavelength {self.wavelength}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        key = {"maker": self.maker, "weight": self.weight.__name__, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "seed": self.seed,
               "a_over_h": 1/self.h, "h_over_lambda": self.h/self.wavelength}
        try:
            edges = self.make(points, self.weight.of(h=self.h))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"operators": [key | dict.fromkeys(ERRORS, np.nan)]})
        gradient, laplacian = wave_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)
        closure = float(np.abs(edges.closure).max())
        linear = float(np.abs(edges.linear - np.eye(2)).max())
        errors = dict(zip(ERRORS, (gradient, laplacian, closure, linear), strict=True))
        return Outcome({"operators": [key | errors]})


def wave_errors(edges: Edges, x: np.ndarray, k: float) -> tuple[float, float]:
    """Rms errors of grad and lap of sin kx over the rms of the true ones; both phases, so that no point is special."""
    grad, lap = [], []
    for phase in (0.0, np.pi/2):
        f, slope = np.sin(k*x + phase), k*np.cos(k*x + phase)
        along, across = edges.grad(f).T
        grad.append((along - slope)**2 + across**2)
        lap.append((edges.lap(f) + k**2*f)**2)
    V = edges.V/edges.V.sum()
    gradient, laplacian = (float(np.sqrt(V@np.mean(squares, axis=0))) for squares in (grad, lap))
    return gradient/(k/np.sqrt(2)), laplacian/(k**2/np.sqrt(2))


@dataclass(frozen=True, kw_only=True)
class Brackets(Case):
    """Errors of the gradient of a wave along x in three forms, by plain quadrature with Lucy's weight of range h."""
    disorder: Disorder
    h: float
    wavelength: int
    seed: int = 1
    make: Callable[[Points, Any], Edges] = plain
    weight: Any = Lucy

    @property
    def cost(self) -> float:
        return 0.05 + 3.0*(self.disorder.name == "relaxed")

    @property
    def label(self) -> str:
        return f"brackets h {self.h:g}, {self.disorder.name}, wavelength {self.wavelength}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        edges = self.make(points, self.weight.of(h=self.h))
        key = {"h": self.h, "points": self.disorder.name, "wavelength": self.wavelength, "seed": self.seed}
        errors = form_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)
        return Outcome({"brackets": [key | errors]})


def form_errors(edges: Edges, x: np.ndarray, k: float) -> dict[str, float]:
    """Rms errors of the gradient of sin kx in three forms, over the rms of the true one; both phases.

    single : sum_j W_ij V_j e_ji f_j    [Eq. 1, inner sums of Eqs 37, 38]. sum : with f_i + f_j    [Eqs 10-14, 34-36].
    difference : with f_j - f_i. The wave has no mean; one would add to the errors of the first two.
    """
    single: list[Any] = [S/2 for S in edges.areas]
    errors = (form_error(edges, matrices, x, k) for matrices in (single, edges.D, edges.G))
    return dict(zip(FORMS, errors, strict=True))


def form_error(edges: Edges, matrices: Any, x: np.ndarray, k: float) -> float:
    """That of V times the gradient by these matrices, one a direction."""
    squares = np.zeros(edges.n)
    for phase in (0.0, np.pi/2):
        f, slope = np.sin(k*x + phase), k*np.cos(k*x + phase)
        along, *across = (M@f/edges.V for M in matrices)
        squares += ((along - slope)**2 + sum(g**2 for g in across))/2
    return float(np.sqrt(2*(edges.V@squares)/edges.V.sum()))/k
