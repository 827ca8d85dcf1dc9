"""The square cavity by the spectral method, on more and more functions, and on the staggered grid.

`paper` takes some minutes, most of them on 48 functions.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from continuum import boussinesq
from continuum.boussinesq import BoussinesqCase, Box, BoxEdges, End
from continuum.spectral.cavity import CavityLaws, observed, steady
from studies.kit.case import Case, Outcome, Report

PR = 0.71
RAS = (1e3, 1e4, 1e5, 1e6)
SIDES = BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=-0.5)
CAVITY = Box(sides=SIDES, plates=BoxEdges(flow=End.WALL, heat=End.MIRROR))



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
        others = [*seen[1:], seen[-2]]
        rows = [{"method": "spectral-boussinesq", "ra": self.ra, "resolution": n, "quantity": name,
                 "value": value, "err": abs(value - other[name])}
                for n, here, other in zip(self.sizes, seen, others) for name, value in here.items()]
        return Outcome({"cavity": rows})


@dataclass(frozen=True, kw_only=True)
class GridCavity(Case):
    """Nu of the staggered grid, of the hot side."""
    ra: float
    sizes: tuple[int, ...]

    @property
    def cost(self) -> float:
        return sum(3e-4*rows**2 for rows in self.sizes)

    def run(self, report: Report, folder: Path) -> Outcome:
        rows, state = list[dict[str, Any]](), None
        for size in self.sizes:
            state = boussinesq.steady(BoussinesqCase(ra=self.ra, pr=PR, box=CAVITY, rows=size), state)
            rows.append({"method": "boussinesq", "ra": self.ra, "resolution": size, "quantity": "nu",
                         "value": state.observe().nu_left, "err": 0.0})
            report(len(rows)/len(self.sizes))
        return Outcome({"cavity": rows})


def cases(size: str) -> list[Case]:
    """Size `quick` has two Ra."""
    quick = size == "quick"
    grids, functions = ((16, 24, 32), (12, 16)) if quick else ((32, 48, 64, 96), (24, 32, 40, 48))
    ras = RAS[:2] if quick else RAS
    return [kind(ra=ra, sizes=sizes) for kind, sizes in ((SpectralCavity, functions), (GridCavity, grids))
            for ra in ras]
