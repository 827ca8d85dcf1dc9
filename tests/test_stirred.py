"""The stress of sheared particles: flows that a force holds, the law of it, K that it foretells."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from crowd import rates

from continuum.gas.fields import placed
from continuum.linear import FREE, critical_ra
from continuum.scene import RayleighBenard
from studies.build.scenes import Tile
from studies.build.spam import TODAY, VARIANTS, at_rest, scattered
from studies.lattices import stirred
from studies.lattices.loss import Law, gain, laws, projected, roll, strained, thickness
from studies.lattices.stirred import MAKERS, SHEARED, STIRRED, Stirred, amplitude, stresses, symbol

PRINTED = VARIANTS["printed"]


def look(case, x, U=0.0):
    """Sums and a state of a flow at places x (n, 2)."""
    method, state = case.method, at_rest(x, 1.0)
    state[2:4] = U*method.v(state)
    return method, *method.look(state)[:2]


@pytest.mark.parametrize("name", ["printed", "direct"])
@pytest.mark.parametrize("mode", [STIRRED, SHEARED])
def test_on_a_lattice_the_force_holds_the_flow_but_for_the_symbol_of_friction(mode, name):
    case = Stirred(variant=VARIANTS[name], mode=mode, rows=25, U=1e-3)
    grid = np.stack(np.meshgrid(np.arange(25.0) - 12, np.arange(25.0) - 12), axis=-1).reshape(-1, 2)
    method, sums, state = look(case, grid, U=1e-3)
    out = np.empty_like(state)
    sums.rates(state, out)
    force = 1e-3*method.friction*method.k
    held = amplitude(out[2:4], method.v(state))
    assert held == pytest.approx(force*(1 - symbol(method)/sums.around.rho[0]), abs=1e-9*force)


def test_deviators_vanish_on_lattices_and_not_on_stretched_ones():
    for sides, size in ((np.arange(24.0) - 11.5, 0), (np.arange(20.0)*1.2 - 11.4, 5e-3)):
        grid = np.stack(np.meshgrid(np.arange(24.0) - 11.5, sides), axis=-1).reshape(-1, 2)
        _, sums, _ = look(Stirred(variant=PRINTED, rows=24), grid)
        assert (np.abs(stresses(sums)).max() < 1e-12) == (size == 0) and np.abs(stresses(sums)).max() >= size


def test_stresses_are_a_double_sum_over_pairs():
    case = Stirred(variant=PRINTED, rows=12)
    _, sums, state = look(case, np.random.default_rng(1).uniform(-6, 6, (144, 2)))
    d = state[:2, :, None] - state[:2, None, :]
    d -= 12*np.round(d/12)
    q = np.hypot(*d)/3.0
    slope = np.where(q < 1, -12*(1 - q)**2*5/(9*np.pi)/9, 0.0)      # Lucy: w'/r = -12 (1 - q)^2 w0/h^2
    P = (sums.less/sums.around.rho**2)[:144]
    f = (P[:, None] + P)*slope
    known = [(f*(d[0]**2 - d[1]**2)).sum(axis=1)/4, (f*2*d[0]*d[1]).sum(axis=1)/4]
    np.testing.assert_allclose(stresses(sums), known, atol=1e-12)


def test_slip_of_an_exact_profile():
    y = np.arange(40) - 19.5
    rows = np.array([0*y + 3, 3*(0.1 + np.cos(np.pi*y/40))])
    assert stirred.slip_length(rows, 3.0) == pytest.approx(4/np.pi)


def test_plates_that_slip_are_rigid_and_free_ones_in_the_limits():
    assert roll(0.0)[0] == pytest.approx(critical_ra(np.pi), rel=1e-6)
    assert roll(1e9)[0] == pytest.approx(critical_ra(np.pi, FREE), rel=1e-6)
    assert gain(0.0, 5000.0) == pytest.approx(1) and gain(0.1, 5000.0) > gain(0.02, 5000.0) > 1


def test_a_law_is_found_again_and_makes_a_fluid_more_viscous():
    """Of today's smooth particles it is a power or a viscosity, which may be less."""
    C, q, J = 0.007, 0.25, np.array([0.01, 0.02, 0.04, 0.08])
    runs = pd.DataFrame({"variant": "printed", "h": 3.0, "mode": "stirred", "flow": 0.8, "P": 1.0,
                         "friction": J, "excess_err": 1e-5, "stress": projected(q)*C*J**q})
    maker = runs.assign(variant="sph", excess=runs.stress, stress=np.nan)
    viscous = maker.assign(excess=-0.03*J)
    found = [next(laws(some)) for some in (runs.assign(excess=np.nan), maker, viscous)]
    for law, known in zip(found, [(C, q), (C, q), (-0.03, 1.0)]):
        assert [law["C"], law["q"]] == pytest.approx(known)
    layer = pd.DataFrame([{"ra": 1e4, "thick": x, "q": power, "share": 40.0, "ke": 1/x}
                          for x in (1.0, 1.2, 1.4, 2.0, 3.0) for power in (0.0, 0.5, 1.0)])
    assert thickness(layer, Law(C, q, 0.0), 1.0) == pytest.approx((1.28, 1/1.28), rel=2e-2)
    assert np.isnan(thickness(layer, Law(1.0, q, 0.0), 1.0)[0])
    assert thickness(layer, Law(-0.03, 1.0, 0.0), 1.0) == pytest.approx((0.97, 1/0.97), rel=1e-3)
    assert [projected(0.0), projected(1.0)] == pytest.approx([16/np.pi**2, 1.0])


def test_rate_of_strain_of_a_plain_shear():
    fields = placed(RayleighBenard(ra=1e4), 16, lambda x, y: (1.0, 0.3*y, 0.0, 1.0))
    rate, P, eta, _, _ = strained(fields, 2.0)
    np.testing.assert_allclose(rate, 0.3, rtol=1e-12)
    assert (P == 1).all() and eta == pytest.approx(fields.scene.nu/2)


@pytest.mark.parametrize("name", MAKERS)
def test_makers_are_pushed_by_the_force_alone(name):
    case = Stirred(variant=TODAY[name], rows=9)
    state = at_rest(scattered(Tile(width=9.0, L=9.0, law=case.method.law), 1), 1.0)
    state[2:4] = 0.2*case.method.v(state)
    free = replace(case.method, transport=TODAY[name].transport)
    pushed = rates(case.method, state) - rates(free, state)
    force = case.method.friction*case.method.k*case.method.U*case.method.v(state)
    np.testing.assert_allclose(pushed[2:4], force, atol=1e-14)
