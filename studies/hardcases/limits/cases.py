"""Limits of the time step as cases: by formula, by eigenvalues and by trial."""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from continuum.fluid import ConstEta
from studies.build.unguarded import GROWN, bisected
from studies.hardcases.limits.boussinesq import BoussinesqLimit
from studies.hardcases.limits.dpd import BOXES, INTEGRATORS, DpdLimit
from studies.hardcases.limits.euler import WEAK, Strip
from studies.hardcases.limits.linear import eigenvalues, largest_step, visible
from studies.hardcases.limits.still import METHODS, OnGrid, Trial
from studies.kit.case import Case, Outcome, Report

#: viscosity and conductivity, spacing times speed of sound is 1.4: what the step is limited by
SCENES = {"zero viscosity": (0.0, 0.0), "balanced": (0.3, 0.3), "Prandtl 0.01": (0.05, 5.0), "Prandtl 100": (5.0, 0.05)}
EULER_SCENES = {"zero viscosity": (0.0, 0.0), "Euler 1/2": (0.5, 0.5), "Euler 1": (1.0, 1.0), "Euler heat": (0.1, 1.0)}
ROLLS = (1e4, 1e5)      # Rayleigh numbers of the Boussinesq grid
#: 1 % beyond its limit RK4 makes motions grow by 4 (diffusion) to 7 % (sound) a step: in 200 steps by 2000 and more. Beyond
#: Euler's they grow by some 1e-3 a step.
STEPS = {"RK4": 200, "ThreeStage": 200, "Euler": 4000}
LONG = {"fixed Euler, strip": 40000}        # where 4000 tell limits only to 10 %
SLOW = ("moving", "fluctuating", "spam direct", "fixed jittered, edges alone")      # in two scenes only
UNKNOWN = 0.01          # of a limit: how far beyond it growth may stay unseen where no eigenvalues tell


@dataclass(frozen=True, kw_only=True)
class Limit(Case):
    """One method in one scene."""
    method: str
    scene: str
    eta: float
    k: float

    @property
    def cost(self) -> float:
        return {"moving": 6.0, "fluctuating": 6.0, "fixed Euler, strip": 30.0}.get(self.method, 2.0)

    @property
    def label(self) -> str:
        return f"limit {self.method}, {self.scene}"

    def run(self, report: Report, folder: Path) -> Outcome:
        trial = METHODS[self.method](ConstEta(self.eta, self.k))
        steps = LONG.get(self.method, STEPS[trial.integrator])
        exact, seen = by_eigenvalues(trial, steps)
        found = bisected(trial.grows(steps), trial.predicted*trial.margin or 1.0)
        # growth that a trial of so many steps is too short to see: no difference of measured and exact
        unseen = seen - exact if np.isfinite(seen) else UNKNOWN*found.value
        return Outcome({"limits": [{"method": self.method, "scene": self.scene, "eta": self.eta, "k": self.k,
                                    "integrator": trial.integrator, "predicted": trial.predicted, "margin": trial.margin,
                                    "exact": exact, "measured": found.value, "measured_err": found.half + unseen}]})


@dataclass(frozen=True, kw_only=True)
class Shorter(Case):
    """What sound alone and diffusion alone allow, all methods whose formulas tell these apart."""

    @property
    def cost(self) -> float:
        return 10.0

    @property
    def label(self) -> str:
        return "formulas of sound and diffusion alone"

    def run(self, report: Report, folder: Path) -> Outcome:
        trials = {(method, scene): METHODS[method](ConstEta(eta, k)) for method in METHODS if "Euler" not in method
                  for scene, (eta, k) in SCENES.items()}
        return Outcome({"shorter": [{"method": method, "scene": scene, "shorter": trial.shorter}
                                    for (method, scene), trial in trials.items() if np.isfinite(trial.shorter)]})


def by_eigenvalues(trial: Trial | OnGrid, steps: int) -> tuple[float, float]:
    """The step at which motions begin to grow, and the one from which trials of so many steps see it."""
    if isinstance(trial, OnGrid) or not trial.linear:
        return np.nan, np.nan
    rates = eigenvalues(trial.method, trial.start)
    return (largest_step(rates, trial.integrator),
            largest_step(rates, trial.integrator, visible(GROWN, trial.start.size, steps)))


def cases(size: str) -> Iterator[Case]:
    """All methods; those with slow sums in two scenes."""
    for method in METHODS:
        scenes = EULER_SCENES if "Euler" in method else SCENES
        if size == "quick" and method not in ("grid", "spam Lucy", "fixed lattice"):
            continue
        for scene, (eta, k) in scenes.items():
            if scene in ("balanced", "Prandtl 100") or (method not in SLOW and (eta or method not in LONG)):
                yield Limit(method=method, scene=scene, eta=eta, k=k)
    if size != "quick":
        yield Shorter()
        yield from (Strip(scene=scene, eta=eta, k=k) for scene, (eta, k) in {**EULER_SCENES, WEAK: (0.0, 0.05)}.items() if k)
        yield from (DpdLimit(integrator=name, d=d) for d, name in product(BOXES, INTEGRATORS))
    yield from (BoussinesqLimit(ra=ra) for ra in ROLLS[:1 if size == "quick" else None])
