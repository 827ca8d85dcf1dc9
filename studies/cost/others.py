"""Solvers of convection without the particles' time loop: Newton's methods, the MAC grid in time, py-pde."""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.boussinesq import HALF_LAYER, LAYER, Case, State, khp95, steady, transient
from continuum.boussinesq.mac import mac
from continuum.boussinesq.projection import CFL_LIMIT, Projection
from continuum.gas.fields import Fields
from continuum.gas.newton import Discrete
from continuum.gas.newton import steady as newton
from continuum.pypde import solve as pypde
from continuum.scene import RayleighBenard
from continuum.steady import Time
from studies.build.names import START_ENERGY
from studies.cost import names
from studies.cost.layer_runs import (
    EARLY,
    END,
    OFTEN,
    RA,
    SIZES,
    Followed,
    Reference,
    Seen,
    compared,
    extrapolated,
    problem_of,
    reference,
    residuals_of,
    scene_of,
    shares_of,
)
from studies.cost.problem import Problem, Race, Residuals, rms
from studies.cost.timing import Laps, Timed, array_bytes, of_calls
from studies.kit.case import Outcome, Report
from studies.kit.timing import compile_and_run_seconds

PR = 2.0            # of the Boussinesq fluid that is nearest to the gas
FALLS = (24, 32, 48)                    # rows of K(t) of the Boussinesq fluid


@cache
def boussinesq_reference(sizes: tuple[int, int, int] = SIZES, falls: tuple[int, int, int] = FALLS) -> Reference:
    """The Boussinesq fluid's own limits; without fields."""
    ke = [steady(Case(ra=RA, pr=PR, box=HALF_LAYER, rows=rows)).K for rows in sizes]
    times, curves = np.arange(round(EARLY*OFTEN) + 1)/OFTEN, []
    for rows in falls:
        case = Case(ra=RA, pr=PR, box=LAYER, rows=rows)
        found = transient(case, khp95(case, START_ENERGY), until=EARLY, dt=CFL_LIMIT/2/rows, within=0.0)
        curves.append(CubicSpline(found.t, found.K)(times))
    (before, last), (early, curve) = ([extrapolated(q[n], q[n + 1], s[n:n + 2]) for n in (0, 1)]
                                      for q, s in ((ke, sizes), (curves, falls)))
    off = float(np.sqrt(np.mean((curve - early)**2)/np.mean(curve**2)))
    return Reference(last, abs(last - before)/last, (), CubicSpline(times, curve), off)


class OnMac(NamedTuple):
    """The MAC grid in time, IMEX; the limit is that of advection with the free-fall velocity."""
    name: str = names.MAC_IMEX
    first: float = 0.9
    sizes: tuple[int, int, int] = SIZES
    falls: tuple[int, int, int] = FALLS

    def seconds(self, rows: int) -> float:
        return 0.5 + 1.5e-4*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        mac.cache_clear()       # what set-up takes is to be seen each time
        case = Case(ra=RA, pr=PR, box=LAYER, rows=rows)
        first = khp95(case, START_ENERGY).q
        made = Projection(case, first)

        def follow(q: np.ndarray, dt: float, steps: int) -> Followed:
            flow, every = Projection(case, q), max(1, round(1/OFTEN/dt))
            t, ke = [0.0], [START_ENERGY]
            for number in range(1, steps + 1):
                flow.advance(dt)
                if number % every == 0 or number == steps:
                    t.append(number*dt)
                    ke.append(State(case=case, q=flow.q).K)
                    if not np.isfinite(ke[-1]):
                        raise FloatingPointError(f"K is {ke[-1]} after {number} steps of {dt:.3g}")
            return Followed(np.array(t), np.array(ke), flow.q)

        def step(q: np.ndarray, dt: float, steps: int) -> None:
            flow = Projection(case, q)
            for _ in range(steps):
                flow.advance(dt)
        return problem_of(case.rows*case.columns, first, CFL_LIMIT/rows, follow, step, lambda: (made,), None, unit=1.0,
                          found=boussinesq_reference(self.sizes, self.falls))


# --- solvers that choose their own steps ------------------------------------------------------------------------------


class Solved(NamedTuple):
    """Residuals, shares of the seconds by quantity, points, steps, bytes; seconds and compiling where the solver told them."""
    residuals: Residuals
    share: dict[str, float]
    points: int
    steps: int
    bytes: int
    known: float
    seconds: Timed | None = None
    compile_s: float = 0.0
    setup: Timed = Timed(0.0, 0.0, 0.0, 0.0)
    of_limit: float = np.nan


@dataclass(frozen=True, kw_only=True)
class Direct(Race):
    """A solver that is called once: its whole call is timed, unless it tells its own seconds."""

    def run(self, report: Report, folder: Path) -> Outcome:
        solve = partial(self.method.solve, self.resolution)
        found, compile_s, _ = compile_and_run_seconds(solve)
        report(0.2)
        errors = [{**self.key_columns, "quantity": name, "error": rms(off), "error_err": found.known,
                   "share": found.share.get(name, 1.0)} for name, off in found.residuals.items()]
        return Outcome({"errors": errors, **self.timings(found.seconds or of_calls(solve), {
            "points": found.points, "of_limit": found.of_limit, "dt": np.nan, "steps": found.steps, "setup_s": found.setup.value,
            "setup_s_err": found.setup.err, "compile_s": found.compile_s or compile_s, "bytes": found.bytes, "threads": 1})})


class OnNewton(NamedTuple):
    """The compressible grid's steady state by Newton's method."""
    name: str = names.NEWTON
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 1 + 5e-3*rows**2

    def solve(self, rows: int) -> Solved:
        scene, known = scene_of(rows), reference(self.sizes)
        state = newton(scene, rows)
        off = {"K": np.array([state.ke/known.ke - 1]), **compared(seen(scene, state.fields), known)}
        return Solved(off, {}, rows*round(scene.width), len(state.changes), array_bytes(Discrete(scene, rows)), known.known)


def seen(scene: RayleighBenard, fields: Fields) -> Seen:
    """All nodes but those on the right side, which are those on the left."""
    X, Y = (q[:, :-1].ravel()/scene.L for q in np.meshgrid(fields.x, fields.y))
    vx, vy, T = (getattr(fields.at, name)[:, :-1] for name in ("vx", "vy", "T"))
    V = np.ones_like(T)
    V[[0, -1]] = 0.5
    return Seen(np.stack([X, Y], axis=1), np.stack([vx.ravel(), vy.ravel()], axis=1), T.ravel(), V.ravel())


class OnMacNewton(NamedTuple):
    """The Boussinesq steady state by Newton's method, from the roll of the three-mode model."""
    name: str = names.MAC_NEWTON
    sizes: tuple[int, int, int] = SIZES
    falls: tuple[int, int, int] = FALLS

    def seconds(self, rows: int) -> float:
        return 0.1 + 4e-4*rows**2

    def solve(self, rows: int) -> Solved:
        mac.cache_clear()
        known, case = boussinesq_reference(self.sizes, self.falls), Case(ra=RA, pr=PR, box=HALF_LAYER, rows=rows)
        state = steady(case)
        return Solved({"K": np.array([state.K/known.ke - 1])}, {}, case.rows*case.columns, len(state.residuals),
                      array_bytes(case.mac), known.known)


class OnPypde(NamedTuple):
    """py-pde, compiled at each call: the gas, or Boussinesq where `gas` is False, at the driver's own step (0.8 of the limit)."""
    name: str
    gas: bool
    sizes: tuple[int, int, int] = SIZES
    falls: tuple[int, int, int] = FALLS

    def seconds(self, rows: int) -> float:
        return 4 + 2e-4*rows**3

    def solve(self, rows: int) -> Solved:
        known = reference(self.sizes) if self.gas else boussinesq_reference(self.sizes, self.falls)
        laps, scene = Laps(), scene_of(rows)
        unit, samples = (scene.L/scene.free_fall if self.gas else 1.0), round(END*OFTEN)
        options: dict[str, Any] = {"until": Time(END*unit, samples), "start": pypde.Rolls(START_ENERGY), "progress": laps}
        done = pypde.solve_gas(scene, rows, **options) if self.gas else pypde.solve_boussinesq(ra=RA, pr=PR, rows=rows, **options)
        followed = Followed(done.series.t/unit, done.series.ke, done)
        off = residuals_of(followed, self._see(scene) if self.gas else None, None, 1.0, known)
        if not self.gas:
            off.pop("K(t)")     # its rolls at the start are not KHP95's, which are not free of divergence
        share = shares_of(followed, {name: max(known.known, rms(q)) for name, q in off.items()}, None)
        return Solved(off, share, done.state[0].size, done.steps, array_bytes(done.state, done.equation), known.known,
                      laps.total(samples), done.compile_s)

    def _see(self, scene: RayleighBenard) -> Callable[[Any], Seen]:
        def see(done: pypde.Solution) -> Seen:
            at = done.fields
            x, y, vx, vy, T = (at[name].ravel() for name in ("x", "y", "v_x", "v_y", "T"))
            return Seen(np.stack([x, y], axis=1)/scene.L, np.stack([vx, vy], axis=1), T, np.ones_like(T))
        return see
