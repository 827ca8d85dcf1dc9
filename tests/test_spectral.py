"""The spectral method: its slopes, branches, the cavity, refusals; claims judge its digits and its onset."""
import numpy as np
import pytest
from numpy.polynomial import legendre

from continuum.fluid import ConstNu, VanDerWaals
from continuum.linear import critical_ra
from continuum.published import table
from continuum.scene import RayleighBenard
from continuum.spectral import cavity
from continuum.spectral.branch import begun, bordered, branch
from continuum.spectral.cavity import Cavity, CavityLaws, observed, peak
from continuum.spectral.laws import BoussinesqLaws, GasLaws
from continuum.spectral.newton import Galerkin, SpectralState, steady

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


@pytest.mark.parametrize("equations", [Galerkin(LAWS["gas"], 5), CAVITY])
def test_fields_anywhere_are_those_at_the_points(equations):
    state = SpectralState(equations, np.random.default_rng(1).normal(size=equations.kept.sum()), ())
    x, y = (each.ravel() for each in np.meshgrid(equations.x.points, equations.y.points, indexing="ij"))
    assert np.allclose(state.fields(np.stack([x, y], 1)), state.at[:, 0].reshape(4, -1), rtol=0, atol=1e-12)


@pytest.mark.parametrize("make, words", [
    (lambda: steady(LAWS["gas"], 100), "takes 4 to 48 functions along an axis, got 100: 24 do for eight"),
    (lambda: list(branch(1.0, 8, (0.1, -0.1))), r"must be positive, got -0\.1: they lead away from rest")])
def test_too_many_functions_and_a_step_back_are_refused(make, words):
    with pytest.raises(ValueError, match=words):
        make()


def test_a_branch_begins_at_the_onset_and_has_the_states_that_newton_finds():
    first, *states = branch(0.71, 8, (0.002, 0.05, 0.2))
    ras = [state.equations.laws.ra for state in states]
    onset = first.equations.laws.ra
    assert onset == pytest.approx(critical_ra(np.pi), rel=1e-8) and onset < ras[0] < ras[1]
    assert steady(BoussinesqLaws(ras[-1], 0.71), 8).K == pytest.approx(states[-1].K, rel=1e-9)


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
    """Five digits of another solution, places to 1e-4 (published/devahldavis.csv)."""
    state, known = cavity.steady(CavityLaws(1e4, 0.71), 24), table("devahldavis").set_index("id")["spectral"]
    seen = observed(state)
    for name, value in seen.items():
        assert value == pytest.approx(known[f"devahldavis-{name}-1e4"], rel=2e-5, abs=1e-4), name
    hot = 1 - 2*legendre.legval(-1, legendre.legder(cavity.series(state)[3]))[0]
    assert hot == pytest.approx(seen["nu"], rel=1e-6)


def test_what_half_a_turn_leaves_out_of_the_cavity_is_zero():
    """In a steady state the rates of all functions vanish, those that were left out, too."""
    state = cavity.steady(CavityLaws(1e4, 0.71), 8)
    whole, q = Cavity(CavityLaws(1e4, 0.71), 8), state.equations.amplitudes(state.q)
    whole.kept[:] = True
    rates = whole.rates(q.ravel())
    assert np.abs(rates).max() < 1e-8 and np.abs(state.q).max() > 0.1


def test_the_largest_value_of_a_series_is_found_inside_and_at_its_ends():
    assert peak(np.array([2/3, 0.0, -2/3])) == pytest.approx((1.0, 0.5))       # 1 - z^2
    assert peak(np.array([0.0, 1.0])) == (1.0, 1.0)
