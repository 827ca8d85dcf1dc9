"""Slow flow with slip against published drags and the dilute limit; walls of frozen particles; what their tables give."""
import numpy as np
import pandas as pd
import pytest
from scipy.integrate import quad

from continuum.published import published
from particles.dissipative.dpd import Dpd
from studies.kit.claim import CannotTell
from studies.kit.table import Tables
from studies.noise.dpd import derive_surfaces as derived
from studies.noise.dpd.claims_surfaces import SURFACES, together
from studies.noise.dpd.slip import drag, slip_of
from studies.noise.dpd.surfaces import FAST, Array, Beyond, Inside, jackknife, parabola


@pytest.mark.parametrize("c", [0.05, 0.1, 0.2, 0.3])
def test_without_slip_the_drag_is_the_published_one(c):
    known = published(f"cylinders-drag-{c:g}")
    assert drag(c) == pytest.approx(known.value, abs=known.uncertainty)


@pytest.mark.parametrize("slip", [0.1, 1.0, 100.0])
def test_far_apart_slip_is_a_smaller_radius(slip):
    """The stream near a cylinder is A (r ln r - r/(2 (1 + 2 slip)) + ...): the next term is of the solid fraction's order."""
    same = np.exp(-slip/(1 + 2*slip))       # the radius without slip that a distant stream takes this one for
    assert drag(1e-4, slip) == pytest.approx(drag(1e-4*same**2), rel=1e-4)


def test_slip_is_told_back_and_a_little_of_it_is_as_much_less_radius():
    assert slip_of(drag(0.2, 0.15)/drag(0.2), 0.2) == pytest.approx(0.15, abs=1e-9)
    assert drag(0.2, 1e-4) == pytest.approx(drag(0.2*(1 - 1e-4)**2), rel=1e-6)
    assert drag(0.2, -0.05) == drag(0.2*1.05**2)
    assert np.isnan(slip_of(0.1, 0.2))


@pytest.mark.parametrize("c", [0.0, 0.8])
def test_cylinders_that_touch_are_refused(c):
    with pytest.raises(ValueError, match="touch at pi/4"):
        drag(c)


def test_a_wall_begins_beyond_half_the_height_of_each_period():
    wall = Beyond(8.0, 11.0)
    x = np.array([[0.0]*5, [3.9, 4.1, -4.1, 6.0, 7.1]])
    assert wall(x).tolist() == [False, True, True, True, False]
    v = np.array([[0.0]*5, [1.0, 1.0, 1.0, 1.0, -1.0]])
    # up at 4.1 is inward, at -4.1 and at 6 - 11 = -5 outward
    assert wall.turned(x, v).tolist() == [False, True, False, False, False]
    assert len(wall.across()) == 44 and wall.across().sum() == pytest.approx(0, abs=1e-12)


def test_parabola_and_jackknife():
    """u = (half^2 + 2 half b - y^2) bend/2 slips by b; of a mean the jackknife is its textbook error."""
    y = np.linspace(-3, 3, 24)
    assert parabola(y, 0.05*(16 + 2*4*0.3 - y**2), 4.0) == pytest.approx([0.3, 0.1])
    parts = np.random.default_rng(0).normal(size=(20, 1))
    found = jackknife(lambda some: some.mean(axis=0), parts)[0]
    assert found.value == pytest.approx(parts.mean())
    assert found.err == pytest.approx(2.093*parts.std(ddof=1)/np.sqrt(20), rel=1e-3)       # t of 19


def test_a_dense_body_is_as_dense_as_asked():
    """What is inside will be frozen: as many times what the fluid has there, to three sigma of an ideal gas of them."""
    still, inside = Dpd(box=(4.0, 4.0, 4.0)), Inside(1.2, 4.0)
    for denser in (1.0, 2.0):
        state, wanted = Array(denser=denser).filled(still, inside), 3*denser*np.pi*1.2**2*4
        assert abs(inside(state[:3]).sum() - wanted) < 3*np.sqrt(wanted)


def test_friction_across_a_plane():
    """pi gamma rho^2/240: of pairs across a plane, w^2 cos^2 of the angle with the stream, times their height over it."""
    radial = quad(lambda r: r**3*(1 - r)**2, 0, 1)[0]
    angular = np.pi*quad(lambda c: (1 - c**2)*c, 0, 1)[0]
    assert derived.rubbing_slip(1.0, 3.0, 2.0) == pytest.approx(1/(derived.GAMMA*3*2*radial*angular), rel=1e-12)


def test_fluid_that_is_as_dense_as_frozen_ones_are_few_stays_so():
    """With nothing frozen density is that outside; with twice the fluid's density hardly any gets in."""
    assert derived.inside_density(3.0, 0.0) == pytest.approx(3.0)
    assert derived.inside_density(3.0, 3.0) == pytest.approx(0.40, abs=0.01)
    assert derived.inside_density(3.0, 6.0) < 1e-5


def tables(slip: float) -> tuple[pd.DataFrame, ...]:
    """Cylinders of radius 2 with the drag of this slip in a fluid of viscosity 0.9 (rho/3)^2, walls of it, inertia of 2 %."""
    side, rho = 2*np.sqrt(np.pi/0.2), 3.1
    eta, volume = 0.9*(rho/3)**2, side**2*4
    U = 0.2
    reynolds = 4*U*rho/eta
    push = drag(0.2, slip/2)*eta*U*4/(volume*rho)*(1 + 0.02*(reynolds/2)**2)
    row = {"surface": "frozen", "radius": 2.0, "asked": 2.0, "dt": 0.04, "side": side, "depth": 4.0, "push": push, "far": rho,
           "momentum": U*rho*volume, "momentum_err": 0.0, "balance_err": 0.0}
    wall = {"surface": "frozen", "slip": slip, "slip_err": 0.02, "height": 8.0}
    shear = [{"a": 25.0, "integrator": "VelocityVerlet", "dt": 0.04, "rate": 0.3, "rho": at, "viscosity": 0.9*(at/3)**2,
              "viscosity_err": 0.01} for at in (2.7, 3.0, 3.3)]
    return (pd.DataFrame([row]), pd.DataFrame([wall]), pd.DataFrame([{"fraction": 0.2, "reynolds": 2.0, "ratio": 1.02}]),
            pd.DataFrame(shear))


@pytest.mark.parametrize("slip", [0.0, 0.3])
def test_the_slip_that_was_put_in_comes_out(slip):
    arrays, slabs, inertia, shear = tables(slip)
    law = pd.DataFrame(derived.viscosities(shear))
    assert law["power"].iloc[0] == pytest.approx(2) and law["eta"].iloc[0] == pytest.approx(0.9)
    found = next(derived.surfaces(arrays, slabs, inertia, law))
    # 51.53 is 6e-5 above the collocation
    assert found["over"] == pytest.approx(1, abs=1e-4) and found["slip"] == pytest.approx(slip, abs=1e-3)
    assert found["predicted"] == pytest.approx(drag(0.2, slip/2)/drag(0.2))


def test_together_the_error_of_the_viscosity_stays():
    """Three alike: chance goes down by sqrt(3), the viscosity's part does not."""
    row = {"radius": 2.0, "asked": FAST, "over": 0.9, "over_err": 0.9*0.05, "viscosity": 0.8, "viscosity_err": 0.8*0.03}
    rows = pd.DataFrame([{**row, "surface": surface} for surface in SURFACES])
    found = together(Tables({"surfaces": rows}))
    assert found.value == pytest.approx(0.9) and found.err == pytest.approx(0.9*np.hypot(0.04/np.sqrt(3), 0.03))
    with pytest.raises(CannotTell, match="no flat wall"):
        together(Tables({"surfaces": rows.assign(over=[0.9, 0.9, np.nan])}))
