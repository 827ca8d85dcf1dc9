"""Points that move, in RR98's ways; edges are made again at every evaluation    [RR98, Sec. III]

    literal         dr_i/dt = v_i [Eq. 39], fields as on fixed points [Eqs 34-36], every volume dV:
                    convection counts twice
    convective      d/dt is the partial derivative and what Eqs 46-48 add, with their signs; volumes dV
    carried         the same, but volumes go with the flow, dV_i/dt = V_i div v
    constant mass   m_i dv_i/dt = sum_j .. [Eq. 49], pressure crossed [Eq. 13] or of Eq. 50: smoothed
                    particle hydrodynamics

A state (2 d + 3, n) begins with positions, which are not wrapped into the box. Then come rho, p, eps per
volume, as RR98's m_i, p_i, eps_i are of equal volumes dV; or, at constant mass, m, p, E of the point; then V.
A scheme that is conservative and consistent is another one: see `closed_faces`.
"""
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from continuum.fluid import energy, pressure
from particles.fields import Fields, from_densities
from particles.integral.dih import Dih, EdgeFluxes, Flow, Pairwise, densities, gained, take
from particles.integral.drifts import Crossed
from particles.integral.edge_makers import from_weights, judged
from particles.integral.edges import Edges
from particles.integral.interpolants import check
from particles.integral.points import Points, of_positions, wrapped


def pressures(bracket: Any, eos: Any, a: Flow, b: Flow) -> tuple[np.ndarray, np.ndarray]:
    """(P_ab, P_ba) of Eq. 13 or 50; written apart from the compiled formulas, which tests compare with it."""
    if isinstance(bracket, Crossed):
        return pressure(eos, a.rho, energy(eos, a.rho, b.T)), pressure(eos, b.rho, energy(eos, b.rho, a.T))
    m, n = bracket
    return b.P/(b.rho**m*a.rho**n), a.P/(a.rho**m*b.rho**n)


def convected(edges: Edges, v: np.ndarray, fields: np.ndarray) -> np.ndarray:
    """-sum_j W_ij e_ij.v_i q_j, (m, n), of fields q (m, n): what Eqs 46-48 add; v.grad q on a lattice."""
    i, j, half = edges.i, edges.j, edges.S/2
    ahead, back = (half*v[i]).sum(axis=1), (half*v[j]).sum(axis=1)
    return np.stack([np.bincount(i, ahead*q[j], edges.n) - np.bincount(j, back*q[i], edges.n)
                     for q in fields])/edges.V


def divergence(edges: Edges, v: np.ndarray) -> np.ndarray:
    """-sum_j W_ij e_ij.v_j, (n,): the divergence that remains of Eqs 34 and 46."""
    i, j, half = edges.i, edges.j, edges.S/2
    out, back = (half*v[j]).sum(axis=1), (half*v[i]).sum(axis=1)
    return (np.bincount(i, out, edges.n) - np.bincount(j, back, edges.n))/edges.V


@dataclass(frozen=True, kw_only=True)
class Motion:
    """What all have in common: a fluid on points that move in a periodic box (d,) around the origin.

    weight : of `weights` or `interpolants`, for d dimensions. scale : of `rr98_moving.scale_of`.
    """
    box: tuple[float, ...]
    weight: Any
    eos: Any
    law: Any
    transport: Any = Pairwise()  # noqa: RUF009  (immutable)
    scale: float = 1.0

    def __post_init__(self):
        check(self.weight, self.places)

    @property
    def places(self) -> int:
        """Rows of a state that are positions: d."""
        return len(self.box)

    @property
    def names(self) -> tuple[str, ...]:
        axes = ("x", "y", "z")[:self.places]
        return (*axes, "rho", *(f"p{axis}" for axis in axes), "eps", "V")

    def fluid(self, x: np.ndarray, V: np.ndarray) -> Dih:
        """The fluid as if points x (n, d) of volumes V (n,) stood still."""
        bad = np.flatnonzero(~(np.isfinite(x).all(axis=1) & (V > 0)))
        if len(bad):
            raise FloatingPointError(f"point {bad[0]} is at {x[bad[0]]} with volume {V[bad[0]]:.6g}: "
                                     "both must be finite and volumes positive; take a shorter step")
        box = np.asarray(self.box, float)
        points = Points(x=wrapped(x, box), box=box, V=V)
        edges = from_weights(points, self.weight, lambda r: self.scale)
        return Dih(edges=edges, eos=self.eos, law=self.law, transport=self.transport)

    def owned(self, V: np.ndarray) -> np.ndarray:
        """The volume (n,) that the rows between positions and volumes are those of."""
        return np.ones_like(V)

    def state(self, x: np.ndarray, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """(2 d + 3, n) of positions (n, d) and fields; all volumes are equal. Warns where the weight is too
        narrow [Eq. 45]. Raises ValueError: two points overlap, or the box is narrower than two ranges."""
        V = np.full(len(x), np.prod(self.box)/len(x))
        judged(self.fluid(x, V).edges, of_positions(wrapped(x, np.asarray(self.box)), self.box), self.weight)
        return np.concatenate([x.T, self.owned(V)*densities(self.eos, rho, v, T), V[None]])

    def velocity(self, state: np.ndarray) -> np.ndarray:
        """(d, n): the rates of the positions    [Eq. 39]"""
        d = self.places
        return state[d + 1:2*d + 1]/state[d]

    def fields(self, state: np.ndarray) -> Fields:
        d, V = self.places, state[-1]
        rho, *p, eps = state[d:-1]/self.owned(V)
        return from_densities(self.eos, state[:d].T.copy(), V.copy(), rho, np.stack(p), eps)

    def conserved(self, state: np.ndarray) -> np.ndarray:
        """Mass, momentum and energy of all points, (2 + d,)."""
        return state[self.places:-1]@state[-1]


@dataclass(frozen=True, kw_only=True)
class Literal(Motion):
    """Eqs 34-36 and 39 as printed: points move, and what convection brings is exchanged as well."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        d = self.places
        self.fluid(state[:d].T, state[-1]).rates(state[d:-1], out[d:-1])
        out[:d], out[-1] = self.velocity(state), 0


@dataclass(frozen=True, kw_only=True)
class Convective(Motion):
    """Eqs 34-36, 39, 46-48 as printed: m_i, p_i, eps_i of volumes dV that stay as they are.

    follow : volumes grow by so much of V div v, with the divergence that Eqs 34 and 46 leave in dm_i/dt;
    with 1 rho_i V_i stays as it is, as at constant mass.
    """
    follow: float = 0.0

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        d, v, V = self.places, self.velocity(state), state[-1]
        dih = self.fluid(state[:d].T, V)
        dih.rates(state[d:-1], out[d:-1])
        out[d:-1] += convected(dih.edges, v.T, state[d:-1])
        out[:d], out[-1] = v, self.follow*V*divergence(dih.edges, v.T)


@dataclass(frozen=True, kw_only=True)
class ConstantMass(Motion):
    """Eq. 49 with masses that stay; volumes follow the flow, dV_i/dt = V_i div v.

    bracket : `Crossed` or `Powers`. The divergence takes differences, the adjoint of P_ij + P_ji.
    """
    bracket: Any = Crossed()  # noqa: RUF009  (immutable)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple({"rho": "m", "eps": "E"}.get(name, name) for name in super().names)

    def owned(self, V: np.ndarray) -> np.ndarray:
        return V

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        d, V = self.places, state[-1]
        dih = self.fluid(state[:d].T, V)
        flow, edges = dih.flow(state[d:-1]/V), dih.edges
        a, b, half = take(flow, edges.i), take(flow, edges.j), edges.S/2
        P_ab, P_ba = pressures(self.bracket, self.eos, a, b)
        to_a, to_b = (half*a.v).sum(axis=1), (half*b.v).sum(axis=1)
        pushed = EdgeFluxes(np.zeros(len(half)), half*(P_ab + P_ba)[:, None], P_ab*to_a + P_ba*to_b)
        out[d:-1] = gained(edges, pushed, self.transport.fluxes(dih, flow))
        out[:d] = flow.v.T
        out[-1] = np.bincount(edges.i, to_b - to_a, edges.n) + np.bincount(edges.j, to_b - to_a, edges.n)

    def conserved(self, state: np.ndarray) -> np.ndarray:
        return state[self.places:-1].sum(axis=1)


#: by name
MOTIONS: dict[str, Any] = {"literal": Literal, "convective": Convective,
                           "carried": partial(Convective, follow=1.0), "constant-mass": ConstantMass}
