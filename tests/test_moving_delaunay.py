"""Points that move with their triangulation: flips, the slow twin, conservation, threads, refusals."""
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from plain_moving_delaunay import Plain

from continuum.domain import Domain
from continuum.fluid import ConstEta, ConstNu, IdealGas
from continuum.scene import RayleighBenard
from continuum.sides import Periodic, Plate, Sliding
from particles.integral import moving_delaunay
from particles.integral import rings as rings_module
from particles.integral.bodies import CLEAR, held, on_circle, together, with_disc
from particles.integral.flips import flips
from particles.integral.march import REAL
from particles.integral.moving_delaunay import MovingDelaunay
from particles.integral.points import lattice
from particles.integral.rings import geometry, rings, table_of
from particles.integral.triangulation import outside, triangles
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.threads import Threads
from studies.build import SCENES, ready
from studies.build.fixed import between_sides
from studies.build.moving import NONE_HELD, Carriage
from studies.build.setting import shifted

TORUS, PLATES, BOX = (False, False), (False, True), (True, True)
SIZE = (12.0, 10.0)
ROOM = np.zeros((4000, 2), np.int64)        # for edges to look at


def corners(x, size, closed):
    """Triangles (T, 3) of SciPy, counterclockwise."""
    corner, at = triangles(x, size, closed)
    one, two = at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]
    turned = one[:, 0]*two[:, 1] < one[:, 1]*two[:, 0]
    corner[turned] = corner[turned][:, ::-1]
    return corner


def edges_of(made, x):
    """Volumes, and points with an edge to be flipped; S and k go into the rings."""
    n = len(x)
    V, crossed = np.zeros(n), np.zeros(n, bool)
    geometry(0, n, x.T.copy(), made, V, np.zeros((n, 2)), np.zeros(n), crossed)
    return V, crossed


def shaken(closed):
    """Places moved by up to 0.35 at random, and the triangulation that they had before."""
    x, _ = between_sides(SIZE, closed, shifted, 0.1, 3)
    made = rings(x, SIZE, closed)
    return x + 0.35*np.random.default_rng(0).uniform(-1, 1, x.shape)*~made.rim[:, None], made


@pytest.mark.parametrize("closed", [TORUS, PLATES, BOX])
def test_flips_end_at_delaunays_triangulation_and_keep_linear_fields(closed):
    """Flips give each point the value that a linear field has there."""
    x, made = shaken(closed)
    V, crossed = edges_of(made, x)
    ones, slope = np.ones(len(x)), np.multiply([0.1, 0.2], closed)       # where a field may be linear
    fields = np.stack([2*ones, 0*ones, 3 + x@slope, ones, 5*ones])
    state = np.concatenate([x.T, 0*x.T, fields*V])
    before = state[4:].sum(axis=1)
    count, full = flips(x.T.copy(), state, IdealGas(), made, crossed, np.zeros(len(x), bool), ROOM)
    assert count > 10 and full == -1
    after, anew = (np.sort(table_of(one), axis=1) for one in (made, rings(x, SIZE, closed)))
    for one, other in zip(after, anew, strict=True):
        assert np.array_equal(one[one >= 0], other[other >= 0])
    V, crossed = edges_of(made, x)
    assert not crossed.any()
    assert np.allclose(state[7], V, rtol=0, atol=1e-13)
    assert np.allclose(state[4:]/V, fields, rtol=1e-12)
    assert np.allclose(state[4:].sum(axis=1), before, rtol=1e-13)


def test_flips_leave_what_is_positive_positive_where_densities_jump():
    x, made = shaken(TORUS)
    V, crossed = edges_of(made, x)
    rho, T = 10**np.random.default_rng(1).uniform(-2, 2, (2, len(x)))
    state = np.concatenate([x.T, 0*x.T, np.stack([0*rho, 0*rho, rho, np.ones(len(x)), rho*T])*V])
    before = state[4:].sum(axis=1)
    flips(x.T.copy(), state, IdealGas(), made, crossed, np.zeros(len(x), bool), ROOM)
    assert (state[6]/state[7]).min() > rho.min()/4 and (state[8]/state[6]).min() > T.min()/4
    assert np.allclose(state[4:].sum(axis=1), before, rtol=1e-13)


HEATED = Domain(L=8.0, eta=0.1, k=0.1, g=1e-3, left=Periodic(), right=Periodic(), bottom=Plate(q=1e-3),
                top=Sliding(0.1, T=1.0))
SCENES_OF_ALL_KINDS = {
    "torus": SCENES["taylor-green"](rows=8), "plates": RayleighBenard(ra=1e4, L=8.0, transport=ConstNu),
    "four sides": SCENES["cavity"](rows=10), "heat that is given, a plate that slides": HEATED}


def in_disorder(scene, of_step):
    """A method, its triangles, state and step. Four points on a circle would flip at once, in any order."""
    method, state, dt = Carriage("disordered", size=0.25, of_limit=0.9*of_step).ready(scene)
    return method, corners(method.x, method.rings.size, method.rings.per == 0), state, dt


def past_body():
    """The same of a stream past a disc that turns, whose inside is left out."""
    size, radius = (14.0, 12.0), 2.6
    x, edge = with_disc(shifted(*size, 0.25, 1), radius)
    rim = held(edge, T=1.1)._replace(v=0.05*np.stack([-x[edge, 1], x[edge, 0]], axis=1))
    method = MovingDelaunay(x=x, rings=rings(x, size, TORUS, edge), held=rim, eos=IdealGas(),
                            law=ConstEta(0.3, 0.3))
    state, corner = method.state(1.0, np.tile([0.3, 0.0], (len(x), 1)), 1.0), corners(x, size, TORUS)
    return method, corner[outside(corner, edge)], state, 0.5*limit_of(method, state)


#: steps after which flips come one by one, and one so long that stiff edges exchange in parts
TWINS = {name: (partial(in_disorder, scene, 0.5), False) for name, scene in SCENES_OF_ALL_KINDS.items()}
TWINS |= {"stiff": (partial(in_disorder, RayleighBenard(ra=100.0, L=8.0), 2.5), True),
          "body": (past_body, False)}


@pytest.mark.parametrize(("made", "parts"), TWINS.values(), ids=TWINS)
def test_its_plain_twin_takes_the_same_steps(made, parts):
    """To the third flip: later ones of neighbouring edges come in another order, which changes fields."""
    method, corner, state, dt = made()
    plain, twin, sums = Plain(method, corner), state.copy(), method.start(state.shape[1], Threads(1))
    while plain.flips < 3:
        plain.step(twin, dt)
        sums.march(state, dt, 1)
    assert plain.flips == sums.flips
    sums.look_at(state)
    assert (dt*sums.bench.stiffness.max() > REAL) == parts
    assert np.allclose(state, twin, rtol=0, atol=1e-13)


def stirred(scene):
    """A method, a vortex, and the step."""
    method, _, dt = ready(scene, "moving-delaunay")
    x, y = 2*np.pi*method.x.T/10
    v = 0.2*np.stack([-np.cos(x)*np.sin(y), np.sin(x)*np.cos(y)], axis=1)
    return method, method.state(1.0, v, 1.0), dt


def insulated():
    """Method, state and step of a stream past a disc at rest that takes no heat."""
    method, _, state, dt = past_body()
    return replace(method, held=held(method.held.which)), state, dt


@pytest.mark.parametrize(("made", "steps", "kept"), [
    (partial(stirred, SCENES["taylor-green"](rows=10)), 10_000, [0, 1, 2, 3, 4]),
    (partial(stirred, Domain(L=10.0, eta=0.01, k=0.01)), 10_000, [2, 3, 4]), (insulated, 2000, [2, 3, 4])],
    ids=["torus", "box", "body"])
def test_mass_momentum_energy_and_volume_are_kept_to_round_off(made, steps, kept):
    """Sides and bodies take momentum, and no heat where they are insulated; at rest they do no work."""
    method, start, dt = made()
    sums, end = method.start(start.shape[1], Threads(1)), start.copy()
    sums.march(end, dt, steps)
    assert sums.flips > 100
    assert np.allclose(end[4:].sum(axis=1)[kept], start[4:].sum(axis=1)[kept], rtol=1e-12, atol=1e-11)
    V, _ = edges_of(sums.rings, end[:2].T)
    assert np.allclose(end[7], V, rtol=0, atol=1e-12)


@pytest.mark.parametrize("gradient, heating", [([[0, -1], [1, 0]], 0.0), ([[0, 1], [0, 0]], 1.0),
                                               ([[1, 0], [0, -1]], 4.0)], ids=["rotation", "shear", "strain"])
def test_a_linear_flow_heats_as_a_fluid_does(gradient, heating):
    """2 eta s:s per volume, summed; a rigid rotation does not heat. Points move with the flow."""
    scene = Domain(L=10.0, aspect=1.2, eta=0.3, k=0.1)
    method, _, _ = ready(scene, "moving-delaunay")
    v, plain = method.x@np.array(gradient, float).T, Plain(method, corners(method.x, SIZE, BOX))
    y = method.state(1.0, v, np.ones(len(v)))
    y[2:4], y[4:6] = v.T, y[6]*v.T
    y[8] = y[6]*(1 + (v**2).sum(axis=1)/2)
    t, i, j, S, k = plain.edges(y[:2])
    rates = plain.exchange(y, i, j, S, k) + plain.rest_of_stress(y, t)
    assert rates[4].sum() == pytest.approx(0, abs=1e-10)
    assert -(rates[:2]*v.T).sum() == pytest.approx(heating*0.3*120, abs=1e-10)


def test_two_threads_and_another_order_in_memory_change_no_bit(monkeypatch):
    method, start, dt = ready(RayleighBenard(ra=1e4, L=16.0), "moving-delaunay")
    plan = Plan(dt=dt/2, steps=40)       # in longer steps edges beside each other flip, whose order counts
    one, two = run(method, start, plan), run(method, start, replace(plan, threads=2))
    assert np.array_equal(one.state, two.state)
    monkeypatch.setattr(moving_delaunay, "MANY", 0)
    shared, alone = run(method, start, replace(plan, threads=2)), run(method, start, plan)
    assert np.array_equal(shared.state, alone.state)
    assert np.allclose(shared.state, one.state, rtol=0, atol=1e-13)
    monkeypatch.undo()
    monkeypatch.setattr(moving_delaunay, "AFAR", 0)
    sorted_often = run(method, start, plan)
    assert not np.array_equal(sorted_often.ids, one.ids)
    assert np.allclose(sorted_often.by_id(), one.by_id(), rtol=0, atol=1e-12)      # sums in another order


def test_a_ring_gets_room_when_it_is_full(monkeypatch):
    scene = SCENES["taylor-green"](rows=8)
    roomy, start, dt = ready(scene, "moving-delaunay")
    ends = [run(roomy, start, Plan(dt=dt, steps=100)).state]
    monkeypatch.setattr(rings_module, "ROOM", 3)
    for points_a_row in (1, 10_000):        # rows go on behind all others, or all are made anew
        monkeypatch.setattr(rings_module, "POINTS", points_a_row)
        ends.append(run(roomy, start, Plan(dt=dt, steps=100)).state)
    assert np.array_equal(ends[0], ends[1]) and np.array_equal(ends[0], ends[2])


def test_what_is_no_triangulation_is_refused():
    x, _ = between_sides(SIZE, PLATES, shifted, 0.1, 1)
    with pytest.raises(ValueError, match=r"6.29 spacings wide along x, where it is periodic.* needs 8"):
        rings(between_sides((6.0, 10.0), PLATES, shifted, 0.1, 1)[0], (6.0, 10.0), PLATES)
    twice = x.copy()
    twice[-1] = twice[-2]
    with pytest.raises(ValueError, match=r"overlap at .*, or nearly so"):
        rings(twice, SIZE, PLATES)
    with pytest.raises(ValueError, match=r"plates at -\+5: put a row of points"):
        rings(x*[1, 1.1], SIZE, PLATES)
    with pytest.raises(ValueError, match="on a side and not held"):
        MovingDelaunay(x=x, rings=rings(x, SIZE, PLATES), held=NONE_HELD, eos=IdealGas(), law=ConstEta(1, 1))


def test_a_state_on_another_triangulation_is_refused():
    method, start, dt = ready(SCENES["taylor-green"](rows=8), "moving-delaunay")
    end = run(method, start, Plan(dt=dt, steps=10)).state
    with pytest.raises(ValueError, match="not where the triangulation of the method is: start from"):
        run(method, end, Plan(dt=dt, steps=10))


def test_a_triangle_that_turns_over_ends_a_run_with_the_place_and_the_way_out():
    method, start, dt = ready(RayleighBenard(ra=1e6, L=8.0), "moving-delaunay")
    with pytest.raises(Divergence, match=r"a triangle of the point at .* has turned over.*shift above 0"):
        run(replace(method, shift=0.0), start, Plan(dt=dt, steps=5000))


def between_circles(rows, eta=0.5, speed=0.05):
    """A fluid at rest between points held on two circles; the inner ones turn. Exact: v = A r + B/r."""
    radii, at = np.array([0.18, 0.42])*rows, lattice((rows, rows)).x
    off = (np.abs(np.hypot(*at.T)[:, None] - radii) > CLEAR).all(axis=1)
    x = np.concatenate([*map(on_circle, radii), at[off]])
    r = np.hypot(*x.T)
    turned, fixed = np.flatnonzero(r < radii[0] + 1e-9), np.flatnonzero(r > radii[1] - 1e-9)
    v = speed/radii[0]*np.stack([-x[turned, 1], x[turned, 0]], axis=1)
    method = MovingDelaunay(x=x, rings=rings(x, (rows, rows), TORUS), eos=IdealGas(), law=ConstEta(eta, eta),
                            held=together(held(turned, T=1.0)._replace(v=v), held(fixed, T=1.0)))
    torque = 4*np.pi*eta*speed*radii[0]/(1 - (radii[0]/radii[1])**2)
    return method, torque, 9*(radii[1] - radii[0])**2/(np.pi**2*eta)


def test_the_torque_between_circles_is_of_second_order():
    """Points stay held on both, and what one gains the other loses."""
    errors = []
    for rows in (24, 48):
        method, exact, time = between_circles(rows)
        state = method.state(1.0, np.zeros_like(method.x), 1.0)
        dt, sums = 0.8*limit_of(method, state), method.start(len(method.x), Threads(1))
        sums.march(state, dt, round(time/dt))
        sums.look_at(state)
        (x, y), (Fx, Fy, _) = method.x[method.held.which].T, sums.received.T
        inner, outer = np.bincount(method.held.body, x*Fy - y*Fx)/exact
        assert sums.flips > 0
        assert -inner == pytest.approx(outer, abs=0.002)     # e^-9 of the start is left
        errors.append(abs(inner + 1))
    assert errors[1] < 0.005 and np.log2(errors[0]/errors[1]) > 1.5


def test_an_insulated_side_that_slides_does_its_work_and_no_energy_is_lost():
    scene = Domain(L=8.0, aspect=2.0, eta=0.1, k=0.1, left=Periodic(), right=Periodic(), top=Sliding(0.1))
    method, state, dt = ready(scene, "moving-delaunay")
    sums, before, work = method.start(state.shape[1], Threads(1)), state[8].sum(), []
    for _ in range(200):
        sums.march(state, dt/8, 1)
        sums.look_at(state)
        work.append(-sums.received[:, 2].sum()*dt/8)
    # the sum over steps is of first order in the step, the plate starts with a jump
    assert state[8].sum() - before == pytest.approx(sum(work), rel=0.02)
    assert sum(work) > 0
