"""The square cavity by the spectral method, on more and more functions, and on the staggered grid.

`paper` takes two minutes, most of them on 48 functions.
"""
from collections.abc import Iterator

import numpy as np

from continuum import boussinesq
from continuum.boussinesq import BoussinesqCase, Box, BoxEdges, End
from continuum.spectral.cavity import CavityLaws, observed, steady
from studies.kit.case import Case, Report
from studies.kit.fits import four_grids
from studies.kit.table import Table

TABLE = Table.of(
    "cavity", "method ra resolution quantity", "value err",
    about="A number of the square cavity of de Vahl Davis, Boussinesq fluid, Pr 0.71; velocities in kappa/L, "
          "places in L from the lower left corner.",
    means={"quantity": ("as in continuum/published/devahldavis.csv: nu of the mean, nu-max of the hot side, "
                        "u-max on the upright, v-max on the level middle line, psi-middle", ""),
           "err": ("of the spectral method what more functions change, the most of those before; of limits "
                   "half of the 95 % interval", "")})
PR = 0.71
RAS = (1e3, 1e4, 1e5, 1e6)
#: hot left side, cold right side, insulated above and below
CAVITY = Box(sides=BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=-0.5),
             plates=BoxEdges(flow=End.WALL, heat=End.MIRROR))


class SpectralCavity(Case, table="cavity", same="ra"):
    """From rest, then from the state on fewer functions."""
    ra: float
    sizes: tuple[int, ...]

    @property
    def cost(self) -> float:
        return sum(4e-9*n**6 for n in self.sizes)

    def measure(self, report: Report) -> Iterator[dict]:
        seen, state = list[dict[str, float]](), None
        for n in self.sizes:
            state = steady(CavityLaws(self.ra, PR), n, state)
            seen.append(observed(state))
            report(n/self.sizes[-1])
        for n, here, other in zip(self.sizes, seen, [*seen[1:], seen[-2]]):
            for name, value in here.items():
                yield {"method": "spectral-boussinesq", "resolution": n, "quantity": name, "value": value,
                       "err": abs(value - other[name])}


class GridCavity(Case, table="cavity", same="ra"):
    """Nu of the hot side on staggered grids, and its limit."""
    ra: float
    sizes: tuple[int, ...]

    def measure(self, report: Report) -> Iterator[dict]:
        values, state = list[float](), None
        for rows in self.sizes:
            state = boussinesq.steady(BoussinesqCase(ra=self.ra, pr=PR, box=CAVITY, rows=rows), state)
            values.append(state.observe().nu_left)
            report(rows/self.sizes[-1])
        limit = (np.inf, *four_grids(self.sizes, values))
        for resolution, value, err in (*zip(self.sizes, values, [0.0]*len(values)), limit):
            yield {"method": "boussinesq", "resolution": resolution, "quantity": "nu", "value": value,
                   "err": err}


def cases(size: str) -> list[Case]:
    """Size `quick` has two Ra."""
    quick = size == "quick"
    grids, functions = ((16, 24, 32), (12, 16)) if quick else ((32, 48, 64, 96), (24, 32, 40, 48))
    ras = RAS[:2] if quick else RAS
    return [*(SpectralCavity(ra=ra, sizes=functions) for ra in ras),
            *(GridCavity(ra=ra, sizes=grids) for ra in ras)]
