"""Integral hydrodynamics as cases of the study rb: rows, order, the wrong limit of unmended heating."""
import numpy as np
import pytest

from continuum.scene import RayleighBenard, Walls
from studies.build.fixed import SCHEMES, fluid, layer
from studies.build.measure import rolls
from studies.rb.runs.points import DihRun
from studies.rb.tables import KINETIC


def one(tmp_path, scheme="fixed-lattice", rows=8, ra=1e4, **more):
    case = DihRun(scene=RayleighBenard(ra=ra, L=float(rows)), scheme=SCHEMES[scheme], **more)
    [row] = case.run(lambda done: None, tmp_path).rows["kinetic_energy"]
    return row


def test_a_row_has_the_columns_of_the_table(tmp_path):
    row = one(tmp_path, rows=12)
    assert set(row) <= set(KINETIC.columns) | {"cpu_s", "compile_s"}
    assert row["converged"] and row["rolls"] == 2 and abs(row["mass_drift"]) < 1e-13
    assert row["nu_err"] < 0.003*row["nu"]      # both plates and the change of the last tenth of the time


def test_energy_falls_to_its_limit_as_the_square_of_the_spacing(tmp_path):
    """8, 12, 16 rows: two pairs give one limit to 1 %, the rest of fourth order; 0.4891e-2 is the grid's."""
    K = {rows: one(tmp_path/str(rows), rows=rows)["ke"] for rows in (8, 12, 16)}
    limits = [(K[b]*b**2 - K[a]*a**2)/(b**2 - a**2) for a, b in ((8, 12), (12, 16))]
    assert limits[1] == pytest.approx(limits[0], rel=0.03)
    assert limits[1] == pytest.approx(0.004891, rel=0.005)


def test_heating_as_the_pairs_work_lowers_the_energy(tmp_path):
    """Unmended, Eq. 51 heats by eta |grad v|^2: 1.3 % less K at these sizes as in the limit."""
    ratio = one(tmp_path/"a", "fixed-lattice-printed-heat", 12)["ke"]/one(tmp_path/"b", rows=12)["ke"]
    assert 0.98 < ratio < 0.995


@pytest.mark.parametrize(("scheme", "within"), [
    ("fixed-lattice", 1e-6), ("fixed-lattice-nested", 1e-6),
    ("fixed-random-plates", 1e-3)])     # weak currents where hydrostatic pressure bends between points
def test_heat_through_plates_is_conduction_at_rest(tmp_path, scheme, within):
    """Far below onset the layer comes to rest: Nu = 1 on a lattice exactly, whatever the share."""
    assert one(tmp_path, scheme, ra=200.0, t_end=200.0)["nu"] == pytest.approx(1, abs=within)


def test_points_on_plates_give_them_the_heat_of_the_fluid_and_keep_its_mass(tmp_path):
    """Nu of both plates agrees as the flow settles; 12 random rows are some 10 % from the grid's K."""
    row = one(tmp_path, "fixed-random-plates", rows=12, t_end=100.0)
    assert row["converged"] and row["rolls"] == 2 and abs(row["mass_drift"]) < 1e-13
    assert row["nu_err"] < 0.003*row["nu"] and row["particles"] == 24*13
    assert row["ke"] == pytest.approx(0.004891, rel=0.2)


def test_side_walls_are_refused(tmp_path):
    with pytest.raises(ValueError, match="fixed-lattice cannot take sides"):
        fluid(RayleighBenard(ra=1e4, L=12.0, aspect=1.0, sides=Walls()), SCHEMES["fixed-lattice"], 1)


def test_rolls_are_twice_the_strongest_harmonic():
    scene = RayleighBenard(ra=1e4, L=16.0)
    x = layer(scene, SCHEMES["fixed-lattice"], 1).x
    for m in (1, 2, 3):
        assert rolls(scene, x, 0.1*np.cos(2*np.pi*m*x[:, 0]/scene.width)) == 2*m
    assert rolls(scene, x, 0*x[:, 0]) == 0
