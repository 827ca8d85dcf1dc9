"""Fluctuations sampled: of the full equations, and of temperatures    [RR98 Eqs 20-25, 42, 43]

A mean is over 20 batches, each of which starts where the previous one ended. Its error is their scatter, with
its t factor. A batch lasts for ten decay times of the slowest mode or longer: batches are independent.
"""
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.edge_makers import delaunay, renormalised
from particles.integral.edges import Edges
from particles.integral.points import jittered, lattice
from particles.integral.thermal import Thermal, fill_pairs
from particles.limits import limit_of
from particles.run import Plan, run
from particles.weights import Lucy
from studies.kit.case import Case, Report
from studies.kit.stats import over_seeds, with_errors
from studies.kit.table import Row
from studies.noise.partners import ETA, KAPPA, ZETA

BATCHES = 20


class Nonlinear(Case, table="nonlinear", same="share k"):
    """Variances of rho, v and T in the full equations on jittered points, over those of equilibrium."""
    counts: tuple[int, int]
    share: float
    k: float
    time: float         # of a batch

    @property
    def cost(self) -> float:
        return BATCHES*self.time/0.1*3e-3

    def measure(self, report: Report) -> Iterator[Row]:
        edges = delaunay(jittered(self.counts, 0.2, 1), None)
        method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, share=self.share,
                         k=self.k, seed=1)
        one, V = np.ones(edges.n), edges.V
        start = method.state(one, np.zeros((edges.n, 2)), one)
        dt = 0.6*limit_of(method, start)
        steps = int(np.ceil(self.time/dt/5))*5
        means = {"squares": lambda sums, state: V@squares(sums.method.flow(state))}
        plan, state, powers = Plan(dt=dt, steps=steps, every=5, means=means), start, []
        for number in range(BATCHES + 1):
            batch = run(replace(method, seed=1000 + number), state, plan)
            state = batch.state
            powers.append(batch.means["squares"])
            report((number + 1)/(BATCHES + 1))
        before = start@V
        drift = np.abs(state@V - before).max()/before[-1]
        ratios = np.array(powers[1:])/(edges.n - 1)/self.k      # the first batch forgets the start
        for name, values in zip(("rho", "v", "T"), ratios.T, strict=True):
            yield {"drift": drift, "field": name, **with_errors(ratio=over_seeds(values))}


def squares(flow: Any) -> np.ndarray:
    """Squared fluctuations (n, 3) of rho, v and T, each with mean k/V in equilibrium."""
    kinetic = flow.rho*(flow.v**2).sum(axis=1)/2
    return np.stack([(flow.rho - 1)**2, kinetic, (flow.T - 1)**2], axis=1)


# --- heat with current amplitudes ------------------------------------------------------------


class Capacity(Case, table="capacity", same="C"):
    """Variance of the temperatures of points whose random heat has amplitudes of current temperatures."""
    C: float
    steps: int
    counts: tuple[int, int] = (6, 6)
    dt: float = 0.05

    def measure(self, report: Report) -> Iterator[Row]:
        edges = renormalised(lattice(self.counts), Lucy.of(h=1.5))
        J = edges.laplacian.toarray()/edges.V[:, None]
        one, T, variances = np.eye(edges.n), np.ones(edges.n), []
        inverse = np.linalg.inv(one - self.dt/2*J)      # Crank-Nicolson: exact variances at any step
        A = inverse@(one + self.dt/2*J)
        for batch in range(BATCHES + 1):
            kick, looks = heat_kicks(edges, self.C, self.dt, 1000 + batch), []
            for step in range(self.steps):
                T = A@T + inverse@kick(T, step)
                looks.append(np.var(T))
            variances.append(np.mean(looks[1::2]))
            report((batch + 1)/(BATCHES + 1))
        # `var` divides by n: it is (n - 1)/n of the variance of one point, as `dirichlet` is
        yield {"due": dirichlet(edges.n, self.C + 1), **with_errors(measured=over_seeds(variances[1:]))}


def heat_kicks(edges: Edges, C: float, dt: float, seed: int) -> Callable[[np.ndarray, int], np.ndarray]:
    """Random heat with amplitudes of the current T_i T_j, points of heat capacity C (in k), kappa = C."""
    across, normals, i, j = fluctuating.incidence(edges), np.empty((len(edges.i), 1)), edges.i, edges.j

    def kick(T: np.ndarray, step: int) -> np.ndarray:
        fill_pairs(0, len(normals), seed, step, i, j, normals)
        squared = np.maximum(T[i]*T[j], 0)      # rarely negative
        amplitude = np.sqrt(2*edges.k*squared/C*dt)
        return across@(amplitude*normals[:, 0])/edges.V
    return kick


def dirichlet(n: int, alpha: float) -> float:
    """Var T/T^2 of n points whose energies, with a fixed sum, have the distribution Dirichlet(alpha).

    Entropies C ln T make alpha = C/k + 1; current amplitudes without Ito's correction make C/k of it.
    """
    return (n - 1)/(n*alpha + 1)
