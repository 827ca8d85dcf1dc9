"""py-pde's solver of the gas on a staggered grid as a case that is one call.

Steps are at the limit of its own formula, an eighth longer than which ends in the vortex; compiling is not
counted, nor what py-pde does around the steps.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from continuum.exact.vortex import solved, velocities
from continuum.fluid import energy, sound_speed
from continuum.pypde import solve as pypde
from continuum.pypde.gas import Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.steady import RK4_DECAY, RK4_SOUND, Time
from studies.build.grid import started
from studies.build.scenes import TaylorGreen
from studies.cost.contestants import DecayingVortex
from studies.cost.problem import Result
from studies.cost.race import Race
from studies.cost.seconds import Laps, of_calls
from studies.cost.tables import with_err
from studies.kit.case import Outcome, Report
from studies.kit.stats import Measured

SAMPLES = 5         # of the seconds, which are those of as many equal parts of the run


class Slow(Gas):
    """The gas of a slow vortex at a temperature and density about 1."""

    @classmethod
    def of(cls, scene: TaylorGreen) -> "Slow":
        """Cells of one spacing."""
        return cls(scene, scene.L)

    def step_limit(self) -> float:
        """As that of convection; of velocities twice the largest one."""
        eos, law = self.scene.eos, self.scene.law
        sound = float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0)))
        wave = (2*np.sqrt(2)*sound + 2*self.scene.speed)/self.h
        decay = 8*max(law.eta, law.k/eos.cv)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_SOUND))

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """v^2/2 per volume, as cheap as it gets: samples are there for their times."""
        return float((data[VX]**2 + data[VY]**2).mean()/2), np.nan, 1.0

    def nusselt(self, data: np.ndarray) -> tuple[float, float]:
        """No heat is driven through it."""
        return np.nan, np.nan

    def begun(self) -> np.ndarray:
        """The state (4, columns, rows) at the start, each field where it is."""
        at = [started(self.scene, *self.mesh(field)) for field in (RHO, VX, VY, E)]
        (rho, *_), (_, u, *_), (*_, v, _), (heavy, *_, warm) = at
        return np.array([rho, u, v, energy(self.scene.eos, heavy, warm)])

    def exact(self) -> np.ndarray:
        """Velocities (n, 2) at the end over the initial speed, each component where it is."""
        answer = solved(self.scene.mach)
        components = []
        for axis, field in enumerate((VX, VY)):
            x, y = self.mesh(field)
            place = np.stack([x.ravel(), y.ravel()], axis=1)/self.scene.L
            components.append(velocities(answer, place)[:, axis])
        return np.stack(components, axis=1)


class Stopped(NamedTuple):
    """The end, what it is worth, seconds of the steps and of setting up."""
    end: pypde.PdeSolution
    result: Result
    seconds: Measured
    setup: Measured


def vortex(flow: DecayingVortex, method: None, size: int, seed: int) -> Stopped:
    """From the start to the end."""
    scene, laps = flow.scene(size), Laps()
    gas = Slow.of(scene)
    until = Time(scene.time, SAMPLES)
    end = pypde.solve(gas, until=until, start=gas.begun(), dt=gas.step_limit(), progress=laps)
    setup = of_calls(lambda: Slow.of(scene).begun())
    v = end.state[[VX, VY]].reshape(2, -1).T
    result = Result(flow.against(scene, gas.exact(), np.ones(len(v)), v))
    return Stopped(end, result, laps.total(SAMPLES), setup)


@dataclass(frozen=True, kw_only=True)
class SolverRace(Race):
    """The solver, called once; what the entry makes is `Stopped`."""

    def run(self, report: Report, folder: Path) -> Outcome:
        end, result, seconds, setup = self.made()
        row = {**self.columns, "points": end.state[0].size, "of_limit": 1.0, "dt": np.nan, "steps": end.steps,
               **with_err(run_s=seconds, setup_s=setup)}
        errors = self.errors(result, self.entry.flow.known)
        return Outcome({"errors": list(errors), "runs": [row]})
