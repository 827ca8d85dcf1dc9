"""Questions to tables, each on four rows with the answer known by hand; arithmetic; fits; what is refused."""
import math

import numpy as np
import pandas as pd
import pytest
from scipy.special import stdtrit

from studies.kit import ask, fits
from studies.kit.ask import one
from studies.kit.claim import Claim, judge
from studies.kit.csvfile import OtherTable
from studies.kit.stats import CannotTell, Measured, combine, over_seeds, seed_means
from studies.kit.table import Tables

ROWS = pd.DataFrame({"name": ["a", "a", "b", "b"], "n": [2, 1, 4, 8], "y": [4.0, 1.0, 16.0, 64.0],
                     "y_err": [0.3, 0.1, 0.4, 0.2], "exact": [4.0, 2.0, 8.0, 64.0],
                     "gone": [1.0, math.nan, 1.0, 1.0]})
TABLES = Tables(rows=ROWS)


def almost(value: float, err: float = 0.0):
    """To round-off."""
    return pytest.approx((value, err), rel=1e-12, abs=1e-12)


# --- questions ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("value", "answer"), [
    (one("rows", "y", n=8), (64, 0.2)), (one("rows", "exact", "y > 60"), (64, 0)),
    (one("rows", "2*y", n=2, err="2*y_err"), (8, 0.6)),
    (ask.first("rows", "y", by="n"), (1, 0.1)), (ask.last("rows", "y", by="-n"), (1, 0.1)),
    (ask.last("rows", "y", by="y", name="a"), (4, 0.3)), (ask.largest("rows", "y"), (64, 0.4)),
    (ask.largest("rows", "abs(y/exact - 1)", err="y_err/exact", n=(1, 2)), (0.5, 0.075)),
    (ask.least("rows", "y", "1 < n < 8"), (4, 0.4)),
    (ask.farthest("rows", "y", centre=10.0, name=("a", "b"), such="n < 8"), (1, 0.1)),
    (ask.total("rows", "y", name="a"), (5, math.hypot(0.3, 0.1))), (ask.total("rows", "exact > 3"), (3, 0)),
    (ask.share("rows", "exact > 3"), (0.75, 0)),
    (ask.over_seeds("rows", "exact", name="a"), (3, stdtrit(1, 0.975)*math.sqrt(2)/math.sqrt(2))),
    (ask.over_seeds("rows", "y", n=(4,)), (16, 0.4)),
    (ask.spread("rows", "y", name="a"), (4, math.hypot(0.3, 4*0.1))), (ask.power("rows", "y", "n"), (2, 0)),
    (ask.largest("rows", "cos(pi*n) + sqrt(n)*0 + log10(exp(0)*10) + abs(-1)"), (3, 0)),
])
def test_a_question_has_its_number_and_its_error(value, answer):
    assert value(TABLES) == almost(*answer)


def test_questions_are_calculated_with():
    a, b = one("rows", "y", n=2), one("rows", "y", n=4)
    assert (b/a)(TABLES) == almost(4, math.hypot(0.4, 4*0.3)/4)
    assert (b - a)(TABLES) == almost(12, 0.5)
    assert (b + a)(TABLES) == almost(20, 0.5)
    assert (a*b)(TABLES) == almost(64, math.hypot(0.3*16, 4*0.4))
    assert (1 - a/2)(TABLES) == almost(-1, 0.15)
    assert abs(1 - a/2)(TABLES) == almost(1, 0.15)
    assert (2/a)(TABLES) == almost(0.5, 0.5*0.3/4)
    assert (3*a + 1)(TABLES) == almost(13, 0.9)
    assert (-a**2)(TABLES) == almost(-16, 2*4*0.3)


def test_several_questions_in_one():
    a, b = (one("rows", "y", n=n) for n in (2, 8))
    assert ask.largest_of(a, b)(TABLES) == almost(64, 0.3)
    assert ask.largest_per("name", ask.spread("rows", "exact"))(TABLES) == almost(8)
    farthest = ask.farthest_per("name", ask.total("rows", "y"), centre=0.0)
    assert farthest(TABLES) == almost(80, math.hypot(0.4, 0.2))


def test_groups_that_lack_rows_of_a_question_are_left_out_unless_all_do():
    small = one("rows", "exact", n=(1, 8))
    assert ask.largest_per("name", small/one("rows", "exact", n=2))(TABLES) == almost(0.5)
    with pytest.raises(CannotTell, match="rows where n = 3 has 0 rows"):
        ask.largest_per("name", small/one("rows", "exact", n=3))(TABLES)


def test_a_question_tells_its_formula():
    assert str(ask.largest("rows", "abs(y/exact - 1)", "n > 1", name="a", err="0")) == (
        "largest(abs(y/exact - 1)) in rows where name = a and n > 1")
    assert str(1 - one("rows", "y", n=2)/one("rows", "y", n=(4, 8))) == (
        "1 - ((one(y) in rows where n = 2) / (one(y) in rows where n in (4, 8)))")
    assert str(ask.power("rows", "y", "n")) == "power(y over n) in rows"
    assert str(ask.of(by_hand)) == "number of rows"


def by_hand(tables: Tables) -> Measured:
    """number of rows

    More of it.
    """
    return Measured(float(len(tables["rows"])))


# --- what is not there ----------------------------------------------------------------------------


@pytest.mark.parametrize(("value", "words"), [
    (one("other", "y"), "not run yet: table other is not there"),
    (one("rows", "y", n=3), "rows where n = 3 has 0 rows of 1 or more"),
    (ask.total("rows", "y", "n > 3", need=3), "rows where n > 3 has 2 rows of 3 or more"),
    (ask.largest("rows", "gone"), "gone is not a number in 1 of 4 rows of table rows"),
    (ask.over_seeds("rows", "exact", n=2), "no error bar without a second"),
    (one("rows", "y", n=2)/(one("rows", "y", n=2) - 4), "a ratio to 0 .* not told from zero"),
])
def test_what_has_not_been_run_cannot_be_told(value, words):
    with pytest.raises(CannotTell, match=words):
        value(TABLES)


def toy(value):
    return Claim(id="rr98-toy", source="RR98 Eq. 1", statement="none", value=value, at_most=1, because="none")


@pytest.mark.parametrize(("value", "words"), [
    (one("rows", "exac", n=2), "table rows has no column exac: it has name, n, y"),
    (one("rows", "exact", m=2), "table rows has no column m: it has name, n, y"),
    (one("rows", "exact", "kind == 'a'"), "no column kind"), (one("rows", "y + (", n=2), "is no formula"),
    (one("rows", "where(exact)", n=2), "cannot be computed"),
    (one("rows", "y/exact", n=2), "y_err: say what the error is, as in err='y_err/exact', or err='0'"),
    (one("rows", "exact", name="a"), "2 such rows")])
def test_a_mistake_is_one_line_with_study_claim_and_table(value, words):
    with pytest.raises(OtherTable, match=words) as error:
        judge([toy(value)], TABLES, "toys")
    line = str(error.value)
    assert "\n" not in line and "study toys, claim rr98-toy" in line and "rows" in line
    assert line.endswith("correct the claim")


def test_a_verdict_has_its_formula():
    row, = judge([toy(one("rows", "y", n=8))], TABLES, "toys")
    assert row["formula"] == "one(y) in rows where n = 8" and (row["measured"], row["err"]) == (64, 0.2)


# --- arithmetic, seeds, fits ----------------------------------------------------------------------


def test_means_over_seeds():
    scatter = stdtrit(2, 0.975)*1.0/math.sqrt(3)
    assert over_seeds([1, 2, 3]) == almost(2, scatter)
    frame = pd.DataFrame({"h": [1, 1, 1, 2], "v": [1.0, 2.0, 3.0, 5.0], "w": [1.0]*4, "w_err": [0.3]*4})
    first, second = seed_means(frame, ["h"], ["v", "w"])
    assert first == pytest.approx({"h": 1, "seeds": 3, "v": 2.0, "v_err": scatter, "w": 1.0,
                                   "w_err": 0.3/math.sqrt(3)})
    assert (second["seeds"], second["v"], second["w_err"]) == (1, 5.0, 0.3)
    assert combine([(1.0, 0.1)]) == (1.0, 0.1)


X, Y = np.array([1.0, 2.0, 4.0, 7.0]), np.array([1.1, 1.9, 4.2, 6.8])


def test_errors_of_values_add_to_the_scatter():
    err, about = np.array([0.1, 0.2, 0.3, 0.4]), X - X.mean()
    own = math.sqrt(np.sum((about*err)**2))/(about@about)
    assert fits.line(X, 2*X, err=err).slope == almost(2, own)
    assert fits.weighted([0.0, 1.0], [3.0, 5.0], [0.3, 0.4]).slope == almost(2, 0.5)
    assert fits.line(X, Y, err=err).slope.err == pytest.approx(math.hypot(fits.line(X, Y).slope.err, own))
    log_err = fits.line(np.log(X), 2*np.log(X), err=err).slope.err
    assert fits.power_law(X, X**2, err=err*X**2).slope.err == pytest.approx(log_err)


@pytest.mark.parametrize("degree", [1, 2])
def test_weights_and_parabolas_are_those_of_polyfit(degree):
    weight = np.array([1.0, 2.0, 3.0, 4.0])
    found, cov = np.polyfit(X, Y, degree, w=weight, cov=True)
    fit = fits.polynomial(X, Y, degree, weight=weight)
    assert fit.coefficients == pytest.approx(found[::-1])
    t, at = stdtrit(len(X) - degree - 1, 0.975), 5.0**np.arange(degree, -1, -1)
    assert fit.intercept.err == pytest.approx(t*math.sqrt(cov[-1, -1]))
    assert fit.slope.err == pytest.approx(t*math.sqrt(cov[-2, -2]))
    assert fit.at(5.0) == pytest.approx((at@found, t*math.sqrt(at@cov@at)))


def test_fits_of_too_few_values_cannot_be_told():
    for fit in (lambda: fits.line([1, 2], [1, 2]), lambda: fits.grid_limit([8, 16], [1, 2])):
        with pytest.raises(CannotTell, match="not run yet"):
            fit()
