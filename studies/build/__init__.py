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

from studies.build import fixed, grid, moving, rr98_moving, spam
from studies.build.setting import Ready, of_method


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


def ready(scene: Any, method: Any, seed: int = 1, **more: Any) -> Ready:
    """A method in a scene, by its name, by a variant, as an object, or a class that takes the scene.

    more : as the family takes.

    Raises ValueError: No method has this name, or the family cannot take the scene.
    """
    chosen = variant(method) if isinstance(method, str) else method
    if hasattr(chosen, "ready"):
        made: Ready = chosen.ready(scene, seed, **more)
        return made
    return of_method(chosen(scene) if isinstance(chosen, type) else chosen, scene, seed)


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
