"""Error bars cover the truth as often as they say, compiling is counted apart, figures repeat."""
import itertools
import math

import numpy as np
import pytest

from studies.kit import figure, stats, timing
from studies.kit.timing import REPEATS, SPREAD_TO_ERR


def autoregressive(phi, n, runs, seed):
    """Series x(t+1) = phi x(t) + noise, started steady: mean 0, variance 1, tau = (1 + phi)/(2 (1 - phi))."""
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((n, runs))*math.sqrt(1 - phi**2)
    series = np.empty((n, runs))
    series[0] = rng.standard_normal(runs)
    for t in range(1, n):
        series[t] = phi*series[t - 1] + noise[t]
    return series.T


@pytest.mark.parametrize(("phi", "n"), [(0.0, 100), (0.9, 2000), (0.9, 400), (0.98, 4000)])
def test_intervals_cover_the_truth_as_often_as_they_say(phi, n):
    means = [stats.mean(x) for x in autoregressive(phi, n, 1000, seed=2)]
    covered = np.mean([abs(value) <= err for value, err in means])
    # binomial: sqrt(0.95 0.05/1000) = 0.007; 3 of these below, and with few independent samples the t factor
    # errs on the safe side
    assert 0.93 <= covered <= 0.99


def test_the_error_over_seeds_is_honest_with_and_without_scatter_between_runs():
    rng, inner = np.random.default_rng(3), 0.3
    for scatter, most in ((0.0, 1.0), (1.0, 0.97)):
        covered = 0
        for _ in range(2000):
            runs = [(rng.normal(0, scatter) + rng.normal(0, inner), 1.96*inner) for _ in range(3)]
            value, err = stats.combine(runs)
            covered += abs(value) <= err
        # never less than 95 % (binomial 0.005, 3 of these); without scatter the larger of two covers more
        assert 0.935 <= covered/2000 <= most


def test_means_of_what_does_not_fluctuate_or_is_too_short():
    assert stats.mean(np.full(50, 0.3)) == (0.3, 0.0)
    for wrong in (np.ones(9), [1.0]*20 + [math.nan]):
        with pytest.raises(ValueError, match="at least 10, all finite"):
            stats.mean(wrong)
    with pytest.raises(ValueError, match="no runs"):
        stats.combine([])


def test_a_figure_drawn_twice_is_the_same_file(tmp_path):
    def draw(path):
        page, axes = figure.figure()
        figure.errorbar(axes, [1, 2], [1, 2], [0.1, 0.1], number=1, label="a")
        figure.save(page, path)
        return path.read_bytes()
    assert draw(tmp_path / "a.png") == draw(tmp_path / "b.png")
    looks = [figure.look(number) for number in range(len(figure.COLOURS))]
    assert all(a[word] != b[word] for a, b in itertools.combinations(looks, 2) for word in a)


def test_compiling_is_counted_apart_and_once():
    import numba
    double = numba.njit(lambda x: 2*x)
    result, compiling, _ = timing.compile_and_run_seconds(lambda: double(2))
    assert result == 4 and compiling > 0
    assert timing.compile_and_run_seconds(lambda: double(3))[1] == 0.0, "nothing is compiled twice"


def test_the_interval_of_a_measured_step_covers_the_truth_as_often_as_it_says():
    """Normal scatter: the median of 7 repeats is off by less than the interval in 95 % of 4000 trials."""
    times = np.random.default_rng(5).standard_normal((4000, REPEATS))
    low, median, high = np.quantile(times, (0.25, 0.5, 0.75), axis=1)
    covered = np.mean(np.abs(median) < SPREAD_TO_ERR*(high - low)/2)
    # quartiles of 7 know sigma less well than t with 6 degrees of freedom takes for granted: up to 2 %
    assert 0.93 < covered < 0.97


def test_a_series_that_changes_says_so_in_its_error():
    rng, n = np.random.default_rng(0), 400
    # 0.3 %, 1.6 % once in 10^4
    assert sum(not stats.settled(rng.normal(size=200))[1] for _ in range(500)) <= 8
    # half a wave: its correlation time is as long as the series
    slow = 1 + 0.5*np.cos(np.pi*np.arange(n)/n)
    assert stats.settled(slow)[1] and not stats.settled(slow, most=0.3)[1]      # halves 1 +- 1/pi
    flat = rng.normal(1.0, 0.1, n)
    (value, err), steady = stats.settled(flat)
    assert steady and (value, err) == stats.mean(flat)
    (_, wide), steady = stats.settled(flat + np.repeat([0, 0.4], n//2))
    assert not steady and wide > 0.19          # half of what the halves differ by, 0.2
    # a steady rise looks like a long correlation in either half, too: the error covers both ends
    (_, wide), _ = stats.settled(flat + np.linspace(0, 0.4, n))
    assert wide > 0.19
