"""Transients of the discrete equations by a projection method with fast solves."""
from typing import NamedTuple

import numpy as np

from continuum.boussinesq.flow import BoussinesqCase, Equations, State
from continuum.boussinesq.poisson import solvers

CFL = 0.4           # of a step: two-step explicit advection with some viscosity is stable to 0.8
LONGEST = 0.05      # step in free-fall times where the flow is too slow to set one
RECORD = 10         # steps from one record to the next


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
    """K at times t, and the last state."""
    t: np.ndarray
    K: np.ndarray
    state: State


def transient(case: BoussinesqCase, start: State, *, until: float) -> Transient:
    """Follow the flow for `until` free-fall times. Raises ValueError: it diverges."""
    if not 0 < until < np.inf:
        raise ValueError(f"until must be positive and finite, got {until}: it is in free-fall times")
    flow, t = Projection(case, start.on(case).q), 0.0
    state = State(case=case, q=flow.q)
    rows = [(t, state.K)]
    while t < until*(1 - 1e-12):
        step = min(LONGEST, CFL/max(flow.courant(), CFL/LONGEST))
        steps = min(RECORD, int(np.ceil((until - t)/step - 1e-9)))
        step = min(step, (until - t)/steps)
        for _ in range(steps):
            flow.advance(step)
        t += steps*step
        state = State(case=case, q=flow.q, t=t)
        rows.append((t, state.K))
    times, K = np.array(rows).T
    return Transient(times, K, state)
