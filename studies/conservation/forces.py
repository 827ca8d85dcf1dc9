"""Forces at one moment: their torques, and those of Eq. 50 beside smooth particles    [RR98 Eqs 34-51]

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

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, NestedFluxes, carried, densities, take
from particles.integral.edges import Edges
from particles.integral.points import Points, jittered
from particles.integral.rr98_moving_plain import ConstantMass, Powers
from particles.run import Plan, run
from particles.smooth.spam import Spam
from particles.weights import Lucy
from studies.build.setting import DISORDERS
from studies.build.spam import fluid as smooth_particles
from studies.conservation.motions import ALONG, DT, STILL, acceleration, march, moving
from studies.conservation.sums import SIZE, random_fields
from studies.kit.case import Case, Outcome, Report

#: rho (n,), v (n, 2), T (n,)
Fields = tuple[np.ndarray, np.ndarray, np.ndarray]
ETA, LUCY = 0.1, Lucy.of(h=3.0)
THICK = ConstEta(ETA, ETA)
RADIUS, WIDE = 6.0, (40, 40)        # of a disc with a free rim, in a box that its pairs do not cross


def relative(x: np.ndarray, f: np.ndarray) -> float:
    """|sum x cross f| over sum |x| |f|."""
    torque = (x[:, 0]*f[:, 1] - x[:, 1]*f[:, 0]).sum()
    return float(abs(torque)/(np.hypot(*x.T)*np.hypot(*f.T)).sum())


def exchanges(edges: Edges, fields: Fields) -> Iterator[tuple[str, np.ndarray]]:
    """Name and momentum (E, 2) that leaves the first point of each edge."""
    dih = Dih(edges=edges, eos=IdealGas(), law=THICK, transport=ALONG)
    flow = dih.flow(dih.state(*fields))
    a, b, half = take(flow, edges.i), take(flow, edges.j), edges.S/2
    crossed = half*(a.rho*b.T + b.rho*a.T)[:, None]
    stress = flow.rho[:, None, None]*flow.v[:, :, None]*flow.v[:, None, :]
    yield "pressure, P_i + P_j", half*(a.P + b.P)[:, None]
    yield "pressure, Eq. 13", crossed
    yield "convection, Eq. 35", carried(dih.eos, edges.S, a, b).momentum - crossed
    yield "convection, half of each end", np.einsum("eb,eab->ea", half, stress[edges.i] + stress[edges.j])
    for name, kind, zeta in (("Eq. 51", ALONG, 0.0), ("Eq. 51, B = 0", ALONG, 2*ETA),
                             ("Eq. 37", NestedFluxes(), 0.0)):
        yield f"friction, {name}", kind.fluxes(replace(dih, zeta=zeta), flow).momentum


@dataclass(frozen=True, kw_only=True)
class EdgeTorque(Case):
    """Of each exchange over edges on points that stay, random fields in a periodic box."""
    make: Callable[[Points, Any], Edges]
    points: str
    seed: int = 1

    def run(self, report: Report, folder: Path) -> Outcome:
        kind = DISORDERS[self.points]
        points = kind.make((16, 16), kind.size, self.seed)
        edges, fields = self.make(points, LUCY), random_fields(points, SIZE, self.seed)
        key = {"maker": self.make.__name__, "points": self.points, "seed": self.seed}
        return Outcome({"torques": [key | {"exchange": name, "torque": relative(edges.apart, f)}
                                    for name, f in exchanges(edges, fields)]})


def disc(seed: int) -> Points:
    """Jittered points around the origin; nothing is beyond them."""
    points = jittered(WIDE, 0.3, seed)
    x = points.x[np.hypot(*points.x.T) < RADIUS]
    return Points(x=x, box=points.box, V=np.ones(len(x)))


@dataclass(frozen=True, kw_only=True)
class MotionTorque(Case):
    """Of all forces on that disc, for a motion of the points, or for smooth particles (no kind)."""
    motion: str
    kind: Any
    friction: str
    seed: int = 1

    def run(self, report: Report, folder: Path) -> Outcome:
        points = disc(self.seed)
        push = self.pushed if self.kind else self.of_smooth
        force = push(points, STILL if self.friction == "none" else THICK)
        return Outcome({"motion_torques": [{"motion": self.motion, "friction": self.friction,
                                            "seed": self.seed, "torque": relative(points.x, force)}]})

    def pushed(self, points: Points, law: Any) -> np.ndarray:
        """d(momentum)/dt of each point, (n, 2)."""
        transport = NestedFluxes() if self.friction == "Eq. 37" else ALONG
        method = moving(self.kind, points, LUCY, law, transport=transport)
        fields = densities(method.eos, *random_fields(points, SIZE, self.seed))
        state = np.concatenate([points.x.T, method.owned(points.V)*fields, points.V[None]])
        rates = np.empty_like(state)
        method.rates(state, rates)
        up, down = (q[3:5]*q[-1]/method.owned(q[-1]) for q in (state + rates, state - rates))
        return (up - down).T/2              # exact: products of two

    def of_smooth(self, points: Points, law: Any) -> np.ndarray:
        """The same of smooth particles of unit mass, stress as printed    [KHP95, Sec. II]"""
        method, (_, v, T) = smooth_particles(LUCY, tuple(points.box), law=law), random_fields(points, SIZE, 1)
        return rates_of(method, method.state(points.x, 1.0, v, T))[2:4].T


@dataclass(frozen=True, kw_only=True)
class BesideSpam(Case):
    """Eq. 50 and smooth particles, from one state without friction: random fields, jittered points, m = 1.

    Volumes begin as 1/rho of the summed density, and follow the flow. With a = 1, b = -1 a pair then has
    V_i V_j (P_i rho_j/rho_i + P_j rho_i/rho_j) = P_i/rho_i^2 + P_j/rho_j^2. How volumes go on and what heats
    is different.
    """
    a: float
    b: float
    time: float = 5.0

    def run(self, report: Report, folder: Path) -> Outcome:
        points = jittered((16, 16), 0.2, 1)
        smooth, (_, v, T) = smooth_particles(LUCY, tuple(points.box)), random_fields(points, SIZE, 1)
        start = smooth.state(points.x, 1.0, v, T)
        V = smooth.fields(start).V
        method = moving(ConstantMass, points, LUCY, scale=1.0, bracket=Powers(self.a, self.b))
        first = np.concatenate([points.x.T, V*densities(method.eos, 1/V, v, T), V[None]])
        steps = round(self.time/DT)
        last = march(method, first.copy(), DT, steps, np.copy)[-1]
        ended = run(smooth, start, Plan(dt=DT, steps=steps))
        other = ended.state[:, np.argsort(ended.ids)]
        pushed = acceleration(method, first), rates_of(smooth, start)[2:4]
        return Outcome({"beside": [{
            "a": self.a, "b": self.b, "start": apart(*pushed),
            "end": apart(method.velocity(last), other[2:4]),
            "volumes": apart(last[-1], smooth.fields(other).V)}]})


def apart(one: np.ndarray, other: np.ndarray) -> float:
    """Rms of a difference over that of the second."""
    return float(np.linalg.norm(one - other)/np.linalg.norm(other))


def rates_of(method: Spam, state: np.ndarray) -> np.ndarray:
    """d(state)/dt of smooth particles, in their order."""
    sums, ordered, ids = method.look(state)
    rates = np.empty_like(state)
    sums.rates(ordered, rates)
    return rates[:, np.argsort(ids)]
