"""The entropy-stable flux: any start, bends of the pressure, edges evaluated once; refusals."""
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from continuum.fluid import ConstEta, DenseFluid, IdealGas, VanDerWaals
from continuum.scene import RayleighBenard
from particles.integral import entropy_fluxes as fluxes
from particles.integral.edges import NONE_BEYOND
from particles.integral.entropy_stable import Positive, StableLayer
from particles.integral.exchange import At, Listing
from particles.integral.lanes import BLOCK, SLOPES
from particles.integral.layer import Layer
from particles.integral.once import FEW, Sending, empty_once, fill_once
from particles.integral.points import random
from particles.integral.positive import PART, Slopes
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.pairs import Face, Faces, sweep
from particles.threads import Threads
from studies.build import SCENES, ready

GAS, VDW, POINTS = IdealGas(2.5), VanDerWaals(0.5, 0.7, 1.5), random((12, 10), 0.4, 1)
CRITICAL = 8*VDW.a/27/VDW.b
LATTICE, JITTERED = "fixed-lattice-entropy-stable", "fixed-jittered-delaunay-entropy-stable"
MOVING, LAYERS = "moving-delaunay-entropy-stable", (LATTICE, JITTERED)


def closed(*flow, eos=GAS):
    """A fluid without viscosity on random points, their edges closed."""
    return StableLayer(x=POINTS.x, edges=delaunay(POINTS), beyond=NONE_BEYOND, eos=eos, law=ConstEta(0, 0),
                       g=0.0, T_plates=(1.0, 1.0), flow=flow)


def any_states(eos, n, seed=1, size=2.0):
    """Densities and temperatures (n,) far apart; of van der Waals' fluid above the critical point."""
    rho, T = np.exp(size*np.random.default_rng(seed).normal(size=(2, n)))
    return (rho/(1 + eos.b*rho), CRITICAL + T) if isinstance(eos, VanDerWaals) else (rho, T)


def violent(method, size=1.0, seed=2):
    """Densities and temperatures that differ a hundredfold, flow at several times the speed of sound."""
    n = len(method.x)
    rho, T = any_states(method.eos, n, seed, size)
    return method.state(rho, np.random.default_rng(seed + 1).normal(0, 3*size, (n, 2)), T)


def at_random(method, size=1.0, seed=2):
    """Points that differ a hundredfold and move at velocities of their own."""
    state, n = violent(method, size, seed), len(method.x)
    free = ~np.isin(np.arange(n), method.held.which)
    state[2:4] += size*np.random.default_rng(seed).normal(size=(2, n))*free
    return state


def evaluated(method, state):
    """The sums of a method, and the rates of a state."""
    sums, rates = method.start(state.shape[1], Threads(1)), np.empty_like(state)
    sums.rates(state, rates)
    return sums, rates


def over_a_step_too_long(method, state):
    """Changes of the sums over their size in a step far too long, which is halved and limited."""
    V, begun, sums = method.edges.V, state.copy(), method.start(state.shape[1], Threads(1))
    longest = sums.longest
    sums.longest = lambda: 20*longest()
    sums.look_at(state)
    Positive(state.shape, Threads(1)).step(sums, state, 40*longest())
    assert sums.limited and sums.refused and not sums.fault(state, np.arange(state.shape[1]))
    return (state - begun)@V/(np.abs(begun)@V).max()


@pytest.mark.parametrize("name, fluid", [
    (LATTICE, {}), (JITTERED, {}), (LATTICE, {"eos": VDW, "T_hot": 2.5, "T_cold": 1.5})],
    ids=["lattice", "jittered", "vdw"])
def test_no_start_is_too_violent_and_sums_are_kept(name, fluid):
    """All sums on closed edges. Mass between plates; without gravity and friction px and energy, too."""
    sticky = replace(ready(RayleighBenard(ra=1e4, L=8.0, **fluid), name).method, law=ConstEta(1e-3, 1e-3))
    slippery = replace(sticky, law=ConstEta(0, 0))
    for method, kept in ((sticky, [0]), (slippery, [0]), (replace(slippery, g=0.0), [0, 1, 3]),
                         (closed(eos=sticky.eos), [0, 1, 2, 3])):
        assert np.abs(over_a_step_too_long(method, violent(method))[kept]).max() < 1e-14


@pytest.mark.parametrize("name", LAYERS)
def test_friction_shortens_the_proven_step_by_its_rate(name):
    made = ready(RayleighBenard(ra=1e4, L=8.0), name).method
    state, rates = made.state(1.0, np.zeros_like(made.x), 1.0), []
    for eta in (0.0, 1e3):
        rates.append(1/limit_of(replace(made, law=ConstEta(eta, 0.0)), state))
    k = 2*np.bincount(made.beyond.i, made.beyond.k, len(made.x)) - made.edges.laplacian.diagonal()
    assert np.diff(rates) == pytest.approx(PART*1e3*np.max(k/made.edges.V), rel=1e-2)


def test_plates_hold_back_what_heats_as_they_do_without_the_flux():
    made = replace(ready(RayleighBenard(ra=1e4, L=8.0), LATTICE).method, g=0.0, law=ConstEta(1.0, 0.0))
    made = replace(made, flow=made.flow[:2])     # differs by v^3 from what `Layer` lists
    plain = Layer(**{name: value for name, value in vars(made).items() if name != "flow"})
    state = made.state(1.0, 1e-4*np.random.default_rng(1).normal(size=made.x.shape), 1.0)
    with_flux, without = (evaluated(one, state)[1][3] for one in (made, plain))
    assert np.abs(with_flux - without).max() < 1e-2*1e-4**2


EDGE = SimpleNamespace(dx=0.6, dy=-0.8)


def ends(one, other, c=1e-6):
    """Gradients of the velocity, (2, 2), at both ends of an edge."""
    return [SimpleNamespace(**dict(zip(("u_x", "u_y", "v_x", "v_y"), q.ravel())), c=c) for q in (one, other)]


def part_of_bends(one, other, c=1e-6):
    return fluxes.unturned(*ends(one, other, c), EDGE)


def test_a_bend_of_the_pressure_counts_where_the_flow_shrinks_and_not_where_it_turns():
    draw, rigid = np.random.default_rng(1), np.array([[0.0, -1], [1, 0]])
    for one, other, angle in zip(*draw.normal(size=(2, 20, 2, 2)), draw.uniform(0, 6, 20)):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        wave, part = np.outer(turn[0], turn[0]), part_of_bends(one, other)
        assert part == pytest.approx(part_of_bends(turn@one@turn.T, turn@other@turn.T), rel=1e-12)
        assert 0 < part < 1 and part == part_of_bends(other, one)
        assert part_of_bends(wave, -3*wave) == pytest.approx(1, rel=1e-12)
        assert part_of_bends(wave, rigid) == pytest.approx(1/5, rel=1e-12)
        strain = turn@np.diag([1.0, -1])@turn.T
        assert part_of_bends(strain, strain) < 1e-12
        assert part_of_bends(np.eye(2), np.eye(2) + 0.9*strain) == pytest.approx(1, rel=1e-12)
        assert part_of_bends(1e-15*one, 1e-15*other, c=1.0) == 1        # round-off of a gas at rest
    assert part_of_bends(rigid, rigid) < 1e-12


def test_a_bend_of_the_pressure_counts_by_its_square_and_a_thousandth_where_it_is_looked_at():
    wave = np.diag([1.0, 0.0])
    sizes = np.array([0.0, fluxes.FAINT, fluxes.CALM, 2*fluxes.CALM, 1.0])
    parts = [fluxes.shock(*ends(wave, wave), EDGE, size/fluxes.STEEPEST) for size in sizes]
    of_pressure = [0, fluxes.CALM/(1 + fluxes.CALM), 1/2, 4/5, 1/(1 + fluxes.CALM**2)]
    assert np.allclose(parts, np.transpose([of_pressure, sizes]), rtol=1e-9, atol=1e-15)


def test_the_limited_mean_leaves_nothing_of_a_line_all_of_an_extremum_and_the_same_from_both_ends():
    for d, before, behind in np.random.default_rng(1).normal(size=(50, 3)):
        _, left = fluxes.bend(d, d + before, d + behind, d)
        mean = 2*before*behind/(before + behind) if before*behind > 0 else 0.0
        assert left == pytest.approx(np.clip(1 - mean/d, 0, 1), abs=1e-12)
        assert left == pytest.approx(fluxes.bend(-d, -d - behind, -d - before, -d)[1], abs=1e-14)
    assert fluxes.bend(0.3, 0.6, 0.6, 0.3) == pytest.approx((0, 0), abs=1e-15)
    assert fluxes.bend(0.0, 0.0, 0.0, 0.0)[0] == 0
    # a bend is small beside a large jump that dissipates
    assert fluxes.bend(0.0, 1.0, -0.5, 3.0)[0] == pytest.approx((0.5/7.5)**fluxes.STEEP, rel=1e-12)


C = 1.2


def gains_along_x(r, rho=1.0, u=0.0, v=0.0):
    """Gains (4,) of a gas at rest by dissipation on an edge along x to one of rho, u, v and its pressure.
    r (2,) : velocity of the edge."""
    ends = [SimpleNamespace(**dict.fromkeys(("g", "hydro", *SLOPES), 0.0), P=1.0, c=C, rx=r[0], ry=r[1],
                            rho=rho, T=1/rho, vx=u, vy=v) for rho, u, v in ((1.0, 0.0, 0.0), (rho, u, v))]
    edge = Face(0.5, 0.0, 0.0, 1.0, 0.0)
    return fluxes.waves(GAS, *ends, edge, *fluxes.jumps(*ends, edge))


def test_a_flow_along_an_edge_dissipates_entropy_and_shear_a_tenth_as_much_as_one_across():
    for number, jump in ((0, {"rho": 2.0}), (2, {"v": 1e-6})):
        along, across = (gains_along_x(r, **jump)[number] for r in ((0.0, 1.0), (1.0, 0.0)))
        assert along/across == pytest.approx(0.1/np.hypot(1, 0.1), rel=1e-9) and across > 0


def test_the_normal_velocity_is_dissipated_by_its_fastest_wave_times_the_mach_number_below_one():
    for speed in (0.1, 0.2, 2.0, 4.0):
        gain = gains_along_x((speed, 0.0), u=1e-9)[1]
        assert gain/1e-9 == pytest.approx(0.5*(speed + C)*min(1, speed/np.sqrt(1.4)), rel=1e-8)


def test_fluids_without_an_entropy_and_plates_that_slide_are_refused():
    for method in (closed(), ready(SCENES["taylor-green"](8), MOVING).method):
        with pytest.raises(TypeError, match=r"DenseFluid has no formula for log_means and acoustics and"):
            replace(method, eos=DenseFluid())
    with pytest.raises(ValueError, match=r"cannot take slide = 0\.1"):
        ready(SCENES["couette"](8), LATTICE)


# --- edges that are evaluated once ------------------------------------------------------------------

NARROW = random((3, 2), 0.2, 1)


def looked_at(method, state, threads=1):
    """Sums with fields and gradients of a state."""
    sums = method.start(state.shape[1], Threads(threads))
    sums.look_at(state)
    return sums


def half_violent(method):
    """Noise on one side and at one point of the other, which is uniform: see `both_ways`."""
    calm, wild = violent(method, 0.0), violent(method)
    x, y = method.x.T
    noisy = x >= 0
    noisy[np.argmin(np.hypot(x - x.min()/2, y))] = True
    return np.where(noisy, wild, calm)


def both_ways(sums):
    """Whether some blocks of edges dissipate at once, some edge by edge, and some not at all."""
    sending = sums.sending
    number = sending.stirred.reshape(-1, int(BLOCK)).sum(axis=1)[:sending.blocks]
    return number.min() == 0 and number.max() > FEW and ((number > 0) & (number <= FEW)).any()


def narrow():
    """A closed box with more than one edge between two points."""
    method = StableLayer(**{**vars(closed()), "x": NARROW.x, "edges": delaunay(NARROW)})
    pairs = np.stack([method.edges.i, method.edges.j])
    assert np.unique(pairs, axis=1).shape[1] < pairs.shape[1]
    return method


@pytest.mark.parametrize("name, state", [
    *((name, state) for name in LAYERS for state in (half_violent, partial(violent, size=0.01))),
    (MOVING, at_random), ("narrow", violent)])
def test_points_gain_what_rows_bring(name, state):
    scene = SCENES["taylor-green"](8) if name == MOVING else RayleighBenard(ra=1e4, L=48.0)
    method = narrow() if name == "narrow" else ready(scene, name).method
    sums = looked_at(method, state(method))
    slopes, rows = np.zeros((sums.n, 8)), np.zeros((sums.n, 4))
    sweep(0, sums.n, Slopes(), sums.points, sums.edges, slopes)
    sweep(0, sums.n, Listing((*method.transport, *method.flow)), sums.points, sums.edges, rows)
    sums.sending.follow(sums.edges)
    sums.sending.slopes, sums.sending.stages = slopes, ()
    once = sums.sending.sum(At(sums.points, sums.edges, sums.images, np.ones(sums.n)))
    assert np.allclose(once, rows, rtol=0, atol=1e-13*np.abs(rows).max())
    assert state is not half_violent or both_ways(sums)


def test_an_edge_without_a_way_back_is_one_of_its_own():
    edges = Faces(np.array([0, 1], np.uint64), np.array([1, 1], np.uint32), np.array([1, 0], np.uint32),
                  np.array([0.5, -0.4]), *np.zeros((4, 2)))
    once = empty_once(2)
    assert fill_once(2, edges, once) == 2
    assert once.sign.tolist() == [1, 1] and once.sx[:2].tolist() == [0.5, -0.4]
    edges.sx[1] = -0.5
    assert fill_once(2, edges, once) == 1 and once.sign.tolist() == [1, -1]


@pytest.mark.parametrize("name", LAYERS)
def test_threads_change_no_bit(name):
    method = ready(RayleighBenard(ra=1e4, L=48.0), name).method
    state, rates = half_violent(method), []
    for threads in (1, 3):
        sums = looked_at(method, state, threads)
        assert sums.sending.blocks >= 64*threads      # else one thread takes all
        rates.append(np.empty_like(state))
        sums.rates(state, rates[-1])
        assert both_ways(sums)
    assert np.array_equal(*rates)


def test_nothing_is_sent_where_nothing_is_listed():
    sums = looked_at(closed(), violent(closed()))
    sending = Sending((), (), sums.slopes, Threads(1))
    sending.follow(sums.edges)
    assert not sending.sum(sums.at).any()
