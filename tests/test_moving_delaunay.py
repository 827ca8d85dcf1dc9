"""Points that move with their triangulation: its geometry, flips, laws of conservation, and its slow twin."""
from dataclasses import replace

import numpy as np
import pytest
from plain_moving_delaunay import Plain
from scenes import between_circles, turning

from continuum.domain import Domain
from continuum.fluid import ConstEta, ConstNu, IdealGas
from continuum.scene import RayleighBenard
from continuum.sides import Periodic, Plate, Sliding
from particles.integral import moving_delaunay
from particles.integral import rings as rings_module
from particles.integral.bodies import held, together, with_disc
from particles.integral.flips import flips
from particles.integral.march import REAL
from particles.integral.moving_delaunay import MovingDelaunay
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


def corners(x, size, closed):
    """Triangles (T, 3) of SciPy, counterclockwise."""
    corner, at = triangles(x, size, closed)
    one, two = at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]
    turned = one[:, 0]*two[:, 1] < one[:, 1]*two[:, 0]
    corner[turned] = corner[turned][:, ::-1]
    return corner


def of_points(size, closed, jitter, seed):
    """Points (n, 2) between rows on sides."""
    return between_sides(size, closed, shifted, jitter, seed)


def neighbours(made):
    """Of each point."""
    return [set(row[row >= 0]) for row in table_of(made)]


def edges_of(made, x):
    """(V, crossed), with S and k in the rings."""
    n = len(x)
    V, crossed = np.zeros(n), np.zeros(n, bool)
    geometry(0, n, x.T.copy(), made, V, np.zeros((n, 2)), np.zeros(n), crossed)
    return V, crossed


def room(n):
    """For points whose rings change, and edges to look at."""
    return np.zeros(n, bool), np.zeros((4000, 2), np.int64)


@pytest.mark.parametrize("closed", [TORUS, PLATES, BOX])
def test_flips_end_at_delaunays_triangulation_and_keep_linear_fields(closed):
    """What points have of a linear field, per volume, they have after flips, on the same places."""
    x, _ = of_points(SIZE, closed, 0.1, seed=3)
    made, n = rings(x, SIZE, closed), len(x)
    x = x + 0.35*np.random.default_rng(0).uniform(-1, 1, x.shape)*~made.rim[:, None]
    V, crossed = edges_of(made, x)
    slope = np.multiply([0.1, 0.2], closed)       # where a field may be linear
    fields = np.stack([np.full(n, 2.0), np.zeros(n), 3 + x@slope, np.ones(n), np.full(n, 5.0)])
    state = np.concatenate([x.T, 0*x.T, fields*V])
    before = state[4:].sum(axis=1)
    count, full = flips(x.T.copy(), state, IdealGas(), made, crossed, *room(n))
    assert count > 10 and full == -1
    assert neighbours(made) == neighbours(rings(x, SIZE, closed))
    V, crossed = edges_of(made, x)
    assert not crossed.any()
    assert np.allclose(state[7], V, rtol=0, atol=1e-13)
    assert np.allclose(state[4:]/V, fields, rtol=1e-12)
    assert np.allclose(state[4:].sum(axis=1), before, rtol=1e-13)


def test_flips_leave_what_is_positive_positive_where_densities_jump():
    x, _ = of_points(SIZE, TORUS, 0.1, seed=3)
    made, n, draw = rings(x, SIZE, TORUS), len(x), np.random.default_rng(0)
    x = x + 0.35*draw.uniform(-1, 1, x.shape)
    V, crossed = edges_of(made, x)
    rho, T = 10**draw.uniform(-2, 2, (2, n))
    state = np.concatenate([x.T, 0*x.T, np.stack([0*rho, 0*rho, rho, np.ones(n), rho*T])*V])
    before = state[4:].sum(axis=1)
    flips(x.T.copy(), state, IdealGas(), made, crossed, *room(n))
    least = rho.min(), T.min()
    assert (state[6]/state[7]).min() > least[0]/4 and (state[8]/state[6]).min() > least[1]/4
    assert np.allclose(state[4:].sum(axis=1), before, rtol=1e-13)


HEATED = Domain(L=8.0, eta=0.1, k=0.1, g=1e-3, left=Periodic(), right=Periodic(), bottom=Plate(q=1e-3),
                top=Sliding(0.1, T=1.0))
SCENES_OF_ALL_KINDS = {
    "torus": SCENES["taylor-green"](rows=8), "plates": RayleighBenard(ra=1e4, L=8.0, transport=ConstNu),
    "four sides": SCENES["cavity"](rows=10), "heat that is given, a plate that slides": HEATED}
#: of the step that is taken: flips come one by one, or edges are so stiff that they exchange in parts
TWINS = [*((scene, 0.5) for scene in SCENES_OF_ALL_KINDS.values()), (RayleighBenard(ra=100.0, L=8.0), 2.5)]


@pytest.mark.parametrize("scene, of_step", TWINS, ids=[*SCENES_OF_ALL_KINDS, "in parts"])
def test_its_plain_twin_takes_the_same_steps(scene, of_step):
    """To the third flip; later on flips of neighbouring edges come in another order, with other remains.
    Points start in disorder, since four on a circle flip at once, in any order."""
    method, state, dt = Carriage("disordered", size=0.25, of_limit=0.9*of_step).ready(scene)
    plain, twin = Plain(method, corners(method.x, method.rings.size, method.rings.per == 0)), state.copy()
    sums = method.start(state.shape[1], Threads(1))
    while plain.flips < 3:
        plain.step(twin, dt)
        sums.march(state, dt, 1)
    assert plain.flips == sums.flips
    sums.look_at(state)
    assert (dt*sums.bench.stiffness.max() > REAL) == (of_step > 1)
    assert np.allclose(state, twin, rtol=0, atol=1e-13)


@pytest.mark.parametrize("scene, kept", [
    (SCENES["taylor-green"](rows=10), slice(0, 5)), (Domain(L=10.0, eta=0.01, k=0.01), slice(2, 5))],
    ids=["torus", "box"])
def test_mass_momentum_energy_and_volume_are_kept_to_round_off(scene, kept):
    """Over 10 000 steps; sides take momentum."""
    method, _, dt = ready(scene, "moving-delaunay")
    x, y = 2*np.pi*method.x.T/10
    v = 0.2*np.stack([-np.cos(x)*np.sin(y), np.sin(x)*np.cos(y)], axis=1)
    start = method.state(1.0, v, 1.0)
    sums, end = method.start(start.shape[1], Threads(1)), start.copy()
    sums.march(end, dt, 10_000)
    assert sums.flips > 100
    assert np.allclose(end[4:].sum(axis=1)[kept], start[4:].sum(axis=1)[kept], rtol=1e-12, atol=1e-11)
    V, _ = edges_of(sums.rings, end[:2].T)
    assert np.allclose(end[7], V, rtol=0, atol=1e-12)


def test_a_stream_flows_past_a_body_whose_inside_is_left_out():
    """As its twin steps, to the third flip; in 2000 steps mass, energy and volume stay to round-off: the body
    takes no heat and does no work."""
    size, radius = (14.0, 12.0), 2.6
    x, edge = with_disc(shifted(*size, 0.25, 1), radius)
    method = MovingDelaunay(x=x, rings=rings(x, size, TORUS, edge), held=held(edge), eos=IdealGas(),
                            law=ConstEta(0.3, 0.3))
    state = method.state(1.0, np.tile([0.3, 0.0], (len(x), 1)), 1.0)
    dt, sums, corner = 0.5*limit_of(method, state), method.start(len(x), Threads(1)), corners(x, size, TORUS)
    plain, twin = Plain(method, corner[outside(corner, edge)]), state.copy()
    while plain.flips < 3:
        plain.step(twin, dt)
        sums.march(state, dt, 1)
    assert plain.flips == sums.flips
    assert np.allclose(state, twin, rtol=0, atol=1e-13)
    before = state[6:].sum(axis=1)
    assert before[1] == pytest.approx(14*12 - len(edge)/2*radius**2*np.sin(2*np.pi/len(edge)), rel=1e-12)
    sums.march(state, dt, 2000)
    assert sums.flips > 100
    assert np.allclose(state[6:].sum(axis=1), before, rtol=1e-12)


def test_the_torque_between_circles_is_of_second_order():
    """Points stay held on both, and what one gets the other gives; exact: A r + B/r, 4 pi eta B."""
    eta, speed, errors = 0.5, 0.05, []
    for rows in (24, 48):
        inner, outer = 0.18*rows, 0.42*rows
        points, turned, fixed = between_circles((rows, rows), inner, outer)
        both = together(turning(points, turned, speed/inner, 1.0), turning(points, fixed, 0.0, 1.0))
        method = MovingDelaunay(x=points.x, rings=rings(points.x, (rows, rows), TORUS), held=both,
                                eos=IdealGas(), law=ConstEta(eta, eta))
        state = method.state(1.0, np.zeros_like(points.x), 1.0)
        dt, time = 0.8*limit_of(method, state), 9*(outer - inner)**2/(np.pi**2*eta)
        sums = method.start(len(points.x), Threads(1))
        sums.march(state, dt, round(time/dt))
        sums.look_at(state)
        (x, y), (Fx, Fy, _) = points.x[both.which].T, sums.received.T
        torque = np.bincount(both.body, x*Fy - y*Fx)*(1 - (inner/outer)**2)/(4*np.pi*eta*speed*inner)
        assert sums.flips > 0
        assert -torque[0] == pytest.approx(torque[1], abs=0.002)     # e^-9 of the start is left
        errors.append(abs(torque[0] + 1))
    assert errors[1] < 0.005 and np.log2(errors[0]/errors[1]) > 1.5


def between_plates(speed):
    """A gas between plates that both slide."""
    return Domain(L=8.0, eta=0.1, k=0.1, left=Periodic(), right=Periodic(), bottom=Sliding(speed, T=1.5),
                  top=Sliding(speed, T=1.0))


@pytest.mark.parametrize("speed", [0.7, 7.0])
def test_a_stream_along_plates_that_slide_with_it_changes_nothing(speed):
    """On a torus `test_streams` asks for it."""
    vortex = SCENES["taylor-green"](rows=8)
    (method, _, dt), (moved, _, _) = (ready(between_plates(v), "moving-delaunay") for v in (0.0, speed))
    rho, v, T = vortex.fields(method.x)
    rest, carried = method.state(rho, v, T), moved.state(rho, v + [speed, 0.0], T)
    for one, state in ((method, rest), (moved, carried)):
        one.start(state.shape[1], Threads(1)).march(state, dt, 100)
    at_rest, in_stream = method.fields(rest), method.fields(carried)
    assert np.allclose(in_stream.v - [speed, 0.0], at_rest.v, rtol=0, atol=1e-12)
    assert np.allclose(in_stream.T, at_rest.T, rtol=1e-11)      # T is told from an energy that v^2 adds to


@pytest.mark.parametrize("gradient, heating", [([[0, -1], [1, 0]], 0.0), ([[0, 1], [0, 0]], 1.0),
                                               ([[1, 0], [0, -1]], 4.0)], ids=["rotation", "shear", "strain"])
def test_a_linear_flow_heats_as_a_fluid_does(gradient, heating):
    """2 eta s:s a volume, in all; a rigid rotation does not heat. Points go along: nothing is carried."""
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
    x, _ = of_points(SIZE, PLATES, 0.1, seed=1)
    with pytest.raises(ValueError, match=r"6.29 spacings wide along x, where it is periodic.* needs 8"):
        rings(of_points((6.0, 10.0), PLATES, 0.1, 1)[0], (6.0, 10.0), PLATES)
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
