"""Sod's shock tube by the grid, by fixed and by moving points, judged; limits are smooth particles' where these have some."""
from typing import Any

import numpy as np
import pandas as pd

from studies.convection.claims.read import Value, over_seeds, select
from studies.hard.read import column
from studies.hard.tube_methods import METHODS
from studies.hard.tubes import BARELY, CELL_NUMBER, ETAS, PLACES
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

VISCOUS = max(ETAS)
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


def largest(names: tuple[str, ...], **where: Any) -> Value:
    """The largest of some columns' |means over seeds| in the longest tubes."""
    def value(tables: Tables) -> Measured:
        rows = longest(tables, **where)
        found = [mean(rows[name].abs()) for name in names]
        if any(np.isnan(one.value) for one in found):
            raise CannotTell(f"there is no {' or '.join(names)} to tell")
        return max(found, key=lambda one: one.value)
    return value


def stopped(**where: Any) -> Value:
    """Tubes that did not come to their end."""
    def value(tables: Tables) -> Measured:
        return Measured(float((select(tables, "method_tubes", **where)["reached"] < 1).sum()), 0.0)
    return value


def of(method: str, words: str) -> tuple[Claim, ...]:
    """What is claimed of each method."""
    key = method.replace(" ", "-")
    return (
        Claim(id=f"sod-{key}-robust", source="Sod 1978", at_most=0, because="none", value=stopped(method=method, eta=0.0),
              statement=f"{words}: Sod's shock is taken without any viscosity: tubes that ended before their time"),
        Claim(id=f"sod-{key}-order", source="Sod 1978", at_least=0.8,
              value=column("method_tube_orders", "order", "order_err", method=method, eta=VISCOUS, quantity="v"),
              statement=f"{words}, eta = k = {VISCOUS:g}: v converges on the exact solution as the tube gets longer: order of "
                        "the mean error in 1/L",
              because="shocks are some spacings wide, however long the tube: first order, and 0.2 for heads of rarefactions"),
        Claim(id=f"sod-{key}-grid", source="Sod 1978", at_most=0.01,
              value=largest(("rho_grid", "v_grid", "P_grid"), method=method, eta=VISCOUS),
              statement=f"{words}, eta = k = {VISCOUS:g}: density, velocity and pressure are those of a fine grid as viscous: "
                        "largest mean difference over its range, longest tube", because="1 %, as is asked of smooth particles"),
        Claim(id=f"sod-{key}-places", source="Sod 1978", at_most=1.0,
              value=largest(tuple(f"{place}_grid" for place in PLACES), method=method, eta=VISCOUS),
              statement=f"{words}, eta = k = {VISCOUS:g}: shock and contact are where a fine grid as viscous has them: the "
                        "larger distance in spacings, longest tube",
              because="what conserves puts jumps where they belong, within what a spacing resolves"),
        Claim(id=f"sod-{key}-rings", source="Sod 1978", at_most=0.1, value=largest(("wiggles",), method=method, eta=BARELY),
              statement=f"{words}: nothing rings if v a/nu of the contact's velocity behind the shock is {CELL_NUMBER:g}: "
                        "variation of v beyond that of the exact solution, over it, longest tube",
              because="central differences keep order below a cell number of 2; a tenth is no ringing, as for smooth particles"))


CLAIMS = (*(claim for method in METHODS for claim in of(method, WORDS[method])),
          *(Claim(id=f"sod-{method.replace(' ', '-')}-rings-viscous", source="Sod 1978", at_most=0.1,
                  value=largest(("wiggles",), method=method, eta=VISCOUS),
                  statement=f"{WORDS[method]}, eta = k = {VISCOUS:g}: nothing rings: variation of v beyond that of the exact "
                            "solution, over it, longest tube", because="a tenth is no ringing, as for smooth particles")
            for method in METHODS))
