"""Spectra of a frozen fluid beside Debye's of the continuum    [KHP95, Sec. VII]

In 2D there are omega^2/(4 pi n c^2) waves a particle below omega, of each kind. A fluid has one kind, sound,
in which the density fluctuates. A lattice has shear waves, too; the density in them is their motion along k.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from studies.kit.case import Case, Outcome, Report
from studies.lattices.crystals import Crystal, Lattice, matrices, sums, whole_numbers

C2 = 2.0            # of the ideal gas at T = 1
LONG = 1e-3         # wave number that counts as zero
DIRECTIONS = np.linspace(0, np.pi, 24, endpoint=False)
OMEGAS = (0.02, 0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0)


def waves(crystal: Crystal, k: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """omega^2 (n, 2) of both motions at wave vectors in the first zone, shares of them along k."""
    of_unit = sums(crystal.weight.of(h=crystal.h), crystal.lattice, k)
    squares, a = np.linalg.eigh(matrices(of_unit, crystal.eos, crystal.e, crystal.rho))
    along = np.einsum("kas,ka->ks", a, k/np.hypot(*k.T)[:, None])**2
    return squares, along


def first_zone(lattice: Lattice, k: np.ndarray) -> np.ndarray:
    """The shortest wave vectors of the same motions."""
    turns = 2*np.pi*(whole_numbers((9, 9)) - 4)/lattice.size
    same = np.abs(np.sin(turns@lattice.neighbours(2.0).T/2)).max(axis=1) < 1e-9
    choices = k[:, None] - turns[same]
    return choices[np.arange(len(k)), np.argmin((choices**2).sum(axis=2), axis=1)]


@dataclass(frozen=True, kw_only=True)
class Debye(Case):
    """Numbers of the longest waves over those of the fluid, by their speeds; share of all waves that grow."""
    crystal: Crystal

    def run(self, report: Report, folder: Path) -> Outcome:
        k = LONG*np.stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)], axis=1)
        squares, _ = waves(self.crystal, k)
        shear, sound = np.where(squares > 0, C2*LONG**2/squares, np.nan).mean(axis=0)
        every, _ = waves(self.crystal, self.crystal.lattice.vectors(self.crystal.cells))
        return Outcome({"debye": [{**self.crystal.columns, "sound": sound, "shear": shear,
                                   "growing": np.mean(every < 0)}]})


@dataclass(frozen=True, kw_only=True)
class Spectrum(Case):
    """Waves a particle with frequencies below omega, of all that fit into the box of the crystal."""
    crystal: Crystal

    def run(self, report: Report, folder: Path) -> Outcome:
        lattice = self.crystal.lattice
        k = first_zone(lattice, lattice.vectors(self.crystal.cells))
        squares, along = waves(self.crystal, k)
        rows = []
        for omega in OMEGAS:
            below = squares < omega**2
            rows.append({**self.crystal.columns, "omega": omega, "fluid": omega**2/(4*np.pi*C2),
                         "density": (below*along).sum()/len(k), "modes": below.sum()/len(k)})
        return Outcome({"spectrum": rows})
