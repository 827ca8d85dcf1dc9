"""Sound on a lattice that is not stable: when does the lattice melt into the wave?    [KHP95, Secs II, III]

A standing wave of small amplitude rings for two periods, as in study `speed`: along x, alike along y. What moves along y began
as round-off of places. About a lattice that is not stable it grows at the rate s of `particles.limits.waves`, until it is as
fast as the wave. Steps dt round places off by rms (u_x, u_y); n particles have n motions a cos k.r of least omega^2, and

    v_y^2 = (1/n) sum_k (c e^(s t) a_y)^2 (a_x^2 u_x^2 + a_y^2 u_y^2) (1 + 1/(2 s dt)),    c = s w/(s^2 + w),  w = -omega^2

where c is that of u'' + (w/s - s) u' = w u, let go at rest. It tells the power of ten: particles of one x are often rounded off
alike, which seeds nothing. Rates are of the lattice, times in proportion to the length of the wave: a longer wave has more
e-foldings, unless the viscosity, in proportion too, slows motions as much.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import expm

from continuum.exact.waves import Gas, continuum
from continuum.fluid import ConstEta, IdealGas
from particles.limits import Symbols, step_limit, waves
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Direct, Nested, Spam
from particles.weights import value_and_slope
from studies.build.periodic_box import fluid
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured
from studies.lattices.waves import CELLS, Lattice, lattice, matrices, neighbours, sums, vectors
from studies.ordering.derive import line

T, SOUND = 1.0, np.sqrt(2.0)    # of the ideal gas
AMPLITUDE, DAMPING, PERIODS, BREADTH = 1e-5, 0.01, 2.125, 8     # as in study speed; spacings
BEGUN, SMALL = 30.0, 1e-5       # times round-off, and spacings per time: between these a motion grows by its own rate
SAMPLES = 60                    # of a path, for the figure
SEEN = 5.0                      # e-foldings: fewer do not come out of round-off


class Ripple(NamedTuple):
    """A motion that fits into the box: wave vector, direction, omega^2 without friction, rate with it."""
    k: np.ndarray
    a: np.ndarray
    square: float
    rate: float


@dataclass(frozen=True, kw_only=True)
class Ringing(Case):
    """A wave of a length in spacings, and what grows beside it.

    lattice : name in `lattice_waves.CELLS`; amplitude : of the density; step : over that of other studies; seed : of where the
    lattice is, in [0, 1) spacings, by which it is rounded off in another way. path : keep velocities in time.
    """
    lattice: str
    weight: Any
    length: int
    h: float = 3.0
    transport: type = Nested
    amplitude: float = AMPLITUDE
    step: float = 1.0
    seed: int = 1
    path: bool = False

    @property
    def cost(self) -> float:
        return 4e-5*self.length**2/self.step

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice, "weight": self.weight.__name__, "h": self.h, "transport": self.transport.__name__,
                "length": self.length, "amplitude": self.amplitude, "step": self.step, "seed": self.seed}

    @property
    def label(self) -> str:
        return "ringing " + " ".join(map(str, self.columns.values()))

    @cached_property
    def cells(self) -> tuple[int, int]:
        """Of the lattice in the box."""
        cell, _ = CELLS[self.lattice]
        return round(self.length/cell[0]), round(BREADTH/cell[1])

    @cached_property
    def at(self) -> Lattice:
        """Places before the wave; a part of a spacing off the centre."""
        at = lattice(self.lattice, self.cells)
        return at._replace(x=at.x - np.random.default_rng(self.seed).random(2)*CELLS[self.lattice][0]/4)

    @property
    def k(self) -> float:
        """Wave number of the sound."""
        return 2*np.pi/self.at.box[0]

    @property
    def gas(self) -> Gas:
        """Viscosity and conductivity, by the wave's length."""
        return Gas(DAMPING*self.at.box[0], 0.0, DAMPING*self.at.box[0])

    @property
    def time(self) -> float:
        return PERIODS*self.at.box[0]/SOUND

    @cached_property
    def method(self) -> Spam:
        return fluid(self.weight.of(h=self.h), self.at.box, IdealGas(), ConstEta(self.gas.eta, self.gas.kappa),
                     transport=self.transport)

    @cached_property
    def steps(self) -> int:
        return int(np.ceil(self.time/(self.step*STUDIES*step_limit(self.method, T))))

    def start(self) -> np.ndarray:
        """State (5, n): places displaced as the density wants it, isentropic, at rest."""
        (x, y), zero = self.at.x.T, np.zeros(len(self.at.x))
        wave = self.amplitude*np.cos(self.k*x)
        return np.array([x - self.amplitude/self.k*np.sin(self.k*x), y, zero, zero, T*(1 + wave)])

    def speed(self) -> float:
        """rms velocity of the exact wave of the usual amplitude at the end."""
        u = expm(continuum(self.gas, self.k).matrix*self.time)@np.array([1, 0, 1])
        return float(AMPLITUDE*abs(u[1])/np.sqrt(2))

    def run(self, report: Report, folder: Path) -> Outcome:
        all_ripples = list(ripples(self.method, self.lattice, self.cells))
        fastest = max(all_ripples, key=lambda ripple: ripple.rate)
        dt, n = self.time/self.steps, len(self.at.x)
        round_off, found = rounding(self.at.x), Track(fastest)
        try:
            run(self.method, self.start(), Plan(dt=dt, steps=self.steps, series={"v": found}, every=2))
            across = found.across[-1]
        except Divergence:
            across = np.nan
        times = 2*dt*(1 + np.arange(len(found.across)))
        seen = fastest.rate*self.time > SEEN
        begun = BEGUN*fastest.rate*round_off.max()/np.sqrt(n)
        rate = growth(times, np.array(found.along), begun) if seen else Measured(np.nan, np.nan)
        row = {**self.columns, "predicted": fastest.rate, "measured": rate.value, "measured_err": rate.err, "time": self.time,
               "wave": self.speed(), "foretold": foretold(all_ripples, self.time, dt, round_off), "across": across}
        return Outcome({"ringing": [row], "ringing_paths": list(self._path(times, found)) if self.path else []})

    def _path(self, times: np.ndarray, found: "Track") -> Iterator[dict[str, Any]]:
        for i in np.unique(np.linspace(0, len(times) - 1, SAMPLES).astype(int)):
            yield {**self.columns, "t": times[i], "across": found.across[i], "along": found.along[i]}


class Track:
    """Velocities, kept also when the run does not come to its end: rms across the wave, and part of one motion."""

    def __init__(self, ripple: Ripple):
        self.ripple = ripple
        self.across: list[float] = []
        self.along: list[float] = []

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        phase = np.exp(-1j*(self.ripple.k@state[:2]))
        self.along.append(float(abs(np.mean(self.ripple.a@state[2:4]*phase))))
        self.across.append(float(np.sqrt(np.mean(state[3]**2))))
        return self.across[-1]


def ripples(method: Spam, kind: str, cells: tuple[int, int]) -> Iterator[Ripple]:
    """Of each wave vector the motion of least omega^2, about rest at T = 1 and mass 1."""
    k = vectors(kind, cells)
    square, a = np.linalg.eigh(matrices(method.weight, method.eos, T, kind, k))
    rates = waves(method, symbols(method.weight, kind, k), T).real.max(axis=1)
    yield from map(Ripple, k, a[:, :, 0], square[:, 0], rates)


def symbols(weight: Any, kind: str, k: np.ndarray) -> Symbols:
    """What `particles.limits` sums over square lattices, for any: with k^2 of nested and of direct sums."""
    rho, S, D = sums(weight, kind, k)
    r = neighbours(kind, weight.h)
    slope = np.array([value_and_slope(weight, one)[1] for one in np.hypot(*r.T)])
    return Symbols(rho, S, D, {Nested: (S**2).sum(axis=1)/rho**2, Direct: 2/rho*(1 - np.cos(k@r.T))@-slope})


def rounding(x: np.ndarray) -> np.ndarray:
    """(2,): rms of what is rounded off from places x (n, 2), uniform within half of the last digit."""
    return np.sqrt(np.mean(np.spacing(np.abs(x))**2, axis=0)/12)


def foretold(found: list[Ripple], time: float, dt: float, round_off: np.ndarray) -> float:
    """rms velocity along y at the end, of the sum above."""
    square = 0.0
    for _, a, omega2, s in found:
        if omega2 < 0 < s:
            seed = a**2@round_off**2*(1 + 1/(2*s*dt))
            square += seed*(a[1]*np.exp(s*time)*s*-omega2/(s**2 - omega2))**2
    return float(np.sqrt(square/len(found)))


def growth(times: np.ndarray, along: np.ndarray, begun: float) -> Measured:
    """Rate of one motion from where it is larger than what began to where it is not small any more; nan if that is too short."""
    end = int(np.argmax(along > SMALL)) or len(along)
    linear = np.arange(len(along)) >= 1 + max(np.flatnonzero(along[:end] < begun), default=-1)
    linear[end:] = False
    if linear.sum() < 10:
        return Measured(np.nan, np.nan)
    return Measured(*line(times[linear], np.log(along[linear])))
