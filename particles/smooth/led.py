"""Sums of particles that move with v + d, where records have d = (dx, dy)."""
from typing import Any

import numpy as np

from particles.smooth.sums import Direct

MOVED = 0.25        # part of the skin that a particle may use before a step; d uses no more of it in the step


class Led(Direct):
    """Base class of shifted and transported particles; they call `mirror` when d is known."""

    def make_ready(self, now: Any, dt: float) -> None:
        if self.around.anchor is not None and self.around.moved(now.state) > MOVED*self.around.skin:
            self.around.anchor = None
        super().make_ready(now, dt)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        out[:2] = self.velocity(state)

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4] + np.stack([self.records[name][:self.n] for name in ("dx", "dy")])
