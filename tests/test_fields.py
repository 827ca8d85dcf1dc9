"""Every method gives back the fields of its state, goes on where it was interrupted, refuses bad starts."""
import importlib
import inspect
import pkgutil

import numpy as np
import pytest
from crowd import goes_on_bitwise, random_fields

import particles
from continuum.fluid import ConstEta, IdealGas, VanDerWaals
from continuum.gas.fields import at_nodes, initial, kinetic_energy, placed
from continuum.gas.fields import block as as_block
from continuum.scene import RayleighBenard, Torus, Walls
from particles.dissipative.dpd import Dpd
from particles.fields import kinetic_energy as of_fields
from particles.integral.bodies import held
from particles.integral.closed_faces import Moving
from particles.integral.dih import Dih
from particles.integral.drifts import DRIFTS
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.entropy_stable import StableLayer, StableStream
from particles.integral.layer import Driven, Layer
from particles.integral.moving_delaunay import MovingDelaunay
from particles.integral.moving_stable import StableDelaunay
from particles.integral.points import jittered, lattice
from particles.integral.rings import rings
from particles.integral.rr98_moving import Drift
from particles.integral.rr98_moving_plain import MOTIONS
from particles.integral.sheared import Sheared
from particles.integral.stream import Stream
from particles.integral.thermal import Thermal
from particles.limits import limit_of
from particles.run import Plan, run
from particles.smooth.spam import Spam
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2

BOX = COLUMNS, ROWS = 16, 8        # two threads share no fewer points
AT, SQUARE = jittered(BOX, 0.1, 1), lattice(BOX)
FLUID = {"eos": VanDerWaals(), "law": ConstEta(0.3, 0.4)}
EVERYWHERE = {"weight": WendlandC2.of(h=2.9), "walls": (*periodic(COLUMNS), *periodic(ROWS, 1)), "box": BOX,
              **FLUID}
EDGES = renormalised(SQUARE, Lucy.of(h=2.0))
INSIDE = dict(zip(("edges", "beyond"), between_plates(renormalised, SQUARE.x, COLUMNS, ROWS, Lucy.of(h=2.0)),
                  strict=True),
              x=SQUARE.x, T_plates=(1.2, 0.8), g=0.01, **FLUID)

CARRIED = {"x": SQUARE.x, "rings": rings(SQUARE.x, BOX, (False, False)), "held": held(np.array([0]))}

#: methods on points that stay, and on points that move: state(rho, v, T), state(x, rho, v, T)
FIXED = {"dih": Dih(edges=EDGES, **FLUID), "layer": Layer(**INSIDE),
         "stable": StableLayer(**{**INSIDE, "eos": IdealGas()}),
         "thermal": Thermal(edges=EDGES, k=1e-3, seed=1, **FLUID),
         "stream": Stream(x=SQUARE.x, edges=EDGES, held=held(np.array([0])), **FLUID),
         "stable stream": StableStream(x=SQUARE.x, edges=EDGES, held=held(np.array([0])),
                                       **{**FLUID, "eos": IdealGas()}),
         "sheared": Sheared(counts=BOX, weight=Lucy.of(h=2.0), rate=0.1, **FLUID), "driven": Driven(**INSIDE),
         "moving-delaunay": MovingDelaunay(**CARRIED, **FLUID),
         "moving-stable": StableDelaunay(**CARRIED, **{**FLUID, "eos": IdealGas()})}
MOVING = {**{f"rr98-{name}": Drift(motion=motion, **EVERYWHERE) for name, motion in DRIFTS.items()},
          **{f"plain-{name}": kind(box=BOX, weight=WendlandC2.of(h=2.9), **FLUID) for name,
             kind in MOTIONS.items()},
          "closed-faces": Moving(**EVERYWHERE)}
DPD = {"dpd": Dpd(box=(5.0, 4.0)), "dpd-3d": Dpd(box=(3.5, 3.0, 4.0))}
SPAM = Spam(**EVERYWHERE)


def given(n):
    """Densities, velocities, temperatures; the first point rests, since the stream holds it."""
    rho, v, T = random_fields(n)
    v[0] = 0
    return rho, v, T


def same(fields, rho, v, T):
    # a few operations, each good to round-off
    for value, wanted in zip((fields.rho, fields.v, fields.T), (rho, v, T), strict=True):
        np.testing.assert_allclose(value, wanted, rtol=1e-13, atol=1e-14)
    assert fields.V.sum() == pytest.approx(COLUMNS*ROWS, rel=1e-13)


@pytest.mark.parametrize("method", FIXED.values(), ids=FIXED)
def test_fixed_points_give_back_what_their_state_was_made_of(method):
    rho, v, T = given(SQUARE.n)
    fields = method.fields(method.state(rho, v, T))
    same(fields, rho, v, T)
    assert np.isnan(fields.x).all() or np.array_equal(fields.x, SQUARE.x)


@pytest.mark.parametrize("method", MOVING.values(), ids=MOVING)
def test_moving_points_give_back_what_their_state_was_made_of(method):
    rho, v, T = given(AT.n)
    fields = method.fields(method.state(AT.x, rho=rho, v=v, T=T))
    same(fields, rho, v, T)
    assert np.array_equal(fields.x, AT.x)


def test_smooth_particles_have_the_density_of_their_own_sums():
    _, v, T = given(AT.n)
    state = SPAM.state(AT.x, 1.0, v, T)
    sums, ordered, ids = SPAM.look(state)
    fields = SPAM.fields(state)
    assert np.array_equal(fields.x, AT.x) and np.array_equal(fields.v, v)
    assert np.array_equal(ordered[2:], state[2:, ids])
    assert np.array_equal(fields.rho[ids], sums.around.rho[:AT.n]) and np.array_equal(fields.V, 1/fields.rho)
    # on the lattice every particle has one density, near 1, and temperatures are as wrong as that is
    still = SPAM.fields(SPAM.state(SQUARE.x, 1.0, v, T))
    assert np.ptp(still.rho) < 1e-14 and abs(still.rho[0] - 1) < 0.02
    np.testing.assert_allclose(still.T, T, atol=2*0.02)


@pytest.mark.parametrize("method", DPD.values(), ids=DPD)
def test_dissipative_particles_have_the_temperature_of_their_velocities(method):
    state = method.random_start(3.0)
    fields, d = method.fields(state), method.d
    assert np.array_equal(fields.x, state[:d].T) and np.array_equal(fields.v, state[d:2*d].T)
    assert fields.V.sum() == pytest.approx(method.volume)
    assert fields.rho@fields.V == pytest.approx(len(fields.T))
    # four standard deviations
    assert fields.T[0] == pytest.approx(method.kT, rel=4*np.sqrt(2/(d*len(fields.T))))


def kinds():
    """Every class of the package whose states have names, apart from base classes."""
    found = {getattr(importlib.import_module(module.name), name)
             for module in pkgutil.walk_packages(particles.__path__, "particles.")
             for name, kind in inspect.getmembers(importlib.import_module(module.name), inspect.isclass)
             if "names" in dir(kind) and {"rates", "start"} & {*dir(kind)}}
    return {kind for kind in found if kind.__module__ != "particles.method"
            and not any(kind is not other and issubclass(other, kind) for other in found)}


def test_no_method_is_left_out():
    tried = {type(method) for method in (*FIXED.values(), *MOVING.values(), *DPD.values(), SPAM)}
    assert kinds() <= tried, f"{kinds() - tried} have states, add them to the methods of this test"


RUN = [name for name, method in {**FIXED, **MOVING}.items() if hasattr(method, "start")]


def start_of(name):
    """A method and a state; points that move lie between where plates would be."""
    method = {**FIXED, **MOVING}[name]
    places = () if name in FIXED else (AT.x*[1, 0.9],)
    return method, method.state(*places, *given(SQUARE.n))


@pytest.mark.parametrize("name", RUN)
def test_an_interrupted_run_goes_on_bitwise_with_any_number_of_threads(name, tmp_path):
    method, state = start_of(name)
    goes_on_bitwise(method, state, 0.5*limit_of(method, state), tmp_path)


@pytest.mark.parametrize("name", RUN)
def test_a_start_that_is_no_fluid_is_refused_with_its_point(name):
    method, start = start_of(name)

    def refused(row, value, words):
        state = start.copy()
        state[row, 17] = value
        with pytest.raises(ValueError, match=words):
            run(method, state, Plan(dt=1e-3, steps=1))
    for row, what in enumerate(method.names[:len(start)]):
        refused(row, np.nan, f"not finite: {what} = nan of particle 17")
        if what in ("rho", "m", "V", "eps", "E"):
            refused(row, -50.0, r"(\(item|point) 17\b")
    if name in MOVING:
        refused(slice(2), start[:2, 18], r"point 1[78] and point 1[78] overlap at .* move one of them")


class Box:
    """A torus without convection."""
    sides, L, width, aspect, eos = Torus(), 8.0, 8.0, 1.0, VanDerWaals()


@pytest.mark.parametrize("scene",
                         [RayleighBenard(L=8.0, ra=1e4), RayleighBenard(L=8.0, ra=1e4, sides=Walls())],
                         ids=["periodic", "walls"])
def test_nodes_of_a_grid_fill_its_box_and_have_its_kinetic_energy(scene):
    fields = initial(scene, 8)
    at = at_nodes(fields)
    assert at.V.sum() == pytest.approx(scene.width*scene.L, rel=1e-14)
    assert len(np.unique(at.x, axis=0)) == len(at.x)
    np.testing.assert_allclose(at.T, scene.T(at.x[:, 1]), rtol=1e-14)
    assert of_fields(at) == pytest.approx(kinetic_energy(as_block(fields)), rel=1e-13)


def test_a_torus_has_each_of_its_nodes_once():
    at = at_nodes(placed(Box, 8, lambda x, y: (1 + 0*x, 0.1*y, 0*x, 1 + 0*x)))
    assert len(at.x) == 64 and np.array_equal(at.V, np.ones(64))
    assert np.array_equal(at.v[:, 0], 0.1*at.x[:, 1])
