"""Sampled plane waves of a gas at rest: variances against equilibrium, Brillouin peaks    [RR98 Eqs 20-25]"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse
from scipy.special import stdtrit

from particles.integral.edge_makers import MAKERS
from particles.integral.points import Points, lattice
from particles.run import Plan, Run
from particles.weights import Lucy
from studies.build.disorder import DISORDERS, Disorder
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.flows import gas_at_rest
from studies.noise.partners import ETA, KAPPA, ZETA, equilibrium, factor, noise, states_of_fields, transport
from studies.noise.printed import gas
from studies.noise.sampling import BATCHES, Linear, batches, check_length, squares

Turns = tuple[int, ...]
#: of the tables, by dimension
TABLE, AXES = {2: "modes", 3: "cubes"}, ("turns_x", "turns_y", "turns_z")
PEAKS = ("position", "half width", "Rayleigh half width")


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
    maker: str = "delaunay"
    disorder: Disorder = DISORDERS["jittered-0.3"]
    h: float = 2.0
    seed: int = 1

    @property
    def d(self) -> int:
        """Dimension."""
        return len(self.counts)

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1.5e-9*((2 + self.d)*np.prod(self.counts))**2 + 10

    @property
    def label(self) -> str:
        return f"equipartition {self.disorder.name} {self.counts}, share {self.share:g}"

    @cached_property
    def points(self) -> Points:
        return self.disorder.make(self.counts, self.disorder.size, self.seed)

    def run(self, report: Report, folder: Path) -> Outcome:
        d, edges = self.d, MAKERS[self.maker](self.points, Lucy.of(h=self.h, d=self.d))
        V = edges.V
        dih, J = gas_at_rest(edges, self.share)
        C = equilibrium(V, d)
        names, F = plane_waves(self.points, V, self.turns)
        momenta, energies = transport(edges, self.share, ETA, ZETA, KAPPA, 1.0)
        check_modes(F, C, noise(V, momenta.Q, energies.Q), names)
        F /= np.sqrt(np.einsum("mi,ij,mj->m", F, C, F))[:, None]
        B = factor(edges, momenta, energies)
        method = Linear(J=J, B=B, seed=self.seed, modes=F, names=dih.names)
        check_length(J, self.steps*self.dt)
        means: dict[str, Any] = {"modes": squares, "all": lambda sums, state: whole(V, state)}
        plan = Plan(dt=self.dt, steps=self.steps, every=1, means=means)
        legs = batches(method, start(V, d, self.seed), plan, report)
        return Outcome({TABLE[d]: self.rows(names, legs)})

    def rows(self, names: list[tuple[str, Turns, str]], legs: list[Run]) -> list[dict[str, Any]]:
        """All degrees of freedom together, then mode by mode."""
        key = {"points": self.disorder.name, "share": self.share}
        total = over_seeds(np.array([leg.means["all"] for leg in legs]))
        rows = [{**key, "field": "all", **dict.fromkeys(AXES[:self.d], 0), "phase": "-", "wavenumber": np.nan,
                 "ratio": total.value, "ratio_err": total.err}]
        powers = np.array([leg.means["modes"] for leg in legs])
        for (field, turns, phase), power in zip(names, powers.T, strict=True):
            ratio, k = over_seeds(power), 2*np.pi*np.linalg.norm(np.array(turns)/self.counts)
            rows.append({**key, "field": field, **dict(zip(AXES, turns)), "phase": phase,
                         "wavenumber": float(k), "ratio": ratio.value, "ratio_err": ratio.err})
        return rows


def start(V: np.ndarray, d: int, seed: int) -> np.ndarray:
    """Densities (2 + d, n) from rho, v and T of equilibrium, with sums of zero."""
    state = np.random.default_rng(seed).normal(size=(2 + d, len(V)))/np.sqrt(V)
    state[-1] += state[0]
    return state - (state@V/V.sum())[:, None]


def whole(V: np.ndarray, state: np.ndarray) -> float:
    """Mean over all degrees of freedom but the conserved sums of what is 1 in equilibrium."""
    rho, *p, eps = state
    square = rho**2 + sum(q**2 for q in p) + (eps - rho)**2
    return float(V@square/(len(state)*(len(V) - 1)))


def plane_waves(points: Points, V: np.ndarray,
                turns: tuple[Turns, ...]) -> tuple[list[tuple[str, Turns, str]], np.ndarray]:
    """(field, turns, phase) and rows (m, (2 + d) n) of cosines and sines of rho, v and T = eps - rho."""
    names, rows, none = list[tuple[str, Turns, str]](), [], np.zeros(len(V))
    for m in turns:
        k = 2*np.pi*np.array(m)/points.box
        for phase, wave in (("cos", V*np.cos(points.x@k)), ("sin", V*np.sin(points.x@k))):
            for field, direction in directions(k).items():
                names.append((field, m, phase))
                rows.append(np.concatenate([none, *(q*wave for q in direction), none]))
            for field, of_rho, of_eps in (("rho", 1, 0), ("T", -1, 1)):
                names.append((field, m, phase))
                rows.append(np.concatenate([of_rho*wave, *[none]*points.d, of_eps*wave]))
    return names, np.array(rows)


def directions(k: np.ndarray) -> dict[str, np.ndarray]:
    """Velocities by name: along the axes of a plane, along and across k in space."""
    if len(k) == 2:
        return {"u": np.array([1.0, 0.0]), "v": np.array([0.0, 1.0])}
    axes = np.eye(3)
    others = axes[np.argsort(np.abs(k))[:2]]
    frame = np.linalg.qr(np.column_stack([k if k.any() else axes[0], others.T]))[0]
    return dict(zip(("along", "across", "across 2"), frame.T, strict=True))


def check_modes(F: np.ndarray, C: np.ndarray, Q: sparse.csr_array,
                names: list[tuple[str, Turns, str]]) -> None:
    """Refuse a list of modes that are all conserved, or that no noise reaches and nothing damps.

    Raises
    ------
    ValueError
        There is no mode in the list that relaxes.
    """
    size = (F**2).sum(axis=1).max(initial=0)        # a sine may be zero at every point, to round-off
    moves = np.einsum("mi,ij,mj->m", F, C, F) > 1e-12*size*np.diag(C).max()
    driven = np.einsum("mi,mi->m", F, (Q@F.T).T) > 1e-12*size*Q.diagonal().max()
    if not len(F) or not (moves & driven).any():
        raise ValueError(f"all {len(F)} modes in the list are null modes ({'; '.join(map(str, names[:4]))} "
                         "...): they are conserved, or nothing drives and damps them, so samples say "
                         "nothing; take waves that are no corner of the zone, or a share of transport along "
                         "edges")


# --- waves in time ----------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Brillouin(Case):
    """Peaks of the dynamic structure factor on a line: sampled waves against the symbols of the lattice.

    Waves (rho, u, T) after a lag are U times what they were, U = <x' x^*><x x^*>^-1; its eigenvalues are
    exp(lambda lag), and sound has the peak at Im lambda, of half width -Re lambda. Crank-Nicolson's
    z = (1 + lambda dt/2)/(1 - lambda dt/2) is undone.
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

    @property
    def label(self) -> str:
        return f"Brillouin, {self.points} points"

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = MAKERS["renormalised"](lattice((self.points,)), Lucy.of(h=2.0, d=1))
        J = gas_at_rest(edges, 1.0, eta=0.0, zeta=ETA)[1]
        to_state = states_of_fields(np.zeros((edges.n, 1)))
        B = factor(edges, *transport(edges, 1.0, 0.0, ETA, KAPPA, 1.0))
        modes = self.waves()@np.linalg.inv(to_state)
        method = Linear(J=J, B=B, seed=self.seed, modes=modes, names=("rho", "p", "eps"))
        check_length(J, self.steps*self.dt)
        fields = np.random.default_rng(self.seed).normal(size=(3, self.points))
        state = (to_state@fields.ravel()).reshape(fields.shape)
        state -= state.mean(axis=1, keepdims=True)
        series = {str(m): mode(m) for m in range(len(modes))}
        plan = Plan(dt=self.dt, steps=self.steps, every=1, series=series)
        legs = batches(method, state, plan, report)
        parts = np.array([list(leg.series.values()) for leg in legs])
        x = (parts[:, 0::2] + 1j*parts[:, 1::2]).reshape(len(legs), -1, 3, parts.shape[-1])
        return Outcome({"peaks": [row for number, turns in enumerate(self.turns)
                                  for row in self.peaks(x[:, number], turns)]})

    def waves(self) -> np.ndarray:
        """Rows: real and imaginary part of rho, u and T at each wave number, variance 1 in equilibrium."""
        rows = []
        for turns in self.turns:
            wave = np.exp(-2j*np.pi*turns*np.arange(self.points)/self.points)/np.sqrt(self.points)
            rows += [np.kron(field, w) for field in np.eye(3) for w in (wave.real, wave.imag)]
        return np.array(rows)

    def peaks(self, x: np.ndarray, turns: int) -> list[dict[str, Any]]:
        """Position and half width of sound, half width of heat; errors by jackknife over batches."""
        b, after, before = len(x), x[:, :, self.lag:], x[:, :, :-self.lag]
        later, now = (np.einsum("bft,bgt->bfg", q, before.conj()) for q in (after, before))
        all_later, all_now = later.sum(axis=0), now.sum(axis=0)
        values = self.rates(all_later, all_now)
        without = np.array([self.rates(all_later - later[k], all_now - now[k]) for k in range(b)])
        scatter = ((without - without.mean(axis=0))**2).sum(axis=0)
        err = stdtrit(b - 1, 0.975)*np.sqrt((b - 1)/b*scatter)
        wavenumber = 2*np.pi*turns/self.points
        symbol = sorted_rates(np.linalg.eigvals(gas(wavenumber)[0]))
        key = {"points": self.points, "turns": turns, "wavenumber": wavenumber}
        return [{**key, "peak": name, "measured": value, "measured_err": e, "symbol": s}
                for name, value, e, s in zip(PEAKS, values, err, symbol, strict=True)]

    def rates(self, after: np.ndarray, before: np.ndarray) -> np.ndarray:
        """(position, half width, Rayleigh half width) from summed products."""
        z = np.linalg.eigvals(after@np.linalg.inv(before))
        z = np.exp(np.log(z)/self.lag)
        return sorted_rates(2/self.dt*(z - 1)/(z + 1))


def mode(number: int) -> Callable[[Any, np.ndarray], float]:
    """One mode as a series."""
    return lambda sums, state: sums.found[number]


def sorted_rates(eigen: np.ndarray) -> np.ndarray:
    """Position and half width of sound, both averaged, half width of heat, which lies between them."""
    low, heat, high = eigen[np.argsort(eigen.imag)]
    return np.array([(high.imag - low.imag)/2, -(high.real + low.real)/2, -heat.real])
