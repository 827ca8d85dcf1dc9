"""What the tables of the study motions say, as values of its claims."""
from math import hypot

import numpy as np
import pandas as pd

from studies.build.read import Value, ratio
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables


def rows(tables: Tables, table: str, **where) -> pd.DataFrame:
    """The rows of a table in which all columns are as said.

    Raises
    ------
    CannotTell
        There are none.
    """
    frame = tables.get(table, pd.DataFrame(columns=list(where)))
    for column, value in where.items():
        frame = frame[frame[column] == value]
    if frame.empty:
        wanted = ", ".join(f"{column} {value}" for column, value in where.items())
        raise CannotTell(f"table {table} has no row of {wanted}: make study-motions runs it")
    return frame


def at(tables: Tables, table: str, column: str, **where) -> Measured:
    """One number with its error, if it has one."""
    row = rows(tables, table, **where).iloc[0]
    return Measured(float(row[column]), float(row.get(f"{column}_err", 0.0)))


def cell(table: str, column: str, **where) -> Value:
    """The same as a value function."""
    return lambda tables: at(tables, table, column, **where)


def over(table: str, column: str, other: str, **where) -> Value:
    """A number over another of the same row that was predicted."""
    return lambda tables: ratio(at(tables, table, column, **where), Measured(at(tables, table, other, **where).value, 0.0))


def largest(table: str, column: str, **where) -> Value:
    """The largest of a column; deterministic."""
    return lambda tables: Measured(float(rows(tables, table, **where)[column].abs().max()), 0.0)


def pattern_over_prediction(tables: Tables) -> Measured:
    """Literal motion: speed of the pattern over 1 + f^(k), f^ of the weight itself."""
    speed = at(tables, "patterns", "speed", motion="literal", pattern="density", wavelength=16)
    f = at(tables, "patterns", "smoothed", motion="literal", pattern="density", wavelength=16).value
    return ratio(speed, Measured(1 + f, 0.0))


LONG = (16, 24, 32)     # wavelengths from which sound is extrapolated


def long_sound(motion: str, weight: str = "WendlandC2") -> Value:
    """Speed of sound over c, extrapolated to long waves: what the weight does to them is proportional to (h/lambda)^2."""
    def value(tables: Tables) -> Measured:
        s, m, l = (at(tables, "moving_sound", "speed", motion=motion, weight=weight, wavelength=w, bracket="none") for w in LONG)
        found, before = ((j*j*b.value - i*i*a.value)/(j*j - i*i) for i, j, a, b in ((*LONG[1:], m, l), (*LONG[:2], s, m)))
        return Measured(found, hypot(abs(found - before), 3*l.err, 3*m.err))
    return value


def drift(quantity: str, **where) -> Value:
    """The largest drift of a quantity; deterministic."""
    return largest("conservation", "drift", quantity=quantity, **where)


def any_drift(**where) -> Value:
    """The largest drift of mass, momentum and energy; deterministic."""
    return largest("conservation", "drift", **where)


def against_damping(tables: Tables) -> Measured:
    """Growth rate at 3/2 of the limit over the damping that short steps show."""
    growth = at(tables, "euler", "growth", transport="nested", wavelength=32, dt_over_limit=1.5)
    half = at(tables, "euler", "growth", transport="nested", wavelength=32, dt_over_limit=0.5)
    return ratio(growth, Measured(-2*half.value, 2*half.err))


def spread_of_limits(tables: Tables) -> Measured:
    """Largest less smallest limit, wavelengths of 16 spacings and more."""
    frame = rows(tables, "euler_limits", transport="nested")
    frame = frame[frame["wavelength"] >= 16]
    if len(frame) < 2:
        raise CannotTell("one wavelength of 16 spacings and more was run: a spread needs two")
    return Measured(float(np.ptp(frame["limit"])), 2*float(frame["limit_err"].max()))


def inconsistent(tables: Tables) -> Measured:
    """Largest error of the force of Eq. 50 among a + b other than 0."""
    frame = rows(tables, "brackets")
    return Measured(float((frame["force"] - 1).abs()[frame["a"] + frame["b"] != 0].max()), 0.0)


def off_law(tables: Tables) -> Measured:
    """Largest difference of the force of Eq. 50 from f^ (1 - (a + b)/gamma)."""
    frame = rows(tables, "brackets")
    return Measured(float((frame["force"] - frame["predicted"]).abs().max()), 0.0)


def off_unit(tables: Tables) -> Measured:
    """Largest difference of what a unit of mass does from u^-(a + b), and what a factor does not explain."""
    frame = rows(tables, "brackets")
    return Measured(float(max((frame["unit"]/frame["unit_predicted"] - 1).abs().max(), frame["unit_left"].max())), 0.0)


def sound_of_bracket(tables: Tables) -> Measured:
    """Square of the speed of sound with a + b = 1 over that with a + b = 0."""
    one, none = (at(tables, "moving_sound", "speed", bracket=f"Powers {a}") for a in ("1 0", "1 -1"))
    found = ratio(one, none)
    return Measured(found.value**2, 2*found.value*found.err)


def fourth(tables: Tables) -> Measured:
    """d ln rate/d ln k of the corrected filter, the two longest waves."""
    frame = rows(tables, "filter", filter="corrected", h=3.0)
    frame = frame[frame["mode"] != "corner"].sort_values("k")
    if len(frame) < 2:
        raise CannotTell("one wavelength was run: an order needs two")
    (k, rate, err), (k2, rate2, err2) = frame[["k", "rate", "rate_err"]].to_numpy()[:2]
    return Measured(float(np.log(rate2/rate)/np.log(k2/k)), float((err/rate + err2/rate2)/np.log(k2/k)))
