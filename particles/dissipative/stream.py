"""Dissipative particles that stream past others which are held, and so form a soft body    [RR98, Sec. IV]"""
from dataclasses import dataclass
from typing import Any

import numpy as np

from particles.dissipative.dpd import Dpd, Forces
from particles.dissipative.integrators import Shardlow, VelocityVerlet
from particles.integrators import TwoStep
from particles.threads import Threads


@dataclass(frozen=True, kw_only=True)
class DpdStream(Dpd):
    """`Dpd` with particles of numbers `held` (m,) at rest; the others get a force `push` along x.

    Raises ValueError: no particle is held, one of them twice, the push is not finite, or the integrator moves
    both particles of a pair at once.
    """
    held: np.ndarray
    push: float = 0.0
    integrator: type = VelocityVerlet

    def __post_init__(self):
        super().__post_init__()
        if len(self.held) < 1 or len(np.unique(self.held)) < len(self.held):
            raise ValueError(f"{len(self.held)} particles are to be held, {len(np.unique(self.held))} of "
                             "them different: name at least one, and each once")
        if not np.isfinite(self.push):
            raise ValueError(f"the push must be finite, got {self.push}")
        if issubclass(self.integrator, (Shardlow, TwoStep)):
            raise ValueError(f"{self.integrator.__name__} does not step with forces alone, by which "
                             "particles are held: take VelocityVerlet")

    def at_rest(self, state: np.ndarray, speed: float) -> np.ndarray:
        """A state (3 d, n) with the held particles at rest, `speed` added to the others along x."""
        d, out = self.d, state.copy()
        out[d] += speed
        out[d:, self.held] = 0.0
        return out

    def start(self, n: int, threads: Threads) -> "PairStreaming":
        """The pair sums."""
        return PairStreaming(self, n, threads)


class PairStreaming(Forces):
    """The pair sums, and the momentum that the body has received since it was last asked for."""
    method: DpdStream

    def __init__(self, method: DpdStream, n: int, threads: Threads):
        super().__init__(method, n, threads)
        self.is_held = np.zeros(n, bool)
        self.is_held[method.held] = True
        self.begin()

    def begin(self) -> None:
        """Nothing has been received yet."""
        self.received, self.calls = np.zeros(self.places), 0

    def drive(self, forces: np.ndarray) -> None:
        """Held particles feel nothing, the others the push."""
        held = self.is_held[self.now.ids]
        forces[:, held] = 0.0
        forces[0, ~held] += self.method.push

    def make_ready(self, now: Any, dt: float) -> None:
        """As all do; the force before the first step is one of these, too."""
        super().make_ready(now, dt)
        if now.step == 0:
            self.drive(now.state[2*self.places:])
            self.begin()

    def forces(self, x: np.ndarray, v: np.ndarray, later: float, out: np.ndarray) -> None:
        """Forces (d, n), of which the held particles' go into what the body has received."""
        super().forces(x, v, later, out)
        self.received += out[:, self.is_held[self.now.ids]].sum(axis=1)
        self.calls += 1
        self.drive(out)


def force_on_body(sums: PairStreaming, state: np.ndarray) -> float:
    """Along x, mean over all forces evaluated since the last record or restart."""
    force = sums.received/max(sums.calls, 1)
    sums.begin()
    return float(force[0])


def speed(sums: PairStreaming, state: np.ndarray) -> float:
    """Mean velocity along x of all particles, the held ones among them."""
    return float(state[sums.places].mean())
