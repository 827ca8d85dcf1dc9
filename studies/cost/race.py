"""A method in a flow at a resolution, as a case: its longest step, its errors, its seconds; solvers, too."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import energy, sound_speed
from continuum.pypde import solve as pypde
from continuum.pypde.gas import Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import SpectralState, steady
from continuum.steady import RK4_DECAY, RK4_SOUND, Time
from particles.run import Divergence
from studies.build.answers import answer
from studies.build.grid import started
from studies.cost.contestants import ExactFlow, decay
from studies.cost.problem import Problem, Residuals, Result, Rung, best, climb, relative, rms
from studies.cost.seconds import SHORT, Laps, of_calls, per_step
from studies.cost.tables import with_err
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

SAMPLES = 5         # of the seconds of py-pde, those of as many equal parts of the run
TRIES = 1.4         # of what an entry says that a case takes: what trying longer steps does to it
LONGER = 10         # are the runs that time particles: they have to hold some lists
DIVERGED = Result({"diverged": np.array([np.nan])}, {"diverged": np.nan}, {"diverged": np.nan})


class Entry(NamedTuple):
    """A method in a flow, by the name that tables have.

    method : a record of `studies.build`. make(flow, method, resolution, seed) : its `Problem`. price : CPU
    seconds for a point and a step of its spacing. first : fraction of the limit that is tried first.
    """
    name: str
    flow: Any
    method: Any
    make: Callable[[Any, Any, int, int], Any]
    price: float
    first: float = 0.9


@dataclass(frozen=True, kw_only=True)
class Race(Case):
    """One method in one flow at one resolution."""
    scene: str
    entry: Entry
    resolution: int
    seed: int = 1
    short: float = SHORT
    alone: ClassVar[bool] = True

    @property
    def cost(self) -> float:
        scene = self.entry.flow.scene(self.resolution)
        return TRIES*(1 + self.entry.price*scene.width*scene.L*self.resolution)

    @property
    def label(self) -> str:
        return f"{self.scene}, {self.entry.name}, resolution {self.resolution}, seed {self.seed}"

    @property
    def columns(self) -> dict[str, Any]:
        """That every row has."""
        name = self.entry.name
        return {"scene": self.scene, "method": name, "resolution": self.resolution, "seed": self.seed}

    def run(self, report: Report, folder: Path) -> Outcome:
        problem = self.made()
        rungs = climb(problem, self.entry.first)
        report(0.7)
        rung = best(rungs)
        errors = self.errors(rung.result or DIVERGED, problem.known)
        rows = {"steps": list(self.steps(rungs)), "errors": list(errors)}
        if rung.result:
            rows["runs"] = [self.timing(problem, rung.fraction, rung.result)]
        return Outcome(rows)

    def made(self) -> Any:
        """What the entry makes."""
        return self.entry.make(self.entry.flow, self.entry.method, self.resolution, self.seed)

    def steps(self, rungs: list[Rung]) -> Iterator[dict[str, Any]]:
        """Rows of the table `steps`."""
        for rung in rungs:
            for name in rung.time or ("diverged",):
                time_error, space_error = (errors.get(name, np.nan) for errors in (rung.time, rung.space))
                yield {**self.columns, "quantity": name, "of_limit": rung.fraction, "time_error": time_error,
                       "space_error": space_error, "accepted": int(rung.accepted)}

    def errors(self, result: Result, known: float) -> Iterator[dict[str, Any]]:
        """Rows of the table `errors`."""
        for name, residual in result.residuals.items():
            err = float(np.hypot(known, result.uncertain.get(name, 0.0)))
            yield {**self.columns, "quantity": name, "error": rms(residual), "error_err": err,
                   "share": result.share.get(name, 1.0)}

    def timing(self, problem: Problem, fraction: float, result: Result) -> dict[str, Any]:
        """The row of the table `runs`."""
        steps, dt = problem.steps(fraction), problem.dt(fraction)
        seconds = self.a_step(problem, dt, result.state)*steps
        set_up = of_calls(lambda: self.made().held())
        return {**self.columns, "points": problem.points, "of_limit": fraction, "dt": dt, "steps": steps,
                **with_err(run_s=seconds, setup_s=set_up)}

    def a_step(self, problem: Problem, dt: float, end: Any) -> Measured:
        """Seconds; of particles in the disorder of the end, when their lists are made more often."""
        start, short = problem.start, self.short
        if problem.chaotic:
            start, short = end, LONGER*self.short
        safe = min(dt, self.entry.first*problem.limit)      # in more steps than the run has

        def seconds(dt: float) -> Measured:
            return per_step(lambda steps: problem.advance(start, dt, steps), short)
        try:
            return seconds(dt if problem.chaotic else safe)
        except Divergence:
            return seconds(safe)


# --- the spectral method: what n functions along an axis give, against more of them ----------------------

FIRST = 8           # functions, from whose state that of others starts
#: most functions -> those of their exact answer; four fewer tell its uncertainty
FINER = {12: 20, 24: 32}


@cache
def solved(ra: float, n: int) -> SpectralState:
    """The steady gas, from warm streams, once in a process."""
    laws = GasLaws(RayleighBenard(ra=ra))
    few = steady(laws, min(n, FIRST))
    return steady(laws, n, few) if n > FIRST else few


def apart(state: SpectralState, exact: SpectralState) -> Residuals:
    """K and velocity of two states, at the points of the finer one; as in `rolls`."""
    finer, n = exact.equations, state.equations.n
    every = np.zeros((4, finer.n, finer.n))
    every[:, :n, :n] = state.equations.amplitudes(state.q)
    v, exact_v = (np.reshape(finer.at(q)[:2, 0], (2, -1)).T for q in (every[finer.kept], exact.q))
    velocity = relative(finer.weights.ravel(), v - exact_v, exact_v)
    return {"K": np.array([state.K/exact.K - 1]), "velocity": velocity}


@dataclass(frozen=True, kw_only=True)
class SpectralRace(Race):
    """All of the way to a steady state, without steps in time; the resolution is functions along an axis."""

    @property
    def cost(self) -> float:
        return 3 + 5e-8*self.resolution**6      # three for the exact answer, once in a process

    def run(self, report: Report, folder: Path) -> Outcome:
        ra, n = self.entry.flow.ra, self.resolution
        state, more = solved(ra, n), next(finer for most, finer in FINER.items() if n <= most)
        exact, fewer = solved(ra, more), solved(ra, more - 4)
        uncertain = {name: rms(residual) for name, residual in apart(fewer, exact).items()}
        errors = list(self.errors(Result(apart(state, exact), uncertain), 0.0))
        report(0.5)
        seconds = of_calls(partial(solved.__wrapped__, ra, n))
        row = {**self.columns, "points": n**2, "of_limit": 1.0, "dt": np.nan, "steps": len(state.changes),
               **with_err(run_s=seconds, setup_s=Measured(0.0))}
        return Outcome({"errors": errors, "runs": [row]})


# --- py-pde, in one call ------------------------------------------------------------------------------------


class Slow(Gas):
    """The gas of a slow vortex at a temperature and density about 1."""

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
        rho, u, v, T = (started(self.scene, *self.mesh(field))[field] for field in (RHO, VX, VY, E))
        return np.array([rho, u, v, energy(self.scene.eos, 1.0, T)])

    def exact(self) -> np.ndarray:
        """Velocities (n, 2) at the end, each component where it is."""
        components = []
        for field, name in ((VX, "vx"), (VY, "vy")):
            x = np.stack(self.mesh(field), axis=-1).reshape(-1, 2)
            components.append(answer(self.scene, x)[name])
        return np.stack(components, axis=1)


def by_pypde(flow: ExactFlow, method: None, size: int, seed: int) -> Slow:
    """Cells of one spacing."""
    return Slow(flow.scene(size), size)


@dataclass(frozen=True, kw_only=True)
class SolverRace(Race):
    """The solver, called once; what the entry makes is its gas.

    Steps are at the limit of its own formula, an eighth longer than which ends in the vortex; compiling is
    not counted, nor what py-pde does around the steps.
    """

    def run(self, report: Report, folder: Path) -> Outcome:
        gas, laps = self.made(), Laps()
        until = Time(gas.scene.time, SAMPLES)
        end = pypde.solve(gas, until=until, start=gas.begun(), dt=gas.step_limit(), progress=laps)
        v, exact = end.state[[VX, VY]].reshape(2, -1).T, gas.exact()
        one = np.ones(len(v))
        result = Result({"velocity": relative(one, v - exact, exact), "decay": decay(gas.scene, one, v)})
        seconds = with_err(run_s=laps.total(SAMPLES), setup_s=of_calls(lambda: self.made().begun()))
        row = {**self.columns, "points": len(v), "of_limit": 1.0, "dt": np.nan, "steps": end.steps, **seconds}
        errors = self.errors(result, self.entry.flow.known)
        return Outcome({"errors": list(errors), "runs": [row]})
