"""Laws over the table of methods: each runs and starts with the scene's fields; names are unique."""
from functools import cache, partial

import numpy as np
import pytest

from continuum.domain import Domain
from continuum.scene import RayleighBenard, Walls
from continuum.sides import Plate
from particles.fields import kinetic_energy
from particles.method import Method
from particles.run import Plan, run
from studies.build import FAMILIES, METHODS, SCENES, ready
from studies.build.measure import heat_at_rest
from studies.build.scenes import Sound, TaylorGreen
from studies.build.spam import VARIANTS
from studies.judge import contract

# six fixed rows behind a plate go on to T = 0 in a lower one
LAYER = RayleighBenard(ra=1e4, L=14.0, aspect=1.0)
BOX = RayleighBenard(ra=1e4, L=14.0, aspect=1.0, sides=Walls())
# other starts
PAIRS = [name for name in METHODS if name not in ("grid-two-rolls", "grid-fig10", "spam-from-flow")]
EXACT = [TaylorGreen(L=12), Sound(width=12), SCENES["conduction"](12)]
in_layer = cache(partial(ready, LAYER))


@pytest.fixture
def exactly(monkeypatch):
    """Velocities and temperatures to round-off of p/rho and e."""
    monkeypatch.setattr(contract, "AGREE", 1e-13)


@pytest.mark.parametrize("name", PAIRS)
def test_every_method_meets_the_contract_and_starts_with_the_fields_of_the_layer(name, exactly):
    """Members and shapes; K is that of the rolls, 9/5000, which points off a lattice sample."""
    made = in_layer(name)
    assert isinstance(made.method, Method)
    contract.check(LAYER, made)
    assert kinetic_energy(made.method.fields(made.start)) == pytest.approx(9/5000, rel=0.1)


@pytest.mark.parametrize("name", METHODS)
def test_every_method_takes_three_steps(name):
    """In the box for grids whose rolls come singly; what moves stays finite, and moves."""
    method, start, dt = ready(BOX, name) if METHODS[name].name in ("two-rolls", "fig10") else in_layer(name)
    end = run(method, start, Plan(dt=dt, steps=3)).by_id()
    assert np.isfinite(end).all() and not np.array_equal(end, start)


@pytest.mark.parametrize(
    "name", ["grid", "spam", "fixed-lattice", "fixed-jittered-delaunay", "moving", "moving-literal"])
@pytest.mark.parametrize("scene", EXACT, ids=lambda scene: type(scene).__name__)
def test_a_method_of_each_family_starts_scenes_with_exact_answers(scene, name, exactly):
    made = ready(scene, name)
    contract.check(scene, made)
    assert 0 < made.dt <= made.limit


BELOW_ONSET = RayleighBenard(ra=100.0, L=8.0)
BOX_OF_PLATES = Domain(L=8.0, eta=0.5, k=0.5, bottom=Plate(T=1.2), top=Plate(T=1.0))


@pytest.mark.parametrize("name, scene", [
    *((name, BELOW_ONSET) for name in (
        "fixed-lattice", "fixed-lattice-nested", "fixed-random-plates",
        "fixed-jittered-plates-entropy-stable", "moving", "moving-delaunay",
        "moving-delaunay-entropy-stable")),
    ("moving-delaunay", BOX_OF_PLATES)])
def test_heat_goes_in_below_and_out_above_at_rest(name, scene):
    """Nu of conduction is 1, but for what is left of the start; corners of a box are their plates'."""
    method, start, dt = ready(scene, name)
    steps = round(300/dt)
    done = run(method, start, Plan(dt=dt, steps=steps, series=METHODS[name].series, every=steps))
    through = [done.series[side][-1]/heat_at_rest(scene) for side in ("lower", "upper")]
    assert through == pytest.approx([1, -1], abs=1e-3)


@pytest.mark.parametrize("name", ["fixed-jittered-delaunay", "fixed-random-delaunay", "relaxed-delaunay"])
def test_no_point_shuns_the_seam_of_a_torus(name):
    """Of 144 points six lie within a quarter of a spacing of it; between plates none does."""
    y = ready(TaylorGreen(L=12), name).method.x[:, 1]
    assert (np.abs(y) > 6 - 0.25).any()
    assert np.abs(ready(LAYER, name).method.x[:, 1]).max() <= 7 - 0.25


def test_a_scene_that_a_method_cannot_take_is_refused():
    for name in ("fixed-lattice", "fixed-jittered-plates", "moving", "moving-literal"):
        with pytest.raises(ValueError, match=r"take sides = Walls\(\): take grid, spam, moving-delaunay$"):
            ready(BOX, name)
    for name in ("moving", "moving-literal"):
        with pytest.raises(ValueError, match=r"cannot take slide = 0\.1: take grid, spam, fixed-lattice"):
            ready(SCENES["couette"](12), name)


def test_no_two_methods_have_one_name():
    assert len(METHODS) == sum(map(len, FAMILIES))


def test_a_variant_of_ones_own_stands_in_place_of_a_name():
    method, start, _ = ready(LAYER, VARIANTS["wendland-c2"]._replace(h=4.0), seed=2)
    assert method.weight.h == 4.0
    assert not np.array_equal(start, ready(LAYER, "spam-wendland-c2", seed=1).start)
    # the range is no part of the start
    assert np.array_equal(start, ready(LAYER, "spam-wendland-c2", seed=2).start)


@pytest.mark.parametrize("name", ["spam", "fixed-lattice", "moving-literal"])
def test_a_method_of_ones_own_starts_like_the_family(name):
    """Any object with state(x, rho, v, T) and a known limit of the step; fixed points bring places."""
    known = ready(LAYER, name)
    made = ready(LAYER, known.method)
    assert made.start.shape == known.start.shape and 0 < made.dt < made.limit
