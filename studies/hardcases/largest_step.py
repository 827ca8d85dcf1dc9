"""Limits of the time step: by formula, by eigenvalues of the rates, and by trial.

Methods are at rest with a little noise, on as few points as their range allows. Units: spacing, mean density,
T and P/rho are 1, so the speed of sound is sqrt 2 (ideal gas, C_V = 1).
"""
from collections.abc import Callable
from dataclasses import dataclass
from math import inf, log, nan
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyval

from continuum.fluid import ConstEta
from continuum.gas.fields import block, initial
from continuum.gas.solve import March, limits
from continuum.scene import Periodic, Torus
from continuum.steady import RK4_DECAY, RK4_SOUND
from particles.integral.layer import Layer
from particles.integral.points import lattice
from particles.limits import jacobian, limit_of
from particles.run import Run
from particles.threads import Threads
from studies.build.fixed import Scheme
from studies.build.grid import GridForm
from studies.build.moving import Carriage, DriftMotion, FacesMotion
from studies.build.scenes import SOUND, TINY, Scene, Slab
from studies.build.spam import Variant
from studies.build.unguarded import GROWN, NOISE, Unguarded, bisected, noise_grows
from studies.kit.case import Case, Outcome, Report

SIDE = 10               # points along each side: waves of 10, 5, ... 2 spacings
DISORDER = 1.4          # by which limits of points that move leave room for disorder: see `limit_of` of each
#: 1 % beyond its limit RK4 makes motions grow by 4 (diffusion) to 7 % (sound) a step: in 200 steps by 2000
#: and more
STEPS = 200
UNKNOWN = 0.01          # of a limit: how far beyond it growth may stay unseen where no eigenvalues tell

#: R(z) = sum of these times z^n multiplies a motion exp(lambda t) in a step of RK4, z = lambda dt
RK4 = (1, 1, 1/2, 1/6, 1/24)
NULL = 1e-3             # of the largest eigenvalue: below are motions that the sums do not see
ROUND_OFF = 1e-7        # growth in a step: rates by differences are good to 1e-9 of the fastest
TRIED = np.geomspace(1e-3, 10, 4001)        # times the fastest rate: the first that grows is good to 0.1 %
HALVINGS = 20


def eigenvalues(method: Any, start: np.ndarray) -> np.ndarray:
    """Of the rates of a method about a state (fields, n), those of motions that its sums see."""
    n = start.shape[1]
    sums, now = method.start(n, Threads(1)), Run(state=start.copy(), ids=np.arange(n))
    sums.make_ready(now, 0.0)
    rates = np.linalg.eigvals(jacobian(sums.rates, now.state))
    return rates[np.abs(rates) > NULL*np.abs(rates).max()]


def growth(rates: np.ndarray, dt: float) -> float:
    """Largest ln |R| of a step, less what the motion grows by itself."""
    z = rates*dt
    with np.errstate(divide="ignore"):
        size = np.log(np.abs(polyval(z, RK4)))
    return float(np.max(size - np.maximum(z.real, 0)))


def largest_step(rates: np.ndarray, least: float = ROUND_OFF) -> float:
    """The step of RK4 at which motions begin to grow by exp(least) a step; 0 if at all steps."""
    low = 0.0
    for high in TRIED/np.abs(rates).max():
        if growth(rates, high) > least:
            break
        low = high
    else:
        return inf
    if not low:
        return 0.0
    for _ in range(HALVINGS):
        middle = (low + high)/2
        low, high = (low, middle) if growth(rates, middle) > least else (middle, high)
    return float((low + high)/2)


class Trial(NamedTuple):
    """A method at rest. grows(dt) : does noise grow at a step?

    predicted : the largest step by the method's own formula, smaller by `margin` for disorder.
    shorter : the shorter one of the steps that sound alone and diffusion alone allow.
    exact : the step at which motions begin to grow, by eigenvalues of the rates; seen : where trials see it.
    """
    predicted: float
    grows: Callable[[float], bool]
    margin: float = 1.0
    shorter: float = nan
    exact: float = nan
    seen: float = nan


@dataclass(frozen=True, kw_only=True)
class Limit(Case):
    """One method in one scene. trial : takes variant and transport law."""
    method: str
    trial: Callable[[Any, ConstEta], Trial]
    variant: Any
    scene: str
    eta: float
    k: float

    @property
    def label(self) -> str:
        return f"limit {self.method}, {self.scene}"

    def run(self, report: Report, folder: Path) -> Outcome:
        trial = self.trial(self.variant, ConstEta(self.eta, self.k))
        limit = bisected(trial.grows, trial.predicted*trial.margin)
        # growth that a trial of so many steps is too short to see: no difference of measured and exact
        unseen = trial.seen - trial.exact if np.isfinite(trial.seen) else UNKNOWN*limit.value
        return Outcome({"limits": [{
            "method": self.method, "scene": self.scene, "eta": self.eta, "k": self.k,
            "predicted": trial.predicted, "shorter": trial.shorter, "exact": trial.exact,
            "measured": limit.value, "measured_err": limit.half + unseen}]})


@dataclass(frozen=True, kw_only=True)
class Quiet(Scene):
    """A gas at rest, between plates or on a torus."""
    law: ConstEta
    sides: Any = Periodic()  # noqa: RUF009 (immutable)
    L: float = SIDE
    width: float = SIDE


def noise(*shape: int) -> np.ndarray:
    """Normal numbers of size NOISE; the same at each call."""
    return NOISE*np.random.default_rng(1).standard_normal(shape)


def trial_of(method: Any, start: np.ndarray, rows: tuple[int, ...], **more: Any) -> Trial:
    """Points whose noise is looked for in some rows of the state, and what eigenvalues of their rates say."""
    rates, visible = eigenvalues(method, start), log(GROWN*start.size**0.5)/STEPS
    trial = unknown(method, start, rows, **more)
    return trial._replace(exact=largest_step(rates), seen=largest_step(rates, visible))


def unknown(method: Any, start: np.ndarray, rows: tuple[int, ...], **more: Any) -> Trial:
    """The same where eigenvalues do not say all: faces are made and points drift between stages."""
    def grows(dt: float) -> bool:
        return noise_grows(Unguarded(method), start, rows, STEPS, dt)
    return Trial(limit_of(method, start), grows, **more)


def on_lattice(variant: Any, scene: Quiet, v: np.ndarray) -> tuple[Any, np.ndarray]:
    """Method and start of particles with velocities v (n, 2) on a square lattice that is stable by itself."""
    x = lattice((SIDE, SIDE)).x
    method, start, _ = variant.ready(scene, x=x, fields=(1.0, v, 1 + noise(len(x))))
    return method, start


def spam(variant: Variant, law: ConstEta) -> Trial:
    """Smooth particles in a periodic box."""
    return trial_of(*on_lattice(variant, Quiet(law=law, sides=Torus()), noise(2, SIDE**2).T), (2, 3, 4))


def fixed(scheme: Scheme, law: ConstEta) -> Trial:
    """Fixed points between plates."""
    n = SIDE**2
    method, start, _ = scheme.ready(Quiet(law=law), fields=(1 + noise(n), noise(n, 2), 1 + noise(n)))
    return trial_of(method, start, (0, 1, 2, 3), shorter=alone(method, scheme.share))


def alone(method: Layer, share: float) -> float:
    """The shorter step of sound and diffusion; the divergence of nested currents is a second gradient."""
    sound, along = method.fastest
    diffusion = max(method.law.eta, method.law.k)*(along if share == 1 else sound**2)
    return float(min(RK4_SOUND/(SOUND*sound), RK4_DECAY/max(diffusion, TINY)))


def drifting(motion: DriftMotion, law: ConstEta) -> Trial:
    """Points that move in one of RR98's ways, between plates."""
    return trial_of(*on_lattice(motion, Quiet(law=law), noise(SIDE**2, 2)), (2, 3, 4, 5), margin=DISORDER)


def moving(motion: FacesMotion, law: ConstEta) -> Trial:
    """Moving points that exchange over closed faces, between plates."""
    return unknown(*on_lattice(motion, Quiet(law=law), noise(SIDE**2, 2)), (4, 5, 6, 7, 8), margin=DISORDER)


def carried(carriage: Carriage, law: ConstEta) -> Trial:
    """Points that move with their triangulation, in the disorder of their start; masses differ by volumes."""
    n = SIDE**2
    scene, fields = Quiet(law=law, sides=Torus()), (1 + noise(n), noise(n, 2), 1 + noise(n))
    method, start, _ = carriage.ready(scene, fields=fields)
    return unknown(method, start, (4, 5))


def on_grid(form: GridForm, law: ConstEta) -> Trial:
    """Cells of size 1 between plates, as many as points; ghosts have no noise of their own."""
    scene = Slab(L=float(SIDE), aspect=1.0, viscosity=law.eta, heat=law.k)
    S = block(initial(scene, SIDE, 0.0))
    S[:, 2:-1, 1:-1] += noise(*S[:, 2:-1, 1:-1].shape)

    def grows(dt: float) -> bool:
        march, noises = March(scene, S.copy(), form.continuity, dt), []
        try:
            for steps in (STEPS//10, STEPS - STEPS//10):
                march.go(steps)
                noises.append(march.S[:, 1:-1, 1:-1].var(axis=(1, 2)).sum()**0.5)
        except ArithmeticError:
            return True
        return bool(noises[1] > GROWN*noises[0])
    formula = limits(scene, S)
    return Trial(formula.both, grows, shorter=min(formula.sound, formula.diffusion))
