"""Boxes of the Boussinesq solver that tests run over, and a state of them at random."""
import numpy as np
import pytest

from continuum.boussinesq import (
    CAVITY,
    CONDUCTING_SQUARE,
    HALF_LAYER,
    SQUARE,
    BoussinesqCase,
    Box,
    State,
)
from continuum.boussinesq.mac import FREE_PLATES
from continuum.boussinesq.projection import Projection

FREE_HALF = Box(width=1.3, plates=FREE_PLATES)
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
