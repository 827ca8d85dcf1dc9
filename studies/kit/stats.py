"""Means with honest errors: correlated series, few seeds.

Every error here is the half width of a 95 % interval, as are all ``_err`` columns of the tables.
"""
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.special import stdtrit


class Measured(NamedTuple):
    """A value and the half width of its 95 % interval."""

    value: float
    err: float


def correlation(x: np.ndarray) -> np.ndarray:
    """Autocorrelation rho(0..n-1) of a series about its mean; rho(0) = 1."""
    n = len(x)
    spectrum = rfft(x - x.mean(), next_fast_len(2*n))
    covariance = irfft(np.abs(spectrum)**2, next_fast_len(2*n))[:n]
    return covariance/covariance[0]


def window_and_tau(x: np.ndarray, c: float = 6.0) -> tuple[int, float]:
    """Sokal's window W, the first with W >= c tau(W), and tau(W) = 1/2 + sum_{1..W} rho, in samples.

    c = 6 leaves exp(-6) of an exponential decay outside the window. The term (2W + 1)/n undoes, to first
    order, the bias that comes from subtracting the mean of the same series.
    """
    tau = np.cumsum(correlation(x)) - 0.5
    inside = np.arange(len(x)) >= c*tau
    window = int(np.argmax(inside)) if inside.any() else len(x) - 1
    return window, max(0.5, float(tau[window]))*(1 + (2*window + 1)/len(x))


def mean(x: Sequence[float] | np.ndarray) -> Measured:
    """Mean of a steady, correlated series and its error.

    The estimated variance of the mean has itself a relative variance 2 (2W + 1)/n, as a chi^2 with
    n/(2W + 1) degrees of freedom has: hence the t factor, which keeps short series honest.

    Raises
    ------
    ValueError
        The series is too short or not finite.
    """
    x = np.asarray(x, dtype=float)
    if len(x) < 10 or not np.isfinite(x).all():
        raise ValueError(f"{len(x)} samples, {np.isfinite(x).sum()} of them finite: a mean with an error "
                         "needs at least 10, all finite; run longer or sample more often")
    if np.ptp(x) == 0:
        return Measured(float(x[0]), 0.0)
    window, tau = window_and_tau(x)
    freedom = max(1.0, len(x)/(2*window + 1))
    return Measured(float(x.mean()), float(stdtrit(freedom, 0.975)*x.std()*np.sqrt(2*tau/len(x))))


def settled(x: Sequence[float] | np.ndarray, most: float = np.inf) -> tuple[Measured, bool]:
    """Mean of a series and whether its halves agree; where they do not, half of their difference is in the error.

    Two halves of a steady series differ by more than 1.5 times the root of the sum of squares of their 95 % intervals
    once in 300 times. Where noise is as long as the series these intervals exclude nothing: halves that differ by more than
    the fraction `most` of the mean do not agree, either.
    """
    x = np.asarray(x, dtype=float)
    whole, (first, last) = mean(x), (mean(half) for half in np.array_split(x, 2))
    apart = abs(first.value - last.value)
    if apart <= 1.5*np.hypot(first.err, last.err) and apart <= most*abs(whole.value):
        return whole, True
    return Measured(whole.value, float(np.hypot(whole.err, apart/2))), False


def combine(runs: Sequence[tuple[float, float]]) -> Measured:
    """Mean over seeds from (value, err) of each run; the error is the larger of two.

    One is what the errors within the runs leave after averaging, the other the scatter between runs with its
    t factor. The scatter knows what a single run cannot (runs that settle in different states), but with two
    or three seeds it is small by chance too often.
    """
    values, errs = np.array(runs, dtype=float).reshape(-1, 2).T
    n = len(values)
    if n == 0:
        raise ValueError("no runs to combine: give (value, err) of at least one seed")
    within = float(np.sqrt((errs**2).sum())/n)
    between = float(stdtrit(n - 1, 0.975)*values.std(ddof=1)/np.sqrt(n)) if n > 1 else 0.0
    return Measured(float(values.mean()), max(within, between))
