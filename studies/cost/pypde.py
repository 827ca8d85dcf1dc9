"""py-pde's solver of the gas, compiled at each call, as a case that is one call.

Steps are at the limit of its own formula, an eighth longer than which ends in the vortex (in convection the driver's
0.8 of it); compiling is not counted, nor what py-pde does around the steps. Each component of the velocity is compared
where the staggered grid has it.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.vortex import solved, velocities
from continuum.fluid import energy, sound_speed, temperature
from continuum.pypde import solve as pypde
from continuum.pypde.gas import RK4_DECAY, RK4_WAVE, Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.fields import Fields
from studies.build.grid import started
from studies.build.names import START_ENERGY
from studies.cost.contestants import StandingWave, VortexDecay
from studies.cost.problem import Result
from studies.cost.race import Race
from studies.cost.rolls import END, OFTEN, Followed, HeatedLayer, unit
from studies.cost.seconds import Laps, array_bytes, of_calls
from studies.kit.case import Outcome, Report
from studies.kit.stats import Measured

SAMPLES = 5         # of the seconds, which are those of as many equal parts of the run


class SolverRun(NamedTuple):
    """What comes out, the uncertainty of the exact answer; seconds of the steps and of setting up; step over its limit."""
    solution: pypde.Solution
    result: Result
    known: float
    seconds: Measured
    setup: Measured = Measured(0.0)
    of_limit: float = np.nan


@dataclass(frozen=True, kw_only=True)
class SolverRace(Race):
    """The solver, called once; what the entry makes is a `SolverRun`."""

    def run(self, report: Report, folder: Path) -> Outcome:
        one = self.made()
        done, run_s, setup = one.solution, one.seconds, one.setup
        row = {**self.columns, "points": done.state[0].size, "of_limit": one.of_limit, "dt": np.nan,
               "steps": done.steps, "run_s": run_s.value, "run_s_err": run_s.err, "setup_s": setup.value,
               "setup_s_err": setup.err, "compile_s": done.compile_s,
               "bytes": array_bytes(done.state, done.equation), "threads": 1}
        return Outcome({"errors": list(self.errors(one.result, one.known)), "runs": [row]})


# --- flows with exact answers -----------------------------------------------------------------------------------


class Still(Gas):
    """The gas of scenes without gravity at temperatures and densities about 1; `fastest`: of its velocities."""

    def __init__(self, scene: Any, rows: int, fastest: float, slide: float = 0.0):
        super().__init__(scene, rows, slide)
        self.fastest = fastest

    def step_limit(self) -> float:
        """As that of convection."""
        eos, law = self.scene.eos, self.scene.law
        sound = float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0)))
        wave = (2*np.sqrt(2)*sound + self.fastest)/self.h
        decay = 8*max(law.eta, law.k/eos.cv)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_WAVE))

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """v^2/2 per volume, as cheap as it gets: samples are there for their times."""
        return float((data[VX]**2 + data[VY]**2).mean()/2), np.nan, 1.0

    def nusselt(self, data: np.ndarray) -> tuple[float, float, float]:
        """No heat is driven through it."""
        return np.nan, np.nan, np.nan

    def begun(self) -> np.ndarray:
        """The state (4, columns, rows) at the start, each field where it is."""
        at = [started(self.scene, *self.mesh(field)) for field in range(4)]
        return np.array([at[RHO][0], at[VX][1], at[VY][2], energy(self.scene.eos, at[E][0], at[E][3])])

    def places(self, field: int) -> np.ndarray:
        """(n, 2) of a field's points."""
        return np.stack([q.ravel() for q in self.mesh(field)], axis=1)


def vortex(flow: VortexDecay, method: None, size: int, seed: int) -> SolverRun:
    """The largest velocity counts twice: the formula knows no rest."""
    scene = flow.scene(size)

    def judge(gas: Still, data: np.ndarray) -> Result:
        answer, v = solved(flow.mach), data[[VX, VY]].reshape(2, -1).T
        u, w = (velocities(answer, gas.places(field)/scene.L) for field in (VX, VY))
        exact = np.stack([u[:, 0], w[:, 1]], axis=1)
        return Result(flow.against(scene, np.ones(len(v)), exact, v))
    return in_flow(flow, partial(Still, scene, size, 2*scene.speed), judge)


def sound(flow: StandingWave, method: None, size: int, seed: int) -> SolverRun:
    """Small waves have no velocity that counts."""
    scene = flow.scene(size)

    def judge(gas: Still, data: np.ndarray) -> Result:
        T, u = temperature(scene.eos, data[RHO], data[E]).ravel(), data[VX].ravel()
        middles, sides = (gas.places(field)[:, 0] for field in (E, VX))
        return Result(flow.against(scene, np.ones(T.size), (sides, u), (middles, T)))
    return in_flow(flow, partial(Still, scene, scene.L, 0.0), judge)


def in_flow(flow: Any, make: Callable[[], Still], judge: Callable[[Still, np.ndarray], Result]) -> SolverRun:
    """From the start of a scene to its end."""
    gas, laps = make(), Laps()
    done = pypde.solve(gas, until=Time(gas.scene.time, SAMPLES), start=gas.begun(), dt=gas.step_limit(), progress=laps)
    setup = of_calls(lambda: make().begun())
    return SolverRun(done, judge(gas, done.state), flow.known, laps.total(SAMPLES), setup, 1.0)


# --- convection -------------------------------------------------------------------------------------------------


def convection(flow: HeatedLayer, method: None, rows: int, seed: int) -> SolverRun:
    """At the driver's own step."""
    scene, laps, samples = flow.scene(rows), Laps(), round(END*OFTEN)
    done = pypde.solve_gas(scene, rows, until=Time(END*unit(scene), samples), start=pypde.Rolls(START_ENERGY),
                           progress=laps)
    followed = Followed(done.series.t/unit(scene), done.series.ke, done)
    return SolverRun(done, flow.result(followed, seen(scene, done)), flow.answer.known, laps.total(samples))


def seen(scene: RayleighBenard, done: pypde.Solution) -> Fields:
    """Fields of a solution, places in heights."""
    x, y, vx, vy, T = (done.fields[name].ravel() for name in ("x", "y", "v_x", "v_y", "T"))
    one = np.ones_like(T)
    return Fields(np.stack([x, y], axis=1)/scene.L, np.stack([vx, vy], axis=1), one, T, one)
