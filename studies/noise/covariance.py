"""Steady covariances of linear fluctuations about a flow, from Lyapunov equations in time and of steps

    dx = J x dt + B dW, Q = B B^T            J C + C J^* + Q = 0                 [RR98 Eqs 20-25]
    x(t + dt) = A x(t) + noise of variance Q_dt       C = A C A^* + Q_dt                 [RR98 Eq. 40]

Where a step conserves sums (rows L with L A = L, L Q = 0), C is the covariance at fixed sums. Covariances of
linear fluctuations are proportional to k, which is 1 here.
"""
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.linalg import null_space, solve_continuous_lyapunov, solve_discrete_lyapunov
from scipy.optimize import brentq

from continuum.scene import RayleighBenard
from particles.integral.fluctuating import conduction, each, friction
from particles.integral.layer import Layer
from particles.threads import Threads
from studies.build.fixed import Scheme, layer
from studies.build.setting import jacobian
from studies.kit.case import Case, Report
from studies.kit.table import Row
from studies.noise.partners import ETA, lattice_weights

#: decay rates below this fraction of the largest |J| count as none; differences leave 1e-12
UNDAMPED = 1e-10


def waves(columns: np.ndarray, counts: tuple[int, int], k: float) -> np.ndarray:
    """The block (m ny, m ny) for waves exp(ikx) of a matrix on a lattice of spacing 1, uniform along x.

    columns : those (m nx ny, m ny) of the points at x = 0, for m fields and point (x, y) numbered x ny + y.
    nx is odd and more than twice the reach of the matrix: then any k will do.
    """
    nx, ny = counts
    fields = columns.shape[1]//ny
    parts = np.asarray(columns).reshape(fields, nx, ny, fields*ny)
    x = (np.arange(nx) + nx//2) % nx - nx//2
    return np.einsum("fxyc,x->fyc", parts, np.exp(-1j*k*x)).reshape(fields*ny, fields*ny)


def steady(J: np.ndarray, Q: np.ndarray) -> np.ndarray:
    """C with J C + C J^* + Q = 0. Raises ArithmeticError: a mode does not decay."""
    check_decay(np.linalg.eigvals(J).real, UNDAMPED*np.abs(J).max())
    C = solve_continuous_lyapunov(J, -Q)
    # iterative refinement: solve again for the residual
    return C + solve_continuous_lyapunov(J, -(Q + J@C + C@J.conj().T))


class Step(NamedTuple):
    """One time step: x -> A x + noise of covariance Q."""
    A: np.ndarray
    Q: np.ndarray


def steady_of_steps(step: Step, conserved: np.ndarray | None = None) -> np.ndarray:
    """C with C = A C A^* + Q, at fixed rows `conserved`. Raises ArithmeticError: a mode does not decay."""
    # columns: a basis of the states at which the conserved sums are zero
    Z = np.eye(len(step.A)) if conserved is None else null_space(conserved)
    A, Q = Z.conj().T@step.A@Z, Z.conj().T@step.Q@Z
    check_decay(np.abs(np.linalg.eigvals(A)) - 1, UNDAMPED)
    C = solve_discrete_lyapunov(A, Q)
    C += solve_discrete_lyapunov(A, Q + A@C@A.conj().T - C)
    return Z@C@Z.conj().T


def check_decay(rates: np.ndarray, least: float) -> None:
    """Raise ArithmeticError if a mode grows or stays."""
    if not (worst := rates.max()) < -least:
        raise ArithmeticError(f"{np.count_nonzero(rates >= -least)} modes do not decay, the fastest grows at "
                              f"{worst:.3g}: take a share of transport along edges or an odd number of "
                              "points, edges that close, a smaller step")


def forward_euler(J: np.ndarray, Q: np.ndarray, dt: float) -> Step:
    """x + dt J x + B dW    [RR98 Eq. 40]"""
    return Step(np.eye(len(J)) + dt*J, dt*Q)


# --- steps of one wave ----------------------------------------------------------------------------------


class Steps(Case, table="steps", same="wavenumber"):
    """Kinetic temperature of one wave after many steps; dt is in eta/(rho c^2), c the isothermal speed."""
    wavenumber: float
    dt: tuple[float, ...]

    def measure(self, report: Report) -> Iterator[Row]:
        """One row per integrator and stable time step."""
        for of_limit in self.dt:
            for integrator, fluid, step, conserved in steps(self.wavenumber, of_limit*ETA):
                try:
                    velocity = steady_of_steps(step, conserved)[1, 1].real
                except ArithmeticError:         # the step is too long: a mode grows
                    continue
                yield {"integrator": integrator, "fluid": fluid, "dt": of_limit, "velocity": velocity,
                       "error": abs(velocity - 1)}


def steps(k: float, dt: float) -> Iterator[tuple[str, str, Step, np.ndarray | None]]:
    """Integrator, fluid, step, conserved rows; a wave of the isothermal gas has density rho and velocity u.

    Points that move by Eq. 39 have a displacement x besides. At the constant volume that is printed, x adds
    the force 2 P grad(n dV): u' = -i s rho - 2 s^2 x - l u, with rho' = -i s u, x' = u. From rest rho =
    -i s x, and the stiffness is (1 + 2) c_T^2; <u u> is 1.
    """
    s, lap = line_symbols(k)
    l = ETA*lap
    yield "forward-euler", "isothermal", forward_euler(*sound(s, l), dt), None
    rates = np.array([[0, -1j*s, 0],
                      [-1j*s, -l, -2*s*s],
                      [0, 1, 0]])
    old = forward_euler(rates, np.diag([0, 2*l, 0]), dt)
    yield "eq40-eq40", "moving", old, np.array([[1, 0, 1j*s]])
    A = old.A.copy()
    A[2] = np.eye(3)[2] + dt*A[1]       # x' = x + dt u', the new velocity with its noise
    noise = np.array([0, 1, dt])
    # x moves with the new u, which changes the conserved sum rho + i s x by -i s dt u
    yield "eq40-eq41", "moving", Step(A, np.outer(noise, noise)*2*l*dt), np.array([[1, -1j*s*dt, 1j*s]])


def sound(s: float, l: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of a wave (rho, u) of the isothermal gas; its covariance in equilibrium is 1."""
    return np.array([[0, -1j*s], [-1j*s, -l]]), np.diag([0, 2*l])


def line_symbols(k: float) -> tuple[float, float]:
    """Symbols (slope, Laplacian) of a line of unit spacing with h = 2, k and k^2 in the continuum."""
    r, size, w = lattice_weights(2.0, 1)
    x = r[:, 0]
    slope = (w*np.sign(x))@np.sin(k*x)
    laplacian = 2*w/size@(1 - np.cos(k*x))
    return float(slope), float(laplacian)


# --- a layer heated from below --------------------------------------------------------------------------

LATTICE = Scheme("fixed-lattice")
K_HEIGHT = 3.117        # wave number times height of the mode that grows first


class BelowOnset(Case, table="onset", same="rows"):
    """Fluctuations of KHP95's motionless layer between plates, `rows` high, below onset: waves k = 3.117/L.

    Column velocity: variance of vertical velocities, which is 1 in equilibrium.
    """
    rows: int
    parts: tuple[float, ...]        # 1 - Ra/Ra_c

    def measure(self, report: Report) -> Iterator[Row]:
        critical = onset(self.rows)
        for below in self.parts:
            variances = np.diag(steady(*matrices(self.rows, critical*(1 - below)))).real
            velocity = variances[2*self.rows:3*self.rows].mean()
            yield {"below": below, "ra_c": critical, "velocity": float(velocity)}


def onset(rows: int) -> float:
    """Ra_c: the Rayleigh number where the slowest mode neither grows nor decays."""
    def rate(ra: float) -> float:
        return float(np.linalg.eigvals(matrices(rows, ra)[0]).real.max())
    return float(brentq(rate, 1000, 3000, xtol=1e-6))


def matrices(rows: int, ra: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of the waves k = 3.117/L at one Rayleigh number."""
    counts, k = (5, rows), K_HEIGHT/rows
    scene = RayleighBenard(ra=ra, L=float(rows), aspect=5/rows)
    fluid = layer(scene, LATTICE, 1)
    x, n = fluid.x, len(fluid.x)
    T = scene.T(x[:, 1])
    sums = fluid.start(n, Threads(1))
    first = np.arange(rows)             # points at the left end
    J = jacobian(sums.rates, fluid.state(1.0, 0*x, T), first)
    fields = np.arange(4)[:, None]
    columns = (fields*n + first).ravel()
    Q = layer_noise(fluid, T)[:, columns].toarray()
    return waves(J, counts, k), waves(Q, counts, k)


def layer_noise(fluid: Layer, T: np.ndarray) -> sparse.csr_array:
    """Q of a layer at rest with transport along edges; edges to images have the temperature of their plate.

    Images have -v and 2 T_w - T: friction over an edge to one is -k (v_i + v_parent), heat alike. Point and
    parent therefore get the same noise.
    """
    edges, beyond, law, n = fluid.edges, fluid.beyond, fluid.law, len(T)
    rows = np.concatenate([beyond.i, beyond.parent])
    columns = np.tile(beyond.i, 2)
    T_wall = np.array(fluid.T_plates)[beyond.plate]

    def of_plate(q: np.ndarray) -> sparse.csr_array:
        values = np.tile(beyond.k*q, 2)
        return sparse.csr_array((values, (columns, rows)), shape=(n, n))
    momenta = friction(edges, law.eta, 0.0, T).Q + each(2, of_plate(2*law.eta*T_wall))
    energies = conduction(edges, law.k, T**2).Q + of_plate(2*law.k*T_wall**2)
    return noise(edges.V, momenta, energies)


def noise(V: np.ndarray, of_momenta: Any, of_energies: Any) -> sparse.csr_array:
    """Q (N, N) of densities (rho, p, eps) at rest, from Q (d n, d n) of momenta and Q (n, n) of energies."""
    n, d = len(V), of_momenta.shape[0]//len(V)
    per = sparse.diags_array(np.tile(1/V, 2 + d))
    Q = sparse.block_diag([sparse.csr_array((n, n)), of_momenta, of_energies])
    return sparse.csr_array(per@Q@per)
