"""Hard cases: a scene, how long it is followed, and what is to be expected    [KHP95, Sec. VI; RR98, Sec.
III]

All have 16 rows: the question is who gives way first, not who is best. Units: spacing, mean density, P/rho at
T = 1.
"""
from dataclasses import dataclass
from math import pi, sqrt
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.scene import RayleighBenard, Torus, Walls
from studies.build.scenes import Slab

ROWS = 16
SOUND = sqrt(2)
THIN = 1e-3         # density in place of vacuum, for methods whose points fill the box
SPEED = 0.1         # of the vortex: Mach number 0.07


@dataclass(frozen=True, kw_only=True)
class Vortex(Slab):
    """A steady Taylor-Green vortex without viscosity between plates that slip."""
    L: float = ROWS
    aspect: float = 1.0
    viscosity: float = 0.0
    heat: float = 0.0

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """Velocities; `ke` says nothing here."""
        k = 2*np.pi/self.L
        return SPEED*np.sin(k*x)*np.cos(k*y), -SPEED*np.cos(k*x)*np.sin(k*y)


@dataclass(frozen=True, kw_only=True)
class Strip(Slab):
    """Gas without viscosity, |x| < L, beside nothing: fronts run out at 2 c/(gamma - 1) = 2 c."""
    L: float = 8.0
    aspect: float = 12.0
    viscosity: float = 0.0
    heat: float = 0.0

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """Rest."""
        return 0*x, 0*y

    def fields(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Density 1 in the strip."""
        rho = np.where(np.abs(x[:, 0]) < self.L, 1.0, THIN)
        return rho, np.zeros((len(x), 2)), self.T(x[:, 1])

    def kinetic(self, t: float) -> float:
        """K per mass before the rarefactions meet, 0.2 c^3 t/L for gamma = 2.

        From u = 2 (c + x/t)/3 and rho = (2 - x/ct)^2/9.
        """
        if not t < self.L/SOUND:
            raise ValueError(f"rarefactions have met at t = {self.L/SOUND:.3g}, got {t}: take an earlier "
                             "time")
        return 0.2*SOUND**3*t/self.L


@dataclass(frozen=True, kw_only=True)
class Corner(Slab):
    """A viscous gas at rest in a square box with four walls: what moves is an error."""
    L: float = 12.0
    aspect: float = 1.0
    viscosity: float = 0.3
    heat: float = 0.3
    sides: Walls = Walls()  # noqa: RUF009 (immutable)

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """Rest."""
        return 0*x, 0*y


U, BEGIN = 0.15, 0.01       # of the shear flow: Mach number 0.1; size of the wave over U at the start
HARMONICS = 20              # on either side: the rate is good to 1e-9


class Wave(NamedTuple):
    """Growth rate, and amplitudes psi_n of the harmonics -HARMONICS .. HARMONICS."""
    rate: float
    psi: np.ndarray


def fastest(k: float, kx: float) -> Wave:
    """The wave exp(i k_x x) on u = U sin ky that grows fastest    [Rayleigh 1880; Meshalkin & Sinai 1961]

    Small waves obey q_t = -i k_x u (q + k^2 psi), q = lap psi, so harmonics q_n exp(inky) of each other:

        dq_n/dt = -(k_x U/2) [(1 - k^2/K_(n-1)^2) q_(n-1) - (1 - k^2/K_(n+1)^2) q_(n+1)],    K_n^2 = k_x^2 + n^2 k^2
    """
    n = np.arange(-HARMONICS, HARMONICS + 1)
    K2 = kx**2 + (n*k)**2
    part = kx*U/2*(1 - k**2/K2)
    rates, modes = np.linalg.eig(np.diag(part[1:], 1) - np.diag(part[:-1], -1))
    best = int(np.argmax(rates.real))
    return Wave(float(rates[best].real), -modes[:, best]/K2)


@dataclass(frozen=True, kw_only=True)
class ShearFlow(Slab):
    """u = U sin ky without viscosity, and the wave that grows fastest, of size BEGIN U."""
    L: float = 16.0
    aspect: float = 2.0
    viscosity: float = 0.0
    heat: float = 0.0

    @property
    def k(self) -> float:
        """Of the flow; that of the wave is half of it."""
        return 2*pi/self.L

    @property
    def wave(self) -> Wave:
        """The wave that grows fastest."""
        return fastest(self.k, self.k/2)

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """u = psi_y, v = -psi_x on top of U sin ky; `ke` says nothing here."""
        kx, psi = self.k/2, self.wave.psi
        psi = psi*BEGIN*U/(kx*abs(psi[HARMONICS]))
        n = np.arange(-HARMONICS, HARMONICS + 1)[:, None]
        waves = psi[:, None]*np.exp(1j*(kx*x + n*self.k*y))
        return U*np.sin(self.k*y) + (1j*n*self.k*waves).sum(axis=0).real, -(1j*kx*waves).sum(axis=0).real


@dataclass(frozen=True)
class Open:
    """A scene without its plates: periodic along both axes."""
    scene: Any
    sides: ClassVar[Torus] = Torus()

    def __getattr__(self, name: str) -> Any:
        return getattr(self.scene, name)


def layer(ra: float, pr: float = 1.0, T: float = 1.0) -> RayleighBenard:
    """KHP95's layer at another mean temperature: the static pressure is T, the flow is that of Ra and Pr."""
    return RayleighBenard(ra=ra, pr=pr, L=float(ROWS), T_hot=T + 0.5, T_cold=T - 0.5)


#: layers by case, with the time in free-fall times
LAYERS = {"Ra 1e5": (layer(1e5), 50.0), "Ra 1e6": (layer(1e6), 50.0), "Prandtl 0.01": (layer(1e4, 0.01), 30.0),
          "Prandtl 100": (layer(1e4, 100.0), 30.0), "high pressure": (layer(1e4, T=4.0), 20.0),
          "disordered points": (layer(1e4), 30.0), "narrow weight": (layer(1e4), 30.0)}
#: the vortex turns SPEED t/L = 5 times, the rarefactions come within 0.7 of the middle, walls are crossed by
#: sound 35 times
BOXES = {"zero viscosity": (Vortex(), 800.0), "vacuum": (Strip(), 0.7*8/SOUND), "wall corner": (Corner(), 300.0)}
