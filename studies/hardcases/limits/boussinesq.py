"""The longest step of the Boussinesq grid's projection method about a steady roll, by trial, against its CFL number's limit."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum import boussinesq
from continuum.boussinesq.projection import CFL_LIMIT, Projection
from studies.build.unguarded import GROWN, NOISE, bisected
from studies.kit.case import Case, Outcome, Report

STEPS = 600
UNSEEN = 0.03       # of the limit: two-step extrapolation grows by c^4/4 a step beyond it, 4 % of that for each per cent
ROWS = 16


def apart(flow: Projection, steady: np.ndarray) -> float:
    """Rms deviation from the steady state."""
    return float(np.sqrt(np.mean((flow.q - steady)**2)))


def noise_grows(state: boussinesq.State, dt: float) -> bool:
    """Whether noise about a steady state is larger at the end than after a tenth of the steps."""
    noise = NOISE*np.random.default_rng(1).standard_normal(state.q.shape)
    flow, early = Projection(state.case, state.q + noise), np.inf
    for step in range(STEPS):
        flow.advance(dt)
        if step == STEPS//10:
            early = apart(flow, state.q)
    last = apart(flow, state.q)
    return not last < GROWN*early


@dataclass(frozen=True, kw_only=True)
class BoussinesqLimit(Case):
    """One roll at Prandtl number 1. Steps in free-fall times over the cell, so that limits are as those of the others."""
    ra: float

    @property
    def cost(self) -> float:
        return 5.0

    @property
    def label(self) -> str:
        return f"limit Boussinesq grid, Ra {self.ra:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        case = boussinesq.Case(ra=self.ra, pr=1.0, rows=ROWS)
        state = boussinesq.steady(case)
        predicted = CFL_LIMIT/Projection(case, state.q).courant()
        with np.errstate(all="ignore"):
            found = bisected(lambda dt: noise_grows(state, dt), predicted)
        return Outcome({"limits": [{"method": "Boussinesq grid", "scene": f"Ra {self.ra:g}", "eta": case.nu, "k": case.kappa,
                                    "integrator": "IMEX", "predicted": ROWS*predicted, "margin": 1.0, "exact": np.nan,
                                    "measured": ROWS*found.value, "measured_err": ROWS*(found.half + UNSEEN*found.value)}]})
