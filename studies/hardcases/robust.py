"""What a flux that survives takes, and what it costs smooth flows: Riemann problems, and pairs of methods.

A gas on the left of the middle meets another one on its right, without viscosity, in a strip so long that
what comes round does not reach the quarter of it that is looked at. Cells are those of Toro's unit of length.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.riemann import GasState, solution
from continuum.fluid import ConstEta
from particles.fields import Fields, kinetic_energy
from particles.integral.positive import switched
from particles.run import Divergence, Plan, run
from studies.build import SCENES, ready, variant
from studies.build.answers import answer, duration
from studies.build.scenes import Scene, Start
from studies.hardcases.survival import followed
from studies.hardcases.tubes import DENSE, EOS, GAMMA, HEIGHT, NAMES, THIN, wiggles
from studies.kit.case import Case, Outcome, Report

PAIRS = {name: f"{name}-entropy-stable"
         for name in ("fixed-lattice", "fixed-jittered-delaunay", "moving-delaunay")}
PLAIN, STABLE = tuple(PAIRS), tuple(PAIRS.values())
SAMPLES = 30
ROOMY = 2*HEIGHT        # where gases part, points that move are three spacings apart, and reach half of that
#: scene, numbers of rows, which pairs; convection of fixed irregular points would take a quarter of an hour
SMOOTH = (("rayleigh-benard", (48,), PLAIN[:1]), ("rayleigh-benard", (25,), PLAIN[2:]),
          ("taylor-green", (32, 64), PLAIN), ("sound", (32,), PLAIN))


class Problem(NamedTuple):
    """Both gases, and when they are looked at; waves have then gone half a unit at most."""
    left: GasState
    right: GasState
    time: float


#: Toro's have two digits of their time; a vacuum of a millionth; cold gases that meet at Mach 27
PROBLEMS = {
    "Sod": Problem(DENSE, THIN, 0.2),
    "Toro 1": Problem(GasState(1.0, 0.75, 1.0), GasState(0.125, 0.0, 0.1), 0.2),
    "Toro 2": Problem(GasState(1.0, -2.0, 0.4), GasState(1.0, 2.0, 0.4), 0.15),
    "Toro 3": Problem(GasState(1.0, 0.0, 1000.0), GasState(1.0, 0.0, 0.01), 0.012),
    "Toro 4": Problem(GasState(5.99924, 19.5975, 460.894), GasState(5.99242, -6.19633, 46.095), 0.035),
    "Toro 5": Problem(GasState(1.0, -19.59745, 1000.0), GasState(1.0, -19.59745, 0.01), 0.012),
    "vacuum 1e-6": Problem(GasState(1.0, 0.0, 1.0), GasState(1e-6, 0.0, 1e-6), 0.08),
    "collision": Problem(GasState(1.0, 1.0, 1e-3), GasState(1.0, -1.0, 1e-3), 0.4),
}


@dataclass(frozen=True, kw_only=True)
class Strip(Scene):
    """A problem in a strip of four units, the gases meet at x = 0."""
    problem: Problem
    cells: int
    eos: Any = EOS
    law: ConstEta = ConstEta(0.0, 0.0)  # noqa: RUF009 (immutable)
    L: float = HEIGHT

    @property
    def width(self) -> float:  # type: ignore[override]
        return 4.0*self.cells

    def fields(self, x: np.ndarray) -> Start:
        rho, v, P = np.where(x[:, 0] < 0, *(np.array(gas)[:, None] for gas in self.problem[:2]))
        return rho, np.stack([v, 0*v], axis=1), P/rho


@dataclass(frozen=True, kw_only=True)
class Riemann(Case):
    """One problem by one method, so many spacings to the unit; rows : of points across the strip."""
    method: str
    problem: str
    cells: int
    seed: int = 1
    rows: float = HEIGHT

    def run(self, report: Report, folder: Path) -> Outcome:
        strip, key = Strip(problem=PROBLEMS[self.problem], cells=self.cells, L=self.rows), vars(self)
        method, start, dt = variant(self.method).ready(strip, self.seed)
        left, right, time = strip.problem
        steps, share = ceil(time*self.cells/dt), []
        row = {name: key[name] for name in ("method", "problem", "cells", "seed")} | {"reached": 1.0}

        def count(sums: Any, state: np.ndarray) -> float:
            share.append(switched(sums, state))
            row.update(switched=np.mean(share), halved=sums.refused, limited=sums.limited)
            return share[-1]
        try:
            done = run(method, start, Plan(dt=time*self.cells/steps, steps=steps, series={"switched": count},
                                           every=1), report)
        except Divergence as error:
            return Outcome({"riemann": [row | {"reached": error.step/steps}]})
        at = method.fields(done.state)
        x, fields = at.x[:, 0]/self.cells, np.array([at.rho, at.v[:, 0], at.rho*at.T])
        seen, exact = np.abs(x) < 0.5, solution(left, right, GAMMA, x/time)
        V, errors = at.V[seen], np.abs(fields - exact)[:, seen]
        order = np.argsort(x[seen], kind="stable")
        row |= dict(zip((f"{name}_exact" for name in NAMES), errors@V/V.sum()/np.ptp(exact[:, seen], axis=1)))
        level = (fields[1][seen][order], exact[1][seen][order])
        rows = int(self.rows)
        mean = [q[:len(q)//rows*rows].reshape(-1, rows).mean(axis=1) for q in level]
        return Outcome({"riemann": [row | {"wiggles": wiggles(*mean)}]})


@dataclass(frozen=True, kw_only=True)
class SmoothFlow(Case):
    """K of convection at Ra 10 000, else the rms error of velocities over the fastest of the start."""
    method: str
    scene: str
    rows: int

    @property
    def cost(self) -> float:
        return 2e-3*self.rows**3

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = SCENES[self.scene](self.rows)
        made, (times, unit) = ready(scene, self.method), duration(scene)
        known = answer(scene, made.method.x)
        fastest = max(np.abs(known[name]).max() for name in ("vx", "vy") if name in known) if known else 1.0

        def look(at: Fields) -> float:
            if not known:
                return kinetic_energy(at)
            there = answer(scene, at.x)
            exact = np.stack([there.get(name, np.zeros(len(at.x))) for name in ("vx", "vy")], axis=1)
            return float(np.sqrt(((at.v - exact)**2).mean())/fastest)
        value = followed(made, times*unit, SAMPLES, look, report).seen[-1]
        return Outcome({"smooth_flows": [{"scene": self.scene, "method": self.method, "rows": self.rows,
                                          "value": value}]})


def cases() -> Iterator[Case]:
    """Several sizes of Sod's tube, several starts of points that lie as a seed says."""
    for method, problem in product(STABLE, PROBLEMS):
        for cells in {"Sod": (50, 100, 200)}.get(problem, (100,)):
            for seed in range(1, 4 if "lattice" not in method and cells == 100 else 2):
                yield Riemann(method=method, problem=problem, cells=cells, seed=seed,
                              rows=ROOMY if method == STABLE[2] else HEIGHT)
    for scene, rows, names in SMOOTH:
        for count, name in product(rows, names):
            yield from (SmoothFlow(method=method, scene=scene, rows=count) for method in (name, PAIRS[name]))
