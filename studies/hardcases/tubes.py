"""Sod's shock tube by the grid, by fixed and by moving points.

The tube and its mirror image of `sod`, in a periodic strip; the grid has one tube between plates, which its
waves do not reach. One spacing, in both gases: the thin one has points of less mass. No method has artificial
viscosity.

Viscosities in units of spacing and density 1, eta = k, chosen beforehand and for all methods alike: nothing;
what makes the contact's velocity a cell number of 2 behind the shock, v a/nu, beyond which central
differences are expected to ring; and the one that smooth particles were given. nu/(c a) of the dense gas is
0, 0.11 and 0.42. Steps are half of the limit at the start, since v + c behind the shock is 1.85 times c of
the dense gas; a quarter of this step tells the scheme's end from the step's.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.riemann import middle
from continuum.fluid import ConstEta
from continuum.gas.fields import NodeFields, Values, block, nodes, unblock
from continuum.gas.loop import FluxForm
from continuum.gas.solve import DivergedError, March, limits
from particles.fields import Fields
from particles.run import Divergence, Plan, run
from studies.build import ready
from studies.build.scenes import Scene, Slab, Start
from studies.hardcases.sod import DENSE, END, EOS, GAMMA, HEIGHT, NAMES, THIN, errors, exact, wiggles
from studies.hardcases.sod import grid as fine_grid
from studies.kit.case import Case, Outcome, Report

PARTS = 16              # of a point, over which it is spread when it is put into cells
BETWEEN = middle(DENSE, THIN, GAMMA)
CELL_NUMBER = 2.0
BARELY = round(BETWEEN.v*BETWEEN.right/CELL_NUMBER, 3)      # 0.123
ETAS = (0.0, BARELY, 0.5)
STEPS = (0.5, 0.125)                        # over the limit at the start
FINE = "fine grid"                          # what a fluid as viscous does
assert END*BETWEEN.v < 1        # the contact stays in its half of the tube


class Seen(NamedTuple):
    """rho, v, P (3, n) in cells of one spacing; rms v across the tube; part of the time reached."""
    fields: np.ndarray
    across: float
    reached: float = 1.0


def ended(L: int, reached: float) -> Seen:
    """Nothing but when."""
    return Seen(np.full((3, 2*L), np.nan), np.nan, reached)


def binned(L: int, at: Fields) -> np.ndarray:
    """rho, v, P (3, 2 L) in cells, of points by volume; means over the height and both tubes.

    A point is as wide as its volume and one spacing high: where the gas is thin rows of points lie farther
    apart than cells.
    """
    m, offsets = at.rho*at.V, (np.arange(PARTS) + 0.5)/PARTS - 0.5
    places = (at.x[:, 0] + at.V*offsets[:, None]).ravel()
    cell, side = np.minimum(np.abs(places).astype(int), 2*L - 1), np.sign(places)
    volume, mass, heat = (np.bincount(cell, np.tile(q, PARTS), 2*L) for q in (at.V, m, m*at.T))
    p = np.bincount(cell, side*np.tile(m*at.v[:, 0], PARTS), 2*L)
    with np.errstate(all="ignore"):
        return np.array([mass/volume, p/mass, heat/volume])


# --- points ---------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Tubes(Scene):
    """Both tubes. half : the length of one."""
    half: int
    law: ConstEta
    eos: Any = EOS
    L: float = HEIGHT

    @property
    def width(self) -> float:  # type: ignore[override]
        return 4.0*self.half

    def fields(self, x: np.ndarray) -> Start:
        dense = np.abs(x[:, 0]) < self.half
        rho, P = (np.where(dense, one, other) for one, other in zip((DENSE.rho, DENSE.P), (THIN.rho, THIN.P), strict=True))
        return rho, np.zeros((len(x), 2)), P/rho


def points(L: int, law: ConstEta, seed: int, step: float, report: Report, name: str) -> Seen:
    """Fixed or moving points; step : over the limit of the start."""
    tubes = ready(Tubes(half=L, law=law), name, seed)
    steps = int(END*L/(step*tubes.limit)) + 1
    try:
        end = run(tubes.method, tubes.start, Plan(dt=END*L/steps, steps=steps), report).by_id()
    except Divergence as error:
        return ended(L, error.step/steps)
    at = tubes.method.fields(end)
    m = at.rho*at.V
    return Seen(binned(L, at), float(np.sqrt(m@at.v[:, 1]**2/m.sum())))


# --- the grid -------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Upright(Slab):
    """One tube without gravity, |y| < L/2, dense below; plates are as warm as the gas at them."""
    eos: Any = EOS
    T_hot: float = DENSE.P/DENSE.rho
    T_cold: float = THIN.P/THIN.rho

    @property
    def g(self) -> float:
        return 0.0


def grid(L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """The compressible grid as it is, cells of one spacing; it has no disorder, so that `seed` says nothing.
    """
    scene = Upright(L=float(2*L), aspect=2/L, viscosity=law.eta, heat=law.k)
    S = block(upright(scene, L))
    steps = int(END*L/(step*limits(scene, S).both)) + 1
    march = March(scene, S, FluxForm(), END*L/steps)
    try:
        march.go(steps)
    except DivergedError:
        return ended(L, march.steps/steps)
    done = unblock(scene, march.S)
    v, T = ((q[1:] + q[:-1])[:, :-1].mean(axis=1)/2 for q in (done.at.vy, done.at.T))
    rho = done.cells.mean(axis=1)
    return Seen(np.array([rho, v, rho*T]), float(np.sqrt((done.at.vx**2).mean())))


def upright(scene: Upright, L: int) -> NodeFields:
    """The grid's start; the node on the diaphragm has the mean temperature."""
    x, y = nodes(scene, 2*L)
    rows = np.where(y < 0, scene.T_hot, np.where(y > 0, scene.T_cold, scene.T_mean))
    T = np.repeat(rows[:, None], len(x), axis=1)
    cells = np.where(np.arange(2*L) < L, DENSE.rho, THIN.rho)
    values = Values(0*T, 0*T, EOS.cv*T, T, np.ones_like(T))
    return NodeFields(scene, x, y, values, np.repeat(cells[:, None], len(x) - 1, axis=1))


METHODS: dict[str, Callable[[int, ConstEta, int, float, Report], Seen]] = {
    "grid": grid,
    "fixed lattice": partial(points, name="fixed-lattice"),
    "fixed jittered": partial(points, name="fixed-jittered-delaunay"),
    "moving": partial(points, name="moving")}


# --- the case -------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class MethodTube(Case):
    """One tube. L : half of its length, spacings. eta : viscosity and conductivity. step : over the limit at
    the start.

    keep : whether profiles go to the table.
    """
    method: str
    L: int
    eta: float
    seed: int = 1
    step: float = STEPS[0]
    keep: bool = False

    @property
    def cost(self) -> float:
        return {"moving": 1e-3}.get(self.method, 1e-4)*self.L**2/self.step + 1

    @property
    def label(self) -> str:
        return f"tube of {self.method}, L {self.L}, eta {self.eta:g}, seed {self.seed}, step {self.step:g}"

    @property
    def point(self) -> dict[str, Any]:
        """Key columns."""
        return {"method": self.method, "eta": self.eta, "step": self.step, "L": self.L, "seed": self.seed}

    def run(self, report: Report, folder: Path) -> Outcome:
        seen, x = self._seen(report), centres(self.L)
        truth = exact(self.L, x)
        twin = viscous(self.L, self.eta) if seen.reached == 1 else np.full_like(truth, np.nan)
        row = {**self.point, **errors(seen.fields, truth, twin), "wiggles": wiggles(seen.fields[1], truth[1]),
               "noise": seen.across/BETWEEN.v, "reached": seen.reached}
        profiles = [{**self.point, "x": at/self.L - 1, **dict(zip(NAMES, values, strict=True))}
                    for at, values in zip(x, seen.fields.T, strict=True)]
        return Outcome({"method_tubes": [row], "method_tube_profiles": profiles if self.keep and seen.reached == 1 else []})

    def _seen(self, report: Report) -> Seen:
        if self.method == FINE:
            return Seen(viscous(self.L, self.eta), 0.0)
        return METHODS[self.method](self.L, ConstEta(self.eta, self.eta), self.seed, self.step, report)


def centres(L: int) -> np.ndarray:
    """(2 L,) of cells of one spacing."""
    return np.arange(2*L) + 0.5


@cache
def viscous(L: int, eta: float) -> np.ndarray:
    """(3, 2 L): the fine grid's fields."""
    return fine_grid(L, ConstEta(eta, eta), centres(L)) if eta else np.full((3, 2*L), np.nan)
