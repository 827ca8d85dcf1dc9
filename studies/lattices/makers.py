"""Does the law of lost convection hold for what people use today? What friction leaves over, and K from it.

A law with a power is fitted where every run has an excess that is told from none, else that of a viscosity,
q = 1, C the mean excess over friction. The steps to K are those of `loss`; odd images do not slip.
"""
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.interpolate import PchipInterpolator

from particles.run import Run
from studies.build import spam
from studies.kit.csvfile import read
from studies.kit.fits import power_law
from studies.kit.stats import Measured, with_errors
from studies.kit.store import RESULTS
from studies.kit.table import Row, Rows, Tables, groups
from studies.lattices import loss
from studies.lattices.stirred import Driven, Push, Stirred

MAKERS = ("sph", "riemann", "sumB", "RKGC", "bonet-lok", "corrected", "CRKSPH", "MFM", "MFM-adiabatic")
RA, FORCES = 10_000.0, (0.1, 0.2, 0.4)


class OfToday(Push):
    """Sums with the force; which stress their pressure makes is not asked."""

    def tensor(self) -> np.ndarray:
        return np.zeros((3, len(self.around.x)))


#: transport -> the same with a force
PUSHED = {kind: type(kind.__name__, (OfToday, kind), {name: getattr(kind, name) for name in (
    "allocate", "prepare", "exchange", "gradients", "symbol")}) for kind in (
        spam.TODAY[name].transport for name in MAKERS)}


@dataclass(frozen=True, kw_only=True)
class StirredMaker(Stirred):
    """Vortices of today's smooth particles."""

    @property
    def pushed(self) -> type:
        return PUSHED[self.variant.transport]

    def row(self, method: Driven, done: Run) -> Row:
        return {**super().row(method, done), "stress": np.nan, "stress_err": np.nan}


def cases() -> Iterator[StirredMaker]:
    """Three forces each."""
    for name in MAKERS:
        for U in FORCES:
            yield StirredMaker(variant=spam.TODAY[name], rows=25, U=U)


def law(runs: pd.DataFrame) -> Row:
    """C, q of one maker."""
    told = (runs["excess"] > runs["excess_err"]).all()
    J, tau = runs["friction"]/runs["P"], runs["excess"]/runs["P"]
    fit = power_law(J, tau) if told else None
    q = fit.slope if fit else Measured(1.0, 0.0)
    C = Measured(float(np.exp(fit.intercept.value)), 0.0) if fit else Measured(float((tau/J).mean()), 0.0)
    scatter = float(np.sqrt(np.mean(fit.residuals**2))) if fit else float((tau/J).std())
    C = C/loss.projected(q.value) if fit else C
    return {"scatter": scatter, "runs": len(runs), **with_errors(C=C, q=q)}


def thickness(layer: pd.DataFrame, found: Row) -> tuple[float, float]:
    """(x, K over that of the grid); of a viscosity x = 1 + C, which may be less than 1."""
    if found["q"] != 1:
        return loss.thickness(layer, loss.Law(found["C"], found["q"], 0.0), 1.0)
    ke, x = layer.groupby("thick")["ke"].first(), 1 + found["C"]
    return x, float(np.exp(PchipInterpolator(ke.index, np.log(ke/ke.iloc[0]))(x)))


def derive(tables: Tables) -> Rows:
    """Laws and K of `loss`, and those of today's makers besides."""
    rows = {name: list(some) for name, some in loss.derive(tables).items()}
    if not rows:
        return {}
    driven = tables["driven"].query("mode == 'stirred' and variant in @MAKERS and U in @FORCES")
    measured = read(RESULTS/"rb"/"errors.csv").query("method == 'spam' and energy == 'Kg' and ra == @RA")
    layer = tables["thickened"].query("ra == @RA")
    for name, runs in groups(driven, "variant"):
        found = law(runs)
        rows["laws"].append({"variant": name, **found})
        for one in measured[measured["variant"] == name].to_dict("records"):
            x, K = thickness(layer, found)
            kept = {"predicted": Measured(K, 0.0), "measured": Measured(1 + one["error"], one["error_err"])}
            key = {"variant": name, "ra": RA, "rows": one["resolution"]}
            rows["foretold"].append(key | {"x": x, "slip": 0.0, "bulk": K, **with_errors(**kept)})
    return rows
