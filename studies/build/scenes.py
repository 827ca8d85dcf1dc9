"""Scenes of flows with exact solutions; convection is `continuum.scene.RayleighBenard`.

Lengths in spacings; the gas is ideal with C_V = 1, density and temperature about 1, conductivity = viscosity.
`studies.build` reads their properties besides the start.
"""
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.linalg import expm

from continuum.exact import plates
from continuum.exact.plates import MU, PlateFlow
from continuum.exact.vortex import Vortex, solved, velocities
from continuum.exact.waves import LinearGas, continuum
from continuum.fluid import ConstEta, IdealGas
from continuum.scene import Periodic, RayleighBenard, Torus
from particles.integral.points import lattice
from studies.build.names import START_JITTER
from studies.build.setting import shifted

SOUND = sqrt(2)         # of the gas at T = 1, in 2D
TINY = 1e-12            # in place of zero: the grid divides by coefficients
HEIGHTS = np.linspace(0, 1, 2001)
Start = tuple[np.ndarray, np.ndarray, np.ndarray]
Answer = dict[str, np.ndarray]


class Scene:
    """Base of scenes: a gas at rest without gravity, periodic along both axes."""
    eos: Any = IdealGas()
    sides: Any = Torus()
    slide = 0.0
    g = 0.0
    T_hot = T_cold = T_mean = 1.0
    dT = 0.0
    width: float
    L: float

    @property
    def aspect(self) -> float:
        return self.width/self.L

    def fields(self, x: np.ndarray) -> Start:
        """Density (n,), velocity (n, 2), temperature (n,) at the start, at positions x (n, 2)."""
        return np.ones(len(x)), np.zeros((len(x), 2)), np.ones(len(x))


@dataclass(frozen=True, kw_only=True)
class Tile(Scene):
    """A gas at rest in a periodic box of any size, with any equation of state and transport law."""
    width: float
    L: float
    law: Any
    eos: Any = IdealGas()  # noqa: RUF009 (immutable)


@dataclass(frozen=True, kw_only=True)
class TaylorGreen(Scene):
    """A Taylor-Green vortex in a periodic box of L spacings, one wavelength; it decays by a factor e."""
    L: int
    mach: float = 0.05

    @property
    def vortex(self) -> Vortex:
        return Vortex(self.mach, self.L)

    @property
    def width(self) -> int:  # type: ignore[override]
        return self.L

    @property
    def speed(self) -> float:
        return self.vortex.speed

    @property
    def law(self) -> ConstEta:
        return ConstEta(self.vortex.eta, self.vortex.eta)

    @property
    def time(self) -> float:
        """Time at which velocities of an incompressible fluid are a factor e smaller."""
        return self.vortex.time

    def fields(self, x: np.ndarray) -> Start:
        rho = self.vortex.density(x)
        return rho, self.vortex.velocity(x), rho

    def answer(self, x: np.ndarray) -> Answer:
        v = self.speed*velocities(solved(self.mach), x/self.L)
        return {"vx": v[:, 0], "vy": v[:, 1]}

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        x = shifted(self.L, self.L, START_JITTER, seed)
        return x, self.fields(x)


@dataclass(frozen=True, kw_only=True)
class Sound(Scene):
    """A standing sound wave of one wavelength along x, at rest at first; exact for small amplitudes."""
    L: int = 8              # height: more than twice a range of three
    width: int
    amplitude: float = 1e-5      # steepening, about 12 times this, is 1e-4 of the wave
    damping: float = 0.01       # eta = kappa, in wavelengths: a third of the wave is left at the end
    periods: float = 2.125      # two and an eighth: neither density nor velocity is zero

    counted = "width"

    @property
    def k(self) -> float:
        return 2*np.pi/self.width

    @property
    def law(self) -> ConstEta:
        return ConstEta(self.damping*self.width, self.damping*self.width)

    @property
    def time(self) -> float:
        return self.periods*self.width/np.sqrt(2)

    def exactly(self, time: float, x: np.ndarray) -> np.ndarray:
        """Exact deviations of (rho, u, T), each (n,), from their means, at x (n,)."""
        matrix = continuum(LinearGas(self.law.eta, 0.0, self.law.k), self.k).matrix
        return self.amplitude*np.real(np.outer(expm(matrix*time)@np.array([1, 0, 1]), np.exp(1j*self.k*x)))

    def fields(self, x: np.ndarray) -> Start:
        rho, u, T = self.exactly(0.0, x[:, 0])
        return 1 + rho, np.stack([u, 0*u], axis=1), 1 + T

    def answer(self, x: np.ndarray) -> Answer:
        _, u, T = self.exactly(self.time, x[:, 0])
        return {"vx": u, "T": 1 + T}

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        """A lattice displaced to give equal masses the density of the wave, with fields at its sites."""
        x = lattice((self.width, self.L)).x
        fields = self.fields(x)
        x[:, 0] -= self.amplitude/self.k*np.sin(self.k*x[:, 0])
        return x, fields


@dataclass(frozen=True, kw_only=True)
class BetweenPlates(Scene):
    """Conduction of heat, or Couette flow that sets in, between plates of temperature 1, L rows apart."""
    flow: PlateFlow
    L: int
    width: int = 8          # wider than twice a range of three
    sides: Periodic = Periodic()  # noqa: RUF009 (immutable)

    @property
    def slide(self) -> float:  # type: ignore[override]
        return self.flow.U

    @property
    def law(self) -> ConstEta:
        """The same fluid at every resolution: coefficients grow with the height L in spacings."""
        return ConstEta(MU*self.L, MU*self.L)

    @property
    def time(self) -> float:
        return self.flow.time*self.L

    def fields(self, x: np.ndarray) -> Start:
        rho, v, u, T = self.flow.start(x[:, 1]/self.L + 0.5)
        return rho, np.stack([u, v], axis=1), T

    def answer(self, x: np.ndarray) -> Answer:
        _, _, u, T = plates.fields(self.flow, x[:, 1]/self.L + 0.5)
        return {"vx": u} if self.flow.U else {"T": T}

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        x = as_dense(lattice((self.width, self.L)).x, self.L, self.flow.start(HEIGHTS)[0])
        return x, self.fields(x)


def as_dense(x: np.ndarray, L: float, rho: np.ndarray) -> np.ndarray:
    """Positions (n, 2) moved along y so that equal masses have a density rho, given at HEIGHTS."""
    mass, below = cumulative_trapezoid(rho, HEIGHTS, initial=0), x[:, 1]/L + 0.5
    return np.stack([x[:, 0], L*(np.interp(below*mass[-1], mass, HEIGHTS) - 0.5)], axis=1)


@dataclass(frozen=True, kw_only=True)
class Slab(RayleighBenard):
    """A layer of L rows at rest between plates of almost equal temperature; `ra`, `pr` mean nothing."""
    viscosity: float
    heat: float
    ra: float = 1.0
    T_hot: float = 1 + 1e-9
    T_cold: float = 1 - 1e-9

    @property
    def nu(self) -> float:
        """Kinematic viscosity at density 1, as given."""
        return max(self.viscosity, TINY)

    @property
    def kappa(self) -> float:
        """Thermal diffusivity k/(rho C_V), as given."""
        return max(self.heat/float(self.eos.cv), TINY)
