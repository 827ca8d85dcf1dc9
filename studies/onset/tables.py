"""Tables of the study onset, and the critical Rayleigh numbers that follow from growth rates and energies.

Growth rates are of the velocity, per free-fall time; K in units of the scene. Every `err` is the half width
of a 95 % interval or, of a grid, the bound that its extrapolation gives. `dT` is over the mean temperature, 0
for Boussinesq and for limits; `resolution` is rows per height, `inf` where extrapolated.
"""
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.stats import Measured, combine
from studies.kit.table import Rows, Table, Tables
from studies.onset.runs import LINES

POINT = ["method", "variant", "eos", "transport", "dT", "sides", "pr", "resolution"]
#: `way` is `operator` (from the linearised rates), `run` (a run in time from rolls of energy `ke_start`)
GROWTH = Table("growth_rates", key=[*POINT, "way", "ke_start", "seed", "ra"],
               columns=[*POINT, "way", "ke_start", "seed", "ra", "sigma", "err"])
#: steady K; `share` is 1 - sqrt(Ra_c/Ra) with the grid's own Ra_c; extrapolated rows have both extrapolated
ENERGIES = Table("energies", key=[*POINT, "share"], columns=[*POINT, "share", "ra", "ke", "rolls"])
#: K = slope Ra^-1/2 + intercept up to `reach` Ra_c; `residual`: largest distance from it over the largest K
#: `lines`: where a line without a grid is from, the lines of grids or ("") extrapolated points
LINE_TABLE = Table("lines", key=[*POINT, "reach", "lines"], columns=[
    *POINT, "reach", "lines", "points", "slope", "intercept", "ra_c", "err", "residual"])
#: `quantity` tells rows of a method apart: the box, what differs from the ideal gas with constant eta and
#: dT = 1, and in brackets how it was found, extrapolated where no rows are named. Other columns say the same:
#: `way` as in growth_rates, or `eigenvalue` or `line`; `reach` is 0 but for lines, `ke_start` but for runs
CRITICAL = Table("critical_ra", key=["method", "quantity"],
                 columns=["method", "quantity", "value", "err", *POINT[1:], "way", "reach", "ke_start"])

ALL = (GROWTH, ENERGIES, LINE_TABLE, CRITICAL)

BOX_NAMES = {"periodic": "ra_c periodic aspect 2", "walls": "ra_c square conducting"}
#: what goes without saying in the name of a quantity
USUAL = {"variant": ("", "printed"), "eos": ("", "ideal"), "transport": ("", "const-eta")}
SERIES = POINT[:-1]
GRIDS = 3       # of an extrapolation, at least; also points of a line, Ra of a zero
DRAWS = 400

Row = dict[Any, Any]


def derive(tables: Tables) -> Rows:
    """All derived rows of the study."""
    critical: list[Row] = []
    limits: list[Row] = []
    lines: list[Row] = []
    if "growth_rates" in tables:
        critical += from_growth(tables["growth_rates"])
        critical += small_differences(pd.DataFrame(critical, columns=list(CRITICAL.columns)))
    if "energies" in tables:
        energies = tables["energies"]
        single = energies[np.isfinite(energies["resolution"])]
        limits += extrapolated_energies(single)
        fine = pd.DataFrame(limits, columns=single.columns)
        lines += all_lines(pd.concat([single, fine]))
        for line in lines:
            ra_c = Measured(line["ra_c"], line["err"])
            critical.append(critical_row(line, ra_c, "line", reach=line["reach"], lines=line["lines"]))
    return {"energies": limits, "lines": lines, "critical_ra": critical}


def critical_row(at: Any, ra: Measured, way: str, reach: float = 0.0, ke_start: float = 0.0,
                 lines: str = "") -> Row:
    """Row of `critical_ra` at the point of another row."""
    line = "K line" if reach == 4 else f"K line to {reach:g} Ra_c"      # 4 is the paper's
    how = [line if reach else "growth rates"]
    if way == "run":
        how.append(f"run from K = {ke_start:g}")
    if lines:
        how.append(lines)
    if np.isfinite(at["resolution"]):
        how.append(f"{at['resolution']:.0f} rows")
    point = {name: at[name] for name in POINT}
    quantity = f"{place(at)} ({', '.join(how)})"
    found = {"value": ra.value, "err": ra.err, "way": way, "reach": reach, "ke_start": ke_start}
    return {**point, "quantity": quantity, **found}


def place(at: Any) -> str:
    """The box, and what differs from the usual gas."""
    differs = [at[name] for name, usual in USUAL.items() if at[name] not in usual]
    if at["eos"] and at["dT"] != 1:
        differs.append(f"dT {at['dT']:g}")
    return ", ".join([BOX_NAMES[at["sides"]], *differs])


def from_growth(rates: pd.DataFrame) -> Iterator[Row]:
    """Ra where sigma crosses zero: for each grid and start, and extrapolated over three grids or more."""
    rates = rates[rates["method"] != "linear"]
    for _, series in rates.groupby([*SERIES, "way", "ke_start"], dropna=False):
        way, ke_start = series[["way", "ke_start"]].iloc[0]
        zero = smooth_zero if way == "operator" else nearby_zero
        rows = []
        for _, runs in series.groupby("resolution"):
            at_ra = means(runs)
            if crosses(at_ra):
                row = critical_row(runs.iloc[0], zero(at_ra), way, ke_start=ke_start)
                rows.append(row)
        yield from rows
        if way == "operator" and len(rows) >= GRIDS:
            at = rows[-1] | {"resolution": np.inf}
            yield critical_row(at, limit(rows), way)


def means(runs: pd.DataFrame) -> pd.DataFrame:
    """Mean sigma over seeds at each Ra."""
    rows = []
    for ra, some in runs.groupby("ra"):
        of_seeds = list(zip(some["sigma"], some["err"], strict=True))
        rows.append((ra, *combine(of_seeds)))
    return pd.DataFrame(rows, columns=["ra", "sigma", "err"])


def crosses(rates: pd.DataFrame) -> bool:
    """True if there is growth and decay, at three Ra or more."""
    sigma = rates["sigma"]
    return len(sigma) >= GRIDS and bool(sigma.min() < 0 < sigma.max())


def smooth_zero(rates: pd.DataFrame) -> Measured:
    """From the polynomial Ra(sigma) through all points; err: what the farthest changes, and that of sigma."""
    rates = rates.iloc[np.argsort(np.abs(rates["sigma"]))]
    sigma, ra = rates["sigma"].to_numpy(), rates["ra"].to_numpy()
    value = interpolated(sigma, ra)
    without = interpolated(sigma[:-1], ra[:-1])
    slope = np.diff(ra)[0]/np.diff(sigma)[0]
    of_sigma = rates["err"].max()*abs(slope)
    return Measured(value, abs(value - without) + of_sigma)


def interpolated(sigma: np.ndarray, ra: np.ndarray) -> float:
    """Lagrange's polynomial at sigma = 0."""
    total = 0.0
    for s, r in zip(sigma, ra, strict=True):
        others = sigma[sigma != s]
        total += r*np.prod(-others/(s - others))
    return float(total)


def nearby_zero(rates: pd.DataFrame) -> Measured:
    """From straight lines between neighbours; of several crossings, which noise makes, the middle one.

    The error is that of the same on DRAWS samples with noise like the errors, and of the bend: what a
    parabola through the three nearest Ra changes, at most a quarter of the distance of neighbours.
    """
    ra, sigma, err = rates[["ra", "sigma", "err"]].to_numpy().T
    value = middle_crossing(ra, sigma)
    draws = np.random.default_rng(1).normal(size=(DRAWS, len(ra)))
    samples = [middle_crossing(ra, sigma + noise) for noise in err/2*draws]
    low, high = np.quantile(samples, [0.025, 0.975])
    nearest = np.argsort(np.abs(ra - value))[:3]
    parabola = interpolated(sigma[nearest], ra[nearest])
    bend = min(abs(parabola - value), np.diff(ra).max()/4)
    scatter = max(value - low, high - value)
    return Measured(value, float(np.hypot(scatter, bend)))


def middle_crossing(ra: np.ndarray, sigma: np.ndarray) -> float:
    """Median of the zeros of lines between neighbours; where there is none, the end towards which it lies."""
    at = np.flatnonzero(sigma[1:]*sigma[:-1] < 0)
    if not len(at):
        return float(ra[0] if sigma.sum() > 0 else ra[-1])
    rise, run = sigma[at + 1] - sigma[at], ra[at + 1] - ra[at]
    zeros = ra[at] - sigma[at]*run/rise
    return float(np.median(zeros))


def limit(rows: list[Row]) -> Measured:
    """Extrapolated over grids; errors of each grid's own are added."""
    frame = pd.DataFrame(rows)
    value, err = fits.grid_limit(frame["resolution"], frame["value"])
    return Measured(value, err + 3*frame["err"].max())


def small_differences(critical: pd.DataFrame) -> Iterator[Row]:
    """Limit dT -> 0 of the gas: even in dT, because turning the box upside down changes its sign alone."""
    fine = np.isinf(critical["resolution"].astype(float))
    rows = critical[fine & (critical["eos"] != "")].sort_values("dT")
    for _, group in rows.groupby(["method", "eos", "transport", "sides"]):
        if len(group) >= GRIDS:
            dT, ra = group[["dT", "value"]].to_numpy(float).T
            value, err = fits.grid_limit(1/dT, ra)
            at = {**group.iloc[0], "dT": 0.0}
            yield critical_row(at, Measured(value, err + group["err"].max()), "operator")


class FittedLine(NamedTuple):
    """K = slope Ra^-1/2 + intercept; `err` of its zero as the scatter of the points would have it."""

    points: int
    slope: float
    intercept: float
    ra_c: float
    err: float
    residual: float


def extrapolated_energies(energies: pd.DataFrame) -> Iterator[Row]:
    """Ra and K at each share, over three grids or more with the same rolls."""
    for _, group in energies.groupby([*SERIES, "share"], dropna=False):
        if len(group) >= GRIDS and group["rolls"].nunique() == 1:
            ra, ke = (fits.grid_limit(group["resolution"], group[name]) for name in ("ra", "ke"))
            fine = {"resolution": np.inf, "ra": ra.value, "ke": ke.value}
            yield {**group.iloc[-1][[*SERIES, "share", "rolls"]], **fine}


def all_lines(energies: pd.DataFrame) -> Iterator[Row]:
    """K against Ra^-1/2 for each reach: of grids, of extrapolated points, extrapolated as KHP95, Sec. V."""
    for key, series in energies.groupby(SERIES, dropna=False):
        for share, shares in LINES.items():
            at: Row = dict(zip(SERIES, key, strict=True))
            at["reach"] = round((1 - share)**-2, 3)
            inside = series[series["share"].round(6).isin(shares)]
            lines: dict[Any, FittedLine] = {}
            for size, some in inside.groupby("resolution"):
                if len(some) >= GRIDS:
                    lines[size] = straight(some)
                    yield at | {"resolution": size, "lines": ""} | lines[size]._asdict()
            lines.pop(np.inf, None)
            if len(lines) >= GRIDS:
                fine = without_grid(lines)
                yield at | {"resolution": np.inf, "lines": "L^-2 extrapolated"} | fine._asdict()


def straight(points: pd.DataFrame) -> FittedLine:
    """Least squares; err is that of (slope/intercept)^2, to first order, at 95 %."""
    fit = fits.line(points["ra"].to_numpy()**-0.5, points["ke"].to_numpy())
    intercept, slope = fit.coefficients
    ra_c = (slope/intercept)**2
    toward = 2*ra_c*np.array([-1/intercept, 1/slope])
    residual = np.abs(fit.residuals).max()/points["ke"].max()
    return FittedLine(len(points), slope, intercept, ra_c, fit.along(toward).err, residual)


def without_grid(lines: dict[float, FittedLine]) -> FittedLine:
    """Linear in L^-2, L in cells; err: that of the lines and what the coarsest grid changes."""
    x = np.array(list(lines))**-2.0
    of_grids = list(lines.values())
    line = extrapolated(x, of_grids)
    without = extrapolated(x[1:], of_grids[1:])
    return line._replace(err=float(np.hypot(line.err, line.ra_c - without.ra_c)))


def extrapolated(x: np.ndarray, lines: list[FittedLine]) -> FittedLine:
    """The line at x = 0; what else it has is the finest grid's."""
    pairs = [(line.slope, line.intercept) for line in lines]
    _, (slope, intercept) = np.polyfit(x, pairs, 1)
    return lines[-1]._replace(slope=slope, intercept=intercept, ra_c=(slope/intercept)**2)
