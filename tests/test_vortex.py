"""The Taylor-Green vortex in the continuum: Fourier sums, small Mach numbers; fixed points beside it."""
import numpy as np
import pytest

from continuum.exact.vortex import DECAYS, SOUND, Vortex, derivative, solved, velocities


def rms(v: np.ndarray) -> float:
    return float(np.sqrt((v**2).sum(axis=1).mean()))


def test_fourier_sums_are_derivatives_of_every_wave_that_fits():
    x = 2*np.pi*np.arange(9)/9
    D = derivative(9)
    for m in range(5):
        assert D@np.sin(m*x + 0.3) == pytest.approx(2*np.pi/9*m*np.cos(m*x + 0.3), abs=1e-13)
    assert np.abs(D + D.T).max() < 1e-14


def test_the_gas_becomes_incompressible_as_the_square_of_the_mach_number():
    """Of the first two terms, Mach^2 and Mach^4, the second is a tenth of the first at Mach 0.3."""
    place = np.random.default_rng(1).uniform(-0.5, 0.5, (50, 2))
    slow, fast = (solved(mach, 29) for mach in (0.15, 0.3))
    assert (fast.decay - 1)/(slow.decay - 1) == pytest.approx(4, rel=0.15)
    exact = Vortex(1/SOUND, 1).velocity(place)*np.exp(-DECAYS)       # of speed 1
    errors = [rms(velocities(gas, place) - exact)/rms(exact) for gas in (slow, fast)]
    assert errors[1]/errors[0] == pytest.approx(4, rel=0.15)
    assert errors[0] < 0.3*0.15**2
