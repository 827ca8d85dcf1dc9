"""Gradients as RR98 print them, and by differences, off a lattice    [RR98 Eqs 1, 14, 45]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from particles.integral.edge_makers import plain
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.ordering.derive import line
from studies.ordering.tables import BRACKET_POINT
from studies.build.disorder import BREADTH, DISORDERS, Disorder

FORMS = ("single", "sum", "difference")
WAVELENGTH = 32
#: wavelengths at h = 3 a; more points take longer to relax
WAVES = {"lattice": (16, 24, 32, 48, 64, 96), "jittered-0.3": (16, 24, 32, 48, 64, 96), "random": (16, 24, 32, 48, 64, 96),
         "relaxed": (16, 20, 24, 32)}


def form_errors(edges: Edges, x: np.ndarray, k: float) -> dict[str, float]:
    """Rms errors of the gradient of sin kx in three forms, over the rms of the true one; both phases.

    single : sum_j W_ij V_j e_ji f_j    [Eq. 1, inner sums of Eqs 37, 38]. sum : with f_i + f_j    [Eqs 10-14, 34-36].
    difference : with f_j - f_i. The wave has no mean; one would add to the errors of the first two.
    """
    found: dict[str, float] = {}
    single: list[Any] = [S/2 for S in edges.areas]
    for form, matrices in zip(FORMS, (single, edges.D, edges.G), strict=True):
        missed = np.zeros(edges.n)
        for phase in (0.0, np.pi/2):
            f, slope = np.sin(k*x + phase), k*np.cos(k*x + phase)
            along, *across = (M@f/edges.V for M in matrices)
            missed += ((along - slope)**2 + sum(g**2 for g in across))/2
        found[form] = float(np.sqrt(2*(edges.V@missed)/edges.V.sum()))/k
    return found


@dataclass(frozen=True, kw_only=True)
class Brackets(Case):
    """Errors of the three forms by plain quadrature, Lucy's weight of range h, for a wave along x; lengths in spacings."""
    disorder: Disorder
    h: float
    wavelength: int
    seed: int = 1
    make: Callable[[Points, Any], Edges] = plain
    weight: Any = Lucy

    @property
    def cost(self) -> float:
        return 0.05 + (3.0 if self.disorder.name == "relaxed" else 0.0)

    @property
    def label(self) -> str:
        return f"brackets h {self.h:g}, {self.disorder.name}, wavelength {self.wavelength}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.wavelength, BREADTH), self.disorder.size, self.seed)
        edges = self.make(points, self.weight.of(h=self.h))
        key = {"h": self.h, "points": self.disorder.name, "wavelength": self.wavelength, "seed": self.seed}
        return Outcome({"brackets": [{**key, **form_errors(edges, points.x[:, 0], 2*np.pi/self.wavelength)}]})


def brackets(ranges: tuple[float, ...], seeds: tuple[int, ...], kinds: tuple[str, ...] = tuple(WAVES)) -> Iterator[Case]:
    """All ranges at one wavelength, h = 3 a at all wavelengths."""
    for kind in kinds:
        places = {*((h, WAVELENGTH) for h in ranges), *((3.0, wavelength) for wavelength in WAVES[kind])}
        for h, wavelength in sorted(places):
            for seed in seeds if kind != "lattice" else seeds[:1]:
                yield Brackets(disorder=DISORDERS[kind], h=h, wavelength=wavelength, seed=seed)


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Means over seeds, and slopes over the wavelengths."""
    if "brackets" not in tables:
        return {}
    means = list(over_seeds(tables["brackets"]))
    return {"bracket_means": means, "bracket_slopes": list(slopes(pd.DataFrame(means)))}


def over_seeds(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a range, kind of points, wavelength and form."""
    for key, group in rows.groupby(BRACKET_POINT):
        for form in FORMS:
            error = combine([(value, 0.0) for value in group[form]])
            yield {**dict(zip(BRACKET_POINT, key, strict=True)), "form": form, "seeds": len(group), "error": error.value,
                   "error_err": error.err}


def slopes(means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """d ln error/d ln(h/lambda) at h = 3 a."""
    for (kind, form), group in means[means["h"] == 3.0].groupby(["points", "form"]):
        if len(group) > 2:
            slope, err = line(-np.log(group["wavelength"].to_numpy()), np.log(group["error"].to_numpy()))
            yield {"points": kind, "form": form, "slope": slope, "slope_err": err}
