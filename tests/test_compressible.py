"""The compressible grid: its twin, rest, exact motions, stable steps, refusals, convection."""
from dataclasses import replace

import numpy as np
import pytest
from plain_grid import State, step

from continuum import fluid
from continuum.gas.fields import NodeFields, block, initial, interpolate, onto
from continuum.gas.ghosts import RHO, EdgeHeat, FluxForm, PaperForm
from continuum.gas.solve import DivergedError, March, run, steady_on, step_limit
from continuum.scene import RayleighBenard, Walls
from continuum.steady import Time

every_eos = pytest.mark.parametrize("eos", fluid.EQUATIONS_OF_STATE.values(), ids=fluid.EQUATIONS_OF_STATE)
GAS = RayleighBenard(ra=5000)


def quiet(eta, eos=fluid.IdealGas(), **options):  # noqa: B008
    """A scene of viscosity eta without a temperature difference to speak of, hence without gravity."""
    scene = RayleighBenard(ra=1.0, eos=eos, T_hot=1 + 5e-10, T_cold=1 - 5e-10, **options)
    return replace(scene, ra=(scene.nu/eta)**2)


def moving(scene, rows, vx=0.0, vy=0.0) -> NodeFields:
    """The motionless state with velocities given at nodes."""
    still = initial(scene, rows, ke=0.0)
    zero = np.zeros_like(still.at.vx)
    return replace(still, at=still.at._replace(vx=zero + vx, vy=zero + vy))


@pytest.mark.parametrize(("scene", "form"), [
    (GAS, PaperForm()),
    (RayleighBenard(ra=5000, eos=fluid.VanDerWaals(), transport=fluid.ConstEta), FluxForm()),
    (RayleighBenard(ra=5000, sides=Walls(), aspect=1.5), FluxForm()),
    (GAS, EdgeHeat()),
    (RayleighBenard(ra=5000, sides=Walls(), eos=fluid.DenseFluid(), transport=fluid.ConstNu), PaperForm()),
], ids=["gas", "van der Waals", "box", "heated along edges", "dense box"])
def test_the_loop_equals_its_plain_twin(scene, form):
    start, dt = rough(scene, 8), 0.2
    fast = run(scene, 8, until=Time(3*dt, samples=1), dt=dt, start=start, continuity=form)
    plain = State(*start.at[:3], start.cells)
    for _ in range(fast.steps):
        plain = step(scene, form, plain, fast.dt)
    for a, b in zip((*fast.fields.at[:3], fast.fields.cells), plain):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-12)  # sums of numbers of order 1 in another order


def rough(scene, rows) -> NodeFields:
    """Rolls with a per cent of noise in every field that is free."""
    still, noise = initial(scene, rows), np.random.default_rng(1).normal(scale=0.01, size=(4, rows + 1, 99))
    inside = np.zeros_like(still.at.e)
    inside[1:-1, 1:-1] = 1  # leaves the seam of periodic sides alone too
    more = [inside*n[:, :inside.shape[1]] for n in noise]
    at = still.at._replace(vx=still.at.vx + more[0], vy=still.at.vy + more[1], e=still.at.e + more[2])
    return replace(still, at=at, cells=still.cells + more[3][:-1, :-1])


@every_eos
def test_the_motionless_state_stays(eos):
    scene = RayleighBenard(ra=5000, eos=eos)
    end = run(scene, 12, start=initial(scene, 12, ke=0.0), until=Time(100.0, samples=4))
    # round-off of the pressure, 1e-15, pushes with 1e-16 per unit of time
    assert np.abs(end.fields.at.vx).max() < 1e-12 and np.abs(end.fields.at.vy).max() < 1e-12
    np.testing.assert_allclose(end.fields.cells, 1, rtol=0, atol=1e-12)
    still = fluid.energy(eos, 1.0, scene.T(end.fields.y[:, None]))*np.ones_like(end.fields.at.e)
    np.testing.assert_allclose(end.fields.at.e, still, atol=1e-11)
    slope = 1.05 if isinstance(eos, fluid.DenseFluid) else 1.0        # its T(rho, e) is 5 % off as printed
    assert end.nusselt.bottom == pytest.approx(slope, rel=1e-10) and end.rolls == 0


@pytest.mark.parametrize("rows", [8, 16, 32])
def test_shear_decays_at_the_rate_of_the_grid(rows):
    """v_x = sin(pi s) decays with 4 nu/h^2 sin^2(pi h/2L), which is nu pi^2/L^2 to second order."""
    scene = quiet(0.5, aspect=0.5)
    s = np.linspace(0, 1, rows + 1)[:, None]
    end = run(scene, rows, start=moving(scene, rows, vx=1e-6*np.sin(np.pi*s)),
              until=Time(0.1*scene.viscous_time))
    rate = -np.log(end.series.ke[-1]/end.series.ke[0])/(2*end.t)
    h = scene.L/rows
    # heating is of order v^2 = 1e-12; what remains is the difference of temperatures, 1e-9, and round-off
    assert rate == pytest.approx(4*scene.nu/h**2*np.sin(np.pi*h/(2*scene.L))**2, rel=1e-7)
    assert rate == pytest.approx(scene.nu*(np.pi/scene.L)**2, rel=1.01*np.pi**2/12/rows**2)


@every_eos
def test_sound_swings_at_the_frequency_of_the_grid(eos):
    """omega^2 = (2/h sin kh/2)^2 (P_rho + P P_e/rho^2 cos^2 kh/2), before walls are heard."""
    scene, rows = quiet(1e-6, eos=eos, aspect=0.5), 32
    x = initial(scene, rows).x
    k, e = 2*np.pi/scene.width, fluid.energy(eos, 1.0, 1.0)
    start = moving(scene, rows, vx=1e-6*np.sin(k*x))
    start.at.vx[[0, -1]] = 0
    c = fluid.sound_speed(eos, 1.0, e)
    end = run(scene, rows, start=start, until=Time(0.25*scene.width/c, samples=20), dt=0.05/c)
    pattern = np.sin(k*x[:-1])
    swing = 2e6*np.mean(pattern*end.fields.at.vx[rows//2, :-1])
    by_rho, by_e = fluid.pressure_slopes(eos, 1.0, e)
    half = k*scene.L/rows/2
    omega = k*np.sin(half)/half*np.sqrt(by_rho + fluid.pressure(eos, 1.0, e)*by_e*np.cos(half)**2)
    # amplitude 1e-6 makes the square terms 1e-6; the error of the fourth order step is 1e-7
    assert np.arccos(swing)/end.t == pytest.approx(omega, rel=1e-5)
    assert omega == pytest.approx(c*k, rel=half**2)


def test_grids_starts_and_steps_that_cannot_be_are_refused():
    limit = step_limit(GAS, filled(block(initial(GAS, 16))))
    cold = initial(GAS, 16)
    cold.at.e[4, 4] = -1
    for given, words in (({"rows": 6}, "at least 8, got 6"), ({"dt": 0.0}, "positive"),
                         ({"start": cold}, "e = -1"),
                         ({"scene": replace(GAS, aspect=2.03)}, "whole number"),
                         ({"dt": 1.01*limit}, f"stability limit {limit:.4g}: lower")):
        with pytest.raises(ValueError, match=words):
            run(**{"scene": GAS, "rows": 16, **given})


def filled(S):
    """With the ghosts of periodic sides."""
    S[:, :, 0], S[:, :, -1] = S[:, :, -2], S[:, :, 1]
    return S


@pytest.mark.parametrize("eta", [1e-6, 0.3, 30.0])
def test_the_limit_of_the_step_is_safe_and_near(eta):
    """A noisy fluid without gravity comes to rest at the limit and diverges at 1.3 times the limit."""
    scene = quiet(eta, aspect=2.0)
    still, noisy = initial(scene, 8, ke=0.0), rough(scene, 8)
    cells = 1 + 1e-3*(noisy.cells - 1)
    S = block(replace(still, at=still.at._replace(e=1 + 1e-3*(noisy.at.e - 1)), cells=cells))
    limit = step_limit(scene, filled(S))
    march = March(scene, S.copy(), FluxForm(), limit)
    march.go(1000)
    assert np.abs(march.S[RHO, 1:-1, 1:-1] - 1).max() < 2*np.abs(cells - 1).max()
    with pytest.raises(DivergedError):
        March(scene, S, FluxForm(), 1.3*limit).go(1000)


def test_divergence_names_step_time_field_and_node():
    scene = RayleighBenard(ra=1e6)
    with pytest.raises(DivergedError,
                       match=r"step \d+ \(t = .*\): .* node \(\d+, \d+\), x = .*, where v_x = .*rows"):
        run(scene, 8, start=initial(scene, 8, ke=0.5), until=Time(1000.0))


# --- convection on coarse grids ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def grids():
    return steady_on(GAS, (12, 16, 24))


def test_three_nusselt_numbers_of_steady_rolls_agree_to_second_order(grids):
    assert all(s.converged and s.rolls == 2 for s in grids)
    gaps = [abs((s.nusselt.bottom + s.nusselt.top)/2 - s.nusselt.volume) for s in grids]
    # 12 to 24 rows: a factor of 4, a little more from the one-sided gradients' third order
    assert 3.5 < gaps[0]/gaps[-1] < 8 and gaps[-1] < 0.01*grids[-1].nu
    losses = [abs(1 - s.nusselt.top/s.nusselt.bottom) for s in grids]
    assert losses[0]/losses[-1] > 3 and losses[-1] < 0.01


def test_interpolation(grids):
    fine, coarse = grids[-1].fields, grids[0].fields
    for a, b in zip(interpolate(fine, *np.meshgrid(fine.x, fine.y)), fine.at):
        np.testing.assert_allclose(a, b, atol=1e-12)  # splines through the nodes
    there, again = (interpolate(fine, x, 4.4) for x in (3.3, 3.3 - fine.scene.width))
    np.testing.assert_allclose(there, again, rtol=1e-12)
    # two grids differ by 3 times the error of the fine one, 1 % each of v ~ 0.1
    rough, smooth = (interpolate(fields, coarse.x[3] + 1.0, 5.0).vy for fields in (coarse, fine))
    assert rough == pytest.approx(smooth, abs=5e-3)
    with pytest.raises(ValueError, match="y goes from 30 to 30"):
        interpolate(fine, 0.0, 30.0)


def test_a_state_on_another_grid_keeps_its_mass(grids):
    other = onto(replace(GAS, L=10.0), 20, grids[0].fields)
    assert other.cells.mean() == pytest.approx(1, abs=1e-14) and other.at.e.shape == (21, 41)
    same = interpolate(grids[0].fields, *np.meshgrid(other.x*5, other.y*5)).e
    assert np.abs(other.at.e - same).max() < 1e-12
