"""The spectral method in convection: what n functions along an axis give, against more functions."""
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import SpectralState, steady
from studies.cost.problem import Residuals, Result, relative, rms

FIRST = 8           # functions from whose state that of more starts
#: most functions -> those of their exact answer; four fewer tell its uncertainty
FINER = {12: 20, 28: 32}


class Modes(NamedTuple):
    """The steady gas at a Rayleigh number on n functions along an axis."""
    ra: float
    n: int

    def solve(self) -> SpectralState:
        """From warm streams."""
        laws = GasLaws(RayleighBenard(ra=self.ra))
        few = steady(laws, min(self.n, FIRST))
        return few if self.n == FIRST else steady(laws, self.n, few)

    def judge(self, state: SpectralState) -> Result:
        """Against more functions."""
        more = next(finer for most, finer in FINER.items() if self.n <= most)
        exact, fewer = (solved(self.ra, n) for n in (more, more - 4))
        uncertain = {name: rms(residual) for name, residual in apart(fewer, exact).items()}
        return Result(apart(state, exact), uncertain)


@cache
def solved(ra: float, n: int) -> SpectralState:
    """Once in a process."""
    return Modes(ra, n).solve()


def apart(state: SpectralState, exact: SpectralState) -> Residuals:
    """K, velocity and temperature, at the points of the finer of two states; as in `rolls`."""
    equations, n = exact.equations, state.equations.n
    every = np.zeros((4, equations.n, equations.n))
    every[:, :n, :n] = state.equations.amplitudes(state.q)
    here, there = equations.at(every[equations.kept])[:, 0], exact.at[:, 0]
    scene, weigh = equations.laws.scene, partial(relative, equations.weights.ravel())
    warm = there[3] + scene.T(scene.L*equations.y.points) - 1
    v, exact_v = (np.reshape(at[:2], (2, -1)).T for at in (here, there))
    return {"K": np.array([state.K/exact.K - 1]), "velocity": weigh(v - exact_v, exact_v),
            "temperature": weigh((here[3] - there[3]).ravel(), warm.ravel())}


def in_modes(flow: Any, method: None, n: int, seed: int) -> Modes:
    """As an entry makes it."""
    return Modes(flow.ra, n)
