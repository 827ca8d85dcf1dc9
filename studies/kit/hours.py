"""python -m studies.kit.hours STUDY ...: what these studies have still to do, in minutes of CPU."""
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from studies.kit.study import Study, results, say
from studies.kit.table import check_size
from studies.kit.times import times


class Left(NamedTuple):
    """Cases to do, of how many; expected CPU seconds; whether a whole run of the study was measured."""

    study: str
    todo: int
    cases: int
    cpu_s: float
    measured: bool

    def __str__(self) -> str:
        told = f"{self.study:<14}{self.todo:>5} of {self.cases:<5}cases {self.cpu_s/60:>6.1f} min"
        return told if self.measured else f"{told} (estimated)"


def left(study: Study, size: str, out: Path) -> Left:
    """The estimates of cases without result, times what a whole run took over its own estimates.

    That run is of the same size, or of the longest that was measured; without any, estimates stay as they are.
    """
    cases = list({case.key: case for case in study.cases(size)}.values())
    todo = [case for case in cases if not (out / "raw" / study.name / f"{case.key}.json").exists()]
    known = times(out).query("study == @study.name")
    same = known[known["size"] == size]
    run = (same if len(same) else known.sort_values("cpu_s").tail(1)).to_dict("records")
    ratio = run[0]["cpu_s"]/run[0]["estimate_s"] if run else 1.0
    return Left(study.name, len(todo), len(cases), ratio*sum(case.cost for case in todo), bool(run))


def main(names: Sequence[str]) -> int:
    """The command line; 0, or 2 for a size that there is none of."""
    size = os.environ.get("SIZE") or "paper"
    try:
        check_size(size)
    except ValueError as error:
        return say(f"hours: {error}", 2)
    print(f"size {size}, what is left, in minutes of CPU:", flush=True)
    hours = 0.0
    for name in names:
        one = left(import_module(f"studies.{name}").STUDY, size, results(size))
        hours += one.cpu_s/3600
        print(one, flush=True)
    print(f"together {hours:.1f} hours of CPU, {hours/2:.1f} on two cores; Ctrl-C keeps what is finished", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
