"""Streams of dissipative particles along bodies of frozen ones: what cylinders and flat walls share"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from particles.dissipative.dpd import Dpd
from particles.dissipative.integrators import VelocityVerlet
from particles.dissipative.stream import DpdStream
from particles.run import Plan, run
from studies.noise.dpd.runs import Fluid

DEPTH = 4.0
ETA = 0.85          # about, for the push
RECORD = 1.0        # between records: about what sound needs across the cell


@dataclass(frozen=True, kw_only=True)
class Frozen(Fluid):
    """A stream along a body of frozen particles, in a box that is `DEPTH` deep.

    turns : particles that get inside are sent back. A subclass has `settling`, the time until the stream is steady.
    """
    turns: bool = False
    integrator: type = VelocityVerlet
    dt: float = 0.04

    @property
    def settling(self) -> float:
        """Time until the stream is steady."""
        raise NotImplementedError(f"{type(self).__name__} needs the time until its stream is steady")

    def filled(self, still: Dpd, inside: Callable) -> np.ndarray:
        """Particles of the whole box (9, n); those inside will be frozen, which leaves the structure as it was."""
        return self.settled(still)

    def stream(self, box: tuple[float, float], inside: Any, push: float, U: float) -> tuple[DpdStream, np.ndarray]:
        """The method in a box (width, height), a push on every free particle, and the steady stream (9, n) that began with U."""
        still = replace(self.method(), box=(*box, DEPTH))
        state = self.filled(still, inside)
        method = DpdStream(box=still.box, a=self.a, kT=self.kT, noise=still.noise, integrator=self.integrator,
                           held=np.flatnonzero(inside(state[:3])), push=push, turned=inside.turned if self.turns else None)
        start = run(method, method.at_rest(state, U), Plan(dt=self.dt, steps=round(self.settling/self.dt))).by_id()
        return method, start

    def again(self, method: DpdStream, number: int = 0) -> DpdStream:
        """The method with a seed of its own: the noise of a run begins anew."""
        return replace(method, noise=self.noise(self.seed + 3000 + number))

    def records(self, time: float, **more) -> Plan:
        """A run of this time."""
        every = round(RECORD/self.dt)
        return Plan(dt=self.dt, steps=round(time/RECORD)*every, every=every, **more)


def free_temperature(sums, state: np.ndarray) -> float:
    """kT of what is free from the velocities across the stream."""
    free = ~sums.is_held[sums.now.ids]
    return float((state[4:6, free]**2).mean())
