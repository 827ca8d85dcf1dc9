"""Terms on lattices against exact derivatives; sums read literally    [RR98 Eqs 10-19, 21, 26-38, 51]"""
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from continuum.fluid import ConstEta, PowerLaw, VanDerWaals, stress_tensor
from particles.integral.dih import Dih, Flow, NestedFluxes, Pairwise, gained
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import lattice
from particles.limits import rates_of
from particles.weights import Lucy, WendlandC2
from studies.kit.case import Case, Report
from studies.kit.table import Row
from studies.operators.weights import weight_of

ETA, ZETA, KAPPA = 0.02, 0.01, 0.03
PRINTED, ALONG = NestedFluxes(differences=False), Pairwise(mended=False)
CHANGING = PowerLaw(ETA, KAPPA, n=1.0)      # eta and kappa proportional to T

ROWS, SPACING = 64, 0.5     # of the lattice on which dV is 1/4
STEP = 1e-4                 # of a central difference of Eq. 34: exact, as Eq. 34 is quadratic

Sums = list[sparse.csr_array]


class Spectral(NamedTuple):
    """Derivatives of fields (n, ...) on a lattice in the unit box, exact for waves above two spacings."""
    shape: tuple[int, ...]

    def derivative(self, f: np.ndarray, axis: int) -> np.ndarray:
        """d f/d x_axis."""
        cells = self.shape[axis]
        k = 2*np.pi*np.fft.fftfreq(cells, 1/cells)
        box = np.moveaxis(f.reshape(*self.shape, -1), axis, -1)
        slope = np.fft.ifft(1j*k*np.fft.fft(box)).real
        return np.moveaxis(slope, -1, axis).reshape(f.shape)

    def grad(self, f: np.ndarray) -> np.ndarray:
        """Gradient: [n, a, ...] = d_a f."""
        return np.stack([self.derivative(f, a) for a in range(len(self.shape))], axis=1)

    def div(self, F: np.ndarray) -> np.ndarray:
        """Divergence: sum_a d_a F[:, a]."""
        return np.einsum("naa...->n...", self.grad(F))


def smooth_flow(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(rho, v, T) of one wave along each axis of the unit box; no term is zero or symmetric."""
    phi = 2*np.pi*x
    axes = np.arange(phi.shape[1])
    rho = 1 + 0.05*np.sin(phi + axes).sum(axis=1)
    T = 1 + 0.05*np.cos(phi + 0.5 + 2*axes).sum(axis=1)
    v = 0.2*np.sin(np.roll(phi, 1, axis=1) + 0.3) + 0.1*np.cos(phi + 0.7)
    return rho, v, T


def transported(dih: Dih, flow: Flow) -> np.ndarray:
    """Rates of densities by stress and heat current alone, (2 + d, n)."""
    return gained(dih.edges, dih.transport.fluxes(dih, flow))/dih.edges.V


def terms(dih: Dih, flow: Flow, exact: Spectral) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """(name, discrete, exact) of terms of Eqs 34-38 as printed, except for the trace factor, and of Eq. 51.

    eta and kappa are proportional to T, but constant in Eq. 51.
    """
    rho, v, T, eps, P = flow
    eta, _, kappa = dih.coefficients(flow)
    stress = stress_tensor(eta, ZETA, exact.grad(v))
    current = kappa[:, None]*exact.grad(T)
    yield "viscous nested", transported(dih, flow)[1:-1].T, exact.div(stress)
    still = rates_of(dih, dih.state(rho, 0*v, T))
    yield "pressure", still[1:-1].T, -exact.grad(P)
    yield "heat nested", still[-1], exact.div(current)
    mass, *momentum, energy = rates_of(dih, dih.state(rho, v, T))
    yield "mass", mass, -exact.div(rho[:, None]*v)                                             # [Eq. 7]
    convected = rho[:, None, None]*v[:, :, None]*v[:, None, :]
    force = exact.div(stress - convected) - exact.grad(P)
    yield "momentum", np.stack(momentum, axis=1), force                                        # [Eq. 8]
    work = np.einsum("nab,nb->na", stress, v)
    yield "energy", energy, -exact.div((eps + P)[:, None]*v - work - current)                  # [Eq. 9]
    if v.shape[1] == 2:
        fluid = replace(dih, law=ConstEta(ETA, KAPPA), zeta=0.0, transport=ALONG)
        stress = stress_tensor(fluid.coefficients(flow).eta, 0.0, exact.grad(v))
        yield "friction, zeta 0", transported(fluid, flow)[1:-1].T, exact.div(stress)


class EquationErrors(Case, table="equations", same="d weight h cells"):
    """Errors of all terms for a smooth flow on a lattice of cells^d points, of Eq. 51 in 2D; h in spacings.

    error : relative rms. ratio : projection of the discrete field on the exact one.
    """
    d: int
    weight: Any
    h: float
    cells: int

    def measure(self, report: Report) -> Iterator[Row]:
        shape = (self.cells,)*self.d
        at, exact = lattice(shape, 1/self.cells), Spectral(shape)
        edges = renormalised(at, weight_of(self.weight, self.h/self.cells, self.d))
        dih = Dih(edges=edges, eos=VanDerWaals(), law=CHANGING, zeta=ZETA, transport=PRINTED)
        flow = dih.flow(dih.state(*smooth_flow(at.x)))
        for name, discrete, true in terms(dih, flow, exact):
            error = np.linalg.norm(discrete - true)/np.linalg.norm(true)
            yield {"operator": name, "error": error, "ratio": ratio(discrete, true)}


def ratio(literal: np.ndarray, true: np.ndarray) -> float:
    """Projection of one field on another."""
    return float(np.vdot(literal, true)/np.vdot(true, true))


# --- sums read literally ------------------------------------------------------------------------------------


class Arithmetic(Case, table="numbers"):
    """Single numbers without parameters. numbers : function that gives them by name."""
    numbers: Callable[[], dict[str, float]]

    def measure(self, report: Report) -> Iterator[Row]:
        for name, value in self.numbers().items():
            yield {"quantity": name, "value": value}


def brackets(edges: Edges) -> Sums:
    """The matrices W(r_ij) e^alpha_ij of Eqs 29, 33-38, one per direction; e_ij points from j to i."""
    return [sparse.csr_array(sparse.diags_array(-0.5/edges.V)@S) for S in edges.areas]


def inner(w: Sums, v: np.ndarray) -> np.ndarray:
    """sum_k W e^alpha_jk v^beta_k, (n, d, d): -grad v."""
    return np.stack([M@v for M in w], axis=1)


def kernel(g: np.ndarray, eta: float, zeta: float, trace: float) -> np.ndarray:
    """pi_ij of Eq. 37, which constant viscosities make independent of i; trace : factor; g : from `inner`."""
    div = np.trace(g, axis1=1, axis2=2)[:, None, None]*np.eye(g.shape[1])
    return -eta*(g + g.transpose(0, 2, 1) - trace*div) - zeta*div


def gathered(w: Sums, F: np.ndarray) -> np.ndarray:
    """sum_j W e^b_ij (F^b_i + F^b_j), of F (n, d) or symmetric (n, d, d)    [RR98 Eqs 35, 36]"""
    return sum(M@q + (q.T*M.sum(axis=1)).T for M, q in zip(w, F.swapaxes(0, 1), strict=True))


def mass_rate(w: Sums, m: np.ndarray, v: np.ndarray) -> np.ndarray:
    """dm_i/dt    [RR98 Eq. 34]; with a component of p for m, its rate by convection    [Eq. 35]"""
    return sum(m*(M@u) + u*(M@m) for M, u in zip(w, v.T, strict=True))


def of_volumes() -> dict[str, float]:
    """Eqs 26, 27, 33-37 read literally, over the terms they stand for: a wave along x in 2D, dV = 1/4.

    Besides what the printed trace factor 2/3 adds to the bulk viscosity, over the shear viscosity.
    """
    at = lattice((ROWS, 8), SPACING)
    edges = renormalised(at, Lucy.of(h=3*SPACING))
    w, dV = brackets(edges), edges.V[0]
    k = 2*np.pi/(ROWS*SPACING)
    s, c = np.sin(k*at.x[:, 0]), np.cos(k*at.x[:, 0])
    v = np.stack([s, c], axis=1)
    mass, thinning = dV*np.ones(edges.n), -k*c*dV
    moved = np.stack([mass_rate(w, p, v*dV) for p in (dV*v*dV).T])
    momentum = -k*np.stack([2*s*c, c**2 - s**2])*dV             # -div(v v) dV, rho = 1
    P = np.stack([(1 + 0.1*s)*dV, 0*s], axis=1)                 # at rest, uniform T: P_ij + P_ji = P_i + P_j
    stress = kernel(inner(w, v), 1.0, 0.0, 1.0)                 # eta = 1, zeta = 0 in 2D: div Pi = lap v
    return {
        "divergence, Eq. 33 in Eq. 1": ratio(-(w[0]@s), k*c),
        "mass, v_i = v": ratio(mass_rate(w, mass, v), thinning),
        "mass, v_i = v dV": ratio(mass_rate(w, mass, v*dV), thinning),
        "momentum, p_i = m_i v_i, v_i = v dV": ratio(moved, momentum),
        "pressure, P_ij = P dV": ratio(gathered(w, P), 0.1*thinning),
        "stress, v_i = v": ratio(-gathered(w, stress), -k**2*v*dV),
        "linearised mass, Eq. 21": ratio(*linearised(w, s, c)),
        "dilation in 3D": added_bulk(3, 2/3),
    }


def linearised(w: Sums, s: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Right-hand side of Eq. 21 as printed, and the derivative of Eq. 34."""
    rho, d_rho = 1 + 0.2*s, 0.1*c
    v = np.stack([0.3 + 0.1*c, 0*c], axis=1)
    dv = 0.1*np.stack([s, c], axis=1)
    printed = -mass_rate(w, rho, dv) - mass_rate(w, d_rho, v)
    above = mass_rate(w, rho + STEP*d_rho, v + STEP*dv)
    below = mass_rate(w, rho - STEP*d_rho, v - STEP*dv)
    return printed, (above - below)/(2*STEP)


def added_bulk(d: int, trace: float) -> float:
    """Bulk viscosity that a trace factor adds to zeta, over eta = 1    [RR98 Eqs 16, 37]

    From the mean normal stress of v = x in a patch's middle.
    """
    at, zeta = lattice((12,)*d), 0.3
    edges = renormalised(at, WendlandC2.of(h=2.5, d=d))
    middle = (np.abs(at.x) < 2).all(axis=1)
    stress = kernel(inner(brackets(edges), at.x), 1.0, zeta, trace)[middle]
    return float(np.trace(stress, axis1=1, axis2=2).mean()/d**2 - zeta)         # div v = d
