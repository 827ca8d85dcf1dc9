"""From growth rates and energies to critical Rayleigh numbers."""
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.onset.runs import BOX_NAMES, LINES
from studies.onset.tables import POINT

Rows = dict[str, list[dict[str, Any]]]
SERIES = POINT[:-1]
DRAWS = 400
WEAK = 1e-6     # K of rolls that are too weak to act on themselves


class Line(NamedTuple):
    """K = slope Ra^-1/2 + intercept; `err` of its zero as the scatter of the points would have it."""
    slope: float
    intercept: float
    err: float
    residual: float
    points: int

    @property
    def ra_c(self) -> float:
        return (self.slope/self.intercept)**2


def derive(tables: Tables) -> Rows:
    """All derived rows of the study."""
    critical, limits, lines = [], [], []
    if "growth_rates" in tables:
        critical += list(from_growth(tables["growth_rates"]))
        critical += list(small_differences(pd.DataFrame(critical))) if critical else []
    if "energies" in tables:
        single = tables["energies"][np.isfinite(tables["energies"]["resolution"])]
        limits = list(extrapolated_energies(single))
        lines = list(all_lines(single, pd.DataFrame(limits, columns=single.columns)))
        critical += [of_line(line) for line in lines]
    return {"energies": limits, "lines": lines, "critical_ra": critical}


def of_line(line: dict[str, Any]) -> dict[str, Any]:
    """Row of `critical_ra` of a row of `lines`."""
    return critical_row(line, line["ra_c"], line["err"], way="line", reach=line["reach"], lines=line["lines"])


def critical_row(at: Any, value: float, err: float, *, way: str, reach: float = 0.0, ke_start: float = 0.0,
                 lines: str = "") -> dict[str, Any]:
    """Row of `critical_ra` at the point of another row."""
    return {**{name: at[name] for name in POINT}, "quantity": quantity(at, way, reach, ke_start, lines), "value": value,
            "err": err, "way": way, "reach": reach, "ke_start": ke_start}


def quantity(at: Any, way: str, reach: float, ke_start: float, lines: str) -> str:
    """Words that tell a row from all others of its method."""
    differs = [at["variant"]*(at["variant"] not in ("", "printed")), at["eos"]*(at["eos"] not in ("", "ideal")),
               at["transport"]*(at["transport"] not in ("", "const-eta")),
               f"dT {at['dT']:g}"*bool(at["eos"] and at["dT"] != 1)]
    near = f" to {reach:g} Ra_c"*bool(reach and reach != 4)
    how = [f"K line{near}" if reach else "growth rates", f"run from K = {ke_start:g}"*(way == "run"), lines,
           f"{at['resolution']:.0f} rows"*bool(np.isfinite(at["resolution"]))]
    return ", ".join(filter(None, [BOX_NAMES[at["sides"]], *differs])) + f" ({', '.join(filter(None, how))})"


# --- growth rates -----------------------------------------------------------------------------------------


def from_growth(rates: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Ra where sigma crosses zero: for each grid and start, and extrapolated over three grids or more."""
    for _, group in rates[rates["method"] != "linear"].groupby([*SERIES, "way", "ke_start"], dropna=False):
        way, ke_start = str(group["way"].iloc[0]), float(group["ke_start"].iloc[0])
        find = smooth_zero if ke_start < WEAK else nearby_zero
        found = [critical_row(one.iloc[0], *find(rates), way=way, ke_start=ke_start)
                 for _, one in group.groupby("resolution") if crosses(rates := means(one))]
        yield from found
        if way == "operator" and len(found) > 2:
            yield critical_row({**found[-1], "resolution": np.inf}, *limit(found), way=way)


def means(runs: pd.DataFrame) -> pd.DataFrame:
    """Mean sigma over seeds at each Ra."""
    rows = [(ra, *combine(list(zip(group["sigma"], group["err"])))) for ra, group in runs.groupby("ra")]
    return pd.DataFrame(rows, columns=["ra", "sigma", "err"])


def crosses(rates: pd.DataFrame) -> bool:
    """True if there is growth and decay, at three Ra or more."""
    return len(rates) > 2 and bool(rates["sigma"].min() < 0 < rates["sigma"].max())


def smooth_zero(rates: pd.DataFrame) -> Measured:
    """From the polynomial Ra(sigma) through all points; err is what the farthest point changes, and the errors of sigma."""
    rates = rates.iloc[np.argsort(np.abs(rates["sigma"]))]
    sigma, ra = rates["sigma"].to_numpy(), rates["ra"].to_numpy()
    value, other = interpolated(sigma, ra), interpolated(sigma[:-1], ra[:-1])
    return Measured(value, abs(value - other) + rates["err"].max()*abs(np.diff(ra)[0]/np.diff(sigma)[0]))


def interpolated(sigma: np.ndarray, ra: np.ndarray) -> float:
    """Lagrange's polynomial at sigma = 0."""
    return float(sum(r*np.prod([-other/(s - other) for other in sigma if other != s]) for s, r in zip(sigma, ra)))


def nearby_zero(rates: pd.DataFrame) -> Measured:
    """From straight lines between neighbours; of several crossings, which noise makes, the middle one.

    The error is that of the same on DRAWS samples with noise like the errors, and of the bend: what a parabola through
    the three nearest Ra changes, at most a quarter of the distance of neighbours.
    """
    ra, sigma = rates["ra"].to_numpy(), rates["sigma"].to_numpy()
    value, rng = middle_crossing(ra, sigma), np.random.default_rng(1)
    noise = rates["err"].to_numpy()/2*rng.normal(size=(DRAWS, len(ra)))
    low, high = np.quantile([middle_crossing(ra, sigma + one) for one in noise], [0.025, 0.975])
    near, step = np.argsort(np.abs(ra - value))[:3], np.diff(ra).max()
    bend = min(abs(interpolated(sigma[near], ra[near]) - value), step/4)
    return Measured(value, float(np.hypot(max(value - low, high - value), bend)))


def middle_crossing(ra: np.ndarray, sigma: np.ndarray) -> float:
    """The median of the zeros of the lines between neighbours; where there is none, the end towards which it lies."""
    at = np.flatnonzero(sigma[1:]*sigma[:-1] < 0)
    if not len(at):
        return float(ra[0] if sigma.sum() > 0 else ra[-1])
    return float(np.median(ra[at] - sigma[at]*(ra[at + 1] - ra[at])/(sigma[at + 1] - sigma[at])))


def limit(rows: list[dict[str, Any]]) -> Measured:
    """Extrapolated over grids; errors of each grid's own are added."""
    value, err = fits.grid_limit([row["resolution"] for row in rows], [row["value"] for row in rows])
    return Measured(value, err + 3*max(row["err"] for row in rows))


def small_differences(critical: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Limit dT -> 0 of the gas: even in dT, because turning the box upside down changes the sign of dT alone."""
    rows = critical[np.isinf(critical["resolution"]) & (critical["eos"] != "")]
    for _, group in rows.groupby(["method", "eos", "transport", "sides"]):
        group = group.sort_values("dT")
        if len(group) > 2:
            value, err = fits.grid_limit(1/group["dT"], group["value"])
            at = {**group.iloc[0].to_dict(), "dT": 0.0}
            yield critical_row(at, value, err + group["err"].max(), way="operator")


# --- lines ------------------------------------------------------------------------------------------------


def extrapolated_energies(energies: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Ra and K at each share, over three grids or more with the same rolls."""
    for _, group in energies.groupby([*SERIES, "share"], dropna=False):
        if len(group) > 2 and group["rolls"].nunique() == 1:
            ra, ke = (fits.grid_limit(group["resolution"], group[name]).value for name in ("ra", "ke"))
            same = {name: group[name].iloc[-1] for name in (*SERIES, "share", "rolls")}
            yield {**same, "resolution": np.inf, "ra": ra, "ke": ke}


def all_lines(energies: pd.DataFrame, limits: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """K against Ra^-1/2 for each reach and grid, with slope and intercept extrapolated in L^-2 as in KHP95, Sec. V, and
    through points that were extrapolated each."""
    for key, series in energies.groupby(SERIES, dropna=False):
        at = dict(zip(SERIES, key))
        points = limits[(limits[SERIES] == list(key)).all(axis=1)]
        for share, shares in LINES.items():
            inside = series[series["share"].round(6).isin(shares)]
            lines = {float(size): straight(group) for size, group in inside.groupby("resolution")     # type: ignore[arg-type]
                     if len(group) > 2}
            for size, line in lines.items():
                yield line_row(at, share, size, line)
            if len(lines) > 2:
                yield line_row(at, share, np.inf, straight(points[points["share"].round(6).isin(shares)]))
                yield line_row(at, share, np.inf, without_grid(lines), "L^-2 extrapolated")


def line_row(at: dict[Any, Any], share: float, size: float, line: Line, lines: str = "") -> dict[str, Any]:
    """Row of `lines`; `lines` says how a line without a grid was found from those of grids."""
    return {**at, "resolution": size, "reach": round((1 - share)**-2, 3), "lines": lines, "points": line.points,
            "slope": line.slope, "intercept": line.intercept, "ra_c": line.ra_c, "err": line.err, "residual": line.residual}


def straight(points: pd.DataFrame) -> Line:
    """Least squares; err is that of (slope/intercept)^2, to first order, at 95 %."""
    fit = fits.line(points["ra"]**-0.5, points["ke"])
    intercept, slope = fit.coefficients
    toward = 2*(slope/intercept)**2*np.array([-1/intercept, 1/slope])
    residual = np.abs(fit.residuals).max()/points["ke"].max()
    return Line(float(slope), float(intercept), fit.along(toward).err, float(residual), len(points))


def without_grid(lines: dict[float, Line]) -> Line:
    """Slopes and intercepts linear in L^-2, L in cells; err is that of the lines and what the coarsest grid changes."""
    line, other = extrapolated(lines), extrapolated(dict(list(lines.items())[1:]))
    return line._replace(err=float(np.hypot(line.err, abs(line.ra_c - other.ra_c))))


def extrapolated(lines: dict[float, Line]) -> Line:
    """The line at L^-2 = 0; what else it has is the finest grid's."""
    x, finest = np.array(list(lines))**-2.0, list(lines.values())[-1]
    slope, intercept = (np.polyfit(x, [getattr(line, name) for line in lines.values()], 1)[1]
                        for name in ("slope", "intercept"))
    return finest._replace(slope=float(slope), intercept=float(intercept))
