"""Terms of the equations on lattices against exact derivatives    [RR98 Eqs 10-19, 34-38, 51]"""
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, PowerLaw, VanDerWaals, stress_tensor
from particles.integral.dih import Dih, Flow, Nested, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import lattice
from studies.kit.case import Case, Outcome, Report
from studies.operators.integrals import weight_of

ETA, ZETA, KAPPA = 0.02, 0.01, 0.03
PRINTED, ALONG = Nested(differences=False), Pairwise(mended=False)
CHANGING = PowerLaw(ETA, KAPPA, n=1.0)      # eta and kappa proportional to T
CONSTANT = ConstEta(ETA, KAPPA)

#: (operator, discrete, exact)
Terms = Iterator[tuple[str, np.ndarray, np.ndarray]]


class Spectral(NamedTuple):
    """Derivatives of fields (n, ...) on a lattice in the unit box, exact for waves above two spacings."""
    shape: tuple[int, ...]

    def derivative(self, f: np.ndarray, axis: int) -> np.ndarray:
        """d f/d x_axis."""
        cells = self.shape[axis]
        k = 2*np.pi*np.fft.fftfreq(cells, 1/cells)
        k[cells//2] = 0
        box = np.moveaxis(f.reshape(*self.shape, -1), axis, -1)
        slope = np.fft.ifft(1j*k*np.fft.fft(box)).real
        return np.moveaxis(slope, -1, axis).reshape(f.shape)

    def grad(self, f: np.ndarray) -> np.ndarray:
        """[n, a, ...] = d_a f."""
        return np.stack([self.derivative(f, a) for a in range(len(self.shape))], axis=1)

    def div(self, F: np.ndarray) -> np.ndarray:
        """sum_a d_a F[:, a]."""
        return np.sum([self.derivative(F[:, a], a) for a in range(len(self.shape))], axis=0)


def smooth_flow(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(rho, v, T) of one wave along each axis of the unit box; no term is zero or symmetric."""
    phi = 2*np.pi*x
    axes = np.arange(phi.shape[1])
    rho = 1 + 0.05*np.sin(phi + axes).sum(axis=1)
    T = 1 + 0.05*np.cos(phi + 0.5 + 2*axes).sum(axis=1)
    v = 0.2*np.sin(np.roll(phi, 1, axis=1) + 0.3) + 0.1*np.cos(phi + 0.7)
    return rho, v, T


def arriving(edges: Edges, flux: np.ndarray) -> np.ndarray:
    """Rate per volume of what flows from i to j, flux (E,) or (E, m)."""
    if flux.ndim == 2:
        return np.stack([arriving(edges, q) for q in flux.T], axis=1)
    return (np.bincount(edges.j, flux, edges.n) - np.bincount(edges.i, flux, edges.n))/edges.V


def rates(dih: Dih, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    dih.rates(state, out)
    return out


def terms(dih: Dih, flow: Flow, exact: Spectral) -> Terms:
    """Eqs 34-38 as printed but for the trace factor, eta and kappa proportional to T."""
    rho, v, T, eps, P = flow
    eta, _, kappa = dih.coefficients(flow)
    stress = stress_tensor(eta, ZETA, exact.grad(v))
    current = kappa[:, None]*exact.grad(T)
    yield "gradient", dih.edges.grad(T), exact.grad(T)
    yield "viscous nested", arriving(dih.edges, PRINTED.fluxes(dih, flow).momentum), exact.div(stress)
    still = rates(dih, dih.state(rho, 0*v, T))
    yield "pressure", still[1:-1].T, -exact.grad(P)
    yield "heat nested", still[-1], exact.div(current)
    mass, *momentum, energy = rates(dih, dih.state(rho, v, T))
    yield "mass", mass, -exact.div(rho[:, None]*v)                                             # [Eq. 7]
    convected = rho[:, None, None]*v[:, :, None]*v[:, None, :]
    yield "momentum", np.stack(momentum, axis=1), exact.div(stress - convected) - exact.grad(P)     # [Eq. 8]
    work = np.einsum("nab,nb->na", stress, v)
    yield "energy", energy, -exact.div((eps + P)[:, None]*v - work - current)                  # [Eq. 9]


def frictions(dih: Dih, flow: Flow, exact: Spectral) -> Terms:
    """Forces along edges with constant viscosities, and with eta proportional to T    [RR98 Eq. 51]"""
    fluids = {"zeta 0.01": replace(dih, law=CONSTANT), "zeta 0": replace(dih, law=CONSTANT, zeta=0.0),
              "eta(T)": replace(dih, zeta=0.0)}
    slope = exact.grad(flow.v)
    for name, fluid in fluids.items():
        stress = stress_tensor(fluid.coefficients(flow).eta, fluid.zeta, slope)
        force = arriving(dih.edges, ALONG.fluxes(fluid, flow).momentum)
        yield f"friction, {name}", force, exact.div(stress)


@dataclass(frozen=True, kw_only=True)
class EquationErrors(Case):
    """All terms for one smooth flow on a lattice of cells^d points, h in spacings; those of Eq. 51 in 2D.

    error : relative rms. ratio : projection of the discrete field on the exact one.
    """
    d: int
    kind: Any
    h: float
    cells: int

    @property
    def cost(self) -> float:
        return 2e-5*self.cells**self.d*self.h**self.d

    def run(self, report: Report, folder: Path) -> Outcome:
        at = lattice((self.cells,)*self.d, 1/self.cells)
        edges = renormalised(at, weight_of(self.kind, self.h/self.cells, self.d))
        dih = Dih(edges=edges, eos=VanDerWaals(), law=CHANGING, zeta=ZETA, transport=PRINTED)
        flow = dih.flow(dih.state(*smooth_flow(at.x)))
        exact = Spectral((self.cells,)*self.d)
        pairs = [*terms(dih, flow, exact)]
        if self.d == 2:
            pairs += frictions(dih, flow, exact)
        key = {"d": self.d, "weight": self.kind.__name__, "h": self.h, "cells": self.cells}
        rows = []
        for name, discrete, true in pairs:
            size = np.sum(true**2)
            error = np.sqrt(np.sum((discrete - true)**2)/size)
            ratio = np.sum(discrete*true)/size
            rows.append(key | {"operator": name, "error": float(error), "ratio": float(ratio)})
        return Outcome({"equations": rows})
