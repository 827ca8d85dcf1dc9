"""Fixed points around bodies, compiled: the terms of `layer` in a periodic box, in 2D.

Held points (`bodies`) keep their velocity and temperature; their density evolves. Slow flow around them feeds
pressure patterns that gradients do not see; a filter of the density, chi of 0.05 a^2 c^2/nu, removes these.
"""
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from continuum.fluid import conductivity, energy, viscosity
from continuum.jit import jit
from particles.integral.bodies import Held
from particles.integral.edges import Edges
from particles.integral.exchange import At, Stage
from particles.integral.fixed import NO_IMAGES, FixedSums, OnPoints, OwnPressure, opened, stored
from particles.pairs import Stored, pair_term, sweep
from particles.threads import Threads


@pair_term(4, "chi")
def Filter(term, a, b, ab):
    """Mass chi k_ab (rho_a - rho_b) goes from a to b, with their mean velocity and internal energy."""
    mass = term.chi*ab.k*(b.rho - a.rho)
    inner = a.eps/a.rho + b.eps/b.rho - 0.5*((a.vx - b.vx)**2 + (a.vy - b.vy)**2)
    return mass, 0.5*mass*(a.vx + b.vx), 0.5*mass*(a.vy + b.vy), 0.5*mass*inner


class Filtering(Stage):
    """Adds the exchange by a `Filter`, over edges of its own."""

    def __init__(self, term: Any, edges: Stored, n: int, threads: Threads):
        self.term, self.edges, self.n, self.threads, self.gain = term, edges, n, threads, np.empty((n, 4))

    def add(self, at: At, total: np.ndarray) -> None:
        self.threads(sweep, self.n, self.term, at.points, self.edges, self.gain)
        total += self.gain


class Streaming(FixedSums):
    """Compiled sums of a stream. received (m, 3): momentum and energy that held points take per time."""
    method: "Stream"

    def __init__(self, method: "Stream", threads: Threads):
        n = len(method.x)
        edges = stored(separated(method.edges, method.held, True) if method.solid else method.edges)
        # no mass seeps through a body
        around = stored(separated(method.edges, method.held))
        filters = (Filtering(Filter(method.chi), around, n, threads),) if method.chi else ()
        super().__init__(method, threads, edges, NO_IMAGES, method.push,
                         OwnPressure(method.eos, opened(edges), n, threads), *filters)
        self.received = np.zeros((len(method.held.which), 3))

    def surround(self, state: np.ndarray) -> None:
        hold(self.method.eos, self.method.law, *self.method.held[:3], self.points)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        held, V = self.method.held, self.at.V
        keep(self.method.eos, *held[:3], self.exchange.total, V, self.points, self.received, out)
        if held.heat.any():
            out[3, held.which] += held.heat/V[held.which]
            self.received[:, 2] -= held.heat


@dataclass(frozen=True, kw_only=True)
class Stream(OnPoints):
    """A fluid on fixed points x (n, 2), periodic, driven by a force `push` per mass, around `held` points.

    chi : diffusivity of the filter of the density, 0 for none. solid : whether edges between held points lie
    in bodies; if not, held points are rows on the fluid's boundary, with friction and heat along them, too.
    """
    x: np.ndarray
    edges: Edges
    eos: Any
    law: Any
    held: Held
    push: tuple[float, float] = (0.0, 0.0)
    chi: float = 0.0
    solid: bool = True

    sums = Streaming

    def __post_init__(self):
        if not self.chi >= 0:
            raise ValueError(f"the filter's chi must not be negative, got {self.chi}: take 0.05 a^2 c^2/nu")

    def state(self, rho: Any, v: np.ndarray, T: Any) -> np.ndarray:
        """(4, n) of densities, velocities (n, 2), temperatures; held points get their own."""
        T, v = T*np.ones(len(self.x)), v.copy()
        v[self.held.which] = self.held.v
        warm = np.isfinite(self.held.T)
        T[self.held.which[warm]] = self.held.T[warm]
        return super().state(rho, v, T)


def separated(edges: Edges, held: Held, warm: bool = False) -> Edges:
    """Edges with k = 0 between held points; warm : but for edges within bodies of given temperature."""
    body = np.full(edges.n, -1)
    alone = -2 - np.arange(len(held.T))
    body[held.which] = np.where(warm & ~np.isnan(held.T), held.body, alone)
    a, b = body[edges.i], body[edges.j]
    return replace(edges, k=np.where((a != b) & (a != -1) & (b != -1), 0.0, edges.k))


@jit
def hold(eos, law, which, v, T, points):
    """Set held points to their own velocity and temperature, exactly."""
    for m in range(len(which)):
        a = points[which[m]]
        a.vx, a.vy = v[m, 0], v[m, 1]
        a.ux, a.uy = a.vx, a.vy
        if T[m] == T[m]:        # not nan
            a.T, a.Td = T[m], T[m]
            a.eps = a.rho*(energy(eos, a.rho, a.T) + 0.5*(a.vx**2 + a.vy**2))
            a.eta, a.k = viscosity(law, a.rho, a.T), conductivity(law, a.rho, a.T)


@jit
def keep(eos, which, v, T, total, V, points, received, out):
    """Rates of held points, of which only the density evolves, and the momentum and energy they take."""
    for m in range(len(which)):
        i, (vx, vy) = which[m], v[m]
        mass, rho, d = total[i, 0], points[i].rho, 1e-6*points[i].rho
        fx, fy = total[i, 1] - vx*mass, total[i, 2] - vy*mass
        taken = fx*vx + fy*vy
        if T[m] == T[m]:
            # d(rho e)/d(rho) at constant T: exact to round-off for an ideal gas, to 1e-10 for others
            above, below = (rho + d)*energy(eos, rho + d, T[m]), (rho - d)*energy(eos, rho - d, T[m])
            slope = (above - below)/(2*d) + 0.5*(vx**2 + vy**2)
            taken = total[i, 3] - slope*mass
        received[m, 0], received[m, 1], received[m, 2] = fx, fy, taken
        out[0, i], out[1, i], out[2, i] = mass/V[i], vx*mass/V[i], vy*mass/V[i]
        out[3, i] = (total[i, 3] - taken)/V[i]
