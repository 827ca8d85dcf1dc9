"""Sod's shock tube by the grid, by fixed and by moving points: errors against the exact solution, ringing, or where a run ends.

Viscosities in units of spacing and density 1, eta = k, chosen beforehand and for all methods alike: nothing; what makes the
contact's velocity a cell number of 2 behind the shock, v a/nu, beyond which central differences are expected to ring; and the
one that smooth particles were given. nu/(c a) of the dense gas is 0, 0.11 and 0.42.

Steps are half of the limit at the start, since v + c behind the shock is 1.85 times c of the dense gas. Runs ended that a quarter
of this step brought to their end: all were made again with it, to tell the scheme's end from the step's.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from continuum.exact.riemann import middle
from continuum.fluid import ConstEta
from studies.hardcases.tube.methods import METHODS, Seen
from studies.hardcases.tube.spam import DENSE, END, GAMMA, NAMES, THIN, exact
from studies.hardcases.tube.spam import grid as fine
from studies.kit.case import Case, Outcome, Report
from studies.kit.table import Table, Tables
from studies.ordering.derive import line

BETWEEN = middle(DENSE, THIN, GAMMA)
CELL_NUMBER = 2.0
BARELY = round(BETWEEN.v*BETWEEN.right/CELL_NUMBER, 3)      # 0.123
ETAS = (0.0, BARELY, 0.5)
LENGTHS = (24, 36, 48, 72, 96)
RANDOM = ("fixed jittered", "moving")       # whose points lie as a seed says
PLACES = ("shock", "contact")

STEPS = (0.5, 0.125)                        # over the limit at the start
FINE = "fine grid"                          # what a fluid as viscous does

TUBE = ["method", "eta", "step", "L", "seed"]
ERRORS = [f"{name}_{of}" for of in ("exact", "grid") for name in NAMES]
#: mean |error| over the range of the exact solution, against it and against the fine grid as viscous; places of shock and contact
#: less those of the exact solution and of the fine grid, spacings; variation of v beyond that of the exact one; rms v across the
#: tube over the contact's v; part of the time that was reached
METHOD_TUBES = Table("method_tubes", key=TUBE, columns=[*TUBE, *ERRORS, *(f"{place}_{of}" for of in ("exact", "grid")
                                                                          for place in PLACES), "wiggles", "noise", "reached"])
#: x: from the diaphragm, over L
METHOD_PROFILES = Table("method_tube_profiles", key=[*TUBE, "x"], columns=[*TUBE, "x", *NAMES],
                        digits=dict.fromkeys(("x", *NAMES), ".5g"), once=TUBE)
#: order: -d ln error/d ln L, against the exact solution, and of quantities `_grid` against the fine grid as viscous
METHOD_ORDERS = Table("method_tube_orders", key=["method", "eta", "step", "quantity"],
                      columns=["method", "eta", "step", "quantity", "order", "order_err", "lengths"])
TABLES = (METHOD_TUBES, METHOD_PROFILES, METHOD_ORDERS)


@dataclass(frozen=True, kw_only=True)
class MethodTube(Case):
    """One tube. L : half of its length, spacings. eta : viscosity and conductivity. step : over the limit at the start.

    keep : whether profiles go to the table.
    """
    method: str
    L: int
    eta: float
    seed: int = 1
    step: float = STEPS[0]
    keep: bool = False

    @property
    def cost(self) -> float:
        return {"moving": 1e-3}.get(self.method, 1e-4)*self.L**2/self.step + 1

    @property
    def label(self) -> str:
        return f"tube of {self.method}, L {self.L}, eta {self.eta:g}, seed {self.seed}, step {self.step:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        point = {"method": self.method, "eta": self.eta, "step": self.step, "L": self.L, "seed": self.seed}
        found = (Seen(viscous(self.L, self.eta), 0.0) if self.method == FINE else
                 METHODS[self.method](self.L, ConstEta(self.eta, self.eta), self.seed, self.step, report))
        profiles = [{**point, "x": at/self.L - 1, **dict(zip(NAMES, values, strict=True))}
                    for at, values in zip(centres(self.L), found.fields.T, strict=True)]
        return Outcome({"method_tubes": [{**point, **told(self.L, self.eta, found)}],
                        "method_tube_profiles": profiles if self.keep and found.reached == 1 else []})


def centres(L: int) -> np.ndarray:
    """(2 L,) of cells of one spacing."""
    return np.arange(2*L) + 0.5


@cache
def viscous(L: int, eta: float) -> np.ndarray:
    """(3, 2 L): the fine grid's fields."""
    return fine(L, ConstEta(eta, eta), centres(L)) if eta else np.full((3, 2*L), np.nan)


def told(L: int, eta: float, found: Seen) -> dict[str, float]:
    """Columns of a row; errors are not known where a run ended or nothing is viscous."""
    x, values = centres(L), found.fields
    truth = exact(L, x)
    row = {"reached": found.reached, "noise": found.across/BETWEEN.v,
           "wiggles": float(np.abs(np.diff(values[1])).sum()/np.abs(np.diff(truth[1])).sum() - 1)}
    for of, other in (("exact", truth), ("grid", viscous(L, eta) if found.reached == 1 else np.full_like(truth, np.nan))):
        errors = np.abs(values - other).mean(axis=1)/np.ptp(truth, axis=1)
        row |= {f"{name}_{of}": float(error) for name, error in zip(NAMES, errors, strict=True)}
        row |= {f"{place}_{of}": at - there for place, at, there in zip(PLACES, places(x, values), places(x, other), strict=True)}
    return row


def places(x: np.ndarray, fields: np.ndarray) -> tuple[float, float]:
    """Shock, the last place where v is half of the contact's, and contact, the first where rho is the mean of both sides'."""
    if np.isnan(fields).any():
        return np.nan, np.nan
    rho, v, _ = fields
    return last_above(x, v, BETWEEN.v/2), -last_above(-x[::-1], -rho[::-1], -(BETWEEN.left + BETWEEN.right)/2)


def last_above(x: np.ndarray, f: np.ndarray, level: float) -> float:
    """Where f falls below a level for good, between two of its values."""
    above = np.flatnonzero(f > level)
    if not len(above) or above[-1] == len(f) - 1:
        return np.nan
    n = above[-1]
    return float(x[n] + (f[n] - level)/(f[n] - f[n + 1])*(x[n + 1] - x[n]))


def cases(size: str) -> Iterator[Case]:
    """All methods, viscosities and lengths; where points are disordered and the gas most viscous, three seeds."""
    lengths = LENGTHS if size != "quick" else (12, 15, 18)
    for method, eta, step, L in product((*METHODS, FINE), ETAS, STEPS, lengths):
        if method == FINE and (eta == 0 or step != STEPS[0]):
            continue
        for seed in (1, 2, 3) if method in RANDOM and eta == max(ETAS) and size != "quick" else (1,):
            yield MethodTube(method=method, eta=eta, L=L, seed=seed, step=step, keep=L == max(lengths) and seed == 1)


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Orders over the lengths, means over seeds."""
    return {"method_tube_orders": list(orders(tables["method_tubes"]))} if "method_tubes" in tables else {}


def orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Where three lengths at least came to their end."""
    for (method, eta, step), group in rows[rows["reached"] == 1].groupby(["method", "eta", "step"]):
        means = group.groupby("L")[ERRORS].mean()
        means = means.loc[:, (means > 0).all()]
        for name in means if len(means) > 2 else ():
            order, err = line(-np.log(means.index.to_numpy(float)), np.log(means[name].to_numpy()))
            yield {"method": method, "eta": eta, "step": step, "quantity": str(name).removesuffix("_exact"), "order": order,
                   "order_err": err, "lengths": len(means)}


assert END*BETWEEN.v < 1        # the contact stays in its half of the tube
