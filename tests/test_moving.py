"""Conservative moving points: a slow twin, what is kept, what faces are exact on, restart."""
from dataclasses import replace

import numpy as np
import plain_moving
import pytest
from crowd import goes_on_bitwise

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, VanDerWaals
from particles.integral.closed_faces import EXCHANGED, SOLVED, Ingredients, Moving
from particles.integral.exchange import PRINTED
from particles.integral.interpolants import OrderingWarning
from particles.integral.points import jittered
from particles.integral.transposed_stress import MENDED
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Threads
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2

ROWS, COLUMNS = 8, 10
TIGHT = Ingredients(iterations=400, within=1e-14)


LAW = ConstEta(0.3, 0.2)


def fluid(scene="plates", eos=IdealGas(), g=0.02, chosen=TIGHT, columns=COLUMNS, law=LAW):  # noqa: B008
    """Between plates under gravity, or periodic both ways without it."""
    inside = scene == "plates"
    walls = (*plates(ROWS, 1.5, 0.5), *periodic(columns)) if inside else (*periodic(columns),
                                                                          *periodic(ROWS, 1))
    return Moving(weight=WendlandC2.of(h=2.9), eos=eos, law=law, walls=walls, box=(columns, ROWS),
                  g=g if inside else 0.0, ingredients=chosen)


def shaken(method, seed=0, speed=0.2):
    rng = np.random.default_rng(seed)
    x = jittered((method.box[0], ROWS), 0.25, seed).x
    x[:, 1] = np.clip(x[:, 1], -ROWS/2 + 0.2, ROWS/2 - 0.2)
    v = rng.normal(0, speed, x.shape)
    state = method.state(x, rng.uniform(0.9, 1.1, len(x)), v, rng.uniform(0.9, 1.1, len(x)))
    state[6:9] *= (stretch := rng.uniform(0.9, 1.1, len(x)))
    state[4:6] *= stretch
    return state


def started(method, state, threads=1):
    """Sums with lists and faces, and the state in their order."""
    sums, now = method.start(state.shape[1], Threads(threads)), state.copy()
    sums.around.relist(now, np.arange(state.shape[1]), 0.0)
    sums.make_faces(now)
    return sums, now


def rates(method, state, threads=1):
    sums, now = started(method, state, threads)
    out = np.zeros_like(now)
    sums.rates(now, out)
    return out[EXCHANGED], now, sums


@pytest.mark.parametrize("smooth", [0.0, 1.0])
@pytest.mark.parametrize("mended", [False, True])
@pytest.mark.parametrize(("scene", "eos", "law"), [
    ("plates", IdealGas(), LAW), ("plates", VanDerWaals(), LAW), ("periodic", IdealGas(), LAW),
    ("plates", IdealGas(), ConstNu(0.3, 0.2)), ("periodic", IdealGas(), PowerLaw(0.3, 0.2, 0.5, 1.0))])
def test_compiled_sums_are_those_of_the_slow_twin(scene, eos, law, mended, smooth):
    method = fluid(scene, eos, chosen=TIGHT._replace(transport=MENDED if mended else PRINTED, smooth=smooth),
                   law=law)
    fast, now, _ = rates(method, shaken(method))
    where = plain_moving.Scene(method.box, (1.5, 0.5) if scene == "plates" else None)
    S, k, apart, pull, count, images = plain_moving.faces(method, where, now)
    S = plain_moving.closed(S, k, apart, now[7], images[0], images[3])
    slow = plain_moving.rates(method, where, now, S, k, apart, plain_moving.shift(method, now, pull), count,
                              images)
    for one, other in zip(fast, slow, strict=True):
        # equations for the faces solved to 1e-14, squared
        assert np.abs(one - other).max() < 1e-9*np.abs(other).max()


def test_faces_close_and_are_exact_on_linear_fields():
    for scene in ("plates", "periodic"):
        method = fluid(scene)
        sums, now = started(method, shaken(method))
        faces, n = sums.faces, sums.n
        rows = np.repeat(np.arange(n), faces.taken)
        entry = np.concatenate([np.arange(a, a + m) for a,
                                m in zip(faces.first, faces.taken, strict=True)]).astype(int)
        for s, along in ((faces.sx, (1, 0)), (faces.sy, (0, 1))):
            assert np.abs(np.bincount(rows, s[entry], n)).max() < 1e-9
            for d, exact in zip((faces.dx, faces.dy), along, strict=True):
                moment = np.bincount(rows, s[entry]*d[entry], n)
                assert np.abs(moment - exact*now[7]).max() < 1e-9


@pytest.mark.parametrize("scene", ["plates", "periodic"])
@pytest.mark.parametrize("law", [LAW, ConstNu(0.3, 0.2)], ids=["const-eta", "const-nu"])
def test_nothing_is_lost_by_an_exchange(law, scene):
    """Open faces, too: exchange does not depend on how well they close; plates take momentum and heat."""
    for iterations in (0, 2, 12):
        method = fluid(scene, chosen=Ingredients(iterations=iterations), law=law)
        (px, py, m, V, E), _, _ = rates(method, shaken(method))
        kept = [m, V] if scene == "plates" else [px, py, m, V, E]
        for rate in kept:
            assert abs(rate.sum()) < 1e-13*np.abs(rate).sum()


def test_a_uniform_stream_at_rest_in_itself_goes_on():
    """Constant v, rho, T on any points: sums a volume stay as they are; only volumes follow the points."""
    method = fluid("periodic")
    x = shaken(method)[:2].T
    ones = np.ones(len(x))
    state = method.state(x, 1.0, ones[:, None]*np.array([0.3, -0.2]), ones)
    (px, py, m, V, E), _, _ = rates(method, state)
    for rate, value in ((px, 0.3), (py, -0.2), (m, 1.0), (E, 1 + 0.5*0.13)):
        assert np.abs(rate - value*V).max() < 1e-11


def test_results_do_not_depend_on_threads():
    method = fluid(chosen=Ingredients(), columns=20)
    state = shaken(method)
    assert state.shape[1] >= 64*2       # threads share no fewer rows
    one, two = (rates(method, state, threads)[0] for threads in (1, 2))
    assert np.array_equal(one, two)


def test_conserved_sums_stay_to_round_off_in_time():
    method = fluid("periodic", chosen=Ingredients())
    state = shaken(method)
    done = run(method, state, Plan(dt=0.5*limit_of(method, state), steps=300))
    for end, start in zip(done.state[EXCHANGED], state[EXCHANGED], strict=True):
        assert abs(end.sum() - start.sum()) < 1e-13*np.abs(start).sum()


def test_a_run_goes_on_bitwise_where_it_was_interrupted(tmp_path):
    method = fluid(chosen=Ingredients())
    state = shaken(method)
    dt = 0.5*limit_of(method, state)
    goes_on_bitwise(method, state, dt, tmp_path)


def test_a_broken_point_is_named():
    method = fluid()
    sums, now = started(method, shaken(method))
    now[8, 5] = -1.0
    assert "point" in sums.fault(now, np.arange(now.shape[1])) and "e = " in sums.fault(now,
                                                                                        np.arange(now.shape[1]))


def test_what_is_no_start_is_refused():
    method, plan = fluid(chosen=Ingredients()), Plan(dt=0.01, steps=1)
    for row, value, words in ((6, -0.5, r"\(item 17\) is outside the validity"),
                              (8, -0.5, r"\(item 17\) is outside"),
                              (7, -0.5, r"point 17 has volume -0\.5"),
                              (0, np.nan, "not finite: x = nan of particle 17")):
        state = shaken(method)
        state[row, 17] = value
        with pytest.raises(ValueError, match=words):
            run(method, state, plan)
    state = shaken(method)
    state[:2, 17] = state[:2, 18]
    with pytest.raises(ValueError, match=r"point 1[78] and point 1[78] overlap at .* move one of them"):
        run(method, state, plan)
    state = shaken(method)
    state[1, 17] = ROWS/2
    with pytest.raises(ValueError, match="point 17 lies on a plate, where it meets its own image"):
        run(method, state, plan)


def test_a_weight_that_is_none_is_refused_and_a_narrow_one_told():
    method, plan = fluid(chosen=Ingredients()), Plan(dt=0.01, steps=1)
    with pytest.raises(ValueError,
                       match=r"has the integral 2 in 2 dimensions, .* make it with WendlandC2\.of"):
        replace(method, weight=method.weight._replace(scale=2*method.weight.scale))
    with pytest.raises(ValueError,
                       match=r"no neighbours in two directions .* h = 1\.05 .*Eq\. 45"):
        run(replace(method, weight=WendlandC2.of(h=1.05)), shaken(method), plan)
    with pytest.warns(OrderingWarning,
                      match=r"below the spacing .*Eq\. 45: volumes, which follow the density of points"):
        run(replace(method, weight=WendlandC2.of(h=1.9)), shaken(method), plan)


def test_fewer_iterations_leave_faces_more_open():
    method = fluid()
    left = []
    for iterations in (0, 3, 12):
        sums, now = started(replace(method, ingredients=Ingredients(iterations=iterations, within=0.0)),
                            shaken(method))
        rows = np.repeat(np.arange(sums.n), sums.faces.taken)
        entry = np.concatenate([np.arange(a, a + m) for a,
                                m in zip(sums.faces.first, sums.faces.taken, strict=True)]).astype(int)
        left.append(np.abs(np.bincount(rows, sums.faces.sx[entry], sums.n)).max())
        assert np.any(now[SOLVED]) == (iterations > 0)
    assert left[0] > left[1] > left[2]
