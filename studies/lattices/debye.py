"""Numbers of long waves of a frozen fluid beside those of Debye's continuum    [KHP95, Sec. VII]

In 2D there are omega^2/(4 pi n c^2) waves per particle below omega, of each kind. A fluid has one kind,
sound, in which the density fluctuates. A lattice has shear waves, too.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from studies.kit.case import Case, Outcome, Report
from studies.lattices.crystals import Crystal, matrices, sums

C2 = 2.0            # of the ideal gas at T = 1
LONG = 1e-3         # wave number that counts as zero
DIRECTIONS = np.linspace(0, np.pi, 24, endpoint=False)


def squares(crystal: Crystal, k: np.ndarray) -> np.ndarray:
    """omega^2 (n, 2) of both motions at wave vectors k (n, 2), the slower one first."""
    of_unit = sums(crystal.weight.of(h=crystal.h), crystal.lattice, k)
    return np.linalg.eigvalsh(matrices(of_unit, crystal.eos, crystal.e, crystal.rho))


@dataclass(frozen=True, kw_only=True)
class Debye(Case):
    """Numbers of long waves of a lattice, from their speeds, over that of the fluid."""
    crystal: Crystal

    def run(self, report: Report, folder: Path) -> Outcome:
        k = LONG*np.stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)], axis=1)
        long = squares(self.crystal, k)
        shear, sound = np.where(long > 0, C2*LONG**2/long, np.nan).mean(axis=0)
        return Outcome({"debye": [{**self.crystal.columns, "sound": sound, "shear": shear}]})
