"""What a flux that survives takes, and what it costs smooth flows: Riemann problems, and pairs of methods.

A gas on the left of the middle meets another one on its right, without viscosity, in a strip of four units;
where it closes one gas goes over into the other along a line. What comes from there does not reach the
quarter of the strip that is looked at. Cells are those of Toro's unit of length.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from continuum.exact.riemann import GasState, middle, solution
from continuum.fluid import ConstEta
from particles.fields import Fields, kinetic_energy
from studies.build import SCENES, ready
from studies.build.answers import answer, duration
from studies.build.scenes import Scene, Start
from studies.hardcases.printed import SHIFT, jittered
from studies.hardcases.survival import followed
from studies.hardcases.tubes import DENSE, EOS, GAMMA, HEIGHT, NAMES, THIN, wiggles
from studies.kit.case import Case, Outcome, Report

#: methods that have the ingredient, too
EDGES = ("fixed-lattice", "fixed-jittered-delaunay", "moving-delaunay")
PAIRS = {name: f"{name}-entropy-stable" for name in EDGES}
STABLE = tuple(PAIRS.values())
BLENDED = f"{STABLE[0]}-blended"
#: points on plates, or on a body
HELD = "fixed-jittered-plates-entropy-stable"
SAMPLES = 30
#: scene, numbers of rows, which of them; convection of fixed irregular points would take a quarter of an hour
SMOOTH = (("rayleigh-benard", (48,), EDGES[:1]), ("rayleigh-benard", (25,), EDGES[2:]),
          ("taylor-green", (32, 64), EDGES), ("sound", (32,), EDGES))
WINDOW, EVEN, CLOSED = 0.5, 1.8, 2.0        # units from the middle: what is seen, where gases end, the strip
ROOMY = 2*HEIGHT        # where gases part, points that move are three spacings apart, and reach half of that


class Problem(NamedTuple):
    """Both gases, and when they are looked at; waves have then gone half a unit at most."""
    left: GasState
    right: GasState
    time: float


def collision(mach: float) -> Problem:
    """Gases that meet and come to rest behind shocks of a Mach number, which are then 0.25 units away."""
    c = GAMMA**0.5
    v = 2*c/(GAMMA + 1)*(mach - 1/mach)
    return Problem(GasState(1.0, v, 1.0), GasState(1.0, -v, 1.0), 0.25/(mach*c - v))


#: Toro's have two digits of their time; a vacuum of a millionth
PROBLEMS = {
    "Sod": Problem(DENSE, THIN, 0.2),
    "Toro 1": Problem(GasState(1.0, 0.75, 1.0), GasState(0.125, 0.0, 0.1), 0.2),
    "Toro 2": Problem(GasState(1.0, -2.0, 0.4), GasState(1.0, 2.0, 0.4), 0.15),
    "Toro 3": Problem(GasState(1.0, 0.0, 1000.0), GasState(1.0, 0.0, 0.01), 0.012),
    "Toro 4": Problem(GasState(5.99924, 19.5975, 460.894), GasState(5.99242, -6.19633, 46.095), 0.035),
    "Toro 5": Problem(GasState(1.0, -19.59745, 1000.0), GasState(1.0, -19.59745, 0.01), 0.012),
    "vacuum 1e-6": Problem(GasState(1.0, 0.0, 1.0), GasState(1e-6, 0.0, 1e-6), 0.08),
    "Mach 10": collision(10.0),
    "Mach 100": collision(100.0),
}


@dataclass(frozen=True, kw_only=True)
class Strip(Scene):
    """A problem in a strip of four units, the gases meet at x = 0; densities over that of the left gas."""
    problem: Problem
    cells: int
    eos: object = EOS
    law: ConstEta = ConstEta(0.0, 0.0)  # noqa: RUF009 (immutable)
    L: float = HEIGHT

    counted = "cells"

    @property
    def width(self) -> float:  # type: ignore[override]
        return 2*CLOSED*self.cells

    @property
    def time(self) -> float:
        return self.problem.time*self.cells

    @property
    def fastest(self) -> float:
        """Speed and sound's of the gas, and of what is between the waves."""
        left, right, _ = self.problem
        v, P, *densities = middle(left, right, GAMMA)
        states = (left, right, *(GasState(rho, v, P) for rho in densities))
        return max(abs(gas.v) + (GAMMA*gas.P/gas.rho)**0.5 for gas in states)

    def gases(self, x: np.ndarray) -> np.ndarray:
        """rho, v, P (3, n)."""
        left, right = (np.array(gas)[:, None] for gas in self.problem[:2])
        over = np.clip((np.abs(x)/self.cells - EVEN)/(CLOSED - EVEN), 0, 1)/2
        own, other = np.where(x < 0, left, right), np.where(x < 0, right, left)
        return (own + over*(other - own))/np.array([[left[0, 0]], [1.0], [left[0, 0]]])

    def fields(self, x: np.ndarray) -> Start:
        rho, v, P = self.gases(x[:, 0])
        return rho, np.stack([v, 0*v], axis=1), P/rho

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        """Columns and rows as far apart in each gas as its density wants them, of which one may have none."""
        rng, parts = np.random.default_rng(seed), []
        for gas, left in ((self.problem.left, -CLOSED), (self.problem.right, 0.0)):
            number = 2*self.cells*HEIGHT*gas.rho/self.problem.left.rho
            rows = max(1, round((number*HEIGHT/2/self.cells)**0.5))
            counts = round(number/rows), rows
            cell = 2*self.cells/max(counts[0], 1), HEIGHT/rows
            parts.append(jittered(counts, cell, (left*self.cells, -HEIGHT/2), SHIFT, rng).T)
        x = np.concatenate(parts)
        return x, self.fields(x)

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """The farthest of mean differences of density, velocity and pressure, over their ranges, in spacings;
        these three; variation of v; how far what is between the waves is off."""
        left, right, time = self.problem
        here = np.abs(at.x[:, 0]) < WINDOW*self.cells
        x, V = at.x[here, 0], at.V[here]
        exact = solution(left, right, GAMMA, x/self.cells/time)
        has = np.array([at.rho*left.rho, at.v[:, 0], at.rho*at.T*left.rho])[:, here]
        errors = np.abs(has - exact)@V/V.sum()/np.ptp(exact, axis=1)
        order = np.argsort(x, kind="stable")
        rows = int(self.L)
        level = [q[order][:len(x)//rows*rows].reshape(-1, rows).mean(axis=1) for q in (has[1], exact[1])]
        between = middle(left, right, GAMMA)
        flat = [np.isclose(exact[0], rho) & np.isclose(exact[2], between.P) for rho in between[2:]]
        off = [np.median(q[side])/q_exact[side][0] - 1 for q, q_exact in zip(has[::2], exact[::2])
               for side in flat if side.any()]
        return {"measured": float(errors.max()*self.cells), "wiggles": wiggles(*level),
                "plateau": float(np.abs(off).max(initial=0)),
                **dict(zip((f"{name}_exact" for name in NAMES), map(float, errors)))}


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
    """Pairs in smooth flows; both pressures."""
    for scene, rows, names in SMOOTH:
        for count, name in product(rows, names):
            yield from (SmoothFlow(method=method, scene=scene, rows=count) for method in (name, PAIRS[name]))
    for count, name in product((16, 24), (STABLE[0], BLENDED)):
        yield SmoothFlow(method=name, scene="rayleigh-benard", rows=count)
