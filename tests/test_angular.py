"""Angular momentum: torques of edges are those of points, and which vanish    [RR98 Eqs 35, 37, 49, 51]"""
import numpy as np
import pytest
from scenes import rows_of

from particles.integral.edge_makers import MAKERS, plain
from particles.integral.points import Points, lattice
from particles.integral.rr98_moving_plain import MOTIONS
from particles.weights import Lucy
from studies.build.setting import DISORDERS
from studies.conservation.forces import (
    STILL,
    VISCOUS,
    BesideSpam,
    EdgeTorque,
    MotionTorque,
    exchanges,
    relative,
)
from studies.conservation.sums import random_fields

ZERO, BROKEN = 1e-15, 1e-9     # round-off; what is none, though signs may cancel
LAWFUL = ("pressure, P_i + P_j", "convection, half of each end", "friction, Eq. 37")
ALONG = ("pressure, P_i + P_j", "pressure, Eq. 13", "friction, Eq. 51, B = 0")


def torque(x, f):
    return np.sum(x[:, 0]*f[:, 1] - x[:, 1]*f[:, 0])


def test_torques_of_edges_are_those_of_their_ends():
    x = lattice((6, 6)).x + np.random.default_rng(2).uniform(-0.3, 0.3, (36, 2))
    points = Points(x=x, box=np.array([20.0, 20.0]), V=np.ones(36))
    edges = plain(points, Lucy.of(h=3.0))
    for name, f in exchanges(edges, random_fields(points, 0.1, 2)):
        force = np.stack([np.bincount(edges.j, one, edges.n) - np.bincount(edges.i, one, edges.n)
                          for one in f.T], axis=1)
        assert torque(points.x, force) == pytest.approx(torque(edges.apart, f), abs=1e-11), name


@pytest.mark.parametrize(("maker", "still", "turning"), [
    ("delaunay", (*LAWFUL, "friction, Eq. 51"), "convection, Eq. 35"),
    ("exact", LAWFUL, "convection, Eq. 35"),
    *((maker, ALONG, "friction, Eq. 51") for maker in ("plain", "renormalised", "printed"))])
def test_halves_of_a_symmetric_stress_on_exact_edges_and_forces_along_edges_have_no_torque(maker, still,
                                                                                           turning):
    """On exact edges friction along velocities has none where the Laplacian of places is zero."""
    case = EdgeTorque(maker=MAKERS[maker], points=DISORDERS["jittered-0.3"], seed=4)
    torques = {row["exchange"]: row["torque"] for row in rows_of(case, "torques")}
    assert max(torques[name] for name in still) < ZERO
    assert torques[turning] > BROKEN


@pytest.mark.parametrize("motion", MOTIONS)
def test_motions_keep_angular_momentum_where_masses_stay(motion):
    case = MotionTorque(motion=motion, law=STILL)
    torque = rows_of(case, "motion_torques")[0]["torque"]
    assert torque < ZERO if motion in ("carried", "constant-mass") else torque > BROKEN


def test_smooth_particles_push_along_pairs_and_rub_across():
    found = [rows_of(MotionTorque(motion="spam", law=law), "motion_torques")[0]["torque"]
             for law in (STILL, VISCOUS)]
    assert found[0] < ZERO and found[1] > BROKEN


def test_equation_50_begins_as_smooth_particles_and_leaves_them_as_volumes_do():
    found = [rows_of(BesideSpam(a=1.0, b=-1.0, time=time), "beside")[0] for time in (0.4, 0.8)]
    assert found[0]["start"] < 1e-13 and found[0]["end"] < 1e-3
    # volumes part as t, so accelerations, and velocities as t^2
    assert found[1]["end"]/found[0]["end"] == pytest.approx(4, abs=0.4)
    assert found[1]["volumes"]/found[0]["volumes"] == pytest.approx(2, abs=0.2)
    assert rows_of(BesideSpam(a=2.0, b=0.0, time=0.2), "beside")[0]["start"] > 0.1


def test_a_force_around_the_middle_is_all_torque():
    x = lattice((4, 4)).x
    assert relative(x, x[:, ::-1]*[-1, 1]) == pytest.approx(1, rel=1e-15)
