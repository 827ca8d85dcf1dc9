"""Time steps of Eqs 40, 41: what they do to sound on fixed points, and how well they place points that move."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.points import lattice
from particles.integral.rr98_moving_plain import ConstantMass, Literal
from particles.integrators import RK4, Euler, TwoStep
from particles.weights import Lucy
from studies.conservation.motions.scene import (
    AMPLITUDE,
    GAS,
    STILL,
    C,
    by_halves,
    march,
    moving,
    rate,
    seen_slope,
    seen_stiffness,
    strip,
)
from studies.kit.case import Case, Outcome, Report

ETA, ZETA, KAPPA = 0.2, 0.1, 0.2
LIMIT = (ETA + ZETA + KAPPA/2)/C**2      # of forward Euler, rho = 1
SAMPLES = 12        # a period: roots of a recurrence are told apart best when samples are neither dense nor sparse
INTEGRATORS = {"euler": Euler, "two-step": TwoStep, "rk4": RK4}


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """Growth rate of standing sound on fixed points, forward Euler [Eq. 40] with dt = so many times the predicted limit.

    The error is what the halves of the run, four periods, differ by. history : amplitudes are kept as well.
    """
    name: str
    transport: Any
    wavelength: int
    of_limit: float
    history: bool = False
    h: float = 2.0
    periods: float = 4.0

    @property
    def cost(self) -> float:
        return 5e-5*self.wavelength**2/self.of_limit

    @property
    def label(self) -> str:
        return f"euler {self.name}, wavelength {self.wavelength}, {self.of_limit:g} of the limit"

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k, dt = strip(self.wavelength, 5), 2*np.pi/self.wavelength, self.of_limit*LIMIT
        weight, wave = Lucy.of(h=self.h), np.sin(k*at.x[:, 0])
        dih = Dih(edges=renormalised(at, weight), eos=GAS, law=ConstEta(ETA, KAPPA), zeta=ZETA, transport=self.transport)
        v, one = np.stack([AMPLITUDE*wave, 0*wave], axis=1), np.ones(at.n)
        every = max(1, round(self.wavelength/C/SAMPLES/dt))
        steps = round(self.periods*self.wavelength/C/dt/every)*every
        seen = np.array(march(dih, dih.state(one, v, one), dt, steps, lambda state: float(state[1]@wave), Euler))[::every]
        growth = by_halves(seen, lambda part: rate(part, every*dt).real)
        f = seen_slope(weight, at, k)
        predicted = f*f*k*k*(C**2*dt - (ETA + ZETA + KAPPA/2))/2
        rows = {"euler": [{"transport": self.name, "wavelength": self.wavelength, "dt_over_limit": self.of_limit,
                           "growth": growth.value, "growth_err": growth.err, "predicted": predicted}]}
        if self.history:
            times = np.arange(len(seen))*every*dt
            rows["history"] = [{"dt_over_limit": self.of_limit, "time": t, "amplitude": s/seen[0],
                                "predicted": np.exp(predicted*t)} for t, s in zip(times, seen, strict=True)]
        return Outcome(rows)


@dataclass(frozen=True, kw_only=True)
class Share(Case):
    """Growth rate of standing sound without viscosity, literal motion, over dt omega^2/2.

    Positions carry 2 g of 2 f^2 + 2 g parts of omega^2: new velocities [Eq. 41] take these out of the growth.
    """
    integrator: str
    dt: float
    wavelength: int = 16
    h: float = 3.0

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k = strip(self.wavelength), 2*np.pi/self.wavelength
        weight, wave = Lucy.of(h=self.h), np.sin(k*at.x[:, 0])
        method = moving(Literal, at, weight)
        v, one = np.stack([AMPLITUDE*wave, 0*wave], axis=1), np.ones(at.n)
        every = max(1, round(self.wavelength/C/1.4/SAMPLES/self.dt))
        steps = round(2*self.wavelength/C/1.4/self.dt/every)*every
        seen = march(method, method.state(at.x, one, v, one), self.dt, steps, lambda state: float(state[3]@wave),
                     INTEGRATORS[self.integrator])
        share = by_halves(np.array(seen[::every]), lambda part: 2*grows(part, every*self.dt)/self.dt)
        f, g = seen_slope(weight, at, k), seen_stiffness(weight, at, k)
        return Outcome({"shares": [{"integrator": self.integrator, "dt": self.dt, "share": share.value, "share_err": share.err,
                                    "predicted": 1.0 if self.integrator == "euler" else f*f/(f*f + g)}]})


def grows(series: np.ndarray, dt: float) -> float:
    """Growth rate over omega^2."""
    found = rate(series, dt)
    return found.real/found.imag**2


# --- places of points after a time -----------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Flowing:
    """A flow that moves points: kind of motion, counts of the lattice, viscosity, time, coarsest number of steps."""
    name: str
    kind: type
    counts: tuple[int, int]
    law: ConstEta
    time: float
    steps: int


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
#: sound for one and a half periods: after whole ones the errors of some integrators are small by chance
MOVED = (Flowing(name="sound", kind=Literal, counts=(16, 7), law=STILL, time=13.0, steps=60),
         Flowing(name="sound", kind=ConstantMass, counts=(16, 7), law=STILL, time=18.9, steps=80),
         Flowing(name="vortices", kind=ConstantMass, counts=(12, 12), law=ConstEta(0.2, 0.2), time=10.0, steps=80))


@dataclass(frozen=True, kw_only=True)
class Places(Case):
    """Rms error of positions after a time, over the rms displacement, for so many steps, twice and four times as many.

    Against RK4 with the most steps; the error of that reference is what RK4 with half as many differs from it by.
    """
    motion: str
    flow: Flowing
    h: float = 3.0

    @property
    def cost(self) -> float:
        return 1e-4*self.flow.steps*np.prod(self.flow.counts)

    @property
    def label(self) -> str:
        return f"places {self.motion} {self.flow.name}"

    def run(self, report: Report, folder: Path) -> Outcome:
        counts = [self.flow.steps*m for m in (1, 2, 4)]
        exact, coarse = (self.places(RK4, n) for n in counts[:0:-1])
        start = lattice(self.flow.counts).x
        moved, known = rms(exact - start), rms(exact - coarse)
        rows = [{"motion": self.motion, "flow": self.flow.name, "integrator": name, "steps": n, "dt": self.flow.time/n,
                 "error": rms(self.places(INTEGRATORS[name], n) - exact)/moved, "error_err": known/moved}
                for name in ("euler", "two-step") for n in counts]
        return Outcome({"steps": rows})

    def places(self, integrator: Any, steps: int) -> np.ndarray:
        """Positions (n, 2) at the end."""
        at = lattice(self.flow.counts)
        method = moving(self.flow.kind, at, Lucy.of(h=self.h), self.flow.law, transport=Pairwise())
        state = method.state(at.x, *FLOWS[self.flow.name](at.x, at.box))
        march(method, state, self.flow.time/steps, steps, lambda state: None, integrator)
        return state[:2].T.copy()


def rms(x: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(x**2)))
