"""Transport in the study operators: waves against symbols, series against their equations, plates."""
from dataclasses import replace

import numpy as np
import pytest
from crowd import rates
from scenes import rows_of

from continuum.exact.shear import couette, poiseuille
from continuum.exact.waves import QUANTITIES, LinearGas, continuum, quantities
from continuum.fluid import ConstNu
from particles.integral.edge_makers import delaunay, renormalised
from particles.weights import Lucy
from studies.build.fixed import lattice_waves
from studies.build.setting import DISORDERS
from studies.operators.cases import DRIVES
from studies.operators.transport import BETWEEN, SPEED, WAYS, Decay, between_rows

GAS = LinearGas(0.3, 0.2, 0.4)
COUETTE, _ = DRIVES
on_lattice, jittered_images, _ = BETWEEN.values()
#: what the continuum is told by
TOLD = ("viscosity", "bulk viscosity", "conductivity", "sound speed")


def decay(transport, make=renormalised, disorder="lattice", counts=(12, 8)):
    """Rows by quantity."""
    case = Decay(transport=transport, maker=make, points=DISORDERS[disorder], counts=counts, h=2.0, zeta=0.2)
    return {row["quantity"]: row for row in rows_of(case, "waves")}


def test_continuum_of_long_waves_has_the_coefficients_put_in():
    k = 2*np.pi/1000        # sound is c - O(k^2) with a share of (l + q)^2 k^2/8 c^2 = 5e-6
    values = quantities(continuum(GAS, k), k)
    expected = (0.3, 0.2, 0.4, np.sqrt(2), k**2*(0.5 + 0.4/2)/2, k**2*0.4/2)
    np.testing.assert_allclose([values[name] for name in QUANTITIES], expected, rtol=1e-5)


@pytest.mark.parametrize("transport", WAYS)
def test_waves_measured_in_time_are_those_of_the_symbol(transport):
    k = 2*np.pi/12
    waves = lattice_waves(GAS, Lucy.of(h=2.0), np.array([k, 0.0]), nested=transport == "nested")
    symbol = quantities(waves, k)
    for name, row in decay(transport).items():
        steps = 1e-5*max(row["continuum"], 0.1)     # they leave 4e-6
        assert abs(row["measured"] - symbol[name]) < steps
        assert name not in TOLD or abs(symbol[name]/row["continuum"] - 1) > 0.01


def test_coefficients_on_irregular_points_are_near_the_continuum():
    """Second order: (2 pi/16)^2 times some tenths."""
    for row in decay("nested", delaunay, "jittered-0.1", (16, 8)).values():
        assert abs(row["measured"] - row["continuum"]) < 0.05*row["continuum"]
        assert 0 < row["measured_err"] < 0.02*row["continuum"]


@pytest.mark.parametrize(("series", "force", "final"), [(couette, 0.0, lambda y: y),
                                                        (poiseuille, 8.0, lambda y: 4*y*(1 - y))])
def test_series_solve_their_equation(series, force, final):
    y, time, d = np.linspace(0.05, 0.95, 19), 0.07, 1e-4
    slope = (series(y, time + d) - series(y, time - d))/(2*d)
    curvature = (series(y + d, time) - 2*series(y, time) + series(y - d, time))/d**2
    np.testing.assert_allclose(slope, curvature + force, atol=1e-4)     # round-off over d^2 is 2e-8
    np.testing.assert_allclose(series(y, 5.0), final(y), atol=1e-12)
    plates = np.array([0.0, 1.0])
    np.testing.assert_allclose(series(plates, time), final(plates), atol=1e-12)
    assert np.abs(series(y, 1e-3)[:15]).max() < 0.01        # from rest


def change(method, u):
    """d(state)/dt of a flow u along the plates."""
    return rates(method, method.state(1.0, np.stack([u, 0*u], axis=1), np.ones(len(u))))


@pytest.mark.parametrize("make", [on_lattice, jittered_images])
def test_a_fluid_that_moves_with_both_plates_goes_on(make):
    method = replace(make(COUETTE, 8, 1), slide=(0.3, 0.3))
    assert np.abs(change(method, 0.3 + 0*method.x[:, 0])).max() < 1e-12


@pytest.mark.parametrize(("make", "steady"),
                         [(on_lattice, True), (between_rows, True), (jittered_images, False)])
def test_linear_shear_is_steady_where_edges_are_exact_on_it_up_to_the_plates(make, steady):
    """Triangles end on rows of points; what images see of irregular points has a kink, and is not steady."""
    method = make(COUETTE, 8, 1)
    found = change(method, SPEED*(method.x[:, 1]/8 + 0.5))
    assert (np.abs(found[:3]).max() < 1e-15*len(method.x)) == steady
    if make is on_lattice:      # heated by the work of the plates
        assert found[3].mean() == pytest.approx(method.law.eta*(SPEED/8)**2, rel=1e-9)


def test_plates_that_slide_refuse_other_laws():
    with pytest.raises(ValueError, match="take ConstEta"):
        replace(on_lattice(COUETTE, 8, 1), law=ConstNu(0.1, 0.1))
