"""Climbing the ladder: rung by rung, what fails a verdict too, within some minutes."""
import inspect
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from particles.run import Divergence
from studies.build.answers import duration
from studies.judge.measures import Numbers, Verdict
from studies.judge.rungs import RUNGS, Rung

LEFT_OUT = "left out:"


class Take(NamedTuple):
    """A rung at a number of rows: its numbers, or why there are none."""
    rung: str
    rows: int
    numbers: Numbers
    seconds: float
    fault: str = ""


def climb(method: Any, rows: Sequence[int], minutes: float) -> list[Take]:
    """A method on its way up, from few rows to many; what takes longer than the minutes is left out."""
    end, takes = monotonic() + 60*minutes, list[Take]()
    places = [(rung, count) for rung in RUNGS for count in (rows if rung.every else rows[:1])]
    for number, place in enumerate(places, 1):
        takes.append(taken(method, *place, end - monotonic(), takes))
        done, left = (sum(work(*each) for each in part) for part in (places[:number], places[number:]))
        rest, take = sum(take.seconds for take in takes)*left/done, takes[-1]
        print(f"[{number}/{len(places)}] {take.rung}, {take.rows} rows: "
              f"{take.fault or f'{take.seconds:.1f} s'}; about {rest:.0f} s left", file=sys.stderr)
    return takes


def taken(method: Any, rung: Rung, rows: int, left: float, before: list[Take]) -> Take:
    """One; not begun where the seconds that are left would not do."""
    needed = foreseen(rung, rows, before)
    if needed > left:
        return Take(rung.name, rows, {}, 0.0,
                    f"{LEFT_OUT} it takes some {needed/60:.0f} minutes; --minutes gives more")
    began = monotonic()
    try:
        with np.errstate(all="ignore"):
            numbers, fault = rung.measure(rung.scene(rows), method), ""
    except Exception as error:      # whatever a method of somebody's own may raise is its verdict
        numbers, fault = {}, told(error, method)
    return Take(rung.name, rows, numbers, monotonic() - began, fault)


def told(error: Exception, method: Any) -> str:
    """One line: what was raised, and where in the method's own file."""
    words = str(error).strip().split("\n")[0]
    own = Path(inspect.getfile(method)) if isinstance(method, type) else None
    if isinstance(error, Divergence):
        return words
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__)
             if own and Path(frame.filename) == own]
    place = f" (line {lines[-1]} of {own.name})" if own and lines else ""
    return f"{type(error).__name__}: {words}{place}"


def work(rung: Rung, rows: int) -> float:
    """Points times the length of the run: seconds go with it."""
    scene = rung.scene(rows)
    usual, unit = duration(scene)
    return float(scene.width*scene.L*usual*unit)


def foreseen(rung: Rung, rows: int, before: list[Take]) -> float:
    """Seconds, from the same rung with fewer rows; nothing is known of the first."""
    same = [take for take in before if take.rung == rung.name and take.numbers]
    return same[-1].seconds*work(rung, rows)/work(rung, same[-1].rows) if same else 0.0


def judged(rung: Rung, takes: Sequence[Take]) -> Verdict:
    """The verdict of a rung: what went wrong first, then what the rest says."""
    mine = [take for take in takes if take.rung == rung.name]
    faults = [f"{take.fault} ({take.rows} rows)" if rung.every else take.fault for take in mine if take.fault]
    taken = [(take.rows, take.numbers) for take in mine if not take.fault]
    verdict = rung.judged(taken) if taken else Verdict("", None)
    if not faults:
        return verdict
    wrong = not all(fault.startswith(LEFT_OUT) for fault in faults)
    words = (faults[0], verdict.words) if wrong else (verdict.words, faults[0])
    return Verdict("; ".join(filter(None, words)), False if wrong else verdict.good)


def verdicts(takes: Sequence[Take]) -> list[tuple[Rung, Verdict]]:
    """Of all rungs, that of the step first where every step is unstable; what is the same is told once."""
    pairs = [(rung, judged(rung, takes)) for rung in RUNGS]
    pairs.sort(key=lambda pair: "unstable at any step" not in pair[1].words)
    first: dict[str, str] = {}
    return [(rung, Verdict(verdict.words if first.setdefault(verdict.words, rung.name) == rung.name
                           else f"the same as {first[verdict.words]}", verdict.good))
            for rung, verdict in pairs]
