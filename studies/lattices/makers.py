"""The law of lost convection for today's smooth particles: the excess over friction, and K predicted from it.

A power law is fitted where the excess of every run differs from zero. Elsewhere the excess is a viscosity:
q = 1, C the mean excess over friction. The steps to K are those of `loss`; odd images do not slip.
"""
import numpy as np
import pandas as pd

from studies.kit.fits import power_law
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row, Rows, Tables, groups
from studies.lattices import loss
from studies.lattices.push import MAKERS

RA = 10_000.0


def law(runs: pd.DataFrame) -> Row:
    """A row of the table `laws`: C, q of one method."""
    J, tau = runs.friction/runs.P, runs.excess/runs.P
    C, q, scatter = (tau/J).mean(), Measured(1.0), (tau/J).std()
    if (runs.excess > runs.excess_err).all():
        fit = power_law(J, tau)
        q, scatter = fit.slope, np.sqrt(np.mean(fit.residuals**2))
        C = np.exp(fit.intercept.value)/loss.projected(q.value)
    return {"scatter": scatter, "runs": len(runs), **with_errors(C=Measured(C), q=q)}


def thickness(layer: pd.DataFrame, found: Row) -> tuple[float, float]:
    """(x, K over that of the grid); if the excess is a viscosity, x = 1 + C, which may be less than 1."""
    if found["q"] != 1:
        return loss.thickness(layer, loss.Law(found["C"], found["q"], 0.0), 1.0)
    x = 1 + found["C"]
    return x, loss.thicker(layer, x)


def derive(tables: Tables) -> Rows:
    """Derived rows of the study: laws and K of `loss`, and those of today's smooth particles."""
    rows = {name: list(some) for name, some in loss.derive(tables).items()}
    if not rows:
        return {}
    driven = tables["driven"].query("mode == 'stirred'")
    measured = loss.measured().query("ra == @RA")
    layer = tables["thickened"].query("ra == @RA")
    for name, runs in groups(driven[driven.variant.isin(MAKERS)], "variant"):
        found = law(runs)
        x, K = thickness(layer, found)
        rows["laws"].append({"variant": name, **found})
        for _, one in measured[measured.variant == name].iterrows():
            known = with_errors(predicted=Measured(K), measured=Measured(1 + one.error, one.error_err))
            rows["foretold"].append({"variant": name, "ra": RA, "rows": one.resolution, "x": x, "slip": 0.0,
                                     "bulk": K, **known})
    return rows
