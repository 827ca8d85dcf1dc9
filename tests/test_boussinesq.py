"""The staggered Boussinesq solver: exact discrete laws, starts, orders, its two drivers, refusals."""
from functools import partial

import numpy as np
import pytest
from boxes import CAVITY, FREE_HALF, SQUARE, every_box, growth_rates

from continuum import boussinesq as bq
from continuum import linear
from continuum.boussinesq.projection import Projection, solvers
from continuum.steady import NewtonFailed
from studies.kit.fits import richardson


@every_box
def test_advection_makes_neither_kinetic_energy_nor_temperature_variance(box):
    case = bq.BoussinesqCase(ra=1e4, pr=2, box=box, rows=16)
    mac, rng = case.mac, np.random.default_rng(7)
    flow = mac.curl@(rng.standard_normal(mac.curl.shape[1])*mac.x.h)
    q = np.append(flow, rng.standard_normal(case.rows*case.columns))
    assert np.max(np.abs(mac.div@flow)) < 1e-12        # round-off of differences over h
    for change in mac.split(q*(mac.D@((mac.A@q)*(mac.B@q)))):
        assert np.sum(np.abs(change)) > 1
        assert abs(np.sum(change)) < 1e-13*np.sum(np.abs(change))       # round-off, in u^2, v^2, T^2 each


@every_box
@pytest.mark.parametrize("unknown", range(4), ids=["u", "v", "T", "p"])
def test_fast_solves_invert_the_assembled_operators(box, unknown):
    case = bq.BoussinesqCase(ra=1e4, pr=2, box=box, rows=12, columns=20)
    mac, rng = case.mac, np.random.default_rng(3)
    shape = [*mac.shapes, mac.shapes[2]][unknown]
    if unknown < 3:
        part = slice(*np.r_[0, mac.ends][unknown:unknown + 2])
        lap, a, b = mac.lap[part, part], 1.0, -0.03
    else:
        lap, a, b = mac.div@mac.grad, 0.0, 1.0
    f = rng.standard_normal(shape)
    f -= f.mean()*(unknown == 3)
    back = solvers(mac)[unknown]((a*f.ravel() + b*(lap@f.ravel())).reshape(shape), a, b)
    assert back == pytest.approx(f, abs=1e-12)      # round-off times the condition of 20^2


@every_box
@pytest.mark.parametrize("pr", [0.3, 7.0])
def test_heat_work_and_friction_are_in_exact_balance(box, pr):
    """Where heat comes in through plates alone, the Nusselt number follows in four ways."""
    state = bq.steady(bq.BoussinesqCase(ra=8000, pr=pr, box=box, rows=16))
    seen, (work, friction) = state.observe(), balance(state)
    assert friction == pytest.approx(work, rel=1e-10)       # what Newton's last step leaves
    if box in (bq.HALF_LAYER, FREE_HALF, SQUARE):
        assert seen.nu_bottom > 1.5
        assert [seen.nu_top, 1 + work] == pytest.approx([seen.nu_bottom]*2, rel=1e-10)


def balance(state) -> tuple[float, float]:
    """<vT> and the dissipation of kinetic energy, over kappa."""
    case, mac = state.case, state.case.mac
    flow = np.r_[state.q[:mac.ends[1]], np.zeros(state.parts[2].size)]
    return mac.cell*flow@(mac.lift@state.q)/case.kappa, -case.nu*mac.cell*flow@(mac.lap@flow)/case.kappa


@every_box
@pytest.mark.parametrize("rolls", [1, 2, 3, 4])
def test_rolls_are_counted(box, rolls):
    case = bq.BoussinesqCase(ra=5000, pr=1, box=box, rows=16)
    start = bq.roll(case, rolls)
    assert start.rolls == rolls
    # its rolls have flattened the mean profile: more heat at the plates than by conduction
    assert start.observe().nu_bottom > 1 or box is CAVITY
    assert bq.rest(case).rolls == 0


@pytest.mark.parametrize("ra, pr", [(3000.0, 7.0), (1500.0, 0.5)])
def test_growth_at_rest_converges_to_linear_theory(ra, pr):
    """Between rigid plates nu and kappa are not exchangeable: a solver that has them swapped fails."""
    exact = linear.growth_rate(ra=ra, pr=pr, k=np.pi)
    assert abs(exact - linear.growth_rate(ra=ra, pr=1/pr, k=np.pi)) > 5e-3
    cases = (bq.BoussinesqCase(ra=ra, pr=pr, rows=rows) for rows in (16, 24, 32))
    grown = [growth_rates(bq.rest(case))[0].real for case in cases]
    seen = richardson(grown, (16, 24, 32))
    assert abs(seen.order - 2) < 0.1
    # h^6 terms of 16 rows; distance at 32 rows is 1e-3
    assert seen.limit == pytest.approx(exact, abs=2e-5)
    assert seen.limit == pytest.approx(exact, abs=seen.error)


@every_box
def test_transient_ends_in_the_steady_state_of_newton(box):
    case = bq.BoussinesqCase(ra=8000, pr=0.71, box=box, rows=16)
    series, state = bq.transient(case, bq.roll(case), until=300.0), bq.steady(case)      # 4 H^2/kappa
    assert series.K[-1] == pytest.approx(state.K, rel=2e-6)
    assert series.state.q == pytest.approx(state.q, abs=1e-6)
    assert series.state.rolls == state.rolls == 1


def test_newton_forgets_a_start_that_is_not_free_of_divergence():
    case = bq.BoussinesqCase(ra=5000, pr=2, rows=16)
    coarse = bq.steady(bq.BoussinesqCase(ra=2500, pr=1, rows=12))
    start = coarse.on(case)
    assert np.max(np.abs(case.mac.div@start.q[:case.mac.ends[1]])) > 1e-6
    assert bq.steady(case, coarse).q == pytest.approx(bq.steady(case).q, abs=1e-9)        # Newton's tolerance


def test_time_step_is_of_second_order():
    case = bq.BoussinesqCase(ra=2e4, pr=0.5, box=SQUARE, rows=16)

    def marched(q, time, steps):
        flow = Projection(case, q)
        for _ in range(steps):
            flow.advance(time/steps)
        return flow.q
    start = marched(bq.roll(case).q, 1.0, 100)
    ends = [marched(start, 2.0, steps) for steps in (50, 100, 200)]
    ratio = np.linalg.norm(ends[0] - ends[1])/np.linalg.norm(ends[1] - ends[2])
    assert np.log2(ratio) == pytest.approx(2, abs=0.15)     # first step is Euler's: third order, still seen


case_of = partial(bq.BoussinesqCase, ra=5000.0, pr=1.0)
CASE = case_of(rows=16)


@pytest.mark.parametrize("make, rule", [
    (lambda: case_of(ra=0), "ra must be positive and finite, got 0"),
    (lambda: case_of(ra=-3.0), "ra must be positive"), (lambda: case_of(pr=0.0), "pr must be positive"),
    (lambda: case_of(pr=np.inf), "pr must be positive and finite, got inf"),
    (lambda: case_of(rows=15), "rows must be even and at least 8, got 15"),
    (lambda: case_of(rows=4), "rows must be even and at least 8"),
    (lambda: case_of(rows=16, columns=7), "columns must be even"),
    (lambda: bq.Box(width=0.0), "width must be positive"),
    (lambda: bq.Box(plates=bq.BoxEdges(flow=bq.End.WALL, heat=bq.End.MIRROR)), "no wall has a temperature"),
    (lambda: bq.State(case=CASE, q=np.append(bq.rest(CASE).q[:-1], np.nan)), "T is not finite at t = 0"),
    (lambda: bq.State(case=case_of(rows=32), q=bq.rest(CASE).q), r"use state.on\(case\)"),
    (lambda: bq.steady(case_of(box=SQUARE, rows=16), bq.rest(CASE)), "resample only within one box"),
    (lambda: bq.roll(CASE, 0), "0 rolls do not fit"),
    (lambda: bq.transient(CASE, bq.roll(CASE), until=-1.0), "until must be positive")])
def test_what_cannot_be_is_refused(make, rule):
    with pytest.raises(ValueError, match=rule):
        make()


def test_newton_that_fails_says_so():
    """On 8 rows a layer at Ra = 1e8 has no steady state that the steps reach."""
    with pytest.raises(NewtonFailed, match=r"no steady state at Ra = 1e\+08, Pr = 0.01 on 8 rows.*refine"):
        bq.steady(bq.BoussinesqCase(ra=1e8, pr=0.01, rows=8))
