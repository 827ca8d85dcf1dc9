"""Sound on a lattice of smooth particles: its speed, and when the lattice melts    [KHP95, Sec. II]

Sums over a lattice take the place of integrals, which changes the speed of sound (`Speed`). A standing wave
of small amplitude then rings for two periods: along x, alike along y (`Ringing`). What moves along y began as
round-off of places. About a lattice that is not stable it grows at the rate s of `particles.limits.waves`,
until it is as fast as the wave. Steps dt round places off by rms (u_x, u_y); n particles have n motions a cos
k.r of least omega^2, and

    v_y^2 = (1/n) sum_k (c e^(s t) a_y)^2 (a_x^2 u_x^2 + a_y^2 u_y^2) (1 + 1/(2 s dt))
    c = s w/(s^2 + w),  w = -omega^2

where c is that of u'' + (w/s - s) u' = w u, let go at rest. It tells the power of ten: particles of one x are
often rounded off alike, which seeds nothing. A longer wave rings for longer, so that round-off grows by more
e-foldings.
"""
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy.linalg import expm

from continuum.exact.waves import LinearGas, continuum
from continuum.fluid import ConstEta, IdealGas
from particles.limits import step_limit
from particles.limits import waves as rates_of
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from studies.build.spam import at_rest, fluid
from studies.kit.case import Case, Outcome, Report
from studies.lattices.crystals import Lattice, LatticeMotion, matrices, sums

T, SOUND = 1.0, np.sqrt(2.0)    # of the ideal gas
AMPLITUDE = 1e-5                # of the density
DAMPING = 0.01                  # viscosity over length, sound speed and density
PERIODS = 2.125
BREADTH = 8                     # of the box, spacings
LONG = 1000.0                   # spacings: sound that long has the speed of the longest to 1e-5


@dataclass(frozen=True, kw_only=True)
class Speed(Case):
    """Speed of the longest waves along x over the fluid's, by lattice sums."""
    lattice: Lattice
    weight: Any
    h: float = 3.0

    @property
    def label(self) -> str:
        return f"speed {self.lattice.name} {self.weight.__name__}"

    def run(self, report: Report, folder: Path) -> Outcome:
        k = 2*np.pi/LONG
        symbols = sums(self.weight.of(h=self.h), self.lattice, np.array([[k, 0.0]]))
        square = matrices(symbols, IdealGas(), T)[0, 0, 0]
        row = {"lattice": self.lattice.name, "weight": self.weight.__name__, "speed": np.sqrt(square)/k/SOUND}
        return Outcome({"sound_speeds": [row]})


@dataclass(frozen=True, kw_only=True)
class Ringing(Case):
    """A wave of a length in spacings, and what grows beside it.

    seed : of where the lattice is, in [0, 1/4) cells, by which it is rounded off in another way.
    """
    lattice: Lattice
    weight: Any
    length: int
    h: float = 3.0
    seed: int = 1

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice.name, "weight": self.weight.__name__, "h": self.h,
                "length": self.length, "seed": self.seed}

    @property
    def cells(self) -> tuple[int, int]:
        """Of the lattice in the box."""
        width, height = self.lattice.size
        return round(self.length/width), round(BREADTH/height)

    @property
    def box(self) -> tuple[float, float]:
        """Its length is the wave's."""
        return self.lattice.box(self.cells)

    @property
    def places(self) -> np.ndarray:
        """(n, 2) before the wave, off the centre by a part of a cell."""
        rng = np.random.default_rng(self.seed)
        shift = rng.random(2)*self.lattice.size/4
        return self.lattice.places(self.cells) - shift

    @property
    def gas(self) -> LinearGas:
        """Viscosity and conductivity, in proportion to the length."""
        return LinearGas(DAMPING*self.box[0], 0.0, DAMPING*self.box[0])

    @property
    def time(self) -> float:
        return PERIODS*self.box[0]/SOUND

    @cached_property
    def method(self) -> Spam:
        law = ConstEta(self.gas.eta, self.gas.kappa)
        return fluid(self.weight.of(h=self.h), self.box, IdealGas(), law)

    def start(self) -> np.ndarray:
        """State (5, n): places displaced as the density wants it, isentropic, at rest."""
        x, y = self.places.T
        k = 2*np.pi/self.box[0]
        displaced = x - AMPLITUDE/k*np.sin(k*x)
        e = T*(1 + AMPLITUDE*np.cos(k*x))
        return at_rest(np.stack([displaced, y], axis=1), e)

    @property
    def speed(self) -> float:
        """Rms velocity of the exact wave at the end."""
        matrix = continuum(self.gas, 2*np.pi/self.box[0]).matrix
        amplitudes = expm(matrix*self.time)@np.array([1, 0, 1])
        return float(AMPLITUDE*abs(amplitudes[1])/np.sqrt(2))

    @property
    def cost(self) -> float:
        return 4e-5*self.length**2

    @property
    def label(self) -> str:
        return "ringing " + " ".join(map(str, self.columns.values()))

    def run(self, report: Report, folder: Path) -> Outcome:
        longest = STUDIES*step_limit(self.method, T)
        steps = int(np.ceil(self.time/longest))
        plan = Plan(dt=self.time/steps, steps=steps, series={"v": across}, every=2)
        foretold = grown(motions(self), self.time, plan.dt, rounding(self.places))
        try:
            measured = run(self.method, self.start(), plan).series["v"][-1]
        except Divergence:
            measured = np.nan
        return Outcome({"ringing": [
            {**self.columns, "wave": self.speed, "foretold": foretold, "across": measured}]})


def across(sums: Any, state: np.ndarray) -> float:
    """Rms velocity along y."""
    v = sums.method.fields(state).v[:, 1]
    return float(np.sqrt(np.mean(v**2)))


def motions(wave: Ringing) -> list[LatticeMotion]:
    """Of each wave vector the motion of least omega^2, about rest at T = 1, mass 1; rates with friction."""
    k = wave.lattice.vectors(wave.cells)
    symbols = sums(wave.method.weight, wave.lattice, k)
    squares, a = np.linalg.eigh(matrices(symbols, wave.method.eos, T))
    rates = rates_of(wave.method, symbols, T).real.max(axis=1)
    return [*map(LatticeMotion, k, a[:, :, 0], squares[:, 0], rates)]


def rounding(x: np.ndarray) -> np.ndarray:
    """(2,): rms of what is rounded off from places x (n, 2), uniform within half of the last digit."""
    return np.sqrt(np.mean(np.spacing(np.abs(x))**2, axis=0)/12)


def grown(motions: Sequence[LatticeMotion], time: float, dt: float, round_off: np.ndarray) -> float:
    """Rms velocity along y at the end, of the sum at the head of this file."""
    total = 0.0
    for _, a, square, s in motions:
        if square < 0 < s:
            seed = a**2@round_off**2*(1 + 1/(2*s*dt))
            c = -s*square/(s**2 - square)
            total += seed*(c*np.exp(s*time)*a[1])**2
    return float(np.sqrt(total/len(motions)))
