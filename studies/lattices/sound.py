"""Sound on a lattice of smooth particles: its speed, and when the lattice melts    [KHP95, Sec. II]

Sums over a lattice take the place of integrals, which changes the speed of sound (`Speed`). A standing wave
of small amplitude then rings for two periods: along x, alike along y (`Ringing`). What moves along y began as
round-off of places. About a lattice that is not stable it grows at the rate s of `particles.limits.waves`,
until it is as fast as the wave. Steps dt round places off by rms (u_x, u_y); n particles have n motions a cos
k.r of least omega^2, and

    v_y^2 = (1/n) sum_k (c e^(s t) a_y)^2 (a_x^2 u_x^2 + a_y^2 u_y^2) (1 + 1/(2 s dt)),    c = s w/(s^2 + w),  w = -omega^2

where c is that of u'' + (w/s - s) u' = w u, let go at rest. It tells the power of ten: particles of one x are
often rounded off alike, which seeds nothing. A longer wave rings for longer, so that round-off grows by more
e-foldings.
"""
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import expm

from continuum.exact.waves import Gas, continuum
from continuum.fluid import ConstEta, IdealGas
from particles.limits import Symbols, step_limit
from particles.limits import waves as rates_of
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.weights import value_and_slope
from studies.build.periodic_box import fluid
from studies.kit.case import Case, Outcome, Report
from studies.kit.fits import line
from studies.kit.stats import Measured
from studies.lattices.waves import CELLS, Lattice, lattice, matrices, neighbours, sums, vectors

T, SOUND = 1.0, np.sqrt(2.0)    # of the ideal gas
AMPLITUDE = 1e-5                # of the density
DAMPING = 0.01                  # viscosity over length, sound speed and density
PERIODS = 2.125
BREADTH = 8                     # of the box, spacings
LONG = 1000.0                   # spacings: sound that long has the speed of the longest to 1e-5
BEGUN, SMALL = 30.0, 1e-5       # times round-off, and spacings per time: between these a motion grows by its own rate
SEEN = 5.0                      # e-foldings: fewer do not come out of round-off


# --- the speed of sound ---------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Speed(Case):
    """Speed of the longest waves along x over the fluid's, by lattice sums."""
    lattice: str
    weight: Any
    h: float = 3.0

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, k = self.weight.of(h=self.h), 2*np.pi/LONG
        M = matrices(weight, IdealGas(), T, self.lattice, np.array([[k, 0.0]]))
        speed = float(np.sqrt(M[0, 0, 0])/k/SOUND)
        return Outcome({"sound_speeds": [{"lattice": self.lattice, "weight": self.weight.__name__, "speed": speed}]})


# --- what grows beside it -------------------------------------------------------------------------


class Ripple(NamedTuple):
    """A motion that fits into the box: wave vector, direction, omega^2 without friction, rate with it."""
    k: np.ndarray
    a: np.ndarray
    square: float
    rate: float


@dataclass(frozen=True, kw_only=True)
class Ringing(Case):
    """A wave of a length in spacings, and what grows beside it. lattice : name in `waves.CELLS`.

    seed : of where the lattice is, in [0, 1/4) cells, by which it is rounded off in another way.
    """
    lattice: str
    weight: Any
    length: int
    h: float = 3.0
    seed: int = 1

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": self.h, "length": self.length,
                "seed": self.seed}

    @cached_property
    def cells(self) -> tuple[int, int]:
        """Of the lattice in the box."""
        (width, height), _ = CELLS[self.lattice]
        return round(self.length/width), round(BREADTH/height)

    @cached_property
    def at(self) -> Lattice:
        """Places before the wave, off the centre by a part of a cell."""
        at = lattice(self.lattice, self.cells)
        shift = np.random.default_rng(self.seed).random(2)*CELLS[self.lattice][0]/4
        return at._replace(x=at.x - shift)

    @property
    def k(self) -> float:
        """Wave number."""
        return 2*np.pi/self.at.box[0]

    @property
    def gas(self) -> Gas:
        """Viscosity and conductivity, in proportion to the length."""
        return Gas(DAMPING*self.at.box[0], 0.0, DAMPING*self.at.box[0])

    @property
    def time(self) -> float:
        return PERIODS*self.at.box[0]/SOUND

    @cached_property
    def method(self) -> Spam:
        law = ConstEta(self.gas.eta, self.gas.kappa)
        return fluid(self.weight.of(h=self.h), self.at.box, IdealGas(), law)

    @cached_property
    def steps(self) -> int:
        return int(np.ceil(self.time/(STUDIES*step_limit(self.method, T))))

    def start(self) -> np.ndarray:
        """State (5, n): places displaced as the density wants it, isentropic, at rest."""
        (x, y), zero = self.at.x.T, np.zeros(len(self.at.x))
        wave = AMPLITUDE*np.cos(self.k*x)
        return np.array([x - AMPLITUDE/self.k*np.sin(self.k*x), y, zero, zero, T*(1 + wave)])

    @property
    def speed(self) -> float:
        """Rms velocity of the exact wave at the end."""
        amplitudes = expm(continuum(self.gas, self.k).matrix*self.time)@np.array([1, 0, 1])
        return float(AMPLITUDE*abs(amplitudes[1])/np.sqrt(2))

    @property
    def cost(self) -> float:
        return 4e-5*self.length**2

    @property
    def label(self) -> str:
        return "ringing " + " ".join(map(str, self.columns.values()))

    def run(self, report: Report, folder: Path) -> Outcome:
        motions, round_off = ripples(self), rounding(self.at.x)
        dt, fastest = self.time/self.steps, max(motions, key=lambda motion: motion.rate)
        track = Track(fastest)
        try:
            run(self.method, self.start(), Plan(dt=dt, steps=self.steps, series={"v": track}, every=2))
            across = track.across
        except Divergence:
            across = np.nan
        rate = Measured(np.nan, np.nan)
        if fastest.rate*self.time > SEEN:
            times = 2*dt*(1 + np.arange(len(track.along)))
            begun = BEGUN*fastest.rate*round_off.max()/np.sqrt(len(self.at.x))
            rate = growth(times, np.array(track.along), begun)
        return Outcome({"ringing": [{
            **self.columns, "predicted": fastest.rate, "measured": rate.value, "measured_err": rate.err,
            "time": self.time, "wave": self.speed, "foretold": grown(motions, self.time, dt, round_off),
            "across": across}]})


class Track:
    """The part of one motion in the velocities, in time, and the last rms velocity across the wave."""

    def __init__(self, ripple: Ripple):
        self.ripple = ripple
        self.along: list[float] = []
        self.across = np.nan

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        phase = np.exp(-1j*(self.ripple.k@state[:2]))
        self.along.append(float(abs(np.mean(self.ripple.a@state[2:4]*phase))))
        self.across = float(np.sqrt(np.mean(state[3]**2)))
        return self.across


def ripples(wave: Ringing) -> list[Ripple]:
    """Of each wave vector the motion of least omega^2, about rest at T = 1 and mass 1."""
    method, k = wave.method, vectors(wave.lattice, wave.cells)
    squares, a = np.linalg.eigh(matrices(method.weight, method.eos, T, wave.lattice, k))
    rates = rates_of(method, symbols(method.weight, wave.lattice, k), T).real.max(axis=1)
    return [*map(Ripple, k, a[:, :, 0], squares[:, 0], rates)]


def symbols(weight: Any, kind: str, k: np.ndarray) -> Symbols:
    """What `particles.limits` sums over square lattices, for any: with k^2 of nested and of direct sums."""
    rho, S, D = sums(weight, kind, k)
    r = neighbours(kind, weight.h)
    slope = np.array([value_and_slope(weight, one)[1] for one in np.hypot(*r.T)])
    return Symbols(rho, S, D, nested=(S**2).sum(axis=1)/rho**2, direct=2/rho*(1 - np.cos(k@r.T))@-slope)


def rounding(x: np.ndarray) -> np.ndarray:
    """(2,): rms of what is rounded off from places x (n, 2), uniform within half of the last digit."""
    return np.sqrt(np.mean(np.spacing(np.abs(x))**2, axis=0)/12)


def grown(motions: Sequence[Ripple], time: float, dt: float, round_off: np.ndarray) -> float:
    """Rms velocity along y at the end, of the sum at the head of this file."""
    square = 0.0
    for _, a, omega2, s in motions:
        if omega2 < 0 < s:
            seed = a**2@round_off**2*(1 + 1/(2*s*dt))
            square += seed*(a[1]*np.exp(s*time)*s*-omega2/(s**2 - omega2))**2
    return float(np.sqrt(square/len(motions)))


def growth(times: np.ndarray, along: np.ndarray, begun: float) -> Measured:
    """Rate of one motion while it is above what began and still small; nan if that is too short."""
    end = int(np.argmax(along > SMALL)) or len(along)
    first = 1 + max(np.flatnonzero(along[:end] < begun), default=-1)
    if end - first < 10:
        return Measured(np.nan, np.nan)
    return line(times[first:end], np.log(along[first:end])).slope
