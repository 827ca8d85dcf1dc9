"""Numbers with errors: arithmetic, means of correlated series, means over few seeds. Fits are in ``fits.py``.

Every error here is the half width of a 95 % interval, as are all ``_err`` columns of the tables.
"""
from collections.abc import Iterator, Sequence
from math import floor, hypot, inf, log10
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.fft import irfft, next_fast_len, rfft
from scipy.special import stdtrit

Numbers = Sequence[float] | np.ndarray | pd.Series


class CannotTell(Exception):
    """The numbers available do not answer the question, for the reason given."""


class Measured(NamedTuple):
    """A value and the half width of its 95 % interval.

    Arithmetic treats errors as independent: they add in squares, to first order. A plain number has no error.
    """

    value: float
    err: float = 0.0

    def __add__(self, other: "Measured | float") -> "Measured":  # type: ignore[override]
        b = measured(other)
        return Measured(self.value + b.value, hypot(self.err, b.err))

    def __radd__(self, other: float) -> "Measured":
        return self + other

    def __neg__(self) -> "Measured":
        return Measured(-self.value, self.err)

    def __sub__(self, other: "Measured | float") -> "Measured":
        b = measured(other)
        return Measured(self.value - b.value, hypot(self.err, b.err))

    def __rsub__(self, other: float) -> "Measured":
        return measured(other) - self

    def __mul__(self, other: "Measured | float") -> "Measured":  # type: ignore[override]
        b = measured(other)
        return Measured(self.value*b.value, hypot(self.err*b.value, self.value*b.err))

    def __rmul__(self, other: float) -> "Measured":  # type: ignore[override]
        return self*other

    def __truediv__(self, other: "Measured | float") -> "Measured":
        """Raise CannotTell if the divisor's interval contains zero."""
        b = measured(other)
        if abs(b.value) <= b.err:
            raise CannotTell(f"a ratio to {b.value:.3g} +- {b.err:.2g}, which is not told from zero")
        ratio = self.value/b.value
        return Measured(ratio, hypot(self.err, ratio*b.err)/abs(b.value))

    def __str__(self) -> str:
        """17.5(15) for 17.5 +- 1.5: the error in units of the last digit, with two digits if its first is 1.

        Without an error the value has five digits.
        """
        if not 0 < self.err < inf:
            return f"{self.value:.5g}"
        power = floor(log10(max(abs(self.value), self.err)))
        if not -5 < power < 7:
            return f"{self*10.0**-power}e{power}"
        size = floor(log10(self.err))
        places = max(0, (self.err < 2*10.0**size) - size)
        return f"{self.value:.{places}f}({self.err*10**places:.0f})"

    def __rtruediv__(self, other: float) -> "Measured":
        return measured(other)/self

    def __pow__(self, power: float) -> "Measured":
        return Measured(self.value**power, abs(power*self.value**(power - 1))*self.err)

    def __abs__(self) -> "Measured":
        return Measured(abs(self.value), self.err)


def measured(number: "Measured | float") -> Measured:
    """A plain number as `Measured` without error; a `Measured` as it is."""
    return number if isinstance(number, Measured) else Measured(float(number))


def correlation(x: np.ndarray) -> np.ndarray:
    """Autocorrelation rho(0..n-1) of a series about its mean; rho(0) = 1."""
    n = len(x)
    spectrum = rfft(x - x.mean(), next_fast_len(2*n))
    covariance = irfft(np.abs(spectrum)**2, next_fast_len(2*n))[:n]
    return covariance/covariance[0]


def window_and_tau(x: np.ndarray, c: float = 6.0) -> tuple[int, float]:
    """Sokal's window W, the first with W >= c tau(W), and tau(W) = 1/2 + sum_{1..W} rho, in samples.

    c = 6 leaves exp(-6) of an exponential decay outside the window. The term (2W + 1)/n corrects, to first
    order, the bias from subtracting the mean of the same series.
    """
    tau = np.cumsum(correlation(x)) - 0.5
    inside = np.arange(len(x)) >= c*tau
    window = int(np.argmax(inside)) if inside.any() else len(x) - 1
    return window, max(0.5, float(tau[window]))*(1 + (2*window + 1)/len(x))


def mean(x: Numbers) -> Measured:
    """Mean of a steady, correlated series and its error.

    The estimated variance of the mean has itself a relative variance 2 (2W + 1)/n, as a chi^2 with
    n/(2W + 1) degrees of freedom has: hence Student's t factor, which widens intervals of short series.

    Raises ValueError: the series is too short or not finite.
    """
    x = np.asarray(x, dtype=float)
    if len(x) < 10 or not np.isfinite(x).all():
        raise ValueError(f"{len(x)} samples, {np.isfinite(x).sum()} of them finite: a mean with an error "
                         "needs at least 10, all finite; run longer or sample more often")
    if np.ptp(x) == 0:
        return Measured(float(x[0]), 0.0)
    window, tau = window_and_tau(x)
    t = stdtrit(max(1.0, len(x)/(2*window + 1)), 0.975)
    return Measured(float(x.mean()), float(t*x.std()*np.sqrt(2*tau/len(x))))


def settled(x: Numbers, most: float = np.inf) -> tuple[Measured, bool]:
    """Mean of a series and whether its halves agree; if not, half of their difference adds to the error.

    Two halves of a steady series differ by more than 1.5 times the root of the sum of squares of their 95 %
    intervals once in 300 times. If noise is correlated over the whole series, these intervals are too wide to
    tell: halves that differ by more than the fraction `most` of the mean do not agree, either.
    """
    whole = mean(x)
    first, last = map(mean, np.array_split(np.asarray(x, float), 2))
    apart = abs(first.value - last.value)
    if apart <= 1.5*np.hypot(first.err, last.err) and apart <= most*abs(whole.value):
        return whole, True
    return Measured(whole.value, float(np.hypot(whole.err, apart/2))), False


def combine(runs: Sequence[tuple[float, float]]) -> Measured:
    """Mean over seeds from (value, err) of each run; the error is the larger of two.

    One is propagated from the errors within the runs. The other is the scatter between runs times Student's t
    factor: it covers runs that settle in different states, but may be small by chance for two or three runs.
    """
    values, errs = np.array(runs, dtype=float).reshape(-1, 2).T
    n = len(values)
    if n == 0:
        raise ValueError("no runs to combine: give (value, err) of at least one seed")
    within = float(np.sqrt((errs**2).sum())/n)
    between = float(stdtrit(n - 1, 0.975)*values.std(ddof=1)/np.sqrt(n)) if n > 1 else 0.0
    return Measured(float(values.mean()), max(within, between))


def over_seeds(values: Numbers) -> Measured:
    """Mean over seeds of values that have no error of their own: t(n - 1) times the scatter over sqrt n.

    Raises CannotTell: there is only one seed.
    """
    if len(values) < 2:
        raise CannotTell(f"{len(values)} seed was run: there is no error bar without a second")
    return combine([(value, 0.0) for value in values])


def seed_means(rows: pd.DataFrame, by: Sequence[str], columns: Sequence[str]) -> Iterator[dict[str, Any]]:
    """One row per group of seeds: values of ``by``, number of ``seeds``, mean and ``_err`` of each column.

    The ``_err`` of a column, if the table has one, is the error within a run, for `combine`. A single seed
    has only this error.
    """
    for key, group in rows.groupby(list(by)):
        row: dict[str, Any] = dict(zip(by, key))
        row["seeds"] = len(group)
        for column in columns:
            errors = group.get(f"{column}_err", [0.0]*len(group))
            row[column], row[f"{column}_err"] = combine(list(zip(group[column], errors)))
        yield row


def with_errors(**numbers: Measured) -> dict[str, float]:
    """Numbers and their errors as columns: `K` and `K_err` for K."""
    columns = dict[str, float]()
    for name, (value, err) in numbers.items():
        columns |= {name: value, f"{name}_err": err}
    return columns
