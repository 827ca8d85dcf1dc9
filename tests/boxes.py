"""Boxes of the Boussinesq solver that tests run over, and growth rates in them."""
import numpy as np
import pytest
from scipy.sparse.linalg import eigs

from continuum.boussinesq import HALF_LAYER, Box, BoxEdges, End, State
from continuum.boussinesq.newton import InStreamfunction
from studies.cavity.cases import CAVITY

INSULATED = BoxEdges(flow=End.WALL, heat=End.MIRROR)
FREE_HALF = Box(width=1.3, plates=BoxEdges(flow=End.MIRROR, heat=End.WALL, low=0.5, high=-0.5))
SQUARE = Box(sides=INSULATED)
CONDUCTING_SQUARE = Box(sides=BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=0.5, ramp=-1.0))
BOXES = {"half layer": HALF_LAYER, "free plates": FREE_HALF, "square": SQUARE,
         "conducting": CONDUCTING_SQUARE, "cavity": CAVITY}
every_box = pytest.mark.parametrize("box", BOXES.values(), ids=BOXES)


def growth_rates(state: State, count: int = 4) -> np.ndarray:
    """Complex growth rates of disturbances that have the symmetry of the box, fastest first."""
    equations = InStreamfunction(state.case)
    slope, inertia = equations.jacobian(state.q).tocsc(), equations.inertia.tocsc()
    first = np.sin(1.0 + np.arange(slope.shape[0]))     # any will do, but the same each time
    rates = eigs(slope, count, inertia, sigma=0.2, v0=first, return_eigenvectors=False)
    return rates[np.argsort(-rates.real)]
