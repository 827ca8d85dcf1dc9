"""Scenes of hard cases, and methods in them    [KHP95, Sec. VI; RR98, Sec. III]

All have 16 rows or so: the question is who gives way first. Units: spacing, mean density, P/rho at T = 1.
"""
from collections.abc import Callable
from dataclasses import dataclass
from math import pi, sqrt
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.shear import growing_wave, layer_with_wave
from continuum.gas.fields import block, placed
from continuum.scene import RayleighBenard, Torus, Walls
from studies.build.grid import GridForm, started
from studies.build.names import START_JITTER
from studies.build.scenes import Slab, Tile
from studies.build.setting import Ready, positions
from studies.build.spam import Variant

ROWS = 16
SOUND = sqrt(2)
THIN = 1e-3         # density in place of vacuum, for methods whose points fill the box
SPEED = 0.1         # of the vortex: Mach number 0.07
U, BEGIN = 0.15, 0.01       # of the shear flow: Mach number 0.1; size of the wave over U at the start
Velocities = tuple[np.ndarray, np.ndarray]


def vortex(x: np.ndarray, y: np.ndarray, L: float) -> Velocities:
    """A steady Taylor-Green vortex, which passes through no plate."""
    k = 2*np.pi/L
    return SPEED*np.sin(k*x)*np.cos(k*y), -SPEED*np.cos(k*x)*np.sin(k*y)


def sheared(x: np.ndarray, y: np.ndarray, L: float) -> Velocities:
    """U sin ky and its fastest wave, of size BEGIN U."""
    places = np.stack([x, y], axis=-1)
    v = layer_with_wave(places.reshape(-1, 2), U, 2*pi/L, BEGIN).reshape(places.shape)
    return v[..., 0], v[..., 1]


@dataclass(frozen=True, kw_only=True)
class Chamber(Slab):
    """A gas between plates, with velocities(x, y, L) at the start; of a strip only |x| < L is dense.

    ripple : of densities, up and down from one spacing to the next.
    """
    viscosity: float = 0.0
    heat: float = 0.0
    velocities: Callable | None = None
    strip: bool = False
    ripple: float = 0.0

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None) -> Velocities:
        """Velocities; `ke` and `rolls` say nothing here."""
        return self.velocities(x, y, self.L) if self.velocities else (0*x, 0*y)

    def fields(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Density, velocity, temperature at places (n, 2)."""
        v = np.stack(self.flow(*x.T), axis=1)
        outside = self.strip and np.abs(x[:, 0]) >= self.L
        sign = 1 - 2*(np.floor(x).sum(axis=1) % 2)
        return np.where(outside, THIN, 1 + self.ripple*sign), v, self.T(x[:, 1])


VORTEX = Chamber(L=ROWS, aspect=1.0, velocities=vortex)
STRIP = Chamber(L=8.0, aspect=12.0, strip=True)
CORNER = Chamber(L=12.0, aspect=1.0, viscosity=0.3, heat=0.3, sides=Walls())
CROWD = Chamber(L=1000.0, aspect=1.0, velocities=vortex)
CHESSBOARD = Chamber(L=12.0, aspect=1.0, viscosity=0.3, heat=0.3, ripple=0.1)
#: without viscosity; that it conducts heat keeps drifting points from ending at once
SHEAR_FLOW = Chamber(L=16.0, aspect=2.0, heat=2*pi/16, velocities=sheared)
#: of the shear flow, and the growth rate of its fastest wave, which is twice as long
WAVE_NUMBER = 2*pi/SHEAR_FLOW.L
RATE, _ = growing_wave(U, WAVE_NUMBER, WAVE_NUMBER/2)


def rarefied(t: float) -> float:
    """K per mass of the strip before its rarefactions meet, 0.2 c^3 t/L for gamma = 2.

    From u = 2 (c + x/t)/3 and rho = (2 - x/ct)^2/9; fronts run out at 2 c/(gamma - 1) = 2 c.
    """
    meet = STRIP.L/SOUND
    if not t < meet:
        raise ValueError(f"rarefactions have met at t = {meet:.3g}, got {t}: take an earlier time")
    return 0.2*SOUND**3*t/STRIP.L


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


def falls(scene: RayleighBenard, times: float) -> float:
    """So many free-fall times."""
    return times*scene.L/scene.free_fall


class Situation(NamedTuple):
    """A scene, and how long it is followed."""
    scene: Any
    time: float


def convection(times: float, *layer_of: float) -> Situation:
    """A layer, followed for so many free-fall times."""
    scene = layer(*layer_of)
    return Situation(scene, falls(scene, times))


LAYERS = {
    "Ra 1e5": convection(50.0, 1e5),
    "Ra 1e6": convection(50.0, 1e6),
    "Ra 1e7": convection(50.0, 1e7),
    "Ra 1e8": convection(50.0, 1e8),
    "Prandtl 0.01": convection(30.0, 1e4, 0.01),
    "Prandtl 100": convection(30.0, 1e4, 100.0),
    "high pressure": convection(20.0, 1e4, 1.0, 4.0),
    "disordered points": convection(30.0, 1e4),
    "narrow weight": convection(30.0, 1e4),
}
#: the vortex turns SPEED t/L = 5 times, rarefactions come within 0.7 of the middle, sound crosses 35 times;
#: a layer below onset rests, a million points take a hundred steps or so
BOXES = {
    "zero viscosity": Situation(VORTEX, 800.0),
    "vacuum": Situation(STRIP, 0.7*8/SOUND),
    "wall corner": Situation(CORNER, 300.0),
    "long rest": convection(1e4, 1e3),
    "a million points": Situation(CROWD, 60.0),
}
SITUATIONS = {**LAYERS, **BOXES}


def places(scene: Any) -> np.ndarray:
    """(n, 2) where particles start: away from where plates would be."""
    return positions(scene.width, scene.L, START_JITTER, 1)


class Smooth(NamedTuple):
    """Smooth particles, none where the gas is thin; their step is chosen at the start."""
    variant: Variant

    def ready(self, scene: Any) -> Ready:
        """In a scene."""
        x = places(scene)
        ready = self.variant.ready(scene, x=x[scene.fields(x)[0] > THIN])
        return ready._replace(dt=self.variant.step*ready.limit)


class WithoutPlates(NamedTuple):
    """A method that takes a scene without its plates."""
    variant: Any

    def ready(self, scene: Any) -> Ready:
        """In a scene."""
        return self.variant.ready(Open(scene))  # type: ignore[no-any-return]


class Tiled(NamedTuple):
    """The compressible grid without plates, and so without gravity, for the time loop of particles."""
    form: GridForm

    def ready(self, scene: Any) -> Ready:
        """In a scene, whose plates are left out."""
        box = Tile(width=scene.width, L=scene.L, eos=scene.eos, law=scene.law)
        start = placed(box, round(scene.L), lambda x, y: started(scene, x, y))
        method, S, dt = self.form.ready(box, first=block(start))
        return Ready(method, S.reshape(4, -1), dt)
