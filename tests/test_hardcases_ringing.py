"""Sound on lattices that are not stable: sums, what grows from round-off, what is read off the rows."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from particles.limits import lattice_sums
from particles.smooth.spam import Direct, Nested
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read
from studies.lattices import ringing_part
from studies.lattices.long_sound import LongSound, longest, matrix
from studies.lattices.ringing import Ringing, Ripple, foretold, growth, ripples, rounding, symbols
from studies.lattices.waves import vectors

SHORT = Ringing(lattice="square", weight=Monaghan, length=40)


@pytest.mark.parametrize("weight", [Lucy, WendlandC2])
def test_sums_are_those_of_the_step_limit_frictions_too(weight):
    k = vectors("square", (8, 8))
    found, known = symbols(weight.of(h=3.0), "square", k), lattice_sums(weight.of(h=3.0), 1.0, 1.0, k)
    assert found.rho == pytest.approx(known.rho, rel=1e-14)
    for kind in (Nested, Direct):
        np.testing.assert_allclose(found.k2[kind], known.k2[kind], atol=1e-13)


@pytest.mark.parametrize("friction", [0.0, 2.0])
def test_what_is_let_go_grows_as_the_sum_says(friction):
    """One motion, rounded off once: u'' + friction u' = w u."""
    w, time, dt = 0.12, 60.0, 1e9
    s = -friction/2 + np.hypot(friction/2, np.sqrt(w))
    known = solve_ivp(lambda t, y: (y[1], w*y[0] - friction*y[1]), (0, time), (1.0, 0.0), rtol=1e-10, atol=1e-12).y[1, -1]
    found = foretold([Ripple(np.zeros(2), np.array([0.0, 1.0]), -w, s)], time, dt, np.array([7.0, 1.0]))
    assert found == pytest.approx(known, rel=1e-3)


def test_places_are_rounded_off_by_their_last_digit():
    assert rounding(np.array([[1.5, -3.0]])) == pytest.approx(np.array([2.0**-52, 2.0**-51])/np.sqrt(12))


def test_stable_lattices_have_nothing_that_grows():
    for h, grows in ((2.5, False), (3.0, True)):
        case = replace(SHORT, weight=Lucy, h=h)
        rates = [one.rate for one in ripples(case.method, "square", case.cells)]
        assert max(rates) > 0.1 if grows else max(rates) < 1e-10


def test_viscosity_slows_what_grows():
    rate = {kind: max(one.rate for one in ripples(case.method, "square", case.cells)) for kind in (Nested, Direct)
            if (case := replace(SHORT, transport=kind))}
    assert 0 < rate[Direct] < rate[Nested] < 0.42        # the rate without any


def test_a_wave_is_lost_to_round_off_at_the_rate_of_the_lattice():
    row = SHORT.run(lambda done: None, None).rows["ringing"][0]
    assert row["measured"] == pytest.approx(row["predicted"], rel=0.01)
    assert 0.1 < row["foretold"]/row["across"] < 10 and 1e-3 < row["across"]/row["wave"] < 1


def test_starts_are_waves_in_their_box():
    for kind in ("square", "hexagonal"):
        case = replace(SHORT, lattice=kind)
        x, y, *v, T = case.start()
        assert np.abs(x).max() < case.at.box[0]/2 and np.abs(y).max() < case.at.box[1]/2
        assert not np.any(v) and np.mean(T) == pytest.approx(1.0, abs=1e-12)


def test_rates_are_read_between_round_off_and_large_motions():
    t = np.linspace(0, 100, 400)
    found = growth(t, np.minimum(1e-17 + 1e-18*np.exp(0.4*t), 1e-3), 1e-14)
    assert found.value == pytest.approx(0.4, rel=1e-3)
    assert np.isnan(growth(t, np.full(400, 1e-17), 1e-14).value)


def test_lengths_are_interpolated():
    rows = pd.DataFrame([{**replace(SHORT, length=length, seed=seed).columns, "wave": 1.0, "foretold": np.exp(length - 45.0),
                          "across": np.exp(length - 46.0)} for length in (40, 44, 48) for seed in (1, 2)])
    row = next(ringing_part.lost(rows))
    assert (row["predicted"], row["measured"]) == pytest.approx((45.0, 46.0))
    assert np.isnan(ringing_part.crossing(rows[rows["length"] < 45], "across"))


def test_without_tables_nothing_is_decided():
    assert {row["verdict"] for row in judge(ringing_part.CLAIMS, Tables(), "hardcases")} == {"undecidable"}


@pytest.mark.skipif(not (RESULTS/"hardcases"/"ringing.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_and_figures_follow_from_committed_tables():
    tables = load(ringing_part.PART.tables, "hardcases")
    found = {row["id"]: row["verdict"] for row in judge(ringing_part.CLAIMS, tables, "hardcases")}
    kept = read(RESULTS/"claims.csv").set_index("id")["verdict"]
    assert {name: kept[name] for name in found} == found
    assert set(ringing_part.figures(tables)) <= {path.stem for path in (RESULTS/"hardcases").glob("*.png")}


# --- long waves ---------------------------------------------------------------------------------------------------------


def test_long_sound_errs_as_lattice_sums_foretell():
    for row in LongSound(wave=replace(SHORT, length=16)).run(lambda done: None, None).rows["sound_errors"]:
        assert row["measured"] == pytest.approx(row["foretold"], rel=0.01)


def test_the_longest_waves_have_one_speed_by_either_sum():
    """Rates without viscosity and conduction, those of the step limit's symbols, too."""
    wave = replace(SHORT, length=4000)
    s = np.linalg.eigvals(matrix(wave))
    assert np.abs(s.imag).max()/wave.k/np.sqrt(2) == pytest.approx(longest(wave), rel=2e-3)
