"""Discretized integral hydrodynamics: exchange over edges, in d dimensions    [RR98, Sec. III]

The state (2 + d, n) holds densities rho, p^alpha = rho v^alpha, total energy eps per volume; RR98's m_i, p_i,
eps_i are these times the volume V_i (Eq. 26). What point i loses over an edge, point j gains:

    mass       1/2 S.(rho_i v_j + rho_j v_i)                                                   [Eq. 34]
    momentum   1/2 S.{(p_i v_j + p_j v_i) + (P_ij + P_ji) 1 - (pi_ij + pi_ji)}                 [Eq. 35]
    energy     1/2 S.{(eps_i v_j + ..) + (P_ij v_i + ..) - (pi_ij.v_i + ..) + (J_ij + J_ji)}   [Eq. 36]

with P_ij = P(rho_i, T_j), and stress and heat current nested (Eqs 37, 38) or pairwise (Eq. 51).
"""
from collections import namedtuple
from dataclasses import dataclass
from typing import Any

import numpy as np

from continuum import fluid
from continuum.fluid import energy, pressure, stress_tensor, temperature, valid
from particles.fields import Fields, from_densities
from particles.integral.edges import Edges

#: Fields of a state: rho (n,), v (n, d), T (n,), eps (n,), P (n,).
Flow = namedtuple("Flow", "rho v T eps P")

#: Shear and bulk viscosity, conductivity, each (n,).
Coefficients = namedtuple("Coefficients", "eta zeta kappa")

#: Fluxes out of the first point of each edge: mass (E,), momentum (E, d), energy (E,).
EdgeFluxes = namedtuple("EdgeFluxes", "mass momentum energy")


def densities(eos: Any, rho: np.ndarray, v: np.ndarray, T: Any) -> np.ndarray:
    """Density, momentum, total energy per volume, (2 + d, n), from rho (n,), v (n, d), T (n,)."""
    return np.stack([rho, *(rho[:, None]*v).T, rho*(energy(eos, rho, T) + (v**2).sum(axis=1)/2)])


def take(flow: Flow, points: np.ndarray) -> Flow:
    return Flow(*(field[points] for field in flow))


def carried(eos: Any, S: np.ndarray, a: Flow, b: Flow) -> EdgeFluxes:
    """Fluxes from points a to b by Eqs 34-36, without stress and heat current."""
    half = S/2
    to_b, to_a = (half*b.v).sum(axis=1), (half*a.v).sum(axis=1)      # S.v_b/2, S.v_a/2
    P_ab, P_ba = pressure(eos, a.rho, energy(eos, a.rho, b.T)), pressure(eos, b.rho, energy(eos, b.rho, a.T))
    momentum = (a.rho*to_b)[:, None]*a.v + (b.rho*to_a)[:, None]*b.v + half*(P_ab + P_ba)[:, None]
    return EdgeFluxes(a.rho*to_b + b.rho*to_a, momentum, a.eps*to_b + b.eps*to_a + P_ab*to_a + P_ba*to_b)


@dataclass(frozen=True, kw_only=True)
class NestedFluxes:
    """Stress and heat current of Eqs 37, 38: pi_ij = eta_i E(grad v_j), J_ij = -kappa_i grad T_j.

    differences : take v_k - v_j in the inner sum, exact on uniform flow, instead of v_k as printed.
    """
    differences: bool = True

    def fluxes(self, dih: "Dih", flow: Flow) -> EdgeFluxes:
        edges = dih.edges
        i, j, eta, zeta, kappa = edges.i, edges.j, *dih.coefficients(flow)
        slope = self.gradient(edges, flow.v)
        one, other = stress_tensor(eta[i], zeta[i], slope[j]), stress_tensor(eta[j], zeta[j], slope[i])
        heat = self.gradient(edges, flow.T[:, None])[:, :, 0]
        half = edges.S/2
        momentum = -np.einsum("eb,eab->ea", half, one + other)
        work = np.einsum("eb,eab,ea->e", half, one, flow.v[i])
        work += np.einsum("eb,eab,ea->e", half, other, flow.v[j])
        current = -kappa[i, None]*heat[j] - kappa[j, None]*heat[i]
        return EdgeFluxes(np.zeros(len(i)), momentum, (half*current).sum(axis=1) - work)

    def gradient(self, edges: Edges, f: np.ndarray) -> np.ndarray:
        """Gradient (n, d, m) of f (n, m): by differences, or -sum_k w_jk e_jk f_k as printed."""
        matrices = edges.G if self.differences else [S/2 for S in edges.areas]
        return np.stack([M@f for M in matrices], axis=1)/edges.V[:, None, None]


@dataclass(frozen=True, kw_only=True)
class Pairwise:
    """Forces along edges [Eq. 51]: k [B (v_j - v_i) + A e e.(v_j - v_i)], heat k kappa (T_j - T_i).

    B, A are those of `frictions`; the paper leaves both free. mended : add the stress
    tau_ab = B (d_b v_a - delta_ab div v) of the points, which forces along edges lack, and its work F_a =
    tau_ab v_b. In the continuum div tau = 0 where viscosity is constant: its force is added only where
    viscosity varies. F is always added: without it even a rigid rotation heats.
    """
    mended: bool = True

    def fluxes(self, dih: "Dih", flow: Flow) -> EdgeFluxes:
        """Fluxes through all edges. Raises ValueError: a bulk viscosity makes a friction negative."""
        edges, coefficients = dih.edges, dih.coefficients(flow)
        check_bulk(coefficients.eta, coefficients.zeta, edges.d)
        found = along(edges, means(coefficients, edges.i, edges.j), take(flow, edges.i), take(flow, edges.j))
        if self.mended:
            slope = NestedFluxes().gradient(edges, flow.v)
            tau = transposed(coefficients, slope)
            F = np.einsum("nab,nb->na", tau, flow.v)
            found = found._replace(energy=found.energy - (edges.S*(F[edges.i] + F[edges.j])).sum(axis=1)/2)
            if np.ptp(coefficients.eta) > 0 or np.ptp(coefficients.zeta) > 0:
                push = np.einsum("ea,eab->eb", edges.S, tau[edges.i] + tau[edges.j])/2
                found = found._replace(momentum=found.momentum - push)
        return found


@dataclass(frozen=True, kw_only=True)
class Mixed:
    """A share of transport along edges [Eq. 51], the rest nested [Eqs 37, 38]."""
    share: float

    def __post_init__(self):
        check_share(self.share)

    def fluxes(self, dih: "Dih", flow: Flow) -> EdgeFluxes:
        parts: list[tuple[float, Any]] = [(1 - self.share, NestedFluxes()), (self.share, Pairwise())]
        found = [[part*q for q in kind.fluxes(dih, flow)] for part, kind in parts if part > 0]
        return EdgeFluxes(*(sum(q) for q in zip(*found, strict=True)))


def check_share(share: float) -> None:
    """Raise ValueError unless the share is between 0 and 1."""
    if not 0 <= share <= 1:
        raise ValueError(f"the share of transport along edges must be between 0 and 1, got {share}")


def frictions(eta: np.ndarray, zeta: np.ndarray, d: int) -> tuple[np.ndarray, np.ndarray]:
    """B = eta (1/2 + 1/d) - zeta/2, A = (d + 2)/2 [eta (1 - 2/d) + zeta] of Eq. 51, which leaves both free:
    from the limit of long waves on isotropic edges."""
    return eta*(1/2 + 1/d) - zeta/2, (d + 2)/2*(eta*(1 - 2/d) + zeta)


def along(edges: Any, coefficients: Coefficients, a: Flow, b: Flow) -> EdgeFluxes:
    """Fluxes from points a to b by friction [Eq. 51] and heat along edges, with k and apart."""
    d, (eta, zeta, kappa) = edges.apart.shape[1], coefficients
    B, A = frictions(eta, zeta, d)
    dv, e = b.v - a.v, edges.apart/np.sqrt((edges.apart**2).sum(axis=1))[:, None]
    force = edges.k[:, None]*(B[:, None]*dv + A[:, None]*e*(e*dv).sum(axis=1)[:, None])
    work, heat = (force*(a.v + b.v)).sum(axis=1)/2, edges.k*kappa*(b.T - a.T)
    return EdgeFluxes(np.zeros(len(heat)), -force, -work - heat)


def transposed(coefficients: Coefficients, slope: np.ndarray) -> np.ndarray:
    """Stress tau[n, a, b] = B (d_b v_a - delta_ab div v), B of `frictions`, slope[n, a, b] = d_a v_b."""
    d, (eta, zeta, _) = slope.shape[1], coefficients
    div = np.einsum("naa->n", slope)[:, None, None]*np.eye(d)
    return frictions(eta, zeta, d)[0][:, None, None]*(np.swapaxes(slope, 1, 2) - div)


def check_bulk(eta: np.ndarray, zeta: np.ndarray, d: int) -> None:
    """Raise ValueError if A or B of `frictions` is negative; in 1D only their sum, zeta, counts."""
    low, high = (0*eta, np.inf + 0*eta) if d == 1 else (-eta*(1 - 2/d), eta*(1 + 2/d))
    bad = np.flatnonzero((zeta < low - 1e-12*eta) | (zeta > high + 1e-12*eta))
    if len(bad):
        k = bad[0]
        raise ValueError(f"bulk viscosity {zeta[k]:.4g} with shear viscosity {eta[k]:.4g} is outside of what "
                         f"forces along edges allow, {low[k]:.4g} to {high[k]:.4g}: take nested transport")


def gained(edges: Edges, *fluxes: EdgeFluxes) -> np.ndarray:
    """Gains of the points by fluxes over edges, (2 + d, n)."""
    mass, momentum, energy = (sum(q[1:], q[0]) for q in zip(*fluxes, strict=True))
    return np.stack([np.bincount(edges.j, flux, edges.n) - np.bincount(edges.i, flux, edges.n)
                     for flux in (mass, *momentum.T, energy)])


def means(q: Coefficients, i: np.ndarray, j: np.ndarray) -> Coefficients:
    return Coefficients(*((c[i] + c[j])/2 for c in q))


@dataclass(frozen=True, kw_only=True)
class Dih:
    """A fluid on fixed points.

    zeta : bulk viscosity. transport : NestedFluxes, Pairwise or Mixed.
    """
    edges: Edges
    eos: Any
    law: Any
    zeta: float = 0.0
    transport: Any = Pairwise()

    @property
    def names(self) -> tuple[str, ...]:
        return ("rho", *("px", "py", "pz")[:self.edges.d], "eps")

    def state(self, rho: np.ndarray, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """State (2 + d, n) from densities (n,), velocities (n, d), temperatures (n,)."""
        return densities(self.eos, rho, v, T)

    def flow(self, state: np.ndarray) -> Flow:
        """Fields of a state. FloatingPointError: a point is outside the validity of the equation of state."""
        rho, eps = state[0], state[-1]
        with np.errstate(all="ignore"):
            v = (state[1:-1]/rho).T
            e = eps/rho - (v**2).sum(axis=1)/2
            good = np.isfinite(e) & valid(self.eos, rho, e)
        if not good.all():
            i = int(np.argmin(good))
            raise FloatingPointError(f"point {i} has rho = {rho[i]:.6g}, e = {e[i]:.6g}, outside the "
                                     f"validity of {type(self.eos).__name__}: take a shorter step")
        return Flow(rho, v, temperature(self.eos, rho, e), eps, pressure(self.eos, rho, e))

    def fields(self, state: np.ndarray) -> Fields:
        """Fields of the points; positions are nan, since edges do not store them."""
        nowhere = np.full((self.edges.n, self.edges.d), np.nan)
        return from_densities(self.eos, nowhere, self.edges.V, state[0], state[1:-1], state[-1])

    def coefficients(self, flow: Flow) -> Coefficients:
        one = np.ones_like(flow.rho)
        return Coefficients(fluid.viscosity(self.law, flow.rho, flow.T)*one,
                            self.zeta*one,
                            fluid.conductivity(self.law, flow.rho, flow.T)*one)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`    [Eqs 34-36]"""
        flow, edges = self.flow(state), self.edges
        moved = carried(self.eos, edges.S, take(flow, edges.i), take(flow, edges.j))
        out[:] = gained(edges, moved, self.transport.fluxes(self, flow))/edges.V
