"""The study conservation: what changes are divided by, what runs keep, what controls lose, winds."""

import numpy as np
import pytest

import studies.conservation.cases as conservation
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.points import jittered, lattice
from particles.weights import Lucy, Monaghan
from studies.conservation.drift import MODES, PLATES, MovingDrift
from studies.conservation.plain_runs import CUBE, LINE, SQUARE, DihDrift, Unsymmetric
from studies.conservation.sums import random_fields, sizes

PRINTED = NestedFluxes(differences=False)


def row(case, table="drift"):
    return case.run(lambda done: None, None).rows[table][0]


def largest(columns):
    return max(columns[name] for name in ("mass", "momentum", "energy"))


# --- measuring ----------------------------------------------------------------------------------


def test_random_starts_are_as_rough_as_asked_for():
    points = lattice((16, 16))
    starts = [random_fields(points, 0.1, seed) for seed in range(40)]
    rms = np.sqrt(np.mean([np.var(rho) for rho, _, _ in starts]))
    assert rms == pytest.approx(0.1, rel=0.1)       # 40 samples of 24 waves: 5 % for two standard deviations
    assert np.mean([v.mean(axis=0) for _, v, _ in starts], axis=0) == pytest.approx([0.1, -0.05], abs=1e-12)


def test_changes_are_divided_by_mass_momenta_and_energy():
    v, rho = np.array([[3.0, 4.0], [0.0, -1.0]]), np.array([1.0, 2.0])
    fields = Fields(v, v, rho, np.array([1.0, 2.0]), np.array([1.0, 0.5]))
    expected = [2.0, 6.0, 6.0, 1.0 + 12.5 + 2.0 + 0.5]
    assert list(sizes(IdealGas(), fields)) == pytest.approx(expected, rel=1e-15)


# --- runs ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_compiled_runs_keep_their_sums(mode):
    columns = row(conservation.layer("exact", "jittered-0.3", mode, steps=400))
    assert columns["reached"] == 400 and columns["claimed"] == "mass momentum energy"
    assert 0 < largest(columns) < 1e-14


@pytest.mark.parametrize("transport", [Pairwise(), PRINTED])
@pytest.mark.parametrize("box", [LINE, SQUARE, CUBE])
def test_runs_in_all_dimensions_keep_their_sums(transport, box):
    columns = row(DihDrift(mode="any", transport=transport, box=box, steps=40))
    assert columns["reached"] == 40 and 0 < largest(columns) < 1e-14


def test_a_pressure_that_is_not_symmetric_loses_momentum():
    columns = row(Unsymmetric(steps=60), "losses")
    assert 1e-3 < columns["lost"] < 1 and columns["reached"] == 60


def test_plates_with_friction_take_momentum_and_without_it_none():
    with_friction, without = (row(conservation.layer("delaunay", "jittered-0.3", mode, PLATES, steps=200))
                              for mode in (MODES[0], MODES[-1]))
    assert with_friction["momentum"] > 1e-2 and with_friction["mass"] < 1e-14
    assert with_friction["claimed"] == "mass" and largest(without) < 1e-14


def test_plain_quadrature_off_a_lattice_diverges_and_says_when():
    [nested] = (mode for mode in MODES if mode.name == "nested")
    assert 0 < row(conservation.layer("plain", "jittered-0.3", nested, steps=400))["reached"] < 400


@pytest.mark.parametrize(("more", "pairs"), [
    ({"steps": 60, "wall": PLATES}, False), ({"weight": Monaghan}, True)])
def test_moving_points_keep_what_they_claim_until_they_pair(more, pairs):
    columns = row(MovingDrift(**more))
    assert 60 <= columns["reached"] and (columns["reached"] < columns["steps"]) == pairs
    assert max(columns[name] for name in columns["claimed"].split()) < 1e-14


# --- frames -------------------------------------------------------------------------------------

WIND = np.array([0.3, -0.2])


def boosted(state):
    """Density, momentum, energy in a frame that moves with -WIND; of rates likewise."""
    rho, *p, eps = state
    return np.stack([rho, *(p + WIND[:, None]*rho), eps + WIND@p + rho*(WIND@WIND)/2])


def error_in_wind(transport, maker):
    """Largest differences of rates in a wind from those at rest, carried along, over the largest, row by row.

    On fixed points a wind carries the state along with the discrete divergence D: rates differ by -U.D of it.
    """
    points = jittered((8, 8), 0.3, 1)
    edges = MAKERS[maker](points, Lucy.of(h=3.0))
    fluid = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.1, 0.1), transport=transport)
    state = fluid.state(*random_fields(points, 0.1, 1))
    still, windy, there = np.empty_like(state), np.empty_like(state), boosted(state)
    fluid.rates(state, still)
    fluid.rates(there, windy)
    carried = np.stack([sum(u*(D@q) for u, D in zip(WIND, edges.D, strict=True)) for q in there])/edges.V
    return np.abs(windy - boosted(still) + carried).max(axis=1)/np.abs(windy).max(axis=1)


@pytest.mark.parametrize("transport", [NestedFluxes(), PRINTED, Pairwise(mended=False)])
def test_closed_edges_do_not_know_of_a_wind(transport):
    assert error_in_wind(transport, "delaunay").max() < 1e-12       # round-off of sums of 30 terms


def test_inner_sums_as_printed_know_of_a_wind_off_a_lattice_and_so_does_mended_heating():
    assert error_in_wind(PRINTED, "plain")[1:3].max() > 1e-4
    assert error_in_wind(Pairwise(), "delaunay")[3] > 1e-4
