"""Limits of the time step: by formula, by eigenvalues of the rates, and by trial.

Methods are at rest with a little noise, on as few points as their range allows. Units: spacing, mean density,
T and P/rho are 1, so the speed of sound is sqrt 2 (ideal gas, C_V = 1).
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.gas.fields import block, initial
from continuum.gas.loop import FluxForm
from continuum.gas.solve import RK4_DECAY, RK4_SOUND, March, limits
from particles.integral.closed_faces import Moving
from particles.integral.drifts import DRIFTS
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Layer
from particles.integral.nested import mixed
from particles.integral.points import lattice
from particles.integral.rr98_moving import Drift
from particles.integral.rr98_moving_plain import scale_of
from particles.integral.thermal import Thermal
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.smooth.sums import Direct
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.periodic_box import at_rest, fluid
from studies.build.scenes import TINY, Slab
from studies.build.setting import positions
from studies.build.unguarded import GROWN, NOISE, Unguarded, bisected, noise_grows
from studies.hardcases.stability import eigenvalues, largest_step, visible
from studies.kit.case import Case, Outcome, Report

SIDE = 10               # points along each side: waves of 10, 5, ... 2 spacings
SMALL = 6               # of the scheme that is not compiled
JITTER = 0.3            # of disordered points, in spacings
DISORDER = 1.4          # by which limits of points that move leave room for disorder: see `limit_of` of each
EOS, SOUND = IdealGas(), np.sqrt(2)
#: 1 % beyond its limit RK4 makes motions grow by 4 (diffusion) to 7 % (sound) a step: in 200 steps by 2000
#: and more
STEPS = 200
UNKNOWN = 0.01          # of a limit: how far beyond it growth may stay unseen where no eigenvalues tell


class AtRest(NamedTuple):
    """A method at rest: start (fields, n), rows of the state that noise is looked for in, integrator by name.

    predicted : the largest step by the method's own formula. margin : what it leaves for disorder, by which
    it is smaller.
    shorter : the shorter one of the steps that sound alone and diffusion alone allow, by the operators in
    use.
    linear : whether eigenvalues of the rates say all, as they do not where faces are made and points drift
    between stages.
    """
    method: Any
    start: np.ndarray
    rows: tuple[int, ...]
    predicted: float
    integrator: str = "RK4"
    margin: float = 1.0
    linear: bool = True
    shorter: float = np.nan

    def grows(self, dt: float) -> bool:
        """Whether noise grows at a step."""
        return noise_grows(Unguarded(self.method), self.start, self.rows, STEPS, dt)

    def eigenvalues(self) -> tuple[float, float]:
        """The step at which motions begin to grow, and the one from which trials see it."""
        if not self.linear:
            return np.nan, np.nan
        rates = eigenvalues(self.method, self.start)
        seen = visible(GROWN, self.start.size, STEPS)
        return largest_step(rates, self.integrator), largest_step(rates, self.integrator, seen)


@dataclass(frozen=True, kw_only=True)
class Limit(Case):
    """One method in one scene."""
    method: str
    scene: str
    eta: float
    k: float

    @property
    def cost(self) -> float:
        return {"moving": 6.0, "fluctuating": 6.0}.get(self.method, 2.0)

    @property
    def label(self) -> str:
        return f"limit {self.method}, {self.scene}"

    def run(self, report: Report, folder: Path) -> Outcome:
        trial = METHODS[self.method](ConstEta(self.eta, self.k))
        exact, seen = trial.eigenvalues()
        limit = bisected(trial.grows, trial.predicted*trial.margin)
        # growth that a trial of so many steps is too short to see: no difference of measured and exact
        unseen = seen - exact if np.isfinite(seen) else UNKNOWN*limit.value
        return Outcome({"limits": [{
            "method": self.method, "scene": self.scene, "eta": self.eta, "k": self.k, "integrator": trial.integrator,
            "predicted": trial.predicted, "margin": trial.margin, "shorter": trial.shorter, "exact": exact,
            "measured": limit.value, "measured_err": limit.half + unseen}]})


# --- methods --------------------------------------------------------------------------------------


def noise(*shape: int) -> np.ndarray:
    """Normal numbers of size NOISE; the same at each call."""
    return NOISE*np.random.default_rng(1).standard_normal(shape)


def spam(law: ConstEta, weight: Any, h: float, **more: Any) -> AtRest:
    """Smooth particles on a square lattice that is stable by itself, in a periodic box."""
    x, e = lattice((SIDE, SIDE)).x, 1 + noise(SIDE**2)
    method = fluid(weight.of(h=h), (SIDE, SIDE), EOS, law, **more)
    start = at_rest(x, e)
    start[2:4] = noise(2, SIDE**2)
    return AtRest(method, start, (2, 3, 4), limit_of(method, start))


def fixed(law: ConstEta, make: Callable = renormalised, jitter: float = 0.0, share: float = 1.0) -> AtRest:
    """Fixed points between plates."""
    x = positions(SIDE, SIDE, jitter, 1)
    edges, beyond = between_plates(make, x, SIDE, SIDE, Lucy.of(h=2.0))
    method = Layer(x=x, edges=edges, beyond=beyond, eos=EOS, law=law, T_plates=(1.0, 1.0), g=0.0, transport=mixed(share))
    start = method.state(1 + noise(len(x)), noise(len(x), 2), 1 + noise(len(x)))
    sound, along = method.fastest
    spread = along if share == 1 else sound**2      # the divergence of nested currents is a second gradient
    shorter = min(RK4_SOUND/(SOUND*sound), RK4_DECAY/max(max(law.eta, law.k)*spread, TINY))
    return AtRest(method, start, (0, 1, 2, 3), limit_of(method, start), shorter=float(shorter))


def thermal(law: ConstEta) -> AtRest:
    """Fluctuating hydrodynamics without fluctuations, k = 0."""
    points = lattice((SMALL, SMALL))
    method = Thermal(edges=renormalised(points, Lucy.of(h=2.0)), eos=EOS, law=law, k=0.0, seed=1, share=1.0)
    start = method.dih.state(1 + noise(points.n), noise(points.n, 2), 1 + noise(points.n))
    return AtRest(method, start, (0, 1, 2, 3), limit_of(method, start), "ThreeStage")


def drifting(law: ConstEta, name: str) -> AtRest:
    """Points that move in one of RR98's ways, between plates."""
    weight, points = WendlandC2.of(h=4.0), lattice((SIDE, SIDE))      # at h = 3 the lattice itself gives way
    method = Drift(motion=DRIFTS[name], weight=weight, scale=scale_of(lattice((12, 12)), weight), eos=EOS, law=law,
                   box=(SIDE, SIDE), walls=(*plates(SIDE, 1.0, 1.0), *periodic(SIDE)))
    start = method.state(points.x, 1.0, noise(points.n, 2), 1 + noise(points.n))
    return AtRest(method, start, (2, 3, 4, 5), limit_of(method, start), margin=DISORDER)


def moving(law: ConstEta) -> AtRest:
    """Moving points that exchange over closed faces, between plates."""
    points = lattice((SIDE, SIDE))
    method = Moving(weight=WendlandC2.of(h=3.0), eos=EOS, law=law, box=(SIDE, SIDE),
                    walls=(*plates(SIDE, 1.0, 1.0), *periodic(SIDE)))
    start = method.state(points.x, noise(points.n, 2), 1.0, 1 + noise(points.n))
    return AtRest(method, start, (4, 5, 6, 7, 8), limit_of(method, start), "ThreeStage",
                                                           DISORDER, linear=False)


class GridAtRest(NamedTuple):
    """The compressible grid at rest, cells of size 1: what `Limit` asks of a `AtRest`."""
    scene: Slab
    start: np.ndarray
    predicted: float
    shorter: float
    integrator: str = "RK4"
    margin: float = 1.0

    def grows(self, dt: float) -> bool:
        """Whether noise grows at a step."""
        march = March(self.scene, self.start.copy(), FluxForm(), dt)
        try:
            march.go(STEPS//10)
            before = spread(march.S)
            march.go(STEPS - STEPS//10)
        except ArithmeticError:
            return True
        return spread(march.S) > GROWN*before

    def eigenvalues(self) -> tuple[float, float]:
        """Not known."""
        return np.nan, np.nan


def spread(S: np.ndarray) -> float:
    """Rms deviation of all fields from their means, without ghosts."""
    return float(np.sqrt(S[:, 1:-1, 1:-1].var(axis=(1, 2)).sum()))


def on_grid(law: ConstEta) -> GridAtRest:
    """Cells between plates, as many as points."""
    scene = Slab(L=float(SIDE), aspect=1.0, viscosity=law.eta, heat=law.k)
    S = block(initial(scene, SIDE, 0.0))
    S[:, 2:-1, 1:-1] += noise(*S[:, 2:-1, 1:-1].shape)
    formula = limits(scene, S)
    return GridAtRest(scene, S, formula.both, min(formula.sound, formula.diffusion))


METHODS: dict[str, Callable[[ConstEta], AtRest | GridAtRest]] = {
    "grid": on_grid,
    "spam Lucy": partial(spam, weight=Lucy, h=2.5),
    "spam Wendland": partial(spam, weight=WendlandC2, h=4.0),
    "spam direct": partial(spam, weight=Lucy, h=2.5, transport=Direct),
    "fixed lattice": fixed,
    "fixed nested": partial(fixed, share=0.0),
    "fixed jittered": partial(fixed, make=delaunay, jitter=JITTER),
    "fluctuating": thermal,
    "drift literal": partial(drifting, name="literal"),
    "drift constant mass": partial(drifting, name="constant-mass"),
    "moving": moving,
}
