"""A run in the layer heated from below, and what is measured there, of any method."""
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Periodic
from particles.run import Divergence, Plan, Run, run
from particles.threads import Team
from studies.build.setting import Ready


class LayerRun(NamedTuple):
    """A run of a variant, its steps, and its end, None if it diverged."""
    ready: Ready
    steps: int
    done: Run | None


class Ended(NamedTuple):
    """K per mass and Nu at the end of a run that settles; errors are what its last tenth changed; whether that is little."""
    ke: float
    ke_err: float
    nu: float
    nu_err: float
    converged: bool


def followed(scene: Any, variant: Any, seed: int, t_end: float, often: int, report: Callable[[float], None] | None = None,
             checkpoint: Path | None = None) -> LayerRun:
    """Run until t_end in free-fall times; `variant.series` is read `often` times in one."""
    ready, unit = variant.ready(scene, seed), scene.L/scene.free_fall
    plan = Plan(dt=ready.dt, steps=round(t_end*unit/ready.dt), series=variant.series,
                every=max(1, round(unit/often/ready.dt)), checkpoint=checkpoint)
    try:
        return LayerRun(ready, plan.steps, run(ready.method, ready.start, plan, report))
    except Divergence as error:
        return LayerRun(ready, error.step, None)


def heat_at_rest(scene: Any) -> float:
    """Conducted through a plate: the unit of Nu."""
    return scene.k*scene.dT/scene.L*scene.width


def ended(scene: Any, done: Run) -> Ended:
    """From series ke, and heat through the lower and upper plate."""
    ke, lower, upper = (np.array(done.series[name]) for name in ("ke", "lower", "upper"))
    unit, late = heat_at_rest(scene), slice(-max(2, len(ke)//10), None)
    nu, err = (lower - upper)/2/unit, float(np.ptp(ke[late]))
    nu_err = float(np.ptp(nu[late]) + abs(lower[-1] + upper[-1])/2/unit)
    return Ended(ke[-1], err, nu[-1], nu_err, bool(err < 1e-3*ke[-1] + 1e-7))


def rolls(scene: Any, x: np.ndarray, vy: np.ndarray) -> int:
    """Twice the strongest harmonic of vy (n,) along x (n, 2) at mid-height; 0 at rest."""
    middle = np.abs(x[:, 1]) < scene.L/8
    vy = vy[middle]
    if np.abs(vy).max() < 1e-4*scene.free_fall:
        return 0
    size = [abs(np.mean(vy*np.exp(-2j*np.pi*m*x[middle, 0]/scene.width))) for m in range(1, 7)]
    return 2*(1 + int(np.argmax(size)))


def turns(scene: Any, vy: np.ndarray) -> int:
    """Changes of sign of a mean vy (rows, columns) along mid-height that stand out of the noise, a fifth of its largest value."""
    mid = vy[len(vy)//2 - 1:len(vy)//2 + 1].mean(axis=0)
    if np.abs(mid).max() < 5e-3*scene.free_fall:
        return 0
    up = mid[np.abs(mid) > 0.2*np.abs(mid).max()] > 0
    return int(np.sum(up[1:] != up[:-1]) + (isinstance(scene.sides, Periodic) and up[-1] != up[0]))


def at_end(method: Any, done: Run) -> tuple[Any, np.ndarray]:
    """(sums, state) of smooth particles: the last state in the order of new lists, with densities, motion and images."""
    sums, state = method.start(done.state.shape[1], Team(1)), done.state.copy()
    sums.around.relist(state, done.ids.copy(), 0.0)
    sums.densities(state)
    return sums, state
