"""Random stress and heat current on fixed points, as matrices over edges    [RR98 Eqs 22-25, 42-44]

Momenta p (d, n) of points with velocities v and energies E (n,) with temperatures T obey, at rest,

    dp = -Gamma v dt + B dW        dE = -Gamma T dt + B dW        B B^T = Q

dW independent Wiener processes, Gamma and B sparse. In equilibrium <p_i p_j> = kT m_i delta_ij and <E_i E_j>
= k T^2 C_i delta_ij on any points if and only if Q = 2 kT Gamma (momenta) and Q = 2 k T^2 Gamma (energies):
the fluctuation-dissipation theorem. Row a n + i is component a of point i. k is Boltzmann's constant in the
units of the fluid; it sets the strength of the noise.

RR98's Eqs 42-44 give increments of a whole step, and lack a volume.
"""
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from particles.integral.dih import check_bulk, check_share, frictions
from particles.integral.edges import Edges

#: share of the largest conductance down to which negative ones count as zero (right angles of triangles)
ROUND_OFF = 1e-13


class Partners(NamedTuple):
    """Matrices of dissipation, Gamma (N, N), and noise, B (N, normals)."""
    Gamma: sparse.csr_array
    B: sparse.csr_array

    @property
    def Q(self) -> sparse.csr_array:
        """Covariance of the noise per time."""
        return sparse.csr_array(self.B@self.B.T)


def mismatch(pair: Partners, twice: float) -> float:
    """|Q - twice Gamma|/|twice Gamma| by largest elements; twice : 2 kT (momenta) or 2 k T^2 (energies)."""
    wanted = twice*pair.Gamma
    return float(abs(pair.Q - wanted).max()/abs(wanted).max())


def stress(edges: Edges, eta: Any, zeta: Any, kT: Any) -> Partners:
    """Viscous forces D (eta Delta + zeta 11)/V D^T, and one random stress per point:

    s_i = sqrt(2 kT_i eta_i/V_i) [(R + R^T)/sqrt 2 - 1 tr R sqrt 2/d] + sqrt(2 kT_i zeta_i/V_i) 1 r, R (d, d)
    and r from dW. eta, zeta, kT are (n,) or numbers, here and below. Raises ValueError: one is negative.
    """
    eta, zeta, kT = checked(edges.n, eta=eta, zeta=zeta, kT=kT)
    d, V = edges.d, edges.V
    # V div of a tensor, component (a, b) of point j in column (a d + b) n + j
    div = each(d, sparse.hstack(edges.D))
    middle = kron(shear(d), eta/V) + kron(np.outer(one(d), one(d)), zeta/V)
    normals = sparse.hstack([kron(traceless(d), np.sqrt(2*kT*eta/V)),
                             kron(one(d)[:, None], np.sqrt(2*kT*zeta/V))])
    return Partners(sparse.csr_array(div@middle@div.T), sparse.csr_array(div@normals))


def heat(edges: Edges, kappa: Any, kT2: Any) -> Partners:
    """Heat D kappa/V D^T, and a random current sqrt(2 kT2_i kappa_i/V_i) r_i per point; kT2 = k T^2."""
    kappa, kT2 = checked(edges.n, kappa=kappa, kT2=kT2)
    d, div = edges.d, sparse.hstack(edges.D, format="csr")
    Gamma = div@kron(np.eye(d), kappa/edges.V)@div.T
    return Partners(sparse.csr_array(Gamma),
                    sparse.csr_array(div@kron(np.eye(d), np.sqrt(2*kT2*kappa/edges.V))))


def shear(d: int, trace: float | None = None) -> np.ndarray:
    """Delta_ab,cd = delta_ac delta_bd + delta_ad delta_bc - trace delta_ab delta_cd; default trace 2/d."""
    unit = np.eye(d)
    both = np.einsum("ac,bd->abcd", unit, unit) + np.einsum("ad,bc->abcd", unit, unit)
    return both.reshape(d*d, d*d) - (2/d if trace is None else trace)*np.outer(one(d), one(d))


def traceless(d: int) -> np.ndarray:
    """Matrix M with vec[(R + R^T)/sqrt 2 - 1 tr R sqrt 2/d] = M vec R; M M^T = Delta."""
    swap = np.einsum("ac,bd->abdc", np.eye(d), np.eye(d)).reshape(d*d, d*d)
    return (np.eye(d*d) + swap)/np.sqrt(2) - np.sqrt(2)/d*np.outer(one(d), one(d))


def one(d: int) -> np.ndarray:
    """The unit tensor as a vector (d^2,)."""
    return np.eye(d).ravel()


def kron(tensor: np.ndarray, at: np.ndarray) -> sparse.csr_array:
    """Matrix of a tensor at every point or edge, times the number `at` there."""
    return sparse.csr_array(sparse.kron(sparse.csr_array(tensor), sparse.diags_array(at)))


def each(d: int, matrix: Any) -> sparse.csr_array:
    """Block matrix that applies one matrix to each of d components."""
    return sparse.csr_array(sparse.kron(sparse.eye_array(d), matrix))


def friction(edges: Edges, eta: Any, zeta: Any, kT: Any) -> Partners:
    """Friction k (B + A e e) of `dih.along`, noise sqrt(2 kT k B) R + sqrt(2 kT k A) e r on each edge. Raises
    ValueError: a coefficient or k of an edge is negative, or forces along edges do not allow zeta."""
    eta, zeta, kT = checked(edges.n, eta=eta, zeta=zeta, kT=kT)
    d = edges.d
    check_bulk(eta, zeta, d)
    eta, zeta, kT = (ends(edges, q) for q in (eta, zeta, kT))
    B, A = frictions(eta, zeta, d)
    return between(edges, A, B, kT) if d > 1 else between(edges, 0*A, A + B, kT)


def between(edges: Edges, A: np.ndarray, B: np.ndarray, kT: np.ndarray) -> Partners:
    """Friction k (B + A e e) between the points of each edge, A, B, kT (E,), and its noise."""
    k, d, across = conductances(edges), edges.d, incidence(edges)
    A, B = np.maximum(A, 0), np.maximum(B, 0)       # negative by round-off at the ends of zeta's range
    e = edges.apart/np.sqrt((edges.apart**2).sum(axis=1))[:, None]
    along = sparse.vstack([across@sparse.diags_array(q) for q in e.T])
    Gamma = each(d, across@sparse.diags_array(k*B)@across.T) + along@sparse.diags_array(k*A)@along.T
    noise = [each(d, across@sparse.diags_array(np.sqrt(2*kT*k*B))),
             along@sparse.diags_array(np.sqrt(2*kT*k*A))]
    return Partners(sparse.csr_array(Gamma), sparse.csr_array(sparse.hstack(noise)))


def conduction(edges: Edges, kappa: Any, kT2: Any) -> Partners:
    """Heat k kappa (T_j - T_i) along each edge, its random current; coefficients are means of both ends."""
    kappa, kT2 = (ends(edges, q) for q in checked(edges.n, kappa=kappa, kT2=kT2))
    f, across = conductances(edges)*kappa, incidence(edges)
    return Partners(sparse.csr_array(across@sparse.diags_array(f)@across.T),
                    sparse.csr_array(across@sparse.diags_array(np.sqrt(2*kT2*f))))


def mixed(points: Partners, along: Partners, share: float) -> Partners:
    """A share of friction along edges, the rest from stresses at points, each with its noise."""
    check_share(share)
    Gamma = (1 - share)*points.Gamma + share*along.Gamma
    return Partners(sparse.csr_array(Gamma),
                    sparse.csr_array(sparse.hstack([np.sqrt(1 - share)*points.B, np.sqrt(share)*along.B])))


def incidence(edges: Edges) -> sparse.csr_array:
    """Incidence matrix (n, E): the first point of an edge gains what the second loses."""
    e, ones = np.arange(len(edges.i)), np.ones(len(edges.i))
    rows, columns = np.concatenate([edges.i, edges.j]), np.concatenate([e, e])
    return sparse.csr_array((np.concatenate([ones, -ones]), (rows, columns)), shape=(edges.n, len(e)))


def ends(edges: Edges, q: np.ndarray) -> np.ndarray:
    """Means over the two points of each edge."""
    return (q[edges.i] + q[edges.j])/2


def conductances(edges: Edges) -> np.ndarray:
    """Conductances k (E,), round-off below zero set to zero. Raises ValueError: k < 0, as in tetrahedra."""
    if not (edges.k >= -ROUND_OFF*edges.k.max()).all():
        worst = int(np.argmin(edges.k))
        raise ValueError(f"the edge between points {edges.i[worst]} and {edges.j[worst]} conducts k = "
                         f"{edges.k[worst]:.4g} < 0: take stresses at points, or edges of a weight")
    return np.maximum(edges.k, 0)


def printed_stress(edges: Edges, eta: Any, zeta: Any, kT: Any, *, doubled: bool, volume: bool = True,
                   trace: float = 2/3, bulk: float = 1.0) -> Partners:
    """Eqs 42, 44: an independent random stress on each pair, and the viscous force of Eq. 37 as printed.

    Square roots are those printed, of 2 kT_i eta_j + 2 kT_j eta_i (X) and kT_i zeta_j + kT_j zeta_i (Y).
    doubled : the bracket takes pi_ij + pi_ji = 2 pi_ij (Eq. 35), not pi_ij (Eq. 22). volume : divide
    variances by V, not V^2 (Eq. 42 with Eq. 27). trace : 2/3 as printed. bulk : 1 as printed, 2 as in Eq. 23.
    """
    eta, zeta, kT = checked(edges.n, eta=eta, zeta=zeta, kT=kT)
    i, j, d = edges.i, edges.j, edges.d
    V = ends(edges, edges.V)**(1 if volume else 2)
    of_shear = 2*(kT[i]*eta[j] + kT[j]*eta[i])/V
    of_trace = bulk*(kT[i]*zeta[j] + kT[j]*zeta[i])/V + (2/d - trace)*of_shear
    across = incidence(edges)
    factor = 1.0 if doubled else 0.5
    bracket = each(d, sparse.hstack([across@sparse.diags_array(factor*s) for s in edges.S.T]))
    normals = sparse.hstack([kron(traceless(d), np.sqrt(of_shear)), kron(one(d)[:, None], np.sqrt(of_trace))])
    return Partners(printed_viscosity(edges, eta, zeta, trace), sparse.csr_array(bracket@normals))


def printed_viscosity(edges: Edges, eta: np.ndarray, zeta: np.ndarray,
                      trace: float = 2/3) -> sparse.csr_array:
    """Gamma of Eqs 35, 37: pi_ij = -eta_i E(sum_k w_jk e_jk v_k), from values v_k, not differences."""
    d = edges.d
    slope = each(d, sparse.vstack([S/2 for S in edges.areas]))
    of_shear, of_trace = kron(shear(d, trace), 1/edges.V), kron(np.outer(one(d), one(d)), 1/edges.V)
    return sparse.csr_array(-(swapped(edges, eta)@of_shear + swapped(edges, zeta)@of_trace)@slope)


def swapped(edges: Edges, eta: np.ndarray) -> sparse.csr_array:
    """Matrix of sum_j S_ij (eta_i E_j + eta_j E_i)/2, a coefficient of one point and slope E of the other."""
    both = [sparse.diags_array(eta)@S/2 + sparse.diags_array(S@eta/2) for S in edges.areas]
    return each(edges.d, sparse.hstack(both))


def printed_heat(edges: Edges, kappa: Any, k: float, T: Any, *, doubled: bool,
                 of25: bool = False) -> Partners:
    """Eqs 43, 44: a random current on each pair, and the heat of Eq. 38; of25 : variance as in Eq. 25."""
    kappa, T = checked(edges.n, kappa=kappa, T=T)
    i, j, n = edges.i, edges.j, edges.n
    variance = k*(2*(T[i]**2*kappa[j] + T[j]**2*kappa[i]) if of25
                  else T[i]*kappa[j] + T[j]*kappa[i])/ends(edges, edges.V)
    across, factor = incidence(edges), 1.0 if doubled else 0.5
    B = sparse.hstack([across@sparse.diags_array(factor*s*np.sqrt(variance)) for s in edges.S.T])
    bracket = swapped(edges, kappa)[:n, :edges.d*n]        # first component: heat is a scalar
    Gamma = -bracket@kron(np.eye(edges.d), 1/edges.V)@sparse.vstack([S/2 for S in edges.areas])
    return Partners(sparse.csr_array(Gamma), sparse.csr_array(B))


def checked(n: int, **fields: Any) -> list[np.ndarray]:
    """Fields as arrays (n,). Raises ValueError: one is negative or nan."""
    found = []
    for name, field in fields.items():
        q = np.broadcast_to(np.asarray(field, float), (n,))
        if not (q >= 0).all():
            i = int(np.argmin(q >= 0))
            raise ValueError(f"{name} of point {i} is {q[i]:.6g}, which must not be negative")
        found.append(q)
    return found
