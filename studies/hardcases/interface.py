"""An interface that a shock runs over: does its ripple grow as theory says?    [KHP95, Fig. 11]

Printed are the width, 30, the height, 100, and a density ratio of 4 of two ideal gases; not printed are
strength of the shock, amplitude and direction, nor the walls: here a shock of Mach 1.5 comes through the
light gas, the ripple has one wavelength and k a = 0.25 or 0.75, 1.2 or 3.6 spacings. Both gases fall with the
speed of the piston onto a resting mirror, which is where the shock begins; above is vacuum.
"""
from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.riemann import GasState, middle, shock_speed
from continuum.fluid import IdealGas
from particles.limits import step_limit
from particles.run import STUDIES, Divergence, Plan, run
from particles.smooth.spam import Spam
from particles.walls.mirror import Copied, Mirror, Odd
from particles.walls.periodic import periodic
from particles.weights import Lucy
from studies.build.spam import FRICTIONLESS, at_rest
from studies.hardcases.tubes import jittered, within
from studies.kit.case import Case, Outcome, Report

GAMMA, MACH = 2.0, 1.5
LIGHT, HEAVY = GasState(0.4, 0.0, 0.4), GasState(1.6, 0.0, 0.4)     # mean density about 1, light gas at T = 1
WIDTH, HEIGHT, BELOW = 30.0, 100.0, 60.0                    # of them the lowest 60 are light
JITTER = 0.2        # of rows and columns
STRIPS = 16         # in which the interface is looked for
SAMPLES = 60


class Impulse(NamedTuple):
    """What theory says: speed of the falling gas, time at which the shock meets the interface, velocity that
    this gives to it, time at which the reflected shock comes to the mirror, amplitude behind the shock and
    its growth rate.
    """
    fall: float
    meets: float
    kick: float
    back: float
    amplitude: float
    growth: float


def impulse(scale: float, steep: float) -> Impulse:
    """da/dt = k a+ A+ dv with a+ = a (1 - dv/W), k a = steep    [Richtmyer 1960]

    + is behind the shock of speed W, dv the velocity of the interface.
    """
    c = sqrt(GAMMA*LIGHT.P/LIGHT.rho)
    fall, W = 2*c/(GAMMA + 1)*(MACH - 1/MACH), MACH*c
    behind = middle(LIGHT._replace(v=fall), LIGHT._replace(v=-fall), GAMMA)     # a gas against its image
    shocked = GasState(behind.right, 0.0, behind.P)
    after = middle(shocked, HEAVY._replace(v=-fall), GAMMA)
    kick, meets = after.v + fall, BELOW*scale/W
    height = BELOW*scale - fall*meets
    k = 2*pi/(WIDTH*scale)
    a = steep/k*(1 - kick/W)
    atwood = (after.right - after.left)/(after.right + after.left)
    return Impulse(fall, meets, kick, meets + height/shock_speed(shocked, after.P, GAMMA), a, k*a*atwood*kick)


def gases(scale: float, steep: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """State (5, n) at the start, and which particles are light: rows cut at the rippled interface."""
    rng, width, bottom = np.random.default_rng(seed), WIDTH*scale, -HEIGHT*scale/2
    k, states, light = 2*pi/width, [], []
    for gas in (LIGHT, HEAVY):
        columns = round(width*sqrt(gas.rho))
        dx = width/columns
        dy = 1/(gas.rho*dx)
        counts = columns, round(HEIGHT*scale/dy)
        x, y = jittered(counts, (dx, dy), (-width/2, bottom), JITTER, rng)
        below = y < bottom + BELOW*scale + steep/k*np.cos(k*x)
        own = below == (gas is LIGHT)
        states.append(at_rest(np.stack([within(x, width), y], axis=1)[own], gas.P/gas.rho))
        light.append(np.full(own.sum(), gas is LIGHT))
    state = np.concatenate(states, axis=1)
    state[3] = -impulse(scale, steep).fall
    return state, np.concatenate(light)


def ripple(x: np.ndarray, y: np.ndarray, light: np.ndarray, width: float) -> tuple[float, float]:
    """Mean height and amplitude of the interface, from the best division of each strip."""
    strip = np.floor((x/width + 0.5)*STRIPS).astype(int) % STRIPS
    at = np.array([divide(y[strip == i], light[strip == i]) for i in range(STRIPS)])
    middles = (np.arange(STRIPS) + 0.5)/STRIPS - 0.5
    return float(at.mean()), float(2*np.mean(at*np.cos(2*pi*middles)))


def divide(y: np.ndarray, light: np.ndarray) -> float:
    """The height with the fewest particles on the wrong side; of several their mean."""
    order = np.argsort(y)
    heights, below = y[order], light[order]
    heavy_below = np.cumsum(~below)
    light_above = light.sum() - np.cumsum(below)
    wrong = (heavy_below + light_above)[:-1]
    best = np.flatnonzero(wrong == wrong.min())
    return float(np.mean((heights[best] + heights[best + 1])/2))


@dataclass(frozen=True, kw_only=True)
class Interface(Case):
    """One run of both gases. scale : all lengths over the printed ones. steep : k a before the shock."""
    scale: float
    steep: float = 0.25
    seed: int = 1

    @property
    def cost(self) -> float:
        return 2*self.scale**3

    @property
    def time(self) -> float:
        """Until the reflected shock is at the mirror, when nothing can be back at the interface."""
        return impulse(self.scale, self.steep).back

    def run(self, report: Report, folder: Path) -> Outcome:
        state, light = gases(self.scale, self.steep, self.seed)
        method = self.method
        steps = round(self.time/SAMPLES/(STUDIES*step_limit(method, state[4], 4.0))) + 1
        plan = Plan(dt=self.time/SAMPLES/steps, steps=steps)
        rows: list[dict[str, Any]] = []
        for number in range(1, SAMPLES + 1):
            report(number/SAMPLES)
            row = {"scale": self.scale, "steep": self.steep, "seed": self.seed,
                   "time": number*plan.steps*plan.dt}
            try:
                state = run(method, state, plan).by_id()
            except Divergence:
                rows.append({**row, "height": np.nan, "amplitude": np.nan})
                break
            height, amplitude = ripple(state[0], state[1], light, WIDTH*self.scale)
            rows.append({**row, "height": height, "amplitude": amplitude})
        return Outcome({"ripples": rows})

    @property
    def method(self) -> Spam:
        """Periodic along the shock, with a mirror below; above is vacuum."""
        width, height = WIDTH*self.scale, HEIGHT*self.scale
        floor = Mirror(1, -height/2, 1.0, 1.0, 0.0, Odd(), Copied())
        return Spam(weight=Lucy.of(h=3.0), eos=IdealGas(), law=FRICTIONLESS, walls=(*periodic(width), floor),
                    box=(width, height))
