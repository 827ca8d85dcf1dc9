"""Growth of sound, unsymmetric pressures, Euler's step, forces along edges    [RR98 Eqs 13, 34-40, 51]"""
from collections.abc import Callable, Iterator
from math import prod
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.waves import LinearGas
from continuum.scene import RayleighBenard
from particles.integral.edges import Edges
from particles.integral.interpolants import W
from particles.integral.points import Points
from particles.limits import jacobian
from particles.threads import Threads
from particles.weights import WendlandC2
from studies.build.fixed import SCHEMES, fluid, lattice_waves
from studies.build.setting import Disorder
from studies.kit.case import Case, Report
from studies.kit.table import Row
from studies.operators.weights import around, integral

VISCOSITIES = (0.0, 0.1)    # in rho c a
C2 = 2.0                    # gamma P/rho of the ideal gas at rho = T = 1
NULL = 1e-6                 # eigenvalues below this belong to waves that the operators do not see


class PointSet(Case, same="maker points d seed"):
    """Base of measurements on the edges of one set of points; no rows where the maker has no edges.

    maker : one of `particles.integral.edge_makers.MAKERS`. h : range of the weight, in spacings.
    """
    maker: Callable[[Points, Any], Edges]
    points: Disorder
    counts: tuple[int, ...]
    h: float
    seed: int = 1

    weight: ClassVar[Any] = WendlandC2

    @property
    def d(self) -> int:
        return len(self.counts)

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make(self.counts, self.points.size, self.seed)
        try:
            edges = self.maker(points, self.weight.of(h=self.h, d=self.d))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return
        yield from self.rows_of(points, edges)

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        """The rows measured on these points and edges."""
        raise NotImplementedError


class OneKernel(PointSet, table="one_kernel"):
    """Momentum lost if the pressure has the one kernel P(rho(r), T(r')), not both    [RR98 Eqs 13, 14]

    P = rho T, rho and T random: i gets -S P_ij/2, j gets S P_ji/2. lost : over the sum of sizes.
    """

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        rho, T = np.random.default_rng(self.seed).uniform(0.5, 1.5, (2, edges.n))
        i, j = edges.i, edges.j
        there = edges.S.T*rho[i]*T[j]
        back = edges.S.T*rho[j]*T[i]
        lost = np.abs((back - there).sum(axis=1))
        size = (np.abs(there) + np.abs(back)).sum(axis=1)
        yield {"lost": lost.max()/size.max()}


class SoundGrowth(PointSet, table="growth"):
    """Largest growth rate of sound in a fluid at rest."""

    @property
    def cost(self) -> float:
        size = prod(self.counts)*(len(self.counts) + 1)
        return 0.05 + 1e-8*size**3

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        closure = np.abs(edges.closure/edges.V[:, None]).max()
        for eta in VISCOSITIES:
            rate = np.linalg.eigvals(sound(edges, eta)).real.max()
            yield {"viscosity": eta, "rate": rate, "closure": closure}


def sound(edges: Edges, eta: float = 0.0) -> np.ndarray:
    """Matrix of rates of sqrt(V) (P'/c, p) in a fluid at rest; rho = c = 1, friction eta lap v.

    V P'_t = -c^2 D.p and V p_t = -D P': antisymmetric if D = -D^T, that is, where edges close.
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


def euler_limit(eigenvalues: np.ndarray) -> float:
    """Largest dt with |1 + lambda dt| <= 1 for all eigenvalues but null modes; 0 if a mode grows."""
    seen = eigenvalues[np.abs(eigenvalues) > NULL]
    return np.min(np.maximum(-2*seen.real/np.abs(seen)**2, 0), initial=np.inf)


class EulerLimit(Case, table="euler"):
    """Largest stable step of Eq. 40 in the 2D gas, nested transport, for waves along an axis of a lattice."""
    gas: LinearGas
    length: int = 32

    def measure(self, report: Report) -> Iterator[Row]:
        eta, zeta, kappa = self.gas
        key = {**self.gas._asdict(), "predicted": (eta + zeta + kappa/2)/C2}
        for mode in range(1, self.length//2 + 1):
            k = 2*np.pi*mode/self.length
            waves = lattice_waves(self.gas, WendlandC2.of(h=3.0), np.array([k, 0.0]), nested=True)
            rates = np.append(np.linalg.eigvals(waves.matrix), -waves.shear)
            yield key | {"mode": mode, "k": k, "limit": euler_limit(rates)}


class LayerGrowth(Case, table="nested_growth", same="h rows ra share"):
    """Growth rate (in c/a) of the fastest growing disturbance of a motionless layer; h in spacings.

    share : of transport along edges [Eq. 51]; the rest is nested [Eqs 37, 38].
    """
    h: float
    rows: int
    ra: float
    share: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def measure(self, report: Report) -> Iterator[Row]:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows), aspect=1.0)
        method = fluid(scene, SCHEMES["fixed-lattice"]._replace(h=self.h, share=self.share))
        y, c = method.x[:, 1], np.sqrt(2*scene.T_mean)
        state = method.state(1.0, np.zeros_like(method.x), scene.T(y))
        sums = method.start(len(y), Threads(1))
        growth = np.linalg.eigvals(jacobian(sums.rates, state)).real.max()
        yield {"growth": growth/c}


class EdgeForces(NamedTuple):
    """A(r) and B(r) of Eq. 51, each given as (c, p) of c (r/h)^p."""
    name: str
    A: tuple[float, int]
    B: tuple[float, int]


def viscosities(d: int, M_A: float, M_B: float) -> tuple[float, float]:
    """eta = M_A/2d(d+2) + M_B/2d, zeta = M_A/d(d+2) - (1 - 2/d) eta, with M_X = int W X r^2 dV."""
    eta = M_A/(2*d*(d + 2)) + M_B/(2*d)
    return eta, M_A/(d*(d + 2)) - (1 - 2/d)*eta


class EdgeViscosities(Case, table="friction", same="d form h"):
    """Viscosities of forces A(r) e (e.v_ij) + B(r) v_ij [RR98 Eq. 51]: of long waves, and by M_A, M_B."""
    d: int
    form: EdgeForces
    h: float

    def measure(self, report: Report) -> Iterator[Row]:
        weight = WendlandC2.of(h=self.h, d=self.d)
        eta, zeta = self.of_waves(weight)
        moments = (self.second_moment(weight, *X) for X in (self.form.A, self.form.B))
        eta_predicted, zeta_predicted = viscosities(self.d, *moments)
        yield {"eta": eta, "zeta": zeta, "eta_predicted": eta_predicted, "zeta_predicted": zeta_predicted}

    def of_waves(self, weight: Any) -> tuple[float, float]:
        """eta and zeta of long waves along an axis of a lattice."""
        d, at = self.d, around(self.h, self.d)
        half, ex2 = at.number*W(weight, at.r)*at.r**2/2, (at.x/at.r)**2
        A, B = (half*c*(at.r/self.h)**p for c, p in (self.form.A, self.form.B))
        eta = A@(ex2*(1 - ex2))/(d - 1) + B@ex2
        return eta, A@ex2**2 + B@ex2 - 2*(1 - 1/d)*eta

    def second_moment(self, weight: Any, c: float, p: int) -> float:
        """M_X = int W X r^2 dV."""
        return integral(weight, self.d, lambda r: W(weight, r)*c*(r/self.h)**p*r**2).value
