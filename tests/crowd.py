"""Small crowds of particles and points: made, evaluated and advanced without the time loop of runs."""
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from continuum.fluid import IdealGas, energy
from particles.integrators import RK4
from particles.run import Plan, run
from particles.smooth.spam import Spam
from particles.threads import Threads
from particles.walls.periodic import periodic


def lattice(box, columns: int, rows: int) -> np.ndarray:
    """(2, n) centres of a lattice that fills the box."""
    x, y = np.meshgrid((np.arange(columns) + 0.5)/columns - 0.5, (np.arange(rows) + 0.5)/rows - 0.5)
    return np.array([x.ravel()*box[0], y.ravel()*box[1]])


def crowd(box, columns: int, rows: int, eos=IdealGas(), jitter=0.25, seed=0) -> np.ndarray:  # noqa: B008
    """A lattice shaken by +-jitter, v of 0.3 and T of 0.8 to 1.2 at random: state (5, n)."""
    rng, n = np.random.default_rng(seed), columns*rows
    r = lattice(box, columns, rows) + rng.uniform(-jitter, jitter, (2, n))
    return np.array([*r, *rng.normal(0, 0.3, (2, n)), energy(eos, 1.0, rng.uniform(0.8, 1.2, n))])


def everywhere(box) -> tuple:
    """Walls of a box that is periodic in x and y."""
    return periodic(box[0]) + periodic(box[1], axis=1)


def goes_on_bitwise(method, state: np.ndarray, dt: float, folder: Path) -> None:
    """60 steps that are interrupted at the second report go on, with two threads, as those that are not."""
    whole, seen = run(method, state, Plan(dt=dt, steps=60)), []

    def stop(done):
        seen.append(done)
        if len(seen) == 2:
            raise KeyboardInterrupt
    plan = Plan(dt=dt, steps=60, checkpoint=folder/"run.h5")
    with pytest.raises(KeyboardInterrupt):
        run(method, state, plan, stop)
    again = run(method, state, replace(plan, threads=2))
    assert again.step == 60 and np.array_equal(whole.by_id(), again.by_id())


def random_fields(n: int, d: int = 2, seed: int = 0) -> tuple:
    """Densities and temperatures of 0.9 to 1.1, velocities (n, d) of 0.2."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.9, 1.1, n), rng.normal(0, 0.2, (n, d)), rng.uniform(0.9, 1.1, n)


def alike(found, expected, within: float = 1e-12) -> None:
    """Rows differ by round-off, relative to the largest value of each."""
    for one, other in zip(found, expected, strict=True):
        assert np.abs(one - other).max() < within*np.abs(other).max()


def prepare(method, state: np.ndarray, threads: int = 1):
    """The method's sums with lists, or itself where it needs none, the state in the order of their cells, and
    which particle is where."""
    n, alone = state.shape[1], not hasattr(method, "start")
    state, ids, sums = state.copy(), np.arange(n), method if alone else method.start(n, Threads(threads))
    if hasattr(sums, "around"):
        sums.around.relist(state, ids, 0.0)
    return sums, state, ids


def jacobian(f, x: np.ndarray, step: float) -> np.ndarray:
    """df/dx by central differences."""
    kicks = step*np.eye(x.size).reshape(-1, *x.shape)
    return np.array([(f(x + kick) - f(x - kick)).ravel()/(2*step) for kick in kicks]).T


def rates(method, state: np.ndarray, threads: int = 1) -> np.ndarray:
    """d(state)/dt in the order of the state."""
    sums, ordered, ids = prepare(method, state, threads)
    out = np.full_like(ordered, np.nan)
    sums.rates(ordered, out)
    return out[:, np.argsort(ids)]


def advance(method: Spam, state: np.ndarray, dt: float, steps: int, threads: int = 1) -> np.ndarray:
    """The state after some steps of RK4, without reflections, in the order in which it was given."""
    sums, now, ids = prepare(method, state, threads)
    integrator = RK4(now.shape, sums.threads)
    for _ in range(steps):
        if sums.around.must_relist(now, dt):
            sums.around.relist(now, ids, dt)
        integrator.step(sums, now, dt)
    return now[:, np.argsort(ids)]
