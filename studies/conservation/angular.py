"""Torques: which exchanges over edges keep angular momentum, and which motions    [RR98 Eqs 34-51]

An edge takes the momentum f from i to j, and with it the angular momentum (x_j - x_i) x f from nowhere. That
is zero for each edge if f points along it. It is zero in the sum over all edges for a stress that both ends
have half of, f = S.(s_i + s_j)/2 with s symmetric, where edges are exact on linear fields; and for friction k
(v_j - v_i) where the Laplacian of x is zero.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas, PowerLaw
from particles.integral.dih import Dih, Flow, NestedFluxes, carried, densities, take
from particles.integral.edges import Edges
from particles.integral.points import Points, jittered
from particles.weights import Lucy
from studies.build.setting import DISORDERS
from studies.build.spam import fluid as smooth_particles
from studies.conservation.motions import ALONG, STILL, moving
from studies.conservation.sums import SIZE, random_fields
from studies.kit.case import Case, Outcome, Report

ETA = 0.1
CONSTANT, CHANGING = ConstEta(ETA, ETA), PowerLaw(ETA, ETA, n=1.0)      # eta(T) = ETA T
#: rho (n,), v (n, 2), T (n,)
Fields = tuple[np.ndarray, np.ndarray, np.ndarray]
COUNTS, H = (16, 16), 3.0
RADIUS, WIDE = 6.0, (40, 40)        # of a disc with a free rim, in a box that its pairs do not cross


def cross(x: np.ndarray, f: np.ndarray) -> np.ndarray:
    """(n,) of (n, 2)."""
    return x[:, 0]*f[:, 1] - x[:, 1]*f[:, 0]


def relative(x: np.ndarray, f: np.ndarray) -> float:
    """|sum x cross f| over sum |x| |f|."""
    return float(abs(cross(x, f).sum())/(np.hypot(*x.T)*np.hypot(*f.T)).sum())


def exchanges(edges: Edges, fields: Fields) -> Iterator[tuple[str, np.ndarray]]:
    """Name and momentum (E, 2) that leaves the first point of each edge."""
    dih = Dih(edges=edges, eos=IdealGas(), law=CONSTANT, transport=ALONG)
    flow = dih.flow(dih.state(*fields))
    a, b, half = take(flow, edges.i), take(flow, edges.j), edges.S/2
    crossed = half*(a.rho*b.T + b.rho*a.T)[:, None]
    yield "pressure, P_i + P_j", half*(a.P + b.P)[:, None]
    yield "pressure, Eq. 13", crossed
    yield "convection, Eq. 35", carried(dih.eos, edges.S, a, b).momentum - crossed
    yield "convection, half of each end", half_of_each(edges, flow)
    for name, kind, law, zeta in (("Eq. 51", ALONG, CONSTANT, 0.0), ("Eq. 51, B = 0", ALONG, CONSTANT, 2*ETA),
                                  ("Eq. 37", NestedFluxes(), CONSTANT, 0.0),
                                  ("Eq. 37, eta(T)", NestedFluxes(), CHANGING, 0.0)):
        yield f"friction, {name}", kind.fluxes(replace(dih, law=law, zeta=zeta), flow).momentum


def half_of_each(edges: Edges, flow: Flow) -> np.ndarray:
    """1/2 S.(rho v v at i and at j)."""
    stress = flow.rho[:, None, None]*flow.v[:, :, None]*flow.v[:, None, :]
    return np.einsum("eb,eab->ea", edges.S/2, stress[edges.i] + stress[edges.j])


@dataclass(frozen=True, kw_only=True)
class EdgeTorque(Case):
    """Of each exchange over edges on points that stay, random fields in a periodic box."""
    make: Callable[[Points, Any], Edges]
    points: str
    seed: int = 1

    def run(self, report: Report, folder: Path) -> Outcome:
        kind = DISORDERS[self.points]
        points = kind.make(COUNTS, kind.size, self.seed)
        edges = self.make(points, Lucy.of(h=H))
        key = {"maker": self.make.__name__, "points": self.points, "seed": self.seed}
        fields = random_fields(points, SIZE, self.seed)
        return Outcome({"torques": [key | {"exchange": name, "torque": relative(edges.apart, f)}
                                    for name, f in exchanges(edges, fields)]})


# --- motions ------------------------------------------------------------------------------------------------


def disc(seed: int) -> Points:
    """Jittered points around the origin; nothing is beyond them."""
    points = jittered(WIDE, 0.3, seed)
    x = points.x[np.hypot(*points.x.T) < RADIUS]
    return Points(x=x, box=points.box, V=np.ones(len(x)))


@dataclass(frozen=True, kw_only=True)
class MotionTorque(Case):
    """Of all forces on that disc, for a motion of the points (none: smooth particles) and a friction."""
    motion: str
    kind: Any
    friction: str
    seed: int = 1

    def run(self, report: Report, folder: Path) -> Outcome:
        points = disc(self.seed)
        fields = random_fields(points, SIZE, self.seed)
        push = (of_motion if self.kind else of_spam)(self, points, fields)
        return Outcome({"motion_torques": [{"motion": self.motion, "friction": self.friction,
                                            "seed": self.seed, "torque": relative(points.x, push)}]})

    @property
    def law(self) -> ConstEta:
        return STILL if self.friction == "none" else CONSTANT


def of_motion(case: MotionTorque, points: Points, fields: Fields) -> np.ndarray:
    """d(momentum)/dt of each point, (n, 2)."""
    transport = NestedFluxes() if case.friction == "Eq. 37" else ALONG
    method = moving(case.kind, points, Lucy.of(h=H), case.law, transport=transport)
    inner = method.owned(points.V)*densities(method.eos, *fields)
    state = np.concatenate([points.x.T, inner, points.V[None]])
    rates = np.empty_like(state)
    method.rates(state, rates)

    def momentum(state: np.ndarray) -> np.ndarray:
        return state[3:5]*state[-1]/method.owned(state[-1])
    return ((momentum(state + rates) - momentum(state - rates))/2).T      # exact: a product of two


def of_spam(case: MotionTorque, points: Points, fields: Fields) -> np.ndarray:
    """The same of smooth particles of unit mass, stress as printed    [KHP95, Sec. II]"""
    method = smooth_particles(Lucy.of(h=H), tuple(points.box), law=case.law)
    _, v, T = fields
    sums, state, ids = method.look(method.state(points.x, 1.0, v, T))
    rates = np.empty_like(state)
    sums.rates(state, rates)
    return rates[2:4, np.argsort(ids)].T
