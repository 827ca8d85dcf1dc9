"""The study conservation: what long runs keep; points that move, their equations, speeds, steps."""
import numpy as np
import pytest
from crowd import random_fields, rates
from scenes import rows_of

import studies.conservation.cases as conservation
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from particles.integral.dih import NestedFluxes, Pairwise
from particles.integral.drifts import Powers
from particles.integral.points import jittered, lattice
from particles.integral.rr98_moving import scale_of
from particles.integral.rr98_moving_plain import MOTIONS, ConstantMass, Convective, Literal
from particles.integrators import RK4, Euler, TwoStep
from particles.limits import lattice_sums
from particles.weights import Lucy, WendlandC2
from studies.conservation.drift import MODES
from studies.conservation.motions import MovingSound, march, moving
from studies.conservation.sums import sizes

CARRIED = MOTIONS["carried"]
COUNTS = {1: (14,), 2: (7, 8), 3: (5, 5, 5)}
TRANSPORT = {"nested": NestedFluxes(), "pairwise": Pairwise(mended=False), "mended": Pairwise()}


def made(kind, d=2, size=0.15, weight=WendlandC2, transport="pairwise", eta=0.2, **more):
    at = jittered(COUNTS[d], size, 3)
    weight = weight.of(h=2.7 if d < 3 else 2.2, d=d)
    return moving(kind, at, weight, ConstEta(eta, eta), transport=TRANSPORT[transport], **more), at


def crowd(method, at):
    return method.state(at.x, *random_fields(at.n, at.d))


def seen(weight, points, k):
    """Wave number of discrete gradients over k of a wave along x, and (1/k^2) sum_r w_xx (1 - cos kx)."""
    sums, scale = lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])), scale_of(points, weight)
    return scale*np.abs(sums.S[0, 0])/k, scale*sums.D[0, 0, 0]/k**2


def after(method, state, steps, dt, integrator=RK4):
    state = state.copy()
    march(method, state, dt, steps, lambda state: None, integrator)
    return state


@pytest.mark.parametrize("transport", TRANSPORT)
@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("kind", [Literal, ConstantMass])
def test_mass_momentum_and_energy_stay_while_points_move(kind, d, transport):
    method, at = made(kind, d, transport=transport)
    state = crowd(method, at)
    moved = after(method, state, 5, 0.1)
    assert np.abs(moved[:d] - state[:d]).max() > 0.05
    # 5 steps of 4 stages, some 30 terms each
    assert np.abs(method.conserved(moved) - method.conserved(state)).max() < 1e-14*at.n


def test_volumes_that_go_with_the_flow_give_it_all_back_but_the_error_of_time_steps():
    """rho V is a product of two fields, each good to dt^4: half the step takes the drift down 16 times.

    On equal volumes Eqs 46-48 conserve nothing.
    """
    def lost(kind, n):
        method, at = made(kind)
        state = crowd(method, at)
        return np.abs(method.conserved(after(method, state, n, 1.0/n)) - method.conserved(state))/at.n
    drift = [lost(CARRIED, n).max() for n in (8, 16)]
    assert drift[0] < 1e-4 and np.log2(drift[0]/drift[1]) > 3.5
    assert (lost(Convective, 8) > 1e-6).all()


@pytest.mark.parametrize("transport", ["nested", "pairwise"])
@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("eta", [0.0, 1e-4, 1.0])
def test_equations_46_and_47_are_equation_49(eta, d, transport):
    """m dv/dt = dp/dt - v dm/dt, term by term, at any Reynolds number."""
    found = {}
    for kind in (Convective, CARRIED, ConstantMass):
        method, at = made(kind, d, transport=transport, eta=eta)
        state = crowd(method, at)
        out = rates(method, state)
        found[kind] = (out[d + 1:2*d + 1] - method.velocity(state)*out[d])/state[d]
    for kind in (Convective, CARRIED):
        size = np.abs(found[kind]).max()
        np.testing.assert_allclose(found[kind], found[ConstantMass], rtol=0, atol=1e-13*size)


@pytest.mark.parametrize("bracket", [Powers(), Powers(1.0, -1.0)])
def test_internal_energy_changes_by_pressure_times_the_growth_of_volumes_only(bracket):
    """Without viscosity; for a + b = 0 and one density."""
    method, at = made(ConstantMass, eta=0.0, bracket=bracket)
    rng = np.random.default_rng(1)
    v, T = rng.normal(0, 0.2, (at.n, 2)), rng.uniform(0.9, 1.1, at.n)
    state = method.state(at.x, np.ones(at.n), v, T)
    out = rates(method, state)
    heat = out[5] - (v.T*out[3:5]).sum(axis=0)
    np.testing.assert_allclose(heat, -T*out[6], rtol=0, atol=1e-14)


@pytest.mark.parametrize("motion", MOTIONS)
def test_sound_on_moving_points_goes_at_the_speed_of_lattice_sums(motion):
    """Constant volumes do not give way to the pressure: the square of the gradient adds to the stiffness."""
    [row] = rows_of(MovingSound(motion=motion, wavelength=8), "moving_sound")
    slope, stiffness = seen(Lucy.of(h=3.0), lattice((8, 8)), 2*np.pi/8)
    squared = stiffness + (motion in ("literal", "convective"))*slope**2
    # of the square of the amplitude, 1e-8, over the change of c that resonance of its double can make
    assert row["speed"] == pytest.approx(np.sqrt(squared), rel=1e-3)


def test_two_steps_are_equations_40_and_41():
    method, at = made(Literal)
    state, dt = crowd(method, at), 0.05
    k, moved = rates(method, state), after(method, state, 1, dt, TwoStep)
    fields = state[2:] + dt*k[2:]
    np.testing.assert_allclose(moved[2:], fields, rtol=0, atol=1e-15)
    np.testing.assert_allclose(moved[:2], state[:2] + dt*fields[1:3]/fields[0], rtol=0, atol=1e-15)
    old = after(method, state, 1, dt, Euler)
    np.testing.assert_allclose(old, state + dt*k, rtol=0, atol=1e-15)


def test_what_cannot_be_moved_is_refused():
    at = lattice((7, 7))
    with pytest.raises(ValueError, match="M_1 = "):
        moving(Literal, at, Lucy.of(h=3.0, d=3))
    method = moving(Literal, at, Lucy.of(h=3.0))
    state = method.state(at.x, np.ones(at.n), 0*at.x, np.ones(at.n))
    state[1, 5] = np.nan
    with pytest.raises(FloatingPointError, match=r"point 5 is at .* take a shorter step"):
        rates(method, state)
    state[1, 5], state[2, 6] = 0.3, -1.0
    with pytest.raises(FloatingPointError, match=r"point 6 has rho = -1"):
        rates(method, state)
    twice = at.x.copy()
    twice[7] = twice[8]
    with pytest.raises(ValueError, match="points 7 and 8 overlap"):
        method.state(twice, np.ones(at.n), 0*at.x, np.ones(at.n))


# --- long runs ----------------------------------------------------------------------------------


def test_changes_are_divided_by_mass_momenta_and_energy():
    v, rho = np.array([[3.0, 4.0], [0.0, -1.0]]), np.array([1.0, 2.0])
    fields = Fields(v, v, rho, np.array([1.0, 2.0]), np.array([1.0, 0.5]))
    expected = [2.0, 6.0, 6.0, 1.0 + 12.5 + 2.0 + 0.5]
    assert list(sizes(IdealGas(), fields)) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_compiled_runs_keep_their_sums(mode):
    [columns] = rows_of(conservation.layer("exact", "jittered-0.3", mode, steps=400), "drift")
    assert columns["reached"] == 400 and columns["claimed"] == "mass momentum energy"
    assert 0 < max(columns[name] for name in ("mass", "momentum", "energy")) < 1e-14
