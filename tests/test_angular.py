"""Angular momentum: torques of edges are those of points, and which vanish    [RR98 Eqs 35, 37, 49, 51]"""
import numpy as np
import pytest
from scenes import rows_of

from particles.integral.edge_makers import MAKERS, exact, plain
from particles.integral.points import Points, jittered, lattice
from particles.integral.rr98_moving_plain import MOTIONS
from particles.weights import Lucy, WendlandC2
from studies.conservation.angular import (
    EdgeTorque,
    MotionTorque,
    cross,
    disc,
    exchanges,
    relative,
)
from studies.conservation.sums import random_fields

ZERO, BROKEN = 1e-15, 1e-9     # round-off; what is none, though signs may cancel
LAWFUL = ("pressure, P_i + P_j", "convection, half of each end", "friction, Eq. 37")


def torques(maker, points="jittered-0.3", seed=4):
    case = EdgeTorque(make=MAKERS[maker], points=points, seed=seed)
    return {row["exchange"]: row["torque"] for row in rows_of(case, "torques")}


def test_torques_of_edges_are_those_of_their_ends():
    points = disc(2)
    edges = plain(points, Lucy.of(h=3.0))
    for name, f in exchanges(edges, random_fields(points, 0.1, 2)):
        force = np.stack([np.bincount(edges.j, one, edges.n) - np.bincount(edges.i, one, edges.n)
                          for one in f.T], axis=1)
        assert cross(points.x, force).sum() == pytest.approx(cross(edges.apart, f).sum(), abs=1e-11), name


@pytest.mark.parametrize("maker", ["delaunay", "exact"])
@pytest.mark.parametrize("seed", [4, 5])
def test_halves_of_a_symmetric_stress_have_no_torque_on_exact_edges(maker, seed):
    found = torques(maker, seed=seed)
    assert max(found[name] for name in LAWFUL) < ZERO
    assert found["friction, Eq. 37, eta(T)"] > BROKEN and found["convection, Eq. 35"] > BROKEN


@pytest.mark.parametrize("maker", ["plain", "renormalised", "printed"])
def test_what_points_along_edges_has_no_torque(maker):
    found = torques(maker)
    along = ("pressure, P_i + P_j", "pressure, Eq. 13", "friction, Eq. 51, B = 0")
    assert max(found[name] for name in along) < ZERO
    assert found["friction, Eq. 51"] > BROKEN


def test_friction_along_velocities_has_no_torque_where_the_laplacian_of_places_is_zero():
    assert max(torques("delaunay")["friction, Eq. 51"],
               torques("renormalised", "lattice")["friction, Eq. 51"]) < ZERO


def test_crossed_pressure_turns_by_a_product_of_differences():
    """P_ij + P_ji - P_i - P_j = -(rho_i - rho_j)(T_i - T_j): fields a tenth as large turn by a hundredth."""
    points = jittered((12, 12), 0.3, 6)
    edges, (rho, v, T) = exact(points, WendlandC2.of(h=3.0)), random_fields(points, 0.1, 6)
    whole, tenth = (dict(exchanges(edges, (1 + c*(rho - 1), v, 1 + c*(T - 1)))) for c in (1.0, 0.1))
    turn = [cross(edges.apart, f["pressure, Eq. 13"]).sum() for f in (whole, tenth)]
    assert turn[1] == pytest.approx(turn[0]/100, rel=1e-6)


@pytest.mark.parametrize("motion", MOTIONS)
def test_motions_keep_angular_momentum_where_masses_stay(motion):
    case = MotionTorque(motion=motion, kind=MOTIONS[motion], friction="none", seed=3)
    torque = rows_of(case, "motion_torques")[0]["torque"]
    assert torque < ZERO if motion in ("carried", "constant-mass") else torque > BROKEN


def test_smooth_particles_push_along_pairs_and_rub_across():
    found = [rows_of(MotionTorque(motion="spam", kind=None, friction=friction), "motion_torques")[0]["torque"]
             for friction in ("none", "as printed")]
    assert found[0] < ZERO and found[1] > BROKEN


def test_a_force_around_the_middle_is_all_torque():
    x = lattice((4, 4)).x
    assert relative(x, x[:, ::-1]*[-1, 1]) == pytest.approx(1, rel=1e-15)
    assert isinstance(disc(1), Points) and np.hypot(*disc(1).x.T).max() < 6
