"""The spectral method in convection: what n functions along an axis give, against more of them."""
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np

from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import SpectralState, steady
from studies.cost.problem import Residuals, Result, relative, rms
from studies.cost.race import Race
from studies.cost.seconds import of_calls
from studies.cost.tables import with_err
from studies.kit.case import Outcome, Report
from studies.kit.stats import Measured

FIRST = 8           # functions, from whose state that of others starts
#: most functions -> those of their exact answer; four fewer tell its uncertainty
FINER = {12: 20, 24: 32}


@cache
def solved(ra: float, n: int) -> SpectralState:
    """The steady gas, from warm streams, once in a process."""
    laws = GasLaws(RayleighBenard(ra=ra))
    few = steady(laws, min(n, FIRST))
    return steady(laws, n, few) if n > FIRST else few


def apart(state: SpectralState, exact: SpectralState) -> Residuals:
    """K and velocity of two states, at the points of the finer one; as in `rolls`."""
    finer, n = exact.equations, state.equations.n
    every = np.zeros((4, finer.n, finer.n))
    every[:, :n, :n] = state.equations.amplitudes(state.q)
    v, exact_v = (np.reshape(finer.at(q)[:2, 0], (2, -1)).T for q in (every[finer.kept], exact.q))
    velocity = relative(finer.weights.ravel(), v - exact_v, exact_v)
    return {"K": np.array([state.K/exact.K - 1]), "velocity": velocity}


@dataclass(frozen=True, kw_only=True)
class SpectralRace(Race):
    """All of the way to a steady state, without steps in time; the resolution is functions along an axis."""

    @property
    def cost(self) -> float:
        return 3 + 5e-8*self.resolution**6      # three for the exact answer, once in a process

    def run(self, report: Report, folder: Path) -> Outcome:
        ra, n = self.entry.flow.ra, self.resolution
        state, more = solved(ra, n), next(finer for most, finer in FINER.items() if n <= most)
        exact, fewer = solved(ra, more), solved(ra, more - 4)
        uncertain = {name: rms(residual) for name, residual in apart(fewer, exact).items()}
        errors = list(self.errors(Result(apart(state, exact), uncertain), 0.0))
        report(0.5)
        seconds = of_calls(partial(solved.__wrapped__, ra, n))
        row = {**self.columns, "points": n**2, "of_limit": 1.0, "dt": np.nan, "steps": len(state.changes),
               **with_err(run_s=seconds, setup_s=Measured(0.0))}
        return Outcome({"errors": errors, "runs": [row]})
