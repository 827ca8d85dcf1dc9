"""The run that benchmarks time: KHP95's gas at Ra = 10 000, in the time loop of `particles.run`."""
import math
import time
from collections.abc import Callable
from functools import cache

import numpy as np

from continuum.fluid import energy
from continuum.scene import RayleighBenard
from particles.run import Plan, run
from particles.smooth.spam import Spam
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import Lucy

H, DT = 3.0, 0.6    # range of the weight and time step of production, in KHP95's units (density 1)
EVALUATIONS = 4     # of the rates, in each step of RK4
BLOCK = 16          # steps between two calls of a run's progress


def method(particles: int) -> Spam:
    """SPAM between mirror plates, periodic in x, aspect 2; `particles` is rounded to 2 L^2."""
    scene = RayleighBenard(ra=10_000, L=round(math.sqrt(particles/2)))
    walls = (*periodic(scene.width), *plates(scene.L, scene.T_hot, scene.T_cold))
    return Spam(weight=Lucy.of(h=H), eos=scene.eos, law=scene.law, walls=walls, box=(scene.width, scene.L),
                g=scene.g)


def lattice(box: tuple[float, float]) -> np.ndarray:
    """State (5, n) on a jittered square lattice with rolls of twice the energy of steady convection.

    After the first turnover it moves as steady convection does: the fastest particle has 0.20 to 0.26.
    """
    width, height = box
    scene, rng = RayleighBenard(ra=10_000, L=height), np.random.default_rng(1)
    x, y = (q.ravel() for q in np.meshgrid(np.arange(width) + 0.5 - width/2,
                                           np.arange(height) + 0.5 - height/2))
    x, y = x + rng.uniform(-0.1, 0.1, x.size), y + rng.uniform(-0.1, 0.1, x.size)
    return np.array([x, y, *scene.flow(x, y, 0.0096), energy(scene.eos, 1.0, scene.T(y))])


@cache
def melted(particles: int, steps: int = 10*BLOCK) -> np.ndarray:
    """The lattice after some steps: disordered, with particles in the order of cells, as in any run."""
    case = method(particles)
    return run(case, lattice(case.box), Plan(dt=DT, steps=steps, every=steps)).state


def block_seconds(particles: int, blocks: int, *, threads: int = 1,
                  clock: Callable[[], float] = time.process_time,
                  between: Callable[[], None] = lambda: None) -> list[float]:
    """Seconds of each block of BLOCK steps; `between` is called after each block, untimed."""
    seconds: list[float] = []
    began = math.nan

    def lap(_):
        nonlocal began
        seconds.append(clock() - began)
        between()
        began = clock()

    steps = (blocks + 1)*BLOCK
    run(method(particles), melted(particles), Plan(dt=DT, steps=steps, every=steps + 1, threads=threads),
        progress=lap)
    return seconds[1:]      # the first holds the start


def per_evaluation(seconds: float, particles: int) -> float:
    """Nanoseconds per particle and evaluation, from the seconds of a block."""
    return 1e9*seconds/(BLOCK*EVALUATIONS*particles)
