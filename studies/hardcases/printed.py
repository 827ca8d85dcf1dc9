"""Smooth particles in the squares of KHP95's Fig. 10 and in the shocked interface of Fig. 11.

Squares: rolls and pairs of 2500 particles between temperatures 10 and 0.5. KHP95 print Ra 350 000 for eta =
k = 0.8 (ideal gas) and 0.4 (dense fluid). The gas has this Ra with alpha = 1, and 67 150 with its own alpha =
1/<T>; the dense fluid has 340 800 with its own alpha, and 511 200 with the scenes' kappa = k/(rho C_V).

Interface: does its ripple grow as theory predicts? KHP95 print the width, 30, the height, 100, and a density
ratio of 4 of two ideal gases, but not the strength of the shock, its direction, the amplitude or the walls.
Here a shock of Mach 1.5 comes through the light gas; the ripple has one wavelength and k a = 0.25 or 0.75,
1.2 or 3.6 spacings. Both gases fall with the speed of the piston onto a mirror at rest, where the shock
begins; above them is vacuum.
"""
from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.riemann import GasState, middle, shock_speed
from continuum.fluid import IdealGas
from continuum.scene import RayleighBenard, Walls
from particles.limits import step_limit
from particles.observe import Grid, Smoothed
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.walls.mirror import Mirror, Odd
from particles.walls.periodic import periodic
from particles.weights import Lucy
from studies.build.measure import Snapshot, turns
from studies.build.names import START_ENERGY
from studies.build.spam import FRICTIONLESS, Variant, at_rest
from studies.hardcases.extremes import falls
from studies.kit.case import Case, Outcome, Report


def jittered(counts: tuple[int, int], cell: tuple[float, float], corner: tuple[float, float], jitter: float,
             rng: np.random.Generator) -> np.ndarray:
    """Places x, y (2, n) in the middle of cells, shifted by up to `jitter` of one. counts : columns, rows."""
    row, column = np.divmod(np.arange(counts[0]*counts[1]), counts[0])
    shift = rng.uniform(-1, 1, (2, len(row)))
    size, low = np.array(cell)[:, None], np.array(corner)[:, None]
    return (np.array([column, row]) + 0.5)*size + low + jitter*size*shift


# --- squares ------------------------------------------------------------------------------------------------

SIDE = 50.0
SHARED = 0.5            # distance in spacings within which a neighbour is the partner of a pair


def two_rolls(scene: RayleighBenard, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(rho, v, T) of conduction with two rolls, whose K over free-fall velocity squared is as in Sec. VI."""
    y = np.clip(x[:, 1], -scene.L/2, scene.L/2)
    v = scene.flow(x[:, 0], y, START_ENERGY*scene.free_fall**2, rolls=2)
    return np.ones(len(x)), np.stack(v, axis=1), scene.T(y)


@dataclass(frozen=True, kw_only=True)
class Square(Case):
    """One run in a square. t_end, mean_from : in free-fall times."""
    weight: Any
    ra: float
    t_end: float
    mean_from: float
    seed: int = 1
    eos: Any = IdealGas()  # noqa: RUF009 (immutable)

    @property
    def cost(self) -> float:
        return 0.5*self.t_end

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, pr=self.eos.cv, eos=self.eos, L=SIDE, aspect=1.0,     # eta = k
                               T_hot=10.0, T_cold=0.5, sides=Walls())
        variant = Variant("square", weight=self.weight, begin=two_rolls)
        method, start, dt = variant.ready(scene, self.seed)
        unit = falls(scene, 1.0)
        plan = Plan(dt=dt, steps=round(self.t_end*unit/dt), every=max(1, round(unit/4/dt)),
                    mean_from=self.mean_from*unit, means={"grid": Grid.over(method.box, 30)},
                    checkpoint=folder/"run.h5")
        done = run(method, start, plan, report)
        mean, (sums, *_) = Smoothed(*done.means["grid"]), method.look(done.state)
        x = np.stack([sums.around.x, sums.around.y], axis=1)
        near = Snapshot(x, np.zeros_like(x), sums.n, SIDE)
        flow = mean.rho*(mean.vx**2 + mean.vy**2)/2
        return Outcome({"squares": [{
            "eos": type(self.eos).__name__, "weight": self.weight.__name__, "ra": self.ra, "seed": self.seed,
            "alpha": scene.alpha, "rolls": turns(scene, mean.vy),
            "begun": START_ENERGY*scene.free_fall**2, "flow": flow.mean()/mean.rho.mean(),
            "ratio": near.pairing.value, "ratio_err": near.pairing.err,
            "shared": np.mean(near.near(SHARED) > 0)}]})


# --- interface ----------------------------------------------------------------------------------------------

GAMMA, MACH = 2.0, 1.5
LIGHT, HEAVY = GasState(0.4, 0.0, 0.4), GasState(1.6, 0.0, 0.4)     # mean density about 1, light gas at T = 1
WIDTH, TALL, BELOW = 30.0, 100.0, 60.0                    # the lowest 60 are light gas
JITTER = 0.2        # largest shift of a particle over its cell
STRIPS = 16         # columns in which the height of the interface is found
SAMPLES = 60


class Impulse(NamedTuple):
    """Exact and impulsive theory: speed of the falling gas, time at which the shock meets the interface,
    velocity that it gives the interface, time at which the reflected shock reaches the mirror, amplitude
    behind the shock, growth rate of the amplitude.
    """
    fall: float
    meets: float
    kick: float
    back: float
    amplitude: float
    growth: float


def impulse(scale: float, steep: float) -> Impulse:
    """Theory of the ripple, da/dt = k a+ A+ dv with a+ = a (1 - dv/W), k a = steep    [Richtmyer 1960]

    + : behind the shock, whose speed is W. dv : velocity that the interface gains. A : Atwood number.
    """
    c = sqrt(GAMMA*LIGHT.P/LIGHT.rho)
    fall, W = 2*c/(GAMMA + 1)*(MACH - 1/MACH), MACH*c
    behind = middle(LIGHT._replace(v=fall), LIGHT._replace(v=-fall), GAMMA)     # a gas against its image
    shocked = GasState(behind.right, 0.0, behind.P)
    after = middle(shocked, HEAVY._replace(v=-fall), GAMMA)
    kick, meets = after.v + fall, BELOW*scale/W
    height = BELOW*scale - fall*meets
    back = meets + height/shock_speed(shocked, after.P, GAMMA)
    k = 2*pi/(WIDTH*scale)
    a = steep/k*(1 - kick/W)
    atwood = (after.right - after.left)/(after.right + after.left)
    return Impulse(fall, meets, kick, back, a, k*a*atwood*kick)


def gases(scale: float, steep: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """State (5, n) at the start, and which particles are light: rows cut at the rippled interface."""
    rng, width, bottom = np.random.default_rng(seed), WIDTH*scale, -TALL*scale/2
    k, states, light = 2*pi/width, [], []
    for gas in (LIGHT, HEAVY):
        columns = round(width*sqrt(gas.rho))
        dx = width/columns
        dy = 1/(gas.rho*dx)
        counts = columns, round(TALL*scale/dy)
        x, y = places = jittered(counts, (dx, dy), (-width/2, bottom), JITTER, rng)
        below = y < bottom + BELOW*scale + steep/k*np.cos(k*x)
        own = below == (gas is LIGHT)
        x[:] = (x + width/2) % width - width/2
        states.append(at_rest(places[:, own].T, gas.P/gas.rho))
        light.append(np.full(own.sum(), gas is LIGHT))
    state = np.concatenate(states, axis=1)
    state[3] = -impulse(scale, steep).fall
    return state, np.concatenate(light)


def ripple(x: np.ndarray, y: np.ndarray, light: np.ndarray, width: float) -> tuple[float, float]:
    """Mean height and amplitude of the interface, from the height that best divides each strip."""
    strip = np.floor((x/width + 0.5)*STRIPS).astype(int) % STRIPS
    at = np.array([divide(y[strip == i], light[strip == i]) for i in range(STRIPS)])
    middles = (np.arange(STRIPS) + 0.5)/STRIPS - 0.5
    return float(at.mean()), float(2*np.mean(at*np.cos(2*pi*middles)))


def divide(y: np.ndarray, light: np.ndarray) -> float:
    """The height with the fewest particles on the wrong side; the mean of several such heights."""
    order = np.argsort(y)
    heights, below = y[order], light[order]
    wrong = (np.cumsum(~below) + light.sum() - np.cumsum(below))[:-1]
    best = np.flatnonzero(wrong == wrong.min())
    return float(np.mean((heights[best] + heights[best + 1])/2))


@dataclass(frozen=True, kw_only=True)
class Interface(Case):
    """One run of the interface. scale : all lengths over the printed ones. steep : k a before the shock."""
    scale: float
    steep: float = 0.25
    seed: int = 1

    @property
    def cost(self) -> float:
        return 2*self.scale**3

    def run(self, report: Report, folder: Path) -> Outcome:
        """Run until the reflected shock reaches the mirror: no wave has then come back to the interface."""
        width, height = box = WIDTH*self.scale, TALL*self.scale
        floor = Mirror(1, -height/2, 1.0, 1.0, 0.0, Odd())      # above is vacuum
        method = Spam(weight=Lucy.of(h=3.0), eos=IdealGas(), law=FRICTIONLESS, box=box,
                      walls=(*periodic(width), floor))
        state, light = gases(self.scale, self.steep, self.seed)
        time = impulse(self.scale, self.steep).back/SAMPLES
        steps = round(time/(STUDIES*step_limit(method, state[4], 4.0))) + 1
        plan = Plan(dt=time/steps, steps=steps)
        rows: list[dict[str, Any]] = []
        for number in range(1, SAMPLES + 1):
            report(number/SAMPLES)
            rows.append({"scale": self.scale, "steep": self.steep, "seed": self.seed,
                         "time": number*plan.steps*plan.dt})
            try:
                state = run(method, state, plan).by_id()
            except Divergence:
                break
            rows[-1] |= zip(("height", "amplitude"), ripple(state[0], state[1], light, width))
        return Outcome({"ripples": rows})
