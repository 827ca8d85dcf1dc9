"""Covariances that time steps keep, as cases: Crank-Nicolson, forward Euler, three stages, Eqs 40, 41    [RR98 Eqs 40, 41]

One wave of the gas on a line: density, velocity, temperature, with the symbols of the lattice; in equilibrium each has the
variance 1. Step sizes are in units of nu/c^2, c the adiabatic speed: the step of forward Euler is limited by that, not by k.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.exact.waves import waves
from particles.integral.covariance import STEPS, Step, steady_of_steps
from particles.integral.interpolants import W
from particles.weights import Lucy
from studies.build.symbols import neighbours
from studies.kit.case import Case, Outcome, Report

ETA, KAPPA = 0.3, 0.4


def line_symbols(k: float, h: float = 2.0) -> tuple[float, float]:
    """(slope, Laplacian) that a line of unit spacing makes of k and k^2 with Lucy's weight, pairwise."""
    weight = Lucy.of(h=h, d=1)
    r = neighbours(weight, 1)[:, 0]
    w = W(weight, np.abs(r))
    w /= w@np.abs(r)
    return float((w*np.sign(r))@np.sin(k*r)), float(2*w/np.abs(r)@(1 - np.cos(k*r)))


def gas(k: float) -> tuple[np.ndarray, np.ndarray]:
    """J and Q of (rho, u, T): ideal gas, C_V = 1, C = 1 in equilibrium, since J + J^* = -Q."""
    s, lap = line_symbols(k)
    J = waves(s, ETA*lap, KAPPA*lap, 0.0).matrix
    return J, -(J + J.conj().T).real


def isothermal(k: float) -> tuple[np.ndarray, np.ndarray]:
    """The same of (rho, u) at constant temperature."""
    J, Q = gas(k)
    return J[:2, :2], Q[:2, :2]


def euler_heats(k: float, dt: float) -> float:
    """<u u> of `isothermal` with forward Euler, solved by hand: 1/(1 - s^2 dt/l - l dt/2 + 3 s^2 dt^2/4 - s^4 dt^3/(4 l))."""
    s, lap = line_symbols(k)
    l = ETA*lap
    return 1/(1 - s*s*dt/l - l*dt/2 + 0.75*(s*dt)**2 - s**4*dt**3/(4*l))


@dataclass(frozen=True, kw_only=True)
class Steps(Case):
    """What one integrator makes of the variances of one wave; dt in eta/(rho c^2), c^2 = 1 isothermal, 2 of the gas."""
    integrator: str
    k: float
    dt: tuple[float, ...]

    @property
    def cost(self) -> float:
        return 0.1

    @property
    def label(self) -> str:
        return f"steps {self.integrator}, k {self.k:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        found = []
        for fluid, (J, Q) in (("isothermal", isothermal(self.k)), ("gas", gas(self.k))):
            for dt in self.dt:
                real = dt*ETA/(1 if fluid == "isothermal" else 2)
                row = {"integrator": self.integrator, "fluid": fluid, "wavenumber": self.k, "dt": dt}
                try:
                    C = steady_of_steps(STEPS[self.integrator](J, Q, real)).real
                except ArithmeticError:     # beyond its limit
                    continue
                hand = euler_heats(self.k, real) if (self.integrator, fluid) == ("forward-euler", "isothermal") else np.nan
                found.append({**row, "velocity": C[1, 1], "density": C[0, 0], "error": float(np.abs(C - np.eye(len(C))).max()),
                              "by_hand": hand})
        return Outcome({"steps": found})


@dataclass(frozen=True, kw_only=True)
class Moving(Case):
    """Points that move as Eq. 39 says, at constant temperature: density, velocity and displacement of one wave.

    As printed, the constant volume lets displacements x push back with 2 P grad(n dV): u' = -i s rho - 2 s^2 x - l u, besides
    rho' = -i s u, x' = u. With rho = -i s x, as it stays from rest on, stiffness is (1 + 2) c_T^2, and <u u> = 1 still.
    both : the positions by Eq. 40 as well, not by Eq. 41.
    """
    k: float
    dt: tuple[float, ...]
    both: bool

    @property
    def cost(self) -> float:
        return 0.1

    @property
    def label(self) -> str:
        return f"steps moving {'40, 40' if self.both else '40, 41'}, k {self.k:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        s, lap = line_symbols(self.k)
        l, found = ETA*lap, []
        for dt in self.dt:
            real = dt*ETA
            A = np.eye(3, dtype=complex) + real*np.array([[0, -1j*s, 0], [-1j*s, -l, -2*s*s], [0, 1, 0]])
            Q = np.diag([0, 2*l*real, 0]).astype(complex)
            if not self.both:       # x' = x + dt u', with the velocity that comes out and its noise
                A[2] = np.array([0, 0, 1]) + real*A[1]
                Q = np.outer([0, 1, real], [0, 1, real])*2*l*real
            # kept by every step: rho + i s x, less i s dt u where x moves with the new velocity
            kept = np.array([[1, 0 if self.both else -1j*s*real, 1j*s]])
            try:
                C = steady_of_steps(Step(A, Q), kept).real
            except ArithmeticError:
                continue
            found.append({"integrator": "eq40-eq40" if self.both else "eq40-eq41", "fluid": "moving", "wavenumber": self.k,
                          "dt": dt, "velocity": C[1, 1], "density": C[0, 0], "error": abs(C[1, 1] - 1), "by_hand": np.nan})
        return Outcome({"steps": found})
