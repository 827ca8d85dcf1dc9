"""Convection from KHP95's rolls: references, the share of a run that is needed, and the methods.

    K, velocity, temperature    of the steady state, against the compressible grid's by Newton's method
    K(t)                        over the first 30 free-fall times, against the compressible grid in time

Both references are extrapolated. A steady state is reached once K, averaged over a free-fall time, stays as
near to its final value as the quantity's own error; a flow that fluctuates is averaged from there on, until
the statistical error is as small.
"""
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from continuum.gas.fields import NodeFields, Values, initial, interpolate, kinetic_energy
from continuum.gas.newton import steady as newton
from continuum.gas.solve import run as run_grid
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.fields import Fields
from particles.plan import Plan
from particles.run import run
from studies.build.measure import Smoothing, smoothed_energy
from studies.build.names import START_ENERGY
from studies.build.setting import Ready, Unguarded
from studies.cost.contestants import smoothed, with_triangles
from studies.cost.problem import NONE, Judge, Problem, Residuals, Result, of_grid, of_method, relative, rms
from studies.kit.stats import Measured, settled

RA, LOWER_RA = 1e4, 5000.0
END, EARLY, LATE = 90.0, 30.0, 40.0     # free-fall times: ends of runs and of K(t), start of averages
SETTLED = 60.0      # start of averages where 1 % counts: K of the grid is off by 1 % at 47, 0.2 % at 60
OFTEN = 4           # samples per free-fall time
TIMES = np.arange(1, round(EARLY*OFTEN))/OFTEN      # free-fall times at which K(t) is compared
MIDDLE = 1/8        # of the height above and below the middle: there the position of rolls is measured
NEAR, EXACT = 0.1, 1e-7     # heights: range of the search around this position, and its accuracy
#: end of runs whose K has an error of about 1 %: the mean from 60 to 90 is uncertain by 0.5 %, while nine
#: seeds scatter by 0.08 %; from 60 to 210 these are 0.1 and 0.03 % (fixed after a look)
LONG = 210.0


#: state -> fields
See = Callable[[np.ndarray], Any]


class Reference(NamedTuple):
    """K of the steady state and its uncertainty, its fields on two grids, K at TIMES and its uncertainty."""
    ke: float
    known: float
    fields: tuple[NodeFields, ...]
    history: np.ndarray
    history_known: float


@cache
def reference(rows: tuple[int, int, int], ra: float) -> Reference:
    """Limits of the two finer of three grids; the limit of the two coarser ones gives their uncertainty."""
    scene = RayleighBenard(ra=ra)
    until = Time(EARLY*unit(scene), round(EARLY*OFTEN))
    states = [newton(scene, n) for n in rows]
    runs = [run_grid(scene, n, until=until, start=initial(scene, n, START_ENERGY)) for n in rows]
    K, curves = [state.ke for state in states], [one.series.ke for one in runs]
    coarser, ke = extrapolated(K[:2], rows[:2]), extrapolated(K[1:], rows[1:])
    early, curve = extrapolated(curves[:2], rows[:2]), extrapolated(curves[1:], rows[1:])
    return Reference(ke, abs(ke - coarser)/ke, tuple(state.fields for state in states[1:]), curve[1:-1],
                     rms(curve - early)/rms(curve))


def extrapolated(values: Sequence[Any], rows: Sequence[int]) -> Any:
    """Limit of values on a coarse and a fine grid, with errors of second order."""
    (coarse, fine), (a, b) = values, rows
    return fine + (fine - coarse)*a**2/(b**2 - a**2)


# --- a run --------------------------------------------------------------------------------------------------


class Followed(NamedTuple):
    """A run: times in free falls, K at these times, the state at the end."""
    t: np.ndarray
    ke: np.ndarray
    state: Any


class HeatedLayer(NamedTuple):
    """The flow. late : start of averages, if a method fluctuates. rows : of the reference grids."""
    ra: float = RA
    late: float = 0.0
    rows: tuple[int, int, int] = (32, 48, 64)
    end: float = END

    @property
    def answer(self) -> Reference:
        return reference(self.rows, self.ra)

    def scene(self, rows: int) -> RayleighBenard:
        """The layer with unit spacing."""
        return RayleighBenard(ra=self.ra, L=float(rows))

    def judge(self, scene: RayleighBenard, see: See, factor: float = 1.0) -> Judge:
        """Judge of all quantities; see(state) gives the fields at the end. factor : of smoothing on K."""
        def judge(done: Followed) -> Result:
            at = see(done.state)
            others = compared(at._replace(x=at.x/scene.L), self.answer.fields)
            return self.of_energy(done, factor, others)
        return judge

    def of_energy(self, done: Followed, factor: float = 1.0, others: Mapping[str, Any] = NONE) -> Result:
        """Errors of K and K(t), along with those of other quantities."""
        answer = self.answer
        last = self.last(done)*(1/factor/answer.ke)
        early = CubicSpline(done.t, done.ke/factor)(TIMES)
        history = (early - answer.history)/rms(answer.history)
        residuals = {"K": np.array([last.value - 1]), "K(t)": history, **others}
        uncertain = {"K": last.err, "K(t)": answer.history_known}
        return Result(residuals, uncertain, self.share(done, residuals))

    def last(self, done: Followed) -> Measured:
        """K at the end; the mean from `late` on, if a method fluctuates."""
        if not self.late:
            return Measured(float(done.ke[-1]))
        since = self.late/self.end*done.t[-1]
        mean, _ = settled(done.ke[done.t > since])
        return mean

    def share(self, done: Followed, residuals: Residuals) -> dict[str, float]:
        """Share of the run that each quantity needs, by the rule at the head of this file."""
        errors = {name: max(self.answer.known, rms(residual)) for name, residual in residuals.items()}
        times = {name: self.needed(done, error) for name, error in errors.items()} | {"K(t)": EARLY}
        return {name: float(min(1.0, time/done.t[-1])) for name, time in times.items()}

    def needed(self, done: Followed, error: float) -> float:
        """Free-fall times until the steady state is reached and averaged to this error."""
        last = self.last(done)
        window = np.full(OFTEN, 1/OFTEN)
        means = np.convolve(done.ke/last.value - 1, window, "valid")
        far = np.flatnonzero(np.abs(means) > error)
        near = min(far.max(initial=-1) + 1, len(means) - 1)
        noise = last.err/last.value/error
        averaged = (self.end - self.late)*min(1.0, noise**2)
        return float(done.t[near + OFTEN - 1] + averaged)


def compared(at: Fields, answer: tuple[NodeFields, ...]) -> Residuals:
    """Errors of velocity and temperature, the latter over the rms of T - 1.

    Rolls may lie anywhere: the answer is shifted to where velocities differ least, near the position given by
    the phase of v_y in the middle. This phase, a sum over irregular points, would add a third to the error.
    """
    def errors(shift: float) -> Residuals:
        exact = extended(answer, at.x + np.array([shift, 0.0]))
        v = np.stack([exact.vx, exact.vy], axis=1)
        return {"velocity": relative(at.V, at.v - v, v),
                "temperature": relative(at.V, at.T - exact.T, exact.T - 1)}
    first = phase(at)
    best = minimize_scalar(lambda shift: rms(errors(shift)["velocity"]), method="bounded",
                           bounds=(first - NEAR, first + NEAR), options={"xatol": EXACT})
    return errors(float(best.x))


def extended(answer: tuple[NodeFields, ...], x: np.ndarray) -> Values:
    """Fields extrapolated from those on two grids, at places (n, 2) in heights."""
    values = [np.array(interpolate(fields, *fields.scene.L*x.T)) for fields in answer]
    return Values(*extrapolated(values, [len(fields.y) - 1 for fields in answer]))


def phase(at: Fields) -> float:
    """Shift in heights to where rolls lie about as at the start, rising in the middle: the phase of v_y."""
    x, y = at.x.T
    near = np.abs(y) < MIDDLE
    wave = at.V*at.v[:, 1]*np.exp(-1j*np.pi*x)
    return float(np.angle(wave[near].sum())/np.pi)


# --- methods ------------------------------------------------------------------------------------------------


def on_points(flow: HeatedLayer, method: Any, rows: int, seed: int) -> Problem:
    """Problem of points that stay."""
    scene = flow.scene(rows)
    ready = method.ready(scene, seed)
    return in_time(flow, scene, ready, method.series["ke"], ready.method.fields)


def on_moving(flow: HeatedLayer, method: Any, rows: int, seed: int) -> Problem:
    """Problem of points that move."""
    return on_points(flow._replace(late=SETTLED), method, rows, seed)


def on_triangles(flow: HeatedLayer, method: Any, rows: int, seed: int) -> Problem:
    """Problem of points that move with their triangulation."""
    return with_triangles(on_moving(flow, method, rows, seed))


def on_triangles_long(flow: HeatedLayer, method: Any, rows: int, seed: int) -> Problem:
    """As `on_triangles`, averaged five times as long."""
    return on_triangles(flow._replace(end=LONG), method, rows, seed)


def of_particles(flow: HeatedLayer, method: Any, rows: int, seed: int) -> Problem:
    """Problem of smooth particles; K of the smoothed field against that of the grid's, smoothed alike."""
    scene = flow.scene(rows)
    ready = method.ready(scene, seed)
    plain, smooth = smoothed_energy(flow.answer.fields[1], Smoothing(method.weight, method.h, rows))
    see = partial(smoothed, ready.method)
    problem = in_time(flow._replace(late=LATE), scene, ready, method.series["kg"], see, smooth/plain)
    return problem._replace(firm=True)


def in_time(flow: HeatedLayer, scene: RayleighBenard, ready: Ready, energy: Callable, see: See,
            factor: float = 1.0) -> Problem:
    """Problem of a method of the particles' time loop, with K recorded."""
    def go(state: np.ndarray, dt: float, steps: int) -> Followed:
        plan = Plan(dt=dt, steps=steps, series={"ke": energy}, every=every(scene, dt))
        done = run(Unguarded(ready.method), state, plan)
        return from_rolls(scene, done.times, done.series["ke"], done.by_id())
    problem = of_method(ready.method, ready.start, flow.end*unit(scene), flow.judge(scene, see, factor),
                        known=flow.answer.known, chaotic=bool(flow.late))
    return problem._replace(go=go, timed=problem.go)


def on_grid(flow: HeatedLayer, form: Any, rows: int, seed: int) -> Problem:
    """Problem of the compressible grid in time, with K recorded."""
    scene = flow.scene(rows)
    ready = form.ready(scene)

    def go(S: np.ndarray, dt: float, steps: int) -> Followed:
        march, often = ready.method.march(S, dt), every(scene, dt)
        t, ke = list[float](), list[float]()
        while march.steps < steps:
            march.go(min(often, steps - march.steps))
            t.append(march.t)
            ke.append(kinetic_energy(march.S))
        return from_rolls(scene, t, ke, march.S)
    judge = flow.judge(scene, ready.method.fields)
    problem = of_grid(ready, END*unit(scene), judge, known=flow.answer.known)
    return problem._replace(go=go, timed=problem.go)


def unit(scene: RayleighBenard) -> float:
    """The unit of time: that of free fall over the height."""
    return scene.L/scene.free_fall


def every(scene: RayleighBenard, dt: float) -> int:
    """Number of steps between samples."""
    return max(1, round(unit(scene)/OFTEN/dt))


def from_rolls(scene: RayleighBenard, times: Sequence[float], ke: Sequence[float], state: Any) -> Followed:
    """A run from its samples, preceded by the start."""
    t = np.array([0.0, *times])/unit(scene)
    return Followed(t, np.array([START_ENERGY, *ke]), state)
