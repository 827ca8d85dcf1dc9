"""Kinetic energies against time: what the table `history` tells."""
from typing import NamedTuple

import numpy as np

from studies.build.read import over_seeds, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables

NEAR = 0.05     # of the steady value: particles' K fluctuates by 1 % or 2 %, a narrower band would time the noise


class History(NamedTuple):
    """K(t) of one run."""
    t: np.ndarray
    ke: np.ndarray

    @property
    def late(self) -> np.ndarray:
        """The second half of the run."""
        return self.ke[self.t > self.t[-1]/2]

    @property
    def scatter(self) -> float:
        """Relative standard deviation of the second half."""
        return float(self.late.std()/self.late.mean())

    @property
    def drift(self) -> float:
        """How much the mean of the last quarter differs from that of the third, relative."""
        third, last = np.array_split(self.late, 2)
        return float(abs(last.mean()/third.mean() - 1))

    @property
    def settling(self) -> float:
        """When K, averaged over a fortieth of the run, is near its late mean for good."""
        n = max(1, len(self.ke)//40)
        smooth = np.convolve(self.ke, np.full(n, 1/n), "same")[:len(self.ke) - n//2]
        far = np.abs(smooth/self.late.mean() - 1) > NEAR
        return float(self.t[np.flatnonzero(far)[-1]]) if far.any() else 0.0


def histories(tables: Tables, point: dict, energy: str = "ke_field") -> list[History]:
    """One a seed.

    Raises
    ------
    CannotTell
        None, or too short ones.
    """
    frame = select(tables, "history", **point).sort_values("t")
    found = [History(group["t"].to_numpy(float), group[energy].to_numpy(float)) for _, group in frame.groupby("seed")]
    if min(len(h.t) for h in found) < 20:
        raise CannotTell("a history has fewer than 20 samples: nothing to judge by")
    return found


def distance(particles: list[History], grid: History, unit: float) -> Measured:
    """Largest |K - K_grid| during the approach, over `unit`."""
    return over_seeds([float(np.max(np.abs(h.ke - np.interp(h.t, grid.t, grid.ke))))/unit for h in particles])
