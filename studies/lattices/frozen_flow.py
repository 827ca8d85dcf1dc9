"""At which static pressure does convection of 512 particles freeze?    [KHP95, Sec. IV, Fig. 4]

The continuum equations do not depend on this pressure. It is added to the sums, with the gravity that
balances it, as a negative fraction of the static pressure that `LessStatic` leaves out. P is the pressure
left at mid-height, 1 as printed.
"""
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from continuum.gas.fields import NodeFields, interpolate
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard
from particles.observe import Grid, Smoothed
from particles.run import Divergence, Plan, Run, run
from particles.smooth.spam import Spam
from particles.weights import value_and_slope
from studies.build.measure import FINE, Smoothing, flowing, smoothed_energy
from studies.build.spam import OF_LIMIT, Variant
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import with_errors
from studies.kit.table import Row

ROWS = 16
SCENE = RayleighBenard(ra=3000.0, L=float(ROWS))
UNIT = SCENE.L/SCENE.free_fall
RANGE = 3.0
PRESSURES, HALVINGS = (0.25, 8.0), 5
FROZEN = 0.1            # over the energy of the grid's field, smoothed by the same weight
T_END = 60.0            # free-fall times
MEAN_FROM = 30.0
WINDOW, LOOKS = 2.0, 20     # free-fall times of measuring distances of neighbours, number of samples
SITE, SHELL = 0.5, 6        # neighbours: the six nearest beyond half a spacing; partners of a pair are nearer
GRIDS = (16, 24)                    # rows of the grid: K of 24 is good to 1.5 %


@cache
def grid_energies(weight: Any) -> tuple[float, float]:
    """K of the steady flow on the grid, plain and smoothed as that of particles."""
    finest = steady_on(SCENE, GRIDS)[-1]
    return smoothed_energy(finest.fields, Smoothing(weight, RANGE, ROWS))


def criteria(weight: Any, K: float) -> dict[str, float]:
    """P at which m<v^2> = 2 K is the printed potential 2 P w(0) or 2 P [w(0.9) - w(1)]    [KHP95, Sec. IV]"""
    w = weight.of(h=RANGE)
    centre, near, far = (value_and_slope(w, r)[0] for r in (0.0, 0.9, 1.0))
    return {"K": K, "barrier": K/centre, "melting": K/(near - far)}


class Freezing(Case, same="weight seed step"):
    """The pressure at which flow freezes, by halving PRESSURES on a logarithmic scale.

    step : over that of other studies.
    """
    weight: Any
    seed: int = 1
    step: float = 1.0

    @property
    def cost(self) -> float:
        return 20.0/self.step

    def run(self, report: Report, folder: Path) -> Outcome:
        (low, high), rows = np.log(PRESSURES), []
        plain, smooth = grid_energies(self.weight)
        for number in range(HALVINGS):
            report(number/HALVINGS)
            middle = (low + high)/2
            rows.append(self.row(float(np.exp(middle)), smooth))
            if rows[-1]["flow"] < FROZEN:
                high = middle
            else:
                low = middle
        limit = float(np.exp((low + high)/2))
        half = float(np.exp(high) - np.exp(low))/2
        if {row["flow"] < FROZEN for row in rows} != {False, True}:     # the limit is outside [low, high]
            limit = np.nan
        return Outcome({"freezing": rows, "freezing_limits": [
            {**self.columns, "measured": limit, "measured_err": half, **criteria(self.weight, plain)}]})

    def row(self, P: float, K: float) -> Row:
        """The row of one run at pressure P. K : of the grid's smoothed field."""
        variant = Variant("pressure", weight=self.weight, h=RANGE, fraction=1 - P, step=self.step*OF_LIMIT)
        method, start, dt = variant.ready(SCENE, self.seed)
        grid, every = Grid.over(method.box, ROWS), max(1, round(UNIT/4/dt))
        plan = Plan(dt=dt, steps=round(T_END*UNIT/dt), every=every, mean_from=MEAN_FROM*UNIT,
                    means={"grid": grid})
        key = {**self.columns, "P": P}
        try:
            done = run(method, start, plan)
            fluctuation = lindemann(places(method, done, dt), SCENE.width)
        except Divergence:
            return {**key, **dict.fromkeys(("flow", "flow_err", "lindemann"), np.nan)}
        means = Smoothed(*done.means["grid"])
        flow = flowing({"rho": means.rho, "vx": means.vx, "vy": means.vy}, periodic=True)
        return {**key, "lindemann": fluctuation, **with_errors(flow=flow/K)}


class Fastest(Case, table="freezing_flow"):
    """Ratio of the largest v^2 of the grid's flow to its mean, on several grids."""
    cost = 20.0

    def measure(self, report: Report) -> Iterator[Row]:
        for solution in steady_on(SCENE, (*GRIDS, 32)):
            yield {"ra": SCENE.ra, "rows": solution.rows, "fastest": fastest(solution.fields)}


def fastest(fields: NodeFields) -> float:
    """The largest v^2 of a flow over 2 K."""
    x, y = (np.linspace(line[0], line[-1], FINE, endpoint=False) for line in (fields.x, fields.y))
    at = interpolate(fields, *np.meshgrid(x, y))
    square = at.vx**2 + at.vy**2
    return float(square.max()*at.rho.sum()/(at.rho*square).sum())


def places(method: Spam, done: Run, dt: float) -> np.ndarray:
    """Places (times, n, 2) of the particles in a window after a run, in the order of their ids."""
    looks = [done.by_id()]
    plan = Plan(dt=dt, steps=max(1, round(WINDOW*UNIT/dt/LOOKS)))
    for _ in range(LOOKS):
        looks.append(run(method, looks[-1], plan).by_id())
    return np.array([method.fields(look).x for look in looks])


def neighbours(x: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (i, j) of neighbours, periodic in x: for each place x (n, 2) the six nearest beyond SITE."""
    # modulo twice: scipy refuses places at the end of the box, where rounding may put them
    along, up = x[:, 0] % width % width, x[:, 1] - x[:, 1].min()
    tree = cKDTree(np.stack([along, up], axis=1), boxsize=np.array([width, 3*up.max()]))
    distance, number = tree.query(tree.data, 2*SHELL + 4)
    beyond = distance > SITE
    chosen = beyond & (np.cumsum(beyond, axis=1) <= SHELL)
    return np.nonzero(chosen)[0], np.asarray(number)[chosen]


def lindemann(places: np.ndarray, width: float) -> float:
    """Rms fluctuation of distances of neighbours over their mean; places (times, n, 2)."""
    i, j = neighbours(places[0], width)
    apart = places[:, i] - places[:, j]
    apart[..., 0] -= width*np.round(apart[..., 0]/width)
    distance = np.hypot(apart[..., 0], apart[..., 1])
    return float(np.sqrt(distance.var(axis=0).mean())/distance.mean())
