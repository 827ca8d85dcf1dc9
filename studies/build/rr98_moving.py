"""RR98's own moving points in the Rayleigh-Benard scene: motions by name, a run as a case    [RR98 Eqs 39, 46-51]"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Periodic, RayleighBenard
from particles.integral.brackets import Powers
from particles.integral.exchange import PRINTED
from particles.integral.points import lattice
from particles.integral.rr98_moving import DRIFTS, ConstantMassDrift, Drift, Drifts, OverPairs
from particles.integral.rr98_moving_plain import scale_of
from particles.integral.transposed_stress import MENDED
from particles.observe import pairs_behind
from particles.pairs import nothing, rate, sweep
from particles.run import Run
from particles.smooth.spam import LessStatic
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.fixed import positions
from studies.build.names import START_ENERGY, START_JITTER, check_spacings
from studies.build.points import OFTEN, AveragedRun, Setting, rolls
from studies.kit.case import Outcome
from studies.rb.tables import POINT

LAYERS = 16         # of the profile
CURVE = 1           # samples of K(t) a free-fall time


class DriftMotion(NamedTuple):
    """A motion, as printed but for what is named; `less` : share of the static pressure left out."""
    name: str
    motion: Any
    mended: bool = True
    less: float = 0.0
    weight: Any = WendlandC2
    h: float = 3.0


DRIFT_MOTIONS = {m.name: m for m in (
    DriftMotion("moving-literal", DRIFTS["literal"]),
    DriftMotion("moving-literal-printed-heat", DRIFTS["literal"], mended=False),
    DriftMotion("moving-convective", DRIFTS["convective"]),
    DriftMotion("moving-carried", DRIFTS["carried"]),
    DriftMotion("moving-constant-mass", DRIFTS["constant-mass"]),
    DriftMotion("moving-constant-mass-printed-heat", DRIFTS["constant-mass"], mended=False),
    DriftMotion("moving-sph", ConstantMassDrift(Powers(1.0, -1.0))),
    DriftMotion("moving-less-static", DRIFTS["constant-mass"], less=1.0),
)}


def method(scene: RayleighBenard, chosen: DriftMotion) -> Drift:
    """The method of unit spacing: a scene of L = rows spacings."""
    if not isinstance(scene.sides, Periodic):
        raise ValueError("moving points have plates above and below only: take a scene with periodic sides")
    check_spacings(scene)
    weight = chosen.weight.of(h=chosen.h)
    return Drift(motion=chosen.motion, weight=weight, scale=scale_of(lattice((12, 12)), weight), eos=scene.eos, law=scene.law,
                 box=(scene.width, scene.L), g=scene.g, walls=(*plates(scene.L, scene.T_hot, scene.T_cold),
                                                               *periodic(scene.width)),
                 transport=MENDED if chosen.mended else PRINTED, static=LessStatic(chosen.less, scene.T_mean))


def start(scene: RayleighBenard, fluid: Drift, seed: int) -> np.ndarray:
    """Jittered lattice, rolls of Sec. VI, linear temperature, density 1    [KHP95]"""
    x = positions(scene.width, scene.L, START_JITTER, seed)
    return fluid.state(x, 1.0, np.stack(scene.flow(x[:, 0], x[:, 1], START_ENERGY), axis=1), scene.T(x[:, 1]))


def masses(sums: Drifts, state: np.ndarray) -> np.ndarray:
    """Of the points, (n,)."""
    return state[4]*state[6]/sums.method.motion.owned(state[6])


def kinetic(sums: Drifts, state: np.ndarray) -> float:
    """K per mass."""
    m = masses(sums, state)
    return float(0.5*m@((state[2]**2 + state[3]**2)/state[4]**2)/m.sum())


class EdgeHeat(NamedTuple):
    """Heat that the first of two points gets from the other."""


nothing.of(EdgeHeat)(lambda term: (0.0,))
rate.of(EdgeHeat)(lambda term, a, b, ab: (0.5*(a.k + b.k)*ab.k*(b.Td - a.Td),))


class PlateHeat(NamedTuple):
    """Heat that enters the fluid through a plate (-1: lower, 1: upper), per time."""
    side: int

    def __call__(self, sums: Drifts, state: np.ndarray) -> float:
        """Over all pairs with images behind the plate."""
        heat = np.zeros((sums.n, 1))
        sums.team(sweep, sums.n, OverPairs(EdgeHeat()), sums.points, pairs_behind(sums, self.side), heat)
        return float(heat.sum())


@dataclass(frozen=True, kw_only=True)
class DriftRun(AveragedRun):
    """One run of RR98's own motions. The first seed keeps K(t) and the last profile."""
    motion: DriftMotion = DRIFT_MOTIONS["moving-literal"]

    @property
    def cost(self) -> float:
        return self.t_end*self.free_fall_time/0.6*self.points*1.6e-6 + 5

    def setting(self) -> Setting:
        fluid = method(self.scene, self.motion)
        series: dict[str, Any] = {"ke": kinetic, "lower": PlateHeat(-1), "upper": PlateHeat(1)}
        return Setting(fluid, start(self.scene, fluid, self.seed), 1.0, series, OFTEN)

    def values(self, setting: Setting, done: Run) -> dict:
        state, fluid = done.state, setting.method
        drift = fluid.conserved(state)[0]/fluid.conserved(setting.first)[0] - 1
        return {**self.averages(done), "rolls": rolls(self.scene, state[:2].T, state[3]/state[4]), "mass_drift": float(drift),
                "history": self.history(done), "profiles": self.profile(fluid, state)}

    def history(self, done: Run) -> list[dict]:
        """K(t)."""
        samples = list(zip(done.times, done.series["ke"], strict=True))[::OFTEN//CURVE]
        return [{"t": t, "t_viscous": t/self.scene.viscous_time, "ke": ke, "ke_field": ke} for t, ke in samples]

    def profile(self, fluid: Drift, state: np.ndarray) -> list[dict]:
        """Mass per area, and means over the mass of each layer, at the end."""
        owned, L = fluid.motion.owned(state[6]), self.scene.L
        m, vy = state[4]*state[6]/owned, state[3]/state[4]
        T = fluid.temperature(state)
        layer = np.clip(((state[1]/L + 0.5)*LAYERS).astype(int), 0, LAYERS - 1)
        mass, *sums = (np.bincount(layer, m*q, LAYERS) for q in (np.ones_like(m), T, vy**2, vy*T))
        means = [total/mass for total in sums]
        columns = ((np.arange(LAYERS) + 0.5)/LAYERS - 0.5, mass/(L*self.scene.width/LAYERS), *means)
        return [dict(zip(("y", "rho", "T", "vy2", "vyT"), map(float, row), strict=True)) for row in zip(*columns, strict=True)]

    def _outcome(self, steps: int, dt: float, values: dict) -> Outcome:
        more = {name: values.pop(name, []) for name in ("history", "profiles")}
        rows = super()._outcome(steps, dt, values).rows
        [row] = rows["kinetic_energy"]
        key = {name: row[name] for name in (*POINT, "seed")}
        kept = {name: [{**key, **one} for one in found] for name, found in more.items()} if self.seed == 1 else {}
        return Outcome({**rows, **kept})
