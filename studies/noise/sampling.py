"""Samples of linear systems, of the full equations, of heat between points    [RR98 Eqs 20-25, 42, 43]

Each mean is made of 20 batches, each ten decay times of the slowest mode or longer, started where the one
before ended: their scatter, with its t factor, is the error.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.covariance import jacobian
from particles.integral.edge_makers import delaunay, renormalised
from particles.integral.edges import Edges
from particles.integral.points import jittered, lattice
from particles.integral.thermal import Thermal, fill_pairs
from particles.limits import limit_of
from particles.noise import fill_normals
from particles.run import Plan, run
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.partners import ETA, KAPPA, ZETA

BATCHES = 20
DECAYS = 10         # of the slowest mode, at least, in a batch

#: from a state (N,) and the number of the step
Kick = Callable[[np.ndarray, int], np.ndarray]
Look = Callable[[np.ndarray], Any]


@dataclass(frozen=True, kw_only=True)
class Sampler:
    """Batches of dx = J x dt + noise, x (N,), by Crank-Nicolson, whose covariance is exact at any step.

    kicks : from the seed of a batch what a step of it adds to (1 + dt J/2) x. look : what of a state is kept.
    """
    J: np.ndarray
    kicks: Callable[[int], Kick]
    look: Look
    dt: float
    steps: int
    seed: int

    def batches(self, state: np.ndarray, report: Report, count: int = BATCHES) -> np.ndarray:
        """Looks (count, steps, ...), each batch with noise of its own seed."""
        looks = []
        for number in range(count):
            kick = self.kicks(1000*self.seed + number)
            batch, state = self.batch(state, kick)
            looks.append(batch)
            report((number + 1)/count)
        return np.array(looks)

    def batch(self, state: np.ndarray, kick: Kick) -> tuple[np.ndarray, np.ndarray]:
        """Looks (steps, ...) and the last state."""
        one, looks = np.eye(len(self.J)), []
        inverse = np.linalg.inv(one - self.dt/2*self.J)
        A = inverse@(one + self.dt/2*self.J)
        for step in range(self.steps):
            state = A@state + inverse@kick(state, step)
            looks.append(self.look(state))
        return np.array(looks), state


def of_matrix(B: Any, dt: float) -> Callable[[int], Kick]:
    """Kicks B dW."""
    count = B.shape[1]
    normals = np.empty((-(-count//4), 4))

    def kicks(seed: int) -> Kick:
        def kick(state: np.ndarray, step: int) -> np.ndarray:
            fill_normals(0, len(normals), seed, step, normals)
            return np.sqrt(dt)*(B@normals.ravel()[:count])
        return kick
    return kicks


def check_length(J: np.ndarray, time: float) -> None:
    """Refuse batches shorter than DECAYS decay times of the slowest mode that is not conserved.

    Raises
    ------
    ValueError
        They are.
    """
    rates = -np.linalg.eigvals(J).real
    slow = float(rates[rates > 1e-9*rates.max()].min())
    if time*slow < DECAYS:
        raise ValueError(f"a batch of {time:.4g} is {time*slow:.3g} decay times of the slowest mode, less "
                         f"than {DECAYS}: batches would be correlated; take {DECAYS/slow:.4g} or longer")


def ratio(batches: np.ndarray) -> dict[str, float]:
    """Columns of a mean over batches."""
    value, err = over_seeds(batches)
    return {"ratio": value, "ratio_err": err}


# --- the full equations -----------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Nonlinear(Case):
    """Variances of rho, v and T in the full equations on jittered points, over equilibrium."""
    counts: tuple[int, int]
    share: float
    k: float
    time: float         # of a batch
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.time/0.1*3e-3

    def run(self, report: Report, folder: Path) -> Outcome:
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
        key = {"share": self.share, "k": self.k, "drift": drift}
        ratios = np.array(powers[1:])/(edges.n - 1)/self.k      # the first batch forgets the start
        fields = zip(("rho", "v", "T"), ratios.T, strict=True)
        return Outcome({"nonlinear": [{**key, "field": name, **ratio(values)} for name, values in fields]})


def squares(flow: Any) -> np.ndarray:
    """(n, 3): squares of what rho, v and T fluctuate by, each k/V in equilibrium."""
    kinetic = flow.rho*(flow.v**2).sum(axis=1)/2
    return np.stack([(flow.rho - 1)**2, kinetic, (flow.T - 1)**2], axis=1)


# --- heat with current amplitudes ------------------------------------------------------------


def heat_kicks(edges: Edges, C: float, dt: float) -> Callable[[int], Kick]:
    """Heat with the amplitude of the current T_i T_j between points of heat capacity C (in k), kappa = C."""
    across, normals = fluctuating.incidence(edges), np.empty((len(edges.i), 1))

    def kicks(seed: int) -> Kick:
        def kick(T: np.ndarray, step: int) -> np.ndarray:
            fill_pairs(0, len(normals), seed, step, edges.i, edges.j, normals)
            squared = np.maximum(T[edges.i]*T[edges.j], 0)      # below zero once in very many
            amplitude = np.sqrt(2*edges.k*squared/C*dt)
            return across@(amplitude*normals[:, 0])/edges.V
        return kick
    return kicks


def heat_rates(edges: Edges, C: float, corrected: bool) -> np.ndarray:
    """J of their temperatures; corrected : with 1 + k/C, what current amplitudes need of Ito's rule."""
    return (1 + corrected/C)*edges.laplacian.toarray()/edges.V[:, None]


def dirichlet(n: int, C: float, corrected: bool) -> float:
    """Var T/T^2 of n points with entropies C ln T at fixed total.

    Energies are Dirichlet(C/k + 1), without correction Dirichlet(C/k).
    """
    return (n - 1)/(n*(C + corrected) + 1)


@dataclass(frozen=True, kw_only=True)
class Capacity(Case):
    """Variance of temperature with current amplitudes, with and without Ito's correction."""
    C: float
    corrected: bool
    steps: int
    counts: tuple[int, int] = (6, 6)
    dt: float = 0.05
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*5e-5

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = renormalised(lattice(self.counts), Lucy.of(h=1.5))
        J = heat_rates(edges, self.C, self.corrected)
        check_length(J, self.steps*self.dt)
        sampler = Sampler(J=J, kicks=heat_kicks(edges, self.C, self.dt), look=np.var, dt=self.dt,
                          steps=self.steps, seed=self.seed)
        batches = sampler.batches(np.ones(edges.n), report, BATCHES + 1)[1:, 1::2]
        # `var` divides by n: (n - 1)/n of the variance of one point about the fixed mean is in it already
        variance = over_seeds(batches.mean(axis=1))
        predicted = dirichlet(edges.n, self.C, self.corrected)
        return Outcome({"capacity": [{
            "C": self.C, "noise": "corrected" if self.corrected else "current", "measured": variance.value,
            "measured_err": variance.err, "predicted": predicted}]})
