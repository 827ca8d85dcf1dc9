"""Terms of the equations on lattices against exact derivatives    [RR98 Eqs 10-19, 34-38, 51]"""
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, PowerLaw, VanDerWaals
from particles.integral.dih import Dih, Flow, NestedFluxes, Pairwise, carried, rows, take
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import lattice
from studies.kit.case import Case, Outcome, Report
from studies.operators.weights import weight_of

ETA, ZETA, KAPPA = 0.02, 0.01, 0.03
PRINTED, ALONG, MENDED = NestedFluxes(differences=False), Pairwise(mended=False), Pairwise()
CHANGING = PowerLaw(ETA, KAPPA, n=1.0)      # eta and kappa proportional to T
CONSTANT = ConstEta(ETA, KAPPA)


def derivative(f: np.ndarray, axis: int, cells: int) -> np.ndarray:
    """d f/d x_axis of periodic values (cells^d,) on the unit box: exact for waves longer than two spacings."""
    box = f.reshape((cells,)*round(np.log(f.size)/np.log(cells)))
    k = 2*np.pi*np.fft.fftfreq(cells, 1/cells)
    k[cells//2] = 0
    shape = [-1 if a == axis else 1 for a in range(box.ndim)]
    return np.fft.ifft(1j*k.reshape(shape)*np.fft.fft(box, axis=axis), axis=axis).real.ravel()


def smooth_flow(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(rho, v, T) of one wave along each axis of the unit box; phases differ, so that no term is zero or symmetric."""
    phi = 2*np.pi*x
    turned = np.roll(phi, 1, axis=1)
    rho = 1 + 0.05*np.sin(phi + np.arange(phi.shape[1])).sum(axis=1)
    T = 1 + 0.05*np.cos(phi + 0.5 + 2*np.arange(phi.shape[1])).sum(axis=1)
    v = 0.2*np.sin(turned + 0.3) + 0.1*np.cos(phi + 0.7)
    return rho, v, T


@dataclass(frozen=True)
class Exact:
    """Right-hand sides of Eqs 7-9, term by term, of fields (n,) or (n, d) on a lattice in the unit box."""
    cells: int
    flow: Flow
    zeta: float

    def grad(self, f: np.ndarray) -> np.ndarray:
        """(n, d) of f (n,)."""
        return np.stack([derivative(f, a, self.cells) for a in range(self.flow.v.shape[1])], axis=1)

    def div(self, F: np.ndarray) -> np.ndarray:
        """sum_a d_a F[:, a] of F (n, d, ...)."""
        if F.ndim == 3:
            return np.stack([self.div(F[:, :, b]) for b in range(F.shape[2])], axis=1)
        return np.sum([derivative(q, a, self.cells) for a, q in enumerate(F.T)], axis=0)

    def slope(self) -> np.ndarray:
        """[n, a, b] = d_a v_b."""
        return np.stack([self.grad(q) for q in self.flow.v.T], axis=2)

    def stress(self, eta: np.ndarray) -> np.ndarray:
        """eta (grad v + grad v^T - (2/d) div v) + zeta div v, (n, d, d)."""
        g, one = self.slope(), np.eye(self.flow.v.shape[1])
        div = np.trace(g, axis1=1, axis2=2)[:, None, None]*one
        return eta[:, None, None]*(g + g.transpose(0, 2, 1) - 2/len(one)*div) + self.zeta*div

    def mass(self) -> np.ndarray:
        """-div(rho v)    [RR98 Eq. 7]"""
        return -self.div(self.flow.rho[:, None]*self.flow.v)

    def momentum(self, eta: np.ndarray) -> np.ndarray:
        """-div(j v + P 1 - Pi)    [RR98 Eq. 8]"""
        rho, v, P = self.flow.rho, self.flow.v, self.flow.P
        carried = rho[:, None, None]*v[:, :, None]*v[:, None, :]
        return self.div(self.stress(eta)) - self.div(carried) - self.grad(P)

    def energy(self, eta: np.ndarray, kappa: np.ndarray) -> np.ndarray:
        """-div[e v + (P 1 - Pi).v + J]    [RR98 Eq. 9]"""
        v, flow = self.flow.v, self.flow
        work = np.einsum("nab,nb->na", self.stress(eta), v)
        return -self.div((flow.eps + flow.P)[:, None]*v - work - kappa[:, None]*self.grad(flow.T))


def arriving(edges: Edges, flux: np.ndarray) -> np.ndarray:
    """Rate per volume of what flows from i to j, flux (E,) or (E, m)."""
    if flux.ndim == 2:
        return np.stack([arriving(edges, q) for q in flux.T], axis=1)
    return (np.bincount(edges.j, flux, edges.n) - np.bincount(edges.i, flux, edges.n))/edges.V


def terms(dih: Dih, flow: Flow, exact: Exact) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """(operator, found, exact) with Eqs 34-38 as printed but for the trace factor, eta and kappa proportional to T."""
    edges, still = dih.edges, flow._replace(v=np.zeros_like(flow.v))
    eta, kappa = dih.coefficients(flow).eta, dih.coefficients(flow).kappa
    grad_T = exact.grad(flow.T)
    current = kappa[:, None]*grad_T
    yield "gradient", edges.grad(flow.T), grad_T
    kernel = carried(dih.eos, edges.S, take(still, edges.i), take(still, edges.j)).momentum
    yield "pressure", arriving(edges, kernel), -exact.grad(flow.P)
    yield "stress kernel", PRINTED.gradient(edges, flow.v), exact.slope()
    yield "heat kernel", -kappa[:, None]*PRINTED.gradient(edges, flow.T[:, None])[:, :, 0], -current
    yield "viscous nested", arriving(edges, PRINTED.fluxes(dih, flow).momentum), exact.div(exact.stress(eta))
    for name, transport in (("nested", PRINTED), ("pairwise", ALONG)):
        yield f"heat {name}", arriving(edges, transport.fluxes(dih, still).energy), exact.div(current)
    moved = carried(dih.eos, edges.S, take(flow, edges.i), take(flow, edges.j))
    mass, *momentum, energy = (arriving(edges, q) for q in rows(moved, PRINTED.fluxes(dih, flow)))
    yield "mass", mass, exact.mass()
    yield "momentum", np.stack(momentum, axis=1), exact.momentum(eta)
    yield "energy", energy, exact.energy(eta, kappa)


def frictions(dih: Dih, flow: Flow, exact: Exact) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """(operator, found, exact) of forces along edges    [RR98 Eq. 51]: constant viscosities, and eta proportional to T.

    With q = (zeta - eta (1 + 2/d))/2 they make div(q (grad v - div v)) more than the Navier-Stokes force; constant q makes none.
    """
    d = dih.edges.d
    for zeta in (ZETA, 0.0) if d > 1 else (ZETA,):       # on a line only zeta counts
        constant, there = replace(dih, law=CONSTANT, zeta=zeta), replace(exact, zeta=zeta)
        force = arriving(dih.edges, ALONG.fluxes(constant, flow).momentum)
        yield f"friction, zeta {zeta:g}", force, there.div(there.stress(constant.coefficients(flow).eta))
    if d == 1:
        return
    changing = replace(dih, zeta=0.0)
    eta, slope = changing.coefficients(flow).eta, exact.slope()
    force = arriving(dih.edges, ALONG.fluxes(changing, flow).momentum)
    true = there.div(there.stress(eta))
    div = np.trace(slope, axis1=1, axis2=2)[:, None]
    more = -(1 + 2/d)/2*(np.einsum("nc,nac->na", exact.grad(eta), slope) - exact.grad(eta)*div)
    yield "friction, eta(T)", force, true
    yield "friction, eta(T), foretold", force, true + more
    yield "friction, eta(T), mended", arriving(dih.edges, MENDED.fluxes(changing, flow).momentum), true


def comparison(discrete: np.ndarray, exact: np.ndarray) -> dict[str, float]:
    """Relative rms error, and projection of the discrete field on the exact one."""
    size = float(np.sum(exact**2))
    error = np.sqrt(np.sum((discrete - exact)**2)/size)
    return {"error": float(error), "ratio": float(np.sum(discrete*exact)/size)}


@dataclass(frozen=True, kw_only=True)
class EquationErrors(Case):
    """All terms of the equations for one smooth flow on a lattice of cells^d points, h in spacings; printed where printed."""
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
        exact = Exact(self.cells, flow, ZETA)
        key = {"d": self.d, "weight": self.kind.__name__, "h": self.h, "cells": self.cells}
        pairs = (*terms(dih, flow, exact), *frictions(dih, flow, exact))
        return Outcome({"equations": [{**key, "operator": name, **comparison(discrete, true)}
                                      for name, discrete, true in pairs]})

