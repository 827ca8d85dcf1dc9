"""Sampled plane waves of a gas at rest: variances, the Brillouin peak    [RR98 Eqs 20-25]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import stdtrit

from particles.integral.edge_makers import delaunay, renormalised
from particles.integral.points import Points, lattice
from particles.weights import Lucy
from studies.build.setting import DISORDERS, Disorder
from studies.kit.case import Case, Outcome, Report
from studies.noise.partners import (
    ETA,
    KAPPA,
    ZETA,
    equilibrium,
    factor,
    rates_at_rest,
    states_of_fields,
    transport,
)
from studies.noise.printed_noise import gas
from studies.noise.sampling import BATCHES, Sampler, check_length, of_matrix, ratio

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
    h: float = 2.0
    seed: int = 1

    @property
    def cost(self) -> float:
        numbers = (2 + len(self.counts))*np.prod(self.counts)
        return BATCHES*self.steps*1.5e-9*numbers**2 + 10

    @property
    def label(self) -> str:
        return f"equipartition {self.disorder.name} {self.counts}, share {self.share:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        edges = self.maker(points, Lucy.of(h=self.h, d=points.d))
        V, J = edges.V, rates_at_rest(edges, self.share)
        C = equilibrium(V, points.d)
        B = factor(edges, *transport(edges, self.share, ETA, ZETA, KAPPA, 1.0))
        names, F = plane_waves(points, V, self.turns)
        check_modes(F, C, B, names)
        F /= np.sqrt(np.einsum("mi,ij,mj->m", F, C, F))[:, None]
        check_length(J, self.steps*self.dt)
        sampler = Sampler(J=J, kicks=of_matrix(B, self.dt), dt=self.dt, steps=self.steps, seed=self.seed,
                          look=lambda x: np.append((F@x)**2, whole(V, x)))
        powers = sampler.batches(start(V, points.d, self.seed), report).mean(axis=1)
        names.append(("all", (0,)*points.d, "-"))
        rows = [self.row(*name, power) for name, power in zip(names, powers.T, strict=True)]
        return Outcome({TABLE[points.d]: rows})

    def row(self, field: str, turns: Turns, phase: str, power: np.ndarray) -> dict[str, Any]:
        """Of one mode, or of all degrees of freedom together, which have no wave number."""
        k = 2*np.pi*np.linalg.norm(np.divide(turns, self.counts))
        key = {"points": self.disorder.name, "share": self.share, "field": field, "phase": phase}
        axes = dict(zip(AXES, turns))
        return {**key, **axes, "wavenumber": k if k else np.nan, **ratio(power)}


def start(V: np.ndarray, d: int, seed: int) -> np.ndarray:
    """Densities ((2 + d) n,) from rho, v and T of equilibrium, with sums of zero."""
    rng = np.random.default_rng(seed)
    state = rng.normal(size=(2 + d, len(V)))/np.sqrt(V)
    state[-1] += state[0]
    mean = state@V/V.sum()
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


def check_modes(F: np.ndarray, C: np.ndarray, B: Any, names: list[Name]) -> None:
    """Refuse a list of modes that are all conserved, or that no noise reaches and nothing damps.

    Raises
    ------
    ValueError
        There is no mode in the list that relaxes.
    """
    variance = np.einsum("mi,ij,mj->m", F, C, F)
    driving = ((F@B)**2).sum(axis=1)
    least = 1e-12*(F**2).sum(axis=1).max()          # a sine may be zero at every point, to round-off
    moves, driven = variance > least*C.max(), driving > least*(B@B.T).max()
    if not (moves & driven).any():
        raise ValueError(f"all {len(F)} modes in the list are null modes ({'; '.join(map(str, names[:4]))} "
                         "...): they are conserved, or nothing drives and damps them, so samples say "
                         "nothing; take waves that are no corner of the zone, or a share of transport along "
                         "edges")


@dataclass(frozen=True, kw_only=True)
class Brillouin(Case):
    """The peak of the dynamic structure factor on a line: sampled waves against the symbols of the lattice.

    Waves (rho, u, T) after a lag are U times what they were, U = <x' x^*><x x^*>^-1; its eigenvalues are
    exp(lambda lag), and sound has the peak at Im lambda. Crank-Nicolson's z = (1 + lambda dt/2)/(1 - lambda
    dt/2) is undone.
    """
    points: int
    turns: tuple[int, ...]
    steps: int
    dt: float = 0.25
    lag: int = 4
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1e-4

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = renormalised(lattice((self.points,)), Lucy.of(h=2.0, d=1))
        J = rates_at_rest(edges, 1.0, eta=0.0, zeta=ETA)
        B = factor(edges, *transport(edges, 1.0, 0.0, ETA, KAPPA, 1.0))
        check_length(J, self.steps*self.dt)
        modes = self.waves()@np.linalg.inv(states_of_fields(edges.n, 1))
        sampler = Sampler(J=J, kicks=of_matrix(B, self.dt), look=lambda x: modes@x, dt=self.dt,
                          steps=self.steps, seed=self.seed)
        looks = sampler.batches(start(edges.V, 1, self.seed), report)
        of_turns = np.split(looks, len(self.turns), axis=2)
        return Outcome({"peaks": [self.peak(*pair) for pair in zip(of_turns, self.turns, strict=True)]})

    def waves(self) -> np.ndarray:
        """Rows: rho, u and T at each wave number, variance 1 in equilibrium; complex."""
        phase = 2*np.pi*np.outer(self.turns, np.arange(self.points))/self.points
        waves = np.exp(-1j*phase)/np.sqrt(self.points)
        return np.concatenate([np.kron(np.eye(3), wave) for wave in waves])

    def peak(self, x: np.ndarray, turns: int) -> dict[str, Any]:
        """The position from waves x (batches, steps, 3); its error by jackknife over batches."""
        after, before = x[:, self.lag:], x[:, :-self.lag]
        later, now = (np.einsum("btf,btg->bfg", q, before.conj()) for q in (after, before))
        all_later, all_now = later.sum(axis=0), now.sum(axis=0)
        without = [self.position(all_later - one, all_now - other) for one, other in zip(later, now)]
        freedom = len(x) - 1
        err = stdtrit(freedom, 0.975)*np.sqrt(freedom)*np.std(without)
        k = 2*np.pi*turns/self.points
        J, _ = gas(k)
        return {"points": self.points, "turns": turns, "wavenumber": k,
                "measured": self.position(all_later, all_now), "measured_err": err,
                "symbol": np.linalg.eigvals(J).imag.max()}

    def position(self, after: np.ndarray, before: np.ndarray) -> float:
        """From summed products; sound that goes left and right is averaged."""
        z = np.linalg.eigvals(after@np.linalg.inv(before))
        z = np.exp(np.log(z)/self.lag)
        rates = (2/self.dt*(z - 1)/(z + 1)).imag
        return float(np.ptp(rates)/2)
