"""What walls make of particles: images, statics, reflections, fixed rows, heat."""
from typing import NamedTuple

import numpy as np
import plain
import pytest
from crowd import crowd, lattice, prepare, rates

from continuum.fluid import ConstEta, IdealGas
from particles.observe import PlateHeat
from particles.run import Plan, run
from particles.smooth.spam import LessStatic, Spam
from particles.smooth.sums import Direct, Nested
from particles.walls import confine, image_motion
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import AtWall, Mirror, Odd, plates, sides, velocity_and_temperature
from particles.walls.periodic import periodic
from particles.weights import Lucy
from studies.build.spam import VARIANTS
from tests.scenes import small

BOX = (10.0, 10.0)
HOT, COLD, SLOPE = 1.2, 0.8, -0.04
G = -SLOPE  # gravity of the ideal gas that balances the profile at constant density
ETA = ConstEta(0.4, 0.3)
PERIODIC = periodic(BOX[0])


def spam(walls, **other) -> Spam:
    return Spam(**{"weight": Lucy.of(h=3.0), "eos": IdealGas(), "law": ETA, "walls": walls, "box": BOX,
                   "g": G, **other})


def four(rule=Odd(), own_pressure=False):  # noqa: B008
    return sides(BOX[0], 1.0, SLOPE, rule, own_pressure) + plates(BOX[1], HOT, COLD, rule, own_pressure)


def wall_T(y):
    """Temperature of plates and sides: linear in y."""
    return 1.0 + SLOPE*y


# --- statics -----------------------------------------------------------------------------------------------


def lattice_moments(weight):
    """Density of the unit lattice and -(m/rho) sum y dw/dy, 1 in the continuum."""
    x, y = (q.ravel() for q in np.meshgrid(np.arange(-3, 4), np.arange(-3, 4)))
    r = np.hypot(x, y)
    w, slope = plain.PRINTED[type(weight)](np.minimum(r, weight.h), weight.h)
    return w.sum(), -np.sum(y**2*slope/np.maximum(r, 1))/w.sum()


RHO, MOMENT = lattice_moments(Lucy.of(h=3.0))


def layer(fraction, rule=Odd(), own_pressure=True, **other):  # noqa: B008
    """Particles less a part of their static pressure, on a lattice at rest with the conduction profile."""
    walls = PERIODIC + plates(BOX[1], HOT, COLD, rule, own_pressure)
    r = lattice(BOX, 10, 10)
    return (spam(walls, static=LessStatic(fraction, RHO, RHO), **other),
            np.array([*r, *np.zeros((2, 100)), 1.0 + SLOPE*r[1]]))


@pytest.mark.parametrize("transport", [Nested, Direct])
@pytest.mark.parametrize("own_pressure", [False, True])
@pytest.mark.parametrize("rule", [AtWall(), Odd()])
def test_without_static_pressure_the_conduction_state_rests(rule, own_pressure, transport):
    # all that is left of the pressure is round-off; odd images continue the linear profile, so that nothing
    # is heated
    out = rates(*layer(1.0, rule, own_pressure, transport=transport))
    if not own_pressure or isinstance(rule, Odd):
        assert abs(out[:4]).max() < 1e-14
    if isinstance(rule, Odd):
        assert abs(out[4]).max() < 1e-14
    else:
        assert abs(out[4]).max() > 1e-4  # images at the wall's temperature flatten the profile at the plates


@pytest.mark.parametrize("fraction", [0.0, 0.3, 0.7])
def test_static_pressure_pushes_by_the_error_of_the_lattice_only(fraction):
    # the printed sum gives -dP/dy/rho times the lattice moment; at odd images with their own pressure also
    # at plates
    out = rates(*layer(fraction))
    assert out[3] == pytest.approx((1 - fraction)*G*(MOMENT - 1), abs=1e-14)
    assert 1e-4 < abs(MOMENT - 1) < 0.02
    assert abs(out[2]).max() < 1e-14


def test_rest_stays_rest():
    # t = 100 is fifty sound crossings of the range: round-off feeds a mode that grows all the time
    method, start = layer(1.0)
    end = run(method, start, Plan(dt=0.5, steps=200)).by_id()
    assert abs(end - start).max() < 1e-10


@pytest.mark.parametrize("walls", [four(), fixed_plates(10.0, HOT, COLD)], ids=["mirrors", "fixed rows"])
def test_reflection_is_elastic(walls):
    state = crowd(BOX, 10, 10, jitter=3.0)
    state[:2, :4] = [[-5.5, 5.25, 0, 1], [0, 1, 5.75, -6]]
    before = state.copy()
    count = sum(confine(wall, state) for wall in walls)
    axes = sorted({getattr(wall, "axis", 1) for wall in walls})
    assert (abs(state[axes]) <= 5).all()
    assert count == sum(int((abs(before[a]) > 5).sum()) for a in axes) > 0
    assert (state[2]**2 == before[2]**2).all() and (state[3]**2 == before[3]**2).all()
    for a in axes:  # as far inside as it had been outside, and moving inwards if it had been moving outwards
        out = abs(before[a]) > 5
        assert abs(state[a, out]) == pytest.approx(10 - abs(before[a, out]), rel=1e-14)
        assert (state[2 + a, out] == -before[2 + a, out]).all()
        assert (state[a, ~out] == before[a, ~out]).all() and (state[2 + a, ~out] == before[2 + a, ~out]).all()
    assert (state[4] == before[4]).all()


@pytest.mark.parametrize("walls", [
    four(AtWall()), four(Odd(), True), PERIODIC + fixed_plates(10.0, HOT, COLD)],
    ids=["at wall", "odd", "rows"])
def test_nothing_leaks(walls):
    # thrown at the walls at the speed of sound; much faster ones fly apart and cool to e < 0, as printed
    start = crowd(BOX, 10, 10)
    start[2:4] *= 4
    done = run(spam(walls), start, Plan(dt=0.1, steps=200))
    assert done.reflections > 20
    assert (abs(done.state[1]) <= 5).all()
    assert (abs(done.state[0]) <= 5.01 + 3*(walls[0] == PERIODIC[0])).all()


def test_fixed_rows_fit_a_period_that_is_no_multiple_of_their_spacing():
    sums, *_ = prepare(spam(periodic(10.3) + fixed_plates(10.0, HOT, COLD), box=(10.3, 10.0)),
                       crowd((10.3, 10.0), 10, 10))
    row = np.sort(sums.around.x[100:110])
    assert np.diff(np.append(row, row[0] + 10.3)) == pytest.approx(1.03, rel=1e-12)


def test_fixed_rows_need_a_positive_temperature():
    with pytest.raises(ValueError,
                       match=r"last of 6 fixed rows would have T = -0\.05.* take a higher box or closer"):
        fixed_plates(10.0, 1.5, 0.5)


class Slippery(NamedTuple):
    """A rule that tells along from across."""


velocity_and_temperature.of(Slippery)(lambda rule, wall_T, along, across, T: (0.2*along, -across, T))


@pytest.mark.parametrize("axis", [0, 1])
def test_rules_see_velocities_along_and_across_whatever_the_side(axis):
    plate = Mirror(axis, 0.0, 1.0, 1.0, 0.0, Slippery())
    moved = image_motion(plate, 0.5, 0.5, 0.3, 0.7, 1.0)
    assert moved == pytest.approx((0.06, -0.7, 1.0) if axis == 1 else (-0.3, 0.14, 1.0))


@pytest.mark.parametrize("name", ["printed", "printed-fixed-rows", "walls-odd-own-pressure", "direct"])
def test_plates_give_all_the_energy_that_the_fluid_gains(name):
    """Particles conserve energy among themselves: what they gain, m g y included, comes through plates."""
    method, state = small(VARIANTS[name], rows=12)
    sums, state, _ = prepare(method, state)
    out = np.empty_like(state)
    sums.rates(state, out)
    gained = state[2]*out[2] + state[3]*out[3] + out[4] + method.g*out[1]
    sums.densities(state)
    sums.gradients()
    lower, upper = (PlateHeat(side, pressure=True)(sums, state)*method.box[0] for side in (-1, 1))
    assert min(abs(lower), abs(upper)) > 1e-3*np.abs(gained).sum()
    # 288 energies and some 300 pairs a plate, summed in another order
    assert lower + upper == pytest.approx(gained.sum(), abs=1e-13*np.abs(gained).sum())
