"""Tables of the study ordering, and rows derived from them: means over seeds, slopes, the cost of 1 %.

Lengths in spacings; errors relative; `_err`: half of the 95 % interval.
"""
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from particles.integral.interpolants import moment
from particles.weights import Lucy
from studies.build.measure import limit
from studies.kit.fits import crossing, power_law
from studies.kit.stats import Measured, seed_means, with_errors
from studies.kit.table import Row, Rows, Table, Tables
from studies.ordering.runs import FORMS

#: rms width of Lucy's weight in 2D, RR98's r0, over its range
WIDTH = float(np.sqrt(moment(Lucy.of(h=1.0, d=2), 3, 2)/4))

POINT = "maker h points wavelength"
OPERATORS = Table.of("operators", f"{POINT} seed", "gradient laplacian closure linear",
                     about="A plane wave on one set of points.")
MEANS = Table.of("means", POINT, "seeds gradient gradient_err laplacian laplacian_err",
                 about="The same, means over seeds.")
SLOPES = Table.of("slopes", "maker points operator fixed at", "slope slope_err floor",
                  about="How these errors change with h over the wavelength.",
                  means={"operator": ("gradient or laplacian", "")})
BRACKETS = Table.of("brackets", "h points wavelength seed", "single sum difference",
                    about="The gradient of a plane wave by plain quadrature in three forms.")
BRACKET_MEANS = Table.of("bracket_means", "h points wavelength form", "seeds error error_err",
                         about="The same, means over seeds.")
BRACKET_SLOPES = Table.of("bracket_slopes", "points form", "slope slope_err",
                          about="How these errors change with h over the wavelength at h = 3 a.")
VORTICES = Table.of("vortices", f"{POINT} seed", "velocity exchanges",
                    about="A Taylor-Green vortex that has decayed by e; no numbers where the run diverged.")
CONVECTION = Table.of("convection", "maker h points rows seed",
                      "ke ke_err nu nu_err rolls converged exchanges",
                      about="Rayleigh-Benard convection at Ra 10 000: its end; no numbers where it diverged.")
REFERENCE = Table.of("reference", "flow", "ke ke_err", about="K of the grid of the study rb, extrapolated.")
SERIES = "flow maker h points"
SPACINGS = "spacings to the wavelength (taylor-green) or to the height (convection)"
FLOWS = Table.of("flows", f"{SERIES} resolution", "seeds lost error error_err exchanges",
                 about="Means over seeds: a point of the error surface.",
                 means={"resolution": (SPACINGS, ""), "lost": ("seeds without a number", ""),
                        "error": ("error of the velocity of vortices, of K of convection with sign", "")})
FLOW_SLOPES = Table.of("flow_slopes", "flow maker points fixed at", "slope slope_err",
                       about="How these errors change with the spacing or the range, all runs in one fit.",
                       means={"slope": ("d ln |error|/d ln of a at fixed h/a, of h at fixed a", "")})
CHEAPEST = Table.of("cheapest", SERIES, "needed needed_err exchanges bound finest",
                    about="What an error of 1 % costs; no numbers where no run is that good.",
                    means={"needed": (f"least number of {SPACINGS} from which on the error is below 1 %", ""),
                           "exchanges": ("exchanges over edges at that resolution", "")})

ALL = (OPERATORS, MEANS, SLOPES, BRACKETS, BRACKET_MEANS, BRACKET_SLOPES, VORTICES, CONVECTION, REFERENCE,
       FLOWS, FLOW_SLOPES, CHEAPEST)

# --- derived rows -------------------------------------------------------------------------------------------

WIDE = 2.0          # spacings: ranges from which on errors are a power of the range
WAVES = 4           # least number of wavelengths for a slope
RESOLUTIONS = 3     # the same for slopes of flows, and of forms of the gradient
WANTED = 0.01       # the error at which costs are compared
FLOW_POINT = list(FLOWS.key)


def derive(tables: Tables) -> Rows:
    """Derived rows of the study."""
    rows = of_flows(tables) if "vortices" in tables or "convection" in tables else {}
    if "operators" in tables:
        rows |= of_operators(tables["operators"])
    if "brackets" in tables:
        rows |= of_brackets(tables["brackets"])
    return rows


def slopes(rows: pd.DataFrame, key: Sequence[str], x: str, least: int) -> Iterator[Row]:
    """d ln error/d ln x of each group with at least `least` values of x."""
    for values, group in rows.groupby(list(key)):
        if group[x].nunique() >= least:
            yield dict(zip(key, values)) | with_errors(slope=power_law(group[x], group.error).slope)


def of_operators(rows: pd.DataFrame) -> dict[str, Any]:
    """Means and slopes of errors of gradients and Laplacians: over wavelengths, over ranges from WIDE on."""
    operators, key = ["gradient", "laplacian"], list(SLOPES.key)
    means = list(seed_means(rows.dropna(subset="gradient"), MEANS.key, operators))
    errors = pd.DataFrame(means).melt(MEANS.key, operators, "operator", "error")
    errors = at_fixed(errors.assign(ratio=errors.h/errors.wavelength), "wavelength")
    floors = errors.groupby(key).error.min()
    known = [row | {"floor": floors[tuple(row[name] for name in key)]}
             for row in slopes(errors, key, "ratio", WAVES)]
    return {"means": means, "slopes": known}


def at_fixed(errors: pd.DataFrame, resolution: str) -> pd.DataFrame:
    """Each row as one at fixed h/a and, if its range is wide, also as one at fixed spacing."""
    wide = errors.query("h >= @WIDE")
    return pd.concat([errors.assign(fixed="h/a", at=errors.h), wide.assign(fixed="a", at=wide[resolution])])


def of_brackets(rows: pd.DataFrame) -> dict[str, Any]:
    """Means and slopes of errors of gradients in three forms; slopes at h = 3 a."""
    errors = rows.melt(BRACKETS.key, FORMS, "form", "error")
    means = list(seed_means(errors, BRACKET_MEANS.key, ["error"]))
    series = pd.DataFrame(means).query("h == 3")
    series = series.assign(ratio=1/series.wavelength)
    return {"bracket_means": means,
            "bracket_slopes": list(slopes(series, BRACKET_SLOPES.key, "ratio", RESOLUTIONS))}


def of_flows(tables: Tables) -> dict[str, Any]:
    """Rows derived from vortices (errors of velocity) and from convection (errors of K)."""
    ke, parts = Measured(limit("ke"), limit("ke_err")), []
    if "vortices" in tables:
        vortices = tables["vortices"].rename(columns={"wavelength": "resolution", "velocity": "error"})
        parts.append(vortices.assign(flow="taylor-green", error_err=0.0))
    if "convection" in tables:
        parts.append(convection(tables["convection"], ke.value))
    runs = pd.concat(parts, ignore_index=True)
    means = flow_means(runs)
    return {"reference": [{"flow": "convection", **with_errors(ke=ke)}], "flows": means.to_dict("records"),
            "flow_slopes": list(flow_slopes(runs, means)), "cheapest": list(cheapest(means))}


def convection(rows: pd.DataFrame, ke: float) -> pd.DataFrame:
    """Errors of K, uncertain by the change in the last tenth of a run; nan if a run ends in other rolls."""
    error = (rows.ke/ke - 1).where(rows.rolls == 2)
    rows = rows.assign(flow="convection", error=error, error_err=rows.ke_err/ke)
    return rows.rename(columns={"rows": "resolution"})


def flow_means(runs: pd.DataFrame) -> pd.DataFrame:
    """Means over seeds, one row for each point of the error surface."""
    there = seed_means(runs.dropna(subset="error"), FLOW_POINT, ["error"])
    errors = pd.DataFrame(there, columns=[*FLOW_POINT, "error", "error_err"])
    points = runs.groupby(FLOW_POINT, as_index=False)
    means = points.agg(seeds=("seed", "size"), known=("error", "count"), exchanges=("exchanges", "mean"))
    means["lost"] = means.seeds - means.pop("known")
    return means.merge(errors, on=FLOW_POINT, how="left")


def flow_slopes(runs: pd.DataFrame, means: pd.DataFrame) -> Iterator[Row]:
    """Slopes over resolutions and ranges, of points where no seed is lost and the error differs from zero."""
    sure = means.query("lost == 0 and abs(error) > error_err")
    runs = runs.merge(sure[FLOW_POINT], on=FLOW_POINT)
    runs = at_fixed(runs.assign(spacing=1/runs.resolution), "resolution")
    for fixed, x in (("h/a", "spacing"), ("a", "h")):
        yield from slopes(runs[runs.fixed == fixed], FLOW_SLOPES.key, x, RESOLUTIONS)


def cheapest(means: pd.DataFrame) -> Iterator[Row]:
    """What an error of 1 % costs in each series: where errors fall below it for good."""
    means = means.assign(error=means.error.abs()).sort_values("resolution")
    for values, group in means.groupby(list(CHEAPEST.key)):
        yield dict(zip(CHEAPEST.key, values)) | needed(group) | {"finest": group.error.iloc[-1]}


def needed(group: pd.DataFrame) -> dict[str, float]:
    """Resolution and exchanges for 1 % in one series, by power laws between a row above and one below it.

    Errors have no sign. There are no numbers where 1 % was not reached.
    """
    above = np.flatnonzero(~(group.error <= WANTED) | (group.lost > 0))
    if not len(above):
        first = group.iloc[0]
        return {"needed": first.resolution, "needed_err": np.nan, "exchanges": first.exchanges, "bound": 1}
    pair = group.iloc[above[-1]:above[-1] + 2]
    if len(pair) < 2 or not np.isfinite(pair.error.iloc[0]):
        return {"bound": 0}
    pair = pair.assign(resolution_err=0.0, exchanges_err=0.0)
    resolution, half = crossing(pair, "resolution", WANTED)
    exchanges, _ = crossing(pair, "exchanges", WANTED)
    return {"needed": resolution, "needed_err": resolution*half, "exchanges": exchanges, "bound": 0}
