"""Transients of the discrete equations by a projection method.

Sine and cosine modes are eigenvectors of the five-point Laplacian: fast transforms solve linear systems.
"""
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy import fft

from continuum.boussinesq.flow import BoussinesqCase, Equations, State
from continuum.boussinesq.mac import Axis, End, Mac
from continuum.scene import positive

CFL = 0.4           # Courant number: two-step explicit advection with some viscosity is stable up to 0.8
LONGEST = 0.05      # longest step in free-fall times, for slow flows
RECORD = 10         # steps between records of K


class Modes(NamedTuple):
    """Transform along one axis, its inverse, and the eigenvalues of the second difference."""
    forward: Callable
    backward: Callable
    eigenvalues: np.ndarray


def modes(axis: Axis, along: int, end: End | None = None) -> Modes:
    """Modes of a quantity in cells, or without `end` of one on faces that vanishes in the walls."""
    first, last = {End.MIRROR: (0, -1), End.WALL: (1, None), None: (1, -1)}[end]
    half_turns = (np.arange(axis.cells + 1)/axis.cells)[first:last]     # from cell to cell
    ways = (fft.dct, fft.idct) if end is End.MIRROR else (fft.dst, fft.idst)
    forward, backward = (partial(way, type=2 if end else 1, axis=along) for way in ways)
    return Modes(forward, backward, -(2/axis.h*np.sin(np.pi*half_turns/2))**2)


class Solver:
    """Solver of (a + b Lap) f = g for one quantity on the staggered grid."""

    def __init__(self, x: Modes, y: Modes):
        self.x, self.y = x, y
        self.lap = x.eigenvalues[:, None] + y.eigenvalues[None, :]

    def __call__(self, g: np.ndarray, a: float, b: float) -> np.ndarray:
        """f, shaped as g (x, y); if a = 0 and a constant is undetermined, its mean is zero."""
        factor = a + b*self.lap
        amplitude = self.x.forward(self.y.forward(g))
        amplitude = np.divide(amplitude, factor, out=np.zeros_like(amplitude), where=factor != 0)
        return self.y.backward(self.x.backward(amplitude))


def solvers(mac: Mac) -> tuple[Solver, Solver, Solver, Solver]:
    """Solvers for u, v, T and the pressure."""
    x, y, sides, plates = mac.x, mac.y, mac.box.sides, mac.box.plates
    return (Solver(modes(x, 0), modes(y, 1, plates.flow)),
            Solver(modes(x, 0, sides.flow), modes(y, 1)),
            Solver(modes(x, 0, sides.heat), modes(y, 1, plates.heat)),
            Solver(modes(x, 0, End.MIRROR), modes(y, 1, End.MIRROR)))


class Projection(Equations):
    """Time stepper of second order: buoyancy and advection extrapolated, diffusion by the trapezoidal rule,
    pressure by projection. It steps increments of q and p: a steady state has no splitting error."""

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
        """Make a step of length dt; in the first, buoyancy and advection are explicit Euler."""
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
        """Make the velocity divergence-free; returns the pressure of this step and the former divergence."""
        div = (self.mac.div@self.q[:self.flow]).reshape(self.mac.shapes[2])
        phi = self.solve[3](div/dt, 0.0, 1.0)
        self.q[:self.flow] -= dt*(self.mac.grad@phi.ravel())
        return phi, div

    def courant(self) -> float:
        """Largest |u|/dx + |v|/dy in a cell: Courant number over dt."""
        x, y = self.mac.x, self.mac.y
        u, v, _ = self.mac.split(np.abs(self.q))
        return float(np.max(x.back@u/x.h + v@y.mean/y.h))


class Transient(NamedTuple):
    """K at times t, and the last state."""
    t: np.ndarray
    K: np.ndarray
    state: State


def transient(case: BoussinesqCase, start: State, *, until: float) -> Transient:
    """Integrate the flow for `until` free-fall times. Raises ValueError: it diverges."""
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
