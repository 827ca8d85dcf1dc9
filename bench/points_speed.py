"""How fast are points: an evaluation over stored edges or over pairs, of smooth particles, a step over faces.

    python -m bench.points_speed

One core, CPU time, 20 000 points between plates in the developing rolls of the start, unless a row says
otherwise; the kinds take turns. Rows are medians and quartiles over the repeats. Writes
results/bench/points_speed.csv; takes five minutes, on a quiet machine.
"""
import time
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pandas as pd

from bench.spam_speed import COLUMNS, time_row
from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import steady
from particles.integral.carried import complete, follow, read, stage
from particles.integral.layer import LayerSums
from particles.integral.rings import geometry
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Threads
from studies.build import ready
from studies.build.rapid import ShockTube
from studies.build.spam import TODAY
from studies.kit.csvfile import commit, cpu, now, versions, write
from studies.kit.key import ROOT

FILE = ROOT/"results"/"bench"/"points_speed.csv"
SCENE = RayleighBenard(ra=1e4, L=100.0)
#: nanoseconds per point and evaluation, by row of the table
GOALS = {"spam": 185, "spam-sumB": 350}
TUBE = ShockTube(half=50, eta=0.0, L=100.0)
REPEATS, EVALUATIONS, STEPS, AHEAD, FORMED = 21, 10, 12, 100, 1000
LATTICE, DELAUNAY, MOVING = (f"{kind}-entropy-stable" for kind in ("fixed-lattice", "fixed-jittered-delaunay",
                                                                 "moving-delaunay"))


def called(n: int, loop: Callable, *arguments: Any) -> Callable[[], float]:
    """A measurement of a loop over n points, in nanoseconds per point."""
    def measure() -> float:
        began = time.process_time()
        for _ in range(EVALUATIONS):
            loop(*arguments)
        return 1e9*(time.process_time() - began)/(EVALUATIONS*n)
    return measure


def fixed(name: str, fast: bool = True) -> Callable[[], float]:
    """A measurement of one evaluation of a scheme on fixed points."""
    method, state, _ = ready(SCENE, name)
    method, n = replace(method, form=None if fast else LayerSums), state.shape[1]
    return called(n, method.start(n, Threads(1)).rates, state, np.empty_like(state))


def entropy_stable(name: str, noise: float = 0.0) -> Callable[[], float]:
    """A measurement of one evaluation in Sod's tube after AHEAD steps, or in noise: every edge dissipates."""
    method, state, dt = ready(TUBE, name)
    n = state.shape[1]
    if noise:
        rho, T = np.exp(noise*np.random.default_rng(1).normal(size=(2, n)))
        state = method.state(rho, np.zeros((n, 2)), T)
    else:
        state = run(method, state, Plan(dt=dt, steps=AHEAD)).state
    return called(n, method.start(n, Threads(1)).rates, state, np.empty_like(state))


@cache
def rolls() -> Any:
    """The spectral method's steady flow."""
    return steady(GasLaws(SCENE), 20)


def in_rolls(name: str) -> Callable[[], float]:
    """A measurement of one evaluation in steady rolls: FORMED steps after those of the spectral method."""
    method, _, dt = ready(SCENE, name)
    u, v, rho, T = rolls().fields(method.x/SCENE.L)
    state = method.state(1 + rho, np.stack([u, v], axis=1), SCENE.T(method.x[:, 1]) + T)
    state, n = run(method, state, Plan(dt=dt, steps=FORMED)).state, len(rho)
    return called(n, method.start(n, Threads(1)).rates, state, np.empty_like(state))


def parts_of_a_step(ahead: int = 30) -> dict[str, Callable[[], float]]:
    """Measurements of the loops of a step of `moving-delaunay`; `read` and `stage` run four times a step."""
    method, y, dt = ready(SCENE, "moving-delaunay")
    n, one = y.shape[1], Threads(1)
    sums = method.start(n, one)
    sums.march(y, dt, ahead)
    fluid, rings, bench = sums.fluid, sums.rings, sums.bench
    geometry_of = (0, n, y[:2], rings, bench.V, bench.pull, bench.spread, bench.crossed)
    return {"moving delaunay: edges, volumes": called(n, geometry, *geometry_of),
            "moving delaunay: strain, stress of triangles": called(n, follow, one, n, fluid, rings, bench),
            "moving delaunay: stress of triangles again": called(n, complete, one, n, 1.0, rings, bench),
            "moving delaunay: fields, four times": called(n, read, one, n, y, fluid.eos, fluid.law,
                                                          bench.points),
            "moving delaunay: exchange, four times": called(n, stage, one, n, 0.0, 1.0, fluid, rings.edges,
                                                            bench, y)}


def step(method: Any, first: np.ndarray, evaluations: int = 1, ahead: int = 30) -> Callable[[], float]:
    """A measurement of whole steps, in nanoseconds per point and evaluation, lists and faces included.

    It is the difference of two lengths of a run, from a state some steps ahead of the start.
    """
    dt = 0.8*limit_of(method, first)
    warm = run(method, first, Plan(dt=dt, steps=ahead)).state

    def seconds(steps: int) -> float:
        began = time.process_time()
        run(method, warm, Plan(dt=dt, steps=steps))
        return time.process_time() - began

    def measure() -> float:
        return 1e9*(seconds(2*STEPS) - seconds(STEPS))/(STEPS*evaluations*first.shape[1])
    return measure


def closed(name: str) -> Callable[[], float]:
    """A measurement of a step of three evaluations over faces that are made once a step."""
    return step(*ready(SCENE, name)[:2])


def bracket(name: str) -> Callable[[], float]:
    """A measurement of one evaluation of RR98's motions or smooth particles: pairs in range, fields, sums."""
    method, state, _ = ready(SCENE, name)
    n = state.shape[1]
    sums = method.start(n, Threads(1))
    sums.around.relist(state, np.arange(n), 0.0)
    return called(n, sums.rates, state, np.empty_like(state))


def marched(name: str, **changes: Any) -> Callable[[], float]:
    """A measurement of one evaluation within a run: lists and step limits included."""
    method, state, _ = ready(SCENE, name)
    return step(replace(method, **changes), state, RK4.evaluations)


def kinds() -> dict[str, Callable[[], float]]:
    """Measurements by row of the table."""
    return {"fixed points, h = 2 a": fixed("fixed-lattice"),
            "fixed points, h = 3 a": fixed("fixed-lattice-h3"),
            "fixed points, h = 3 a, edge by edge": fixed("fixed-lattice-h3", fast=False),
            "fixed points, Delaunay": fixed("fixed-jittered-delaunay"),
            "fixed points, h = 2 a, edge by edge": fixed("fixed-lattice", fast=False),
            "fixed points, Delaunay, edge by edge": fixed("fixed-jittered-delaunay", fast=False),
            "fixed points, h = 2 a, edge by edge, in steps": marched("fixed-lattice", form=LayerSums),
            "fixed points, Delaunay, edge by edge, in steps": marched("fixed-jittered-delaunay",
                                                                      form=LayerSums),
            "lattice, entropy-stable, in steps": marched(LATTICE),
            "Delaunay, entropy-stable, in steps": marched(DELAUNAY),
            "lattice, entropy-stable": fixed(LATTICE),
            "lattice, entropy-stable, steady rolls": in_rolls(LATTICE),
            "lattice, entropy-stable, Sod's tube": entropy_stable(LATTICE),
            "lattice, entropy-stable, noise": entropy_stable(LATTICE, 0.3),
            "Delaunay, entropy-stable": fixed(DELAUNAY),
            "Delaunay, entropy-stable, steady rolls": in_rolls(DELAUNAY),
            "Delaunay, entropy-stable, Sod's tube": entropy_stable(DELAUNAY),
            "Delaunay, entropy-stable, noise": entropy_stable(DELAUNAY, 0.3),
            "moving points, a step": closed("moving"),
            "moving points, a step, open faces": closed("moving-open-faces"),
            "moving delaunay, a step": step(*ready(SCENE, "moving-delaunay")[:2], ahead=0),
            "moving delaunay, entropy-stable, a step": step(*ready(SCENE, MOVING)[:2], ahead=0),
            "moving delaunay, entropy-stable, Sod's tube, a step": step(*ready(TUBE, MOVING)[:2], ahead=0),
            **parts_of_a_step(),
            "moving, plain bracket": bracket("moving-literal-printed-heat"),
            "moving, plain bracket, mended": bracket("moving-literal"),
            "moving, plain bracket, constant mass": bracket("moving-constant-mass-printed-heat"),
            "moving, plain bracket, with lists and steps": marched("moving-literal-printed-heat"),
            **{name: bracket(name) for name in ("spam", *(f"spam-{maker}" for maker in TODAY))}}


def main() -> None:
    """Measure, print, and write the table."""
    timed = kinds()
    found: dict[str, list[float]] = {name: [] for name in timed}
    for measure in timed.values():
        measure()       # loads what is compiled
    for _ in range(REPEATS):
        for name, measure in timed.items():
            found[name].append(measure())
    points = round(SCENE.width*SCENE.L)
    rows = [time_row(name, points, 1, values) for name, values in found.items()]
    for row in rows:
        print(f"{row['what']:52s} {row['ns_per_particle_evaluation']:8.1f} ns  ({row['q25']:.1f} to "
              f"{row['q75']:.1f})")
    for name, most in GOALS.items():
        median = float(np.median(found[name]))
        print(f"{'met' if median <= most else 'NOT MET':8s}{name} within {most} ns: {median:.4g} ns")
    FILE.parent.mkdir(parents=True, exist_ok=True)
    table = pd.DataFrame(rows, columns=COLUMNS).assign(cpu=cpu(), versions=versions(), date=now(),
                                                       commit=commit())
    write(FILE, table, head=["python -m bench.points_speed"])


if __name__ == "__main__":
    main()
