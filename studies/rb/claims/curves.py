"""Questions of this study about curves: K against time, K against Ra^-1/2, two K(t) against each other."""
from contextlib import suppress
from typing import Any

import numpy as np

from studies.kit import fits
from studies.kit.ask import NoRows, Value, curve, rows
from studies.kit.stats import CannotTell, Measured, over_seeds
from studies.kit.table import Tables
from studies.rb.flows import ONSET, STILL, Point, besides, grid, limit

NEAR = 0.05     # of the steady value: K of particles fluctuates by 1 % or 2 %, and noise is not to be timed
SAMPLES = 20    # of K(t) at least
LEAST = 5       # points of a line: three are left to tell how straight it is
ONE_STATE = {"periodic": 2, "walls": 1}     # rolls of the states that make a line


# --- K against time -------------------------------------------------------------------------------


def late(t: np.ndarray, ke: np.ndarray) -> np.ndarray:
    """The second half of a run."""
    return ke[t > t[-1]/2]


@curve
def scatter(t: np.ndarray, ke: np.ndarray, err: np.ndarray) -> Measured:
    """Standard deviation over mean of the second half of a run."""
    half = late(t, ke)
    return Measured(float(half.std()/half.mean()))


@curve
def drift(t: np.ndarray, ke: np.ndarray, err: np.ndarray) -> Measured:
    """Difference of the means of the last quarter and of the third, relative."""
    third, last = np.array_split(late(t, ke), 2)
    return Measured(float(abs(last.mean()/third.mean() - 1)))


@curve
def settling(t: np.ndarray, ke: np.ndarray, err: np.ndarray) -> Measured:
    """When K, averaged over a fortieth of the run, is near its late mean for good."""
    n = max(1, len(ke)//40)
    smooth = np.convolve(ke, np.full(n, 1/n), "same")[:len(ke) - n//2]
    far = np.flatnonzero(np.abs(smooth/late(t, ke).mean() - 1) > NEAR)
    return Measured(float(t[far[-1]]) if len(far) else 0.0)


@curve
def peak(t: np.ndarray, ke: np.ndarray, err: np.ndarray) -> Measured:
    """Top of the parabola through three samples around the largest; its error is how far above it lies."""
    k = int(np.clip(np.argmax(ke), 1, len(ke) - 2))
    slope, bend = (ke[k + 1] - ke[k - 1])/2, ke[k + 1] - 2*ke[k] + ke[k - 1]
    above = float(-slope**2/(2*bend)) if bend < 0 else 0.0
    return Measured(float(ke[k]) + above, above)


def history(question: Any, point: Point, energy: str = "ke_field", such: str = "") -> Value:
    """A question about K(t) of one run."""
    return question("history", energy, "t", such, need=SAMPLES, **point)


def approach(point: Point, beside: Point, energy: str) -> Value:
    """Largest |K(t) - K_grid(t)|, mean over seeds, over the steady K of the grid's limit."""
    unit = limit(point["ra"])

    def answer(tables: Tables) -> Measured:
        other = rows(tables, "history", **beside).sort_values("t")
        apart = []
        for _, run in rows(tables, "history", need=SAMPLES, **point).groupby("seed"):
            apart.append(np.abs(run[energy] - np.interp(run["t"], other["t"], other["ke"])).max())
        return over_seeds(np.array(apart)/unit(tables).value)
    asked = history(scatter, point, energy).asks
    words = f"mean over seeds of largest |{energy}(t) - ke(t) of the grid| in history, over {unit}"
    return Value(answer, words, asked)


# --- K against Ra^-1/2 ----------------------------------------------------------------------------


@curve
def bend(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
    """Largest distance from a straight line by least squares, with the largest error."""
    return Measured(float(np.abs(fits.line(x, y).residuals).max()), float(err.max()))


@curve
def slope_alone(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
    """Of the same line; its error is that of the points at both ends."""
    return Measured(fits.line(x, y).slope.value, float(err.max()/np.ptp(x)))


@curve
def intercept_alone(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
    """Of the same line, at 0, with the error of the points."""
    return Measured(fits.line(x, y).intercept.value, float(err.max()))


def line(question: Any, low: float = 1.0, height: float = np.inf, sides: str = "periodic", **where) -> Value:
    """A question about K over Ra^-1/2 from `low` to 4 times onset; states with one pair of rolls (square: one roll)."""
    point = besides(grid(1.0, height, sides=sides, **where), "ra")
    inside = f"{low*ONSET[sides]:.1f} < ra <= {4*ONSET[sides]:.1f} and ke > {STILL:g}"
    states = {"rolls": ONE_STATE[sides], **point}
    return question("means", "ke", "ra**-0.5", inside, err="ke_err", need=LEAST, **states)


def reading(ra: float) -> Any:
    """The line read at a Rayleigh number; its error is that of the points."""
    def read(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
        at = ra**-0.5
        far = (at - x.mean())**2/np.sum((x - x.mean())**2)
        return Measured(fits.line(x, y).at(at).value, float(err.max()*np.sqrt(1/len(x) + far)))
    read.__name__ = f"line at Ra {ra:g} through "
    return curve(read)


def foretelling(ra: float) -> Any:
    """The same as if the line were drawn through other points with the same scatter."""
    def read(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
        return fits.line(x, y).at(ra**-0.5)
    read.__name__ = f"line at Ra {ra:g} through "
    return curve(read)


def straightness(sides: str = "periodic", **where) -> Value:
    """Largest distance of K from its straight line, over K of the line at 4 times onset."""
    return line(bend, sides=sides, **where)/line(reading(4*ONSET[sides]), sides=sides, **where)


def against_cells(question: Any) -> Value:
    """Slopes or intercepts of the lines of grids against L^-2: largest residual over their whole change."""
    asked = line(question)

    def answer(tables: Tables) -> Measured:
        lines = on_grids(tables, question)
        values = np.array([one.value for one in lines.values()])
        err = max(one.err for one in lines.values())
        residuals = fits.line(np.array(list(lines))**-2.0, values).residuals
        return Measured(float(np.abs(residuals).max()), err)/Measured(float(np.ptp(values)), err)
    words = f"distance from a line over resolution**-2, over the whole change, of {asked}"
    return Value(answer, words, asked.asks)


def on_grids(tables: Tables, question: Any) -> dict[float, Measured]:
    """The question about the line of each grid on which enough Rayleigh numbers were run.

    Raises
    ------
    CannotTell
        Fewer than three.
    """
    lines = {}
    point = besides(grid(1.0), "ra", "resolution")
    for size in sorted(rows(tables, "means", "resolution < inf", **point)["resolution"].unique()):
        with suppress(NoRows):
            lines[float(size)] = line(question, height=size)(tables)
    if len(lines) < 3:
        raise CannotTell(f"{len(lines)} grids have {LEAST} Rayleigh numbers in the linear range, three or more show "
                         "how slopes and intercepts go with L: a larger SIZE of the study has them")
    return lines
