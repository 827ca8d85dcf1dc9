"""Lattices that are let go: do small motions grow where and as fast as lattice sums say?    [KHP95, Secs III, VI]

Particles of an inviscid fluid without conduction start at rest, shifted by 1e-8 spacings: as the motion that is to grow first,
or at random. Weights with pairs melt into them, fluids under negative pressure clump: both begin as a motion that grows.
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
from studies.build.periodic_box import at_rest, fluid
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured
from studies.lattices.waves import Motion, lattice, least_stable
from studies.ordering.derive import line

SHIFT = 1e-8                    # spacings
LINEAR = (1e-12, 1e-6)          # kinetic energies between which a motion grows by its own rate: shifts of 1e-6 to 1e-2 spacings
GROWN = 100.0                   # of the energy, ten times the motion: what counts as growth in the search for the limit
PATIENCE = 200.0                # time that a search waits: ln 10/200 is a rate of 0.012
HALVINGS = 8
PHASE = 1.0                     # at the edge of the zone a cosine without it may vanish at all places


Shifts = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Crystal:
    """A lattice of particles at rest. lattice : name in `lattice_waves.CELLS`; rho : density, also the mass of a particle."""
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
        return least_stable(self.weight.of(h=self.h), self.eos, self.e, self.lattice, self.cells, self.rho)

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": self.h, "eos": type(self.eos).__name__,
                "T": self.T, "rho": self.rho}

    def energies(self, time: float, shifts: Shifts) -> tuple[np.ndarray, np.ndarray]:
        """Times and kinetic energies per mass; up to where it diverges, if it does. shifts : of places x (n, 2), of size 1."""
        at = lattice(self.lattice, self.cells)
        method, shift = fluid(self.weight.of(h=self.h), at.box, self.eos, m=self.rho), SHIFT*shifts(at.x)
        dt, kinetic = STUDIES*step_limit(method, self.e, self.rho), Track()
        try:
            run(method, at_rest(at.x + shift, self.e), Plan(dt=dt, steps=round(time/dt), series={"k": kinetic}, every=2))
        except Divergence:
            pass
        return 2*dt*(1 + np.arange(len(kinetic.found))), np.array(kinetic.found)


class Track:
    """Kinetic energies, kept also when the run does not come to its end."""

    def __init__(self):
        self.found: list[float] = []

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.found.append(particle_kinetic(sums, state))
        return self.found[-1]


def growth(times: np.ndarray, energies: np.ndarray) -> Measured:
    """Rate of the motion, half of the energy's, where it is small and larger than what began."""
    linear = (energies > LINEAR[0]) & (energies < LINEAR[1]) & (np.arange(len(energies)) < np.argmax(energies > LINEAR[1]))
    slope, err = line(times[linear], np.log(energies[linear])/2)
    return Measured(float(slope), float(err))


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
        shape = lambda x: a*np.cos(x@k + PHASE)[:, None]  # noqa: E731
        found = growth(*self.crystal.energies(20/motion.rate, shape))       # e^20: from 1e-8 to beyond what is linear
        return Outcome({"growth": [{**self.crystal.columns, "predicted": motion.rate, "measured": found.value,
                                    "measured_err": found.err}]})


@dataclass(frozen=True, kw_only=True)
class Onset(Case):
    """The value of one parameter (h or T of the crystal) at which motions begin to grow, by halving an interval.

    stable, unstable : values of the parameter.
    """
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
        columns = {**self.crystal.columns, self.parameter: 0.0}
        return Outcome({"onsets": [{**columns, "parameter": self.parameter, "seed": self.seed, "predicted": predicted,
                                    "measured": (stable + unstable)/2, "measured_err": abs(stable - unstable)/2}]})

    def _with(self, value: float) -> Crystal:
        changed: dict[str, Any] = {self.parameter: value}
        return replace(self.crystal, **changed)

    def _grows(self, value: float) -> bool:
        """The mean energy of the last tenth over that of the second one."""
        shape = lambda x: np.random.default_rng(self.seed).standard_normal(x.shape)  # noqa: E731
        energies = self._with(value).energies(PATIENCE, shape)[1]
        tenth = max(1, len(energies)//10)
        return bool(energies[-tenth:].mean() > GROWN*energies[tenth:2*tenth].mean())
