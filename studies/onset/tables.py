"""Tables of the study onset, and the critical Rayleigh numbers that follow from them.

Ra_c is where a growth rate is zero, or where a line of K over Ra^-1/2 is zero. Growth rates are those of the
velocity, per free-fall time. K has the units of the scene. An `err` is the half width of a 95 % interval, or
a bound where grids are extrapolated. `dT` is divided by the mean temperature; a Boussinesq fluid has 0.
`resolution` is the number of rows over the height, `inf` where it is extrapolated.
"""
from collections.abc import Iterator
from math import inf
from typing import Any

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.stats import Measured, seed_means
from studies.kit.table import Row, Rows, Table, Tables
from studies.onset.runs import LINES

SERIES = "method variant eos transport dT sides pr"
POINT = f"{SERIES} resolution"
GROWTH = Table.of("growth_rates", f"{POINT} way ke_start seed ra", "sigma err",
                  about="The growth rate of rolls at one Ra.",
                  means={"err": ("half width of the 95 % interval of sigma; of a limit a bound", "")})
ENERGIES = Table.of("energies", f"{POINT} share", "ra ke rolls",
                    about="A steady state of the grid; rows with resolution inf have Ra and K extrapolated.",
                    means={"share": ("1 - (Ra_c/Ra)^(1/2), Ra_c of the same grid", "")})
LINE_TABLE = Table.of("lines", f"{POINT} reach lines", "points slope intercept ra_c err residual",
                      about="A line K = slope Ra^-1/2 + intercept through energies up to `reach` Ra_c.",
                      means={"points": ("number of points in the fit", ""),
                             "ra_c": ("Ra where the line is 0", ""),
                             "slope": ("slope of K over Ra^-1/2", "epsilon/m"),
                             "err": ("half width of the 95 % interval of ra_c", "")})
CRITICAL = Table.of("critical_ra", "method quantity",
                    "value err variant eos transport dT sides pr resolution way reach ke_start",
                    about="A critical Rayleigh number.",
                    means={"quantity": ("box, what differs from the ideal gas with constant eta and dT = 1, "
                                        "in brackets how it was found: a limit where no rows are named", ""),
                           "value": ("critical Rayleigh number", "")})

BRANCH = Table.of("branch", "pr width resolution arc", "ra above ke nu off_linear",
                  about="A steady state of the Boussinesq fluid on its branch, from rest (arc 0) on.",
                  means={"arc": ("length of the branch up to here, in amplitudes and (Ra_c/Ra)^(1/2)", ""),
                         "above": ("Ra over that of arc 0, less 1", ""),
                         "width": ("of the box, in heights", ""),
                         "resolution": ("functions along an axis", ""),
                         "off_linear": ("Ra of arc 0 over that of linear theory, less 1", "")})

ALL = (GROWTH, ENERGIES, LINE_TABLE, CRITICAL, BRANCH)

# --- what follows from them ---------------------------------------------------------------------------------

BOX_NAMES = {"periodic": "ra_c periodic aspect 2", "walls": "ra_c square conducting"}
#: what goes without saying in the name of a quantity
USUAL = ("", "printed", "ideal", "const-eta")
BY = SERIES.split()
FOUND = f"{POINT} way reach ke_start".split()
GRIDS = 3       # of an extrapolation, at least; also points of a line, Ra of a zero
DRAWS = 400


def derive(tables: Tables) -> Rows:
    """Rows of `critical_ra`, of `lines`, and of extrapolated `energies`."""
    critical, rows = list[Row](), dict[str, list[Row]]()
    if "growth_rates" in tables:
        critical += from_growth(tables["growth_rates"])
        critical += fine_grids(critical)
    if "energies" in tables:
        grids = tables["energies"].query("resolution < @inf")
        limits = list(extrapolated_energies(grids))
        lines = list(all_lines(pd.concat([grids, pd.DataFrame(limits, columns=grids.columns)])))
        rows = {"energies": limits, "lines": lines}
        critical += [critical_row(line, line["ra_c"], line["err"]) for line in lines]
    return rows | {"critical_ra": critical}


def critical_row(at: Any, value: float, err: float) -> Row:
    """Row of `critical_ra` at the point of a row of `growth_rates` or `lines`."""
    at = pd.Series({"way": "line", "reach": 0.0, "ke_start": 0.0, "lines": "", **at})
    return {**at[FOUND], "quantity": quantity(at), "value": value, "err": err}


def quantity(at: pd.Series) -> str:
    """Name of a critical Ra: the box, what differs from the usual gas, in brackets how it was found."""
    words = [BOX_NAMES[at.sides], *(name for name in (at.variant, at.eos, at.transport) if name not in USUAL)]
    if at.eos and at.dT != 1:
        words.append(f"dT {at.dT:g}")
    ways = ["growth rates"]
    if at.way == "line":
        ways = ["K line" if at.reach == 4 else f"K line to {at.reach:g} Ra_c"]      # 4 is the paper's
    if at.way == "run":
        ways.append(f"run from K = {at.ke_start:g}")
    if at.lines:
        ways.append(at.lines)
    if at.resolution < inf:
        ways.append(f"{at.resolution:.0f} rows")
    return f"{', '.join(words)} ({', '.join(ways)})"


def several(frame: pd.DataFrame, by: str | list[str]) -> list[pd.DataFrame]:
    """Groups with at least GRIDS rows."""
    return [group for _, group in frame.groupby(by, dropna=False) if len(group) >= GRIDS]


def from_growth(rates: pd.DataFrame) -> Iterator[Row]:
    """Ra where the growth rate is zero, for each grid and each start."""
    rates = rates.rename(columns={"err": "sigma_err"})
    for _, runs in rates.groupby([*BY, "way", "ke_start", "resolution"], dropna=False):
        at, means = runs.iloc[0], pd.DataFrame(seed_means(runs, ["ra"], ["sigma"]))
        if len(means) >= GRIDS and means.sigma.min() < 0 < means.sigma.max():
            zero = smooth_zero if at.way == "operator" else nearby_zero
            yield critical_row(at, *zero(means))


def smooth_zero(rates: pd.DataFrame) -> Measured:
    """Zero of exact rates, from the polynomial Ra(sigma) through all of them.

    The error is what the point farthest from the zero changes, and the error of sigma over its slope.
    """
    rates = rates.sort_values("sigma", key=abs)
    ra, sigma = rates[["ra", "sigma"]].to_numpy().T
    value = interpolated(sigma, ra)
    without = interpolated(sigma[:-1], ra[:-1])
    slope = np.diff(ra)[0]/np.diff(sigma)[0]
    return Measured(value, abs(value - without) + rates.sigma_err.max()*abs(slope))


def interpolated(sigma: np.ndarray, ra: np.ndarray) -> float:
    """Lagrange's polynomial Ra(sigma) at sigma = 0."""
    total = 0.0
    for s, r in zip(sigma, ra):
        others = sigma[sigma != s]
        total += r*np.prod(-others/(s - others))
    return total


def nearby_zero(rates: pd.DataFrame) -> Measured:
    """Zero of noisy rates, from straight lines between neighbours: the middle one if noise makes several.

    The error has two parts. One is the scatter of this zero over DRAWS samples with noise as large as the
    errors. The other is what a parabola through the three nearest Ra changes, but at most a quarter of the
    distance of neighbours.
    """
    ra, sigma, err = rates[["ra", "sigma", "sigma_err"]].to_numpy().T
    value = middle_crossing(ra, sigma)
    draws = np.random.default_rng(1).normal(size=(DRAWS, len(ra)))
    samples = [middle_crossing(ra, sigma + noise) for noise in err/2*draws]
    low, high = np.quantile(samples, [0.025, 0.975])
    nearest = np.argsort(np.abs(ra - value))[:3]
    parabola = interpolated(sigma[nearest], ra[nearest])
    bend = min(abs(parabola - value), np.diff(ra).max()/4)
    scatter = max(value - low, high - value)
    return Measured(value, np.hypot(scatter, bend))


def middle_crossing(ra: np.ndarray, sigma: np.ndarray) -> float:
    """Median of the zeros of lines between neighbours; if there is none, the end that is nearer to it."""
    at = np.flatnonzero(sigma[1:]*sigma[:-1] < 0)
    if not len(at):
        return float(ra[0] if sigma.sum() > 0 else ra[-1])
    zeros = ra[at] - sigma[at]*(np.diff(ra)/np.diff(sigma))[at]
    return float(np.median(zeros))


def fine_grids(critical: list[Row]) -> Iterator[Row]:
    """Limits of fine grids, whose errors contain three times the largest error of a grid."""
    grids = pd.DataFrame(critical, columns=list(CRITICAL.columns)).query("way == 'operator'")
    for group in several(grids, BY):
        value, err = fits.grid_limit(group.resolution, group.value)
        yield critical_row(dict(group.iloc[0]) | {"resolution": inf}, value, err + 3*group.err.max())


def extrapolated_energies(energies: pd.DataFrame) -> Iterator[Row]:
    """Ra and K at each share, extrapolated from three grids or more that have the same number of rolls."""
    for grids in several(energies, [*BY, "share"]):
        if grids.rolls.nunique() == 1:
            ra, ke = (fits.grid_limit(grids.resolution, grids[name]).value for name in ("ra", "ke"))
            finest = grids.iloc[-1][list(ENERGIES.columns)]
            yield {**finest, "resolution": inf, "ra": ra, "ke": ke}


def all_lines(energies: pd.DataFrame) -> Iterator[Row]:
    """Lines of K over Ra^-1/2 for each reach: through each grid's points and through extrapolated points.

    The third kind extrapolates lines instead of points, as KHP95 do in Sec. V.
    """
    for share, shares in LINES.items():
        wanted = energies.share.round(6).isin(shares)
        for key, series in energies[wanted].groupby(BY, dropna=False):
            at = dict(zip(BY, key)) | {"reach": round((1 - share)**-2, 3)}
            lines = [straight(points) for points in several(series, "resolution")]
            grids = [line for line in lines if line["resolution"] < inf]
            if len(grids) >= GRIDS:
                lines.append(without_grid(grids))
            yield from (at | line for line in lines)


def straight(points: pd.DataFrame) -> Row:
    """Line by least squares, with its zero (slope/intercept)^2 and the 95 % error of this, to first order."""
    fit = fits.line(points.ra.to_numpy()**-0.5, points.ke.to_numpy())
    intercept, slope = fit.coefficients
    ra_c = (slope/intercept)**2
    err = fit.along(2*ra_c*np.array([-1/intercept, 1/slope])).err
    residual = np.abs(fit.residuals).max()/points.ke.max()
    return {"resolution": points.resolution.iloc[0], "lines": "", "points": len(points), "slope": slope,
            "intercept": intercept, "ra_c": ra_c, "err": err, "residual": residual}


def without_grid(lines: list[Row]) -> Row:
    """Lines extrapolated in L^-2; err: that of the line, and what leaving out the coarsest grid changes."""
    line, without = extrapolated(lines), extrapolated(lines[1:])
    return line | {"err": np.hypot(line["err"], line["ra_c"] - without["ra_c"])}


def extrapolated(lines: list[Row]) -> Row:
    """Slope and intercept at L^-2 = 0, L in cells; other columns are the finest grid's."""
    grids = pd.DataFrame(lines)
    _, (slope, intercept) = np.polyfit(grids.resolution**-2.0, grids[["slope", "intercept"]], 1)
    return lines[-1] | {"resolution": inf, "lines": "L^-2 extrapolated", "slope": slope,
                        "intercept": intercept, "ra_c": (slope/intercept)**2}
