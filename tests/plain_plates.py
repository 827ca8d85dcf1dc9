"""Integral hydrodynamics between plates, edge by edge in numpy: the readable twin of `layer`.

Plates are across y; m = (1, -1) is what a mirror makes of a vector. Convection and
pressure see images with rho, T, eps, P even and m v, P going on hydrostatically; friction and heat see -v and
2 T_w - T. An edge from i to the image of p has a twin from p to the image of i, of area -m S. Hence the
adjoint of slopes d_a that see odd images sees -m_a, and sums that are to stay go through images with m_a:

    v       m       the divergence is minus the adjoint of the gradient, which sees P even: sound stays
    tau_ab  -m_a    first the direction, as of the heat current, made of slopes: both only damp
    F_a     m_a     tau_ab v_b, the work that mends the heating: -m_a times -1

A force along an edge, A e e.(v_j - v_i) in Eq. 51, would not be symmetric: the twin lies along -m e. Edges
to images take the mean of both, so that plates at rest do no work. A is 0 without bulk viscosity.
"""
from dataclasses import dataclass
from functools import cached_property, singledispatch
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import stress_tensor
from particles.integral import dih
from particles.integral.dih import Dih, EdgeFluxes, Flow, Mixed, NestedFluxes, Pairwise, take
from particles.integral.edges import MIRROR, Beyond


class Ends(NamedTuple):
    """Edges from i to points, then to images of `to`. Of images: signs (E, d), (E, 1), 2 T_w, how much
    higher `to` is."""
    i: np.ndarray
    to: np.ndarray
    S: np.ndarray
    k: np.ndarray
    apart: np.ndarray
    mirror: np.ndarray
    odd: np.ndarray
    T_twice: np.ndarray
    rise: np.ndarray


@dataclass(frozen=True, kw_only=True)
class PlainPlates(Dih):
    """A fluid on fixed points x (n, 2) between plates at T_plates (lower, upper) under gravity g, downwards.

    edges, beyond : of `edges.between_plates`. transport : Pairwise, Mixed or Nested, with eta_i grad v_j as
    Eqs 37 and 38 have it (`layer` has eta_j grad v_j).
    """
    x: np.ndarray
    beyond: Beyond
    T_plates: tuple[float, float]
    g: float = 0.0

    @cached_property
    def ends(self) -> Ends:
        """All edges, those to images last."""
        edges, beyond, joined = self.edges, self.beyond, np.concatenate
        one, none, images = np.ones_like(edges.S), np.zeros(len(edges.i)), np.ones_like(beyond.S)
        rise = self.x[beyond.parent, -1] - (self.x[beyond.i, -1] + beyond.apart[:, -1])
        return Ends(joined([edges.i, beyond.i]), joined([edges.j, beyond.parent]),
                    joined([edges.S, beyond.S]),
                    joined([edges.k, beyond.k]), joined([edges.apart, beyond.apart]),
                    joined([one, MIRROR*images]),
                    joined([one, -images])[:, :1], joined([none, 2*np.array(self.T_plates)[beyond.plate]]),
                    joined([none, rise]))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt, written to `out`    [Eqs 34-36]"""
        flow, edges, ends = self.flow(state), self.edges, self.ends
        far = take(flow, ends.to)
        near, half, weight = take(flow, ends.i), ends.S/2, far.rho*self.g*ends.rise
        moved = dih.carried(self.eos, ends.S, near, far._replace(v=far.v*ends.mirror))
        moved = moved._replace(momentum=moved.momentum + half*weight[:, None],
                               energy=moved.energy + weight*(half*near.v).sum(axis=1))
        mass, momentum, energy = map(sum, zip(moved, spread(self.transport, self, flow), strict=True))
        for row, flux in zip(out, (mass, *momentum.T, energy), strict=True):
            row[:] = (np.bincount(edges.j, flux[:len(edges.j)], edges.n)
                      - np.bincount(ends.i, flux, edges.n))/edges.V
        out[-2] -= self.g*flow.rho
        out[-1] -= self.g*state[-2]

    def opposite(self, flow: Flow) -> Flow:
        """What friction and heat see at the far ends: points, images with -v and 2 T_w - T."""
        far, ends = take(flow, self.ends.to), self.ends
        return far._replace(v=far.v*ends.odd, T=far.T*ends.odd[:, 0] + ends.T_twice)

    def gradient(self, transport: NestedFluxes, f: np.ndarray, far: np.ndarray) -> np.ndarray:
        """(n, d, m) of f (n, m), `far` (E, m) at the far ends: `Nested.gradient` with images."""
        edges, beyond = self.edges, self.beyond
        step = far[len(edges.i):] - (f[beyond.i] if transport.differences else 0)
        images = np.zeros((edges.n, edges.d, f.shape[1]))
        np.add.at(images, beyond.i, beyond.S[:, :, None]*step[:, None, :]/2)
        return transport.gradient(edges, f) + images/edges.V[:, None, None]


@singledispatch
def spread(transport: Any, fluid: PlainPlates, flow: Flow) -> EdgeFluxes:
    """Friction and heat through all edges and those to images."""
    raise TypeError(transport)


@spread.register
def _(transport: Pairwise, fluid: PlainPlates, flow: Flow) -> EdgeFluxes:
    ends, c, far = fluid.ends, fluid.coefficients(flow), fluid.opposite(flow)
    dih.check_bulk(c.eta, c.zeta, fluid.edges.d)
    twins = ends._replace(apart=ends.apart*ends.mirror)
    both = (dih.along(edges, dih.means(c, ends.i, ends.to), take(flow, ends.i), far)
            for edges in (ends, twins))
    found = EdgeFluxes(*((a + b)/2 for a, b in zip(*both, strict=True)))
    if transport.mended:
        slope = fluid.gradient(NestedFluxes(), flow.v, far.v)
        tau = dih.transposed(c, slope)
        F = np.einsum("nab,nb->na", tau, flow.v)
        found = found._replace(energy=found.energy
                               - (ends.S*(F[ends.i] + ends.mirror*F[ends.to])).sum(axis=1)/2)
        if np.ptp(c.eta) > 0 or np.ptp(c.zeta) > 0:
            force = np.einsum("ea,eab->eb", ends.S,
                              tau[ends.i] + (ends.odd*ends.mirror)[:, :, None]*tau[ends.to])/2
            found = found._replace(momentum=found.momentum - force)
    return found


@spread.register
def _(transport: NestedFluxes, fluid: PlainPlates, flow: Flow) -> EdgeFluxes:
    ends, far, (eta, zeta, kappa) = fluid.ends, fluid.opposite(flow), fluid.coefficients(flow)
    i, to, half, sign = ends.i, ends.to, ends.S/2, ends.odd*ends.mirror
    slope = fluid.gradient(transport, flow.v, far.v)
    heat = fluid.gradient(transport, flow.T[:, None], far.T[:, None])[:, :, 0]
    one, other = sign[:, :, None]*stress_tensor(eta[i], zeta[i], slope[to]), stress_tensor(eta[to], zeta[to],
                                                                                           slope[i])
    work = np.einsum("ea,eab,eb->e", half, one, flow.v[i]) + np.einsum("ea,eab,eb->e", half, other, far.v)
    current = -kappa[i, None]*sign*heat[to] - kappa[to, None]*heat[i]
    return EdgeFluxes(np.zeros(len(i)), -np.einsum("ea,eab->eb", half, one + other),
                      (half*current).sum(axis=1) - work)


@spread.register
def _(transport: Mixed, fluid: PlainPlates, flow: Flow) -> EdgeFluxes:
    share, both = transport.share, (spread(kind, fluid, flow) for kind in (Pairwise(), NestedFluxes()))
    return EdgeFluxes(*(share*one + (1 - share)*other for one, other in zip(*both, strict=True)))
