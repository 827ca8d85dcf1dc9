"""Bodies in the study conservation: published drags against a collocation, drag, torque, a wave that the shear turns."""
import numpy as np
import pytest

from continuum.exact.cylinder import series
from continuum.published import published
from studies.build.cylinder import VARIANTS
from studies.conservation.slow_flows import CylinderDrag, TurningCylinder, TurningWave, sliding

# --- published drags ----------------------------------------------------------------------------


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
    """Good to what its note says."""
    for c, good in ((0.05, 4e-4), (0.1, 8e-4), (0.2, 0.016), (0.3, 0.13)):
        assert series(c) == pytest.approx(published(f"cylinders-drag-{c:g}").value, rel=good)


# --- runs ---------------------------------------------------------------------------------------


def row(case, table):
    return case.run(lambda done: None, None).rows[table][0]


def test_points_on_the_surface_have_the_drag_and_a_staircase_has_less():
    surface, frozen = (row(CylinderDrag(variant=VARIANTS[name], fraction=0.1, rows=16), "drag")["error"]
                       for name in ("surface", "frozen"))
    assert abs(surface) < 0.03      # second order: 0.2 % at 48 rows is 2 % at 16
    assert frozen < -0.05           # a staircase inside of the circle


@pytest.mark.parametrize("rows", [16, 20])
def test_torques_on_both_cylinders_are_the_exact_one(rows):
    torque = row(TurningCylinder(rows=rows), "torque")
    assert max(abs(torque["turned"]), abs(torque["fixed"])) < 0.015     # second order: 0.15 % at 48 rows is 1.4 % at 16


def test_a_sliding_wave_is_of_second_order():
    errors = [row(TurningWave(rows=rows), "wave")["error"] for rows in (12, 16, 24)]
    orders = -np.diff(np.log(errors))/np.diff(np.log([12, 16, 24]))
    assert np.all(np.abs(orders - 2) < 0.3)     # at 12 rows the next order is a fifth of the error


def test_the_turning_wave_solves_its_equation():
    """d omega/dt + rate y d omega/dx = nu lap omega, by differences of the exact velocity in time."""
    case, t, dt = TurningWave(rows=32), 150.0, 0.01
    method = sliding(32, case.eta*32)
    (x, y), kx = method.points.x.T, 2*np.pi/32

    def amplitude(at):
        """Of the vorticity."""
        v, _ = case.wave(method, at)
        ky = kx*(1 - method.rate*at)
        return 2*np.mean(v[:, 1]*np.sin(kx*x + ky*y))*(kx**2 + ky**2)/kx
    slope, ky = (amplitude(t + dt) - amplitude(t - dt))/(2*dt), kx*(1 - method.rate*t)
    damped = -case.eta*32*(kx**2 + ky**2)*amplitude(t)
    assert slope == pytest.approx(damped, rel=1e-6)     # dt^2 times 1e-3, over round-off
