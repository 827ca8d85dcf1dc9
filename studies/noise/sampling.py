"""Fluctuations sampled from the full equations    [RR98 Eqs 20-25]

A mean is over 20 batches, each as long as ten decay times of the slowest mode or longer, and started where
the previous one ended. The scatter of the batches, with its t factor, is the error.
"""
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edge_makers import delaunay
from particles.integral.points import jittered
from particles.integral.thermal import Thermal
from particles.limits import jacobian, limit_of
from particles.run import Plan, run
from studies.kit.case import Case, Report
from studies.kit.stats import over_seeds, with_errors
from studies.kit.table import Row
from studies.noise.partners import ETA, KAPPA, ZETA

BATCHES = 20
DECAYS = 10         # least length of a batch in decay times of the slowest mode


def check_length(J: np.ndarray, time: float) -> None:
    """Raise ValueError if batches are shorter than DECAYS decay times of the slowest mode not conserved."""
    rates = -np.linalg.eigvals(J).real
    slow = float(rates[rates > 1e-9*rates.max()].min())
    if time*slow < DECAYS:
        raise ValueError(f"a batch of {time:.4g} is {time*slow:.3g} decay times of the slowest mode, less "
                         f"than {DECAYS}: batches would be correlated; take {DECAYS/slow:.4g} or longer")


class Nonlinear(Case, table="nonlinear", same="share k"):
    """Variances of rho, v and T in the full equations on jittered points, over those of equilibrium."""
    counts: tuple[int, int]
    share: float
    k: float
    time: float         # of a batch
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.time/0.1*3e-3

    def measure(self, report: Report) -> Iterator[Row]:
        edges = delaunay(jittered(self.counts, 0.2, self.seed), None)
        method = Thermal(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, share=self.share,
                         k=self.k, seed=self.seed)
        one, V = np.ones(edges.n), edges.V
        start = method.state(one, np.zeros((edges.n, 2)), one)
        check_length(jacobian(method.rates, start), self.time)
        dt = 0.6*limit_of(method, start)
        steps = int(np.ceil(self.time/dt/5))*5
        means = {"squares": lambda sums, state: V@squares(sums.dih.flow(state))}
        plan, state, powers = Plan(dt=dt, steps=steps, every=5, means=means), start, []
        for number in range(BATCHES + 1):
            batch = run(replace(method, seed=1000*self.seed + number), state, plan)
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
