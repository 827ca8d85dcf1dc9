"""Samples of linear systems, of waves of a gas at rest, of the full equations    [RR98 Eqs 20-25]

Each mean is made of 20 batches, each ten decay times of the slowest mode or longer, started where the one
before ended: their scatter, with its t factor, is the error.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edge_makers import delaunay
from particles.integral.points import Points, jittered
from particles.integral.thermal import Thermal
from particles.limits import jacobian, limit_of
from particles.noise import fill_normals
from particles.run import Plan, run
from particles.weights import Lucy
from studies.build.setting import DISORDERS, Disorder
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds, with_errors
from studies.noise.partners import ETA, KAPPA, ZETA, equilibrium, factor, rates_at_rest, transport

BATCHES = 20
DECAYS = 10         # of the slowest mode, at least, in a batch

#: from a state (N,) and the number of the step
Kick = Callable[[np.ndarray, int], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Sampler:
    """Batches of dx = J x dt + noise, x (N,), by Crank-Nicolson, whose covariance is exact at any step.

    kicks : from the seed of a batch what a step of it adds to (1 + dt J/2) x. look : what of a state is kept.
    """
    J: np.ndarray
    kicks: Callable[[int], Kick]
    look: Callable[[np.ndarray], Any]
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
    """Raise ValueError: batches are shorter than DECAYS decay times of the slowest mode not conserved."""
    rates = -np.linalg.eigvals(J).real
    slow = float(rates[rates > 1e-9*rates.max()].min())
    if time*slow < DECAYS:
        raise ValueError(f"a batch of {time:.4g} is {time*slow:.3g} decay times of the slowest mode, less "
                         f"than {DECAYS}: batches would be correlated; take {DECAYS/slow:.4g} or longer")


def ratio(batches: np.ndarray) -> dict[str, float]:
    """Columns of a mean over batches."""
    return with_errors(ratio=over_seeds(batches))


# --- plane waves of a gas at rest -----------------------------------------------------------------

Turns = tuple[int, ...]
#: field, whole waves along each axis, phase
Name = tuple[str, Turns, str]
#: of the tables, by dimension
TABLE, AXES = {2: "modes", 3: "cubes"}, ("turns_x", "turns_y", "turns_z")


@dataclass(frozen=True, kw_only=True)
class Equipartition(Case):
    """Variances of plane waves of rho, v and T in a gas at rest in 2D or 3D, over their exact values.

    turns : wave vectors, whole waves along each axis; each has a cosine and a sine.
    """
    counts: tuple[int, ...]
    turns: tuple[Turns, ...]
    share: float
    steps: int
    dt: float = 1.0
    maker: Callable = delaunay
    disorder: Disorder = DISORDERS["jittered-0.3"]
    seed: int = 1

    @property
    def cost(self) -> float:
        numbers = (2 + len(self.counts))*np.prod(self.counts)
        return BATCHES*self.steps*1.5e-9*numbers**2 + 10

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        edges = self.maker(points, Lucy.of(h=2.0, d=points.d))
        V, J = edges.V, rates_at_rest(edges, self.share)
        B = factor(edges, *transport(edges, self.share, ETA, ZETA, KAPPA, 1.0))
        names, F = plane_waves(points, V, self.turns)
        variances = np.einsum("mi,ij,mj->m", F, equilibrium(V, points.d), F)
        F /= np.sqrt(variances)[:, None]
        check_length(J, self.steps*self.dt)
        sampler = Sampler(J=J, kicks=of_matrix(B, self.dt), dt=self.dt, steps=self.steps, seed=self.seed,
                          look=lambda x: np.append((F@x)**2, whole(V, x)))
        powers = sampler.batches(start(V, points.d, self.seed), report).mean(axis=1)
        names.append(("all", (0,)*points.d, "-"))
        rows = [self.row(*name) | ratio(power) for name, power in zip(names, powers.T, strict=True)]
        return Outcome({TABLE[points.d]: rows})

    def row(self, field: str, turns: Turns, phase: str) -> dict[str, Any]:
        """Of one mode, or of all degrees of freedom together, which have no wave number."""
        k = 2*np.pi*np.linalg.norm(np.divide(turns, self.counts))
        return {"points": self.disorder.name, "share": self.share, "field": field, "phase": phase,
                "wavenumber": k or np.nan, **dict(zip(AXES, turns))}


def start(V: np.ndarray, d: int, seed: int) -> np.ndarray:
    """Densities ((2 + d) n,) from rho, v and T of equilibrium, with sums of zero."""
    rng = np.random.default_rng(seed)
    state = rng.normal(size=(2 + d, len(V)))/np.sqrt(V)
    state[-1] += state[0]
    mean = np.average(state, axis=1, weights=V)
    return (state - mean[:, None]).ravel()


def whole(V: np.ndarray, state: np.ndarray) -> float:
    """Mean over all degrees of freedom but the conserved sums of what is 1 in equilibrium."""
    fields = state.reshape(-1, len(V)).copy()
    fields[-1] -= fields[0]
    square = (fields**2).sum(axis=0)
    return float(V@square/len(fields)/(len(V) - 1))


def plane_waves(points: Points, V: np.ndarray, turns: tuple[Turns, ...]) -> tuple[list[Name], np.ndarray]:
    """(field, turns, phase) and rows (m, (2 + d) n) of cosines and sines of v, rho and T = eps - rho."""
    names, rows = list[Name](), []
    for m in turns:
        k = 2*np.pi*np.array(m)/points.box
        for phase, wave in (("cos", np.cos), ("sin", np.sin)):
            for field, direction in directions(k).items():
                names.append((field, m, phase))
                rows.append(np.kron(direction, V*wave(points.x@k)))
    return names, np.array(rows)


def directions(k: np.ndarray) -> dict[str, np.ndarray]:
    """What (rho, p, eps) have of each field; velocities along the axes, in 3D along and across k."""
    frame, names = np.eye(2), ["u", "v"]
    if len(k) == 3:
        frame, names = along_and_across(k), ["along", "across", "across 2"]
    rho, *_, eps = np.eye(2 + len(k))
    vectors = [*np.pad(frame, ((0, 0), (1, 1))), rho, eps - rho]
    return dict(zip([*names, "rho", "T"], vectors, strict=True))


def along_and_across(k: np.ndarray) -> np.ndarray:
    """Rows: three unit vectors, the first along k (3,)."""
    axes = np.eye(3)
    along = k if k.any() else axes[0]
    others = axes[np.argsort(np.abs(k))[:2]]
    return np.linalg.qr(np.stack([along, *others], axis=1))[0].T


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
        ratios = np.array(powers[1:])/(edges.n - 1)/self.k      # the first batch forgets the start
        rows = [{"share": self.share, "k": self.k, "drift": drift, "field": name, **ratio(values)}
                for name, values in zip(("rho", "v", "T"), ratios.T, strict=True)]
        return Outcome({"nonlinear": rows})


def squares(flow: Any) -> np.ndarray:
    """(n, 3): squares of what rho, v and T fluctuate by, each k/V in equilibrium."""
    kinetic = flow.rho*(flow.v**2).sum(axis=1)/2
    return np.stack([(flow.rho - 1)**2, kinetic, (flow.T - 1)**2], axis=1)
