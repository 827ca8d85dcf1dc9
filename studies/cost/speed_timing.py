"""CPU seconds of a step and bytes of arrays, for every method in the same way."""
from collections.abc import Callable, Iterator
from functools import partial
from math import ceil
from time import process_time
from typing import Any

import numpy as np

from studies.convection.cost import REPEATS, SPREAD_TO_ERR
from studies.kit.stats import Measured
from studies.kit.timing import median_seconds

SHORT = 0.004       # CPU seconds of the shorter of two runs at least: a thousand times what the clock resolves
FEW, MANY = 4, 100000


def per_step(advance: Callable[[int], Any], short: float = SHORT,
             clock: Callable[[], float] = process_time) -> Measured:
    """Seconds of one step of advance(steps): the difference of two lengths, which leaves out what every run pays once.

    Medians of REPEATS runs of each length; the error is the half width of the 95 % interval that their quartiles give.
    """
    advance(FEW)
    steps = max(FEW, min(MANY, ceil(short/max(1e-9, _rough(advance, clock)))))
    one, three = (median_seconds(partial(advance, n), REPEATS, clock) for n in (steps, 3*steps))
    err = float(np.hypot(one.spread, three.spread))*SPREAD_TO_ERR
    return Measured((three.median - one.median)/(2*steps), err/(2*steps))


def _rough(advance: Callable[[int], Any], clock: Callable[[], float]) -> float:
    """About the seconds of a step."""
    times = [clock()]
    for steps in (FEW, 5*FEW):
        advance(steps)
        times.append(clock())
    return (times[2] - 2*times[1] + times[0])/(4*FEW)


class Laps:
    """Seconds between calls."""

    def __init__(self, clock: Callable[[], float] = process_time) -> None:
        self.clock, self.at = clock, list[float]()

    def __call__(self, fraction: float) -> None:
        self.at.append(self.clock())

    def total(self, count: int) -> Measured:
        """Of `count` of them; the error is that of their median, from their quartiles."""
        laps = np.diff(self.at)
        low, middle, high = np.percentile(laps, [25, 50, 75])
        return Measured(count*float(middle), count*float(high - low)/2*SPREAD_TO_ERR*np.sqrt(REPEATS/len(laps)))


def array_bytes(*things: Any) -> int:
    """Bytes of all arrays that things hold, each buffer once; not those of a `method`, which are there to set up only."""
    return sum({address(array): array.nbytes for array in arrays(things, set())}.values())


def address(array: np.ndarray) -> int:
    """Where the buffer of an array begins."""
    return int(array.__array_interface__["data"][0])


def arrays(thing: Any, seen: set[int]) -> Iterator[np.ndarray]:
    """Arrays in a thing, in what it holds, and so on; of a view its whole buffer."""
    if id(thing) in seen or isinstance(thing, type | str | int | float):
        return
    seen.add(id(thing))
    if isinstance(thing, np.ndarray):
        while isinstance(thing.base, np.ndarray):
            thing = thing.base
        yield thing
        return
    held = list(thing) if isinstance(thing, tuple | list) else list(thing.values()) if isinstance(thing, dict) else []
    held += [value for name, value in getattr(thing, "__dict__", {}).items() if name != "method"]
    for one in held:
        yield from arrays(one, seen)
