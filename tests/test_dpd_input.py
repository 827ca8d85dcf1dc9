"""Bad fluids and steps of dissipative particles."""
import numpy as np
import pytest

from particles.dissipative.dpd import Dpd
from particles.dissipative.pairs3d import Uniform
from particles.run import Plan, run


@pytest.mark.parametrize("wrong, message", [
    ({"kT": -1.0}, "kT must be zero or positive, got -1.0"),
    ({"gamma": -4.5}, "gamma must be zero or positive, got -4.5"),
    ({"a": np.nan}, "a must be zero or positive, got nan"),
    ({"skin": -0.1}, "skin must be zero or positive"),
    ({"box": (10.0, 2.9, 10.0)}, "sides of at least 3"), ({"box": (10.0,)}, "two or three sides"),
    ({"noise": Uniform(-1)}, "the seed must be a whole number")])
def test_bad_fluids(wrong, message):
    with pytest.raises(ValueError, match=message):
        Dpd(**{"box": (4.0, 4.0, 4.0), **wrong})
    with pytest.raises(ValueError, match=r"rho = 0\.001 makes no two particles"):
        Dpd(box=(4.0, 4.0, 4.0)).random_start(1e-3)


def test_a_step_beyond_the_stability_limit():
    method = Dpd(box=(4.0, 4.0, 4.0))
    with pytest.raises(ValueError,
                       match=r"dt = 0\.15 is above the stability limit 0\.138 of these particles"):
        run(method, method.random_start(3.0), Plan(dt=0.15, steps=1))


def test_collapsed_particles_are_an_error():
    method = Dpd(box=(30.0, 30.0, 30.0))
    state = method.random_start(0.1)
    state[:3] *= 1e-3
    with pytest.raises(FloatingPointError,
                       match=r"neighbours within 1\.3 of each particle: they have collapsed"):
        run(method, state, Plan(dt=0.02, steps=1))
