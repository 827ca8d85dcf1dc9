"""A decaying Taylor-Green vortex on fixed points, as a case, against the gas of the same Mach number    [RR98 Eqs 34-38]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.vortex import Vortex, incompressible, solved, velocities
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.integrators import RK4
from studies.build.disorder import Disorder
from studies.build.vortex import decayed
from studies.kit.case import Case, Outcome, Report

ERRORS = ("velocity", "decay", "incompressible", "exchanges")


@dataclass(frozen=True, kw_only=True)
class TaylorGreen(Case):
    """One vortex on one set of points; runs that diverge, and points without such edges, leave a row without errors.

    make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings; None where the maker
    takes none. wavelength in spacings.
    """
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any = None
    h: float = 0.0
    disorder: Disorder
    wavelength: int
    mach: float = 0.05
    seed: int = 1

    @property
    def cost(self) -> float:
        size = self.wavelength/32
        once = 1.0*(self.maker == "exact") + 6.0*(self.disorder.name == "relaxed")
        return size**3*(0.06*self.h + 0.15)*0.05/self.mach + size**4*once + 0.1

    @property
    def label(self) -> str:
        edges = f"{self.maker} {self.weight_name} h {self.h:g}"
        return (f"taylor-green {edges}, {self.disorder.name}, wavelength {self.wavelength}, "
                f"Mach {self.mach:g}, seed {self.seed}")

    @property
    def weight_name(self) -> str:
        return self.weight.__name__ if self.weight else "none"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, self.wavelength), self.disorder.size, self.seed)
        key = {"maker": self.maker, "weight": self.weight_name, "h": self.h, "points": self.disorder.name,
               "wavelength": self.wavelength, "mach": self.mach, "seed": self.seed}
        try:
            edges = self.make(points, self.weight.of(h=self.h) if self.weight else None)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"vortices": [key | dict.fromkeys(ERRORS, np.nan) | {"reached": 0.0}]})
        end = decayed(Vortex(self.mach, self.wavelength), points, edges, report)
        gas, place = solved(self.mach), points.x/self.wavelength
        errors = {"velocity": difference(edges.V, end.v, velocities(gas, place)),
                  "decay": end.decay/gas.decay - 1,
                  "incompressible": difference(edges.V, end.v, incompressible(place)),
                  "exchanges": RK4.evaluations*end.steps*len(edges.i) if end.reached == 1 else np.nan}
        return Outcome({"vortices": [key | errors | {"reached": end.reached}]})


def difference(V: np.ndarray, v: np.ndarray, known: np.ndarray) -> float:
    """Relative rms difference of velocities (n, 2)."""
    squares = ((v - known)**2).sum(axis=1)
    return float(np.sqrt(V@squares/(V@(known**2).sum(axis=1))))
