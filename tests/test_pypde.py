"""The gas in py-pde: rest, rates, steps, steady states, refusals."""
from functools import partial
from itertools import cycle

import numpy as np
import pytest
import sympy
from crowd import jacobian
from pde.solvers import RungeKuttaSolver

from continuum.fluid import (
    EQUATIONS_OF_STATE,
    ConstEta,
    ConstNu,
    IdealGas,
    PowerLaw,
    VanDerWaals,
    conductivity,
    energy,
    pressure,
    stress,
    viscosity,
)
from continuum.gas import solve as compressible
from continuum.pypde.gas import RHO, VX, VY, E, Gas
from continuum.pypde.gas_loop import rate as compiled_rate
from continuum.pypde.solve import StageLoop, onto, solve
from continuum.scene import RayleighBenard, Torus, Walls
from continuum.steady import Steady, Time
from studies.build.scenes import Tile
from studies.kit.fits import richardson

GAS = RayleighBenard(ra=5000, L=1.0)
# every equation of state once, every transport law with one of them: each pair is compiled anew
every_fluid = pytest.mark.parametrize(("eos", "transport"), [*zip(
    EQUATIONS_OF_STATE.values(), cycle([ConstEta, ConstNu, PowerLaw]))], ids=EQUATIONS_OF_STATE)


def rough(gas: Gas, ke=0.01) -> np.ndarray:
    """Rolls with noise on every field."""
    data = gas.rolls(ke)
    return gas.repaired(data + 0.05*np.random.default_rng(1).standard_normal(data.shape))


def rate(gas: Gas, data: np.ndarray) -> np.ndarray:
    return gas.evolution_rate(gas.state(data)).data


@every_fluid
def test_the_motionless_gas_stays_so(eos, transport):
    gas = Gas(RayleighBenard(ra=5000, eos=eos, transport=transport, L=1.0), 8)
    still = rate(gas, gas.rolls(0.0))
    np.testing.assert_allclose(still[[RHO, VX, VY]], 0, atol=1e-12)     # pressures of 1 to 10 over h = 1/8
    # heat stays too where conductivity and temperature's slope are constant: neither by the power law nor in
    # the dense fluid, whose T(rho, e) does not invert its e(rho, T)
    if transport is not PowerLaw:
        np.testing.assert_allclose(still[E], 0, atol=1e-12)


class Uneven(Tile):
    """No plates, whose temperatures would show."""
    T_hot, T_cold = 1.3, 0.8


@pytest.mark.parametrize("scene", [
    *(RayleighBenard(ra=100, L=1.0, eos=eos, transport=law) for eos, law in (
        (IdealGas(), ConstEta), (VanDerWaals(), ConstNu), (IdealGas(), PowerLaw))),
    Uneven(width=2.0, L=1.0, eos=VanDerWaals(), law=ConstEta(0.02, 0.03))],
    ids=["ideal", "van der Waals, const nu", "power law", "torus"])
def test_the_rates_of_the_gas_are_of_second_order(scene):
    waves = 2 if scene.sides == Torus() else 1      # half ones over the height, of equal numbers of cells
    (exact, fields), errors = manufactured(scene, waves), []
    for rows in (16*waves, 32*waves):
        gas = Gas(scene, rows)
        data, wanted = (np.array([f(*gas.mesh(n)) for n, f in enumerate(fs)]) for fs in (fields, exact))
        if waves == 1:
            data[VY, :, -1] = wanted[VY, :, -1] = 0
        errors.append(np.abs(rate(gas, data) - wanted).max(axis=(1, 2)))
    # 1.978 to 1.988 with these grids, 1.993 to 1.998 with twice as fine ones: the term of order h^4
    np.testing.assert_allclose(np.log2(errors[0]/errors[1]), 2, atol=0.04)


def manufactured(scene, waves):
    """(rates, fields) as functions of x, y; no curvature at the plates, so that ghosts are exact there."""
    x, y = axes = sympy.symbols("x y")
    across = waves*sympy.pi*y
    bump = sympy.cos(sympy.pi*x)*sympy.cos(across)
    rho, T = 1 + bump/10, scene.T_mean - scene.dT*y + bump/5
    v = [sympy.Rational(3, 10)*sympy.sin(sympy.pi*x)*sympy.cos(across), bump/4]
    e = energy(scene.eos, rho, T)
    P, eta, k = pressure(scene.eos, rho, e), viscosity(scene.law, rho, T), conductivity(scene.law, rho, T)
    grad = [[sympy.diff(f, a) for f in v] for a in axes]
    sxx, sxy, syy = stress(eta, 0, *grad[0], *grad[1])
    sigma = [[sxx - P, sxy], [sxy, syy - P]]

    def carry(f):
        return sum(w*sympy.diff(f, a) for w, a in zip(v, axes))

    def divergence(f):
        return sum(sympy.diff(w, a) for w, a in zip(f, axes))

    work = sum(sigma[a][b]*grad[a][b] for a in range(2) for b in range(2))
    heat = divergence([k*sympy.diff(T, a) for a in axes])
    rates = [-divergence([rho*f for f in v]), divergence(sigma[0])/rho - carry(v[0]),
             divergence(sigma[1])/rho - carry(v[1]) - scene.g, (work + heat)/rho - carry(e)]
    return tuple([sympy.lambdify(axes, f, "numpy") for f in fs] for fs in (rates, (rho, *v, e)))


def test_the_step_limit_is_stable_and_not_far_below_what_is():
    """Of small disturbances of the motionless state, whose rates are differentiated."""
    gas = Gas(GAS, 8)
    decays = np.linalg.eigvals(jacobian(partial(compiled_rate, gas.loop), gas.rolls(0.0), 1e-5))
    decays = decays[decays.real < 1e-6]         # convection itself grows

    def gain(dt):
        z = decays*dt
        return np.abs(1 + z + z**2/2 + z**3/6 + z**4/24).max()

    assert gain(gas.step_limit()) <= 1 + 1e-5       # differences of the rate are good to 1e-6
    assert gain(2*gas.step_limit()) > 1.1           # it is stable to 1.7 limits


def test_the_stage_loop_steps_like_py_pdes_runge_kutta():
    gas = Gas(GAS, 8)
    start, dt = gas.state(rough(gas)), 0.5*gas.step_limit()
    ends = [gas.solve(start, t_range=5*dt, dt=dt, tracker=None, solver=solver, backend="numpy").data
            for solver in (StageLoop, RungeKuttaSolver)]
    np.testing.assert_allclose(*ends, rtol=0, atol=1e-13)   # sums of numbers of order 1 in another order


SIZES = (12, 16, 20)


@pytest.fixture(scope="module")
def gases() -> list:
    """Solutions on SIZES, each started from the one before."""
    solutions: list = []
    for rows in SIZES:
        start = {"start": solutions[-1]} if solutions else {}
        solutions.append(solve(Gas(GAS, rows), until=Steady(rtol=1e-5), **start))
    return solutions


def test_the_gas_is_that_of_the_other_grid(gases):
    """The limits agree within the sum of their uncertainties; order 2 is seen."""
    both = gases, compressible.steady_on(GAS, SIZES)
    for name in ("ke", "nu"):
        ours, theirs = (richardson([getattr(s, name) for s in solutions], SIZES) for solutions in both)
        assert abs(ours.limit - theirs.limit) < ours.error + theirs.error
        assert ours.error < 0.01*ours.limit
        assert ours.order == pytest.approx(2, abs=0.15)     # 1.89 to 2.07 on grids as coarse as these


def test_a_solution_on_another_grid_keeps_its_energy(gases):
    fine, wide = gases[-1], Gas(GAS, 40)
    # splines go through their points; the sum of v^2 over a grid is good to h^2, 2e-4
    np.testing.assert_allclose(onto(fine.equation, fine), fine.state, atol=1e-12)
    assert wide.measure(onto(wide, fine))[0] == pytest.approx(fine.series.ke[-1], rel=1e-3)


@pytest.mark.parametrize(("make", "message"), [
    (lambda: Gas(GAS, 7), "rows must be at least 8, got 7"),
    (lambda: Gas(RayleighBenard(ra=5000, sides=Walls()), 8), "continuum.gas.solve for walls"),
    (lambda: Gas(GAS, 8).rolls(-1.0), "cannot be negative, got -1"),
    (lambda: solve(Gas(GAS, 8), dt=1.0), "not above the stability limit 0.0"),
    (lambda: solve(Gas(GAS, 8), dt=-1.0), "dt = -1 must be positive"),
    (lambda: solve(Gas(RayleighBenard(ra=5000), 8), start=solve(Gas(GAS, 8), until=Time(0.01, samples=1))),
     "start from rolls or from the same box"),
], ids=["odd", "walls", "negative energy", "step", "negative step", "another box"])
def test_bad_input_is_told(make, message):
    with pytest.raises(ValueError, match=message):
        make()


@pytest.mark.filterwarnings("ignore::RuntimeWarning")    # overflow is what the test makes
def test_divergence_is_told_with_time_and_place():
    gas = Gas(GAS, 8)
    with pytest.raises(compressible.DivergedError, match=r"before t = .* in cell \(.*IdealGas.*smaller dt"):
        solve(gas, start=gas.rolls(1e3))


def test_an_interrupt_is_not_taken_for_an_end():
    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve(Gas(GAS, 8), until=Time(0.1, samples=1), progress=stop)
