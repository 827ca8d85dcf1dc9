"""When a run stops, and what it then knows of the end."""
from types import SimpleNamespace

import numpy as np
import pytest

from continuum.steady import Steady, Time

SCENE = SimpleNamespace(viscous_time=100.0)


def stopped(rule, ke_of_t):
    """Samples until the rule stops, and their last time in units of L^2/nu."""
    ke = [ke_of_t(0.0)]
    while not rule.done(ke):
        ke.append(ke_of_t(len(ke)*rule.interval(SCENE)/SCENE.viscous_time))
    return np.array(ke), (len(ke) - 1)*rule.interval(SCENE)/SCENE.viscous_time


@pytest.mark.parametrize("slow", [0.3, 3.0])
@pytest.mark.parametrize("sound", [0.0, 1e-3])
def test_a_decay_is_followed_to_its_end(slow, sound):
    """Differences of blocks may be thirty times smaller than what is left, and sound may ride on K."""
    rule = Steady(rtol=1e-4)
    ke, t = stopped(rule, lambda t: 1 + np.exp(-t/slow) + sound*np.exp(-5*t)*np.sin(2000*t))
    value, error = rule.estimate(ke)
    assert rule.settled(ke) and rule.fraction(ke) == 1
    assert np.exp(-t/slow) < 2e-4  # the mean of the last block is half a block older than its end
    assert abs(value - 1) < 1e-4 and abs(value - 1) < 2*error + 1e-9
    dies, _ = stopped(Steady(), lambda t: 1e-3*np.exp(-t/slow))
    assert Steady().estimate(dies)[0] == pytest.approx(0, abs=1e-9)


def test_an_oscillation_does_not_count_as_steady():
    rule = Steady(longest=5)
    ke, t = stopped(rule, lambda t: 1 + 0.1*np.sin(2*np.pi*t))
    value, error = rule.estimate(ke)
    assert not rule.settled(ke) and t == pytest.approx(5, rel=0.05)
    assert value == pytest.approx(1, abs=0.05) and error > 0.05  # half a period may be missing of the mean


def test_a_given_time():
    ke, t = stopped(Time(50.0, samples=10), lambda t: t)
    assert len(ke) == 11 and t == pytest.approx(0.5, rel=1e-12)
    assert Time(50.0, samples=10).fraction(ke) == 1 and not Time(50.0).settled(ke)
    assert Time(50.0, samples=10).estimate(ke) == (pytest.approx(0.5), pytest.approx(0.05))


@pytest.mark.parametrize("make, words", [(lambda: Time(0.0), "t_end"), (lambda: Steady(rtol=0.0), "rtol")])
def test_bad_rules_are_refused(make, words):
    with pytest.raises(ValueError, match=words):
        make()
