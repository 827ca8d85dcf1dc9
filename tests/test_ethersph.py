"""EtherSPH's scheme, made again: its weight, what its pairs keep, what its walls do, bad input."""
import numpy as np
import pytest
from scipy.integrate import quad

from bench.ethersph import COLD, FLUID, HOT, numbers, placed, rate, run, slope, value
from particles.neighbours import make_lists, sort_into_cells
from particles.threads import Threads


def test_the_weight_has_unit_moment_and_its_slope():
    assert quad(lambda r: 2*np.pi*r*value(r, 0.3), 0, 0.3)[0] == pytest.approx(1)
    assert (value(0.1001, 0.3) - value(0.0999, 0.3))/2e-4 == pytest.approx(slope(0.1, 0.3), rel=1e-5)


def test_pairs_keep_momentum_and_the_fluid_gets_the_heat_that_walls_give():
    """Of a shaken fluid far from walls, or with walls at rest and of uneven temperature."""
    by, (x, kind, normal), random = numbers(1e4, 12, 0.5), placed(12), np.random.default_rng(1)
    n = int((kind == FLUID).sum())
    x[:n] += random.uniform(-0.2, 0.2, (n, 2))*by.a
    v, rho = 0.1*random.normal(size=x.shape), 1 + 0.01*random.normal(size=len(x))
    T = random.normal(size=len(x))
    v[n:] = 0
    dv, dT, heat = np.zeros((n, 2)), np.zeros(n), np.zeros(4)
    for fluid in (n, len(x)):
        across, up = x[:fluid].T.copy()
        lists = make_lists(Threads(1), sort_into_cells(across, up, by.reach), across, up, by.reach, 0)
        rate(n, lists, x, v, rho, T, kind, normal, by, dv, dT, heat)
        if fluid == n:
            lifted = by.lift*(T[:n] - 0.5).sum()
            assert dv.sum(axis=0) == pytest.approx([0, lifted], abs=1e-9*np.abs(dv).sum())
        assert dT.sum()*by.a**2/by.alpha == pytest.approx(heat[HOT] + heat[COLD], abs=1e-9)


def test_another_ra_is_refused():
    with pytest.raises(ValueError, match=r"one of 1000, 10000, 100000, 1e\+06, got 2000: the code has no"):
        run(2e3, 12, 1.0)
