"""The study conservation: what changes are divided by, what runs keep, what controls lose."""
import numpy as np
import pytest
from scenes import rows_of

import studies.conservation.cases as conservation
from continuum.fluid import IdealGas
from particles.fields import Fields
from studies.conservation.drift import MODES, PLATES
from studies.conservation.sums import Unsymmetric, sizes


def row(case, table="drift"):
    return rows_of(case, table)[0]


def largest(columns):
    return max(columns[name] for name in ("mass", "momentum", "energy"))


def test_changes_are_divided_by_mass_momenta_and_energy():
    v, rho = np.array([[3.0, 4.0], [0.0, -1.0]]), np.array([1.0, 2.0])
    fields = Fields(v, v, rho, np.array([1.0, 2.0]), np.array([1.0, 0.5]))
    expected = [2.0, 6.0, 6.0, 1.0 + 12.5 + 2.0 + 0.5]
    assert list(sizes(IdealGas(), fields)) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_compiled_runs_keep_their_sums(mode):
    columns = row(conservation.layer("exact", "jittered-0.3", mode, steps=400))
    assert columns["reached"] == 400 and columns["claimed"] == "mass momentum energy"
    assert 0 < largest(columns) < 1e-14


def test_a_pressure_that_is_not_symmetric_loses_momentum():
    columns = row(Unsymmetric(steps=60), "losses")
    assert 1e-3 < columns["lost"] < 1 and columns["reached"] == 60


def test_plates_with_friction_take_momentum_and_without_it_none():
    with_friction, without = (row(conservation.layer("delaunay", "jittered-0.3", mode, PLATES, steps=200))
                              for mode in (MODES[0], MODES[-1]))
    assert with_friction["momentum"] > 1e-2 and with_friction["mass"] < 1e-14
    assert with_friction["claimed"] == "mass" and largest(without) < 1e-14
