"""What the brackets conserve, what grows at rest, the step of forward Euler    [RR98 Eqs 13, 34-40, 51]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from continuum.exact.waves import LinearGas
from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.threads import Threads
from particles.weights import WendlandC2
from studies.build.fixed import SCHEMES, fluid
from studies.build.setting import Disorder
from studies.kit.case import Case, Outcome, Report
from studies.operators.equations import rates

TRANSPORT = {"nested": NestedFluxes(), "printed": NestedFluxes(differences=False),
             "pairwise": Pairwise(mended=False)}
VISCOSITIES = (0.0, 0.1)    # rho c a
C2 = 2.0                    # gamma P/rho of the ideal gas at rho = T = 1
NULL = 1e-6                 # rates that small belong to waves that the operators do not see
WAVE = 1e-4     # of a central difference: rates are cubic, so errors are 1e-8 of them, round-off 1e-12
SINGLE = 1e-6   # the same, of one field of one point


@dataclass(frozen=True, kw_only=True)
class PointSet(Case):
    """What edges do on one set of points; no rows where the maker has none there.

    make : of `particles.integral.edge_makers.MAKERS`. h : range of the weight, in spacings.
    """
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    counts: tuple[int, ...]
    h: float
    seed: int = 1

    table: ClassVar[str]

    @property
    def cost(self) -> float:
        size = prod(self.counts)*(len(self.counts) + 1)
        return 0.05 + 1e-8*size**3

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        d = len(self.counts)
        try:
            edges = self.make(points, WendlandC2.of(h=self.h, d=d))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({})
        key = {"maker": self.make.__name__, "points": self.disorder.name, "d": d, "seed": self.seed}
        return Outcome({self.table: [key | row for row in self.rows(edges)]})

    def rows(self, edges: Edges) -> Iterator[dict[str, Any]]:
        """What is measured on these edges."""
        raise NotImplementedError


class Invariance(PointSet):
    """What a random state loses of mass, momentum and energy, over what is exchanged    [RR98 Eqs 34-36]"""
    table = "invariance"

    def rows(self, edges: Edges) -> Iterator[dict[str, Any]]:
        for name, transport in TRANSPORT.items():
            dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.3, 0.4), zeta=0.1, transport=transport)
            rng = np.random.default_rng(0)
            rho = rng.uniform(0.9, 1.1, edges.n)
            v = rng.normal(0, 0.2, (edges.n, edges.d))
            T = rng.uniform(0.9, 1.1, edges.n)
            change = rates(dih, dih.state(rho, v, T))
            lost = np.abs(dih.conserved(change))/(np.abs(change)@edges.V)
            yield {"transport": name, "lost": float(lost.max())}


class OneKernel(PointSet):
    """Momentum that the pressure's kernel P(rho(r), T(r')) alone would not keep    [RR98 Eqs 13, 14]

    P = rho T, rho and T random: i gets S.P_ij/2, j gets S.P_ji/2. lost : over the sum of sizes.
    """
    table = "one_kernel"

    def rows(self, edges: Edges) -> Iterator[dict[str, Any]]:
        rho, T = np.random.default_rng(self.seed).uniform(0.5, 1.5, (2, edges.n))
        i, j, half = edges.i, edges.j, edges.S/2
        there = half*(rho[i]*T[j])[:, None]
        back = half*(rho[j]*T[i])[:, None]
        lost = np.abs(back.sum(axis=0) - there.sum(axis=0)).max()
        size = (np.abs(there) + np.abs(back)).sum(axis=0).max()
        yield {"lost": float(lost/size)}


class SoundGrowth(PointSet):
    """Largest growth rate of sound at rest."""
    table = "growth"

    def rows(self, edges: Edges) -> Iterator[dict[str, Any]]:
        closure = float(np.abs(edges.closure/edges.V[:, None]).max())
        for eta in VISCOSITIES:
            growth = np.linalg.eigvals(sound(edges, eta)).real.max()
            yield {"viscosity": eta, "rate": float(growth), "closure": closure}


def sound(edges: Edges, eta: float = 0.0) -> np.ndarray:
    """Matrix of d/dt (P'/c, p) in a fluid at rest, times sqrt(V); rho = c = 1, friction eta lap v.

    V P'_t = -c^2 D.p and V p_t = -D P': antisymmetric if D = -D^T, so where edges close.
    """
    n, d, root = edges.n, edges.d, 1/np.sqrt(edges.V)
    A = np.zeros(((d + 1)*n,)*2)
    friction = eta*root[:, None]*edges.laplacian.toarray()*root
    for a, D in enumerate(edges.D, start=1):
        p = slice(a*n, (a + 1)*n)
        scaled = root[:, None]*D.toarray()*root
        A[:n, p] = A[p, :n] = -scaled
        A[p, p] = friction
    return A


# --- rates of what is small ---------------------------------------------------------------------------------


def linear(sums: Any, state: np.ndarray, change: np.ndarray) -> np.ndarray:
    """What a small change of the state makes of its rates, by a central difference."""
    up, down = np.empty_like(state), np.empty_like(state)
    sums.rates(state + change, up)
    sums.rates(state - change, down)
    return (up - down)/2


def response(dih: Dih, x: np.ndarray, k: float) -> np.ndarray:
    """Matrix (2 + d, 2 + d) by which the scheme multiplies amplitudes of exp(ikx) at rest, rho = T = 1."""
    n, d = x.shape
    rest = dih.state(np.ones(n), np.zeros((n, d)), np.ones(n))
    wave = np.exp(1j*k*x[:, 0])
    matrix = np.empty((d + 2, d + 2), complex)
    for row in range(d + 2):
        one = WAVE*(np.arange(d + 2) == row)[:, None]
        real = linear(dih, rest, one*wave.real)
        imaginary = linear(dih, rest, one*wave.imag)
        matrix[:, row] = ((real + 1j*imaginary)/wave).mean(axis=1)/WAVE
    return matrix


def euler_limit(eigenvalues: np.ndarray) -> float:
    """The largest dt with |1 + lambda dt| <= 1 for all that are no null modes; 0 if one grows by itself."""
    seen = eigenvalues[np.abs(eigenvalues) > NULL]
    return float(np.min(np.maximum(-2*seen.real/np.abs(seen)**2, 0), initial=np.inf))


@dataclass(frozen=True, kw_only=True)
class EulerLimit(Case):
    """Largest stable step of Eq. 40 in the 2D gas, nested transport, for waves along an axis of a lattice."""
    gas: LinearGas
    rows: int = 32

    def run(self, report: Report, folder: Path) -> Outcome:
        at, (eta, zeta, kappa) = lattice((self.rows, 8)), self.gas
        dih = Dih(edges=renormalised(at, WendlandC2.of(h=3.0)), eos=IdealGas(), law=ConstEta(eta, kappa),
                  zeta=zeta, transport=NestedFluxes())
        key = {**self.gas._asdict(), "predicted": (eta + zeta + kappa/2)/C2}
        rows = []
        for mode in range(1, self.rows//2 + 1):
            k = 2*np.pi*mode/self.rows
            limit = euler_limit(np.linalg.eigvals(response(dih, at.x, k)))
            rows.append(key | {"mode": mode, "k": k, "limit": limit})
        return Outcome({"euler": rows})


# --- the layer between plates -------------------------------------------------------------------------------


def jacobian(sums: Any, state: np.ndarray) -> np.ndarray:
    """d rates/d state of a compiled scheme, (size, size); fields are of order 1."""
    J = np.empty((state.size, state.size))
    for column in range(state.size):
        change = np.zeros_like(state)
        change.flat[column] = SINGLE
        J[:, column] = linear(sums, state, change).ravel()/SINGLE
    return J


@dataclass(frozen=True, kw_only=True)
class LayerGrowth(Case):
    """The fastest growing disturbance of a motionless layer between plates; `h` in spacings, rate in c/a.

    share : of transport along edges [Eq. 51], the rest is nested [Eqs 37, 38].
    """
    h: float
    rows: int
    ra: float
    share: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows), aspect=1.0)
        method = fluid(scene, SCHEMES["fixed-lattice"]._replace(h=self.h, share=self.share))
        y, c = method.x[:, 1], np.sqrt(2*scene.T_mean)
        state = method.state(1.0, np.zeros_like(method.x), scene.T(y))
        sums = method.start(len(y), Threads(1))
        growth = np.linalg.eigvals(jacobian(sums, state)).real.max()
        return Outcome({"nested_growth": [{"h": self.h, "rows": self.rows, "ra": self.ra, "share": self.share,
                                           "growth": growth/c}]})
