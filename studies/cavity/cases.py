"""The square cavity by the spectral method, on more and more functions, and on the staggered grid.

`paper` takes two minutes, most of them on 48 functions.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum import boussinesq
from continuum.boussinesq import BoussinesqCase, Box, BoxEdges, End
from continuum.spectral.cavity import CavityLaws, observed, steady
from studies.kit.case import Case, Outcome, Report
from studies.kit.fits import four_grids

PR = 0.71
RAS = (1e3, 1e4, 1e5, 1e6)
#: hot left side, cold right side, insulated above and below
CAVITY = Box(sides=BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=-0.5),
             plates=BoxEdges(flow=End.WALL, heat=End.MIRROR))


@dataclass(frozen=True, kw_only=True)
class SpectralCavity(Case):
    """From rest, then from the state on fewer functions."""
    ra: float
    sizes: tuple[int, ...]

    @property
    def cost(self) -> float:
        return sum(4e-9*n**6 for n in self.sizes)

    def run(self, report: Report, folder: Path) -> Outcome:
        seen, state = list[dict[str, float]](), None
        for n in self.sizes:
            state = steady(CavityLaws(self.ra, PR), n, state)
            seen.append(observed(state))
            report(n/self.sizes[-1])
        return Outcome({"cavity": [
            self.row("spectral-boussinesq", n, name, value, abs(value - other[name]))
            for n, here, other in zip(self.sizes, seen, [*seen[1:], seen[-2]])
            for name, value in here.items()]})

    def row(self, method: str, resolution: float, quantity: str, value: float, err: float) -> dict[str, Any]:
        """Of the table."""
        return {"method": method, "ra": self.ra, "resolution": resolution, "quantity": quantity,
                "value": value, "err": err}


class GridCavity(SpectralCavity):
    """Nu of the hot side on staggered grids, and its limit."""

    @property
    def cost(self) -> float:
        return sum(3e-4*rows**2 for rows in self.sizes)

    def run(self, report: Report, folder: Path) -> Outcome:
        values, state = list[float](), None
        for rows in self.sizes:
            state = boussinesq.steady(BoussinesqCase(ra=self.ra, pr=PR, box=CAVITY, rows=rows), state)
            values.append(state.observe().nu_left)
            report(rows/self.sizes[-1])
        all_rows = [(rows, value, 0.0) for rows, value in zip(self.sizes, values)]
        limit = (np.inf, *four_grids(self.sizes, values))
        return Outcome({"cavity": [self.row("boussinesq", rows, "nu", value, err)
                                   for rows, value, err in (*all_rows, limit)]})


def cases(size: str) -> list[Case]:
    """Size `quick` has two Ra."""
    quick = size == "quick"
    grids, functions = ((16, 24, 32), (12, 16)) if quick else ((32, 48, 64, 96), (24, 32, 40, 48))
    return [kind(ra=ra, sizes=sizes) for kind, sizes in ((SpectralCavity, functions), (GridCavity, grids))
            for ra in RAS[:2 if quick else None]]
