"""Convection in space: points and the spectral gas do what the plane and slow twins do, and conserve."""
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from crowd import random_fields, rates

from continuum.fluid import ConstNu, VanDerWaals
from continuum.scene import RayleighBenard, Walls
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import steady
from continuum.spectral.space import GasInSpace
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Layer
from particles.integral.layer3d import Layer3D
from particles.integral.points import lattice, of_positions
from particles.weights import Lucy
from studies.rb.derive import in_space
from studies.rb.runs.space import InSpace

ROWS, DEEP = 8, 6
SCENE = RayleighBenard(ra=1e4, L=float(ROWS))


def space(scene=SCENE, h=2.0, x=None):
    x = lattice((2*ROWS, DEEP, ROWS)).x if x is None else x
    return Layer3D(scene, x, (scene.width, float(DEEP)), renormalised, Lucy.of(h=h, d=3))


def plane(h):
    """The compiled layer."""
    x = lattice((2*ROWS, ROWS)).x
    edges, beyond = between_plates(renormalised, x, SCENE.width, SCENE.L, Lucy.of(h=h))
    return Layer(x=x, edges=edges, beyond=beyond, eos=SCENE.eos, law=SCENE.law, g=SCENE.g,
                 T_plates=(SCENE.T_hot, SCENE.T_cold))


def near(found, expected, most=1e-12):
    for one, other in zip(found, expected, strict=True):
        assert np.abs(one - other).max() < most*np.abs(other).max()


def test_in_the_plane_matrices_are_the_compiled_layer():
    fast = plane(2.0)
    slow = Layer3D(SCENE, fast.x, (SCENE.width,), renormalised, Lucy.of(h=2.0))
    state = fast.state(*random_fields(len(fast.x)))
    near(rates(slow, state), rates(fast, state))


def test_what_is_uniform_along_the_third_axis_moves_as_in_the_plane():
    """Nearest neighbours alone, so that edges of the plane are those of space seen along z."""
    flat, deep = plane(1.3), space(h=1.3)
    state = flat.state(*random_fields(len(flat.x)))
    found = rates(deep, raised(state)).reshape(5, 2*ROWS, DEEP, ROWS)
    due = rates(flat, state).reshape(4, 2*ROWS, 1, ROWS)
    near(found[[0, 1, 3, 4]], np.broadcast_to(due, (4, *found.shape[1:])))
    assert np.abs(found[2]).max() < 1e-13


def raised(state):
    """(5, n) of a state (4, m) of the plane, the same at all depths."""
    cube = np.repeat(state.reshape(4, 2*ROWS, 1, ROWS), DEEP, axis=2)
    return np.insert(cube, 2, 0.0, axis=0).reshape(5, -1)


def test_away_from_plates_points_are_the_slow_twin_in_three_dimensions():
    """Bulk viscosity -eta/3 makes the stress of the plane; two edges away from images."""
    fluid = space()
    state, n, up = fluid.state(*random_fields(fluid.n, 3)), fluid.n, np.array([0, 0, SCENE.L/2])
    both = np.concatenate([fluid.x - up, (fluid.x - up)*[1, 1, -1]])
    edges = renormalised(of_positions(both, (SCENE.width, DEEP, 2*SCENE.L)), Lucy.of(h=2.0, d=3))
    twin = Dih(edges=edges, eos=SCENE.eos, law=SCENE.law, zeta=-SCENE.nu/3)
    due = rates(twin, np.tile(state, 2))[:, :n]
    due[3:] -= SCENE.g*state[[0, 3]]
    inside = np.abs(fluid.x[:, 2]) < SCENE.L/2 - 2
    near(rates(fluid, state)[:, inside], due[:, inside])


def test_mass_stays_and_energy_comes_through_plates_alone():
    names = "eos law sides L width T_hot T_cold".split()
    fluid = space(SimpleNamespace(g=0.0, **{name: getattr(SCENE, name) for name in names}))
    state = fluid.state(*random_fields(fluid.n, 3))
    mass, *_, power = rates(fluid, state)*fluid.V
    heat = [fluid.heat_through(state, plate) for plate in (0, 1)]
    assert abs(mass.sum()) < 1e-14*np.abs(mass).sum()
    assert heat[0] > 0 > heat[1] and abs(power.sum() - sum(heat)) < 1e-13*np.abs(power).sum()


def test_the_motionless_state_stays_to_round_off_on_points_and_of_the_spectral_gas():
    for fluid in (space(), GasInSpace(SCENE, 9)):
        n = len(fluid.x)
        state, out = fluid.state(np.ones(n), np.zeros((n, 3)), SCENE.T(fluid.x[:, 2])), np.empty((5, n))
        fluid.rates(state, out)
        assert np.abs(out).max() < 1e-13


def test_the_spectral_gas_in_space_comes_to_the_rolls_of_the_plane_and_keeps_its_mass(tmp_path):
    """Nine waves and polynomials: the flow in the plane, of as many, is right to a thousandth."""
    scene = replace(SCENE, ra=2500.0)
    done = InSpace(scene=scene, start="rolls", n=9, t_end=80.0).run(lambda part: None, tmp_path)
    [row] = done.rows["three_dimensions"]
    assert row["ke"] == pytest.approx(steady(GasLaws(scene), 16).K, rel=0.01)
    assert abs(row["mass_drift"]) < 1e-12 and row["across"] < 1e-9


@pytest.mark.parametrize(("wrong", "words"), [
    ({"scene": replace(SCENE, eos=VanDerWaals())}, "IdealGas with ConstEta .* got VanDerWaals"),
    ({"scene": replace(SCENE, transport=ConstNu)}, "got .* ConstNu"),
    ({"scene": replace(SCENE, sides=Walls())}, r"got .* Walls\(\)"),
    ({"x": lattice((6, 6)).x}, r"d - 1 periods, got \(36, 2\)"),
    ({"x": lattice((6, 6, 9)).x}, "is not between the plates")])
def test_what_a_layer_in_space_cannot_be_is_refused(wrong, words):
    with pytest.raises(ValueError, match=words):
        space(**wrong)


@pytest.mark.parametrize("n", [8, 3])
def test_an_even_number_of_functions_or_too_few_are_refused(n):
    with pytest.raises(ValueError, match=f"odd number n > 4 .* {n}"):
        GasInSpace(SCENE, n)


@pytest.mark.parametrize(("across", "number"), [((0.0, 0.01, 0.0), 1), ((0.0, 0.5, 1.0), 0)])
def test_sizes_that_end_in_one_pattern_have_a_limit_and_others_none(across, number):
    point = {"method": "dih", "variant": "fixed-lattice", "start": "crossed", "ra": 5e3, "ke_err": 0.0,
             "nu": 1.5, "nu_err": 0.0, "converged": True}
    runs = [point | {"resolution": n, "ke": 3 + n**-2, "across": a} for n, a in zip((12, 16, 20), across)]
    limits = list(in_space({"three_dimensions": pd.DataFrame(runs)}))
    assert [row["ke"] for row in limits] == pytest.approx([3.0]*number, abs=1e-12)
