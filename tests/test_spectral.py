"""The spectral method: its slopes, how fast it converges, onset, bad input; claims hold grids against it."""
from functools import partial

import numpy as np
import pytest
from numpy.polynomial import legendre

from continuum.fluid import ConstNu, VanDerWaals
from continuum.linear import critical, critical_ra
from continuum.published import table
from continuum.scene import RayleighBenard
from continuum.spectral import cavity
from continuum.spectral.branch import begun, bordered, branch
from continuum.spectral.cavity import Cavity, CavityLaws, observed, peak
from continuum.spectral.laws import BoussinesqLaws, GasLaws
from continuum.spectral.newton import Galerkin, SpectralState, onset, steady

OTHER = RayleighBenard(ra=5e3, eos=VanDerWaals(), transport=ConstNu)
LAWS = {"gas": GasLaws(RayleighBenard(ra=5e3)), "other gas": GasLaws(OTHER),
        "boussinesq": BoussinesqLaws(5e3, 0.71)}
CAVITY = Cavity(CavityLaws(5e3, 0.71), 5)


@pytest.mark.parametrize("equations", [*(Galerkin(laws, 5) for laws in LAWS.values()), CAVITY],
                         ids=[*LAWS, "cavity"])
def test_slopes_are_those_of_the_rates(equations):
    """Of a random state; central differences err by step^2 and round-off/step."""
    random = np.random.default_rng(1)
    q, along = 0.01*random.normal(size=(2, equations.kept.sum()))
    change = (equations.rates(q - 1e-3*along) - equations.rates(q + 1e-3*along))/2e-3
    assert equations.slopes(q)@along == pytest.approx(change, abs=1e-9)


@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS)
def test_errors_fall_exponentially(laws):
    """Tenfold at least with every four functions; second order would leave 0.44 and 0.56."""
    states = [steady(laws, 8)]
    for n in (12, 16, 20):
        states.append(steady(laws, n, states[-1]))
    for name in ("K", "Nu"):
        errors = np.abs([getattr(one, name) - getattr(states[-1], name) for one in states[:-1]])
        assert (errors[1:] < errors[:-1]/10).all() and errors[-1] < 1e-5


def test_onset_has_ten_digits():
    for width, known in ((2.0, critical_ra(np.pi)), (2*np.pi/critical().k, critical().ra)):
        ra = onset(partial(BoussinesqLaws, pr=1.0, width=width), 12, 1500.0, 2000.0)
        assert ra == pytest.approx(known, rel=1e-10)
    assert steady(BoussinesqLaws(1700.0, 1.0), 8).K < 1e-15 < steady(BoussinesqLaws(1720.0, 1.0), 8).K


def test_too_many_functions_are_refused_with_a_way_out():
    with pytest.raises(ValueError, match="takes 4 to 48 functions along an axis, got 100: 24 do for eight"):
        steady(LAWS["gas"], 100)


def test_a_branch_has_the_states_that_newton_finds_and_leaves_rest_as_a_square_root():
    """K over Ra/Ra_c - 1 changes by as much as that, three times it here; below onset there is nothing."""
    first, *states = branch(0.71, 8, (0.002, 0.05, 0.2))
    ras = [state.equations.laws.ra for state in states]
    assert steady(BoussinesqLaws(ras[-1], 0.71), 8).K == pytest.approx(states[-1].K, rel=1e-9)
    ra_c = first.equations.laws.ra
    near, far = (state.K/(ra/ra_c - 1) for state, ra in zip(states, ras[:2]))
    assert ra_c < ras[0] < ras[1] and near == pytest.approx(far, rel=3*(ras[1]/ra_c - 1))


def test_slopes_along_a_branch_are_those_of_the_rates():
    """In amplitudes and in Ra; central differences err by step^2 and round-off/step."""
    def at(s: float) -> Galerkin:
        return Galerkin(BoussinesqLaws(2e3/s**2, 0.71), 5)
    random, (z, tangent) = np.random.default_rng(1), begun(at(1.0))
    along = 0.01*random.normal(size=z.size)
    z = z + 0.01*random.normal(size=z.size)
    ahead, behind = ((at(p[-1]).rates(p[:-1]), tangent@p) for p in (z + 1e-3*along, z - 1e-3*along))
    change = [*(behind[0] - ahead[0])/2e-3, (ahead[1] - behind[1])/2e-3]
    assert bordered(at, z, tangent)@along == pytest.approx(np.array(change), abs=1e-6)


def test_the_cavity_has_the_known_numbers_and_as_much_heat_inside_as_at_its_side():
    """Five digits of another solution, places to 1e-4 (published/devahldavis.csv); errors fall tenfold."""
    states = list[SpectralState]()
    for n in (8, 12, 16, 24):
        states.append(cavity.steady(CavityLaws(1e4, 0.71), n, *states[-1:]))
    known, (*few, seen) = table("devahldavis").set_index("id")["spectral"], [observed(one) for one in states]
    for name, value in seen.items():
        assert value == pytest.approx(known[f"devahldavis-{name}-1e4"], rel=2e-5, abs=1e-4), name
    errors = np.array([abs(one["nu"]/seen["nu"] - 1) for one in few])
    assert (errors[1:] < errors[:-1]/10).all() and errors[0] < 0.1
    hot = 1 - 2*legendre.legval(-1, legendre.legder(cavity.series(states[-1])[3]))[0]
    assert hot == pytest.approx(seen["nu"], rel=1e-6)


def test_what_half_a_turn_leaves_out_of_the_cavity_is_zero():
    """The rates of all functions, those that were left out too, vanish in the steady state."""
    state = cavity.steady(CavityLaws(1e4, 0.71), 8)
    whole, q = Cavity(CavityLaws(1e4, 0.71), 8), state.equations.amplitudes(state.q)
    whole.kept[:] = True
    rates = whole.rates(q.ravel())
    assert np.abs(rates).max() < 1e-8 and np.abs(state.q).max() > 0.1


def test_the_largest_value_of_a_series_is_found_inside_and_at_its_ends():
    assert peak(np.array([2/3, 0.0, -2/3])) == pytest.approx((1.0, 0.5))       # 1 - z^2
    assert peak(np.array([0.0, 1.0])) == (1.0, 1.0)


def test_no_step_back_along_a_branch():
    with pytest.raises(ValueError, match=r"must be positive, got -0\.1: they lead away from rest"):
        next(branch(1.0, 8, (0.1, -0.1)))
