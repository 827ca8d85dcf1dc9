"""Set up a method in a scene, ready to run: the one place where methods and scenes meet.

    from particles.run import Plan, run
    from studies.build import SCENES, ready

    method, start, dt = ready(SCENES["rayleigh-benard"](rows=16), "fixed-lattice", seed=1)
    done = run(method, start, Plan(dt=dt, steps=100))

In place of a name, `ready` takes a record of a family (`Variant`, `Scheme`, `FacesMotion`, `DriftMotion`,
`GridForm`) or a method of one's own with `state(x, rho, v, T)`. A record has `refuses(scene)`, the part of a
scene that it cannot take (empty if none), `ready(scene, seed, ...)`, the method in a scene, and, but for the
grid, `series`, quantities of a run: K, heat through plates.
"""
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from difflib import get_close_matches
from types import FunctionType
from typing import Any

import numpy as np

from continuum.domain import Domain
from continuum.exact.plates import FLOWS
from continuum.fluid import conductivity, viscosity
from continuum.jit import check_formulas
from continuum.scene import RayleighBenard, Walls
from studies.build import fixed, grid, moving, spam, stable
from studies.build.cavity import cavity
from studies.build.names import VARIATIONS
from studies.build.rapid import ShearLayer, ShockTube
from studies.build.scenes import HEIGHTS, BetweenPlates, Sound, TaylorGreen, as_dense
from studies.build.setting import CannotTake, Ready, of_method, shaken

ROWS = 16
FALLS = 90.0        # free-fall times: K of rolls at Ra 10 000 then changes by 0.1 % at most
FEW = 12            # an error message lists all names of a table that has no more than these


def convection(rows: int = ROWS, ra: float = 1e4, **more: Any) -> RayleighBenard:
    """A gas between a hot plate below and a cold one above, periodic sides, aspect 2    [KHP95, Fig. 5]"""
    return RayleighBenard(ra=ra, L=float(rows), **more)


def box(rows: int = ROWS, **more: Any) -> RayleighBenard:
    """A gas heated from below in a square box, side walls with the conduction profile    [KHP95, Fig. 6]"""
    return convection(rows, **{"aspect": 1.0, "sides": Walls(), **more})


#: name -> function that makes the scene, from its number of rows of points or cells and its parameters
SCENES: dict[str, Callable[..., Any]] = {
    "rayleigh-benard": convection,
    "rayleigh-benard-box": box,
    "cavity": cavity,
    "taylor-green": lambda rows=ROWS, **more: TaylorGreen(L=rows, **more),
    "sound": lambda rows=ROWS, **more: Sound(width=rows, **more),
    "shock-tube": lambda rows=54, **more: ShockTube(half=rows, **more),
    "shear-layer": lambda rows=ROWS, **more: ShearLayer(L=rows, **more),
    "couette": lambda rows=ROWS: BetweenPlates(flow=FLOWS["couette"], L=rows),
    "conduction": lambda rows=ROWS: BetweenPlates(flow=FLOWS["conduction"], L=rows),
}


def prefixed(family: str, variants: Mapping[str, Any], usual: str) -> dict[str, Any]:
    """Variants by names that begin with the family's; the usual variant has the family's alone."""
    return {family if name == usual else f"{family}-{name.removeprefix(f'{usual}-')}": variant
            for name, variant in variants.items()}


FAMILIES = (prefixed("grid", grid.FORMS, "flux-form"),
            prefixed("spam", spam.VARIANTS | spam.TODAY, "printed"), fixed.SCHEMES, moving.CARRIAGES,
            stable.STABLE, moving.MOTIONS, moving.DRIFT_MOTIONS)
#: name -> variant; tables have the family in a column of its own
METHODS = {name: variant for family in FAMILIES for name, variant in family.items()}
#: the best known method of each family
USUAL = ("grid", "spam", "fixed-lattice", "fixed-jittered-plates", "moving-delaunay", "moving",
         "moving-literal")


def ready(scene: Any, method: Any, seed: int = 1, **more: Any) -> Ready:
    """A method in a scene, ready to run; given by name, as a variant or object, or a class or function of the
    scene. more : further arguments of the variant's `ready`.

    Raises ValueError: no method has this name, or the family cannot take the scene. TypeError: what is given
    is not a method, or the scene's transport law lacks a formula.
    """
    chosen = variant(method)
    check_formulas(scene.law, viscosity, conductivity)
    if not hasattr(chosen, "ready"):
        made_here = isinstance(chosen, (type, FunctionType))
        return of_method(chosen(scene) if made_here else chosen, scene, seed)
    try:
        made: Ready = chosen.ready(scene, seed, **more)
    except CannotTake as part:
        able = [name for name in USUAL if not METHODS[name].refuses(scene)]
        raise ValueError(f"{called(method)} cannot take {part}: take {', '.join(able)}") from None
    return made


def variant(method: Any) -> Any:
    """The variant of a name; a variant or a method is returned as it is. Raises ValueError: no method has the
    name. TypeError: the argument is not a name, a variant or a method."""
    if isinstance(method, str):
        return of_name("method", method, METHODS)
    if not (callable(method) or hasattr(method, "ready") or hasattr(method, "state")):
        raise TypeError(f"a method is a name, a variant, an object with `state`, or a class or function of "
                        f"the scene, got {method!r}: make words lists the names")
    return method


def called(method: Any) -> str:
    """Name of a method in messages, titles and tables; of a variant its name in `METHODS`."""
    if isinstance(method, str):
        return method
    same = [name for name, known in METHODS.items() if known is method]
    return str([*same, getattr(method, "name", "") or getattr(method, "__name__", type(method).__name__)][0])


def variants(*names: str) -> dict[str, Any]:
    """Variants by their names."""
    return {name: variant(name) for name in names}


def of_name(kind: str, name: str, table: Mapping[str, Any]) -> Any:
    """Entry of a table under a name. Raises ValueError: the table lacks it; the message suggests others."""
    if name in table:
        return table[name]
    why = f"no {kind} is called {name!r}"
    if kind == "method" and name in VARIATIONS:
        why = f"{name} is used by a single study only, {VARIATIONS[name].about}"
    raise ValueError(f"{why}; {near(name, table)}; make words lists all")


def near(name: str, names: Iterable[str]) -> str:
    """Hint for an error message: similar names; if there are none, all names if few, else the usual ones."""
    known = list(names)
    if alike := get_close_matches(name, known, 4, 0.4):
        return f"near to it are {', '.join(alike)}"
    if len(known) <= FEW:
        return f"there are {', '.join(known)}"
    usual = ", ".join(one for one in USUAL if one in known)
    return f"no name of {len(known)} is near to it; the usual ones are {usual}"


# --- scenes: what may be asked besides the start ------------------------------------------------------------
# a scene may define `duration`, `answer`, `quantities`, `of_one_mass`, and `counted`, the length that is the
# number of rows, if that is not the height L

def duration(scene: Any) -> tuple[float, float]:
    """(length of a run in the scene's unit of time, this unit); exact solutions are known at its end."""
    if isinstance(scene, RayleighBenard):
        return FALLS, scene.L/scene.free_fall
    return scene.duration if hasattr(scene, "duration") else (1.0, float(scene.time))


def rows_of(scene: Any) -> int:
    """Number of points or cells over the counted length: the height, or the wavelength of sound."""
    return round(getattr(scene, counted(scene)))


def with_rows(scene: Any, rows: int) -> Any:
    """The same scene with another number of rows of points or cells."""
    if hasattr(scene, "resized"):
        return scene.resized(rows)
    name = counted(scene)
    return replace(scene, **{name: type(getattr(scene, name))(rows)})


def counted(scene: Any) -> str:
    """Name of the scene's length that is its number of rows."""
    return getattr(scene, "counted", "L")


def answer(scene: Any, x: np.ndarray) -> dict[str, np.ndarray]:
    """Exact fields at the end of a run at positions x (n, 2), by names such as vx, T; empty if not known."""
    return scene.answer(x) if hasattr(scene, "answer") else {}


def of_one_mass(scene: Any, seed: int) -> tuple[Any, Any]:
    """Start positions (n, 2) of particles of equal mass, and fields there; two None if the density is 1."""
    if hasattr(scene, "of_one_mass"):
        return scene.of_one_mass(seed)
    if not isinstance(scene, Domain) or scene.start or not scene.g:
        return None, None
    at_rest = scene.fields(scene.L*np.stack([0*HEIGHTS, HEIGHTS - 0.5], axis=1))[0]
    x = as_dense(shaken(scene, seed), scene.L, at_rest)
    return x, scene.fields(x)
