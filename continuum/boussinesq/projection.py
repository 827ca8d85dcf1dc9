"""Transients of the discrete equations by a projection method.

Sine and cosine modes are the eigenvectors of the five-point Laplacian, so that solves are fast.
"""
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy import fft

from continuum.boussinesq.flow import BoussinesqCase, Equations, State
from continuum.boussinesq.mac import Axis, End, Mac
from continuum.scene import positive

CFL = 0.4           # of a step: two-step explicit advection with some viscosity is stable to 0.8
LONGEST = 0.05      # step in free-fall times where the flow is too slow to set one
RECORD = 10         # steps from one record to the next


class Modes(NamedTuple):
    """Transform along one axis, its inverse, and the eigenvalues of the second difference there."""
    forward: Callable
    backward: Callable
    eigenvalues: np.ndarray


def modes(axis: Axis, along: int, end: End) -> Modes:
    """For what sits in cells."""
    turns = np.arange(axis.cells + 1)/axis.cells
    if end is End.MIRROR:
        return Modes(partial(fft.dct, axis=along), partial(fft.idct, axis=along), bend(axis.h, turns[:-1]))
    return Modes(partial(fft.dst, axis=along), partial(fft.idst, axis=along), bend(axis.h, turns[1:]))


def face_modes(axis: Axis, along: int) -> Modes:
    """For what sits on faces and vanishes in the walls."""
    return Modes(partial(fft.dst, type=1, axis=along), partial(fft.idst, type=1, axis=along),
                 bend(axis.h, np.arange(1, axis.cells)/axis.cells))


def bend(h: float, half_turns: np.ndarray) -> np.ndarray:
    """Second difference of a wave that advances by pi*half_turns from point to point."""
    return -(2/h*np.sin(np.pi*half_turns/2))**2


class Solver:
    """Solves (a + b Lap) f = g on one of the staggered sets of points."""

    def __init__(self, x: Modes, y: Modes):
        self.x, self.y = x, y
        self.lap = x.eigenvalues[:, None] + y.eigenvalues[None, :]

    def __call__(self, g: np.ndarray, a: float, b: float) -> np.ndarray:
        """f of the shape of g (x, y); with a = 0 and ends that leave a constant free, its mean is zero."""
        factor = a + b*self.lap
        amplitude = self.x.forward(self.y.forward(g))
        amplitude = np.divide(amplitude, factor, out=np.zeros_like(amplitude), where=factor != 0)
        return self.y.backward(self.x.backward(amplitude))


def solvers(mac: Mac) -> tuple[Solver, Solver, Solver, Solver]:
    """For u, v, T and the pressure."""
    x, y, sides, plates = mac.x, mac.y, mac.box.sides, mac.box.plates
    return (Solver(face_modes(x, 0), modes(y, 1, plates.flow)),
            Solver(modes(x, 0, sides.flow), face_modes(y, 1)),
            Solver(modes(x, 0, sides.heat), modes(y, 1, plates.heat)),
            Solver(modes(x, 0, End.MIRROR), modes(y, 1, End.MIRROR)))


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
    positive(until=until)
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
