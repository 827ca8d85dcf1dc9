"""Momentum that RR98's scheme loses where it has to, and a book of where it goes    [RR98 Secs III A, III B]

Two ways: a pressure that is not symmetric in ij, and plates with friction. The book adds up, step by step, what these push, from
formulas of its own: nothing else may change the sum.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edge_makers import MAKERS
from particles.integrators import RK4
from particles.limits import limit_of
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import DISORDERS
from studies.build.read import Value, select
from studies.conservation.dih import COUNTS, ETA, SIZE, OneSided, step_limit
from studies.conservation.drift import MODES, OF_LIMIT, WALLS, sizes
from studies.conservation.layers import LayerDrift
from studies.conservation.sums import exact_sums, random_fields
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import Claim
from studies.kit.stats import Measured, combine
from studies.kit.table import Table, Tables

LOOKS = 100             # at how far a run is
#: momentum along x after so many steps, or where a run that diverged was looked at last (`reached`). lost: its change over the
#: sum of its sizes; booked: the change over what the book says; left: over that at the start
LOSSES = Table("losses", key=["how", "maker", "points", "seed"],
               columns=["how", "maker", "points", "seed", "steps", "reached", "lost", "booked", "left"])


class Ledger(NamedTuple):
    """Sums over edges, and one column more of a state: in its second row what `pushed` brings to the momentum along x."""
    sums: Any
    pushed: Callable[[np.ndarray], float]

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (fields, n + 1), written to `out`."""
        inner, found = np.ascontiguousarray(state[:, :-1]), np.empty((len(state), state.shape[1] - 1))
        self.sums.rates(inner, found)
        out[:, :-1], out[:, -1] = found, 0
        out[1, -1] = self.pushed(inner)


def unsymmetric(fluid: OneSided) -> Callable[[np.ndarray], float]:
    """-sum over edges of S_ij (P_ij - P_ji), P_ij = rho_i T_j: what two points of an edge get together."""
    i, j, S = fluid.edges.i, fluid.edges.j, fluid.edges.S[:, 0]

    def pushed(state: np.ndarray) -> float:
        rho, T = state[0], state[-1]/state[0] - (state[1:-1]**2).sum(axis=0)/(2*state[0]**2)
        return -float(S@(rho[i]*T[j] - rho[j]*T[i]))
    return pushed


def friction(layer: Any) -> Callable[[np.ndarray], float]:
    """sum over edges to images of k eta (-u_parent - u_i): images have the velocity reversed."""
    beyond, eta = layer.beyond, layer.law.eta

    def pushed(state: np.ndarray) -> float:
        u = state[1]/state[0]
        return -eta*float(beyond.k@(u[beyond.parent] + u[beyond.i]))
    return pushed


@dataclass(frozen=True, kw_only=True)
class Lost(Case):
    """A run from a random start whose momentum along x is booked."""
    how: str
    maker: str
    points: str
    seed: int = 1
    steps: int = 10_000

    @property
    def cost(self) -> float:
        return 7e-4*self.steps

    def run(self, report: Report, folder: Path) -> Outcome:
        ledger, state, V, dt = (one_sided if self.how == "one-sided" else between)(self.maker, self.points, self.seed)
        whole = np.concatenate([state, np.zeros((len(state), 1))], axis=1)
        seen, reached = followed(ledger, whole, dt, self.steps, report)
        first, last = exact_sums(V, state)[1], exact_sums(V, seen[:, :-1])[1]
        return Outcome({"losses": [{"how": self.how, "maker": self.maker, "points": self.points, "seed": self.seed,
                                    "steps": self.steps, "reached": reached, "lost": abs(last - first)/sizes(V, state)[1],
                                    "booked": (last - first)/seen[1, -1], "left": last/first}]})


def followed(ledger: Ledger, whole: np.ndarray, dt: float, steps: int, report: Report) -> tuple[np.ndarray, int]:
    """(state, steps) at the end, or where a run that diverged was looked at last."""
    stepper, every = RK4(whole.shape, Team(1)), max(1, steps//LOOKS)
    seen, reached = whole.copy(), 0
    try:
        for step in range(1, steps + 1):
            stepper.step(ledger, whole, dt)
            if step % every == 0:
                seen, reached = whole.copy(), step
                report(step/steps)
    except FloatingPointError:
        pass
    return seen, reached


def one_sided(maker: str, points: str, seed: int) -> tuple[Ledger, np.ndarray, np.ndarray, float]:
    """On a line, with bulk viscosity: the run of `conservation_dih`."""
    at = DISORDERS[points].make(COUNTS[1], DISORDERS[points].size, seed)
    fluid = OneSided(edges=MAKERS[maker](at, Lucy.of(h=3.0, d=1)), eos=IdealGas(), law=ConstEta(ETA, ETA), zeta=0.05)
    state = fluid.state(*random_fields(at, SIZE, seed))
    return Ledger(fluid, unsymmetric(fluid)), state, fluid.edges.V, OF_LIMIT*step_limit(fluid, state)


def between(maker: str, points: str, seed: int) -> tuple[Ledger, np.ndarray, np.ndarray, float]:
    """Between plates, in a light wind: the run of `conservation_layers`."""
    case = LayerDrift(mode=MODES["pairwise"], maker=maker, make=MAKERS[maker], weight=Lucy, h=3.0, disorder=DISORDERS[points],
                      wall=WALLS["plates"], seed=seed)
    at = case.points()
    layer = case.method(at)
    state = case.start(layer, at)
    return (Ledger(layer.start(at.n, Team(1)), friction(layer)), state, layer.edges.V, OF_LIMIT*limit_of(layer, state))


SEEDS = tuple(range(1, 25))     # six left the first claim open
PLATES = (("renormalised", "lattice"), ("delaunay", "jittered-0.3"))


def cases(seeds: tuple[int, ...] = SEEDS, **more: int) -> Iterator[Case]:
    """24 random starts without symmetry, three between plates of each kind."""
    yield from (Lost(how="one-sided", maker="exact", points="jittered-0.1", seed=seed, **more) for seed in seeds)
    yield from (Lost(how="friction", maker=maker, points=points, seed=seed, **more)
                for (maker, points), seed in product(PLATES, seeds[:3]))


def lost(tables: Tables) -> Measured:
    """Mean over random starts."""
    return combine([(value, 0.0) for value in select(tables, "losses", how="one-sided")["lost"]])


def unbooked(how: str) -> Value:
    """Largest |booked - 1|."""
    return lambda tables: Measured(float((select(tables, "losses", how=how)["booked"] - 1).abs().max()), 0.0)


def finished(tables: Tables) -> Measured:
    """Share of the runs without symmetry that reached their end."""
    rows = select(tables, "losses", how="one-sided")
    return Measured(float((rows["reached"] == rows["steps"]).mean()), 0.0)


def left(tables: Tables) -> Measured:
    """Largest share of the wind that plates leave."""
    return Measured(float(select(tables, "losses", how="friction")["left"].abs().max()), 0.0)


ROUNDED = "1e-9: 40 000 additions, of which some cancel where little is lost"
CLAIMS = (
    Claim(id="rr98-conservation-symmetrised", source="RR98 Sec. III B", at_least=0.01, value=lost,
          printed="as long as ij-symmetrized forms are provided, the conservation laws are guaranteed",
          because="a per cent: what flows are told to",
          statement="without forms symmetric in ij momentum is lost: P_ij + P_ij for point i in place of P_ij + P_ji, change "
                    "over the sum of its sizes in 10 000 steps, or until shortly before a run diverges, mean of 24 random "
                    "starts on a line"),
    Claim(id="own-conservation-symmetrised-survival", source="RR98 Sec. III B", at_least=1.0, value=finished,
          because="all of them; asked after the first of these runs had diverged",
          statement="runs without forms symmetric in ij get through 10 000 steps: share of 24 random starts on a line"),
    Claim(id="own-conservation-symmetrised-booked", source="RR98 Sec. III B", at_most=1e-9, value=unbooked("one-sided"),
          because=ROUNDED,
          statement="what is lost is -sum S_ij (P_ij - P_ji) of all edges and nothing else: largest difference of change over "
                    "booked from 1"),
    Claim(id="rr98-conservation-plates-friction", source="RR98 Sec. III A", at_most=1e-9, value=left,
          because="exp(-nu pi^2 t/L^2) is below 1e-12 after 10 000 steps between plates 8 spacings apart",
          statement="plates with friction bring a wind along them to rest: largest share of its momentum left after 10 000 "
                    "steps, lattice and jittered points, three random starts of each"),
    Claim(id="own-conservation-plates-booked", source="RR98 Sec. III A", at_most=1e-9, value=unbooked("friction"),
          because=ROUNDED,
          statement="what they take is the friction over edges to images and nothing else, no pressure and no convection: "
                    "largest difference of change over booked from 1"),
)
