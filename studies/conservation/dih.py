"""Sums of the scheme in d dimensions, edge by edge in numpy, over long runs as cases    [RR98 Eqs 34-38]

With bulk viscosity, with the inner sums of Eq. 37 as printed, and with a pressure that is not symmetric in ij, which cannot
conserve.
"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas, energy, pressure
from particles.integral.dih import Dih, Nested, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.integrators import RK4
from particles.threads import Team
from studies.build.disorder import Disorder
from studies.conservation.drift import EVERYTHING, OF_LIMIT, sizes, worst
from studies.conservation.sums import Watch, exact_sums, kinetic, parts, random_fields
from studies.kit.case import Case, Outcome, Report

COUNTS = {1: (32,), 2: (6, 6), 3: (4, 4, 4)}
ETA, SIZE = 0.1, 0.1


@dataclass(frozen=True, kw_only=True)
class OneSided(Dih):
    """The pressure of an edge taken as P_ij + P_ij by its first point and P_ji + P_ji by its second: not symmetric in ij."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`; the first point gets P_ij - P_ji more, the second as much, instead of its negative."""
        super().rates(state, out)
        flow, edges = self.flow(state), self.edges
        i, j, half = edges.i, edges.j, edges.S/2
        P_ij, P_ji = (pressure(self.eos, flow.rho[a], energy(self.eos, flow.rho[a], flow.T[b])) for a, b in ((i, j), (j, i)))
        more = (P_ij - P_ji)[:, None]*half
        for row, flux in zip(out[1:-1], more.T, strict=True):
            row -= (np.bincount(i, flux, edges.n) + np.bincount(j, flux, edges.n))/edges.V


class Form(NamedTuple):
    """A mode: which kind of fluid, its transport, what it claims to conserve, eta = kappa, the rms of the random start."""
    name: str
    kind: Callable[..., Dih] = Dih
    transport: Any = Pairwise()
    claimed: str = EVERYTHING
    eta: float = ETA
    size: float = SIZE


FORMS = {form.name: form for form in (Form("pairwise"), Form("unmended", transport=Pairwise(mended=False)),
                                      Form("everywhere", transport=Pairwise(everywhere=True)),
                                      Form("nested", transport=Nested()),
                                      Form("printed", transport=Nested(differences=False)),
                                      Form("one-sided", OneSided, claimed="mass energy"),
                                      Form("ideal", eta=0.0, size=1e-4))}


@dataclass(frozen=True, kw_only=True)
class DihDrift(Case):
    """A long run from a random start in d dimensions."""
    form: Form
    d: int
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    zeta: float = 0.0
    steps: int = 10_000
    seed: int = 1
    wall: ClassVar[str] = "periodic"

    @property
    def cost(self) -> float:
        return self.steps*{1: 5e-4, 2: 1.5e-3, 3: 1.5e-3}[self.d]

    @property
    def claimed(self) -> str:
        return self.form.claimed

    @property
    def label(self) -> str:
        return (f"dih {self.form.name} {self.d}D {self.maker} {self.weight.__name__} h {self.h:g}, {self.disorder.name}, zeta "
                f"{self.zeta:g}")

    def points(self) -> Points:
        """Where the points are."""
        return self.disorder.make(COUNTS[self.d], self.disorder.size, self.seed)

    def method(self, points: Points) -> Dih:
        """The scheme on them."""
        return self.form.kind(edges=self.make(points, self.weight.of(h=self.h, d=self.d)), **self.fluid)

    @property
    def fluid(self) -> dict[str, Any]:
        """The gas and its transport."""
        return {"eos": IdealGas(), "law": ConstEta(self.form.eta, self.form.eta), "zeta": self.zeta,
                "transport": self.form.transport}

    def start(self, points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Random rho, v, T."""
        return random_fields(points, self.form.size, self.seed)

    def totals(self, V: np.ndarray, state: np.ndarray) -> np.ndarray:
        """Mass, momentum along each axis, energy."""
        return exact_sums(V, state)

    def limit(self, fluid: Dih, state: np.ndarray) -> float:
        """The largest step."""
        return step_limit(fluid, state)

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.points()
        fluid = self.method(points)
        state = fluid.state(*self.start(points))
        V, dt, integrator = fluid.edges.V, OF_LIMIT*self.limit(fluid, state), RK4(state.shape, Team(1))
        watch, begin = Watch(lambda now: self.totals(V, now), sizes(V, state)), kinetic(V*state[0], V*state[1:-1])
        reached = in_place(integrator, fluid, state, dt, self.steps, watch, report)
        motion = kinetic(V*state[0], V*state[1:-1])/begin
        return Outcome({"drift": [{
            "scheme": "dih", "mode": self.form.name, "d": self.d, "maker": self.maker, "weight": self.weight.__name__,
            "h": self.h, "points": self.disorder.name, "wall": self.wall, "zeta": self.zeta, "seed": self.seed, "n": points.n,
            "steps": self.steps, "reached": reached, "claimed": self.claimed, **worst(watch), "motion": motion}]})


def in_place(integrator: Any, fluid: Any, state: np.ndarray, dt: float, steps: int, watch: Watch, report: Report) -> int:
    """Steps of a run that is looked at now and then, done in place, until its end or until the fluid is none any more."""
    watch(state)
    for before, number in parts(steps):
        taken = advance(integrator, fluid, state, dt, number)
        if taken < number:
            return before + taken
        watch(state)
        report((before + number)/steps)
    return steps


def advance(integrator: Any, fluid: Any, state: np.ndarray, dt: float, steps: int) -> int:
    """Steps taken, in place, until the end or until the fluid is none any more."""
    for step in range(steps):
        try:
            integrator.step(fluid, state, dt)
        except FloatingPointError:
            return step
    return steps


def step_limit(fluid: Dih, state: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at the hottest point."""
    return limit_by(fluid, state, fluid.edges.fastest, 2*ETA + fluid.zeta)


def limit_by(fluid: Dih, state: np.ndarray, fastest: tuple[float, float], nu: float) -> float:
    """The same of edges, and of images, whose fastest sound and diffusion these are; nu at density 1."""
    flow, (sound, spread) = fluid.flow(state), fastest
    fast = np.sqrt(2*flow.T.max()) + np.sqrt((flow.v**2).sum(axis=1)).max()
    return float(1/(fast*sound/2.82 + nu/flow.rho.min()*spread/2.78))
