"""The entropy-stable flux on points that move: what is kept on edges that move, steps, limits."""
from dataclasses import replace

import numpy as np
import pytest
from test_entropy_stable import GAS, MOVING, at_random

from continuum.domain import Domain
from continuum.fluid import ConstEta
from continuum.scene import RayleighBenard
from continuum.sides import Periodic, Plate
from particles.integral.carried import follow
from particles.integral.entropy_fluxes import Logarithmic, MeanPressure
from particles.integral.exchange import Pressure
from particles.integral.moving_stable import StableDelaunay
from particles.pairs import sweep
from particles.threads import Threads
from studies.build import SCENES, ready

ONE = Threads(1)


def entropy_variables(rho, v, T, cv=GAS.cv):
    """d(-rho s)/d(rho, p, eps), (4, n), s = c_v ln T - ln rho."""
    return np.array([cv + 1 - cv*np.log(T) + np.log(rho) - (v**2).sum(axis=0)/(2*T), *v/T, -1/T])


@pytest.mark.parametrize("kind", [Pressure, MeanPressure])
def test_a_moving_torus_keeps_entropy_without_dissipation(kind):
    made = replace(ready(SCENES["taylor-green"](8), MOVING).method, eos=GAS, law=ConstEta(0, 0),
                   flow=(Logarithmic(GAS), kind(GAS)))
    state = at_random(made)
    sums = made.start(state.shape[1], ONE)
    sums.look_at(state)
    follow(ONE, sums.n, sums.fluid, sums.rings, sums.bench)
    gain, at = np.zeros((sums.n, 4)), made.fields(state)
    sweep(0, sums.n, sums.fluid.terms, sums.points, sums.edges, gain)
    parts = entropy_variables(at.rho, at.v.T, at.T)*gain.T
    assert abs(parts.sum() - at.rho@sums.bench.flow) < 1e-13*np.abs(parts).sum()


@pytest.mark.parametrize("scene, kept, more", [
    (SCENES["taylor-green"](8), [4, 5, 6, 7, 8], {}), (SCENES["taylor-green"](8), [4, 5, 6, 7], {"g": 0.1}),
    (RayleighBenard(ra=1e4, L=8.0), [6, 7], {})], ids=["torus", "falling", "plates"])
def test_no_start_is_too_violent_and_sums_are_kept(scene, kept, more):
    """Also through limits and flips, in steps far too long, which are halved; what falls gains -g m t."""
    made = replace(ready(scene, MOVING).method, law=ConstEta(0, 0), **more)
    state, sums = at_random(made, 2.0), made.start(len(made.x), ONE)
    begun, longest = state.copy(), sums.longest
    sums.longest = lambda y: 10*longest(y)
    sums.march(state, 0.5, 2)
    assert sums.flips and sums.limited and sums.refused and not sums.fault(state, np.arange(sums.n))
    change = state.sum(axis=1) - begun.sum(axis=1)
    change[5] += more.get("g", 0.0)*begun[6].sum()
    assert np.abs(change[kept]).max() < 1e-14*np.abs(begun).sum()


def test_threads_change_no_bit_where_triangles_turn_over():
    made, ends = ready(SCENES["taylor-green"](16), MOVING).method, []
    for threads in (1, 2):
        ends.append(at_random(made, 0.5, seed=1))
        made.start(256, Threads(threads)).march(ends[-1], 0.5, 1)
    assert np.array_equal(*ends)


def test_slopes_of_linear_fields_are_exact_on_sides_too():
    box = Domain(L=8.0, eta=0.1, k=0.1, left=Periodic(), right=Periodic(), bottom=Plate(T=1.0),
                 top=Plate(T=1.8))
    made = ready(box, MOVING).method
    y = made.x[:, 1]
    state = made.state(2 + 0.1*y, np.zeros((len(y), 2)), 1.4 + 0.1*y)
    sums = made.start(len(y), ONE)
    sums.look_at(state)
    assert np.allclose(sums.points["rho_y"], 0.1) and np.allclose(sums.points["rho_x"], 0, atol=1e-13)


def test_an_end_names_its_point():
    made, state, _ = ready(SCENES["taylor-green"](8), MOVING)
    state[8, 5] = -1.0
    with pytest.raises(FloatingPointError, match=r"no step of .* leaves the point at .* E = -1, . edges"):
        StableDelaunay(**vars(made)).start(len(made.x), ONE).march(state, 0.1, 1)
