"""Layers whose flux survives shocks and vacua: listed `entropy_fluxes`, and steps that are `positive`."""
from dataclasses import dataclass, fields, replace
from math import ceil, inf
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import sound_speed
from continuum.jit import check_formulas, jit
from particles.integral.entropy_fluxes import Dissipation, Logarithmic, log_means
from particles.integral.exchange import At, Exchange, Pressure, Stage, pressure_of
from particles.integral.fixed import Point, stored
from particles.integral.layer import Layer, LayerSums
from particles.integral.once import Sending
from particles.integral.positive import COURANT, LEAST, MORE, OLD, PART, Limits, Slopes, divided
from particles.limits import limit_of
from particles.pairs import Faces, sweep
from particles.threads import Threads

#: what `fixed.Point` has; r = w - v, which is -v
StablePoint = np.dtype([*Point.descr, *((name, "f8") for name in ("rx", "ry", *MORE))])


@jit
def _sound(first, last, eos, points):
    for i in range(first, last):
        a = points[i]
        a.P, a.rx, a.ry = pressure_of(eos, a.rho, a.T), -a.vx, -a.vy
        a.c = sound_speed(eos, a.rho, eos.cv*a.T)


@jit
def _mirrored(parent, points, n):
    """Gradients of images."""
    for m in range(len(parent)):
        a, b = points[parent[m]], points[n + m]
        b.rho_x, b.P_x, b.u_x, b.v_y = a.rho_x, a.P_x, a.u_x, a.v_y
        b.rho_y, b.P_y, b.u_y, b.v_x = -a.rho_y, -a.P_y, -a.u_y, -a.v_x


class Sent(Exchange):
    """Listed terms, each edge once, and their stages."""

    def __init__(self, stages: tuple[Stage, ...], sending: Sending, slopes: np.ndarray):
        self.stages, self.sending, self.slopes, self.total = stages, sending, slopes, sending.total

    def sum(self, at: At) -> np.ndarray:
        total = self.sending.sum(at.points, self.slopes)
        for stage in self.stages:
            stage.add(at, total)
        return total


class StableSums(Limits, LayerSums):
    """The compiled sums."""
    method: "StableLayer"

    def __init__(self, method: "StableLayer", threads: Threads):
        super().__init__(method, threads)
        n, beyond = self.n, method.beyond
        self.set_limits(method.flow)
        self.points = np.zeros(len(self.points), StablePoint)
        self.points["g"][n:] = method.g
        near, far = replace(method.edges, S=2*method.edges.apart), replace(beyond, S=2*beyond.apart)
        along = stored(near, far, n + self.image)
        edges = Faces(**self.at.edges._asdict(), dx=along.sx, dy=along.sy)
        self.at, self.edges = self.at._replace(points=self.points, edges=edges), edges
        self.images = self.at.images
        self.sending.follow(edges)
        self.exchange = Sent(self.exchange.stages, self.sending, self.slopes)
        k = 2*np.bincount(beyond.i, beyond.k, n) - method.edges.laplacian.diagonal()
        self.spread = k/self.at.V

    def surround(self, state: np.ndarray) -> None:
        """Images; gradients, of images as in a mirror."""
        super().surround(state)
        points, V = self.points, self.at.V
        self.threads(_sound, len(points), self.method.eos, points)
        self.threads(sweep, self.n, Slopes(), points, self.at.edges, self.slopes)
        self.threads(divided, self.n, self.slopes, V, points)
        _mirrored(self.parent, points, self.n)

    def longest(self) -> float:
        """The step that is known to keep a state positive that was looked at."""
        return float(1/PART/np.max(self.speeds/self.at.V/COURANT + self.spread*self.chi))

    def euler(self, state: np.ndarray, dt: float, rates: np.ndarray) -> bool:
        """Go on by dt from a state with these rates; False: not even Rusanov's flux leaves rho, e > 0."""
        before = state.copy()
        state += dt*rates
        less = self.less(before, state, dt/self.at.V)
        if less is None:
            return False
        state += less
        return True


class Positive:
    """Averaged Euler steps in as many parts as it takes for `sums.longest`, halved where that does not do."""
    evaluations = len(OLD)

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._start, self._k = np.empty(shape), np.empty(shape)

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        left, most = dt, inf
        while left > 0:
            self._start[:] = y
            sums.rates(y, self._k)
            h = left/ceil(left/min(sums.longest(), most))
            if all(self._stage(sums, y, h, number) for number in range(len(OLD))):
                left, most = left - h, inf
                continue
            y[:], most, sums.refused = self._start, h/2, sums.refused + 1
            if most < LEAST*dt:
                raise FloatingPointError(f"no step of {h:.3g} or more leaves point {sums.lost} a density and "
                                         "an energy that are positive")

    def _stage(self, sums: Any, y: np.ndarray, h: float, number: int) -> bool:
        if number:
            sums.rates(y, self._k)
        done: bool = sums.euler(y, PART*h, self._k)
        if OLD[number]:
            y[:] = OLD[number]*self._start + (1 - OLD[number])*y
        return done


@dataclass(frozen=True, kw_only=True)
class StableLayer(Layer):
    """A layer of a fluid with an entropy. flow : listed terms in place of convection and pressure."""
    flow: tuple = ()

    integrator: ClassVar[type] = Positive
    sums = StableSums

    def __post_init__(self):
        check_formulas(self.eos, log_means)
        usual = Logarithmic(self.eos), Pressure(self.eos), Dissipation(self.eos)
        object.__setattr__(self, "flow", self.flow or usual)
        for name in ("edges", "beyond"):        # as at the end of a weight's range
            object.__setattr__(self, name, of_some_area(getattr(self, name)))


def of_some_area(edges: Any) -> Any:
    """Edges that anything passes."""
    some = (edges.k != 0) | edges.S.any(axis=1)
    return replace(edges, **{field.name: getattr(edges, field.name)[some] for field in fields(edges)
                             if field.name != "V"})


@limit_of.register
def _(method: StableLayer, start: np.ndarray) -> float:
    sums = method.start(start.shape[1], Threads(1))
    sums.look_at(start)
    return sums.longest()
