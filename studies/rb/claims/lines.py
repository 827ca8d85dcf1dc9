"""Straight lines of K in Ra^-1/2 through the compressible grid's states    [KHP95, Sec. V]"""
from dataclasses import dataclass
from math import inf

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from continuum.richardson import richardson
from studies.build.read import STILL, Value, grid, limit, onset, ratio, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables

LEAST = 5           # points of a line: three are left to tell how straight it is
ONE_STATE = {"periodic": 2, "walls": 1}  # rolls of the states that make a line


@dataclass(frozen=True)
class Line:
    """y = intercept + slope x, fitted to y +- err."""
    x: np.ndarray
    y: np.ndarray
    err: np.ndarray

    @property
    def coefficients(self) -> np.ndarray:
        """(slope, intercept) of least squares."""
        return np.polyfit(self.x, self.y, 1)

    @property
    def residuals(self) -> np.ndarray:
        return self.y - np.polyval(self.coefficients, self.x)

    def at(self, x: float, spread: float = 0.0) -> Measured:
        """The line read at x; error from that of the points, or from a `spread` of points if that is more."""
        far = (x - self.x.mean())**2/np.sum((self.x - self.x.mean())**2)
        err = max(spread, self.err.max())*np.sqrt(1/len(self.x) + far)
        return Measured(float(np.polyval(self.coefficients, x)), float(err))

    def other(self, x: float) -> Measured:
        """The same, if the line were drawn through other points with the same scatter."""
        n = len(self.x)
        return self.at(x, float(stdtrit(n - 2, 0.975)*np.sqrt(np.sum(self.residuals**2)/(n - 2))))

    @property
    def bend(self) -> Measured:
        """Largest residual."""
        return Measured(float(np.abs(self.residuals).max()), float(self.err.max()))


def line(tables: Tables, low: float = 1.0, height: float = inf, sides="periodic", **where) -> Line:
    """K against Ra^-1/2 for Ra from `low` to 4 times onset, all states with one pair of rolls (square: one roll).

    Raises
    ------
    CannotTell
        Fewer than five Rayleigh numbers in that range were run.
    """
    first = onset(sides)
    frame = select(tables, "means", **{k: v for k, v in grid(1.0, height, sides=sides, **where).items() if k != "ra"},
                   rolls=ONE_STATE[sides])
    frame = frame[(frame["ra"] > low*first) & (frame["ra"] <= 4*first) & (frame["ke"] > STILL)].sort_values("ra")
    if len(frame) < LEAST:
        raise CannotTell(f"{len(frame)} Rayleigh numbers between {low*first:.0f} and {4*first:.0f} were run on the "
                         f"grid, a line is judged by {LEAST} or more: a larger SIZE of the study has them")
    ra, ke, err = (frame[name].to_numpy(float) for name in ("ra", "ke", "ke_err"))
    return Line(ra**-0.5, ke, err)


def straightness(**where) -> Value:
    """Largest distance of K from its straight line, over K at 4 times onset."""
    def value(tables: Tables) -> Measured:
        found = line(tables, **where)
        return ratio(found.bend, found.at((4*onset(where.get("sides", "periodic")))**-0.5))
    return value


def read_at(ra: float, **where) -> Value:
    """K of the line from 1.2 to 4 times onset, read at `ra`; which Ra the paper drew it through is not said."""
    return lambda tables: line(tables, low=1.2, **where).other(ra**-0.5)


def beyond(tables: Tables) -> Measured:
    """K at Ra 10 000, which is 5.9 times onset, over what the line from 1.2 to 4 times onset gives there, less 1."""
    found = ratio(limit(tables, 1e4), line(tables, low=1.2).at(1e4**-0.5))
    return Measured(found.value - 1, found.err)


def heights(tables: Tables) -> list[float]:
    """Rows of the grids on which enough Rayleigh numbers were run for a line.

    Raises
    ------
    CannotTell
        Fewer than three.
    """
    frame = select(tables, "means", **{k: v for k, v in grid(1.0).items() if k not in ("ra", "resolution")})
    frame = frame[np.isfinite(frame["resolution"]) & frame["ra"].between(onset("periodic"), 4*onset("periodic"))]
    counts = frame.groupby("resolution")["ra"].nunique()
    found = sorted(counts.index[counts >= LEAST])
    if len(found) < 3:
        raise CannotTell(f"{len(found)} grids have {LEAST} Rayleigh numbers in the linear range, three or more tell "
                         "how slopes and intercepts go with L: a larger SIZE of the study has them")
    return found


def against_cells(which: str) -> Value:
    """Slopes or intercepts of the lines of several grids against L^-2: largest residual over their whole change."""
    def value(tables: Tables) -> Measured:
        sizes = heights(tables)
        found = [line(tables, height=size) for size in sizes]
        err = max(f.err.max()/(np.ptp(f.x) if which == "slope" else 1) for f in found)
        values = np.array([f.coefficients[["slope", "intercept"].index(which)] for f in found])
        bend = Line(np.array(sizes)**-2.0, values, np.full(len(sizes), err)).bend
        return ratio(bend, Measured(float(np.ptp(values)), err))
    return value


def extrapolated(tables: Tables, ra: float, cells: float) -> Measured:
    """K of an infinitely fine grid from the three finest grids of two squares with so many cells at most.

    Raises
    ------
    CannotTell
        There are fewer than three.
    """
    frame = finite_grids(tables, ra)
    frame = frame[2*frame["resolution"]**2 <= cells]
    if len(frame) < 3:
        raise CannotTell(f"{len(frame)} grids of {cells:g} cells at most were run at Ra {ra:g}, a limit takes three")
    found = richardson(list(frame["ke"]), list(frame["resolution"]))
    return Measured(found.limit, found.error + 2*float(frame["ke_err"].max()))


def finite_grids(tables: Tables, ra: float, **where) -> pd.DataFrame:
    """Rows of `means` of the grids of one scene that are not extrapolated."""
    frame = select(tables, "means", **{k: v for k, v in grid(ra, **where).items() if k != "resolution"})
    return frame[np.isfinite(frame["resolution"])]


def finest(tables: Tables, ra: float, cells: tuple[float, float] = (0, inf), **where) -> tuple[Measured, float]:
    """K and rows of the finest grid of two squares with so many cells, at least and at most."""
    frame = finite_grids(tables, ra, **where)
    frame = frame[(2*frame["resolution"]**2).between(*cells)]
    if frame.empty:
        raise CannotTell(f"no grid of {cells[0]:g} to {cells[1]:g} cells was run at Ra {ra:g}")
    row = frame.sort_values("resolution").iloc[-1]
    return Measured(row["ke"], row["ke_err"]), float(row["resolution"])
