"""Constitutive relations: each law over every equation of state; claims judge the printed dense fluid."""
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from continuum import fluid
from continuum.jit import jit

RHO, T = (q.ravel() for q in np.meshgrid([0.7, 0.9, 1.0, 1.15], [0.6, 1.0, 1.4]))
CONSISTENT = {"ideal", "vdw"}
NEGATIVE = "must not be negative, got -0.5: 0 switches it off"
ROUND_OFF = 1e-13  # a few dozen operations on numbers of order 10

every_eos = pytest.mark.parametrize("eos", fluid.EQUATIONS_OF_STATE.values(), ids=fluid.EQUATIONS_OF_STATE)
consistent = pytest.mark.parametrize("eos", [fluid.EQUATIONS_OF_STATE[name] for name in sorted(CONSISTENT)])


def slope(f, x):
    """df/dx by a complex step: exact to round-off."""
    return np.imag(f(x + 1e-40j))/1e-40


@every_eos
def test_slopes_of_the_pressure(eos):
    e = fluid.energy(eos, RHO, T)
    by_rho, by_e = fluid.pressure_slopes(eos, RHO, e)
    np.testing.assert_allclose(by_rho, slope(lambda r: fluid.pressure(eos, r, e), RHO), rtol=ROUND_OFF)
    np.testing.assert_allclose(by_e*np.ones_like(e), slope(lambda u: fluid.pressure(eos, RHO, u), e),
                               rtol=ROUND_OFF)


@consistent
def test_temperature_inverts_energy(eos):
    np.testing.assert_allclose(fluid.temperature(eos, RHO, fluid.energy(eos, RHO, T)), T, rtol=ROUND_OFF)


@consistent
def test_maxwell_relation(eos):
    """(dE/dV)_T = T (dP/dT)_V - P for one particle, V = 1/rho; both are zero of the ideal gas."""
    P = fluid.pressure(eos, RHO, fluid.energy(eos, RHO, T))
    dE_dV = -RHO**2*slope(lambda r: fluid.energy(eos, r, T), RHO)
    np.testing.assert_allclose(dE_dV, T*fluid.thermal_pressure(eos, RHO, T) - P, atol=10*ROUND_OFF)


@every_eos
def test_thermal_pressure(eos):
    P_T = slope(lambda q: fluid.pressure(eos, RHO, fluid.energy(eos, RHO, q)), T)
    np.testing.assert_allclose(fluid.thermal_pressure(eos, RHO, T), P_T, rtol=ROUND_OFF)


@every_eos
@pytest.mark.parametrize("state", [(1.0, 1.0), (0.9, 1.3)])
def test_expansivity_is_the_shrinking_of_density_at_constant_pressure(eos, state):
    rho, theta = state
    P, step = fluid.pressure(eos, rho, fluid.energy(eos, rho, theta)), 1e-3

    def density(T):
        return brentq(lambda r: fluid.pressure(eos, r, fluid.energy(eos, r, T)) - P, 0.9*rho, 1.1*rho,
                      xtol=1e-14)
    # central difference: relative error of order step^2 and the 1e-10 of the inner difference
    shrinking = -(density(theta + step) - density(theta - step))/(2*step*rho)
    assert fluid.expansivity(eos, rho, theta) == pytest.approx(shrinking, rel=1e-5)


@pytest.mark.parametrize(("refuse", "given", "words"), [
    (fluid.check_state, (fluid.VanDerWaals(), 2.0, 1.0), "rho b = 1 must stay below 1"),
    (fluid.check_state, (fluid.VanDerWaals(), 1.0, -0.6), "VanDerWaals"),
    (fluid.check_state, (fluid.IdealGas(), -1, 1), "rho = -1"),
    (fluid.check_state, (fluid.DenseFluid(), 1.0, -1.0), "DenseFluid"),
    (fluid.check_state, (fluid.IdealGas(), 1, -0.1), "e = -0.1"),
    (fluid.check_state, (fluid.IdealGas(), 1.0, np.nan), "e = nan"),
    (fluid.VanDerWaals, (0.5, -0.5), NEGATIVE),
    (fluid.ConstEta, (-0.5, 1.0), NEGATIVE),
    (fluid.ConstEta, (1.0, -0.5), NEGATIVE), (fluid.ConstNu, (1.0, -0.5), NEGATIVE),
    (fluid.PowerLaw, (-0.5, 1.0), NEGATIVE)])
def test_a_state_outside_and_a_negative_number_are_refused(refuse, given, words):
    with pytest.raises(ValueError, match=words):
        refuse(*given)


def test_transport_laws():
    eta, nu = fluid.ConstEta(eta=0.5, k=0.7), fluid.ConstNu(nu=0.5, kappa=0.7, cv=1.5)
    assert (fluid.viscosity(eta, 0.8, 1.2), fluid.conductivity(eta, 0.8, 1.2)) == (0.5, 0.7)
    assert fluid.viscosity(nu, 0.8, 1.2)/0.8 == pytest.approx(0.5, rel=1e-15)
    assert fluid.conductivity(nu, 0.8, 1.2)/(0.8*1.5) == pytest.approx(0.7, rel=1e-15)
    power = fluid.PowerLaw(eta=0.5, k=0.7, m=1.0, n=0.5)
    assert fluid.viscosity(power, 2.0, 4.0) == pytest.approx(0.5*2*2, rel=1e-15)
    assert fluid.conductivity(power, 2.0, 4.0) == pytest.approx(0.7*2*2, rel=1e-15)


@given(st.sampled_from([fluid.IdealGas, fluid.VanDerWaals, fluid.DenseFluid,
                        fluid.ConstEta, fluid.ConstNu, fluid.PowerLaw]),
       st.lists(st.floats() | st.sampled_from(["1", None, 1j, True, np.ma.masked]), max_size=4))
def test_a_law_of_any_numbers_is_refused_or_has_finite_ones(kind, numbers):
    try:
        law = kind(*numbers)
    except (TypeError, ValueError):
        return
    assert np.isfinite(law).all() and getattr(law, "cv", 1.0) > 0
    assert all(value >= 0 for name, value in law._asdict().items() if name not in ("a", "m", "n"))


def test_stress_in_a_plane_is_that_of_the_tensor():
    grad = np.random.default_rng(1).normal(size=(20, 2, 2))  # grad[a, b] = d_a v_b
    full = fluid.stress_tensor(0.3, 0.2, grad)
    xx, xy, yy = fluid.stress(0.3, 0.2, grad[:, 0, 0], grad[:, 0, 1], grad[:, 1, 0], grad[:, 1, 1])
    np.testing.assert_allclose([[xx, xy], [xy, yy]], full.transpose(1, 2, 0), atol=ROUND_OFF)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_shear_makes_stress_without_trace_rotation_none_and_expansion_only_bulk_stress(d):
    grad = np.random.default_rng(2).normal(size=(d, d))
    shear = fluid.stress_tensor(0.3, 0.0, grad)
    np.testing.assert_allclose(shear, shear.T, atol=ROUND_OFF)
    np.testing.assert_allclose(np.trace(shear), 0, atol=ROUND_OFF)
    np.testing.assert_allclose(fluid.stress_tensor(0.3, 0.2, grad - grad.T), 0, atol=ROUND_OFF)
    np.testing.assert_allclose(fluid.stress_tensor(0.3, 0.2, np.eye(d)), 0.2*d*np.eye(d), atol=ROUND_OFF)


@jit
def compiled(eos, law, rho, e):
    theta = fluid.temperature(eos, rho, e)
    return fluid.pressure(eos, rho, e), theta, fluid.energy(eos, rho, theta), fluid.viscosity(law, rho, theta)


@every_eos
def test_compiled_code_uses_the_same_formulas(eos):
    rho, e = 0.9, fluid.energy(eos, 0.9, 1.2)
    plain = compiled.py_func(eos, fluid.ConstNu(0.5, 0.5), rho, e)
    np.testing.assert_allclose(compiled(eos, fluid.ConstNu(0.5, 0.5), rho, e), plain, rtol=ROUND_OFF)


def test_an_unknown_type_is_refused_with_what_is_known():
    class Steam(tuple):
        pass
    with pytest.raises(TypeError,
                       match=r"pressure\(Steam.*it knows IdealGas, VanDerWaals, DenseFluid.*add a formula"):
        fluid.pressure(Steam(), 1.0, 1.0)
