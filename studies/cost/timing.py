"""CPU seconds of a step, bytes of arrays and of the process, for every method in the same way."""
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple, TypeVar

import numpy as np
from scipy.special import stdtrit

from studies.kit.timing import REPEATS, SPREAD_TO_ERR

T = TypeVar("T")
SHORT = 0.01        # CPU seconds that the steps of the shorter of two runs take at least
MANY = 100_000      # steps of it at most
FEW, LONG = 3, 0.3  # repeats of what takes longer than so many seconds
#: half of the interquartile range of 3 repeats -> half width of the 95 % interval of their median: as `cost.SPREAD_TO_ERR`; the
#: quartiles of 3 lie half-way between neighbours, on average 0.423 sigma off
OF_FEW = float(stdtrit(FEW - 1, 0.975)*np.sqrt(np.pi/(2*FEW))/0.423)
#: of a process: its memory now and at most, the latter counted anew once "5" is written to the other
STATUS, FORGET = Path("/proc/self/status"), Path("/proc/self/clear_refs")


class Timed(NamedTuple):
    """Median of repeats and half width of its 95 % interval."""
    value: float
    err: float

    def times(self, factor: float) -> "Timed":
        """All of it, as often."""
        return Timed(*(factor*number for number in self))


def timed(seconds: Sequence[float], to_err: float) -> Timed:
    """to_err: half of the interquartile range of repeats to the error of their median."""
    low, middle, high = np.percentile(seconds, [25, 50, 75])
    return Timed(float(middle), to_err*float(high - low)/2)


def took(f: Callable[[], Any], clock: Callable[[], float] = process_time) -> float:
    """Seconds of a call."""
    began = clock()
    f()
    return clock() - began


def of_calls(f: Callable[[], Any], clock: Callable[[], float] = process_time) -> Timed:
    """Seconds of a call that was made before, so that all is compiled: of REPEATS, or of a FEW where it takes LONG."""
    first = took(f, clock)
    count, to_err = (FEW, OF_FEW) if first > LONG else (REPEATS, SPREAD_TO_ERR)
    return timed([first, *(took(f, clock) for _ in range(count - 1))], to_err)


def per_step(advance: Callable[[int], Any], short: float = SHORT, clock: Callable[[], float] = process_time) -> Timed:
    """Seconds of one step of advance(steps): the difference of two lengths, which leaves out what every run pays once.

    The steps of the shorter one take at least `short`, and as long as what is paid once: else its scatter would be all that is
    seen.
    """
    def lap(steps: int) -> float:
        return took(lambda: advance(steps), clock)
    lap(1)
    steps = 1
    while steps < MANY:
        one, three = lap(steps), lap(3*steps)
        spent = (three - one)/2
        if spent >= max(short, one - spent):
            break
        steps *= 2
    return timed([(lap(3*steps) - lap(steps))/(2*steps) for _ in range(REPEATS)], SPREAD_TO_ERR)


def of_laps(laps: Sequence[float] | np.ndarray) -> Timed:
    """Of one of them: their median; its error is that of so many, from their quartiles."""
    return timed(list(laps), SPREAD_TO_ERR*np.sqrt(REPEATS/len(laps)))


class Laps:
    """Seconds between calls."""

    def __init__(self, clock: Callable[[], float] = process_time) -> None:
        self.clock, self.at = clock, list[float]()

    def __call__(self, fraction: float) -> None:
        self.at.append(self.clock())

    def total(self, count: int) -> Timed:
        """Of `count` of them; the error is that of their median, from their quartiles."""
        return of_laps(np.diff(self.at)).times(count)


def with_peak(f: Callable[[], T]) -> tuple[T, float]:
    """What f() gives, and the bytes of memory that it takes at most beyond those of the process before; nan where no Linux is."""
    try:
        FORGET.write_text("5")
    except OSError:
        return f(), np.nan
    before = resident("VmRSS")
    result = f()
    return result, resident("VmHWM") - before


def resident(name: str) -> float:
    """Bytes, of this process."""
    line = next(line for line in STATUS.read_text().splitlines() if line.startswith(name))
    return 1024.0*int(line.split()[1])


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
