"""Solver of the compressible Navier-Stokes-Fourier equations on a regular grid    [KHP95, Sec. V]

    solution = run(RayleighBenard(ra=1e4), rows=32)
    solutions = steady_on(RayleighBenard(ra=1e4), (16, 24, 32, 48))

Second order in space, fourth in time, fixed step.
"""
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from continuum import fluid
from continuum.gas import fields as grid
from continuum.gas.fields import NodeFields, Nusselt
from continuum.gas.ghosts import FIELDS, RHO, VX, VY, E, FluxForm, box_of, in_loop
from continuum.gas.loop import advance
from continuum.steady import RK4_DECAY, RK4_SOUND, GridRun, Steady, of_samples, steps_between


class DivergedError(ArithmeticError):
    """The solution is no longer finite, or it left the range in which its equation of state is valid."""


@dataclass(frozen=True, kw_only=True)
class Solution(GridRun):
    """Result of a run; in a steady state the three numbers of `nusselt` agree to the error of the grid."""
    rows: int
    fields: NodeFields
    nusselt: Nusselt

    @property
    def nu(self) -> float:
        """Nusselt number: of the volume, of second order; between side walls the mean of both plates."""
        plates = (self.nusselt.bottom + self.nusselt.top)/2
        return self.nusselt.volume if self.fields.periodic else plates


def step_limit(scene, S: np.ndarray) -> float:
    """Largest stable time step, from the fastest wave and the largest diffusivity; compact differences have
    wave numbers up to 2/h."""
    h, rho, (vx, vy, e) = scene.L/(S.shape[1] - 2), grid.mean(S[RHO]), (S[f, 1:, 1:] for f in (VX, VY, E))
    spread = fluid.diffusivity(scene.eos, scene.law, rho, e)
    fast = 2*sound_of_grid(scene.eos, rho, e) + np.abs(vx) + np.abs(vy)
    with np.errstate(divide="ignore"):      # no diffusion, no limit
        sound, diffusion = RK4_SOUND*h/float(np.max(fast)), float(RK4_DECAY*h**2/(4*np.max(spread)))
    return float(1/(1/sound + 1/diffusion))


def sound_of_grid(eos, rho, e):
    """Largest omega h/2 of sound, omega^2 = (4/h^2) s (P_rho + (1 - s) P P_e/rho^2); 1 - s: e is averaged."""
    a, b = fluid.pressure_slopes(eos, rho, e)
    b = b*fluid.pressure(eos, rho, e)/rho**2
    inside = np.where(b > a, b, a)  # the maximum over 0 < s <= 1 lies inside if b > a, else at s = 1
    return (a + inside)/(2*np.sqrt(inside))


class March:
    """A block that is stepped in time."""

    def __init__(self, scene, S: np.ndarray, continuity, dt: float):
        rows, columns = S.shape[1] - 2, S.shape[2] - 2
        self.scene, self.S, self.dt, self.steps = scene, S, dt, 0
        self.laws = (in_loop(scene.sides), scene.eos, scene.law, continuity, box_of(scene, rows))
        self.scratch = (np.zeros((3, *S.shape)), np.zeros((2, 8, columns + 2)))
        start = time.process_time()
        self.advance(0)
        self.compile_s, self.start = time.process_time() - start, time.process_time()

    @property
    def t(self) -> float:
        return self.steps*self.dt

    def advance(self, steps: int) -> None:
        """Make steps without checking the result."""
        advance(*self.laws, self.S, *self.scratch, self.dt, steps)

    def go(self, steps: int) -> None:
        """Make steps; if the state becomes invalid, go back and step singly. Raises DivergedError: where."""
        before = self.S.copy()
        self.advance(steps)
        self.steps += steps
        if first_fault(self.scene, self.S):
            self.S[:], self.steps = before, self.steps - steps
            self._find()

    def _find(self) -> None:
        while not (fault := first_fault(self.scene, self.S)):
            self.advance(1)
            self.steps += 1
        raise DivergedError(f"diverged in step {self.steps} (t = {self.t:.6g}): {fault}; take more rows or "
                            f"dt below {self.dt:.4g}")


def first_fault(scene, S: np.ndarray) -> str:
    """Message on the first node whose state is not finite or not valid: its place and state; else empty."""
    with np.errstate(all="ignore"):
        valid = fluid.valid(scene.eos, grid.mean(S[RHO]), S[E, 1:, 1:])
        bad = ~(np.isfinite(S[:, 1:, 1:]).all(axis=0) & valid)
    if not bad.any():
        return ""
    j, i = np.argwhere(bad)[0]
    state, h = S[:, 1 + j, 1 + i], scene.L/(S.shape[1] - 2)
    finite = np.isfinite(state)
    field = "rho, e, T or c^2" if finite.all() else FIELDS[int(np.argmin(finite))]
    values = ", ".join(f"{name} = {value:.4g}" for name, value in zip(FIELDS, state))
    return (f"{field} is not valid at node ({j}, {i}), x = {i*h - scene.width/2:.4g}, y = "
            f"{j*h - scene.L/2:.4g}, where {values}")


def sample(scene, S: np.ndarray, t: float) -> tuple[float, float, float, float]:
    rho, e = grid.mean(S[RHO, :5]), S[E, 1:4, 1:]
    T = fluid.temperature(scene.eos, rho[:3], e)
    k = fluid.conductivity(scene.law, rho[:3], T)*np.ones_like(T)
    flux = grid.wall_flux(T, k, scene.L/(S.shape[1] - 2))
    return t, grid.kinetic_energy(S), flux/(scene.k*scene.dT*scene.aspect), float(np.mean(S[RHO, 1:-1, 1:-1]))


def run(scene, rows: int, *, until: Any = Steady(), start: NodeFields | None = None, dt: float | None = None,  # noqa: B008
        continuity: Any = FluxForm(), progress: Callable[[float], None] | None = None) -> Solution:  # noqa: B008
    """Solve a scene (RayleighBenard, or anything with its attributes) on `rows` rows of square cells.

    until : Steady(rtol=...) or Time(t_end). start : fields of any grid; KHP95's two rolls by default.
    dt : largest step (by default 0.8 of the stability limit); the one taken divides the time between samples.
    continuity : FluxForm() or PaperForm(). progress : called with the fraction done.
    Raises ValueError: rows below 8, dt above the limit, an invalid start. DivergedError: where.
    """
    fields = grid.initial(scene, rows) if start is None else grid.onto(scene, rows, start)
    fluid.check_state(scene.eos, fields.at.rho, fields.at.e)
    S = grid.block(fields)
    interval = until.interval(scene)
    count = steps_between(interval, step_limit(scene, S), dt)
    march = March(scene, S, continuity, interval/count)
    samples = [sample(scene, S, 0.0)]
    while not until.done([s[1] for s in samples]):
        march.go(count)
        samples.append(sample(scene, S, march.t))
        if progress:
            progress(until.fraction([s[1] for s in samples]))
    fields = grid.unblock(scene, S)
    return Solution(
        rows=rows, fields=fields, nusselt=grid.nusselt(fields), rolls=grid.count_rolls(fields), dt=march.dt,
        steps=march.steps, cpu_s=time.process_time() - march.start, compile_s=march.compile_s,
        **of_samples(until, samples))


def steady_on(scene, sizes: Sequence[int], *, start: NodeFields | None = None, **options) -> list[Solution]:
    """Steady solutions on a sequence of grids, each started from the one before."""
    solutions: list[Solution] = []
    for rows in sizes:
        solutions.append(run(scene, rows, start=start, **options))
        start = solutions[-1].fields
    return solutions
