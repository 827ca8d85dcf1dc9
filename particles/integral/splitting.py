"""Moving particles with noise, split: kick, drift, friction, drift, kick."""
from typing import Any

import numpy as np

from particles.threads import Team


class KickDriftFrictionDriftKick:
    """Half a kick, half a drift, friction and noise for a whole step, half a drift, half a kick.

    Rows of a state are x, v and the force of the end of the last step, masses are 1. sums.places : d;
    sums.soft(x, later, out) writes the forces without friction and noise, sums.rub(x, v, dt) lets these act
    on v where the particles are at half time. The conserved momentum stays, and kT of velocities and places
    is off by second order    [Leimkuhler & Matthews 2013, BAOAB]
    """

    def __init__(self, shape: tuple[int, ...], team: Team):
        self._new = np.empty((shape[0]//3, shape[1]))

    def step(self, sums: Any, y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt. ValueError: the box is sheared."""
        if sums.method.rate:
            raise ValueError(f"a box sheared at the rate {sums.method.rate:g} has images that slide during a "
                             "step: take Shardlow or GrootWarren")
        d, new = sums.places, self._new
        x, v, f = y[:d], y[d:2*d], y[2*d:]
        v += dt/2*f
        x += dt/2*v
        sums.rub(x, v, dt)
        x += dt/2*v
        sums.soft(x, dt, new)
        v += dt/2*new
        f[:] = new
