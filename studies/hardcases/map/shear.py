"""A shear flow that gives way: does its wave grow as linear theory says?    [Rayleigh 1880; Meshalkin & Sinai 1961]

u = U sin ky in a periodic box two wavelengths wide, without viscosity. Small waves exp(i k_x x), k_x = k/2, obey
q_t = -i k_x u (q + k^2 psi), q = lap psi, so harmonics q_n exp(inky) of each other:

    dq_n/dt = -(k_x U/2) [(1 - k^2/K_(n-1)^2) q_(n-1) - (1 - k^2/K_(n+1)^2) q_(n+1)],    K_n^2 = k_x^2 + n^2 k^2.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND
from particles.integral.layer import Layer
from particles.integral.points import Points, of_positions
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.weights import Lucy
from studies.build import fixed as dih
from studies.build import moving, spam
from studies.build import rr98_moving as drift
from studies.build.scenes import Slab
from studies.build.setting import positions
from studies.hardcases.map.methods import Body, Built, all_round, closed, drifting, fields, smooth
from studies.kit.case import Case, Outcome, Report
from studies.kit.table import Table
from studies.ordering.derive import line

U, BEGIN = 0.15, 0.01       # Mach number 0.1; size of the wave over U at the start
HARMONICS = 20              # on either side: the rate is good to 1e-9
GROWN = 2.5                 # growth times that are watched: the wave ends with a tenth of U
SAMPLES = 50

#: growth rates of the wave, reached: part of the time
SHEAR = Table("shear", key=["method"], columns=["method", "predicted", "measured", "measured_err", "reached"])


class Wave(NamedTuple):
    """Growth rate, and amplitudes psi_n of the harmonics -HARMONICS .. HARMONICS."""
    rate: float
    psi: np.ndarray


def fastest(k: float, kx: float) -> Wave:
    """The wave that grows fastest."""
    n = np.arange(-HARMONICS, HARMONICS + 1)
    K2 = kx**2 + (n*k)**2
    part = kx*U/2*(1 - k**2/K2)
    rates, modes = np.linalg.eig(np.diag(part[1:], 1) - np.diag(part[:-1], -1))
    best = int(np.argmax(rates.real))
    return Wave(float(rates[best].real), -modes[:, best]/K2)


@dataclass(frozen=True, kw_only=True)
class ShearFlow(Slab):
    """The flow with its wave: v of the wave has the size BEGIN U in the mean over y."""
    L: float = 16.0
    aspect: float = 2.0
    viscosity: float = 0.0
    heat: float = 0.0

    @property
    def k(self) -> float:
        """Of the flow; that of the wave is half of it."""
        return 2*pi/self.L

    @property
    def wave(self) -> Wave:
        """The wave that grows fastest."""
        return fastest(self.k, self.k/2)

    def flow(self, x, y, ke: float = 0.0, rolls: int | None = None):
        """u = psi_y, v = -psi_x on top of U sin ky; `ke` says nothing here."""
        kx, psi = self.k/2, self.wave.psi
        psi = psi*BEGIN*U/(kx*abs(psi[HARMONICS]))
        n = np.arange(-HARMONICS, HARMONICS + 1)[:, None]
        waves = psi[:, None]*np.exp(1j*(kx*x + n*self.k*y))
        return U*np.sin(self.k*y) + (1j*n*self.k*waves).sum(axis=0).real, -(1j*kx*waves).sum(axis=0).real


def fixed(scene: ShearFlow, make: Callable, size: float) -> Built:
    """Points that stay, periodic along both axes."""
    points: Points = of_positions(positions(scene.width, scene.L, size, 1), (scene.width, scene.L))
    method = Layer(x=points.x, edges=make(points, Lucy.of(h=2.0)), beyond=NONE_BEYOND, eos=scene.eos, law=scene.law,
                   T_plates=(1.0, 1.0), g=0.0)
    start = method.state(*fields(scene, points.x))
    return Built(method, start, dih.OF_LIMIT*limit_of(method, start),
                 lambda state: Body(method.x, (state[1:3]/state[0]).T, state[0]*method.edges.V))


METHODS: dict[str, Callable[..., Built]] = {
    "spam printed": partial(smooth, variant=spam.PRINTED._replace(walls=all_round)),
    "spam Wendland": partial(smooth, variant=spam.VARIANTS["wendland-c2"]._replace(walls=all_round)),
    "fixed lattice": partial(fixed, make=renormalised, size=0.0), "fixed jittered": partial(fixed, make=delaunay, size=0.3),
    "moving": partial(closed, motion=moving.MOTIONS["moving"], walls=all_round),
    **{f"drift {name}": partial(drifting, motion=drift.DRIFT_MOTIONS[motion], walls=all_round)
       for name, motion in (("literal", "moving-literal"), ("constant mass", "moving-constant-mass"))}}


class Amplitude:
    """Size of v exp(-i k_x x), the mean over the mass, in time."""

    def __init__(self, built: Built, kx: float):
        self.built, self.kx, self.found = built, kx, [self.of(built.body(built.start), kx)]

    @staticmethod
    def of(body: Body, kx: float) -> float:
        """Of one state."""
        return float(abs(np.sum(body.m*body.v[:, 1]*np.exp(-1j*kx*body.x[:, 0])))/body.m.sum())

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        self.found.append(self.of(self.built.body(state), self.kx))
        return self.found[-1]


@dataclass(frozen=True, kw_only=True)
class Shear(Case):
    """The growth rate by one method."""
    method: str

    @property
    def cost(self) -> float:
        return 3.0

    @property
    def label(self) -> str:
        return f"map shear layer, {self.method}"

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = ShearFlow()
        built, rate = METHODS[self.method](scene=scene), scene.wave.rate
        time = GROWN/rate
        every = int(np.ceil(time/built.dt/SAMPLES))
        seen, reached = Amplitude(built, scene.k/2), 1.0
        plan = Plan(dt=time/every/SAMPLES, steps=every*SAMPLES, series={"v": seen}, every=every)
        try:
            run(built.method, built.start, plan, report)
        except Divergence as error:
            reached = error.step/plan.steps
        return growth(self.method, scene, time, seen, reached)


def growth(method: str, scene: ShearFlow, time: float, seen: Amplitude, reached: float) -> Outcome:
    """The row of a run."""
    slope, err = np.nan, np.nan
    if reached == 1:
        slope, err = line(np.linspace(0, time, len(seen.found)), np.log(seen.found))
    return Outcome({"shear": [{"method": method, "predicted": scene.wave.rate, "measured": slope, "measured_err": err,
                               "reached": reached}]})


def cases(size: str) -> Iterator[Case]:
    """All methods."""
    yield from (Shear(method=method) for method in METHODS if size != "quick")
