"""Conservative moving points: a slow twin, what is kept, what faces are exact on, what is refused."""
from dataclasses import replace

import numpy as np
import plain_moving
import pytest
from crowd import alike

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, VanDerWaals
from particles.integral.closed_faces import EXCHANGED, Ingredients, Moving
from particles.integral.exchange import PRINTED
from particles.integral.interpolants import OrderingWarning
from particles.integral.points import jittered
from particles.integral.transposed_stress import MENDED
from particles.run import Plan, run
from particles.threads import Threads
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2

ROWS, COLUMNS = 8, 10
TIGHT = Ingredients(iterations=400, within=1e-14)
LAW = ConstEta(0.3, 0.2)


def fluid(scene="plates", eos=IdealGas(), chosen=TIGHT, law=LAW):  # noqa: B008
    """Between plates under gravity, or periodic both ways without it."""
    inside = scene == "plates"
    ends = plates(ROWS, 1.5, 0.5) if inside else periodic(ROWS, 1)
    return Moving(weight=WendlandC2.of(h=2.9), eos=eos, law=law, walls=(*periodic(COLUMNS), *ends),
                  box=(COLUMNS, ROWS), g=0.02*inside, ingredients=chosen)


def shaken(method):
    """Points off a lattice, their volumes not those of their density."""
    rng = np.random.default_rng(0)
    x = jittered(method.box, 0.25, 0).x
    x[:, 1] = np.clip(x[:, 1], -ROWS/2 + 0.2, ROWS/2 - 0.2)
    v = rng.normal(0, 0.2, x.shape)
    state = method.state(x, rng.uniform(0.9, 1.1, len(x)), v, rng.uniform(0.9, 1.1, len(x)))
    state[4:9] *= rng.uniform(0.9, 1.1, len(x))
    return state


def started(method, state):
    """Sums with lists and faces, and the state in their order."""
    sums, now = method.start(state.shape[1], Threads(1)), state.copy()
    sums.around.relist(now, np.arange(state.shape[1]), 0.0)
    sums.make_faces(now)
    return sums, now


def rates(method, state):
    """Rates of what is exchanged, and the state in their order."""
    sums, now = started(method, state)
    out = np.zeros_like(now)
    sums.rates(now, out)
    return out[EXCHANGED], now


@pytest.mark.parametrize("smooth", [0.0, 1.0])
@pytest.mark.parametrize("mended", [False, True])
@pytest.mark.parametrize(("scene", "eos", "law"), [
    ("plates", IdealGas(), LAW), ("plates", VanDerWaals(), LAW), ("periodic", IdealGas(), LAW),
    ("plates", IdealGas(), ConstNu(0.3, 0.2)), ("periodic", IdealGas(), PowerLaw(0.3, 0.2, 0.5, 1.0))])
def test_compiled_sums_are_those_of_the_slow_twin(scene, eos, law, mended, smooth):
    method = fluid(scene, eos, chosen=TIGHT._replace(transport=MENDED if mended else PRINTED, smooth=smooth),
                   law=law)
    fast, now = rates(method, shaken(method))
    T_plates = (1.5, 0.5) if scene == "plates" else None
    S, k, apart, pull, count, images = plain_moving.faces(method, T_plates, now)
    S = plain_moving.closed(S, k, apart, now[7], images[0], images[3])
    slow = plain_moving.rates(method, now, S, k, apart, plain_moving.shift(method, now, pull), count, images)
    alike(fast, slow, 1e-9)     # equations for the faces solved to 1e-14, squared


@pytest.mark.parametrize("scene", ["plates", "periodic"])
@pytest.mark.parametrize("law", [LAW, ConstNu(0.3, 0.2)], ids=["const-eta", "const-nu"])
def test_nothing_is_lost_by_an_exchange(law, scene):
    """However well faces close; plates take momentum and heat."""
    for iterations in (0, 2, 12):
        method = fluid(scene, chosen=Ingredients(iterations=iterations), law=law)
        (px, py, m, V, E), _ = rates(method, shaken(method))
        kept = [m, V] if scene == "plates" else [px, py, m, V, E]
        for rate in kept:
            assert abs(rate.sum()) < 1e-13*np.abs(rate).sum()


def test_a_uniform_stream_at_rest_in_itself_goes_on():
    """Where v, rho, T are constant densities stay as they are, and volumes follow the points."""
    method = fluid("periodic")
    x = shaken(method)[:2].T
    ones = np.ones(len(x))
    state = method.state(x, 1.0, ones[:, None]*np.array([0.3, -0.2]), ones)
    (px, py, m, V, E), _ = rates(method, state)
    for rate, value in ((px, 0.3), (py, -0.2), (m, 1.0), (E, 1 + 0.5*0.13)):
        assert np.abs(rate - value*V).max() < 1e-11


def test_a_broken_point_and_one_on_a_plate_are_named():
    method = fluid()
    sums, now = started(method, shaken(method))
    now[8, 5] = -1.0
    told = sums.fault(now, np.arange(now.shape[1]))
    assert "point" in told and "e = " in told
    state = shaken(method)
    state[1, 17] = ROWS/2
    with pytest.raises(ValueError, match="point 17 lies on a plate, where it meets its own image"):
        run(method, state, Plan(dt=0.01, steps=1))


def test_a_weight_that_is_none_is_refused_and_a_narrow_one_told():
    method, plan = fluid(chosen=Ingredients()), Plan(dt=0.01, steps=1)
    with pytest.raises(ValueError, match=r"has the integral 2 in 2 dim.* make it with WendlandC2\.of"):
        replace(method, weight=method.weight._replace(scale=2*method.weight.scale))
    with pytest.raises(ValueError, match=r"no neighbours in two directions within h = 1\.05"):
        run(replace(method, weight=WendlandC2.of(h=1.05)), shaken(method), plan)
    with pytest.warns(OrderingWarning,
                      match=r"below the spacing .*Eq\. 45: volumes, which follow the density of points"):
        run(replace(method, weight=WendlandC2.of(h=1.9)), shaken(method), plan)
