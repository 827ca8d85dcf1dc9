"""Noise and dissipation as matrices: on which points is Q = 2 kT Gamma?    [RR98 Eqs 22-25, 42-44]

The gas is at rho = T = 1 with C_V = 1; its state is densities (rho, p, eps); Boltzmann's k is 1.
"""
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from particles.integral import fluctuating
from particles.integral.edge_makers import delaunay, renormalised
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners, mismatch
from particles.integral.points import lattice, random
from particles.weights import Lucy, WendlandC2
from studies.build.setting import Disorder
from studies.kit.case import Case, Report
from studies.kit.table import Row
from studies.noise.covariance import crank_nicolson, steady_of_steps

ETA, ZETA, KAPPA = 0.3, 0.1, 0.4
KT = 0.7

# --- partners ---------------------------------------------------------------------------------


class Partnership(Case, table="partners", same="maker points"):
    """Mismatch of noise and dissipation on one set of points, for every kind of noise meant to be exact."""
    maker: Callable
    points: Disorder
    counts: tuple[int, ...]
    h: float = 2.7
    seed: int = 1

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make(self.counts, self.points.size, self.seed)
        try:
            edges = self.maker(points, WendlandC2.of(h=self.h, d=points.d))
        except ArithmeticError:         # no such edges exist on these points: see the study operators
            return
        for name, pair in kinds(edges, self.seed).items():
            yield {"d": points.d, "noise": name, "mismatch": mismatch(pair, 2*KT), "sums": sums(edges, pair)}


def kinds(edges: Edges, seed: int) -> dict[str, Partners]:
    """Noise by name, coefficients random by factors of five; along edges if no conductance is negative."""
    rng = np.random.default_rng(seed)
    eta, kappa = rng.uniform(0.2, 1, (2, edges.n))
    zeta = 0.9*(1 + 2/edges.d)*rng.uniform(0, 1, edges.n)*eta
    stress = fluctuating.stress(edges, eta, zeta, KT)
    heat = fluctuating.heat(edges, kappa, KT)
    at_points = {"stress": stress, "heat": heat}
    try:
        friction = fluctuating.friction(edges, eta, zeta, KT)
        conduction = fluctuating.conduction(edges, kappa, KT)
    except ValueError:
        return at_points
    return {**at_points, "friction": friction, "conduction": conduction,
            "stress+friction": fluctuating.mixed(stress, friction, 0.1),
            "heat+conduction": fluctuating.mixed(heat, conduction, 0.1)}


def sums(edges: Edges, pair: Partners) -> float:
    """Largest sum of the noise over all points, over the largest element of B."""
    components = pair.B.shape[0]//edges.n
    of_all = np.kron(np.eye(components), np.ones(edges.n))
    return float(np.abs(of_all@pair.B).max()/abs(pair.B).max())


# --- formulas ---------------------------------------------------------------------------------


class Formula(Case, table="formulas", same="name"):
    """What a printed formula gives by arithmetic."""
    name: str
    value: Callable[[], float]

    def measure(self, report: Report) -> Iterator[Row]:
        yield {"value": self.value()}


def other_partner() -> float:
    """|Q - 2 kT Gamma| of the eta term of Eq. 42 on random points, Gamma along edges, trace factor 2/d."""
    edges = delaunay(random((8, 8), 0.5, 1), None)
    edges = replace(edges, k=np.maximum(edges.k, 1e-3))     # any positive number: B has its inverse
    V, S2 = fluctuating.ends(edges, edges.V), (edges.S**2).sum(axis=1)
    B, kT = 0.3*S2/(2*V)/edges.k, np.ones(len(S2))          # in 2D A = 0, as S S (1 - 2/d) vanishes
    pair = fluctuating.printed_stress(edges, 0.3, 0.0, 1.0, doubled=False, trace=1.0)
    return mismatch(Partners(fluctuating.between(edges, 0*B, B, kT).Gamma, pair.B), 2.0)


def half_spacing() -> float:
    """Variance of Eq. 42 read literally, over its due: at spacing 1/2 over that at 1; a volume is missing."""
    def ratio(a: float) -> float:
        edges = renormalised(lattice((8, 8), a), Lucy.of(h=1.5*a))
        pair = fluctuating.printed_stress(edges, 0.3, 0.1, 1.0, doubled=True, volume=False)
        return float(pair.Q.trace()/(2*pair.Gamma.trace()))
    return ratio(0.5)/ratio(1.0)


def half_step() -> float:
    """<u u> of a decaying u driven by increments of unit variance at any step: at dt/2 over that at dt."""
    def variance(dt: float) -> float:
        step = crank_nicolson(-np.eye(1), dt*np.eye(1), dt)     # dt X is noise of variance dt per time
        return float(steady_of_steps(step)[0, 0])
    return variance(0.5)/variance(1.0)


def trace_2d() -> float:
    """Variance of the trace of X in 2D, over d^2: noise of a bulk viscosity that the fluid does not have."""
    tensor = fluctuating.shear(2, 2/3).reshape(2, 2, 2, 2)
    return float(np.einsum("aacc->", tensor))/4


def viscosity(rho: float = 3.0, gamma: float = 4.5) -> float:
    """Bulk viscosity that Eq. 42, doubled, gives the noise of dissipative particles, over that of friction.

    RR98's W = c w has c = 15/pi, as int W r dV = 3. Noise, with W dV = c w V and the volume V = 1/rho which
    Eq. 42 lacks: 4 c^2 w^2 2 kT zeta V^3 = 2 gamma kT w^2. Friction, by the moments of Eq. 51: zeta = (5/3)
    eta, eta = 2 pi gamma rho^2/1575.
    """
    noise = gamma*rho**3/(2*15/np.pi)**2
    return noise/(5/3*2*np.pi*gamma*rho**2/1575)


def viscosity_single() -> float:
    """The same with brackets as in Eq. 22, not doubled."""
    return 4*viscosity()
