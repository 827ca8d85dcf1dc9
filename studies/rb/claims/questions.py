"""Questions to tables of this study: energies, refused where flows differ; curves over time, Ra^-1/2."""
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from studies.kit import fits, stats
from studies.kit.ask import Array, NoRows, Value, curve, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables
from studies.rb.tables import SCENE, STILL, Point, besides, grid

#: which K of the grid a claim takes, for its reason: two yardsticks are in use
PLAIN = "against the grid's K as it is, as the paper compares"
ALIKE = "against K of the grid's field smoothed by the same weight"
NEAR = 0.05     # of the steady value: K of particles fluctuates by 1 % or 2 %, and noise is not to be timed
SAMPLES = 20    # of K(t) at least
LEAST = 5       # points of a line: three are left to tell how straight it is
#: critical Ra of the Boussinesq fluid, by linear theory: a pair of rolls in the layer, one in the square,
#: whose sides conduct; the study onset measures both again
ONSET = {"periodic": 1707.9222997145034, "walls": 5011.71}
ONE_STATE = {"periodic": 2, "walls": 1}     # rolls of the states that make a line
CELLS = (24, 32, 48)                        # rows of the grids that have lines


def said(name: str, place: str, printed: str, value: Value, statement: str, because: str,
         **more: Any) -> Claim:
    """A claim of KHP95: place, printed words or digits, value, statement, and the reason of its limits."""
    return Claim(id=f"khp95-{name}", source=f"KHP95 {place}", printed=printed, value=value,
                 statement=statement, because=because, **more)


def guarded(value: Value, check: Callable[..., object], *about: Any, **more: Any) -> Value:
    """A question that is put only to tables that check(tables, *about, **more) does not refuse."""
    def answer(tables: Tables) -> Measured:
        check(tables, *about, **more)
        return value(tables)
    return replace(value, answer=answer)


def mean(point: Point, column: str = "ke") -> Value:
    """A column of `means`, refused where runs diverged or seeds ended in different flows."""
    return guarded(one("means", column, **point), one_flow, point)


def limit(ra: float, column: str = "ke", **where) -> Value:
    """A column of the extrapolated compressible grid, likewise."""
    return mean(grid(ra, **where), column)


def alike(point: Point) -> Value:
    """K of the grid's field, smoothed as the particles smooth theirs: Kg is to have this value."""
    return one("errors", "reference", energy="Kg", **point)


def against_grid(point: Point, column: str = "ke_field", unit: Value | None = None) -> Value:
    """K of particles over the grid's limit, or over another unit; refused where the flows differ."""
    beside = grid(1.0) | {name: point[name] for name in SCENE}
    return same_flow(mean(point, column)/(unit or mean(beside)), point, beside)


def against_alike(point: Point) -> Value:
    """Kg over K of the grid's field smoothed alike, which is 1 if the flow is right."""
    return against_grid(point, unit=alike(point))


def over_runs(point: Point) -> Value:
    """Mean of Kg of the runs of a point that have its rolls; its error is chance, without the step."""
    asked = one("kinetic_energy", "ke_field", **point)

    def answer(tables: Tables) -> Measured:
        flow = one_flow(tables, point)
        runs = rows(tables, "kinetic_energy", "ke == ke", rolls=flow.rolls, **point)
        return stats.combine(list(zip(runs.ke_field, runs.ke_field_err)))
    return Value(answer, str(asked).replace("one", "mean over runs of one flow", 1), asked.asks)


def diverged(tables: Tables, point: Point) -> Array:
    """Which runs of a point diverged, (n,): their rows have no energy."""
    try:
        return rows(tables, "kinetic_energy", **point).ke.isna().to_numpy()
    except NoRows:
        return np.zeros(1, bool)


def refuse_diverged(tables: Tables, point: Point) -> None:
    """Refuse a point of which any run diverged."""
    if diverged(tables, point).any():
        raise CannotTell(f"runs of {point['variant']} with {point['resolution']:g} rows diverged: no K")


def one_flow(tables: Tables, point: Point) -> pd.Series:
    """The row of `means` of one point; refused where all runs diverged, or seeds ended in different flows."""
    if diverged(tables, point).all():
        raise CannotTell(f"all runs of {point['method']}, {point['variant']} at Ra {point['ra']:g} diverged")
    row = rows(tables, "means", **point).iloc[0]
    if row.mixed > 0:
        raise CannotTell(f"{row.mixed:.0f} of {row.mixed + row.seeds:.0f} seeds of {point['variant']}, "
                         f"{point['resolution']:g} rows, ended with another number of rolls than the "
                         f"{row.rolls:.0f} of the others at Ra {point['ra']:g}: the flow is not decided")
    return row


def same_flow(value: Value, point: Point, other: Point) -> Value:
    """A question that is put only where two points have the same number of rolls, or one of them has none."""
    return guarded(value, refuse_other_flow, point, other)


def refuse_other_flow(tables: Tables, point: Point, other: Point) -> None:
    """Refuse different numbers of rolls; where motion has died, the energies tell."""
    a, b = rolls_in(tables, point), rolls_in(tables, other)
    if a != b and min(a, b) > 0:
        raise CannotTell(f"{a} rolls against {b} at Ra {point['ra']:g}: another flow, whose energy and "
                         "velocities say nothing on errors")


def rolls_in(tables: Tables, point: Point) -> int:
    """Number of rolls of the seeds in the mean; 0 where motion has died."""
    row = one_flow(tables, point)
    return int(row.rolls) if row.ke > STILL else 0


def rolls(point: Point) -> Value:
    """Number of rolls; refused where motion has died."""
    return guarded(mean(point, "rolls"), lambda tables: refuse_dead(one_flow(tables, point)))


def refuse_dead(row: pd.Series) -> None:
    """Refuse a row of `means` or `kinetic_energy` where nothing moves."""
    if not row.ke > STILL:
        raise CannotTell(f"K is {row.ke:.1g} at the end: the flow has died, its rolls are of round-off")


def order(errors: dict[int, Value], words: str) -> Value:
    """The order of convergence, -d ln|error|/d ln rows, of errors by rows."""
    def slope(tables: Tables) -> Measured:
        values, errs = zip(*(error(tables) for error in errors.values()))
        return -fits.power_law(list(errors), values, err=errs).slope
    return Value(slope, words)


# --- curves ---------------------------------------------------------------------------------------


def history(question: Any, point: Point, energy: str = "ke_field") -> Value:
    """A question about K(t) of one run."""
    return question("history", energy, "t", need=SAMPLES, **point)


def late(t: Array, ke: Array) -> Array:
    """The second half of a run."""
    return ke[t > t[-1]/2]


@curve
def average(t: Array, ke: Array, err: Array) -> Measured:
    """Mean of all samples."""
    return Measured(ke.mean())


@curve
def scatter(t: Array, ke: Array, err: Array) -> Measured:
    """Standard deviation over mean of the second half of a run."""
    half = late(t, ke)
    return Measured(half.std()/half.mean())


@curve
def drift(t: Array, ke: Array, err: Array) -> Measured:
    """Difference of the means of the last quarter and of the third, relative."""
    third, last = np.array_split(late(t, ke), 2)
    return Measured(abs(last.mean()/third.mean() - 1))


@curve
def settling(t: Array, ke: Array, err: Array) -> Measured:
    """Time after which K, averaged over a fortieth of the run, stays near its late mean."""
    n = max(1, len(ke)//40)
    smooth = np.convolve(ke, np.full(n, 1/n), "same")[:len(ke) - n//2]
    far = np.abs(smooth/late(t, ke).mean() - 1) > NEAR
    return Measured(t[:len(far)][far].max(initial=0.0))


def approach(point: Point, beside: Point, energy: str) -> Value:
    """Largest |K(t) - K_grid(t)|, mean over seeds, over the steady K of the grid's limit."""
    unit = limit(point["ra"])

    def answer(tables: Tables) -> Measured:
        cells = rows(tables, "history", **beside).sort_values("t")
        runs = rows(tables, "history", need=SAMPLES, **point)
        apart = (runs[energy] - np.interp(runs.t, cells.t, cells.ke)).abs()
        return stats.over_seeds(apart.groupby(runs.seed).max()/unit(tables).value)
    words = f"mean over seeds of largest |{energy}(t) - ke(t) of the grid| in history, over {unit}"
    return Value(answer, words, history(scatter, point, energy).asks)


def line(question: Any, low: float = 1.0, height: float = np.inf, sides: str = "periodic", **where) -> Value:
    """A question about K over Ra^-1/2 from `low` to 4 times onset, of states with two rolls (square: one)."""
    point = besides(grid(1.0, height, sides=sides, **where), "ra")
    inside = f"{low*ONSET[sides]:.1f} < ra <= {4*ONSET[sides]:.1f} and ke > {STILL:g}"
    states = {"rolls": ONE_STATE[sides], **point}
    return question("means", "ke", "ra**-0.5", inside, err="ke_err", need=LEAST, **states)


@curve
def bend(x: Array, y: Array, err: Array) -> Measured:
    """Largest distance from a straight line by least squares, with the largest error."""
    return Measured(np.abs(fits.line(x, y).residuals).max(), err.max())


@curve
def slope_alone(x: Array, y: Array, err: Array) -> Measured:
    """Slope of the same line; its error is that of the points at both ends."""
    return Measured(fits.line(x, y).slope.value, err.max()/np.ptp(x))


@curve
def intercept_alone(x: Array, y: Array, err: Array) -> Measured:
    """Value of the same line at 0, with the error of the points."""
    return Measured(fits.line(x, y).intercept.value, err.max())


def reading(ra: float, anew: bool = False) -> Any:
    """The line at a Rayleigh number. Its error is that of the points, or with `anew` that of a line through
    other points with the same scatter.
    """
    def read(x: Array, y: Array, err: Array) -> Measured:
        at, mean = fits.line(x, y).at(ra**-0.5), x.mean()
        far = (ra**-0.5 - mean)**2/np.sum((x - mean)**2)
        return at if anew else at._replace(err=err.max()*np.sqrt(1/len(x) + far))
    read.__name__ = f"line at Ra {ra:g} through "
    return curve(read)


def straightness(sides: str = "periodic", **where) -> Value:
    """Largest distance of K from its straight line, over K of the line at 4 times onset."""
    return line(bend, sides=sides, **where)/line(reading(4*ONSET[sides]), sides=sides, **where)


def against_cells(question: Any) -> Value:
    """Slopes or intercepts of the lines of grids against L^-2: largest residual over their whole change."""
    lines = [line(question, height=height) for height in CELLS]

    def answer(tables: Tables) -> Measured:
        values, errs = zip(*(one(tables) for one in lines))
        residuals, err = fits.line(np.array(CELLS)**-2.0, values).residuals, max(errs)
        return Measured(np.abs(residuals).max(), err)/Measured(np.ptp(values), err)
    words = f"distance from a line over resolution**-2, over the whole change, of {line(question)}"
    return Value(answer, words, lines[0].asks)
