"""The staggered Boussinesq solver: exact discrete laws, starts, what is refused."""
import numpy as np
import pytest
from boxes import CAVITY, FREE_HALF, SQUARE, every_box, random_state

from continuum.boussinesq import (
    HALF_LAYER,
    BoussinesqCase,
    Box,
    BoxEdges,
    End,
    State,
    rest,
    roll,
    steady,
    transient,
)
from continuum.boussinesq.projection import solvers
from continuum.steady import NewtonFailed


@every_box
def test_advection_makes_neither_kinetic_energy_nor_temperature_variance(box):
    case = BoussinesqCase(ra=1e4, pr=2, box=box, rows=16)
    mac, state = case.mac, random_state(case)
    assert np.max(np.abs(mac.div@state.q[:mac.ends[1]])) < 1e-12        # round-off of differences over h
    for change in mac.split(state.q*(mac.D@((mac.A@state.q)*(mac.B@state.q)))):
        assert np.sum(np.abs(change)) > 1
        assert abs(np.sum(change)) < 1e-13*np.sum(np.abs(change))       # round-off, in u^2, v^2, T^2 each


@every_box
@pytest.mark.parametrize("unknown", range(4), ids=["u", "v", "T", "p"])
def test_fast_solves_invert_the_assembled_operators(box, unknown):
    case = BoussinesqCase(ra=1e4, pr=2, box=box, rows=12, columns=20)
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


@pytest.mark.parametrize("pr", [0.3, 7.0])
@pytest.mark.parametrize("box", [HALF_LAYER, FREE_HALF, SQUARE], ids=["half layer", "free plates", "square"])
def test_four_ways_to_the_nusselt_number_agree_exactly(box, pr):
    state = steady(BoussinesqCase(ra=8000, pr=pr, box=box, rows=16))
    seen, (work, friction) = state.observe(), balance(state)
    assert seen.nu_bottom > 1.5
    others = [seen.nu_top, 1 + work, 1 + friction]
    assert others == pytest.approx([seen.nu_bottom]*3, rel=1e-10)       # what Newton's last step leaves


@every_box
def test_work_balances_friction_in_every_box(box):
    work, friction = balance(steady(BoussinesqCase(ra=3e4, pr=0.71, box=box, rows=16)))
    assert friction == pytest.approx(work, rel=1e-10)       # what Newton's last step leaves


def balance(state) -> tuple[float, float]:
    """<vT> and the dissipation of kinetic energy, over kappa."""
    case, mac = state.case, state.case.mac
    flow = np.r_[state.q[:mac.ends[1]], np.zeros(state.parts[2].size)]
    return mac.cell*flow@(mac.lift@state.q)/case.kappa, -case.nu*mac.cell*flow@(mac.lap@flow)/case.kappa


@every_box
@pytest.mark.parametrize("rolls", [1, 2, 3, 4])
def test_rolls_are_counted(box, rolls):
    case = BoussinesqCase(ra=5000, pr=1, box=box, rows=16)
    start = roll(case, rolls)
    assert start.rolls == rolls
    # its rolls have flattened the mean profile: more heat at the plates than by conduction
    assert start.observe().nu_bottom > 1 or box is CAVITY
    assert rest(case).rolls == 0


@pytest.mark.parametrize("bad, rule", [
    ({"ra": 0}, "ra must be positive and finite, got 0"), ({"ra": -3.0}, "ra must be positive"),
    ({"pr": 0.0}, "pr must be positive"), ({"pr": float("inf")}, "pr must be positive and finite, got inf"),
    ({"rows": 15}, "rows must be even and at least 8, got 15"),
    ({"rows": 4}, "rows must be even and at least 8"),
    ({"rows": 16, "columns": 7}, "columns must be even"),
])
def test_refuses_bad_cases(bad, rule):
    with pytest.raises(ValueError, match=rule):
        BoussinesqCase(**{"ra": 5000.0, "pr": 1.0, **bad})


def test_refuses_bad_boxes():
    with pytest.raises(ValueError, match="width must be positive"):
        Box(width=0.0)
    with pytest.raises(ValueError, match="no wall has a temperature"):
        Box(plates=BoxEdges(flow=End.WALL, heat=End.MIRROR))


def test_refuses_bad_states_and_runs():
    case = BoussinesqCase(ra=5000, pr=1, rows=16)
    broken = rest(case).q.copy()
    broken[-1] = np.nan
    with pytest.raises(ValueError, match="T is not finite at t = 0"):
        State(case=case, q=broken)
    with pytest.raises(ValueError, match=r"use state.on\(case\)"):
        State(case=BoussinesqCase(ra=5000, pr=1, rows=32), q=rest(case).q)
    with pytest.raises(ValueError, match="resample only within one box"):
        steady(BoussinesqCase(ra=5000, pr=1, box=SQUARE, rows=16), rest(case))
    with pytest.raises(ValueError, match="0 rolls do not fit"):
        roll(case, 0)
    with pytest.raises(ValueError, match="until must be positive"):
        transient(case, roll(case), until=-1.0)


def test_newton_that_fails_says_so():
    """On 8 rows a layer at Ra = 1e8 has no steady state that the steps reach."""
    with pytest.raises(NewtonFailed, match=r"no steady state at Ra = 1e\+08, Pr = 0.01 on 8 rows.*refine"):
        steady(BoussinesqCase(ra=1e8, pr=0.01, rows=8))
