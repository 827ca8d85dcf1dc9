"""Transients of the discrete equations by a projection method with fast solves."""
from typing import NamedTuple

import numpy as np

from continuum.boussinesq.flow import BOTTOM, TOP, BoussinesqCase, Equations, State, enters
from continuum.boussinesq.poisson import solvers

CFL = 0.4           # of a step that is not given
CFL_LIMIT = 0.8     # of two-step explicit advection with some viscosity
LONGEST = 0.05      # step in free-fall times where the flow is too slow to set one
RECORD = 10         # steps from one record to the next


class Unstable(RuntimeError):
    """A transient left what its step can carry."""


class Projection(Equations):
    """Buoyancy and advection extrapolated, diffusion by the trapezoidal rule, pressure by projection. Second
    order in time. Everything is in increments of q and p: in a steady state nothing is left of splitting."""

    def __init__(self, case: BoussinesqCase, q: np.ndarray):
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
    """A transient: K and plate Nusselt numbers at times t, and the last state."""
    t: np.ndarray
    K: np.ndarray
    nu_bottom: np.ndarray
    nu_top: np.ndarray
    state: State


def transient(case: BoussinesqCase, start: State, *, until: float | None = None,
              dt: float | None = None) -> Transient:
    """Follow the flow for `until` free-fall times, 20 H^2/kappa if not given. Without dt steps keep CFL."""
    until = until or 20/case.kappa
    for name, value in (("until", until), ("dt", 1.0 if dt is None else dt)):
        if not 0 < value < np.inf:
            raise ValueError(f"{name} must be positive and finite, got {value}: it is in free-fall times")
    flow, t = Projection(case, start.on(case).q), 0.0
    rows = [record(flow, t)]
    while t < until*(1 - 1e-12):
        step = length(flow, t, dt)
        steps = min(RECORD, int(np.ceil((until - t)/step - 1e-9)))
        step = min(step, (until - t)/steps)
        for _ in range(steps):
            flow.advance(step)
        t += steps*step
        rows.append(record(flow, t))
    times, K, bottom, top = np.array(rows).T
    return Transient(times, K, bottom, top, State(case=case, q=flow.q, t=t))


def length(flow: Projection, t: float, dt: float | None) -> float:
    """The next step: dt if given and stable, else what CFL allows."""
    rate = flow.courant()
    if not np.isfinite(rate):
        raise Unstable(f"velocity is not finite at t = {t:.6g}: start from slower flow or take a smaller dt")
    if dt and dt*rate > CFL_LIMIT:
        raise Unstable(f"CFL number is {dt*rate:.2f} at t = {t:.6g} with dt = {dt}, above {CFL_LIMIT}: take "
                       f"dt below {CFL_LIMIT/rate:.2g}, or leave it out")
    return dt or min(LONGEST, CFL/max(rate, CFL/LONGEST))


def record(flow: Projection, t: float) -> tuple[float, float, float, float]:
    """(t, K, Nu at the bottom, Nu at the top)."""
    state = State(case=flow.case, q=flow.q, t=t)
    bottom, top = (enters(flow.mac, state.parts[2], *wall).gradient for wall in (BOTTOM, TOP))
    return t, state.K, bottom, -top
