"""Slow, readable twin of `particles.integral.layer`: discretized integral hydrodynamics between plates, edge by edge in numpy.

Convection and pressure see a plate without friction, so that the divergence stays the adjoint of the gradient: images have
rho, T, eps and the velocity along the plate of their parents, the velocity across it reversed, and a pressure that goes on
hydrostatically. Friction and heat see images with -v and 2 T_w - T. Any other mixture lets sound grow.
"""
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from continuum.fluid import constant_viscosity
from particles.integral.dih import Coefficients, Dih, Flow, Fluxes, Pairwise, along, carried, means, rows, take, transposed
from particles.integral.edges import Beyond

SLIP = np.array([1.0, -1.0])
ADJOINT = np.array([-1.0, 1.0])     # of stresses that are made of gradients that see -v


@dataclass(frozen=True, kw_only=True)
class PlainLayer(Dih):
    """A fluid on fixed points between two plates under gravity, in 2D; friction and heat along edges.

    beyond : edges to images. T_plates : of the lower and the upper plate. g : gravity, downwards. y : heights of the points.
    """
    beyond: Beyond
    T_plates: tuple[float, float]
    g: float
    y: np.ndarray

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`    [Eqs 34-36, 51]"""
        flow, edges, beyond = self.flow(state), self.edges, self.beyond
        coefficients = self.coefficients(flow)
        inner = along(edges, means(coefficients, edges.i, edges.j), take(flow, edges.i), take(flow, edges.j))
        outer = self._friction(flow, coefficients)
        if self.mended:
            tau = transposed(coefficients, self._slope(flow.v))
            F = np.einsum("nab,nb->na", tau, flow.v)
            inner = inner._replace(energy=inner.energy - (edges.S*(F[edges.i] + F[edges.j])).sum(axis=1)/2)
            outer = outer._replace(energy=outer.energy - (beyond.S*(F[beyond.i] + SLIP*F[beyond.parent])).sum(axis=1)/2)
            if not constant_viscosity(self.law):
                among, image = tau[edges.i] + tau[edges.j], tau[beyond.i] + ADJOINT[:, None]*tau[beyond.parent]
                inner = inner._replace(momentum=inner.momentum - np.einsum("ea,eab->eb", edges.S, among)/2)
                outer = outer._replace(momentum=outer.momentum - np.einsum("ea,eab->eb", beyond.S, image)/2)
        through = rows(carried(self.eos, edges.S, take(flow, edges.i), take(flow, edges.j)), inner)
        for row, flux, lost in zip(out, through, rows(self._slipping(flow), outer), strict=True):
            row[:] = np.bincount(edges.j, flux, edges.n) - np.bincount(edges.i, flux, edges.n)
            row[:] = (row - np.bincount(beyond.i, lost, edges.n))/edges.V
        out[2] -= self.g*flow.rho
        out[3] -= self.g*flow.rho*flow.v[:, 1]

    @property
    def mended(self) -> bool:
        """Is the heating of friction along edges mended?"""
        return isinstance(self.transport, Pairwise) and self.transport.mended

    def _slipping(self, flow: Flow) -> Fluxes:
        """What convection and pressure take through the plates' edges: no mass and no energy in all."""
        beyond, parent = self.beyond, take(flow, self.beyond.parent)
        image = parent._replace(v=parent.v*SLIP)
        depth = self._depth()
        return carried(self.eos, beyond.S, take(flow, beyond.i), image, weight=parent.rho*self.g*depth)

    def _depth(self) -> np.ndarray:
        """How much higher the parents lie than their images."""
        y = self.y
        return y[self.beyond.parent] - (y[self.beyond.i] + self.beyond.apart[:, 1])

    def _friction(self, flow: Flow, coefficients: Coefficients) -> Fluxes:
        """Friction and heat of images with -v and 2 T_w - T."""
        beyond, parent = self.beyond, take(flow, self.beyond.parent)
        image = parent._replace(v=-parent.v, T=2*np.array(self.T_plates)[beyond.plate] - parent.T)
        return along(beyond, means(coefficients, beyond.i, beyond.parent), take(flow, beyond.i), image)

    def _slope(self, v: np.ndarray) -> np.ndarray:
        """(n, 2, 2) of differences, images with -v."""
        edges, beyond = self.edges, self.beyond
        inside = np.stack([G@v for G in edges.G], axis=1)
        jump = -v[beyond.parent] - v[beyond.i]
        half = 0.5*beyond.S[:, :, None]*jump[:, None, :]
        spread = sparse.csr_array((np.ones(len(beyond.i)), (beyond.i, np.arange(len(beyond.i)))), shape=(edges.n, len(beyond.i)))
        outside = (spread@half.reshape(len(half), 4)).reshape(-1, 2, 2)
        return (inside + outside)/edges.V[:, None, None]
