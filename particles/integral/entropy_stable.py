"""Layers and streams that survive shocks and vacua: `entropy_fluxes`, with time steps of `positive`."""
from dataclasses import dataclass, replace
from math import ceil, inf
from typing import Any, ClassVar

import numpy as np

import particles.integral.van_der_waals  # noqa: F401  (registers its formulas)
from continuum.fluid import IdealGas, check_state, energy, sound_speed
from continuum.jit import check_formulas, jit
from particles.integral.edges import NONE_BEYOND, NOWHERE, selected
from particles.integral.entropy_fluxes import BlendedPressure, Dissipation, Logarithmic, acoustics, log_means
from particles.integral.exchange import Pressure, pressure_of
from particles.integral.fixed import FixedSums, OwnPressure, inner, read, stored
from particles.integral.lanes import Point
from particles.integral.layer import Layer, LayerSums
from particles.integral.positive import COURANT, FORMULAS, LEAST, OLD, PART, Limits, Slopes, divided
from particles.integral.stream import Stream, Streaming, keep
from particles.integral.transposed_stress import Heating
from particles.limits import limit_of
from particles.pairs import Faces, sweep
from particles.threads import Threads


@jit
def _sound(first, last, eos, points):
    for i in range(first, last):
        a = points[i]
        a.P, a.rx, a.ry = pressure_of(eos, a.rho, a.T), -a.vx, -a.vy
        a.c = sound_speed(eos, a.rho, energy(eos, a.rho, a.T))


@jit
def _see_images(slopes, beyond, points):
    """Correct V grad v to what friction and heating see: images have the velocity u, not v."""
    rows, image, sx, sy = beyond
    for k in range(len(rows)):
        b, d = points[image[k]], slopes[rows[k]]
        du, dv = b.ux - b.vx, b.uy - b.vy
        d[0], d[1], d[2], d[3] = d[0] + sx[k]*du, d[1] + sy[k]*du, d[2] + sx[k]*dv, d[3] + sy[k]*dv


@jit
def _went_on(first, last, dt, rates, state, before):
    for row in range(len(state)):
        for i in range(first, last):
            before[row, i] = state[row, i]
            state[row, i] += dt*rates[row, i]


@jit
def _mirrored(origin, points, n):
    """Gradients of images, mirrored from their parents."""
    for m in range(len(origin)):
        a, b = points[origin[m]], points[n + m]
        b.rho_x, b.P_x, b.u_x, b.v_y = a.rho_x, a.P_x, a.u_x, a.v_y
        b.rho_y, b.P_y, b.u_y, b.v_x = -a.rho_y, -a.P_y, -a.u_y, -a.v_x


class Stable(Limits, FixedSums):
    """Common part of the compiled sums over stored edges; a base class in front of a scene's `FixedSums`."""

    def __init__(self, method: Any, threads: Threads):
        super().__init__(method, threads)  # type: ignore[call-arg]
        n, beyond = self.n, getattr(method, "beyond", NONE_BEYOND)
        image = getattr(self, "image", NOWHERE)
        self.beyond, self.before = (beyond.i, n + image, *(beyond.S.T/2).copy()), np.zeros((4, n))
        self.set_limits(method.flow)
        self.points = np.zeros(len(self.points), Point)
        self.points["g"][n:] = -self.push[1]
        near, far = replace(method.edges, S=2*method.edges.apart), replace(beyond, S=2*beyond.apart)
        along = stored(near, far, n + image)
        edges = Faces(**self.at.edges._asdict(), dx=along.sx, dy=along.sy)
        self.at, self.edges = self.at._replace(points=self.points, edges=edges), edges
        self.images = self.at.images
        self.sending.follow(edges)
        self.sending.stages, self.exchange = self.exchange.stages, self.sending
        k = 2*np.bincount(beyond.i, beyond.k, n) - method.edges.laplacian.diagonal()
        self.spread = k/self.at.V

    def look_at(self, state: np.ndarray) -> None:
        """Compute fields and gradients of points and images, set those of held points, prepare the stages."""
        threads, n, points, method = self.threads, self.n, self.points, self.method
        threads(read, n, state, method.eos, method.law, points)
        self.surround(state)
        threads(_sound, len(points), method.eos, points)
        threads(sweep, n, Slopes(), points, self.edges, self.slopes)
        threads(divided, n, self.slopes, self.at.V, points)
        _mirrored(self.images.origin, points, n)
        _see_images(self.slopes, self.beyond, points)
        for stage in self.exchange.stages:
            if isinstance(stage, Heating):
                stage.use(self.slopes, self.at)
            elif not isinstance(stage, OwnPressure):
                stage.prepare(self.at)

    def longest(self) -> float:
        """Longest step that is known to keep rho, e > 0, for the state of the last `look_at`."""
        return float(1/PART/np.max(self.speeds/self.at.V/COURANT + self.spread*self.chi))

    def euler(self, state: np.ndarray, dt: float, rates: np.ndarray) -> bool:
        """Euler step of a state in place, with its rates; False: not even Rusanov's flux keeps rho, e > 0."""
        self.threads(_went_on, self.n, dt, rates, state, self.before)
        less = self.less(self.before, state, dt/self.at.V)
        if less is None:
            return False
        state += less
        return True


class StableSums(Stable, LayerSums):
    """Compiled sums of a `StableLayer`."""
    method: "StableLayer"


class StableStreaming(Stable, Streaming):
    """Compiled sums of a `StableStream`. received (m, 3) : as in `Streaming`, after `euler` with limits."""
    method: "StableStream"

    def settle(self) -> None:
        """Move what would change velocity or temperature of held points from `gain` to `more`."""
        held, kept = self.method.held, np.empty((4, self.n))
        keep(self.method.eos, *held[:3], self.gain, np.ones(self.n), self.points, self.more, kept)
        self.gain[held.which] = kept[:, held.which].T

    def euler(self, state: np.ndarray, dt: float, rates: np.ndarray) -> bool:
        self.more = np.zeros_like(self.received)
        done = super().euler(state, dt, rates)
        self.received += self.more
        return done


class Positive:
    """Averaged Euler steps, in parts no longer than `sums.longest`; a part that fails is halved."""

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


def flow_of(method: Any, pressure: Any) -> None:
    """Set the default terms of a method that lists none, with the given pressure for an ideal gas and the
    blended one for other fluids. Raises TypeError: the fluid has no entropy."""
    eos = method.eos
    check_formulas(eos, log_means, acoustics, *FORMULAS)
    chosen = pressure if isinstance(eos, IdealGas) else BlendedPressure
    object.__setattr__(method, "flow", method.flow or (Logarithmic(eos), chosen(eos), Dissipation(eos)))


@dataclass(frozen=True, kw_only=True)
class StableLayer(Layer):
    """A layer of a fluid with an entropy. flow : listed terms in place of convection and pressure."""
    flow: tuple = ()

    integrator: ClassVar[type] = Positive
    sums = StableSums

    def __post_init__(self):
        flow_of(self, Pressure)
        for name in ("edges", "beyond"):        # some are empty at the end of a weight's range
            edges = getattr(self, name)
            object.__setattr__(self, name, selected(edges, (edges.k != 0) | edges.S.any(axis=1)))


@dataclass(frozen=True, kw_only=True)
class StableStream(Stream):
    """A fluid with an entropy around held points. flow : as in `StableLayer`."""
    flow: tuple = ()

    integrator: ClassVar[type] = Positive
    sums = StableStreaming

    def __post_init__(self):
        super().__post_init__()
        flow_of(self, Pressure)


@limit_of.register(StableLayer)
@limit_of.register(StableStream)
def _(method: Any, start: np.ndarray) -> float:
    """Longest step that is known to keep rho, e > 0 at the start."""
    check_state(method.eos, *inner(*start))
    sums = method.start(start.shape[1], Threads(1))
    sums.look_at(start)
    return float(sums.longest())
