"""Sod's shock tube by the grid, by points, and by smooth particles as printed; none has artificial viscosity.

A periodic strip holds the tube and its mirror image: dense at |x| < L, thin at L < |x| < 2 L, without walls;
the grid has one tube between plates, which its waves do not reach. Points and cells have one spacing in both
gases: thin ones have less mass. Smooth particles have one mass, so the thin gas has eight times fewer, and
one range, 3 mean spacings    [KHP95, Sec. II].

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
from particles.limits import step_limit
from particles.observe import fields_at
from particles.run import Divergence, Plan, run
from particles.smooth.spam import Spam
from studies.build.scenes import Scene, Slab, Start
from studies.build.spam import at_rest, fluid
from studies.hardcases.sod import DENSE, END, EOS, GAMMA, NAMES, THIN, compared, exact, start, viscous
from studies.kit.case import Case, Outcome, Report

HEIGHT = 9.0
MASS = 9/16                     # of smooth particles: the mean density is one a unit of area
ROWS = {DENSE: 12, THIN: 4}     # then columns are 0.75 and 2 apart, and fit if L is a multiple of 3
JITTER = 0.05                   # of the columns and rows: a perfect lattice keeps its rows in such a flow
SKIN = 1.5                      # of neighbour lists: at the diaphragm particles reach full speed in a step
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

    def look(state: np.ndarray) -> np.ndarray:
        return binned(L, tubes.method.fields(state))
    return ran(tubes.method, tubes.start, L, steps, look, report)


def ran(method: Any, begin: np.ndarray, L: int, steps: int, look: Callable, report: Report) -> Seen:
    """Particles or points; look(state) gives what is seen."""
    try:
        done = run(method, begin, Plan(dt=END*L/steps, steps=steps), report)
    except Divergence as error:
        return Seen(None, error.step/steps)
    return Seen(look(done.by_id()))


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


def smooth(weight: Any, L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """Smooth particles."""
    method, begin = fluid(weight.of(h=3.0), (4.0*L, HEIGHT), EOS, law, m=MASS, skin=SKIN), tube(L, seed)
    steps = round(END*L/(step*step_limit(method, begin[4]))) + 1
    return ran(method, begin, L, steps, lambda state: smoothed(method, state, centres(L)), report)


def jittered(counts: tuple[int, int], cell: tuple[float, float], corner: tuple[float, float], jitter: float,
             rng: np.random.Generator) -> np.ndarray:
    """x, y (2, n) in the middle of columns and rows of cells, shifted by up to `jitter` of a cell."""
    numbers = np.stack(np.meshgrid(*map(np.arange, counts)), axis=-1).reshape(-1, 2)
    shift = rng.uniform(-1, 1, (2, len(numbers))).T
    return ((numbers + 0.5)*cell + corner + jitter*np.array(cell)*shift).T


def within(x: np.ndarray, size: float) -> np.ndarray:
    """Places in a periodic interval about 0."""
    return (x + size/2) % size - size/2


def tube(L: float, seed: int) -> np.ndarray:
    """State (5, n) at the start."""
    rng, gases = np.random.default_rng(seed), []
    for gas, left in ((DENSE, -L), (THIN, L)):
        counts = round(2*L*HEIGHT*gas.rho/MASS/ROWS[gas]), ROWS[gas]
        cell = 2*L/counts[0], HEIGHT/counts[1]
        x, y = jittered(counts, cell, (left, -HEIGHT/2), JITTER, rng)
        at = np.stack([within(x, 4*L), within(y, HEIGHT)], axis=1)
        gases.append(at_rest(at, EOS.cv*gas.P/gas.rho))
    return np.concatenate(gases, axis=1)


def smoothed(method: Spam, state: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(3, n): smoothed rho, v, P of a tube and its image, means over the height and over both."""
    sums, state, _ = method.look(state)
    y = np.arange(HEIGHT) + 0.5 - HEIGHT/2
    both = []
    for sign in (1, -1):
        at = fields_at(sums, state, *np.meshgrid(sign*x, y))
        both.append([at.rho.mean(axis=0), sign*at.vx.mean(axis=0), (at.rho*at.e).mean(axis=0)/EOS.cv])
    return np.mean(both, axis=0)


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
    """One tube. L : half of its length, spacings. eta : viscosity and conductivity.

    tube : takes variant, L, law, seed, step, report. step : over the limit at the start.
    keep : whether profiles go to the table.
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
        lines = np.vstack([x/self.L - 1, fields]).T.tolist() if self.keep else []
        profile = [{**point, **dict(zip(("x", *NAMES), line, strict=True))} for line in lines]
        return Outcome({"method_tubes": [row], "method_tube_profiles": profile})
