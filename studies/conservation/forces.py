"""Torques of forces at one moment, and forces of Eq. 50 beside those of smooth particles    [RR98 Eqs 34-51]

An edge that carries the momentum f from i to j creates the angular momentum (x_j - x_i) x f. This is zero for
each edge if f points along the edge. The sum over all edges is zero for the mean stress of both ends, f = S.
(s_i + s_j)/2 with s symmetric, if edges are exact on linear fields; and for the friction f = k (v_j - v_i) if
the Laplacian of x is zero.
"""
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, NestedFluxes, carried, densities, take
from particles.integral.drifts import Powers
from particles.integral.edges import Edges
from particles.integral.points import Points, jittered
from particles.integral.rr98_moving_plain import MOTIONS, ConstantMass
from particles.limits import rates_of
from particles.run import Plan, run
from particles.smooth.spam import Spam
from particles.weights import Lucy
from studies.build.setting import Disorder
from studies.build.spam import fluid as smooth_particles
from studies.conservation.motions import ALONG, DT, STILL, acceleration, march, moving
from studies.conservation.sums import SIZE, random_fields
from studies.kit.case import Case, Report
from studies.kit.table import Row

LUCY, VISCOUS = Lucy.of(h=3.0), ConstEta(0.1, 0.1)
RADIUS, WIDE = 6.0, (40, 40)        # a disc with a free rim, and a box wider than the reach of its pairs


def relative(x: np.ndarray, f: np.ndarray) -> float:
    """|sum x cross f| over sum |x| |f|."""
    torque = (x[:, 0]*f[:, 1] - x[:, 1]*f[:, 0]).sum()
    return float(abs(torque)/(np.hypot(*x.T)*np.hypot(*f.T)).sum())


def exchanges(edges: Edges, fields: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Exchanges by name: momentum (E, 2) that leaves the first point of each edge; fields: rho, v, T."""
    dih = Dih(edges=edges, eos=IdealGas(), law=VISCOUS, transport=ALONG)
    flow = dih.flow(dih.state(*fields))
    a, b, half = take(flow, edges.i), take(flow, edges.j), edges.S/2
    crossed = half*(a.rho*b.T + b.rho*a.T)[:, None]
    stresses = sum(q.rho[:, None]*q.v*(half*q.v).sum(axis=1)[:, None] for q in (a, b))
    yield "pressure, P_i + P_j", half*(a.P + b.P)[:, None]
    yield "pressure, Eq. 13", crossed
    yield "convection, Eq. 35", carried(dih.eos, edges.S, a, b).momentum - crossed
    yield "convection, half of each end", stresses
    yield "friction, Eq. 51", dih.transport.fluxes(dih, flow).momentum
    yield "friction, Eq. 51, B = 0", dih.transport.fluxes(replace(dih, zeta=2*VISCOUS.eta), flow).momentum
    yield "friction, Eq. 37", NestedFluxes().fluxes(dih, flow).momentum


class EdgeTorque(Case, table="torques", same="maker points seed"):
    """Torque of each exchange over edges, for random fields on fixed points in a periodic box."""
    maker: Callable[[Points, Any], Edges]
    points: Disorder
    seed: int = 1

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make((16, 16), self.points.size, self.seed)
        edges, fields = self.maker(points, LUCY), random_fields(points, SIZE, self.seed)
        for name, f in exchanges(edges, fields):
            yield {"exchange": name, "torque": relative(edges.apart, f)}


class MotionTorque(Case, table="motion_torques", same="motion"):
    """Torque of all forces on a disc of jittered points, moved as MOTIONS say, or of smooth particles, spam.

    law : viscosity and conductivity; transport is nested.
    """
    motion: str
    law: ConstEta

    def measure(self, report: Report) -> Iterator[Row]:
        points = jittered(WIDE, 0.3, 1)
        x = points.x[np.hypot(*points.x.T) < RADIUS]
        points = Points(x=x, box=points.box, V=np.ones(len(x)))
        particles = self.motion == "spam"
        force = rates_by_id(*smooth(points, self.law))[2:4].T if particles else self.pushed(points)
        yield {"viscosity": self.law.eta, "torque": relative(x, force)}

    def pushed(self, points: Points) -> np.ndarray:
        """d(momentum)/dt of each point, (n, 2)."""
        method = moving(MOTIONS[self.motion], points, LUCY, self.law, transport=NestedFluxes())
        fields = densities(method.eos, *random_fields(points, SIZE, 1))
        state = np.concatenate([points.x.T, method.owned(points.V)*fields, points.V[None]])
        rates = rates_of(method, state)
        up, down = (q[3:5]*q[-1]/method.owned(q[-1]) for q in (state + rates, state - rates))
        return (up - down).T/2              # exact: momentum is a product of two rows


def smooth(points: Points, law: Any = STILL) -> tuple[Spam, np.ndarray]:
    """Smooth particles of unit mass and random velocities and temperatures."""
    method, (_, v, T) = smooth_particles(LUCY, tuple(points.box), law=law), random_fields(points, SIZE, 1)
    return method, method.state(points.x, 1.0, v, T)


def rates_by_id(method: Spam, state: np.ndarray) -> np.ndarray:
    """d(state)/dt of smooth particles, in the order of the state."""
    sums, ordered, ids = method.look(state)
    return rates_of(sums, ordered)[:, np.argsort(ids)]


class BesideSpam(Case, table="beside", same="a b"):
    """Eq. 50 beside smooth particles, from one state without friction: random fields, jittered points, m = 1.

    Volumes of Eq. 50 are 1/rho of the summed density at the start, and then follow the flow. With a = 1, b =
    -1 pressures of a pair are V_i V_j (P_i rho_j/rho_i + P_j rho_i/rho_j) = P_i/rho_i^2 + P_j/rho_j^2.
    """
    a: float
    b: float
    time: float = 5.0

    def measure(self, report: Report) -> Iterator[Row]:
        points, steps = jittered((16, 16), 0.2, 1), round(self.time/DT)
        spam, start = smooth(points)
        V = spam.fields(start).V
        method = moving(ConstantMass, points, LUCY, scale=1.0, bracket=Powers(self.a, self.b))
        first = np.concatenate([points.x.T, V*densities(method.eos, 1/V, start[2:4].T, start[4]), V[None]])
        pushed, push = acceleration(method, first), rates_by_id(spam, start)[2:4]
        last, ended = march(method, first, DT, steps, np.copy)[-1], run(spam, start, Plan(dt=DT, steps=steps))
        other = ended.by_id()
        yield {"start": apart(pushed, push), "end": apart(method.velocity(last), other[2:4]),
               "volumes": apart(last[-1], spam.fields(other).V)}


def apart(one: np.ndarray, other: np.ndarray) -> float:
    """Rms of the difference over the rms of the second."""
    return float(np.linalg.norm(one - other)/np.linalg.norm(other))
