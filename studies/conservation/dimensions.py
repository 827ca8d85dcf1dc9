"""Long runs in one, two and three dimensions, summed edge by edge in numpy    [RR98 Eqs 34-38]

With bulk viscosity, the inner sums of Eq. 37 as printed, and a pressure that is not symmetric in ij.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas, energy, pressure
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import Points
from particles.integrators import RK4
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import DISORDERS
from studies.conservation.drift import EVERYTHING, OF_LIMIT, drift_row
from studies.conservation.sums import RECORDS, Watch, exact_sums, kinetic, parts, random_fields, sizes
from studies.kit.case import Case, Outcome, Report

COUNTS = {1: (32,), 2: (6, 6), 3: (4, 4, 4)}
RANGE = {1: 3.0, 2: 2.8, 3: 1.9}
ETA, ZETA, SIZE = 0.1, 0.05, 0.1
LOOKS = 100             # at runs that lose momentum


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


class Form(NamedTuple):
    """Which kind of fluid, its transport, the sums that should stay."""

    name: str
    kind: Callable[..., Dih] = Dih
    transport: Any = Pairwise()
    claimed: str = EVERYTHING


FORMS = {form.name: form for form in (
    Form("pairwise"),
    Form("unmended", transport=Pairwise(mended=False)),
    Form("everywhere", transport=Pairwise(everywhere=True)),
    Form("nested", transport=NestedFluxes()),
    Form("printed", transport=NestedFluxes(differences=False)),
    Form("one-sided", OneSided, claimed="mass energy"))}


@dataclass(frozen=True, kw_only=True)
class DihDrift(Case):
    """A long run from a random start in d dimensions, on shifted points with exact edges."""

    form: Form
    d: int
    maker: str = "exact"
    points: str = "jittered-0.1"
    steps: int = 10_000
    seed: int = 1

    @property
    def cost(self) -> float:
        return self.steps*{1: 5e-4, 2: 1.5e-3, 3: 1.5e-3}[self.d]

    @property
    def label(self) -> str:
        return f"dih {self.form.name} {self.d}D, seed {self.seed}"

    def at(self) -> Points:
        """Where the points are."""
        kind = DISORDERS[self.points]
        return kind.make(COUNTS[self.d], kind.size, self.seed)

    def method(self, at: Points) -> Dih:
        """The scheme on them."""
        edges = MAKERS[self.maker](at, Lucy.of(h=RANGE[self.d], d=self.d))
        return self.form.kind(edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), zeta=ZETA,
                              transport=self.form.transport)

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.at()
        fluid = self.method(at)
        state = fluid.state(*random_fields(at, SIZE, self.seed))
        first = fluid.fields(state)
        watch = Watch(lambda now: exact_sums(fluid.edges.V, now), sizes(fluid.eos, first))
        begin = kinetic(first)
        reached = in_place(fluid, state, self.steps, watch, report)
        return drift_row(
            watch, scheme="dih", mode=self.form.name, d=self.d, maker=self.maker, weight="Lucy",
            h=RANGE[self.d], points=self.points, wall="periodic", zeta=ZETA, seed=self.seed, n=at.n,
            steps=self.steps, reached=reached, claimed=self.form.claimed,
            motion=kinetic(fluid.fields(state))/begin)


@dataclass(frozen=True, kw_only=True)
class Unsymmetric(DihDrift):
    """Momentum that an unsymmetric pressure loses, until the last look before a run diverged."""

    form: Form = FORMS["one-sided"]
    d: int = 1

    @property
    def label(self) -> str:
        return f"unsymmetric pressure, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        at = self.at()
        fluid = self.method(at)
        state = fluid.state(*random_fields(at, SIZE, self.seed))
        size = sizes(fluid.eos, fluid.fields(state))[1]
        seen: list[float] = []

        def look(now: np.ndarray) -> None:
            _, momentum, _ = exact_sums(fluid.edges.V, now)
            seen.append(momentum)
        looks = min(LOOKS, self.steps)
        in_place(fluid, state, self.steps, look, report, looks)
        reached = self.steps*(len(seen) - 1)//looks
        return Outcome({"losses": [{
            "maker": self.maker, "points": self.points, "seed": self.seed, "steps": self.steps,
            "reached": reached, "lost": abs(seen[-1] - seen[0])/size}]})


def in_place(fluid: Dih, state: np.ndarray, steps: int, look: Callable[[np.ndarray], None], report: Report,
             records: int = RECORDS) -> int:
    """Steps of a run that is looked at now and then, in place, until its end or until it diverges."""
    stepper, dt = RK4(state.shape, Team(1)), OF_LIMIT*step_limit(fluid, state)
    look(state)
    for before, number in parts(steps, records):
        for step in range(number):
            try:
                stepper.step(fluid, state, dt)
            except FloatingPointError:
                return before + step
        look(state)
        report((before + number)/steps)
    return steps


def step_limit(fluid: Dih, state: np.ndarray) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at the hottest point."""
    flow, (sound, spread) = fluid.flow(state), fluid.edges.fastest
    fast = np.sqrt(2*flow.T.max()) + np.sqrt((flow.v**2).sum(axis=1)).max()
    nu = (2*ETA + fluid.zeta)/flow.rho.min()
    return float(1/(fast*sound/2.82 + nu*spread/2.78))


def dimensions(**more: Any) -> Iterator[Case]:
    """Bulk viscosity, Eq. 37 as printed, one to three dimensions; a pressure that is not symmetric in ij."""
    forms = {1: ("pairwise", "nested", "printed", "one-sided"), 2: ("printed",), 3: ("pairwise",)}
    for d, names in forms.items():
        yield from (DihDrift(form=FORMS[name], d=d, **more) for name in names)


def unsymmetric(seeds: int = 24, **more: Any) -> Iterator[Case]:
    """Random starts on a line; six left the claim open."""
    yield from (Unsymmetric(seed=seed, **more) for seed in range(1, seeds + 1))
