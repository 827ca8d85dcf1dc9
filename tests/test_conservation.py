"""The study conservation: what changes are divided by, that controls lose, linear sound against the full equations."""
from dataclasses import replace
from itertools import combinations, product
from math import fsum

import numpy as np
import pytest

import studies.conservation.cases as conservation
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from particles.integral.dih import Dih
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.points import jittered, lattice
from particles.integral.rr98_moving_plain import MOTIONS
from particles.run import Plan, run
from particles.weights import WEIGHTS, Lucy, Monaghan
from studies.build.disorder import DISORDERS
from studies.conservation.dimensions import FORMS, DihDrift, Unsymmetric
from studies.conservation.drift import MODES, WALLS, MovingDrift, around
from studies.conservation.figures import COLUMNS, column
from studies.conservation.frames import KINDS, Frame, after, sound
from studies.conservation.motions import MotionDrift
from studies.conservation.sums import Watch, exact_sums, kinetic, parts, random_fields, sizes


def row(case, table="drift"):
    return case.run(lambda done: None, None).rows[table][0]


def largest(columns):
    return max(columns[name] for name in ("mass", "momentum", "energy"))


# --- measuring ----------------------------------------------------------------------------------


def test_sums_are_exact():
    V, state = np.ones(3), np.array([[1e16, 1.0, -1e16], [1.0, 2.0, 3.0]])
    assert list(exact_sums(V, state)) == [1.0, 6.0] and fsum(V*state[0]) != V@state[0]


def test_a_watch_keeps_the_largest_change():
    watch = Watch(lambda state: np.array([state, 1.0]), np.array([2.0, 1.0]))
    for state in (3.0, 3.5, 2.0, 3.0):
        watch(state)
    assert list(watch.worst) == [0.5, 0.0]


@pytest.mark.parametrize("steps", [7, 20, 333, 10_000])
def test_parts_make_the_whole(steps):
    made = list(parts(steps))
    assert sum(number for _, number in made) == steps and made[0][0] == 0
    assert [before for before, _ in made] == [sum(n for _, n in made[:k]) for k in range(len(made))]


def test_random_starts_are_as_rough_as_asked_for():
    points = lattice((16, 16))
    starts = [random_fields(points, 0.1, seed) for seed in range(40)]
    rms = np.sqrt(np.mean([np.var(rho) for rho, _, _ in starts]))
    assert rms == pytest.approx(0.1, rel=0.1)       # 40 samples of 24 waves: 5 % for two standard deviations
    assert np.mean([v.mean(axis=0) for _, v, _ in starts], axis=0) == pytest.approx([0.1, -0.05], abs=1e-12)


def test_kinetic_energy_does_not_count_the_wind():
    v, rho, one = np.array([[1.0, 0.0], [-1.0, 0.5]]), np.array([1.0, 3.0]), np.ones(2)
    fields = Fields(v, v, rho, one, one)
    assert kinetic(fields) == pytest.approx(kinetic(fields._replace(v=v + 7)), rel=1e-12)
    assert kinetic(fields) == pytest.approx(2.0 - 1.0**2/2 + 0.375 - 0.28125, rel=1e-12)     # sum m v^2/2 - P^2/2M
    assert kinetic(fields._replace(v=np.array([[2.0, 1.0]]*2))) == pytest.approx(0, abs=1e-12)


def test_changes_are_divided_by_mass_momenta_and_energy():
    v, rho = np.array([[3.0, 4.0], [0.0, -1.0]]), np.array([1.0, 2.0])
    fields = Fields(v, v, rho, np.array([1.0, 2.0]), np.array([1.0, 0.5]))
    assert list(sizes(IdealGas(), fields)) == pytest.approx([2.0, 6.0, 6.0, 1.0 + 12.5 + 2.0 + 0.5], rel=1e-15)


# --- runs ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
def test_compiled_runs_keep_their_sums_and_lose_their_motion(mode):
    columns = row(conservation.layer(mode, "exact", "jittered-0.3", steps=400))
    assert columns["reached"] == 400 and columns["claimed"] == "mass momentum energy"
    assert largest(columns) < 1e-14
    assert 0 < columns["motion"] < 1.2       # sound may turn heat into motion and back
    assert (columns["motion"] < 0.2) == (mode != "ideal")


@pytest.mark.parametrize("form", ["pairwise", "printed"])
@pytest.mark.parametrize("d", [1, 2, 3])
def test_runs_in_all_dimensions_keep_their_sums(form, d):
    columns = row(DihDrift(form=FORMS[form], d=d, steps=40))
    assert columns["reached"] == 40 and largest(columns) < 1e-14


def test_a_pressure_that_is_not_symmetric_loses_momentum_until_it_diverges():
    columns = row(DihDrift(form=FORMS["one-sided"], d=1, steps=60))
    assert columns["momentum"] > 1e-3 and columns["mass"] < 1e-14 and "momentum" not in columns["claimed"]
    lost = row(Unsymmetric(steps=60), "losses")
    assert 1e-3 < lost["lost"] <= columns["momentum"]*(1 + 1e-9) and lost["reached"] == 60


@pytest.mark.parametrize("wall", ["rows", "sliding rows", "rows on plates", "body"])
def test_what_held_points_take_is_what_the_fluid_loses(wall):
    maker, points = ("delaunay", "jittered-0.3") if wall == "rows on plates" else ("renormalised", "lattice")
    case = conservation.hold(wall, maker, points, steps=100)
    columns, method = row(case), case.method(case.points())
    assert columns["reached"] == 100 and largest(columns) < 1e-13
    state = case.start(method, case.points())
    taken = run(method, state, Plan(dt=0.1, steps=10)).state[4:]
    assert abs(taken[0, 0]) > 1e-3 and not taken[:, 1:].any()
    assert (taken[2, 0] != 0) == (wall != "body")       # which is adiabatic


@pytest.mark.parametrize("mode", ["pairwise", "ideal"])
def test_sliding_sides_give_what_their_book_says(mode):
    case = conservation.sliding(mode, "renormalised", Lucy, steps=60)
    columns, method = row(case), case.method(case.points())
    assert columns["reached"] == 60 and largest(columns) < 1e-13
    state = case.start(method, case.points())
    given = np.abs(method.edges.V@run(method, state, Plan(dt=0.1, steps=10)).state[5:].T)
    assert given.max() > 1e-4*(1 if mode == "pairwise" else 1e-3)


@pytest.mark.parametrize(("motion", "keeps"), [("literal", True), ("constant-mass", True), ("convective", False)])
def test_motions_keep_their_sums_or_lose_them(motion, keeps):
    columns = row(MotionDrift(motion=motion, kind=MOTIONS[motion], steps=60))
    assert (columns["claimed"] != "nothing") == keeps
    assert (largest(columns) < 1e-14) == keeps


def test_plates_with_friction_take_momentum_and_without_it_none():
    with_friction, without = (row(conservation.layer(mode, "delaunay", "jittered-0.3", "plates", steps=200))
                              for mode in ("pairwise", "ideal"))
    assert with_friction["momentum"] > 1e-2 and with_friction["claimed"] == "mass" and with_friction["mass"] < 1e-14
    assert largest(without) < 1e-14


def test_plain_quadrature_off_a_lattice_diverges_and_says_when():
    assert 0 < row(conservation.layer("nested", "plain", "jittered-0.3", steps=400))["reached"] < 400


def test_edges_that_do_not_exist_leave_no_row():
    def none(points, weight):
        raise ArithmeticError("no such edges")
    case = replace(conservation.layer("pairwise", "exact", "lattice"), make=none)
    assert case.run(lambda done: None, None).rows == {}


def test_a_box_without_plates_has_no_images():
    case = replace(conservation.layer("pairwise", "plain", "lattice"), wall=WALLS["periodic"])
    assert case.method(around(case.disorder, 1, plates=False)).beyond is NONE_BEYOND


def test_a_run_whose_points_pair_ends_there_and_keeps_its_sums():
    columns = row(MovingDrift(weight=Monaghan))
    assert 100 < columns["reached"] < columns["steps"] and largest(columns) < 1e-14


# --- frames and sound ---------------------------------------------------------------------------


def frame(mode, maker):
    return row(Frame(mode=mode, maker=maker, make=MAKERS[maker], disorder=DISORDERS["jittered-0.3"]), "frames")


@pytest.mark.parametrize("mode", ["nested", "printed", "unmended", "everywhere"])
def test_closed_edges_do_not_know_of_a_wind(mode):
    assert largest(frame(mode, "delaunay")) < 1e-12


def test_what_knows_of_a_wind_shows_it():
    assert frame("printed", "plain")["momentum"] > 1e-4 and frame("pairwise", "delaunay")["energy"] > 1e-4


@pytest.mark.parametrize("maker", ["plain", "delaunay"])
def test_sound_is_the_linear_part_of_the_equations(maker):
    """Brackets of Eqs 34 and 35 about rest, isothermal part: d rho = -rho0 div v, d v = -T grad rho/rho0 at T = 1."""
    at = jittered((8, 8), 0.3, 1)
    edges: Edges = MAKERS[maker](at, Lucy.of(h=3.0))
    fluid = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.0, 0.0))
    L, root, n = sound(edges, "plus"), np.sqrt(edges.V), at.n
    rng, step = np.random.default_rng(0), 1e-6
    rho, v = rng.normal(size=n), rng.normal(size=(n, 2))
    rates = np.empty((2, 4, n))
    for out, sign in zip(rates, (-1, 1), strict=True):
        fluid.rates(fluid.state(1 + sign*step*rho, sign*step*v, np.ones(n)), out)
    slope = (rates[1] - rates[0])/(2*step)
    expected = (L@(np.concatenate([rho, *v.T])*np.tile(root, 3))).reshape(3, n)/root
    base = rates.mean(axis=0)[1:3]      # off a lattice the plain bracket makes a force of a constant pressure
    assert (np.abs(base).max() > 0.1) == (maker == "plain")
    np.testing.assert_allclose(slope[:3], expected, atol=1e-7*np.abs(expected).max())


def test_energy_after_many_periods():
    turn = np.array([[0.6, 0.8], [-0.8, 0.6]])
    assert after(turn, 1000, 1) == pytest.approx(0, abs=1e-12)
    assert after(1.01*turn, 1000, 1) == pytest.approx(2000*np.log(1.01), rel=1e-12)


# --- which runs there are -----------------------------------------------------------------------


def test_any_two_values_of_two_factors_meet():
    """Of transports, weights, makers, points in periodic boxes; of makers, points, weights with plates and held points."""
    runs = [{"mode": case.mode.name, "weight": case.weight.__name__, "maker": case.maker, "wall": case.wall.name,
             "points": case.disorder.name}
            for case in conservation.cases("paper") if getattr(case, "scheme", "") in ("layer", "held")]
    weights = {kind.__name__ for kind in WEIGHTS.values()}
    values = {"mode": set(MODES), "weight": weights, "maker": set(MAKERS), "points": set(KINDS)}
    impossible = {(maker, "lattice") for maker in ("closed", "exact")}
    impossible |= {("delaunay", kind) for kind in weights if kind != "Lucy"}
    for one, other in combinations(values, 2):
        met = {(a[one], a[other]) for a in runs if a["wall"] == "periodic"}
        missing = set(product(values[one], values[other])) - met
        assert not {pair for pair in missing if pair not in impossible and pair[::-1] not in impossible}
    for wall, factor in product(("plates", "rows", "body"), ("weight", "maker", "points")):
        assert {one[factor] for one in runs if one["wall"] == wall} == values[factor]


def test_every_run_has_its_column():
    runs = [("layer", "ideal", "plates, gravity"), ("dih", "printed", "periodic"), ("held", "filtered", "body"),
            ("motions", "constant-mass, RK4", "periodic"), ("moving", "open faces", "periodic")]
    assert [list(COLUMNS.values())[column(*one)] for one in runs] == [
        "plates, gravity", "nested, Eq. 37 as printed", "fluid and body", "Eq. 49", "the same, parts left out"]
