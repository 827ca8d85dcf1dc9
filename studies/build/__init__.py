"""A method in a scene, ready to run: the one place where both meet.

    from continuum.scene import RayleighBenard
    from particles.run import Plan, run
    from studies.build import ready

    method, start, dt = ready(RayleighBenard(ra=1e4, L=16.0), "fixed-lattice", seed=1)
    done = run(method, start, Plan(dt=dt, steps=100))

A record of a family (`Variant`, `Scheme`, `FacesMotion`, `DriftMotion`, `GridForm`) or a method of one's own,
with `state(x, rho, v, T)`, may stand in its place. Flows with exact answers are in `studies.build.scenes`.
"""
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Any

from continuum.fluid import conductivity, viscosity
from continuum.jit import check_formulas
from studies.build import fixed, grid, moving, rr98_moving, spam
from studies.build.setting import CannotTake, Ready, of_method


def joined(*families: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """One table of names. Raises ValueError: A name stands for two variants."""
    table: dict[str, Any] = {}
    for name, variant in (pair for family in families for pair in family):
        if name in table:
            raise ValueError(f"two methods are called {name!r}: {table[name]} and {variant}; "
                             "give one of them another name")
        table[name] = variant
    return table


def prefixed(family: str, variants: Mapping[str, Any], usual: str) -> Iterable[tuple[str, Any]]:
    """Names with the family before them; the usual variant has the family's own."""
    for name, variant in variants.items():
        yield family if name == usual else f"{family}-{name.removeprefix(f'{usual}-')}", variant


#: name -> variant; tables have the family in another column
METHODS = joined(
    prefixed("grid", grid.FORMS, "flux-form"),
    prefixed("spam", spam.VARIANTS, "printed"),
    fixed.SCHEMES.items(),
    moving.MOTIONS.items(),
    rr98_moving.DRIFT_MOTIONS.items())


#: the best known of each family
USUAL = ("grid", "spam", "fixed-lattice", "fixed-jittered-plates", "moving", "moving-literal")


def ready(scene: Any, method: Any, seed: int = 1, **more: Any) -> Ready:
    """A method in a scene, by its name, by a variant, as an object, or a class that takes the scene.

    more : as the family takes.

    Raises ValueError: No method has this name, or the family cannot take the scene. TypeError: the scene's
    transport law lacks a formula.
    """
    check_formulas(scene.law, viscosity, conductivity)
    chosen = variant(method) if isinstance(method, str) else method
    if hasattr(chosen, "ready"):
        return of_variant(chosen, scene, seed, **more)
    return of_method(chosen(scene) if isinstance(chosen, type) else chosen, scene, seed)


def of_variant(chosen: Any, scene: Any, seed: int, **more: Any) -> Ready:
    """What `ready` makes of a variant."""
    try:
        made: Ready = chosen.ready(scene, seed, **more)
    except CannotTake as refused:
        able = [name for name in USUAL if not METHODS[name].refuses(scene)]
        raise ValueError(f"{refused}: take {', '.join(able)}") from None
    return made


def variant(name: str) -> Any:
    """The variant of a name. Raises ValueError: there is none."""
    if name not in METHODS:
        raise ValueError(f"no method is called {name!r}; near to it are {near(name, METHODS)}; "
                         "studies.build.METHODS lists all")
    return METHODS[name]


def variants(*names: str) -> dict[str, Any]:
    """Variants by their names."""
    return {name: variant(name) for name in names}


def near(name: str, names: Iterable[str]) -> str:
    """Names like one, or all of them."""
    known = list(names)
    return ", ".join(get_close_matches(name, known, 4, 0.4) or known)
