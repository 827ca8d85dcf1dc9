"""Limits of the time step: the search finds what is known, eigenvalues and trials agree."""
import numpy as np
import pytest
from scenes import rows_of

from studies.build.unguarded import bisected
from studies.hardcases.cases import AT_REST
from studies.hardcases.largest_step import Limit, largest_step


@pytest.mark.parametrize("rates, limit", [((1j, -0.1), 8**0.5), ((-1.0, -0.1), 2.7853), ((1j, 0.01), 8**0.5)])
def test_the_region_of_stability_ends_where_it_is_known_to(rates, limit):
    """What grows by itself, 0.01, sets no limit."""
    assert largest_step(np.array(rates)) == pytest.approx(limit, rel=1e-3)


@pytest.mark.parametrize("first", [0.3, 1.0, 7.0])
def test_bisection_finds_a_limit_from_either_side_and_says_so_when_there_is_none(first):
    limit = bisected(lambda dt: dt > 1.2345, first)
    assert abs(limit.value - 1.2345) <= limit.half < 0.006*limit.value
    assert all(np.isnan(bisected(lambda dt, bad=bad: bad, first).value) for bad in (True, False))


@pytest.mark.parametrize("method, eta", [("spam-range-2.5", 0.3), ("fixed-lattice", 0.0)])
def test_trial_eigenvalues_and_formula_agree(method, eta):
    trial, variant = AT_REST[method]
    case = Limit(method=method, trial=trial, variant=variant, scene="any", eta=eta, k=eta)
    [row] = rows_of(case, "limits")
    assert abs(row["measured"] - row["exact"]) < row["measured_err"] + 0.01*row["exact"]
    assert 0.95 < row["measured"]/row["predicted"] < 1.1      # ten points lack the wave that limits most: 1 %
