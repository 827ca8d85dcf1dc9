"""Do particles under pressure pair, clump, cease to flow?    [KHP95, Secs IV, VI]

`Fate` leaves a gas to rest. `Freezing` searches, in the scene of Fig. 4 with 512 particles between plates,
for the static pressure at which convection stops. The continuum does not feel this pressure: it is added to
the sums as a negative fraction of the static one that `LessStatic` leaves out, with the gravity that balances
it; P is what is left at mid-height.
"""
from dataclasses import dataclass
from functools import cache, cached_property
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from continuum.fluid import ConstEta, energy, pressure
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard
from particles.limits import step_limit
from particles.observe import Grid, Smoothed, particle_kinetic
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.weights import value_and_slope
from studies.build.measure import Smoothing, flowing, smoothed_energy
from studies.build.names import START_JITTER
from studies.build.periodic_box import at_rest, fluid
from studies.build.spam import OF_LIMIT, Variant
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean
from studies.lattices.waves import sites_of_least_energy

# --- left alone -----------------------------------------------------------------------------------

SIDE = 16               # particles along each side
SPEED = 0.3             # rms of each velocity at the start; friction takes it away
LAW = ConstEta(0.5, 0.5)
TIME = 300.0            # 20 times L/c
PARTNER = 0.5           # spacings within which a neighbour shares a site: sites of one particle are 1.07 apart


@dataclass(frozen=True, kw_only=True)
class Fate(Case):
    """A viscous, conducting ideal gas in a periodic square, from random velocities."""
    weight: Any
    h: float
    seed: int = 1

    @property
    def cost(self) -> float:
        return 1.0

    def run(self, report: Report, folder: Path) -> Outcome:
        weight, box = self.weight.of(h=self.h), (float(SIDE), float(SIDE))
        method = fluid(weight, box, law=LAW)
        dt = STUDIES*step_limit(method, 1.0)
        x = run(method, self._start(), Plan(dt=dt, steps=round(TIME/dt)), report).state[:2].T
        near = partners(x, box)
        return Outcome({"fates": [{
            "weight": self.weight.__name__, "h": self.h, "seed": self.seed,
            "predicted": sites_of_least_energy(weight), "sites": 1 + float(np.median(near)),
            "shared": float(np.mean(near > 0)), "ratio": median_ratio(x, box),
            "chance": 1 - np.exp(-pi*PARTNER**2)}]})

    def _start(self) -> np.ndarray:
        rng = np.random.default_rng(self.seed)
        centres = np.arange(SIDE) + 0.5 - SIDE/2
        x = np.stack(np.meshgrid(centres, centres), axis=-1).reshape(-1, 2)
        state = at_rest(x + rng.uniform(-START_JITTER, START_JITTER, x.shape), 1.0)
        state[2:4] = SPEED*rng.standard_normal((2, len(x)))
        return state


def partners(x: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """(n,): other particles within half a spacing."""
    at = wrapped(x, box)
    return cKDTree(at, boxsize=np.array(box)).query_ball_point(at, PARTNER, return_length=True) - 1


def median_ratio(x: np.ndarray, box: tuple[float, float]) -> float:
    """Median of second over first neighbour distance of particles (n, 2) in a periodic box."""
    at = wrapped(x, box)
    distances, _ = cKDTree(at, boxsize=np.array(box)).query(at, 3)
    _, first, second = np.transpose(distances)
    return float(np.median(second/first))


def wrapped(x: np.ndarray, box: tuple[float, float]) -> np.ndarray:
    """Places as scipy wants them: from 0 to the box."""
    return np.mod(x, box) % box


# --- between plates -------------------------------------------------------------------------------

ROWS = 16
RANGE = 3.0
HALVINGS = 5
FROZEN = 0.1            # of the energy of the grid's field, smoothed by the same weight
T_END = 60.0            # free-fall times
MEAN_FROM = 30.0
WINDOW, LOOKS = 2.0, 20             # free-fall times in which distances of neighbours fluctuate, and looks at them
SITE, SHELL = 0.5, 6                # neighbours: the six nearest beyond half a spacing, where partners of a pair are
GRIDS = (16, 24)                    # rows of the grid: K of 24 is good to 1.5 %


@cache
def grid_energies(scene: RayleighBenard, weight: Any) -> tuple[float, float]:
    """K of the steady grid, as it is and smoothed as particles smooth theirs."""
    finest = steady_on(scene, GRIDS)[-1]
    return smoothed_energy(finest.fields, Smoothing(weight, RANGE, ROWS))


def criteria(weight: Any, K: float) -> dict[str, float]:
    """P at which m<v^2> = 2 K equals the printed potentials 2 P w(0) and 2 P [w(0.9) - w(1)]    [KHP95, Sec.
    IV]
    """
    centre, near, far = (value_and_slope(weight.of(h=RANGE), r)[0] for r in (0.0, 0.9, 1.0))
    return {"K": K, "barrier": K/centre, "melting": K/(near - far)}


@dataclass(frozen=True, kw_only=True)
class Freezing(Case):
    """The pressure at which flow freezes, by halving [low, high] on a logarithmic scale.

    P at mid-height is 1 (ideal gas) or 5 (dense fluid) in the scheme as printed. step : over that of other
    studies.
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

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra,
                "seed": self.seed, "step": self.step}

    def run(self, report: Report, folder: Path) -> Outcome:
        low, high, rows = np.log(self.low), np.log(self.high), []
        plain, smooth = grid_energies(self.scene, self.weight)
        for number in range(HALVINGS):
            report(number/HALVINGS)
            middle = (low + high)/2
            rows.append(self._row(float(np.exp(middle)), smooth))
            low, high = (low, middle) if rows[-1]["flow"] < FROZEN else (middle, high)
        limit = float(np.exp((low + high)/2))
        half = float(np.exp(high) - np.exp(low))/2
        if {row["flow"] < FROZEN for row in rows} != {False, True}:     # the interval's end is all there is
            limit = np.nan
        return Outcome({"freezing": rows, "freezing_limits": [
            {**self.columns, "measured": limit, "measured_err": half, **criteria(self.weight, plain)}]})

    def _row(self, P: float, K: float) -> dict[str, Any]:
        """One run at pressure P. K : of the grid's field, smoothed."""
        variant = Variant("pressure",
                          weight=self.weight, h=RANGE, fraction=1 - P/self.printed, step=self.step*OF_LIMIT)
        method, start, dt = variant.ready(self.scene, self.seed)
        unit = self.scene.L/self.scene.free_fall
        plan = Plan(dt=dt, steps=round(T_END*unit/dt), every=max(1, round(unit/4/dt)), mean_from=MEAN_FROM*unit,
                    series={"kp": particle_kinetic}, means={"grid": Grid.over(method.box, ROWS)})
        row = {**self.columns, "P": P}
        try:
            done = run(method, start, plan)
            places = self._places(method, done.by_id(), dt, unit)
        except Divergence:
            return {**row, **dict.fromkeys(("flow", "flow_err", "kp", "kp_err", "lindemann"), np.nan)}
        fields = Smoothed(*done.means["grid"])._asdict()
        flow = flowing({name: fields[name] for name in ("rho", "vx", "vy")}, periodic=True)
        kp = mean(np.array(done.series["kp"])[np.array(done.times) > plan.mean_from])
        return {**row, "flow": flow.value/K, "flow_err": flow.err/K, "kp": kp.value/K, "kp_err": kp.err/K,
                "lindemann": lindemann(places, self.scene.width)}

    def _places(self, method: Spam, state: np.ndarray, dt: float, unit: float) -> np.ndarray:
        """(times, n, 2) of the particles, in the order of the state."""
        places, steps = [state[:2].T], max(1, round(WINDOW*unit/dt/LOOKS))
        for _ in range(LOOKS):
            state = run(method, state, Plan(dt=dt, steps=steps)).by_id()
            places.append(state[:2].T)
        return np.array(places)


def neighbours(x: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (i, j) of particles (n, 2), periodic in x: of each the six nearest beyond half a spacing."""
    tall = 3*float(np.ptp(x[:, 1]))
    at = np.stack([np.mod(x[:, 0], width) % width, x[:, 1] - x[:, 1].min()], axis=1)
    distance, number = cKDTree(at, boxsize=np.array([width, tall])).query(at, 2*SHELL + 4)
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
