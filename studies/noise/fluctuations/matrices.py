"""Matrices of fluctuations about a gas, in densities (rho, p, eps): noise, equilibrium; k = 1."""
from typing import Any

import numpy as np
from scipy import sparse

from particles.integral import fluctuating
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners

ETA, ZETA, KAPPA = 0.3, 0.1, 0.4


def transport(edges: Edges, share: float, eta: float, zeta: float, kappa: float, T: Any) -> tuple[Partners, Partners]:
    """Viscosity and conduction with their noise: momenta and energies, k = 1."""
    T = np.broadcast_to(T, (edges.n,))
    stress, heat = fluctuating.stress(edges, eta, zeta, T), fluctuating.heat(edges, kappa, T**2)
    if share == 0:
        return stress, heat
    along, conduction = fluctuating.friction(edges, eta, zeta, T), fluctuating.conduction(edges, kappa, T**2)
    return fluctuating.mixed(stress, along, share), fluctuating.mixed(heat, conduction, share)


def noise(V: np.ndarray, of_momenta: Any, of_energies: Any) -> sparse.csr_array:
    """Q (N, N) of a state of densities (rho, p, eps) at rest from those of momenta and energies."""
    n, d = len(V), of_momenta.shape[0]//len(V)
    per = sparse.diags_array(np.tile(1/V, 2 + d))
    return sparse.csr_array(per@sparse.block_diag([sparse.csr_array((n, n)), of_momenta, of_energies])@per)


def equilibrium(V: np.ndarray, d: int) -> np.ndarray:
    """Covariance of densities (rho, p, eps) of the gas at rest, rho = T = 1, k = 1, all sums fixed.

    rho, v and T fluctuate independently, each with variance 1/V: <rho rho> = kT rho/(c_T^2 V), <v v> = kT/(rho V),
    <T T> = kT^2/(rho C_V V).
    """
    to_state = states_of_fields(np.zeros((len(V), d)))
    C = to_state@np.diag(np.tile(1/V, 2 + d))@to_state.T
    sums = np.kron(np.eye(2 + d), V)
    return C - C@sums.T@np.linalg.solve(sums@C@sums.T, sums@C)


def states_of_fields(v: np.ndarray) -> np.ndarray:
    """(N, N) that makes changes of (rho, p, eps) of those of (rho, v, T), rho = T = 1, v (n, d); eps = rho (T + v^2/2)."""
    n, d = v.shape
    M = np.eye((2 + d)*n)
    for a in range(d):
        M[(1 + a)*n:(2 + a)*n, :n] = np.diag(v[:, a])
        M[-n:, (1 + a)*n:(2 + a)*n] = np.diag(v[:, a])
    M[-n:, :n] = np.diag(1 + (v**2).sum(axis=1)/2)
    return M


def factor(edges: Edges, stress: Partners, heat: Partners) -> sparse.csr_array:
    """B of a state of densities (rho, p, eps) from that of momenta and energies."""
    per = sparse.diags_array(np.tile(1/edges.V, edges.d + 1))
    below = per@sparse.block_diag([stress.B, heat.B])
    return sparse.csr_array(sparse.vstack([sparse.csr_array((edges.n, below.shape[1])), below]))
