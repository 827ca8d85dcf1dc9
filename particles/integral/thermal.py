"""Fluctuating hydrodynamics in time: `dih` with random stress and heat current    [RR98 Secs II D, III A]

Amplitudes are those of `fluctuating`, at current temperatures as RR98 says after Eq. 44; random numbers are
functions of (seed, step, i, j). Without a share along edges none are drawn for pairs.
"""
import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from continuum.fluid import energy, sound_speed
from continuum.jit import jit
from particles.integral.dih import Dih, EdgeFluxes, Flow, Mixed, check_bulk, frictions, gained, means, take
from particles.integral.fixed import check_number
from particles.integral.fluctuating import conductances, traceless
from particles.limits import limit_of
from particles.method import Sums
from particles.noise import check_seed, fill_normals, normals, words_of_pair
from particles.threads import Threads

#: heat capacity of a point over k; below it amplitudes at current T bias energy fluctuations by 1 % and more
LEAST_CAPACITY = 50
#: factors of the second noise W_B in stages 1, 2, 3    [Delong, Griffith, Vanden-Eijnden & Donev 2013]
BETAS = tuple(float(b) for b in ((2*np.sqrt(2) + np.sqrt(3))/5, (-4*np.sqrt(2) + 3*np.sqrt(3))/5,
                                 (np.sqrt(2) - 2*np.sqrt(3))/10))
#: shares of the state before the step in stages 1, 2, 3; the rest is an Euler step from the stage before
OLD = (0.0, 3/4, 1/3)


class ThreeStage:
    """Three averaged Euler steps, each with its own mean of two noises; covariances of third order.

    sums.kicks(y, beta, dt, out) writes the change by the noise W_A + beta W_B    [Delong et al. 2013]
    """

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self._start, self._k, self._kick = (np.empty(shape) for _ in range(3))

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        self._start[:] = y
        for old, beta in zip(OLD, BETAS, strict=True):
            sums.rates(y, self._k)
            sums.kicks(y, beta, dt, self._kick)
            y[:] = old*self._start + (1 - old)*(y + dt*self._k + self._kick)


@dataclass(frozen=True, kw_only=True)
class Thermal(Dih):
    """A fluid on fixed points with the fluctuations of its own transport, of which a share goes along edges.

    Noise balances dissipation along edges, and at points with constant coefficients. Where these vary, the
    friction of Eqs 37, 38 at points is no symmetric matrix, and no noise balances it exactly.
    k : Boltzmann's constant in the units of the fluid. Others as in `dih.Dih`.
    """
    k: float
    seed: int
    share: float = 0.0
    transport: Mixed = field(init=False)

    integrator = ThreeStage

    def __post_init__(self):
        if not self.k >= 0:
            raise ValueError(f"Boltzmann's constant k must not be negative, got {self.k}")
        check_seed(self.seed)
        object.__setattr__(self, "transport", Mixed(share=self.share))

    def start(self, n: int, threads: Threads) -> "Agitated":
        """The sums over edges. ValueError: another number of points, a double edge, or a conductance < 0."""
        check_number(n, self.edges.n)
        return Agitated(self, threads)


class Agitated(Sums):
    """Rates without noise, and kicks of one step."""

    def __init__(self, method: Thermal, threads: Threads):
        self.method, self.threads, edges, d = method, threads, method.edges, method.edges.d
        # normal numbers of W_A and of W_B: R, r, heat
        self.of_points = np.empty((edges.n, 2, d*d + 1 + d)) if method.share < 1 else None
        self.of_edges = np.empty((len(edges.i), 2, d + 2)) if method.share > 0 else None
        if method.share > 0:
            self.k = conductances(edges)
            if len(np.unique(np.stack([edges.i, edges.j]), axis=1).T) < len(edges.i):
                raise ValueError("two edges join the same points by different images: take more points")

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        self.method.rates(state, out)

    def make_ready(self, now: Any, dt: float) -> None:
        seed, edges = self.method.seed, self.method.edges
        if self.of_points is not None:
            self.threads(fill_normals, edges.n, seed, now.step, self.of_points.reshape(edges.n, -1))
        if self.of_edges is not None:
            self.threads(fill_pairs, len(edges.i), seed, now.step, edges.i, edges.j,
                         self.of_edges.reshape(len(edges.i), -1))

    def kicks(self, state: np.ndarray, beta: float, dt: float, out: np.ndarray) -> None:
        """Change of a state in dt by the noise W_A + beta W_B, with the amplitudes of that state."""
        flow, share, parts = self.method.flow(state), self.method.share, []
        for drawn, part, fluxes in ((self.of_points, 1 - share, self._at_points),
                                    (self.of_edges, share, self._along_edges)):
            if drawn is not None:
                parts.append(fluxes(flow, (drawn[:, 0] + beta*drawn[:, 1])*np.sqrt(part*dt)))
        out[:] = gained(self.method.edges, *parts)/self.method.edges.V

    def _at_points(self, flow: Flow, dW: np.ndarray) -> EdgeFluxes:
        """Random stresses and currents: -S.(s_i + s_j)/2, -S.(s_j.v_i + s_i.v_j)/2 + S.(q_i + q_j)/2."""
        edges, (eta, zeta, kappa), k = self.method.edges, self.method.coefficients(flow), self.method.k
        i, j, d, half = edges.i, edges.j, edges.d, edges.S/2
        s = np.sqrt(2*k*flow.T*eta/edges.V)[:, None]*(dW[:, :d*d]@traceless(d).T)
        s += (np.sqrt(2*k*flow.T*zeta/edges.V)*dW[:, d*d])[:, None]*np.eye(d).ravel()
        s = s.reshape(-1, d, d)
        q = (flow.T*np.sqrt(2*k*kappa/edges.V))[:, None]*dW[:, d*d + 1:]
        one, other = np.einsum("eb,eab->ea", half, s[i]), np.einsum("eb,eab->ea", half, s[j])
        work = (other*flow.v[i]).sum(axis=1) + (one*flow.v[j]).sum(axis=1)
        return EdgeFluxes(np.zeros(len(i)), -one - other, -work + (half*(q[i] + q[j])).sum(axis=1))

    def _along_edges(self, flow: Flow, dW: np.ndarray) -> EdgeFluxes:
        """Exchange by random forces along edges, their work, and random heat."""
        edges, d = self.method.edges, self.method.edges.d
        a, b, all_of = take(flow, edges.i), take(flow, edges.j), self.method.coefficients(flow)
        check_bulk(all_of.eta, all_of.zeta, d)
        (eta, zeta, kappa), k = means(all_of, edges.i, edges.j), self.method.k*self.k
        B, A = frictions(eta, zeta, d)
        B, A = (B, A) if d > 1 else (A + B, 0*A)
        e, T = edges.apart/np.sqrt((edges.apart**2).sum(axis=1))[:, None], (a.T + b.T)/2
        force = np.sqrt(2*k*T*np.maximum(B, 0))[:, None]*dW[:, :d]
        force += (np.sqrt(2*k*T*np.maximum(A, 0))*dW[:, d])[:, None]*e
        heat = np.sqrt(2*k*a.T*b.T*kappa)*dW[:, d + 1]
        return EdgeFluxes(np.zeros(len(heat)), -force, -(force*(a.v + b.v)).sum(axis=1)/2 - heat)


@jit
def fill_pairs(first, last, seed, step, i, j, out):
    """out[e, c] = normal number of (seed, step, i_e, j_e, c), for edges first..last."""
    for e in range(first, last):
        for c in range(0, out.shape[1], 4):
            found = normals(words_of_pair(seed, step, i[e], j[e], c//4))
            for m in range(min(4, out.shape[1] - c)):
                out[e, c + m] = found[m]


@limit_of.register
def _(method: Thermal, start: np.ndarray) -> float:
    """Longest stable step of three stages: 1.73 on the imaginary axis for sound, 2.51 on the real one for
    diffusion. Warns if a heat capacity is so small that amplitudes at current T bias fluctuations."""
    flow, (sound, spread) = method.flow(start), method.edges.fastest
    e = energy(method.eos, flow.rho, flow.T)
    C = (energy(method.eos, flow.rho, flow.T*(1 + 1e-6)) - e)/(1e-6*flow.T)
    least = float((method.edges.V*flow.rho*C).min())
    if method.k*LEAST_CAPACITY > least:
        warnings.warn(f"a point has the heat capacity {least/method.k:.3g} k: its energy fluctuates by up to "
                      f"k/C = {method.k/least:.2g} too much; take C >= {LEAST_CAPACITY} k", stacklevel=2)
    eta, zeta, kappa = method.coefficients(flow)
    chi = np.maximum(2*eta + zeta, kappa/C)/flow.rho
    fast = sound_speed(method.eos, flow.rho, e) + np.sqrt((flow.v**2).sum(axis=1))
    return float(1/(np.max(fast)*sound/1.73 + np.max(chi)*spread/2.51))
