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
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.riemann import middle
from continuum.fluid import ConstEta
from continuum.gas.fields import block, placed, unblock
from continuum.gas.solve import DivergedError, March, limits
from particles.fields import Fields
from particles.run import Divergence, Plan, run
from studies.build.scenes import Scene, Slab, Start
from studies.hardcases.sod import DENSE, END, EOS, GAMMA, HEIGHT, THIN, compared, exact, profiles, start, viscous
from studies.kit.case import Case, Outcome, Report

PARTS = 16              # of a point, over which it is spread when it is put into cells
BETWEEN = middle(DENSE, THIN, GAMMA)
CELL_NUMBER = 2.0
BARELY = round(BETWEEN.v*BETWEEN.right/CELL_NUMBER, 3)      # 0.123
ETAS = (0.0, BARELY, 0.5)
STEPS = (0.5, 0.125)                        # over the limit at the start
assert END*BETWEEN.v < 1        # the contact stays in its half of the tube


class Seen(NamedTuple):
    """rho, v, P (3, n) in cells of one spacing, None if the run ended before; part of the time reached."""
    fields: np.ndarray | None
    reached: float = 1.0


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
        rho, _, P = start(np.abs(x[:, 0]) < self.half)
        return rho, np.zeros((len(x), 2)), P/rho


def points(variant: Any, L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """Fixed or moving points of a variant; step : over the limit of the start."""
    tubes = variant.ready(Tubes(half=L, law=law), seed)
    steps = int(END*L/(step*tubes.limit)) + 1
    try:
        end = run(tubes.method, tubes.start, Plan(dt=END*L/steps, steps=steps), report).by_id()
    except Divergence as error:
        return Seen(None, error.step/steps)
    return Seen(binned(L, tubes.method.fields(end)))


def binned(L: int, at: Fields) -> np.ndarray:
    """rho, v, P (3, 2 L) in cells, of points by volume; means over the height and both tubes.

    A point is as wide as its volume and one spacing high: where the gas is thin rows of points lie farther
    apart than cells.
    """
    m, offsets = at.rho*at.V, (np.arange(PARTS) + 0.5)/PARTS - 0.5
    places = (at.x[:, 0] + at.V*offsets[:, None]).ravel()
    cell = np.minimum(np.abs(places).astype(int), 2*L - 1)

    def total(q: np.ndarray, sign: Any = 1.0) -> np.ndarray:
        return np.bincount(cell, sign*np.tile(q, PARTS), 2*L)
    volume, mass, heat = total(at.V), total(m), total(m*at.T)
    p = total(m*at.v[:, 0], np.sign(places))
    with np.errstate(all="ignore"):
        return np.array([mass/volume, p/mass, heat/volume])


@dataclass(frozen=True, kw_only=True)
class Upright(Slab):
    """One tube without gravity, |y| < L/2, dense below; plates are as warm as the gas at them."""
    eos: Any = EOS
    T_hot: float = DENSE.P/DENSE.rho
    T_cold: float = THIN.P/THIN.rho

    @property
    def g(self) -> float:
        return 0.0

    def begin(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """rho, v_x, v_y, T; a node on the diaphragm has the mean temperature."""
        T = np.select([y < 0, y > 0], [self.T_hot, self.T_cold], self.T_mean)
        return np.where(y < 0, DENSE.rho, THIN.rho), 0*T, 0*T, T


def grid(continuity: Any, L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """The compressible grid, cells of one spacing; it has no disorder, so that `seed` says nothing."""
    scene = Upright(L=float(2*L), aspect=2/L, viscosity=law.eta, heat=law.k)
    S = block(placed(scene, 2*L, scene.begin))
    steps = int(END*L/(step*limits(scene, S).both)) + 1
    march = March(scene, S, continuity, END*L/steps)
    try:
        march.go(steps)
    except DivergedError:
        return Seen(None, march.steps/steps)
    done = unblock(scene, march.S)
    v, T = ((q[1:] + q[:-1])[:, :-1].mean(axis=1)/2 for q in (done.at.vy, done.at.T))
    rho = done.cells.mean(axis=1)
    return Seen(np.array([rho, v, rho*T]))


def centres(L: int) -> np.ndarray:
    """(2 L,) of cells of one spacing."""
    return np.arange(2*L) + 0.5


@cache
def twin(L: int, eta: float) -> np.ndarray:
    """(3, 2 L): the fine grid's fields."""
    return viscous(L, eta, centres(L))


@dataclass(frozen=True, kw_only=True)
class MethodTube(Case):
    """One tube. L : half of its length, spacings. eta : viscosity and conductivity. step : over the limit at the start.

    tube : takes variant, L, law, seed, step, report. keep : whether profiles go to the table.
    """
    method: str
    tube: Callable[..., Seen]
    variant: Any
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

    def run(self, report: Report, folder: Path) -> Outcome:
        law, x = ConstEta(self.eta, self.eta), centres(self.L)
        fields, reached = self.tube(self.variant, self.L, law, self.seed, self.step, report)
        point = {"method": self.method, "eta": self.eta, "step": self.step, "L": self.L, "seed": self.seed}
        if fields is None:
            return Outcome({"method_tubes": [{**point, "reached": reached}]})
        errors = compared(fields, exact(self.L, x), twin(self.L, self.eta))
        row = {**point, **errors, "reached": reached}
        lines = profiles(point, x/self.L - 1, fields) if self.keep else []
        return Outcome({"method_tubes": [row], "method_tube_profiles": lines})
