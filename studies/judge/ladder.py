"""Climbing the ladder: rung by rung, what is finished on disk, what fails a verdict, within some minutes."""
import hashlib
import inspect
import json
import signal
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import source_hash
from particles.run import Divergence
from studies.build.answers import duration
from studies.judge.measures import Numbers
from studies.judge.rungs import RUNGS, Rung
from studies.judge.verdicts import Verdict
from studies.kit.csvfile import write_atomic

LEFT_OUT = "left out:"


class TooLong(Exception):
    """The minutes are over."""


class Take(NamedTuple):
    """A rung at a number of rows: its numbers, or why there are none."""
    rung: str
    rows: int
    numbers: Numbers
    seconds: float
    fault: str = ""


class Ladder(NamedTuple):
    """A method on its way up. folder : of what is finished. rows : from few to many."""
    method: Any
    folder: Path
    rows: Sequence[int]
    minutes: float

    def climb(self) -> list[Take]:
        """Takes in their order; what is finished is not done again."""
        end = monotonic() + 60*self.minutes
        takes: list[Take] = []
        places = [(rung, rows) for rung in RUNGS for rows in (self.rows if rung.every else self.rows[:1])]
        for number, (rung, rows) in enumerate(places):
            takes.append(self.kept(rung, rows) or self.take(rung, rows, end, takes))
            tell(takes, places, number)
        return takes

    def take(self, rung: Rung, rows: int, end: float, before: list[Take]) -> Take:
        """One, kept if it is finished; not begun where the minutes would not do."""
        left, needed = end - monotonic(), foreseen(rung, rows, before)
        if needed > left:
            why = f"{LEFT_OUT} it takes some {needed/60:.0f} minutes; --minutes gives more"
            return Take(rung.name, rows, {}, 0.0, why)
        began = monotonic()
        try:
            with np.errstate(all="ignore"), within(left):
                numbers, fault = rung.measure(rung.scene(rows), self.method), ""
        except TooLong:
            why = f"{LEFT_OUT} the minutes were over; --minutes gives more"
            return Take(rung.name, rows, {}, monotonic() - began, why)
        except Exception as error:      # whatever a method of somebody's own may raise is its verdict
            numbers, fault = {}, told(error, self.method)
        taken = Take(rung.name, rows, numbers, monotonic() - began, fault)
        write_atomic(self.place(rung, rows), json.dumps({"key": self.key, **taken._asdict()}))
        return taken

    def kept(self, rung: Rung, rows: int) -> Take | None:
        """As on disk, of the same code."""
        path = self.place(rung, rows)
        if not path.exists():
            return None
        fields = json.loads(path.read_text())
        return Take(**fields) if fields.pop("key") == self.key else None

    def place(self, rung: Rung, rows: int) -> Path:
        return self.folder/f"{rung.name}-{rows}.json"

    @property
    def key(self) -> str:
        """Of the module of the method and the solvers."""
        own = source(self.method)
        return source_hash() + (hashlib.sha256(own.read_bytes()).hexdigest()[:12] if own else "")


def source(method: Any) -> Path | None:
    """The file of a class; none of a name."""
    return Path(inspect.getfile(method)) if isinstance(method, type) else None


def told(error: Exception, method: Any) -> str:
    """One line: what was raised, and where in the method's own file."""
    words = str(error).strip().split("\n")[0]
    own = source(method)
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__)
             if own and Path(frame.filename) == own]
    place = f" (line {lines[-1]} of {own.name})" if own and lines else ""
    return words if isinstance(error, Divergence) else f"{type(error).__name__}: {words}{place}"


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Raises TooLong inside after so many seconds, where the system has alarms."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def ring(*_: Any) -> None:
        raise TooLong
    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def work(rung: Rung, rows: int) -> float:
    """Points times the length of the run: seconds go with it."""
    scene = rung.scene(rows)
    usual, unit = duration(scene)
    return float(scene.width*scene.L*usual*unit)


def foreseen(rung: Rung, rows: int, before: list[Take]) -> float:
    """Seconds, from the same rung with fewer rows; nothing is known of the first."""
    same = [take for take in before if take.rung == rung.name and take.numbers]
    return same[-1].seconds*work(rung, rows)/work(rung, same[-1].rows) if same else 0.0


def tell(takes: list[Take], places: list[tuple[Rung, int]], number: int) -> None:
    """A line about what is done, and how long the rest will take, as far as that is known."""
    (rung, rows), take = places[number], takes[-1]
    done, todo = (sum(work(*place) for place in part) for part in (places[:number + 1], places[number + 1:]))
    left = sum(one.seconds for one in takes)*todo/done
    rest = f"; about {left:.0f} s left" if left > 0 else ""
    words = take.fault or f"{take.seconds:.1f} s"
    print(f"[{number + 1}/{len(places)}] {rung.name}, {rows} rows: {words}{rest}", file=sys.stderr)


def judged(rung: Rung, takes: Sequence[Take]) -> Verdict:
    """The verdict of a rung: what went wrong first, then what the rest says."""
    mine = [take for take in takes if take.rung == rung.name]
    faults = [f"{take.fault} ({take.rows} rows)" if rung.every else take.fault for take in mine if take.fault]
    taken = [(take.rows, take.numbers) for take in mine if not take.fault]
    verdict = rung.verdict(taken) if taken else Verdict("", None)
    if not faults:
        return verdict
    if all(fault.startswith(LEFT_OUT) for fault in faults):
        return Verdict("; ".join(filter(None, (verdict.words, faults[0]))), verdict.good)
    return Verdict("; ".join(filter(None, (faults[0], verdict.words))), False)
