"""Sod's shock tube by the grid, by fixed and by moving points, judged; limits are smooth particles' where these have some."""
from typing import Any

import numpy as np
import pandas as pd

from studies.build.read import Value, over_seeds, select
from studies.hardcases.read import column
from studies.hardcases.tube.methods import METHODS
from studies.hardcases.tube.runs import BARELY, CELL_NUMBER, ETAS, FINE, PLACES, STEPS
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.ordering.derive import line

VISCOUS = max(ETAS)
LONG, SHORT = STEPS
WORDS = {"grid": "compressible grid", "fixed lattice": "fixed points on a lattice",
         "fixed jittered": "fixed points, jittered", "moving": "moving points with closed faces"}


def longest(tables: Tables, **where: Any) -> pd.DataFrame:
    """Rows of the longest tubes, all of which came to their end."""
    rows = select(tables, "method_tubes", **where)
    rows = rows[rows["L"] == rows["L"].max()]
    if (rows["reached"] < 1).any():
        raise CannotTell(f"the run ended at {rows['reached'].min():.2g} of its time")
    return rows


def mean(values: pd.Series) -> Measured:
    """Over seeds; what knows no seed has no scatter."""
    return over_seeds(values.tolist()) if len(values) > 1 else Measured(float(values.iloc[0]), 0.0)


def largest(names: tuple[str, ...], step: float = LONG, **where: Any) -> Value:
    """The largest of some columns' |means over seeds| in the longest tubes."""
    def value(tables: Tables) -> Measured:
        rows = longest(tables, step=step, **where)
        found = [mean(rows[name].abs()) for name in names]
        if any(np.isnan(one.value) for one in found):
            raise CannotTell(f"there is no {' or '.join(names)} to tell")
        return max(found, key=lambda one: one.value)
    return value


def stopped(step: float = LONG, **where: Any) -> Value:
    """Tubes that did not come to their end."""
    def value(tables: Tables) -> Measured:
        return Measured(float((select(tables, "method_tubes", step=step, **where)["reached"] < 1).sum()), 0.0)
    return value


def as_the_fluid(method: str) -> Value:
    """Order of the error of v over that of the fine grid as viscous, both against the exact solution."""
    def value(tables: Tables) -> Measured:
        one, other = (select(tables, "method_tubes", method=name, eta=VISCOUS, step=LONG).groupby("L")["v_exact"].mean()
                      for name in (method, FINE))
        ratio = (one/other).dropna()
        if len(ratio) < 3:
            raise CannotTell("three lengths at least tell an order")
        return Measured(*line(-np.log(ratio.index.to_numpy(float)), np.log(ratio.to_numpy())))
    return value


def order(method: str, quantity: str, eta: float = VISCOUS, step: float = LONG) -> Value:
    """Of mean errors in 1/L."""
    return column("method_tube_orders", "order", "order_err", method=method, eta=eta, step=step, quantity=quantity)


def of(method: str, words: str) -> tuple[Claim, ...]:
    """What is claimed of each method, at the step that was chosen first."""
    key, thick = method.replace(" ", "-"), f"eta = k = {VISCOUS:g}"
    return (
        Claim(id=f"sod-{key}-robust", source="Sod 1978", at_most=0, because="none", value=stopped(method=method, eta=0.0),
              statement=f"{words}: Sod's shock is taken without any viscosity: tubes that ended before their time"),
        Claim(id=f"sod-{key}-order", source="Sod 1978", at_least=0.8, value=order(method, "v"),
              statement=f"{words}, {thick}: v converges on the exact solution as the tube gets longer: order of the mean error "
                        "in 1/L",
              because="shocks are some spacings wide, however long the tube: first order, and 0.2 for heads of rarefactions"),
        Claim(id=f"sod-{key}-grid", source="Sod 1978", at_most=0.01,
              value=largest(("rho_grid", "v_grid", "P_grid"), method=method, eta=VISCOUS),
              statement=f"{words}, {thick}: density, velocity and pressure are those of a fine grid as viscous: largest mean "
                        "difference over its range, longest tube", because="1 %, as is asked of smooth particles"),
        Claim(id=f"sod-{key}-places", source="Sod 1978", at_most=1.0,
              value=largest(tuple(f"{place}_grid" for place in PLACES), method=method, eta=VISCOUS),
              statement=f"{words}, {thick}: shock and contact are where a fine grid as viscous has them: the larger distance in "
                        "spacings, longest tube",
              because="what conserves puts jumps where they belong, within what a spacing resolves"),
        *(Claim(id=f"sod-{key}-rings{name}", source="Sod 1978", at_most=0.1, value=largest(("wiggles",), method=method, eta=eta),
                statement=f"{words}{said}: variation of v beyond that of the exact solution, over it, longest tube",
                because=why)
          for name, eta, said, why in (
              ("", BARELY, f": nothing rings if v a/nu of the contact's velocity behind the shock is {CELL_NUMBER:g}",
               "central differences keep order below a cell number of 2; a tenth is no ringing, as for smooth particles"),
              ("-viscous", VISCOUS, f", {thick}: nothing rings", "a tenth is no ringing, as for smooth particles"))))


def later(method: str, words: str) -> tuple[Claim, ...]:
    """What was asked after runs had ended at this step and orders had fallen short."""
    key, thick = method.replace(" ", "-"), f"eta = k = {VISCOUS:g}"
    quarter = "[asked after runs had ended at four times this step]"
    return (
        Claim(id=f"sod-{key}-robust-short", source="Sod 1978", at_most=0, because="none",
              value=stopped(SHORT, method=method, eta=0.0),
              statement=f"{words}: Sod's shock is taken without any viscosity in steps of an eighth of the limit at the start: "
                        f"tubes that ended before their time {quarter}"),
        Claim(id=f"sod-{key}-robust-barely", source="Sod 1978", at_most=0, because="none",
              value=stopped(SHORT, method=method, eta=BARELY),
              statement=f"{words}: Sod's shock is taken at a cell number of {CELL_NUMBER:g} behind it, in steps of an eighth of "
                        f"the limit at the start: tubes that ended before their time {quarter}"),
        Claim(id=f"sod-{key}-order-fluid", source="Sod 1978", expect=0, within=0.1, value=as_the_fluid(method),
              statement=f"{words}, {thick}: v converges on the frictionless solution as fast as that of a viscous gas does: "
                        "order of its mean error over that of a fine grid [asked after orders had fallen short of 0.8]",
              because="a tenth of an order is what five lengths tell"),
        Claim(id=f"sod-{key}-order-grid", source="Sod 1978", at_least=0.8, value=order(method, "v_grid"),
              statement=f"{words}, {thick}: v converges on that of a fine grid as viscous as the tube gets longer: order of the "
                        "mean difference in 1/L [asked after orders against the exact solution had fallen short]",
              because="first order at least: what is off at the start, within some spacings, is a part of the tube as 1/L"))


CLAIMS = tuple(claim for ask in (of, later) for method, words in WORDS.items() for claim in ask(method, words))
assert set(WORDS) == set(METHODS)
