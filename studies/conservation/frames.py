"""Galilean invariance of rates, and linear sound without friction, on points that stay    [RR98 Eqs 34-38]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from scipy import sparse
from scipy.linalg import expm

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.weights import Lucy
from studies.build.disorder import DISORDERS, Disorder
from studies.conservation.dimensions import ETA, FORMS, SIZE
from studies.conservation.sums import random_fields
from studies.kit.case import Case, Outcome, Report

WIND = np.array([0.3, -0.2])
SIDE = 8                # spacings: the length of the wave whose periods are counted
KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
MODES = ("pairwise", "everywhere", "unmended", "nested", "printed")


@dataclass(frozen=True, kw_only=True)
class OnEdges(Case):
    """A row of ``table`` on the edges of a maker; none where no such edges exist on these points."""

    maker: str
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    seed: int = 1
    table: ClassVar[str]
    side: ClassVar[int] = 12

    @property
    def cost(self) -> float:
        return 0.3

    def columns(self, points: Points, edges: Edges) -> dict[str, Any]:
        """Those besides maker, points and seed."""
        raise NotImplementedError

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((self.side, self.side), self.disorder.size, self.seed)
        try:
            edges = self.make(points, Lucy.of(h=3.0))
        except ArithmeticError:
            return Outcome({})
        known = {"maker": self.maker, "points": self.disorder.name, "seed": self.seed}
        return Outcome({self.table: [{**known, **self.columns(points, edges)}]})


@dataclass(frozen=True, kw_only=True)
class Frame(OnEdges):
    """Largest differences of rates in a wind from those at rest, carried along, over the largest rates.

    On fixed points a wind carries the state along with the discrete divergence D: rates may differ by -U.D of
    the state and by what the transformation of momentum and energy asks for, and by nothing else.
    """

    mode: str
    table = "frames"

    def columns(self, points: Points, edges: Edges) -> dict[str, Any]:
        form = FORMS[self.mode]
        fluid = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), transport=form.transport)
        state = fluid.state(*random_fields(points, SIZE, self.seed))
        there = rates(fluid, boosted(state))
        mass, *momentum, energy = zip(np.abs(there - expected(fluid, state)), np.abs(there), strict=True)
        groups = {"mass": [mass], "momentum": momentum, "energy": [energy]}
        return {"mode": self.mode, **{name: share(rows) for name, rows in groups.items()}}


def share(rows: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """Largest difference over the largest rate, of rows (difference, rate)."""
    differences, sizes = zip(*rows, strict=True)
    return float(np.max(differences)/np.max(sizes))


def expected(fluid: Dih, state: np.ndarray) -> np.ndarray:
    """Rates in the wind, from those at rest."""
    moved = boosted(rates(fluid, state))
    carried = [sum(u*(D@q) for u, D in zip(WIND, fluid.edges.D, strict=True)) for q in boosted(state)]
    return moved - np.stack(carried)/fluid.edges.V


def boosted(state: np.ndarray) -> np.ndarray:
    """Density, momentum, energy in a frame that moves with -WIND; of rates likewise."""
    rho, px, py, eps = state
    work = WIND@np.stack([px, py])
    return np.stack([rho, px + rho*WIND[0], py + rho*WIND[1], eps + work + rho*(WIND@WIND)/2])


def rates(fluid: Dih, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    fluid.rates(state, out)
    return out


# --- sound --------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class LinearSound(OnEdges):
    """Linear sound at rest without friction: rho' = -div v, v' = -grad rho in units of the speed of sound.

    bracket : "plus", the gradient with (f_i + f_j) as in Eqs 34 and 35, or "adjoint", with (f_j - f_i).
    """

    bracket: str
    periods: int = 10_000
    table = "sound"
    side = SIDE

    def columns(self, points: Points, edges: Edges) -> dict[str, Any]:
        L = SIDE*sound(edges, self.bracket)
        growth = float(np.linalg.eigvals(L).real.max())
        # eigenvalues of a matrix that is not normal may be off by this where they are defective
        err = float(np.finfo(float).eps*np.linalg.norm(L, 2)*len(L))
        ln_energy = after(expm(L), self.periods, self.seed)
        return {"bracket": self.bracket, "periods": self.periods, "growth": growth, "growth_err": err,
                "ln_energy": ln_energy}


def sound(edges: Edges, bracket: str) -> np.ndarray:
    """d/dt of (rho, v) as a matrix, each times the root of the volume: the energy is half of the square."""
    root = sparse.diags_array(1/np.sqrt(edges.V))
    gradient = edges.D if bracket == "plus" else edges.G
    blocks: list[list[Any]] = [[None, *(-root@D@root for D in edges.D)]]
    blocks += [[-root@slope@root, *[None]*edges.d] for slope in gradient]
    return sparse.block_array(blocks).toarray()


def after(step: np.ndarray, times: int, seed: int) -> float:
    """ln of the energy after so many applications to a random state, over that before."""
    state = np.random.default_rng(seed).normal(size=len(step))
    state /= np.linalg.norm(state)
    total = 0.0
    for _ in range(times):
        state = step@state
        size = float(np.linalg.norm(state))
        total += 2*np.log(size)
        state /= size
    return total


def frames(seeds: tuple[int, ...]) -> Iterator[Case]:
    """Rates in a wind, and sound, on sets of points that differ."""
    for (maker, make), kind in product(MAKERS.items(), KINDS):
        for seed in seeds if kind != "lattice" else seeds[:1]:
            where = {"maker": maker, "make": make, "disorder": DISORDERS[kind], "seed": seed}
            yield from (LinearSound(bracket=bracket, **where) for bracket in ("plus", "adjoint"))
            if kind != "relaxed":
                yield from (Frame(mode=mode, **where) for mode in MODES)
