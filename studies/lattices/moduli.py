"""Spurious shear modulus of lattices over their bulk modulus, by lattice sums and by the compiled ones    [KHP95, Sec. II]"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from particles.weights import value_and_slope
from studies.build.periodic_box import densities, fluid
from studies.kit.case import Case, Outcome, Report
from studies.lattices.waves import CELLS, lattice, neighbours

STRAIN = 1e-3       # second differences over it: truncation 1e-6, round-off 1e-10
WIDEST = 6.0        # range of the weights that are summed by particles, too: half of the box that they need
CELL_COUNTS = {"square": (14, 14), "diagonal": (10, 10), "hexagonal": (14, 8)}


def stretched_density(weight: Any, kind: str, strain: float) -> float:
    """sum of w on a lattice stretched by exp(strain) along x and by exp(-strain) along y."""
    r = np.hypot(*(neighbours(kind, weight.h*np.exp(abs(strain)))*np.exp([strain, -strain])).T)
    return value_and_slope(weight, 0.0)[0] + sum(value_and_slope(weight, one)[0] for one in r)


def modulus(density_at: Any) -> float:
    """G/B of the ideal gas from its density at strains, at constant area: G = P d2(rho)/d(gamma)^2, gamma twice the strain.

    Without heat the energy per mass goes as rho, and B = 2 P.
    """
    return float(np.diff([density_at(s) for s in (-STRAIN, 0.0, STRAIN)], 2)[0]/STRAIN**2/8)


@dataclass(frozen=True, kw_only=True)
class Moduli(Case):
    """Both moduli for one lattice and one weight over ranges h, in spacings. lattice : name in CELLS."""
    lattice: str
    weight: Any
    h: tuple[float, ...]

    @property
    def cost(self) -> float:
        return 1e-4*sum(h**2 for h in self.h)

    def run(self, report: Report, folder: Path) -> Outcome:
        assert self.lattice in CELLS
        return Outcome({"moduli": [self._row(h) for h in self.h]})

    def _row(self, h: float) -> dict[str, Any]:
        weight = self.weight.of(h=h)
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": h,
                "exact": modulus(lambda s: stretched_density(weight, self.lattice, s)),
                "measured": modulus(lambda s: self._summed(weight, s)) if h <= WIDEST else np.nan}

    def _summed(self, weight: Any, strain: float) -> float:
        """Mean density by the sums that run."""
        at = lattice(self.lattice, CELL_COUNTS[self.lattice], strain)
        return float(densities(fluid(weight, at.box), at.x).mean())
