"""The scene: what is derived from Ra, and the motionless state and the rolls that it knows."""
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.fluid import (
    EQUATIONS_OF_STATE,
    ConstNu,
    PowerLaw,
    VanDerWaals,
    conductivity,
    energy,
    pressure,
    viscosity,
)
from continuum.scene import Periodic, RayleighBenard, Walls

every_eos = pytest.mark.parametrize("eos", EQUATIONS_OF_STATE.values(), ids=EQUATIONS_OF_STATE)


def test_the_gas_of_the_paper():
    scene = RayleighBenard(ra=1e4)  # KHP95, Figs 8 and 9: L = 50, eta = 0.5 at Ra = 10 000
    assert (scene.nu, scene.k, scene.g) == (pytest.approx(0.5, rel=1e-9), pytest.approx(0.5, rel=1e-9), 1/50)
    assert scene.free_fall == pytest.approx(1, rel=1e-9)  # 1e-9: the expansivity is a difference


@every_eos
@pytest.mark.parametrize("pr", [1.0, 7.0])
@pytest.mark.parametrize("transport", [ConstNu, PowerLaw])
def test_rayleigh_and_prandtl_numbers_come_back(eos, pr, transport):
    s = RayleighBenard(ra=3000, eos=eos, pr=pr, transport=transport)
    nu, kappa = viscosity(s.law, 1.0, s.T_mean), conductivity(s.law, 1.0, s.T_mean)/eos.cv
    assert s.g*s.alpha*s.L**3*s.dT/(nu*kappa) == pytest.approx(3000, rel=1e-12)
    assert nu/kappa == pytest.approx(pr, rel=1e-12)


@every_eos
def test_the_motionless_state_is_in_balance_at_constant_density(eos):
    s = RayleighBenard(ra=3000, eos=eos, L=20.0)
    y = np.linspace(-10, 10, 41)
    P = pressure(eos, 1.0, energy(eos, 1.0, s.T(y)))
    # the pressure is linear in T at constant density for all three: differences are exact to round-off of P
    # ~ 5
    np.testing.assert_allclose(np.diff(P)/np.diff(y), -s.g, rtol=1e-12)


@pytest.mark.parametrize(("sides", "aspect", "rolls"), [
    (Periodic(), 2.0, None), (Periodic(), 2.0, 4), (Periodic(), 1.0, 2),
    (Walls(), 1.0, None), (Walls(), 1.0, 2), (Walls(), 2.0, 3)])
def test_initial_rolls(sides, aspect, rolls):
    s = RayleighBenard(ra=3000, sides=sides, aspect=aspect)
    x, y = s.width*np.linspace(-0.5, 0.5, 201), s.L*np.linspace(-0.5, 0.5, 201)[:, None]
    u, v = s.flow(x, y, 0.002, rolls)
    # trapezoids over whole periods are exact
    ke = np.trapezoid(np.trapezoid(u**2 + v**2, x), y[:, 0])/2/(s.width*s.L)
    assert ke == pytest.approx(0.002, rel=1e-10)
    edge = np.array([u[[0, -1]], v[[0, -1]]])
    np.testing.assert_allclose(edge, 0, atol=1e-15)
    if isinstance(sides, Walls):
        np.testing.assert_allclose(np.array([u[:, [0, -1]], v[:, [0, -1]]]), 0, atol=1e-15)
    else:
        np.testing.assert_allclose(v[:, 0], v[:, -1], atol=1e-15)


def test_the_initial_rolls_are_those_printed():
    s = RayleighBenard(ra=1e4)
    x, y, L = 13.0, -7.0, 50.0
    u, v = s.flow(x, y, 0.002)
    assert u/v == pytest.approx(np.sin(np.pi*x/L)*np.sin(2*np.pi*y/L)/(np.cos(np.pi*x/L)*np.cos(np.pi*y/L)),
                                rel=1e-12)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_rolls_between_walls_are_free_of_divergence(count):
    s, d = RayleighBenard(ra=1e4, sides=Walls(), aspect=1.0), 1e-3
    x, y = np.meshgrid(np.linspace(-20, 20, 9), np.linspace(-20, 20, 9))
    u_x = (s.flow(x + d, y, 1.0, count)[0] - s.flow(x - d, y, 1.0, count)[0])/(2*d)
    v_y = (s.flow(x, y + d, 1.0, count)[1] - s.flow(x, y - d, 1.0, count)[1])/(2*d)
    # central differences: d^2 (3 pi/50)^3/6 and round-off 1e-16/d, both below 1e-8 of slopes of order 0.3
    np.testing.assert_allclose(u_x + v_y, 0, atol=1e-8)


@pytest.mark.parametrize(("wrong", "words"), [
    ({"ra": 0.0}, "ra must be positive and finite, got 0"), ({"ra": np.inf}, "finite, got inf"),
    ({"ra": np.nan}, "ra must be positive"), ({"pr": 0.0}, "pr must"), ({"L": 0.0}, "L must be positive"),
    ({"L": np.nan}, "L must be .* got nan"),
    ({"aspect": -1.0}, "must be positive and finite"), ({"T_hot": 0.4}, "T_hot > T_cold"),
    ({"T_hot": np.inf}, "positive and finite"), ({"T_cold": np.nan}, "positive and finite"),
    ({"sides": "walls"}, "Periodic"), ({"eos": VanDerWaals(b=1.0)}, "rho b = 1"),
    ({"transport": PowerLaw, "T_hot": 2.5}, "temperatures"),
    ({"ra": "1e4"}, "ra must be a number, got '1e4': give it without quotes"),
    ({"eos": VanDerWaals}, r"needs an object, got the class VanDerWaals itself: give VanDerWaals\("),
    ({"transport": ConstNu(0.1, 0.1)}, "must be a class .*: give .*ConstNu.*, without .* which follow"),
    ({"transport": float}, "must be a class .*, got <class 'float'>: give ConstEta or ConstNu or")])
def test_bad_scenes_are_refused(wrong, words):
    with pytest.raises((ValueError, TypeError), match=words):
        RayleighBenard(**{"ra": 1000.0, **wrong})


@pytest.mark.parametrize(("sides", "ke", "rolls", "words"), [
    (Periodic(), 0.1, 3, "pairs, got 3"), (Walls(), 0.1, 0, "at least one roll"),
    (Periodic(), -0.1, 2, "negative")])
def test_rolls_that_do_not_fit_are_refused(sides, ke, rolls, words):
    with pytest.raises(ValueError, match=words):
        RayleighBenard(ra=1.0, sides=sides).flow(0.0, 0.0, ke, rolls)


@given(**dict.fromkeys(("ra", "L", "pr", "aspect"), st.floats(1e-308, 1e308)))
def test_a_scene_of_any_numbers_is_refused_or_has_finite_ones(**numbers):
    try:
        scene = RayleighBenard(**numbers)
    except ValueError:
        return
    derived = np.array([scene.nu, scene.k, scene.g, scene.viscous_time, scene.width])
    assert (derived > 0).all() and np.isfinite(derived).all()
