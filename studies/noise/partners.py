"""Noise and dissipation as matrices: on which points is Q = 2 kT Gamma?    [RR98 Eqs 22-25, 42-44]

The gas is at rho = T = 1 with C_V = 1; its state is densities (rho, p, eps); Boltzmann's k is 1.
"""
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from scipy import sparse

from particles.integral import fluctuating
from particles.integral.edge_makers import delaunay, renormalised
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners, mismatch
from particles.integral.interpolants import W
from particles.integral.points import lattice, random
from particles.weights import Lucy, WendlandC2
from studies.build.fixed import neighbours
from studies.build.setting import Disorder
from studies.kit.case import Case, Report
from studies.kit.table import Row

ETA, ZETA, KAPPA = 0.3, 0.1, 0.4
KT = 0.7
WAVES = 32          # length of the longest wave in spacings

# --- partners ---------------------------------------------------------------------------------


class Partnership(Case, table="partners", same="maker points"):
    """Mismatch of noise and dissipation on one set of points, for every kind of noise meant to be exact."""
    maker: Callable
    points: Disorder
    counts: tuple[int, ...]
    h: float

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make(self.counts, self.points.size, 1)
        try:
            edges = self.maker(points, WendlandC2.of(h=self.h, d=points.d))
        except ArithmeticError:         # no such edges exist on these points: see the study operators
            return
        for name, pair in kinds(edges).items():
            yield {"d": points.d, "noise": name, "mismatch": mismatch(pair, 2*KT), "sums": sums(edges, pair)}


def kinds(edges: Edges) -> dict[str, Partners]:
    """Noise by name, coefficients random by factors of five; along edges if no conductance is negative."""
    rng = np.random.default_rng(1)
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


# --- printed noise ----------------------------------------------------------------------------


class PrintedWaves(Case, table="printed", same="equation term reading d h"):
    """Variance of printed noise over its due, 2 kT Gamma of Eq. 37 or 38, on a lattice; T = 0.7.

    term : "eta" (momentum across k), "zeta" (along k), "kappa". reading : of the bracket, "doubled", pi_ij +
    pi_ji (Eq. 35), or "single", pi_ij (Eq. 22). h = 1.5 in 1D, 1.2 in 2D: nearest neighbours.
    """
    equation: int
    term: str
    reading: str
    d: int
    h: float

    @property
    def bulk(self) -> float:
        """Factor of the zeta term's variance: twice as large in Eq. 23 as in Eq. 42."""
        return 2.0 if self.equation == 23 else 1.0

    def measure(self, report: Report) -> Iterator[Row]:
        breadth = 2*int(np.ceil(self.h)) + 1
        points = lattice((WAVES, *[breadth]*(self.d - 1)))
        edges = renormalised(points, Lucy.of(h=self.h, d=self.d))
        pair, twice = self.noise(edges)
        components = pair.Gamma.shape[0]//edges.n
        direction = np.eye(components)[1 if self.term == "eta" else 0]
        for k in 2*np.pi/WAVES*np.arange(1, WAVES//2):
            wave = np.kron(direction, np.exp(1j*k*points.x[:, 0]))
            ratio = form(pair.Q, wave)/(twice*form(pair.Gamma, wave))
            yield {"wavenumber": k, "ratio": ratio, "predicted": self.predicted(k)}

    def noise(self, edges: Edges) -> tuple[Partners, float]:
        """The printed noise with its dissipation, and the factor 2 kT (momenta) or 2 k T^2 (energies)."""
        doubled = self.reading == "doubled"
        if self.term == "kappa":
            of25 = self.equation == 25
            return fluctuating.printed_heat(edges, KAPPA, 1.0, KT, doubled=doubled, of25=of25), 2*KT**2
        eta, zeta = (ETA, 0.0) if self.term == "eta" else (0.0, ETA)
        return fluctuating.printed_stress(edges, eta, zeta, KT, doubled=doubled, bulk=self.bulk), 2*KT

    def predicted(self, k: float) -> float:
        """Ratio by lattice sums: c^2 sum w^2 (1 - cos k.r) g/(sum w e_x sin k.r)^2, c = 2 if doubled, else 1.

        g = 2 [1 + (1 - 2/3) e_y^2] for eta, e_x^2 for zeta (2 e_x^2 of Eq. 23), 1/T for kappa (2 of Eq. 25).
        """
        r, size, w = lattice_weights(self.h, self.d)
        along, last = r[:, 0]/size, r[:, -1]/size
        phase = k*r[:, 0]
        heat = 2.0 if self.equation == 25 else 1/KT
        g = {"eta": 2*(1 + last**2/3),
             "zeta": self.bulk*along**2,
             "kappa": heat}[self.term]
        slope = (w*along)@np.sin(phase)
        variance = (w**2*g)@(1 - np.cos(phase))
        return float((4 if self.reading == "doubled" else 1)*variance/slope**2)


def lattice_weights(h: float, d: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """r (m, d) to a point's neighbours on the unit lattice, |r| (m,), Lucy's weights with sum w |r| = d."""
    weight = Lucy.of(h=h, d=d)
    r = neighbours(weight, d)
    size = np.sqrt((r**2).sum(axis=1))
    w = W(weight, size)
    return r, size, w*(d/(w@size))


def form(M: sparse.csr_array, wave: np.ndarray) -> float:
    """wave^* M wave."""
    return float((wave.conj()@(M@wave)).real)


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
        decay, kick = (1 - dt/2)/(1 + dt/2), dt/(1 + dt/2)
        return kick**2/(1 - decay**2)
    return variance(0.5)/variance(1.0)


def viscosity(rho: float = 3.0) -> float:
    """Bulk viscosity that Eq. 42, doubled, gives the noise of dissipative particles, over that of friction.

    RR98's W = c w has c = 15/pi, as int W r dV = 3. Noise, with W dV = c w V and the volume V = 1/rho which
    Eq. 42 lacks: 4 c^2 w^2 2 kT zeta V^3 = 2 gamma kT w^2. Friction, by the moments of Eq. 51: zeta = (5/3)
    eta, eta = 2 pi gamma rho^2/1575. The strength gamma of both cancels.
    """
    noise = rho**3/(2*15/np.pi)**2
    friction = 5/3*2*np.pi*rho**2/1575
    return noise/friction


def viscosity_single() -> float:
    """The same with brackets as in Eq. 22, not doubled."""
    return 4*viscosity()
