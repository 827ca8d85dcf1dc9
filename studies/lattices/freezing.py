"""At which static pressure, which the continuum does not feel, do particles cease to flow? By bisection    [KHP95, Sec. IV]

The scene of Fig. 4, 512 particles between plates. Pressure is added to the sums as a negative fraction of the static one that
`LessStatic` leaves out, with the gravity that balances it; P is what is left at mid-height.
"""
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from continuum.fluid import energy, pressure, temperature
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard
from particles.observe import Grid, Smoothed, particle_kinetic
from particles.run import Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.weights import value_and_slope
from studies.build.smoothing import Smoothing, smoothed_energy
from studies.build.spam import OF_LIMIT, Variant, method, start, step
from studies.build.symmetry import flowing
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean

ROWS = 16
RANGE = 3.0
HALVINGS = 5
FROZEN = 0.1            # of the energy of the grid's field, smoothed by the same weight
T_END, MEAN_FROM = 60.0, 30.0       # free-fall times
WINDOW, LOOKS = 2.0, 20             # free-fall times in which distances of neighbours fluctuate, and looks at them
SITE, SHELL = 0.5, 6                # neighbours: the six nearest beyond half a spacing, where partners of a pair are
LAYERS, STUCK = 4, 0.5              # of the height; spacings that particles come less far in the window if they stay
GRIDS = (16, 24)                    # rows of the grid: K of 24 is good to 1.5 %


@cache
def grid_energies(scene: RayleighBenard, weight: Any) -> tuple[float, float]:
    """K of the steady grid, as it is and smoothed as particles smooth theirs."""
    return smoothed_energy(steady_on(scene, GRIDS)[-1].fields, Smoothing(weight, RANGE, ROWS))


def neighbours(x: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (i, j) of particles (n, 2), periodic in x: of each the six nearest beyond half a spacing."""
    tall = 3*float(np.ptp(x[:, 1]))
    at = np.stack([np.mod(x[:, 0], width) % width, x[:, 1] - x[:, 1].min()], axis=1)
    distance, number = cKDTree(at, boxsize=np.array([width, tall])).query(at, 2*SHELL + 4)
    rank = np.cumsum(distance > SITE, axis=1)
    chosen = (distance > SITE) & (rank <= SHELL)
    return np.nonzero(chosen)[0], np.asarray(number)[chosen]


def lengths(x: np.ndarray, width: float) -> np.ndarray:
    """Of differences of places (..., 2), periodic in x."""
    return np.hypot(x[..., 0] - width*np.round(x[..., 0]/width), x[..., 1])


def lindemann(places: np.ndarray, width: float, some: Any = slice(None)) -> float:
    """Rms fluctuation in time of the distances of neighbours over their mean; places (times, n, 2), neighbours at the first.

    some : (n,) mask of particles whose neighbours count, all if not given.
    """
    i, j = neighbours(places[0], width)
    mask = np.zeros(places.shape[1], bool)
    mask[some] = True
    distance = lengths(places[:, i[mask[i]]] - places[:, j[mask[i]]], width)
    return float(np.sqrt(distance.var(axis=0).mean())/distance.mean())


@dataclass(frozen=True, kw_only=True)
class Freezing(Case):
    """The pressure between flowing and frozen, halving its ratio from `low` to `high`, for one set of random shifts.

    eos : its static pressure is 1 (ideal gas) or 5 (dense fluid) in the scheme as printed. step : over that of other studies.
    """
    eos: Any
    weight: Any
    ra: float = 3000.0
    seed: int = 1
    low: float = 0.25
    high: float = 8.0
    step: float = 1.0

    @property
    def cost(self) -> float:
        return (20.0 if type(self.eos).__name__ == "IdealGas" else 60.0)/self.step

    @cached_property
    def scene(self) -> RayleighBenard:
        return RayleighBenard(ra=self.ra, eos=self.eos, L=float(ROWS), pr=self.eos.cv)

    @property
    def printed(self) -> float:
        """Static pressure at mid-height as the equation of state has it."""
        return float(pressure(self.eos, 1.0, energy(self.eos, 1.0, self.scene.T_mean)))

    def run(self, report: Report, folder: Path) -> Outcome:
        low, high, rows, layers = np.log(self.low), np.log(self.high), [], []
        plain, smooth = grid_energies(self.scene, self.weight)
        for number in range(HALVINGS):
            report(number/HALVINGS)
            row, around = self._look(float(np.exp((low + high)/2)), smooth)
            rows.append(row)
            layers += around
            low, high = (low, (low + high)/2) if rows[-1]["flow"] < FROZEN else ((low + high)/2, high)
        between = {row["flow"] < FROZEN for row in rows} == {False, True}       # else the interval's end is all there is
        middle, half = np.exp((low + high)/2), (np.exp(high) - np.exp(low))/2
        limit = {**self._columns, "measured": float(middle) if between else np.nan, "measured_err": float(half),
                 **self._criteria(plain)}
        return Outcome({"freezing": rows, "freezing_limits": [limit], "freezing_layers": layers})

    @property
    def _columns(self) -> dict[str, Any]:
        return {"eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra, "seed": self.seed,
                "step": self.step}

    def _criteria(self, K: float) -> dict[str, float]:
        """P at which m<v^2> = 2 K equals phi(0) = 2 P w(0), and 2 P [w(0.9) - w(1)]    [KHP95, Sec. IV]"""
        w = [value_and_slope(self.weight.of(h=RANGE), r)[0] for r in (0.0, 0.9, 1.0)]
        return {"K": K, "barrier": K/w[0], "melting": K/(w[1] - w[2])}

    def _look(self, P: float, K: float) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """One run at pressure P, and what layers of particles are like at its end; K : of the grid's field, smoothed."""
        variant = Variant("pressure", weight=self.weight, h=RANGE, fraction=1 - P/self.printed, step=self.step*OF_LIMIT)
        chosen, dt, unit = method(self.scene, variant), step(self.scene, variant), self.scene.L/self.scene.free_fall
        grid = Grid.over(chosen.box, ROWS)
        plan = Plan(dt=dt, steps=round(T_END*unit/dt), every=max(1, round(unit/4/dt)), mean_from=MEAN_FROM*unit,
                    series={"kp": particle_kinetic}, means={"grid": grid})
        row = {**self._columns, "P": P}
        try:
            done = run(chosen, start(self.scene, self.seed), plan)
            places = self._places(chosen, done.by_id(), dt, unit)
        except Divergence:
            return {**row, "flow": np.nan, "flow_err": np.nan, "kp": np.nan, "kp_err": np.nan, "lindemann": np.nan}, []
        fields = Smoothed(*done.means["grid"])._asdict()
        flow = flowing({name: fields[name] for name in ("rho", "vx", "vy")}, periodic=True)
        kp = mean(np.array(done.series["kp"])[np.array(done.times) > plan.mean_from])
        found = {"flow": flow.value/K, "flow_err": flow.err/K, "kp": kp.value/K, "kp_err": kp.err/K,
                 "lindemann": lindemann(places, self.scene.width)}
        return {**row, **found}, [{**row, **layer} for layer in self._layers(places, done.by_id(), K)]

    def _layers(self, places: np.ndarray, state: np.ndarray, K: float) -> list[dict[str, float]]:
        """Of equal heights, from the hot plate up; state (5, n) at the first of the times."""
        height, width, rows = self.scene.L, self.scene.width, []
        for y in (np.arange(LAYERS) + 0.5)/LAYERS - 0.5:
            here = np.abs(places[0][:, 1]/height - y) <= 0.5/LAYERS
            way = lengths(places[-1][here] - places[0][here], width)
            rows.append({"y": float(y), "T": float(temperature(self.eos, 1.0, state[4, here]).mean()),
                         "stuck": float(np.mean(way < STUCK)), "lindemann": lindemann(places, width, here),
                         "kp": float((state[2, here]**2 + state[3, here]**2).mean()/2/K)})
        return rows

    def _places(self, chosen: Spam, state: np.ndarray, dt: float, unit: float) -> np.ndarray:
        """(times, n, 2) of the particles, in the order of the state."""
        found, steps = [state[:2].T], max(1, round(WINDOW*unit/dt/LOOKS))
        for _ in range(LOOKS):
            state = run(chosen, state, Plan(dt=dt, steps=steps)).by_id()
            found.append(state[:2].T)
        return np.array(found)
