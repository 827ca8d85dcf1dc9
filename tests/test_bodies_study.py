"""The study bodies: published drags against a collocation, a small rebuild, what the committed tables must say."""
import math
from dataclasses import replace

import numpy as np
import pytest

import studies.conservation.bodies.cases as bodies
from continuum.published import published
from particles.integral.points import lattice
from studies.conservation.bodies import derive as bodies_derive
from studies.conservation.bodies import tables as bodies_tables
from studies.conservation.bodies.drag import VARIANTS, CylinderDrag, radius_of, series
from studies.conservation.bodies.shear import TurningWave
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import read

# --- published drags ----------------------------------------------------------------------------------------------------------


def radial(n, r, scale):
    """(psi, psi', omega, omega') of the four radial solutions r^p, r ln r of the biharmonic equation with sin(n angle)."""
    powers = (1, -1, 3) if n == 1 else (n, -n, n + 2, 2 - n)
    found = [((r/scale)**p*np.array([1 + 0*r, p/r, (p*p - n*n)/r**2, (p*p - n*n)*(p - 2)/r**3])) for p in powers]
    if n == 1:
        log = np.log(r/scale)
        found.append(np.array([r*log, log + 1, 2/r, -2/r**2]))
    return np.array(found)


def no_slip(n, R, scale):
    """The two combinations (2, 4) of them with psi = psi' = 0 on the cylinder."""
    free, bound = ((2, 3), (0, 1)) if n == 1 else ((0, 2), (1, 3))
    edge = radial(n, np.array(R), scale)[:, :2].T
    found = np.zeros((2, 4))
    for row, j in zip(found, free, strict=True):
        row[j] = 1
        row[list(bound)] = np.linalg.solve(edge[:, bound], -edge[:, j])
    return found


def collocated_drag(c, terms=16, places=64):
    """F/(mu U) of slow flow past a square array: psi by least squares on the boundary of a quarter of the cell of size 1.

    On x = 1/2 by symmetry psi_x = omega_x = 0, on y = 1/2 psi = U/2 and omega = 0; F = 4 pi mu times the factor of r ln r.
    """
    R, scale, along = np.sqrt(c/np.pi), np.sqrt(0.5), (np.arange(places) + 0.5)/places/2

    def columns(x, y):
        r, angle = np.hypot(x, y), np.arctan2(y, x)
        for n in range(1, 2*terms, 2):
            for psi, slope, omega, bend in np.einsum("ab,bcp->acp", no_slip(n, R, scale), radial(n, r, scale)):
                s, k = np.sin(n*angle), n*np.cos(n*angle)*np.sin(angle)/r
                yield psi*s, slope*np.cos(angle)*s - psi*k, omega*s, bend*np.cos(angle)*s - omega*k
    side = np.array(list(columns(0.5 + 0*along, along))).transpose(1, 2, 0)
    top = np.array(list(columns(along, 0.5 + 0*along))).transpose(1, 2, 0)
    A = np.concatenate([side[1], side[3], top[0], top[2]])
    b = np.repeat([0, 0, 0.5, 0], places)
    size = np.abs(A).max(axis=0)
    return 4*np.pi*(np.linalg.lstsq(A/size, b, rcond=None)[0]/size)[1]


@pytest.mark.parametrize("c", [0.05, 0.1, 0.2, 0.3])
def test_published_drags_are_those_of_a_collocation(c):
    known = published(f"cylinders-drag-{c:g}")
    assert collocated_drag(c) == pytest.approx(known.value, abs=known.uncertainty)


def test_the_published_series_is_good_where_it_is_used():
    """Good to what its note says; half a spacing of radius told back from a drag."""
    for c, good in ((0.05, 4e-4), (0.1, 8e-4), (0.2, 0.016), (0.3, 0.13)):
        assert series(c) == pytest.approx(published(f"cylinders-drag-{c:g}").value, rel=good)
    assert radius_of(24.83, 0.1) == pytest.approx(1, abs=1e-12)
    assert radius_of(collocated_drag(0.1*0.95**2), 0.1) == pytest.approx(0.95, abs=1e-3)
    assert math.isnan(radius_of(100.0, 0.3))


# --- study --------------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    out = tmp_path_factory.mktemp("results")
    return bodies.STUDY.run("quick", workers=1, out=out), out


def test_quick_rebuild_writes_every_table(quick):
    found, out = quick
    for table in bodies_tables.ALL:
        assert set(table.columns) <= set(found[table.name].columns)
    assert {path.stem for path in bodies.STUDY.draw(out)} == {"stream", "drag", "sides"}
    assert {row["id"] for row in bodies.STUDY.judge(out)} == {claim.id for claim in bodies.STUDY.claims}


def test_small_sizes_already_tell_surface_from_staircase(quick):
    drag = quick[0]["drag"]
    last = {name: drag[(drag["variant"] == name) & (drag["rows"] == 16)].iloc[0] for name in ("surface", "frozen")}
    assert abs(last["surface"]["error"]) < 0.03                         # second order: 0.2 % at 48 rows is 2 % at 16
    assert last["frozen"]["offset"] < -0.2                              # a staircase inside of the circle
    assert abs(last["surface"]["balance"]) < 1e-3                       # what was not steady


def test_torques_on_both_cylinders_are_the_exact_one(quick):
    torque = quick[0]["torque"]
    assert (torque[["turned", "fixed"]].abs() < 0.015).all(axis=None)       # second order: 0.15 % at 48 rows is 1.4 % at 16
    assert (torque["balance"].abs() < 2e-4).all()


def test_a_sliding_wave_is_of_second_order(quick):
    wave = quick[0]["wave"].sort_values("rows")
    orders = -np.diff(np.log(wave["error"]))/np.diff(np.log(wave["rows"]))
    assert np.all(np.abs(orders - 2) < 0.3)                             # at 12 rows the next order is a fifth of the error
    assert (wave["mass_drift"] < 1e-13).all()


def test_the_turning_wave_solves_its_equation():
    """d omega/dt + rate y d omega/dx = nu lap omega, by differences of the exact velocity in time."""
    case, points, t, dt = TurningWave(rows=32), lattice((32, 32)), 150.0, 0.01
    x, y = points.x.T
    kx = 2*np.pi/32
    ky, eta = kx*(1 - case.rate*t), case.eta*32

    def amplitude(at):
        v, _ = case.wave(points, at)
        phase = kx*x + kx*(1 - case.rate*at)*y
        k2 = kx**2 + (kx*(1 - case.rate*at))**2
        return 2*np.mean(v[:, 1]*np.sin(phase))*k2/kx                   # of the vorticity
    slope = (amplitude(t + dt) - amplitude(t - dt))/(2*dt)
    assert slope == pytest.approx(-eta*(kx**2 + ky**2)*amplitude(t), rel=1e-6)      # dt^2 times rates of 1e-3, over round-off


def test_limits_have_honest_errors():
    """K = 25 (1 + 7/N^2) with 0.05 % of scatter: the interval covers 25 in 95 % of 200 trials, give or take 4 %."""
    rng, rows = np.random.default_rng(0), np.array([24, 28, 32, 36, 40, 48, 56.0])
    found = [bodies_derive.intercept(rows**-2, 25*(1 + 7/rows**2) + rng.normal(0, 0.0125, 7)) for _ in range(200)]
    assert 0.91 < np.mean([abs(value - 25) < err for value, err in found]) <= 0.995


def test_a_case_is_told_from_another_by_its_label():
    labels = [case.label for case in bodies.cases("paper")]
    assert len(set(labels)) == len(labels)
    slow = CylinderDrag(variant=VARIANTS["surface"], fraction=0.1, rows=24)
    assert slow.label in labels and replace(slow, speed=4e-3).label in labels


@pytest.mark.skipif(not (RESULTS/"bodies"/"limits.csv").exists(), reason="no tables are committed yet")
def test_committed_verdicts_follow_from_committed_tables():
    rows = {row["id"]: row["verdict"] for row in judge(bodies.STUDY.claims, load(bodies_tables.ALL, "bodies"), "bodies")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "bodies"]
    assert dict(zip(kept["id"], kept["verdict"], strict=True)) == rows
