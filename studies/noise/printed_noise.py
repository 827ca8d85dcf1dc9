"""Fluctuations from printed noise, from finite steps, from current amplitudes    [RR98 Eqs 23, 25, 40-43]

One wave of the gas on a line has a density, a velocity and a temperature, each of variance 1 in equilibrium;
derivatives are symbols of the lattice. Steps are in units of nu/c^2, with the adiabatic speed c: that limits
forward Euler, not k.
"""
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from continuum.exact.waves import waves
from particles.integral import fluctuating
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.fluctuating import Partners
from particles.integral.interpolants import W
from particles.integral.points import lattice
from particles.integral.thermal import fill_pairs
from particles.weights import Lucy
from studies.build.fixed import neighbours
from studies.kit.case import Case, Report
from studies.kit.stats import over_seeds, with_errors
from studies.kit.table import Row
from studies.noise.covariance import INTEGRATORS, Step, steady_of_steps
from studies.noise.partners import ETA, KAPPA, KT
from studies.noise.sampling import BATCHES, check_length

WAVES = 32          # length of the longest wave in spacings


class PrintedWaves(Case, table="printed", same="equation term reading d h"):
    """Variance of printed noise over its due, 2 kT Gamma of Eq. 37 or 38, on a lattice; T = 0.7.

    term : "eta" (momentum across k), "zeta" (along k), "kappa". h = 1.5 in 1D, 1.2 in 2D: nearest neighbours.
    """
    equation: int
    term: str
    doubled: bool
    d: int
    h: float

    @property
    def reading(self) -> str:
        """Reading of the bracket: "doubled", pi_ij + pi_ji (Eq. 35), or "single", pi_ij (Eq. 22)."""
        return "doubled" if self.doubled else "single"

    @property
    def bulk(self) -> float:
        """Factor of the zeta term's variance: twice as large in Eq. 23 as in Eq. 42."""
        return 2.0 if self.equation == 23 else 1.0

    @property
    def label(self) -> str:
        return f"Eq. {self.equation} {self.term} {self.reading}, {self.d}D, h {self.h:g}"

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
        if self.term == "kappa":
            T, of25 = np.full(edges.n, KT), self.equation == 25
            return fluctuating.printed_heat(edges, KAPPA, 1.0, T, doubled=self.doubled, of25=of25), 2*KT**2
        eta, zeta = (ETA, 0.0) if self.term == "eta" else (0.0, ETA)
        return fluctuating.printed_stress(edges, eta, zeta, KT, doubled=self.doubled, bulk=self.bulk), 2*KT

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
        return float((4 if self.doubled else 1)*variance/slope**2)


def lattice_weights(h: float, d: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """r (m, d) to a point's neighbours on the unit lattice, |r| (m,), Lucy's weights with sum w |r| = d."""
    weight = Lucy.of(h=h, d=d)
    r = neighbours(weight, d)
    size = np.sqrt((r**2).sum(axis=1))
    w = W(weight, size)
    return r, size, w*(d/(w@size))


def form(M: Any, wave: np.ndarray) -> float:
    """wave^* M wave."""
    return float((wave.conj()@(M@wave)).real)


def line_symbols(k: float) -> tuple[float, float]:
    """Symbols (slope, Laplacian) of a line of unit spacing with h = 2, k and k^2 in the continuum."""
    r, size, w = lattice_weights(2.0, 1)
    x = r[:, 0]
    slope = (w*np.sign(x))@np.sin(k*x)
    laplacian = 2*w/size@(1 - np.cos(k*x))
    return float(slope), float(laplacian)


def gas(k: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of a wave (rho, u, T) of the ideal gas, C_V = 1; equilibrium has C = 1, since J + J^* = -Q."""
    s, lap = line_symbols(k)
    J = waves(s, ETA*lap, KAPPA*lap, 0.0).matrix
    return J, -(J + J.conj().T).real


def stable(step: Callable[[float], tuple], times: Iterable[float]) -> Iterator[tuple[float, np.ndarray]]:
    """(dt, steady covariance) of the time steps that have one."""
    for dt in times:
        try:
            yield dt, steady_of_steps(*step(dt)).real
        except ArithmeticError:
            continue


class Steps(Case, table="steps", same="integrator wavenumber"):
    """Covariances of one wave by one integrator; dt in eta/(rho c^2), c^2 = 1 isothermal, 2 of the gas."""
    integrator: str
    wavenumber: float
    dt: tuple[float, ...]

    def measure(self, report: Report) -> Iterator[Row]:
        """One row per stable time step."""
        integrator, (J, Q) = INTEGRATORS[self.integrator], gas(self.wavenumber)
        for fluid, size, c2 in (("isothermal", 2, 1), ("gas", 3, 2)):
            matrices = J[:size, :size], Q[:size, :size]
            for dt, C in stable(lambda dt: (integrator(*matrices, dt*ETA/c2),), self.dt):  # noqa: B023
                error = float(np.abs(C - np.eye(size)).max())
                yield {"fluid": fluid, "dt": dt, "velocity": C[1, 1], "error": error}


class MovingSteps(Case, table="steps", same="wavenumber"):
    """Isothermal points that move by Eq. 39: density rho, velocity u and displacement x of one wave.

    At the constant volume that is printed, x adds the force 2 P grad(n dV): u' = -i s rho - 2 s^2 x - l u,
    besides rho' = -i s u, x' = u. From rest rho = -i s x, and the stiffness is (1 + 2) c_T^2; <u u> is 1.
    both : positions by Eq. 40, too, not by Eq. 41.
    """
    wavenumber: float
    dt: tuple[float, ...]
    both: bool

    def measure(self, report: Report) -> Iterator[Row]:
        name = "eq40-eq40" if self.both else "eq40-eq41"
        for dt, C in stable(self.step, self.dt):
            yield {"integrator": name, "fluid": "moving", "dt": dt, "velocity": C[1, 1],
                   "error": abs(C[1, 1] - 1)}

    def step(self, of_limit: float) -> tuple[Step, np.ndarray]:
        """One step, and the row that it conserves: rho + i s x, less i s dt u if x moves with the new u."""
        s, lap = line_symbols(self.wavenumber)
        l, dt = ETA*lap, of_limit*ETA
        rates = np.array([[0, -1j*s, 0],
                          [-1j*s, -l, -2*s*s],
                          [0, 1, 0]])
        A = np.eye(3) + dt*rates
        if self.both:
            Q = np.diag([0, 2*l*dt, 0]).astype(complex)
            return Step(A, Q), np.array([[1, 0, 1j*s]])
        A[2] = np.eye(3)[2] + dt*A[1]       # x' = x + dt u', the new velocity with its noise
        noise = np.array([0, 1, dt])
        Q = np.outer(noise, noise)*2*l*dt
        return Step(A, Q), np.array([[1, -1j*s*dt, 1j*s]])


# --- heat with current amplitudes ------------------------------------------------------------


def heat_kicks(edges: Edges, C: float, dt: float, seed: int) -> Callable[[np.ndarray, int], np.ndarray]:
    """Random heat with amplitudes of the current T_i T_j, points of heat capacity C (in k), kappa = C."""
    across, normals, i, j = fluctuating.incidence(edges), np.empty((len(edges.i), 1)), edges.i, edges.j

    def kick(T: np.ndarray, step: int) -> np.ndarray:
        fill_pairs(0, len(normals), seed, step, i, j, normals)
        squared = np.maximum(T[i]*T[j], 0)      # rarely negative
        amplitude = np.sqrt(2*edges.k*squared/C*dt)
        return across@(amplitude*normals[:, 0])/edges.V
    return kick


def heat_rates(edges: Edges, C: float, corrected: bool) -> np.ndarray:
    """J of the temperatures of such points; corrected : times 1 + k/C, Ito's term of current amplitudes."""
    return (1 + corrected/C)*edges.laplacian.toarray()/edges.V[:, None]


def dirichlet(n: int, C: float, corrected: bool) -> float:
    """Var T/T^2 of n points with entropies C ln T at fixed total energy.

    The energies have the distribution Dirichlet(C/k + 1); without correction Dirichlet(C/k).
    """
    return (n - 1)/(n*(C + corrected) + 1)


class Capacity(Case, table="capacity", same="C noise"):
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

    @property
    def noise(self) -> str:
        return "corrected" if self.corrected else "current"

    def measure(self, report: Report) -> Iterator[Row]:
        edges = renormalised(lattice(self.counts), Lucy.of(h=1.5))
        J = heat_rates(edges, self.C, self.corrected)
        check_length(J, self.steps*self.dt)
        one, T, variances = np.eye(edges.n), np.ones(edges.n), []
        inverse = np.linalg.inv(one - self.dt/2*J)      # Crank-Nicolson: exact variances at any step
        A = inverse@(one + self.dt/2*J)
        for batch in range(BATCHES + 1):
            kick, looks = heat_kicks(edges, self.C, self.dt, 1000*self.seed + batch), []
            for step in range(self.steps):
                T = A@T + inverse@kick(T, step)
                looks.append(np.var(T))
            variances.append(np.mean(looks[1::2]))
            report((batch + 1)/(BATCHES + 1))
        # `var` divides by n: it is (n - 1)/n of the variance of one point, as `dirichlet` is
        yield {"predicted": dirichlet(edges.n, self.C, self.corrected),
               **with_errors(measured=over_seeds(variances[1:]))}
