"""Check that a method has all that a run needs of it (`particles.method`), before anything runs."""
from typing import Any

import numpy as np

from particles.limits import limit_of, rates_of
from particles.method import Leaps, Sums
from particles.plan import Run
from particles.threads import Threads
from studies.build.setting import Ready
from studies.front.solving import named, prepared

#: member -> its form, in messages
MEMBERS = {"names": "names, of the rows of a state", "eos": "eos, the scene's",
           "fields": "fields(state), which gives Fields(x, v, rho, T, V)",
           "start": "start(n, threads), which gives its sums: inherit OwnRates",
           "state": "state(rho, v, T), or state(x, rho, v, T) without places x of its own"}
AGREE = 1e-6        # largest difference of fields(state(...)) from the scene's fields


class Breach(TypeError):
    """A method lacks a member, or one of its results is wrong."""


def contract(scene: Any, method: Any) -> dict[str, float]:
    """Check a method in a scene; return no numbers. Raises Breach: it does not meet the contract."""
    chosen = named(method)
    if isinstance(chosen, type) and not hasattr(chosen, "ready"):
        made = chosen(scene)
        if lacking := [told for name, told in MEMBERS.items() if not hasattr(made, name)]:
            raise Breach(f"lacks {'; '.join(lacking)}")
    check(scene, prepared(scene, chosen))
    return {}


def check(scene: Any, ready: Ready) -> None:
    """Raise Breach if a method in a scene has wrong fields, sums or limit of the step."""
    check_fields(scene, ready.method, ready.start)
    check_sums(ready.method, ready.start)
    if not 0 < ready.limit < np.inf:
        raise Breach(f"its longest step is {ready.limit}: limit(start) must be positive and finite")


def check_fields(scene: Any, method: Any, start: np.ndarray) -> None:
    """Raise Breach if start or fields have wrong shapes, or v or T differ from the scene's."""
    if start.ndim != 2 or len(start) != len(method.names):
        raise Breach(f"state gives an array {start.shape}: it has {len(method.names)} rows, one for "
                     "each of names")
    at = method.fields(start)
    n = len(at.rho)
    wanted = {"x": (n, 2), "v": (n, 2), "rho": (n,), "T": (n,), "V": (n,)}
    for name, shape in wanted.items():
        if np.shape(getattr(at, name)) != shape:
            raise Breach(f"fields gives {name} of shape {np.shape(getattr(at, name))} where rho has {n} "
                         f"points: it must be {shape}")
    _, v, T = scene.fields(at.x)
    for name, has, known in (("v", at.v, v), ("T", at.T, T)):
        off = float(np.abs(has - known).max())
        if not off < AGREE:
            raise Breach(f"fields(state(...)) does not give back {name}: it is {off:.2g} off")


def check_sums(method: Any, start: np.ndarray) -> None:
    """Raise Breach if sums lack a member; compute rates, or leap once: these raise errors of their own."""
    sums = method.start(start.shape[1], Threads(1))
    if not isinstance(sums, Sums):
        asked = ("method", *(name for name in dir(Sums) if not name.startswith("_")))
        lacking = ", ".join(name for name in asked if not hasattr(sums, name))
        raise Breach(f"its sums lack {lacking}: inherit Sums of particles.method")
    if not hasattr(method, "integrator"):
        now = Run(state=start.copy(), ids=np.arange(start.shape[1]))
        sums.make_ready(now, 1e-6)
        rates_of(sums, now.state)
    elif method.integrator is Leaps:
        Leaps(start.shape, Threads(1)).step(sums, start.copy(), 0.1*limit_of(method, start))
