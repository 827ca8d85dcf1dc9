"""Questions of this study about curves: K against time, K against Ra^-1/2, two K(t) against each other."""
from typing import Any

import numpy as np

from studies.kit import fits
from studies.kit.ask import Value, curve, rows
from studies.kit.stats import Measured, over_seeds
from studies.kit.table import Tables
from studies.rb.claims.flows import limit
from studies.rb.tables import STILL, Point, besides, grid

NEAR = 0.05     # of the steady value: K of particles fluctuates by 1 % or 2 %, and noise is not to be timed
SAMPLES = 20    # of K(t) at least
LEAST = 5       # points of a line: three are left to tell how straight it is
#: critical Ra of the Boussinesq fluid, by linear theory: a pair of rolls in the layer, one in the square,
#: whose sides conduct; the study onset measures both again
ONSET = {"periodic": 1707.9222997145034, "walls": 5011.71}
ONE_STATE = {"periodic": 2, "walls": 1}     # rolls of the states that make a line
CELLS = (24, 32, 48)                        # rows of the grids that have lines


def history(question: Any, point: Point, energy: str = "ke_field", such: str = "") -> Value:
    """A question about K(t) of one run."""
    return question("history", energy, "t", such, need=SAMPLES, **point)


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


def approach(point: Point, beside: Point, energy: str) -> Value:
    """Largest |K(t) - K_grid(t)|, mean over seeds, over the steady K of the grid's limit."""
    unit = limit(point["ra"])

    def answer(tables: Tables) -> Measured:
        cells = rows(tables, "history", **beside).sort_values("t")
        runs = rows(tables, "history", need=SAMPLES, **point)
        apart = np.abs(runs[energy] - np.interp(runs["t"], cells["t"], cells["ke"]))
        return over_seeds(apart.groupby(runs["seed"]).max()/unit(tables).value)
    words = f"mean over seeds of largest |{energy}(t) - ke(t) of the grid| in history, over {unit}"
    return Value(answer, words, history(scatter, point, energy).asks)


def line(question: Any, low: float = 1.0, height: float = np.inf, sides: str = "periodic", **where) -> Value:
    """A question about K over Ra^-1/2 from `low` to 4 times onset, of states with two rolls (square: one)."""
    point = besides(grid(1.0, height, sides=sides, **where), "ra")
    inside = f"{low*ONSET[sides]:.1f} < ra <= {4*ONSET[sides]:.1f} and ke > {STILL:g}"
    states = {"rolls": ONE_STATE[sides], **point}
    return question("means", "ke", "ra**-0.5", inside, err="ke_err", need=LEAST, **states)


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


def foretelling(ra: float) -> Any:
    """The line read at a Rayleigh number, as if it were drawn through other points with the same scatter."""
    def read(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
        return fits.line(x, y).at(ra**-0.5)
    read.__name__ = f"line at Ra {ra:g} through "
    return curve(read)


def reading(ra: float) -> Any:
    """The same with the error of the points alone."""
    def read(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> Measured:
        at = ra**-0.5
        far = (at - x.mean())**2/np.sum((x - x.mean())**2)
        return Measured(fits.line(x, y).at(at).value, float(err.max()*np.sqrt(1/len(x) + far)))
    read.__name__ = f"line at Ra {ra:g} through "
    return curve(read)


def straightness(sides: str = "periodic", **where) -> Value:
    """Largest distance of K from its straight line, over K of the line at 4 times onset."""
    return line(bend, sides=sides, **where)/line(reading(4*ONSET[sides]), sides=sides, **where)


def against_cells(question: Any) -> Value:
    """Slopes or intercepts of the lines of grids against L^-2: largest residual over their whole change."""
    lines = [line(question, height=height) for height in CELLS]

    def answer(tables: Tables) -> Measured:
        values, errs = zip(*(one(tables) for one in lines), strict=True)
        residuals = fits.line(np.array(CELLS)**-2.0, values).residuals
        return Measured(float(np.abs(residuals).max()), max(errs))/Measured(float(np.ptp(values)), max(errs))
    words = f"distance from a line over resolution**-2, over the whole change, of {line(question)}"
    return Value(answer, words, lines[0].asks)
