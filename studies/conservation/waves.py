"""Patterns and sound on points that move; what time steps do to sound and to places    [RR98 Eqs 34-50]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.points import Points, lattice
from particles.integral.rr98_moving_plain import MOTIONS, ConstantMass, Literal, scale_of
from particles.integrators import RK4, Euler, TwoStep
from particles.limits import lattice_sums
from particles.threads import Team
from particles.weights import Lucy, WendlandC2
from studies.conservation.motions import AMPLITUDE, GAS, NESTED, STILL, C, moving, seen_slope, strip
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

STREAM = 0.2
DT = 0.2                # of waves on moving points, with RK4
ETA, ZETA, KAPPA = 0.2, 0.1, 0.2
LIMIT = (ETA + ZETA + KAPPA/2)/C**2      # of forward Euler, rho = 1
SAMPLES = 12            # a period: neither dense nor sparse, so that roots of a recurrence differ
INTEGRATORS = {"euler": Euler, "two-step": TwoStep}


def march(method: Any, state: np.ndarray, dt: float, steps: int, look: Callable[[np.ndarray], Any],
          integrator: Any = RK4) -> list[Any]:
    """look(state) before the first and after every step."""
    stepper, seen = integrator(state.shape, Team(1)), [look(state)]
    for _ in range(steps):
        stepper.step(method, state, dt)
        seen.append(look(state))
    return seen


def amplitude(q: np.ndarray, x: np.ndarray, k: float) -> complex:
    """Mean of (q - <q>) exp(-ikx)."""
    return complex(np.mean((q - q.mean())*np.exp(-1j*k*x)))


def roots(series: np.ndarray) -> np.ndarray:
    """The two factors a sample by which a series s_n = sum of two powers grows, by least squares."""
    known = np.stack([series[:-2], series[1:-1]], axis=1)
    b, c = np.linalg.lstsq(known, series[2:], rcond=None)[0]
    return np.roots([1.0, -c, -b])


def rate(series: np.ndarray, dt: float) -> complex:
    """Growth rate and i omega, omega > 0, of a wave that stands."""
    rates = np.log(np.asarray(roots(series), complex))/dt
    return complex(rates[np.argmax(rates.imag)])


def by_halves(series: np.ndarray, measure: Callable[[np.ndarray], float]) -> Measured:
    """A number from the whole series; its error is what the two halves differ by."""
    one, other = (measure(half) for half in np.array_split(series, 2))
    return Measured(float(measure(series)), float(abs(one - other)))


def seen_stiffness(weight: Any, points: Points, k: float) -> float:
    """(1/k^2) sum_r w_xx (1 - cos kx): stiffness of a moved lattice, 1 in the continuum."""
    D = lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])).D
    return float(scale_of(points, weight)*D[0, 0, 0]/k**2)


@dataclass(frozen=True, kw_only=True)
class Pattern(Case):
    """Speed of a density wave under uniform pressure over that of the stream that carries it, no viscosity.

    kind : of `rr98_moving_plain.MOTIONS`. The error is what the halves of the run differ by.
    """

    motion: str
    kind: type
    wavelength: int
    time: float = 10.0

    @property
    def label(self) -> str:
        return f"pattern {self.motion}, wavelength {self.wavelength}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, k, weight = strip(self.wavelength), 2*np.pi/self.wavelength, Lucy.of(h=3.0)
        method = moving(self.kind, points, weight)
        rho = 1 + AMPLITUDE*np.cos(k*points.x[:, 0])
        first = method.state(points.x, rho, np.tile([STREAM, 0.0], (points.n, 1)), 1/rho)
        seen = march(method, first, DT, round(self.time/DT), lambda state: amplitude(state[2], state[0], k))
        speed = by_halves(-np.unwrap(np.angle(seen))/(k*STREAM*DT),
                          lambda part: np.polyfit(np.arange(len(part)), part, 1)[0])
        twice = seen_slope(weight, points, k) if self.motion == "literal" else 0.0
        return Outcome({"patterns": [{
            "motion": self.motion, "h": 3.0, "wavelength": self.wavelength,
            "speed": speed.value, "speed_err": speed.err, "predicted": 1 + twice}]})


@dataclass(frozen=True, kw_only=True)
class MovingSound(Case):
    """Speed of standing sound without viscosity over c, for two periods. weight : class."""

    motion: str
    kind: type
    wavelength: int
    weight: Any = Lucy
    h: float = 3.0

    @property
    def cost(self) -> float:
        return 1e-5*self.wavelength**2*self.h**2

    @property
    def label(self) -> str:
        return f"sound {self.motion}, {self.weight.__name__} h {self.h:g}, wavelength {self.wavelength}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, k = strip(self.wavelength, 2*int(self.h) + 2), 2*np.pi/self.wavelength
        weight, wave = self.weight.of(h=self.h), np.sin(k*points.x[:, 0])
        method, one = moving(self.kind, points, weight), np.ones(points.n)
        first = method.state(points.x, one, AMPLITUDE*np.stack([wave, 0*wave], axis=1), one)
        seen = march(method, first, DT, round(2*self.wavelength/C/DT), lambda state: float(state[3]@wave))
        speed = by_halves(np.array(seen), lambda part: rate(part, DT).imag/(k*C))
        f, g = seen_slope(weight, points, k), seen_stiffness(weight, points, k)
        stiffness = 2*f*f + 2*g if self.motion in ("literal", "convective") else 2*g
        return Outcome({"moving_sound": [{
            "motion": self.motion, "weight": self.weight.__name__, "h": self.h, "wavelength": self.wavelength,
            "speed": speed.value, "speed_err": speed.err, "predicted": np.sqrt(stiffness/2)}]})


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """Growth rate of standing sound on fixed points, forward Euler [Eq. 40], dt over the predicted limit."""

    wavelength: int
    of_limit: float
    h: float = 2.0
    periods: float = 4.0

    @property
    def cost(self) -> float:
        return 5e-5*self.wavelength**2/self.of_limit

    @property
    def label(self) -> str:
        return f"euler, wavelength {self.wavelength}, {self.of_limit:g} of the limit"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, k, dt = strip(self.wavelength, 5), 2*np.pi/self.wavelength, self.of_limit*LIMIT
        weight, wave, one = Lucy.of(h=self.h), np.sin(k*points.x[:, 0]), np.ones(points.n)
        dih = Dih(edges=renormalised(points, weight), eos=GAS, law=ConstEta(ETA, KAPPA), zeta=ZETA,
                  transport=NESTED)
        first = dih.state(one, AMPLITUDE*np.stack([wave, 0*wave], axis=1), one)
        every = max(1, round(self.wavelength/C/SAMPLES/dt))
        steps = round(self.periods*self.wavelength/C/dt/every)*every
        seen = march(dih, first, dt, steps, lambda state: float(state[1]@wave), Euler)[::every]
        growth = by_halves(np.array(seen), lambda part: rate(part, every*dt).real)
        damping = (ETA + ZETA + KAPPA/2 - C**2*dt)/2
        return Outcome({"euler": [{
            "wavelength": self.wavelength, "dt_over_limit": self.of_limit, "growth": growth.value,
            "growth_err": growth.err, "predicted": -damping*(seen_slope(weight, points, k)*k)**2}]})


# --- places of points after a time --------------------------------------------------------------


def sound_flow(x: np.ndarray, box: np.ndarray) -> tuple[np.ndarray, ...]:
    """Sound that travels, so that no phase of it is special: rho, v, T."""
    wave = 0.02*np.sin(2*np.pi*x[:, 0]/box[0])
    return 1 + wave/C, np.stack([wave, 0*wave], axis=1), 1 + wave/C


def vortex_flow(x: np.ndarray, box: np.ndarray) -> tuple[np.ndarray, ...]:
    """Taylor-Green vortices, the pressure in balance: rho, v, T."""
    (X, Y), u = (2*np.pi*x/box).T, 0.1
    v = u*np.stack([np.sin(X)*np.cos(Y), -np.cos(X)*np.sin(Y)], axis=1)
    return np.ones(len(x)), v, 1 + u*u/4*(np.cos(2*X) + np.cos(2*Y))


FLOWS = {"sound": sound_flow, "vortices": vortex_flow}


@dataclass(frozen=True, kw_only=True)
class Places(Case):
    """Rms error of positions over the rms displacement, for so many steps, twice and four times as many.

    Against RK4 with the most steps; the error of that reference is its difference from RK4 with half as many.
    """

    motion: str
    flow: str
    kind: type
    counts: tuple[int, int]
    law: ConstEta
    time: float
    steps: int

    @property
    def cost(self) -> float:
        return 1e-4*self.steps*np.prod(self.counts)

    @property
    def label(self) -> str:
        return f"places {self.motion} {self.flow}"

    def run(self, report: Report, folder: Path) -> Outcome:
        counts = [self.steps*m for m in (1, 2, 4)]
        exact, coarse = self.places(RK4, counts[2]), self.places(RK4, counts[1])
        moved, known = rms(exact - lattice(self.counts).x), rms(exact - coarse)
        errors = {(name, n): rms(self.places(kind, n) - exact)
                  for (name, kind), n in product(INTEGRATORS.items(), counts)}
        return Outcome({"steps": [{
            "motion": self.motion, "flow": self.flow, "integrator": name, "steps": n, "dt": self.time/n,
            "error": error/moved, "error_err": known/moved} for (name, n), error in errors.items()]})

    def places(self, integrator: Any, steps: int) -> np.ndarray:
        """Positions (n, 2) at the end."""
        points = lattice(self.counts)
        method = moving(self.kind, points, Lucy.of(h=3.0), self.law, transport=Pairwise())
        state = method.state(points.x, *FLOWS[self.flow](points.x, points.box))
        march(method, state, self.time/steps, steps, lambda state: None, integrator)
        return method.fields(state).x


def rms(x: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(x**2)))


#: sound for one and a half periods: after whole ones the errors of some integrators are small by chance
MOVED = (
    Places(motion="literal", flow="sound", kind=Literal, counts=(16, 7), law=STILL, time=13.0, steps=60),
    Places(motion="constant-mass", flow="sound", kind=ConstantMass, counts=(16, 7), law=STILL, time=18.9,
           steps=80),
    Places(motion="constant-mass", flow="vortices", kind=ConstantMass, counts=(12, 12),
           law=ConstEta(0.2, 0.2), time=10.0, steps=80))


def waves(size: str) -> Iterator[Case]:
    """`quick` has one wavelength and long steps."""
    quick = size == "quick"
    for (name, kind), wavelength in product(MOTIONS.items(), (8,) if quick else (8, 16, 24, 32)):
        yield Pattern(motion=name, kind=kind, wavelength=wavelength)
        yield MovingSound(motion=name, kind=kind, wavelength=wavelength)
        if name != "carried" and not quick:
            yield MovingSound(motion=name, kind=kind, wavelength=wavelength, weight=WendlandC2, h=4.0)
    for wavelength, of_limit in product((8,) if quick else (8, 16, 32, 64), (0.5, 1.0, 1.5)):
        yield Growth(wavelength=wavelength, of_limit=of_limit)
    yield from (replace(case, steps=case.steps//8) if quick else case for case in MOVED)
