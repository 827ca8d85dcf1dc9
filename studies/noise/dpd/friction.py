"""What Eqs 40, 41 add to kT of dissipative particles, from the friction that the fluid has; judged below    [RR98 Eqs 40, 41]

Friction Lambda that is taken at the start of a step puts in dt kT Lambda^2 more than it takes out: with covariances C = kT +
delta of velocities, d delta/dt = -Lambda delta - delta Lambda + dt kT Lambda^2. If repulsion turns velocities round faster than
friction slows them, delta is the same for all, dt kT <Lambda^2>/(2 <Lambda>); if nothing does, its mean is dt kT <Lambda>/2. Here
both are of the places that particles with a = 25 have, not of points without order.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from particles.dissipative.integrators import Shardlow
from particles.pairs import nothing, rate
from particles.run import run
from studies.build.read import Value, select
from studies.kit.case import Outcome, Report
from studies.kit.claim import Claim
from studies.kit.stats import Measured, combine
from studies.kit.table import Table, Tables
from studies.noise.dpd.runs import BATCHES, Fluid

KEY = ["a", "rho", "side", "dt"]
#: <Lambda>, by tr Lambda/(3 n); still = <Lambda>/2 and mixed = <Lambda^2>/(2 <Lambda>): relative errors of kT over dt
FRICTION = Table("friction", key=KEY, columns=[*KEY, "n", "time", "friction", "friction_err", "still", "still_err", "mixed",
                                               "mixed_err"])
ALL = (FRICTION,)


class Squares(NamedTuple):
    """Of a particle with itself xx, yy, zz, xy, yz, zx of G = gamma w^2 e e; trace of the squares of its blocks with others."""


@rate.of(Squares)
def _(term, a, b, ab):
    x, y, z = ab.dx, ab.dy, ab.dz
    own = ab.g*(x*x + y*y + z*z)
    return ab.g*x*x, ab.g*y*y, ab.g*z*z, ab.g*x*y, ab.g*y*z, ab.g*z*x, own*own


nothing.of(Squares)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def traces(sums: Any, state: np.ndarray) -> np.ndarray:
    """tr Lambda and tr Lambda^2, a particle and direction."""
    found = sums.over_pairs(Squares(), state, 7)
    square = (found[:, :3]**2).sum() + 2*(found[:, 3:6]**2).sum() + found[:, 6].sum()
    return np.array([found[:, :3].sum(), square])/(3*sums.n)


@dataclass(frozen=True, kw_only=True)
class Friction(Fluid):
    """Both predictions, in batches."""

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.method(), self.settled(self.method())
        kept = [(f"{k}", lambda sums, state, k=k: float(traces(sums, state)[k])) for k in (0, 1)]
        done, n = run(method, start, self.plan(series=dict(kept)), report), start.shape[1]
        one, two = (np.array([part.mean() for part in np.array_split(done.series[name], BATCHES)]) for name, _ in kept)
        row = {"a": self.a, "rho": n/method.volume, "side": self.side, "dt": self.dt, "n": n, "time": self.time,
               "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        for name, values in (("friction", one), ("still", one/2), ("mixed", two/one/2)):
            row[name], row[f"{name}_err"] = combine([(float(value), 0.0) for value in values])
        return Outcome({"friction": [row]})


def cases(*, side: float, time: float) -> list[Friction]:
    """Of the fluid, and without repulsion."""
    return [Friction(integrator=Shardlow, dt=0.01, a=a, side=side, time=time) for a in (25.0, 0.0)]


# --- judged -----------------------------------------------------------------------------------------------------------------


def over(limit: str) -> Value:
    """Linear coefficient of the error of kT with Eqs 40, 41 at a = 25 over one of the predictions."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "errors", integrator="TwoStep", a=25.0, temperature="kinetic").iloc[0]
        due = float(select(tables, "friction", a=25.0).sort_values("n").iloc[-1][limit])
        return Measured(float(row["linear"])/due, float(row["linear_err"])/due)
    return value


CLAIMS = tuple(
    Claim(id=f"own-two-step-dpd-fluid-{limit}", source="RR98 Eqs 40, 41", expect=1, within=0.2, value=over(limit),
          statement=f"relative error of kT over dt, for small steps at a = 25, over {words}, with the friction of the fluid's "
                    "own places, which are no points without order; read after the runs",
          because="20 %: 14 % is what chance leaves of the linear coefficient")
    for limit, words in (("still", "half of a particle's rate of friction"),
                         ("mixed", "<Lambda^2>/(2 <Lambda>), as repulsion turns velocities round at once")))
