"""The spectral method: its slopes, how fast it converges, onset, bad input; claims hold grids against it."""
from functools import partial

import numpy as np
import pytest

from continuum.fluid import ConstNu, VanDerWaals
from continuum.linear import critical, critical_ra
from continuum.scene import RayleighBenard
from continuum.spectral.laws import BoussinesqLaws, GasLaws
from continuum.spectral.newton import Galerkin, onset, steady

OTHER = RayleighBenard(ra=5e3, eos=VanDerWaals(), transport=ConstNu)
LAWS = {"gas": GasLaws(RayleighBenard(ra=5e3)), "other gas": GasLaws(OTHER),
        "boussinesq": BoussinesqLaws(5e3, 0.71)}


@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS)
def test_slopes_are_those_of_the_rates(laws):
    """Of a random state; central differences err by step^2 and round-off/step."""
    equations, random = Galerkin(laws, 5), np.random.default_rng(1)
    q, along = 0.01*random.normal(size=(2, equations.kept.sum()))
    change = (equations.rates(q - 1e-3*along) - equations.rates(q + 1e-3*along))/2e-3
    assert equations.slopes(q)@along == pytest.approx(change, abs=1e-9)


@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS)
def test_errors_fall_exponentially(laws):
    """Tenfold at least with every four functions; second order would leave 0.44 and 0.56."""
    states = [steady(laws, 8)]
    for n in (12, 16, 20):
        states.append(steady(laws, n, states[-1]))
    for name in ("K", "Nu"):
        errors = np.abs([getattr(one, name) - getattr(states[-1], name) for one in states[:-1]])
        assert (errors[1:] < errors[:-1]/10).all() and errors[-1] < 1e-5


def test_onset_has_ten_digits():
    for width, known in ((2.0, critical_ra(np.pi)), (2*np.pi/critical().k, critical().ra)):
        ra = onset(partial(BoussinesqLaws, pr=1.0, width=width), 12, 1500.0, 2000.0)
        assert ra == pytest.approx(known, rel=1e-10)
    assert steady(BoussinesqLaws(1700.0, 1.0), 8).K < 1e-15 < steady(BoussinesqLaws(1720.0, 1.0), 8).K


def test_too_many_functions_are_refused_with_a_way_out():
    with pytest.raises(ValueError, match="takes 4 to 48 functions along an axis, got 100: 24 do for eight"):
        steady(LAWS["gas"], 100)
