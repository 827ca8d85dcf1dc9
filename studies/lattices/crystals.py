"""Lattices of smooth particles: how stiff they are, and what grows    [KHP95, Secs II, III, VI]

A fluid resists no shear, a lattice of particles does: its modulus is an error. Where the modulus, or any
other omega^2, is negative, the lattice gives way. Weights with pairs melt into pairs, fluids under negative
pressure clump; both begin as a small motion that grows.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from continuum.fluid import energy
from particles.limits import step_limit
from particles.observe import particle_kinetic
from particles.run import STUDIES, Divergence, Plan, run
from studies.build.periodic_box import at_rest, densities, fluid
from studies.kit.case import Case, Outcome, Report
from studies.kit.fits import line
from studies.kit.stats import Measured
from studies.lattices.waves import Motion, at_centre, lattice, least_stable, neighbours, total

# --- moduli ---------------------------------------------------------------------------------------

STRAIN = 1e-3       # of second differences: truncation 1e-6, round-off 1e-10
WIDEST = 6.0        # range up to which particles sum moduli, too: half of the box that they need
CELL_COUNTS = {"square": (14, 14), "diagonal": (10, 10), "hexagonal": (14, 8)}


@dataclass(frozen=True, kw_only=True)
class Moduli(Case):
    """Shear over bulk modulus of one lattice and one weight over ranges h, in spacings."""
    lattice: str
    weight: Any
    h: tuple[float, ...]

    @property
    def cost(self) -> float:
        return 1e-4*sum(h**2 for h in self.h)

    def run(self, report: Report, folder: Path) -> Outcome:
        return Outcome({"moduli": [self._row(h) for h in self.h]})

    def _row(self, h: float) -> dict[str, Any]:
        weight = self.weight.of(h=h)
        exact = modulus(lambda strain: stretched_density(weight, self.lattice, strain))
        measured = modulus(lambda strain: self._summed(weight, strain)) if h <= WIDEST else np.nan
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": h, "exact": exact, "measured": measured}

    def _summed(self, weight: Any, strain: float) -> float:
        """Mean density by the compiled sums of particles."""
        at = lattice(self.lattice, CELL_COUNTS[self.lattice], strain)
        return float(densities(fluid(weight, at.box), at.x).mean())


def modulus(density_at: Callable[[float], float]) -> float:
    """G/B of the ideal gas from its density at strains, at constant area.

    G = P d2(rho)/d(gamma)^2 with gamma twice the strain. Without heat the energy per mass goes as rho, so B =
    2 P.
    """
    rho = [density_at(strain) for strain in (-STRAIN, 0.0, STRAIN)]
    return float(np.diff(rho, 2)[0]/STRAIN**2/8)


def stretched_density(weight: Any, kind: str, strain: float) -> float:
    """Sum of w on a lattice stretched by exp(strain) along x and by exp(-strain) along y."""
    x = neighbours(kind, weight.h*np.exp(abs(strain)))
    r = np.hypot(*(x*np.exp([strain, -strain])).T)
    return at_centre(weight) + total(weight, r)


# --- motions that grow ----------------------------------------------------------------------------

SHIFT = 1e-8                    # of the places at the start, spacings
LINEAR = (1e-12, 1e-6)          # kinetic energies of shifts of 1e-6 to 1e-2 spacings: there a motion grows by its own rate
GROWN = 100.0                   # of the energy: what counts as growth in the search for the onset
PATIENCE = 200.0                # time that a search waits: ln 10/200 is a rate of 0.012
HALVINGS = 8
PHASE = 1.0                     # without it a cosine may vanish at all places at the edge of the zone

Shifts = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Crystal:
    """A lattice of inviscid particles at rest. rho : density, also the mass of a particle."""
    lattice: str
    cells: tuple[int, int]
    weight: Any
    h: float
    eos: Any
    T: float = 1.0
    rho: float = 1.0

    @property
    def e(self) -> float:
        return float(energy(self.eos, self.rho, self.T))

    @property
    def motion(self) -> Motion:
        """What grows fastest by lattice sums, or is slowest if nothing grows."""
        weight = self.weight.of(h=self.h)
        return least_stable(weight, self.eos, self.e, self.lattice, self.cells, self.rho)

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": self.h,
                "eos": type(self.eos).__name__, "T": self.T, "rho": self.rho}

    def energies(self, time: float, shifts: Shifts) -> tuple[np.ndarray, np.ndarray]:
        """Times and kinetic energies per mass until the run diverges. shifts : of places x (n, 2)."""
        at = lattice(self.lattice, self.cells)
        method = fluid(self.weight.of(h=self.h), at.box, self.eos, m=self.rho)
        start = at_rest(at.x + SHIFT*shifts(at.x), self.e)
        dt, kinetic = STUDIES*step_limit(method, self.e, self.rho), Kinetic()
        try:
            run(method, start, Plan(dt=dt, steps=round(time/dt), series={"k": kinetic}, every=2))
        except Divergence:
            pass
        return 2*dt*(1 + np.arange(len(kinetic.energies))), np.array(kinetic.energies)


class Kinetic:
    """Kinetic energies in time, kept also when the run diverges."""

    def __init__(self):
        self.energies: list[float] = []

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.energies.append(particle_kinetic(sums, state))
        return self.energies[-1]


def growth(times: np.ndarray, energies: np.ndarray) -> Measured:
    """Rate of the motion, half of the energy's, where the motion is small and has left the start behind."""
    low, high = LINEAR
    until = np.argmax(energies > high)
    linear = (energies > low) & (energies < high) & (np.arange(len(energies)) < until)
    return line(times[linear], np.log(energies[linear])/2).slope


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """The rate at which the fastest growing motion of a lattice grows, started alone."""
    crystal: Crystal

    @property
    def cost(self) -> float:
        return 2.0

    @property
    def label(self) -> str:
        return f"growth {self.crystal.columns}"

    def run(self, report: Report, folder: Path) -> Outcome:
        k, a, _ = motion = self.crystal.motion
        time = 20/motion.rate       # e^20: from 1e-8 to beyond what is linear
        rate = growth(*self.crystal.energies(time, lambda x: a*np.cos(x@k + PHASE)[:, None]))
        return Outcome({"growth": [{**self.crystal.columns, "predicted": motion.rate, "measured": rate.value,
                                    "measured_err": rate.err}]})


@dataclass(frozen=True, kw_only=True)
class Onset(Case):
    """The value of h or T at which motions begin to grow, by halving [stable, unstable]."""
    crystal: Crystal
    parameter: str
    stable: float
    unstable: float
    seed: int = 1

    @property
    def cost(self) -> float:
        return 10.0

    @property
    def label(self) -> str:
        return f"onset in {self.parameter} {self.crystal.columns} seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        predicted = brentq(lambda value: self._with(value).motion.rate, self.stable, self.unstable, xtol=1e-6)
        stable, unstable = self.stable, self.unstable
        for number in range(HALVINGS):
            report(number/HALVINGS)
            middle = (stable + unstable)/2
            stable, unstable = (stable, middle) if self._grows(middle) else (middle, unstable)
        return Outcome({"onsets": [{
            **self.crystal.columns, self.parameter: 0.0, "parameter": self.parameter, "seed": self.seed,
            "predicted": predicted, "measured": (stable + unstable)/2, "measured_err": abs(stable - unstable)/2}]})

    def _with(self, value: float) -> Crystal:
        changed: dict[str, Any] = {self.parameter: value}
        return replace(self.crystal, **changed)

    def _grows(self, value: float) -> bool:
        """Whether the mean energy of the last tenth is much larger than that of the second one."""
        rng = np.random.default_rng(self.seed)
        _, energies = self._with(value).energies(PATIENCE, lambda x: rng.standard_normal(x.shape))
        tenth = max(1, len(energies)//10)
        return bool(energies[-tenth:].mean() > GROWN*energies[tenth:2*tenth].mean())
