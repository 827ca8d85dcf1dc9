"""Scenes by name: each is made for so many rows of points or cells, and takes its numbers besides."""
from collections.abc import Callable
from typing import Any

from continuum.scene import RayleighBenard, Walls
from studies.build.cavity import cavity
from studies.build.rapid import ShearLayer, ShockTube
from studies.build.scenes import Sound, TaylorGreen, between_plates

ROWS = 16


def convection(rows: int = ROWS, ra: float = 1e4, **more: Any) -> RayleighBenard:
    """A gas between a hot plate below and a cold one above, periodic sides, aspect 2    [KHP95, Fig. 5]"""
    return RayleighBenard(ra=ra, L=float(rows), **more)


def box(rows: int = ROWS, ra: float = 1e4, **more: Any) -> RayleighBenard:
    """The same in a square box, side walls with the conduction profile    [KHP95, Fig. 6]"""
    return RayleighBenard(ra=ra, L=float(rows), **{"aspect": 1.0, "sides": Walls(), **more})


def vortex(rows: int = ROWS, mach: float = 0.05) -> TaylorGreen:
    """A Taylor-Green vortex of Re 100 that decays by e in a periodic box; rows to the wavelength."""
    return TaylorGreen(L=rows, mach=mach)


def sound(rows: int = ROWS, **more: Any) -> Sound:
    """A standing wave of sound for two periods, rows to the wavelength; eight across."""
    return Sound(width=rows, **more)


#: name -> maker(rows, its numbers)
SCENES: dict[str, Callable[..., Any]] = {
    "rayleigh-benard": convection,
    "rayleigh-benard-box": box,
    "cavity": cavity,
    "taylor-green": vortex,
    "sound": sound,
    "shock-tube": lambda rows=54, **more: ShockTube(half=rows, **more),
    "shear-layer": lambda rows=ROWS, **more: ShearLayer(L=rows, **more),
    "couette": lambda rows=ROWS: between_plates("couette", rows),
    "conduction": lambda rows=ROWS: between_plates("conduction", rows),
}
