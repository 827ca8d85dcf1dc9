"""What films show: particles, moving points and the grid at equal times, all from the rolls of KHP95's Sec. VI."""
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import temperature
from continuum.gas.fields import initial
from continuum.gas.solve import run as march
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.run import Plan, run
from studies.build import moving, ready, spam
from studies.build.names import START_ENERGY

OF_FIRST = 0.6      # of the limit of the step at the start: it falls as the flow grows


class Dots(NamedTuple):
    """Particles or points at one time: places over L and temperatures, each (n,), and K per mass of all of them."""
    x: np.ndarray
    y: np.ndarray
    T: np.ndarray
    ke: float


class Image(NamedTuple):
    """The grid at one time: temperature and velocity at nodes, each (rows + 1, columns + 1), places over L, and K per mass."""
    x: np.ndarray
    y: np.ndarray
    T: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    ke: float


def grid(scene: RayleighBenard, rows: int, times: np.ndarray) -> Iterator[Image]:
    """The compressible grid at `times`, equally far apart from 0 on, in free-fall times."""
    fields, unit = initial(scene, rows, START_ENERGY), scene.L/scene.free_fall
    ke = START_ENERGY
    for number in range(len(times)):
        if number:
            solution = march(scene, rows, until=Time((times[1] - times[0])*unit, 1), start=fields)
            fields, ke = solution.fields, solution.ke
        at = fields.at
        yield Image(fields.x/scene.L, fields.y/scene.L, at.T, at.vx, at.vy, ke)


def smooth_particles(scene: RayleighBenard, seed: int, times: np.ndarray, variant: spam.Variant = spam.PRINTED) -> Iterator[Dots]:
    """Smooth particles of a variant, as the study has them."""
    def look(state: np.ndarray) -> Dots:
        T = temperature(scene.eos, np.ones_like(state[4]), state[4])
        return Dots(state[0]/scene.L, state[1]/scene.L, T, float(np.mean(state[2]**2 + state[3]**2)/2))
    yield from stretches(*variant.ready(scene, seed), scene, times, look)


def closed_faces(scene: RayleighBenard, seed: int, times: np.ndarray) -> Iterator[Dots]:
    """Moving points that exchange over closed faces."""
    fluid, first, limit = ready(scene, "moving", seed)
    def look(state: np.ndarray) -> Dots:
        px, py, m, V, E = state[moving.EXCHANGED]
        kinetic = (px**2 + py**2)/(2*m)
        T = temperature(scene.eos, m/V, (E - kinetic)/m)
        return Dots(state[0]/scene.L, state[1]/scene.L, T, float(kinetic.sum()/m.sum()))
    yield from stretches(fluid, first, OF_FIRST*limit, scene, times, look)


def printed_motion(scene: RayleighBenard, seed: int, times: np.ndarray) -> Iterator[Dots]:
    """Points that move with v under RR98's balances (Eqs 34-36, 39-41), literally."""
    fluid, first, limit = ready(scene, "moving-literal", seed)
    def look(state: np.ndarray) -> Dots:
        m = state[4]*state[6]/fluid.motion.owned(state[6])
        ke = float(m@((state[2]**2 + state[3]**2)/state[4]**2)/m.sum()/2)
        return Dots(state[0]/scene.L, state[1]/scene.L, fluid.temperature(state), ke)
    yield from stretches(fluid, first, OF_FIRST*limit, scene, times, look)


def stretches(method: Any, state: np.ndarray, dt: float, scene: RayleighBenard, times: np.ndarray,
              look: Callable[[np.ndarray], Dots]) -> Iterator[Dots]:
    """What `look` sees at `times`: a run from each to the next, with steps of at most `dt` that divide the time between."""
    between = (times[1] - times[0])*scene.L/scene.free_fall
    steps = int(np.ceil(between/dt))
    for number in range(len(times)):
        if number:
            state = run(method, state, Plan(dt=between/steps, steps=steps)).by_id()
        yield look(state)
