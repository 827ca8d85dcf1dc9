"""Single numbers: of weights, and of RR98's sums read literally    [RR98 Eqs 2, 5, 21, 26, 27, 33-38, 51]"""
from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
from scipy import sparse

from continuum.exact.waves import Gas, quantities
from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import Exponential, f, moment
from particles.integral.points import lattice
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.build.symbols import lattice_waves
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import arriving

GAS = Gas(0.3, 0.2, 0.4)
LONG = 5000.0       # spacings of a wave that is endless to four digits
SHELLS = 20000      # of a sum over the radius that stands for an integral
ROWS, SPACING = 64, 0.5     # of the lattice on which dV is 1/4
STEP = 1e-4         # of a central difference of Eq. 34, which is quadratic: it is exact
OMEGA = 0.05        # of a rigid rotation
ZETA = 0.3

Sums = list[sparse.csr_array]


@dataclass(frozen=True, kw_only=True)
class Arithmetic(Case):
    """Single numbers without parameters. numbers : makes them, by name."""
    numbers: Callable[[], dict[str, float]]

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = [{"quantity": name, "value": value} for name, value in self.numbers().items()]
        return Outcome({"numbers": rows})


# --- weights ------------------------------------------------------------------------------------------------


def of_weights() -> dict[str, float]:
    """What takes neither points nor a flow."""
    return {"first moment": first_moment_error(), "third derivatives": third_factor(),
            "viscosities, h = 8 a": anisotropy(8.0)}


def first_moment_error() -> float:
    """Largest |M_1/d - 1| of six weights in 1, 2 and 3 dimensions    [RR98 Eq. 2]"""
    errors = []
    for d in (1, 2, 3):
        weights = [kind.of(h=1.3, d=d) for kind in (Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6)]
        errors += [abs(moment(weight, 1, d)/d - 1) for weight in (*weights, Exponential(0.3, d))]
    return max(errors)


def third_factor() -> float:
    """Factor before the third derivatives in 3D: 1 - f^ at small k over 3 k^2 r0^2 M_3/15    [RR98 Eq. 5]"""
    weight, k = Lucy.of(h=1.0, d=3), 0.05
    r = (np.arange(SHELLS) + 0.5)/SHELLS
    transform = float(np.sum(4*pi*r**2*f(weight, r)*np.sin(k*r)/(k*r))/SHELLS)
    return (1 - transform)/(3*k**2*moment(weight, 3, 3)/15)


def anisotropy(h: float) -> float:
    """Largest error of both viscosities of forces along edges: long waves along an axis, by the symbol."""
    k = 2*pi/LONG
    measured = quantities(lattice_waves(GAS, Lucy.of(h=h), np.array([k, 0.0]), nested=False), k)
    return max(abs(measured["viscosity"]/GAS.eta - 1), abs(measured["bulk viscosity"]/GAS.zeta - 1))


# --- sums written out ---------------------------------------------------------------------------------------


def brackets(edges: Edges) -> Sums:
    """The matrices W(r_ij) e^alpha_ij of Eqs 29, 33-38, one a direction; e_ij leads from j to i."""
    return [sparse.csr_array(sparse.diags_array(-0.5/edges.V)@S) for S in edges.areas]


def inner(w: Sums, v: np.ndarray) -> np.ndarray:
    """sum_k W e^alpha_jk v^beta_k, (n, d, d): -grad v."""
    return np.stack([M@v for M in w], axis=1)


def kernel(g: np.ndarray, eta: float, zeta: float, trace: float) -> np.ndarray:
    """pi_ij of Eq. 37 without i, constant viscosities, the trace factor as given; g as from `inner`."""
    div = np.trace(g, axis1=1, axis2=2)[:, None, None]*np.eye(g.shape[1])
    return -eta*(g + g.transpose(0, 2, 1) - trace*div) - zeta*div


def gathered(w: Sums, F: np.ndarray) -> np.ndarray:
    """sum_j W e^b_ij (F^b_i + F^b_j), of F (n, d) or symmetric (n, d, d)    [RR98 Eqs 35, 36]"""
    return sum(M@q + (q.T*M.sum(axis=1)).T for M, q in zip(w, F.swapaxes(0, 1), strict=True))


def mass_rate(w: Sums, m: np.ndarray, v: np.ndarray) -> np.ndarray:
    """dm_i/dt    [RR98 Eq. 34]"""
    return sum(m*(M@u) + u*(M@m) for M, u in zip(w, v.T, strict=True))


def convected(w: Sums, p: np.ndarray, v: np.ndarray) -> np.ndarray:
    """What convection brings to dp_i/dt, (n, d)    [RR98 Eq. 35]"""
    return np.stack([mass_rate(w, q, v) for q in p.T], axis=1)


def ratio(literal: np.ndarray, true: np.ndarray) -> float:
    """Projection of one field on another."""
    return float(np.sum(literal*true)/np.sum(true**2))


def of_volumes() -> dict[str, float]:
    """Eqs 26, 27, 33-37 read literally, over what they stand for: a wave along x where dV is 1/4, 2D."""
    at = lattice((ROWS, 8), SPACING)
    edges = renormalised(at, Lucy.of(h=3*SPACING))
    w, dV, k = brackets(edges), edges.V[0], 2*pi/(ROWS*SPACING)
    s, c = np.sin(k*at.x[:, 0]), np.cos(k*at.x[:, 0])
    v, mass, thinning = np.stack([s, c], axis=1), dV*np.ones(edges.n), -k*c*dV
    momentum = -k*np.stack([2*s*c, c**2 - s**2], axis=1)*dV     # -div(v v) dV, rho = 1
    P = np.stack([(1 + 0.1*s)*dV, 0*s], axis=1)     # at rest, uniform T: P_ij + P_ji = P_i + P_j
    friction = -k**2*v*dV                           # eta = 1, zeta = 0 in 2D: div Pi = lap v
    return {"divergence, Eq. 33 in Eq. 1": ratio(-(w[0]@s), k*c),
            "mass, v_i = v": ratio(mass_rate(w, mass, v), thinning),
            "mass, v_i = v dV": ratio(mass_rate(w, mass, v*dV), thinning),
            "momentum, p_i = m_i v_i, v_i = v dV": ratio(convected(w, dV*(v*dV), v*dV), momentum),
            "pressure, P_ij = P dV": ratio(gathered(w, P), 0.1*thinning),
            "stress, v_i = v": ratio(-gathered(w, kernel(inner(w, v), 1.0, 0.0, 1.0)), friction),
            "linearised mass, Eq. 21": ratio(*linearised(w, s, c))}


def linearised(w: Sums, s: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Right-hand side of Eq. 21 as printed, and the derivative of Eq. 34."""
    rho, d_rho = 1 + 0.2*s, 0.1*c
    v, dv = np.stack([0.3 + 0.1*c, 0*c], axis=1), 0.1*np.stack([s, c], axis=1)
    printed = -sum((M@rho)*du + (M@d_rho)*u + rho*(M@du) + d_rho*(M@u)
                   for M, u, du in zip(w, v.T, dv.T, strict=True))
    above = mass_rate(w, rho + STEP*d_rho, v + STEP*dv)
    below = mass_rate(w, rho - STEP*d_rho, v - STEP*dv)
    return printed, (above - below)/(2*STEP)


def of_dilation() -> dict[str, float]:
    """What the printed trace factor 2/3 adds to zeta over eta    [RR98 Eq. 37]"""
    return {f"dilation in {d}D": added_bulk(d, 2/3) for d in (2, 3)}


def added_bulk(d: int, trace: float) -> float:
    """Mean normal stress of v = x in the middle of a patch, less zeta, over eta = 1."""
    at = lattice((12,)*d)
    edges = renormalised(at, WendlandC2.of(h=2.5, d=d))
    middle = (np.abs(at.x) < 2).all(axis=1)
    pi_ij = kernel(inner(brackets(edges), at.x), 1.0, ZETA, trace)[middle]
    normal = np.trace(pi_ij, axis1=1, axis2=2).mean()/d**2         # div v = d
    return float(normal - ZETA)


def of_rotation() -> dict[str, float]:
    """Heating of a rigid rotation by forces along edges as printed, over eta omega^2    [RR98 Eq. 51]

    Lengths of edges stay, so only the force along v_ij heats: with 2 B omega^2, B = eta (1/2 + 1/d).
    """
    at = lattice((24, 24))
    edges, one = renormalised(at, WendlandC2.of(h=2.2)), np.ones(at.n)
    v = OMEGA*np.stack([-at.x[:, 1], at.x[:, 0]], axis=1)
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(1.0, 1.0), transport=Pairwise(mended=False))
    fluxes = dih.transport.fluxes(dih, dih.flow(dih.state(one, v, one)))
    heating = arriving(edges, fluxes.energy) - (v*arriving(edges, fluxes.momentum)).sum(axis=1)
    middle = np.hypot(*at.x.T) < 2.5        # two ranges from where the rotation ends
    return {"heating of a rotation": float(heating[middle].mean()/OMEGA**2)}
