"""Hard cases: a scene, how long it is followed, and what is to be expected    [KHP95, Sec. VI; RR98, Sec. III]

All have 16 rows: the question is who gives way first, not who is best. Units: spacing, mean density, P/rho at T = 1.
"""
from dataclasses import dataclass
from math import sqrt

import numpy as np

from continuum.scene import RayleighBenard, Walls
from studies.build.scenes import Slab

ROWS = 16
SOUND = sqrt(2)
THIN = 1e-3         # density in place of vacuum, for methods whose points fill the box
SPEED = 0.1         # of the vortex: Mach number 0.07


@dataclass(frozen=True, kw_only=True)
class Vortex(Slab):
    """One Taylor-Green vortex without viscosity between plates that slip: it is steady, its kinetic energy stays."""
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
    """Gas without viscosity, |x| < L, on either side of it nothing: rarefactions run in, fronts out at 2 c/(gamma - 1) = 2 c."""
    L: float = 8.0
    aspect: float = 12.0
    viscosity: float = 0.0
    heat: float = 0.0

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """Rest."""
        return 0*x, 0*y

    def density(self, x):
        """1 in the strip."""
        return np.where(np.abs(x) < self.L, 1.0, THIN)

    def kinetic(self, t: float) -> float:
        """K per mass before the rarefactions meet: 0.2 c^3 t/L for gamma = 2, from u = 2 (c + x/t)/3, rho = (2 - x/ct)^2/9."""
        if not t < self.L/SOUND:
            raise ValueError(f"rarefactions have met at t = {self.L/SOUND:.3g}, got {t}: take an earlier time")
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


def layer(ra: float, pr: float = 1.0, T: float = 1.0) -> RayleighBenard:
    """KHP95's layer at another mean temperature: the static pressure is T, the flow is that of Ra and Pr."""
    return RayleighBenard(ra=ra, pr=pr, L=float(ROWS), T_hot=T + 0.5, T_cold=T - 0.5)


#: layers by case, with the time in free-fall times
LAYERS = {"Ra 1e5": (layer(1e5), 50.0), "Ra 1e6": (layer(1e6), 50.0), "Prandtl 0.01": (layer(1e4, 0.01), 30.0),
          "Prandtl 100": (layer(1e4, 100.0), 30.0), "high pressure": (layer(1e4, T=4.0), 20.0),
          "disordered points": (layer(1e4), 30.0), "narrow weight": (layer(1e4), 30.0)}
#: the vortex turns SPEED t/L = 5 times, the rarefactions come within 0.7 of the middle, walls are crossed by sound 35 times
BOXES = {"zero viscosity": (Vortex(), 800.0), "vacuum": (Strip(), 0.7*8/SOUND), "wall corner": (Corner(), 300.0)}
