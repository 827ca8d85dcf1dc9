"""Boxes of the Boussinesq solver that tests run over, and a state of them at random."""
import numpy as np
import pytest

from continuum.boussinesq import (
    CAVITY,
    CONDUCTING_SQUARE,
    FREE_PLATES,
    HALF_LAYER,
    LAYER,
    SQUARE,
    BoussinesqCase,
    Box,
    State,
)

FREE_HALF = Box(width=1.3, plates=FREE_PLATES)
CLOSED = {"half layer": HALF_LAYER, "free plates": FREE_HALF, "square": SQUARE,
          "conducting": CONDUCTING_SQUARE,
          "cavity": CAVITY}
BOXES = {**CLOSED, "layer": LAYER}
every_box = pytest.mark.parametrize("box", BOXES.values(), ids=BOXES)
every_closed_box = pytest.mark.parametrize("box", CLOSED.values(), ids=CLOSED)


def random_state(case: BoussinesqCase) -> State:
    """Noise without divergence, of size 1."""
    mac, rng = case.mac, np.random.default_rng(7)
    psi = rng.standard_normal(mac.curl.shape[1])*mac.x.h
    return State(case=case, q=np.r_[mac.curl@psi, rng.standard_normal(case.rows*case.columns)])
