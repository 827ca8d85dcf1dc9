"""A layer in space: points do what the plane and a slow twin do, and conserve; rest; refusals."""
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from crowd import alike, random_fields, rates

from continuum.fluid import ConstNu, VanDerWaals
from continuum.scene import RayleighBenard, Walls
from continuum.spectral.space import GasInSpace
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Layer
from particles.integral.layer3d import Layer3D
from particles.integral.points import lattice, of_positions
from particles.weights import Lucy
from studies.rb.derive import in_space

ROWS, DEEP = 8, 6
SCENE = RayleighBenard(ra=1e4, L=float(ROWS))
PARTS = "eos law sides L width T_hot T_cold".split()       # of a scene that a layer takes, but for gravity


def space(scene=SCENE, h=2.0, x=None):
    x = lattice((2*ROWS, DEEP, ROWS)).x if x is None else x
    return Layer3D(scene, x, (scene.width, float(DEEP)), renormalised, Lucy.of(h=h, d=3))


def plane(h):
    """The compiled layer."""
    x = lattice((2*ROWS, ROWS)).x
    edges, beyond = between_plates(renormalised, x, SCENE.width, SCENE.L, Lucy.of(h=h))
    return Layer(x=x, edges=edges, beyond=beyond, eos=SCENE.eos, law=SCENE.law, g=SCENE.g,
                 T_plates=(SCENE.T_hot, SCENE.T_cold))


def test_in_the_plane_matrices_are_the_compiled_layer():
    fast = plane(2.0)
    slow = Layer3D(SCENE, fast.x, (SCENE.width,), renormalised, Lucy.of(h=2.0))
    state = fast.state(*random_fields(len(fast.x)))
    alike(rates(slow, state), rates(fast, state))


def test_what_is_uniform_along_the_third_axis_moves_as_in_the_plane():
    """Only nearest neighbours count, so that edges of the plane are those of space seen along z."""
    flat, deep = plane(1.3), space(h=1.3)
    state = flat.state(*random_fields(len(flat.x)))
    found = rates(deep, raised(state)).reshape(5, 2*ROWS, DEEP, ROWS)
    due = rates(flat, state).reshape(4, 2*ROWS, 1, ROWS)
    alike(found[[0, 1, 3, 4]], np.broadcast_to(due, (4, *found.shape[1:])))
    assert np.abs(found[2]).max() < 1e-13


def raised(state):
    """(5, n) of a state (4, m) of the plane, the same at all depths."""
    cube = np.repeat(state.reshape(4, 2*ROWS, 1, ROWS), DEEP, axis=2)
    return np.insert(cube, 2, 0.0, axis=0).reshape(5, -1)


def test_away_from_plates_points_are_the_slow_twin_in_three_dimensions():
    """zeta = -eta/3 makes the stress of the plane. Points two edges away from images are compared."""
    fluid = space()
    state, n, up = fluid.state(*random_fields(fluid.n, 3)), fluid.n, np.array([0, 0, SCENE.L/2])
    both = np.concatenate([fluid.x - up, (fluid.x - up)*[1, 1, -1]])
    edges = renormalised(of_positions(both, (SCENE.width, DEEP, 2*SCENE.L)), Lucy.of(h=2.0, d=3))
    twin = Dih(edges=edges, eos=SCENE.eos, law=SCENE.law, zeta=-SCENE.nu/3)
    due = rates(twin, np.tile(state, 2))[:, :n]
    due[3:] -= SCENE.g*state[[0, 3]]
    inside = np.abs(fluid.x[:, 2]) < SCENE.L/2 - 2
    alike(rates(fluid, state)[:, inside], due[:, inside])


def test_mass_stays_and_energy_comes_through_plates_alone():
    fluid = space(SimpleNamespace(**{name: getattr(SCENE, name) for name in PARTS}, g=0.0))
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


@pytest.mark.parametrize(("wrong", "words"), [
    ({"scene": replace(SCENE, eos=VanDerWaals())}, "IdealGas with ConstEta .* got VanDerWaals"),
    ({"scene": replace(SCENE, transport=ConstNu)}, "got .* ConstNu"),
    ({"scene": replace(SCENE, sides=Walls())}, r"got .* Walls\(\)"),
    ({"x": lattice((6, 6)).x}, r"d - 1 periods, got \(36, 2\)"),
    ({"x": lattice((6, 6, 9)).x}, "is not between the plates")])
def test_what_a_layer_in_space_cannot_be_is_refused(wrong, words):
    with pytest.raises(ValueError, match=words):
        space(**wrong)


def test_an_even_number_of_functions_is_refused():
    with pytest.raises(ValueError, match=r"odd number n > 4 .* 8"):
        GasInSpace(SCENE, 8)


@pytest.mark.parametrize(("across", "number"), [((0.0, 0.01, 0.0), 1), ((0.0, 0.5, 1.0), 0)])
def test_sizes_that_end_in_one_pattern_have_a_limit_and_others_none(across, number):
    point = {"method": "dih", "variant": "fixed-lattice", "start": "crossed", "ra": 5e3, "ke_err": 0.0,
             "nu": 1.5, "nu_err": 0.0, "converged": True}
    runs = [point | {"resolution": n, "ke": 3 + n**-2, "across": a} for n, a in zip((12, 16, 20), across)]
    limits = list(in_space({"three_dimensions": pd.DataFrame(runs)}))
    assert [row["ke"] for row in limits] == pytest.approx([3.0]*number, abs=1e-12)
