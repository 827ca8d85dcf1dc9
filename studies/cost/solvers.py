"""Contestants that are solved in one call: the spectral gas, and py-pde in the vortex and in convection."""
from functools import cache, partial
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from continuum.fluid import energy, sound_speed
from continuum.pypde import solve as pypde
from continuum.pypde.gas import Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import SpectralState, steady
from continuum.steady import RK4_DECAY, RK4_SOUND, Time
from studies.build import answer
from studies.build.grid import started
from studies.build.names import START_ENERGY
from studies.cost.contestants import KNOWN, decay
from studies.cost.problem import Residuals, Result, relative, rms
from studies.cost.race import Race
from studies.cost.rolls import END, OFTEN, Followed, HeatedLayer, unit
from studies.kit.case import Outcome, Report
from studies.kit.stats import Measured, with_errors
from studies.kit.timing import median, of_calls

SAMPLES = 5         # of the seconds of py-pde in the vortex, one for each equal part of a run


# --- the spectral method: n functions along an axis against more of them ---------------------------------

FIRST = 8           # functions along an axis of the state from which larger ones start
#: functions up to -> functions of their exact answer; four fewer give its uncertainty
FINER = {12: 20, 24: 32}


@cache
def solved(ra: float, n: int) -> SpectralState:
    """The steady gas with n functions along an axis, from warm streams, solved once in a process."""
    laws = GasLaws(RayleighBenard(ra=ra))
    few = steady(laws, min(n, FIRST))
    return steady(laws, n, few) if n > FIRST else few


def apart(state: SpectralState, exact: SpectralState) -> Residuals:
    """Errors of K and velocity of a state at the points of a finer one, relative as in `rolls`."""
    finer, n = exact.equations, state.equations.n
    every = np.zeros((4, finer.n, finer.n))
    every[:, :n, :n] = state.equations.amplitudes(state.q)
    v, exact_v = (np.reshape(finer.at(q)[:2, 0], (2, -1)).T for q in (every[finer.kept], exact.q))
    velocity = relative(finer.weights.ravel(), v - exact_v, exact_v)
    return {"K": np.array([state.K/exact.K - 1]), "velocity": velocity}


class SpectralRace(Race):
    """The spectral gas to its steady state, without steps in time. resolution : functions along an axis."""

    @property
    def cost(self) -> float:
        return 3 + 5e-8*self.resolution**6      # three seconds for the exact answer, once in a process

    def run(self, report: Report, folder: Path) -> Outcome:
        ra, n = self.flow.ra, self.resolution
        state, more = solved(ra, n), next(finer for most, finer in FINER.items() if n <= most)
        exact, fewer = solved(ra, more), solved(ra, more - 4)
        uncertain = {name: rms(residual) for name, residual in apart(fewer, exact).items()}
        errors = list(self.errors(Result(apart(state, exact), uncertain), 0.0))
        report(0.5)
        seconds = of_calls(partial(solved.__wrapped__, ra, n))
        row = {**self.columns, "points": n**2, "of_limit": 1.0, "dt": np.nan, "steps": len(state.changes),
               **with_errors(run_s=seconds, setup_s=Measured(0.0))}
        return Outcome({"errors": errors, "runs": [row]})


# --- py-pde, in one call ------------------------------------------------------------------------------------


class Slow(Gas):
    """py-pde's gas in a slow vortex with temperature and density about 1: its run and its errors."""

    @property
    def known(self) -> float:
        """Uncertainty of the exact answer."""
        return KNOWN[self.scene.mach]

    @property
    def until(self) -> Time:
        return Time(self.scene.time, SAMPLES)

    def step_limit(self) -> float:
        """Largest stable step, by the formula of convection for twice the largest velocity."""
        eos, law = self.scene.eos, self.scene.law
        sound = float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0)))
        wave = (2*np.sqrt(2)*sound + 2*self.scene.speed)/self.h
        decay = 8*max(law.eta, law.k/eos.cv)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_SOUND))

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """v^2/2 per volume, as cheap as possible: samples are only there to read the clock."""
        return float((data[VX]**2 + data[VY]**2).mean()/2), np.nan, 1.0

    def nusselt(self, data: np.ndarray) -> tuple[float, float]:
        """nan: no heat is driven through the vortex."""
        return np.nan, np.nan

    def begun(self) -> np.ndarray:
        """The state (4, columns, rows) at the start, each field at its own points."""
        rho, u, v, T = (started(self.scene, *self.mesh(field))[field] for field in (RHO, VX, VY, E))
        return np.array([rho, u, v, energy(self.scene.eos, 1.0, T)])

    def exact(self) -> np.ndarray:
        """Exact velocities (n, 2) at the end, each component at its own points."""
        components = []
        for field, name in ((VX, "vx"), (VY, "vy")):
            x = np.stack(self.mesh(field), axis=-1).reshape(-1, 2)
            components.append(answer(self.scene, x)[name])
        return np.stack(components, axis=1)

    def result(self, end: pypde.PdeSolution) -> Result:
        """Errors of velocity and decay."""
        v, exact = end.state[[VX, VY]].reshape(2, -1).T, self.exact()
        one = np.ones(len(v))
        return Result({"velocity": relative(one, v - exact, exact), "decay": decay(self.scene, one, v)})


class Rolling(Gas):
    """py-pde's gas in convection from KHP95's rolls: its run and its K."""

    def __init__(self, flow: HeatedLayer, rows: int):
        super().__init__(flow.scene(rows), rows)
        self.flow, self.known = flow, flow.answer.known

    @property
    def until(self) -> Time:
        return Time(END*unit(self.scene), round(END*OFTEN))

    def begun(self) -> np.ndarray:
        """The state at the start."""
        return self.rolls(START_ENERGY)

    def result(self, end: pypde.PdeSolution) -> Result:
        """Errors of K at the end and of K(t)."""
        return self.flow.of_energy(Followed(end.series.t/unit(self.scene), end.series.ke, None))


def by_pypde(flow: Any, method: None, size: int, seed: int) -> Slow | Rolling:
    """py-pde's gas of a flow, in cells of unit spacing."""
    return Rolling(flow, size) if isinstance(flow, HeatedLayer) else Slow(flow.scene(size), size)


class SolverRace(Race):
    """One call of py-pde, whose gas `make` gives.

    The step is the limit by its own formula; an eighth longer, and a run in the vortex ends early. Compiling
    is not counted, nor what py-pde does around the steps.
    """

    def run(self, report: Report, folder: Path) -> Outcome:
        gas, at = self.made(), list[float]()
        end = pypde.solve(gas, until=gas.until, start=gas.begun(), dt=gas.step_limit(),
                          progress=lambda done: at.append(process_time()))
        set_up = of_calls(lambda: self.made().begun())
        seconds = with_errors(run_s=median(np.diff(at))*gas.until.samples, setup_s=set_up)
        row = {**self.columns, "points": gas.grid.num_cells, "of_limit": 1.0, "dt": np.nan,
               "steps": end.steps, **seconds}
        return Outcome({"errors": list(self.errors(gas.result(end), gas.known)), "runs": [row]})
