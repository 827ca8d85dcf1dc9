"""Flows past held points and between sliding sides: drag, a wave, each beside its exact value."""

import numpy as np
from scenes import rows_of

from studies.conservation.slow_flows import CylinderDrag, TurningWave, frozen, surface


def test_points_on_the_surface_have_the_drag_and_a_staircase_has_less():
    drags = (CylinderDrag(variant=body, fraction=0.1, rows=16) for body in (surface, frozen))
    smooth, staircase = (rows_of(drag, "drag")[0]["error"] for drag in drags)
    assert abs(smooth) < 0.03       # second order: 0.2 % at 48 rows is 2 % at 16
    assert staircase < -0.05        # inside of the circle


def test_a_sliding_wave_is_of_second_order():
    errors = [rows_of(TurningWave(rows=rows), "wave")[0]["error"] for rows in (12, 16, 24)]
    orders = -np.diff(np.log(errors))/np.diff(np.log([12, 16, 24]))
    assert np.all(np.abs(orders - 2) < 0.3)     # at 12 rows the next order is a fifth of the error
