"""Transients of the discrete equations by a projection method with fast solves."""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.boussinesq.flow import BOTTOM, STILL, TOP, Case, Equations, State, enters
from continuum.boussinesq.poisson import solvers

CFL_LIMIT = 0.8     # of two-step explicit advection with some viscosity
LONGEST = 0.05      # step in free-fall times where the flow is too slow to set one
RECORD = 10         # steps from one record to the next


class Unstable(RuntimeError):
    """A transient left what its step can carry."""


class Projection(Equations):
    """Buoyancy and advection extrapolated, diffusion by the trapezoidal rule, pressure by projection. Second
    order in time. Everything is in increments of q and p: in a steady state nothing is left of splitting."""

    def __init__(self, case: Case, q: np.ndarray):
        super().__init__(case)
        self.solve, self.flow = solvers(self.mac), self.mac.ends[1]
        self.thin = case.nu, case.nu, case.kappa
        self.q = q.copy()
        self.project(1.0)
        self.driven, self.dt_before = self.drive(self.q), np.inf
        push = self.mac.div@(self.diffuse(self.q) + self.driven)[:self.flow]
        self.p = self.solve[3](push.reshape(self.mac.shapes[2]), 0.0, 1.0)

    def advance(self, dt: float) -> None:
        """One step of length dt; the very first is explicit Euler in what drives."""
        drive = self.drive(self.q)
        rate = self.diffuse(self.q) + drive + dt/self.dt_before/2*(drive - self.driven)
        rate[:self.flow] -= self.mac.grad@self.p.ravel()
        for part, solve, thin in zip(self.mac.split(rate), self.solve, self.thin):
            part[...] = solve(part, 1.0, -dt/2*thin)
        self.q += dt*rate
        phi, div = self.project(dt)
        self.p += phi - self.case.nu/2*div
        self.driven, self.dt_before = drive, dt

    def project(self, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Free the velocity of divergence; returns the pressure that does it over dt, and the divergence."""
        div = (self.mac.div@self.q[:self.flow]).reshape(self.mac.shapes[2])
        phi = self.solve[3](div/dt, 0.0, 1.0)
        self.q[:self.flow] -= dt*(self.mac.grad@phi.ravel())
        return phi, div

    def courant(self) -> float:
        """Largest |u|/dx + |v|/dy in a cell: CFL number over dt."""
        x, y = self.mac.x, self.mac.y
        u, v, _ = self.mac.split(np.abs(self.q))
        return float(np.max(x.back@u/x.h + v@y.mean/y.h))


class Transient(NamedTuple):
    """A transient: K and plate Nusselt numbers at times t, the last state, whether K had settled."""
    t: np.ndarray
    K: np.ndarray
    nu_bottom: np.ndarray
    nu_top: np.ndarray
    state: State
    settled: bool
    left: float         # estimated change of K still to come, over K; inf if unknown

    def growth(self, after: float, before: float = np.inf) -> float:
        """Growth rate of the velocity between two times: half the slope of ln K."""
        window = (self.t >= after) & (self.t <= before)
        if window.sum() < 3:
            raise ValueError(f"{window.sum()} records from t = {after} to {before}: a slope needs 3, and the "
                             f"run has t = {self.t[0]} to {self.t[-1]}")
        return float(np.polyfit(self.t[window], np.log(self.K[window]), 1)[0]/2)


def transient(case: Case, start: State, *, until: float | None = None, dt: float | None = None,
              cfl: float = 0.4, within: float = 1e-6, block: float | None = None,
              progress: Callable[[float], None] | None = None) -> Transient:
    """Follow the flow from start until K has settled `within` (relative), or for `until` free-fall times.

    K is compared over blocks of time, if not given H^2/(20 kappa) but at least 2; `until` is 20 H^2/kappa if
    not given. Without dt, steps keep the CFL number at cfl. `within = 0` never settles.
    """
    until, block = until or 20/case.kappa, block or max(0.05/case.kappa, 2.0)
    check_times(until, block, dt, cfl)
    flow, t, left, due = Projection(case, start.on(case).q), 0.0, np.inf, 3.5*block
    rows = [record(flow, t)]
    while t < until*(1 - 1e-12) and not left < within:
        step = length(flow, t, dt, cfl)
        steps = min(RECORD, int(np.ceil((until - t)/step - 1e-9)))
        step = min(step, (until - t)/steps)
        for _ in range(steps):
            flow.advance(step)
        t += steps*step
        rows.append(record(flow, t))
        if t >= due:
            left, due = change_left(np.array(rows)[:, :2], block), due + block
        if progress:
            progress(min(1.0, t/until))
    times, K, bottom, top = np.array(rows).T
    return Transient(t=times, K=K, nu_bottom=bottom, nu_top=top, state=State(case=case, q=flow.q, t=t),
                  settled=left < within, left=left)


def check_times(until: float, block: float, dt: float | None, cfl: float) -> None:
    """Refuse what cannot be run."""
    for name, value in (("until", until), ("block", block), ("dt", 1.0 if dt is None else dt)):
        if not 0 < value < np.inf:
            raise ValueError(f"{name} must be positive and finite, got {value}: it is in free-fall times")
    if block < RECORD*(dt or LONGEST):
        raise ValueError(f"block is {block}, shorter than {RECORD} steps of {dt or LONGEST}: K is recorded "
                         "so often")
    if not 0 < cfl <= CFL_LIMIT:
        raise ValueError(f"cfl is {cfl}, outside 0 ... {CFL_LIMIT}: advection is unstable above; take 0.4")


def length(flow: Projection, t: float, dt: float | None, cfl: float) -> float:
    """The next step: dt if given and stable, else what cfl allows."""
    rate = flow.courant()
    if not np.isfinite(rate):
        raise Unstable(f"velocity is not finite at t = {t:.6g}: take a smaller {'dt' if dt else 'cfl'}")
    if dt and dt*rate > CFL_LIMIT:
        raise Unstable(f"CFL number is {dt*rate:.2f} at t = {t:.6g} with dt = {dt}, above {CFL_LIMIT}: take "
                       f"dt below {CFL_LIMIT/rate:.2g}, or leave it out")
    return dt or min(LONGEST, cfl/max(rate, cfl/LONGEST))


def record(flow: Projection, t: float) -> tuple[float, float, float, float]:
    """(t, K, Nu at the bottom, Nu at the top)."""
    state = State(case=flow.case, q=flow.q, t=t)
    bottom, top = (enters(flow.mac, state.parts[2], *wall).gradient for wall in (BOTTOM, TOP))
    return t, state.K, bottom, -top


def change_left(history: np.ndarray, block: float) -> float:
    """Change of K still to come over K, from rows (t, K) of the last three blocks.

    The two changes between blocks count as terms of a geometric series; while they do not shrink it is inf.
    Near onset their ratio is nearly 1, hence a spline: records do not come at the ends of blocks.
    """
    t, K = history[history[:, 0] > history[-1, 0] - 3.5*block].T
    sums = CubicSpline(t, K).antiderivative()(t[-1] - block*np.arange(3, -1, -1))
    first, second, third = np.diff(sums)/block
    if third < STILL and third < second < first:
        return 0.0
    before, change = abs(second - first), abs(third - second)
    if change >= before:
        return float(before/third) if before < 1e-13*third else np.inf
    return float(max(before, change**2/(before - change))/third)
