"""The study ordering: a quick rebuild of its tables, and what the committed ones must say."""
import numpy as np
import pandas as pd
import pytest

import studies.ordering.cases as ordering
from particles.integral.edge_makers import plain, renormalised
from particles.integral.interpolants import W
from particles.integral.points import lattice, of_positions, wrapped
from particles.weights import Lucy
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read
from studies.ordering import claims as ordering_claims
from studies.ordering import derive as ordering_derive
from studies.ordering import tables
from studies.ordering.brackets import form_errors
from studies.ordering.waves import wave_errors


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    out = tmp_path_factory.mktemp("results")
    return ordering.STUDY.run("quick", workers=1, out=out), out


def test_quick_rebuild_writes_every_table(quick):
    found, out = quick
    for table in tables.ALL:
        if table.name != "slopes":      # two wavelengths make no slope over wavelengths; seven ranges make one over h
            assert set(table.columns) <= set(found[table.name].columns)
    assert (out/"ordering"/"operators.csv").read_text().startswith("# commit ")
    assert len(ordering.STUDY.draw(out)) == 6
    assert {row["id"] for row in ordering.STUDY.judge(out)} == {claim.id for claim in ordering.STUDY.claims}


def test_the_error_of_a_lattice_is_its_symbol():
    """grad sin kx = (sum over the lattice) cos kx: the measured error is that of the wave number that edges see."""
    at, weight, k = lattice((32, 16)), Lucy.of(h=3.0), 2*np.pi/32
    edges = renormalised(at, weight)
    symbol = float((edges.areas[0]@np.exp(1j*k*at.x[:, 0])/np.exp(1j*k*at.x[:, 0])/2).imag.mean()/edges.V[0])
    gradient, _ = wave_errors(edges, at.x[:, 0], k)
    assert gradient == pytest.approx(abs(symbol/k - 1), rel=1e-9)


def test_slopes_have_honest_errors():
    """Slope 2 with 5 % of scatter in each error: the interval covers it in 95 % of 200 trials, give or take 4 %."""
    rng, x = np.random.default_rng(0), np.log(np.array([16, 24, 32, 48, 64, 96]))
    found = [ordering_derive.line(x, 2*x + rng.normal(0, 0.05, 6)) for _ in range(200)]
    assert 0.91 < np.mean([abs(slope - 2) < err for slope, err in found]) <= 0.995


committed = pytest.mark.skipif(not (RESULTS/"ordering"/"slopes.csv").exists(), reason="no tables are committed yet")


@committed
def test_committed_verdicts_follow_from_committed_tables():
    rows = {row["id"]: row["verdict"] for row in judge(ordering.STUDY.claims, load(tables.ALL, "ordering"), "ordering")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "ordering"]
    assert dict(zip(kept["id"], kept["verdict"], strict=True)) == rows


@committed
def test_compact_weights_are_of_second_order_on_a_lattice():
    """Slope 2.0 +- 0.05 at a range of 3 spacings: the next order, (h/lambda)^4, takes 0.01 to 0.02 at these wavelengths."""
    slopes = pd.DataFrame(read(RESULTS/"ordering"/"slopes.csv", tables.SLOPES.columns))
    some = slopes[(slopes["maker"] == "renormalised") & (slopes["points"] == "lattice") & (slopes["fixed"] == "h/a")
                  & (slopes["at"] == 3.0) & (slopes["operator"] == "gradient")]
    assert set(some["weight"]) == {"Lucy", "Monaghan", "WendlandC2", "WendlandC4", "WendlandC6"}
    assert np.all(np.abs(some["slope"] - 2) < 0.05)


def test_forms_of_the_gradient_differ_by_what_they_make_of_a_constant():
    """On a lattice, where the sum over e_ij is zero, all three are one; by hand for points of which each has two neighbours."""
    at, weight, k = lattice((32, 16)), Lucy.of(h=3.0), 2*np.pi/32
    found = form_errors(plain(at, weight), at.x[:, 0], k)
    assert found["single"] == pytest.approx(wave_errors(plain(at, weight), at.x[:, 0], k)[0], rel=1e-9)
    assert found["sum"] == pytest.approx(found["single"], rel=1e-9) == pytest.approx(found["difference"], rel=1e-9)

    shift = np.where(np.arange(16) % 2, 0.2, 0.0)        # every second point of a line moved: neighbours at 1.2 and 0.8
    uneven = of_positions(wrapped(lattice((16,)).x + shift[:, None], np.array([16.0])), (16.0,))
    near, x = Lucy.of(h=1.5, d=1), uneven.x[:, 0]
    right, left = np.where(shift > 0, 0.8, 1.2), np.where(shift > 0, 1.2, 0.8)
    W_right, W_left = (W(near, r) for r in (right, left))
    missed = dict.fromkeys(("single", "sum", "difference"), 0.0)
    for phase in (0.0, np.pi/2):
        def f(y, phase=phase):
            return np.sin(np.pi/8*y + phase)
        for form, own in (("single", 0), ("sum", 1), ("difference", -1)):
            slope = W_right*(f(x + right) + own*f(x)) - W_left*(f(x - left) + own*f(x))
            missed[form] += np.mean((slope - np.pi/8*np.cos(np.pi/8*x + phase))**2)
    found = form_errors(plain(uneven, near), x, np.pi/8)
    assert found == pytest.approx({form: np.sqrt(total)*8/np.pi for form, total in missed.items()}, rel=1e-9)
    assert found["sum"] > 2*found["difference"]


def test_wide_weights_on_a_lattice_are_of_second_order_in_their_range():
    """By hand: 1 - sum W x sin(kx)/(k r) over sum W x^2/r, W = q (1 - q)^2, of which only the slope over h is asked."""
    k, errors, ranges = 2*np.pi/96, [], (4, 5, 6, 7, 8)
    for h in ranges:
        x, y = np.meshgrid(np.arange(-h, h + 1.0), np.arange(-h, h + 1.0))
        r = np.hypot(x, y) + 1e-300
        pull = np.where(r < h, (1 - r/h)**2, 0.0)          # W/r, but for a factor
        errors.append(1 - np.sum(pull*x*np.sin(k*x))/k/np.sum(pull*x**2))
    assert ordering_claims.wide_slope(Tables()).value == pytest.approx(np.polyfit(np.log(ranges), np.log(errors), 1)[0], abs=1e-9)
