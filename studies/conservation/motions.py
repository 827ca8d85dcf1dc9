"""Points that move as RR98 prints it: what long runs keep, Eqs 46-48 against 49, the force of Eq. 50"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.brackets import Powers
from particles.integral.dih import NestedFluxes, Pairwise
from particles.integral.points import Points, jittered, lattice
from particles.integral.rr98_moving_plain import (
    MOTIONS,
    ConstantMass,
    Convective,
    Literal,
    convected,
    scale_of,
)
from particles.integrators import RK4, TwoStep
from particles.limits import lattice_sums
from particles.threads import Team
from particles.weights import WEIGHTS, Lucy
from studies.conservation.drift import EVERYTHING, drift_row
from studies.conservation.sums import Watch
from studies.kit.case import Case, Outcome, Report

ALONG, NESTED = Pairwise(mended=False), NestedFluxes()
GAS, STILL, C = IdealGas(), ConstEta(0.0, 0.0), np.sqrt(2.0)      # c^2 = gamma P/rho = 2 at rho = T = 1
AMPLITUDE = 1e-4        # of waves: what is quadratic in it is 1e-4 of what is linear, and of another length
BREADTH = 8             # spacings across a wave: more than twice the widest weight
SIDE, H = 6, 2.7        # of the box of long runs, range of their weights
LENGTH = 32             # spacings of a wave on which equations are evaluated once
KEEP = ("literal", "constant-mass")
POINTS = {"lattice": 0.0, "jittered-0.1": 0.1}
POWERS = ((0, 0), (1, -1), (2, -2), (0, -1), (1, 0), (2, 0), (1, 1), (3, 0))
REYNOLDS = (0.1, 10.0, 1000.0, np.inf)


def strip(wavelength: int, breadth: int = BREADTH) -> Points:
    """Lattice that is one wavelength long, or more waves where one is too short."""
    waves = max(1, -(-breadth//wavelength))
    return lattice((wavelength*waves, breadth))


def moving(kind: Any, points: Points, weight: Any, law: Any = STILL, **more: Any) -> Any:
    """A motion on points with renormalised edges; forces along edges, whose heating most runs do not need."""
    settings = {"transport": ALONG, "scale": scale_of(points, weight), **more}
    return kind(box=tuple(points.box), weight=weight, eos=GAS, law=law, **settings)


def seen_slope(weight: Any, points: Points, k: float) -> float:
    """Wave number that gradients see on the lattice, over k, with the scale of `renormalised`."""
    S = lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])).S
    return float(scale_of(points, weight)*np.abs(S[0, 0])/k)


# --- what is kept -------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class MotionDrift(Case):
    """Vortices and sound on a stream, SIDE^2 points that move, a viscous gas; sums are watched at every step.

    kind, weight, integrator : classes. points : of POINTS.
    """

    motion: str
    kind: type
    integrator: Any = RK4
    weight: Any = Lucy
    points: str = "jittered-0.1"
    dt: float = 0.2
    steps: int = 10_000

    @property
    def cost(self) -> float:
        return 5e-4*self.steps*self.integrator.evaluations

    @property
    def label(self) -> str:
        return f"motions {self.motion} {self.weight.__name__} {self.points} {self.integrator.__name__}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = jittered((SIDE, SIDE), POINTS[self.points], 1)
        method = moving(self.kind, points, self.weight.of(h=H), ConstEta(0.2, 0.2))
        state = method.state(points.x, *stirred(points))
        sums, v = method.conserved(state), method.fields(state).v
        m = method.fields(state).rho/len(v)
        momentum = np.abs(m[:, None]*v).sum(axis=0)*sums[0]/m.sum()
        watch = Watch(method.conserved, np.array([sums[0], *momentum, sums[-1]]))
        watch(state)
        stepper = self.integrator(state.shape, Team(1))
        for step in range(self.steps):
            stepper.step(method, state, self.dt)
            watch(state)
            if step % 256 == 0:
                report(step/self.steps)
        return drift_row(
            watch, scheme="motions", mode=f"{self.motion}, {self.integrator.__name__}", maker="renormalised",
            weight=self.weight.__name__, h=H, points=self.points, wall="periodic", seed=1, n=points.n,
            steps=self.steps, reached=self.steps, claimed=EVERYTHING if self.motion in KEEP else "nothing",
            motion=np.nan)


def stirred(points: Points) -> tuple[np.ndarray, ...]:
    """Vortices and sound on a stream: rho, v, T."""
    X, Y = (2*np.pi*points.x/points.box).T
    v = 0.1*np.stack([0.5 + np.sin(X)*np.cos(Y), 0.3 - np.cos(X)*np.sin(Y)], axis=1)
    return 1 + 0.05*np.cos(X + Y), v, 1 + 0.05*np.sin(Y)


# --- equations evaluated once -------------------------------------------------------------------


def acceleration(method: Any, state: np.ndarray) -> np.ndarray:
    """dv/dt, (d, n), of dp/dt - v dm/dt."""
    d, rates = method.places, np.empty_like(state)
    method.rates(state, rates)
    m, dm, dp = state[d], rates[d], rates[d + 1:2*d + 1]
    return (dp - method.velocity(state)*dm)/m


@dataclass(frozen=True, kw_only=True)
class Identity(Case):
    """Accelerations of Eqs 46-48 against those of Eq. 49: random fields on jittered points, 10 x 10.

    Reynolds number: U a/nu with U = 0.1; infinite without viscosity.
    """

    name: str
    transport: Any
    reynolds: float

    def run(self, report: Report, folder: Path) -> Outcome:
        points, eta = jittered((10, 10), 0.2, 2), 0.1/self.reynolds
        exact, other = (self.acceleration(kind, points, eta) for kind in (ConstantMass, Convective))
        difference = float(np.abs(other - exact).max()/np.abs(exact).max())
        known = {"transport": self.name, "reynolds": self.reynolds}
        return Outcome({"identity": [{**known, "convective": difference}]})

    def acceleration(self, kind: type, points: Points, eta: float) -> np.ndarray:
        """Of random fields."""
        rng = np.random.default_rng(0)
        rho, v = rng.uniform(0.9, 1.1, points.n), rng.normal(0, 0.1, (points.n, 2))
        T = rng.uniform(0.9, 1.1, points.n)
        method = moving(kind, points, Lucy.of(h=3.0), ConstEta(eta, eta), transport=self.transport)
        return acceleration(method, method.state(points.x, rho, v, T))


@dataclass(frozen=True, kw_only=True)
class Signs(Case):
    """What Eqs 46-48 add to d/dt over v.grad of smooth fields on a lattice, by least squares."""

    def run(self, report: Report, folder: Path) -> Outcome:
        points, k, weight = strip(LENGTH), 2*np.pi/LENGTH, Lucy.of(h=3.0)
        edges = moving(Convective, points, weight).fluid(points.x, points.V).edges
        x, v = points.x[:, 0], np.tile([0.3, -0.1], (points.n, 1))
        rows = []
        for equation, phase in ((46, 0.0), (47, 0.7), (48, 1.9)):
            exact = -0.3*k*np.sin(k*x + phase)
            [added] = convected(edges, v, np.cos(k*x + phase)[None])
            rows.append({"equation": equation, "wavelength": LENGTH, "factor": added@exact/(exact@exact),
                         "predicted": seen_slope(weight, points, k)})
        return Outcome({"signs": rows})


@dataclass(frozen=True, kw_only=True)
class Brackets(Case):
    """Acceleration by Eq. 50, powers a and b, in a wave without entropy (P = rho^2), over -grad P/rho."""

    a: float
    b: float

    def run(self, report: Report, folder: Path) -> Outcome:
        points, k, weight = strip(LENGTH), 2*np.pi/LENGTH, Lucy.of(h=3.0)
        x, lost = points.x[:, 0], self.a + self.b
        wave = 1 + AMPLITUDE*np.cos(k*x)
        method = moving(ConstantMass, points, weight, bracket=Powers(self.a, self.b))
        along, _ = acceleration(method, method.state(points.x, wave, 0*points.x, wave))
        # -grad rho^2 = 2 k A sin kx
        force = np.mean(along*np.sin(k*x))/(k*AMPLITUDE)
        predicted = seen_slope(weight, points, k)*(1 - lost/2)
        return Outcome({"brackets": [{"a": self.a, "b": self.b, "force": force, "predicted": predicted}]})


def motions(steps: int = 10_000, weights: tuple[type, ...] = tuple(WEIGHTS.values())) -> Iterator[Case]:
    """All motions on jittered points with RK4; on a lattice, with the paper's two steps, those it prints."""
    two: dict[str, Any] = {"integrator": TwoStep, "points": "lattice", "dt": 0.05, "steps": steps}
    yield from (MotionDrift(motion=name, kind=kind, steps=steps) for name, kind in MOTIONS.items())
    yield from (MotionDrift(motion="literal", kind=Literal, weight=weight, **two) for weight in weights)
    yield MotionDrift(motion="convective", kind=Convective, **two)
    yield Signs()
    yield from (Brackets(a=float(a), b=float(b)) for a, b in POWERS)
    for (name, transport), reynolds in product({"nested": NESTED, "pairwise": ALONG}.items(), REYNOLDS):
        yield Identity(name=name, transport=transport, reynolds=reynolds)
