"""The stress that particles bear beside friction, measured in flows that a force holds.

A gas of T = 1 is in a periodic box or between plates. The force n eta k^2 U v(x) exactly holds the flow
U v(x), whose stress is n eta k U d(x). A run gives a flow A v(x), and three amplitudes of stresses along d:

    excess     n eta k (U - A), the part that friction with the given eta does not bear
    stress     that of the pressure sum, the deviator of 1/2 sum_j m (P_i/rho_i^2 + P_j/rho_j^2) r_ji grad w
    kinetic    that of the particles' noise

A fluid has none of these: M_i = sum_j V_j r_ji grad w is the unit matrix there, so that P M_i is a pressure.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.sides import Periodic
from particles.limits import lattice_sums, step_limit
from particles.pairs import entries
from particles.run import Plan, Run, run
from particles.smooth.spam import Spam
from particles.smooth.sums import Nested, SmoothSums
from studies.build import spam
from studies.build.scenes import Tile
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, mean, with_errors
from studies.kit.table import Row

SETTLED = 1/3           # part of a run before means are taken: at least three turns of the flow
LOOKS = 10              # samples in the time in which friction slows a flow by e
ETA = 0.01              # over L: viscosity of KHP95's gas at Ra 10 000
CHANNEL = 25            # columns of flows along x: too few for the longer waves that shear makes unstable
Flowing = Callable[[np.ndarray], np.ndarray]     # of phases k (x, y), (2, n)
#: today's smooth particles that are stirred, too
MAKERS = ("sph", "riemann", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM", "MFM-adiabatic")


# --- sums with a force ---------------------------------------------------------------------------


class Mode(NamedTuple):
    """A flow U v of wave number k = halves pi/L. Its rate of strain ((xx - yy)/2, xy) is n U k/2 times d."""
    name: str
    v: Flowing
    d: Flowing
    n: int = 1
    halves: int = 2
    phase: float = 0.0


def swirl(p: np.ndarray) -> np.ndarray:
    """Taylor-Green vortices, whose advection is balanced by a pressure."""
    return np.array([np.sin(p[0])*np.cos(p[1]), -np.cos(p[0])*np.sin(p[1])])


def stretch(p: np.ndarray) -> np.ndarray:
    return np.array([np.cos(p[0])*np.cos(p[1]), 0*p[0]])


def slide(p: np.ndarray) -> np.ndarray:
    return np.array([np.sin(p[1]), 0*p[0]])


def slope(p: np.ndarray) -> np.ndarray:
    return np.array([0*p[0], np.cos(p[1])])


STIRRED = Mode("stirred", swirl, stretch, n=2)
SHEARED = Mode("sheared", slide, slope)
PLATES = Mode("plates", slide, slope, halves=1, phase=np.pi/2)


@dataclass(frozen=True, kw_only=True)
class Driven(Spam):
    """Smooth particles with a force that holds the flow U v of a mode."""
    mode: Mode
    U: float

    @property
    def k(self) -> float:
        return self.mode.halves*np.pi/self.box[1]

    @property
    def friction(self) -> float:
        """Amplitude of the stress of friction in a flow of amplitude 1."""
        return self.mode.n*self.law.eta*self.k

    def v(self, state: np.ndarray) -> np.ndarray:
        return self.mode.v(self.k*state[:2] + self.mode.phase)

    def d(self, state: np.ndarray) -> np.ndarray:
        return self.mode.d(self.k*state[:2] + self.mode.phase)


class Push(SmoothSums):
    """Sums with the force, at constant energies."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        method = self.method
        out[2:4] += method.friction*method.k*method.U*method.v(state)
        out[4] = 0.0


#: class of sums -> the same with the force
PUSHED = {kind: type(kind.__name__, (Push, kind), {}) for kind in (
    Nested, *(spam.TODAY[name].transport for name in MAKERS))}


def stresses(sums: Any) -> np.ndarray:
    """Components (xx - yy)/2 and xy (2, n) of the stress of the pressure sum, for each particle."""
    around, pairs, n = sums.around, sums.around.pairs, sums.n
    row, entry = entries(pairs, np.arange(n))
    near, wx, wy = pairs.near[entry], pairs.wx[entry], pairs.wy[entry]
    P = sums.less/around.rho**2
    fx, fy = (P[row] + P[near])*np.array([wx, wy])
    dx, dy = (q[row] - q[near] for q in (around.x, around.y))
    return np.array([np.bincount(row, q, n)/4 for q in (fx*dx - fy*dy, fx*dy + fy*dx)])


# --- a run ----------------------------------------------------------------------------------------


class Layer(Tile):
    """A tile between plates at rest, periodic along x."""
    sides = Periodic()


def of_pressure(sums: Any, state: np.ndarray) -> float:
    """Amplitude of the stress of the pressure sum."""
    return amplitude(stresses(sums), sums.method.d(state))


def of_noise(sums: Any, state: np.ndarray) -> float:
    """Amplitude of the stress -rho v v of velocities less the flow."""
    u, v = state[2:4] - of_flow(sums, state)*sums.method.v(state)
    return amplitude(np.array([(v*v - u*u)/2, -u*v]), sums.method.d(state))


def of_flow(sums: Any, state: np.ndarray) -> float:
    """Amplitude A of the flow."""
    return amplitude(state[2:4], sums.method.v(state))


def amplitude(field: np.ndarray, shape: np.ndarray) -> float:
    """Amplitude of a shape in a field, both (2, n), by least squares."""
    return float(np.sum(field*shape)/np.sum(shape**2))


def in_rows(sums: Any, state: np.ndarray) -> np.ndarray:
    """Number of particles and their momentum along x in each row (2, rows)."""
    L = sums.method.box[1]
    row = np.clip((state[1] + L/2).astype(int), 0, round(L) - 1)
    return np.array([np.bincount(row, q, round(L)) for q in (np.ones(sums.n), state[2])])


def slip_length(rows: np.ndarray, h: float) -> float:
    """Distance beyond a plate, in spacings, at which the velocity would vanish: s L/(pi V), from a fit of
    s + V cos(pi y/L) farther than h from the plates."""
    L = rows.shape[1]
    y = np.arange(L) + 0.5 - L/2
    far = np.abs(y) < L/2 - h
    s, V = np.linalg.lstsq(np.stack([np.ones(L), np.cos(np.pi*y/L)], axis=1)[far], (rows[1]/rows[0])[far],
                           rcond=None)[0]
    return float(s*L/(np.pi*V))


class Stirred(Case, table="driven", same="variant mode rows U thick seed"):
    """One flow. U : exact amplitude, as at the start. thick : eta over that of Ra 10 000. time : duration in
    times of friction."""
    variant: Any
    mode: Mode = STIRRED
    rows: int
    U: float = 0.2
    thick: float = 1.0
    time: float = 8.0
    seed: int = 1

    @property
    def width(self) -> int:
        return self.rows if self.mode is STIRRED else CHANNEL

    @property
    def cost(self) -> float:
        steps = self.time*self.rows/(ETA*4*self.thick*self.mode.halves**2*self.mode.n)
        return 0.2 + 7e-7*self.variant.h*self.width*self.rows*steps

    @property
    def method(self) -> Driven:
        eta = ETA*self.thick*self.rows
        kind = Layer if self.mode is PLATES else Tile
        scene = kind(width=float(self.width), L=float(self.rows), law=ConstEta(eta, eta))
        plain = vars(spam.method(scene, self.variant))
        pushed = plain | {"transport": PUSHED[self.variant.transport]}
        return Driven(**pushed, mode=self.mode, U=self.U)

    def measure(self, report: Report) -> Iterator[Row]:
        method = self.method
        scene = Tile(width=method.box[0], L=method.box[1], law=method.law)
        state = spam.at_rest(spam.scattered(scene, self.seed), 1.0)
        state[2:4] = self.U*method.v(state)
        dt = self.variant.step*step_limit(method, 1.0)
        once = 1/(method.friction*method.k)     # time of friction at density 1
        steps = round(self.time*once/dt)
        series = {"A": of_flow, "kinetic": of_noise}
        if self.variant.name not in MAKERS:     # whose pressures have no one tensor
            series["stress"] = of_pressure
        plan = Plan(dt=dt, steps=steps, every=max(1, round(once/LOOKS/dt)), series=series,
                    means={"rows": in_rows}, mean_from=SETTLED*self.time*once)
        yield self.row(method, run(method, state, plan, report))

    def row(self, method: Driven, done: Run) -> Row:
        """A row of the table `driven`, with means over the late part of a run."""
        late = {name: mean(values[round(SETTLED*len(values)):]) for name, values in done.series.items()}
        A, stress = late["A"], late.get("stress", Measured(np.nan, np.nan))
        slip = slip_length(done.means["rows"], method.weight.h) if self.mode is PLATES else np.nan
        return {
            "h": self.variant.h, "walls": self.variant.walls.__name__, "P": 1 - self.variant.fraction,
            "symbol": symbol(method), "slip": slip, "friction": method.friction*A.value, "cpu_s": done.cpu_s,
            **with_errors(flow=A/self.U, excess=method.friction*(self.U - A), stress=stress,
                          kinetic=late["kinetic"])}


def symbol(method: Driven) -> float:
    """Friction of the scheme on a square lattice over the exact one, at the wave number of the flow."""
    k = method.k*np.array([method.mode is STIRRED, 1.0])
    sums = lattice_sums(method.weight, 1.0, 1.0, k[None])
    return float(getattr(sums, method.transport.symbol)[0]/(k@k))
