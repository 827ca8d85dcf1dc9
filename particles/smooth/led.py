"""Sums of particles that move with v + d, where records have d = (dx, dy)."""
from typing import Any, ClassVar

import numpy as np

from particles.smooth.sums import Direct
from particles.walls import mirrored

MOVED = 0.25        # part of the skin that a particle may use before a step; d uses no more of it in the step


class Led(Direct):
    """Base class of shifted and transported particles. numbers : record type; vectors : mirrored fields."""
    numbers: ClassVar[np.dtype]
    vectors: ClassVar[tuple[tuple[str, str], ...]] = (("dx", "dy"),)

    def make_ready(self, now: Any, dt: float) -> None:
        if self.around.anchor is not None and self.around.moved(now.state) > MOVED*self.around.skin:
            self.around.anchor = None
        super().make_ready(now, dt)

    def allocate(self, points: int) -> None:
        super().allocate(points)
        self.records = np.zeros(points, self.numbers)

    def mirror(self) -> None:
        """Set the vectors of images: mirrors reverse the component across them."""
        for wall, parent, first, last in self.around.blocks:
            for axis, name in ((axis, pair[axis]) for pair in self.vectors for axis in (0, 1)):
                sign = -1.0 if axis == mirrored(wall) else 1.0
                self.records[name][first:last] = sign*self.records[name][parent]

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        out[:2] = self.velocity(state)

    def velocity(self, state: np.ndarray) -> np.ndarray:
        return state[2:4] + np.stack([self.records[name][:self.n] for name in ("dx", "dy")])
