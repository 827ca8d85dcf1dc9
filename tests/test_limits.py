"""The step limit: waves of the linearised scheme against its Jacobian; runs on both sides of it."""
import numpy as np
import pytest
from crowd import advance, everywhere, jacobian, lattice, rates

from continuum.fluid import ConstEta, IdealGas, PowerLaw, VanDerWaals, energy, pressure, sound_speed
from particles.limits import largest_step, lattice_sums, step_limit, waves, zone
from particles.smooth.spam import LessStatic, Spam
from particles.smooth.sums import Direct, Nested
from particles.weights import Lucy, Monaghan, WendlandC2

BOX, SIDE = (8.0, 8.0), 8


def spam(weight, eos=IdealGas(), law=ConstEta(0.3, 0.2), box=BOX, **other) -> Spam:  # noqa: B008
    return Spam(weight=weight, eos=eos, law=law, walls=everywhere(box), box=box, **other)


def still(e) -> np.ndarray:
    r = lattice(BOX, SIDE, SIDE)
    return np.array([*r, *np.zeros((2, SIDE**2)), np.full(SIDE**2, float(e))])


def box_waves(method, e):
    """Eigenvalues of all waves that fit into the box."""
    k = 2*np.pi/BOX[0]*np.array([(i, j) for i in range(SIDE) for j in range(SIDE)])
    return waves(method, lattice_sums(method.weight, 1.0, 1.0, k), e).ravel()


METHODS = [spam(WendlandC2.of(h=3.3)), spam(Lucy.of(h=2.6), VanDerWaals(), PowerLaw(0.3, 0.2)),
           spam(Lucy.of(h=2.6), transport=Direct), spam(Monaghan.of(h=3.1), static=LessStatic(0.6, 1.2))]


@pytest.mark.parametrize("method", METHODS, ids=["nested", "vdw", "direct", "less static"])
def test_waves_are_the_eigenvectors_of_the_scheme(method):
    e = energy(method.eos, 1.0, 1.2)
    exact, J = box_waves(method, e), jacobian(lambda state: rates(method, state), still(e), 1e-5)
    measured = np.linalg.eigvals(J)
    # sums over all modes do not care about order and near-degenerate pairs: traces of the matrix, its square,
    # cube and fourth power. Central differences: 1e-10 by truncation, 1e-11 by round-off, times 320 modes and
    # powers of 2
    for power in (1, 2, 3, 4):
        assert np.sum(measured**power) == pytest.approx(np.sum(exact**power), abs=1e-5)
    assert abs(measured).max() == pytest.approx(abs(exact).max(), abs=1e-5)
    assert abs(exact.real).max() > 0.05 and abs(exact.imag).max() > 1


# gamma = rho c^2 over the isothermal bulk modulus: 2 for the ideal gas, 7/3 for van der Waals at rho = T = 1
@pytest.mark.parametrize("eos, gamma", [(IdealGas(), 2.0), (VanDerWaals(), 7/3)])
@pytest.mark.parametrize("transport", [Nested, Direct])
def test_long_waves_are_sound_shear_and_heat(eos, gamma, transport):
    # without the static pressure, whose spurious elasticity turns slow shear into an elastic wave
    nu, kappa, e = 0.02, 0.03, float(energy(eos, 1.0, 1.0))
    weight = WendlandC2.of(h=6.0)
    rho = lattice_sums(weight, 1.0, 1.0, zone(1.0, 2)).rho
    method = spam(weight, eos, ConstEta(nu, kappa), (16.0, 16.0), transport=transport,
                  static=LessStatic(1.0, pressure(eos, rho, e)))
    for k in (0.2, 0.1, 0.05):
        modes = waves(method, lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])), e)[0]
        modes = modes[np.argsort(abs(modes.imag))]
        # smoothing lowers sound by (k h)^2/28, k^2 of nested sums by (k h)^2/14; the lattice is off by 2e-4
        within = 5e-4 + (k*weight.h)**2/13
        assert abs(modes[3:].imag) == pytest.approx(k*sound_speed(eos, 1.0, e), rel=within/2)
        # heat spreads at constant pressure; nothing holds a transverse displacement
        expected = [-nu*k**2, -kappa*k**2/gamma, 0]
        assert np.sort(modes[:3].real) == pytest.approx(np.sort(expected), abs=within*nu*k**2)


STILL = ConstEta(0.0, 0.0)
# sound alone, viscosity alone (h = 4), both, conduction; on lattices that do not buckle by themselves
RUNS = [(spam(WendlandC2.of(h=4.0), law=STILL), 1.0),
        (spam(WendlandC2.of(h=4.0), law=ConstEta(6.0, 0.5)), 1.0),
        (spam(Lucy.of(h=2.5), law=ConstEta(0.5, 0.5), transport=Direct), 1.5),
        (spam(Lucy.of(h=2.5), VanDerWaals(), ConstEta(0.5, 4.0)), 1.0)]
runs = pytest.mark.parametrize("method, T", RUNS, ids=["sound", "viscosity", "direct", "conduction"])


def growth(method, e, dt):
    """How much faster tiny random motions are after 60 steps than after 15."""
    start = still(e)
    start[2:4] = np.random.default_rng(0).normal(0, 1e-11, (2, SIDE**2))
    early, late = (np.abs(advance(method, start, dt, n)[2:4]).max() for n in (15, 60))
    return late/early


@runs
def test_runs_grow_above_the_limit_and_not_below(method, T):
    e = energy(method.eos, 1.0, T)
    box = largest_step(box_waves(method, e))
    # the box holds 64 of the zone's waves, not the fastest one itself
    assert 0.94*box < step_limit(method, e) <= 1.001*box
    # 3 % above the edge |R| is 1.1 or more: 45 steps give tenfold at least. Below, phases may double what is
    # seen
    assert growth(method, e, 0.98*box) < 2
    assert growth(method, e, 1.03*box) > 10


def test_the_hottest_particle_sets_the_limit():
    method = spam(Lucy.of(h=3.0), law=STILL)
    cold, hot, all_three = (step_limit(method, e) for e in (0.5, 1.5, np.array([0.5, 1.5, 1.0])))
    # all frequencies are proportional to the speed of sound
    assert all_three == hot == pytest.approx(cold/np.sqrt(3), rel=1e-6)


def test_particles_that_do_not_see_each_other_are_refused():
    with pytest.raises(ValueError, match=r"1 apart do not see each other .* h = 0\.9: take a larger"):
        step_limit(spam(Lucy.of(h=0.9)), 1.0)
