"""Boxes of the Boussinesq solver that tests run over, a state of them at random, growth rates."""
import numpy as np
import pytest
from scipy.sparse.linalg import eigs

from continuum.boussinesq import HALF_LAYER, BoussinesqCase, Box, BoxEdges, End, State
from continuum.boussinesq.newton import InStreamfunction
from continuum.boussinesq.projection import Projection
from studies.cavity.cases import CAVITY

INSULATED = BoxEdges(flow=End.WALL, heat=End.MIRROR)
FREE_HALF = Box(width=1.3, plates=BoxEdges(flow=End.MIRROR, heat=End.WALL, low=0.5, high=-0.5))
SQUARE = Box(sides=INSULATED)
CONDUCTING_SQUARE = Box(sides=BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=0.5, ramp=-1.0))
BOXES = {"half layer": HALF_LAYER, "free plates": FREE_HALF, "square": SQUARE,
         "conducting": CONDUCTING_SQUARE, "cavity": CAVITY}
every_box = pytest.mark.parametrize("box", BOXES.values(), ids=BOXES)


def marched(case: BoussinesqCase, q: np.ndarray, time: float, steps: int) -> np.ndarray:
    """The state after so many equal steps."""
    flow = Projection(case, q)
    for _ in range(steps):
        flow.advance(time/steps)
    return flow.q


def random_state(case: BoussinesqCase) -> State:
    """Noise without divergence, of size 1."""
    mac, rng = case.mac, np.random.default_rng(7)
    psi = rng.standard_normal(mac.curl.shape[1])*mac.x.h
    return State(case=case, q=np.r_[mac.curl@psi, rng.standard_normal(case.rows*case.columns)])


def growth_rates(state: State, count: int = 4) -> np.ndarray:
    """The growth rates (complex, fastest first) of disturbances of a steady state; below zero it is stable.

    Only disturbances with the symmetry of the box count; nothing in free fall grows faster than 1.
    """
    equations = InStreamfunction(state.case)
    slope, inertia = equations.jacobian(state.q).tocsc(), equations.inertia.tocsc()
    first = np.sin(1.0 + np.arange(slope.shape[0]))     # any will do, but the same each time
    found = eigs(slope, count, inertia, sigma=0.2, v0=first, return_eigenvectors=False)
    return found[np.argsort(-found.real)]
