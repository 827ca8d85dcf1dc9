"""Runs in numpy, edge by edge: in one to three dimensions [RR98 Eqs 34-38], on moving points [Eqs 39-49]."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.linalg import norm

from continuum.fluid import ConstEta, IdealGas, energy, pressure
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import exact
from particles.integral.points import Points, lattice
from particles.integral.rr98_moving_plain import Motion
from particles.integrators import RK4, Euler, TwoStep
from particles.weights import Lucy
from studies.build.setting import DISORDERS, Disorder
from studies.conservation.motions import C, march, moving
from studies.conservation.sums import (
    EVERYTHING,
    OF_LIMIT,
    Advance,
    WatchedRun,
    exact_sums,
    in_numpy,
    in_parts,
    random_fields,
)
from studies.kit.case import Case, Outcome, Report

ETA, ZETA, SIZE = 0.1, 0.05, 0.1
LOOKS = 100             # at runs that lose momentum
SIDE, H = 6, 2.7        # of the box of points that move, range of their weights


class SmallBox(NamedTuple):
    """How many points along each axis, range of the weight, seconds a step."""

    counts: tuple[int, ...]
    h: float
    cost: float


LINE, SQUARE = SmallBox((32,), 3.0, 5e-4), SmallBox((6, 6), 2.8, 1.5e-3)
CUBE = SmallBox((4, 4, 4), 1.9, 1.5e-3)


@dataclass(frozen=True, kw_only=True)
class DihDrift(WatchedRun):
    """Shifted points with exact edges. transport : of `dih`, `mode` its name."""

    mode: str
    transport: Any
    box: SmallBox
    disorder: Disorder = DISORDERS["jittered-0.1"]
    scheme = "dih"
    kind: ClassVar[type[Dih]] = Dih

    @property
    def cost(self) -> float:
        return self.steps*self.box.cost

    def columns(self) -> dict[str, Any]:
        return {"mode": self.mode, "d": len(self.box.counts), "maker": "exact", "weight": "Lucy",
                "h": self.box.h, "points": self.disorder.name, "zeta": ZETA, "claimed": EVERYTHING}

    def points(self) -> Points:
        return self.disorder.make(self.box.counts, self.disorder.size, self.seed)

    def method(self, points: Points) -> Dih:
        edges = exact(points, Lucy.of(h=self.box.h, d=points.d))
        return self.kind(edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), zeta=ZETA,
                         transport=self.transport)

    def start(self, method: Dih, points: Points) -> np.ndarray:
        return method.state(*random_fields(points, SIZE, self.seed))

    def advance(self, method: Dih, state: np.ndarray) -> Advance:
        return in_numpy(method, state, OF_LIMIT*step_limit(method, state))


def step_limit(fluid: Dih, state: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at the hottest point."""
    flow = fluid.flow(state)
    sound, spread = fluid.edges.fastest
    fast = np.sqrt(2*flow.T.max()) + np.sqrt((flow.v**2).sum(axis=1)).max()
    nu = (2*ETA + fluid.zeta)/flow.rho.min()
    return float(1/(fast*sound/2.82 + nu*spread/2.78))


# --- a pressure that is not symmetric -----------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class OneSided(Dih):
    """The first point of an edge feels the pressure 2 P_ij, the second 2 P_ji: not symmetric in ij."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`: both points get P_ij - P_ji more, instead of one its negative."""
        super().rates(state, out)
        flow, edges = self.flow(state), self.edges
        rho, T, i, j = flow.rho, flow.T, edges.i, edges.j
        P_ij = pressure(self.eos, rho[i], energy(self.eos, rho[i], T[j]))
        P_ji = pressure(self.eos, rho[j], energy(self.eos, rho[j], T[i]))
        more = (P_ij - P_ji)[:, None]*(edges.S/2)
        for row, flux in zip(out[1:-1], more.T, strict=True):
            row -= (np.bincount(i, flux, edges.n) + np.bincount(j, flux, edges.n))/edges.V


@dataclass(frozen=True, kw_only=True)
class Unsymmetric(DihDrift):
    """Momentum that an unsymmetric pressure loses on a line, until the last look before a run diverged."""

    mode: str = "one-sided"
    transport: Any = Pairwise()  # noqa: RUF009 (immutable)
    box: SmallBox = LINE
    kind = OneSided

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.points()
        fluid = self.method(points)
        state = self.start(fluid, points)
        _, size, _ = self.sizes(fluid, state)
        momenta: list[float] = []

        def look(now: np.ndarray) -> None:
            _, momentum, _ = exact_sums(fluid.edges.V, now)
            momenta.append(momentum)
        look(state)
        looks = min(LOOKS, self.steps)
        in_parts(self.advance(fluid, state), state, self.steps, look, report, looks)
        reached = self.steps*(len(momenta) - 1)//looks
        return Outcome({"losses": [{
            "maker": "exact", "points": self.disorder.name, "seed": self.seed, "steps": self.steps,
            "reached": reached, "lost": abs(momenta[-1] - momenta[0])/size}]})


# --- points that move ---------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class MotionDrift(WatchedRun):
    """Vortices and sound on a stream, SIDE^2 points that move, a viscous gas; watched at every step.

    kind : of `rr98_moving_plain.MOTIONS`, `motion` its name. integrator, weight : classes.
    """

    motion: str
    kind: type[Motion]
    integrator: Any = RK4
    weight: Any = Lucy
    disorder: Disorder = DISORDERS["jittered-0.1"]
    dt: float = 0.2
    claimed: str = EVERYTHING
    scheme = "motions"

    @property
    def cost(self) -> float:
        return 5e-4*self.steps*self.integrator.evaluations

    @property
    def records(self) -> int:
        return self.steps

    def columns(self) -> dict[str, Any]:
        return {"mode": f"{self.motion}, {self.integrator.__name__}", "maker": "renormalised",
                "weight": self.weight.__name__, "h": H, "points": self.disorder.name,
                "claimed": self.claimed}

    def points(self) -> Points:
        return self.disorder.make((SIDE, SIDE), self.disorder.size, self.seed)

    def method(self, points: Points) -> Any:
        return moving(self.kind, points, self.weight.of(h=H), ConstEta(0.2, 0.2))

    def start(self, method: Any, points: Points) -> np.ndarray:
        X, Y = (2*np.pi*points.x/points.box).T
        vx = 0.1*(0.5 + np.sin(X)*np.cos(Y))
        vy = 0.1*(0.3 - np.cos(X)*np.sin(Y))
        rho = 1 + 0.05*np.cos(X + Y)
        return method.state(points.x, rho, np.stack([vx, vy], axis=1), 1 + 0.05*np.sin(Y))

    def totals(self, method: Any, state: np.ndarray) -> np.ndarray:
        return method.conserved(state)

    def sizes(self, method: Any, state: np.ndarray) -> np.ndarray:
        mass, *_, total = method.conserved(state)
        fields = method.fields(state)
        m = fields.rho*fields.V
        return np.array([mass, *m@np.abs(fields.v), total])

    def advance(self, method: Any, state: np.ndarray) -> Advance:
        return in_numpy(method, state, self.dt, self.integrator)


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


@dataclass(frozen=True, kw_only=True)
class Places(Case):
    """Rms error of positions over the rms displacement, for so many steps, twice and four times as many.

    Against RK4 with the most steps; the error of that reference is its difference from RK4 with half as many.
    start : rho, v, T of positions and box, `flow` its name.
    """

    motion: str
    kind: type[Motion]
    flow: str
    start: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]
    counts: tuple[int, int]
    law: ConstEta
    time: float
    steps: int

    def run(self, report: Report, folder: Path) -> Outcome:
        counts = [self.steps*m for m in (1, 2, 4)]
        exact, coarse = self.places(RK4, counts[2]), self.places(RK4, counts[1])
        moved = norm(exact - lattice(self.counts).x)
        known = norm(exact - coarse)/moved
        rows = []
        for name, integrator in (("euler", Euler), ("two-step", TwoStep)):
            for n in counts:
                error = norm(self.places(integrator, n) - exact)/moved
                rows.append({"motion": self.motion, "flow": self.flow, "integrator": name, "steps": n,
                             "dt": self.time/n, "error": error, "error_err": known})
        return Outcome({"steps": rows})

    def places(self, integrator: Any, steps: int) -> np.ndarray:
        """Positions (n, 2) at the end."""
        points = lattice(self.counts)
        method = moving(self.kind, points, Lucy.of(h=3.0), self.law, transport=Pairwise())
        state = method.state(points.x, *self.start(points.x, points.box))
        march(method, state, self.time/steps, steps, lambda state: None, integrator)
        return method.fields(state).x
