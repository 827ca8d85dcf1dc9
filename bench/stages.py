"""Time of each stage of an evaluation: lists, weights, two sweeps, rest (ns per particle and evaluation).

Stages are timed by wrapping the functions that hand them to threads, which costs a microsecond a call.
"""
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import process_time
from typing import Any

import numpy as np

from bench.convection import block_seconds, per_evaluation
from particles.lists import PairLists
from particles.threads import Threads

NAMES = {"weigh": "stage weigh", "Gradients": "stage gradient sweep", "Fluxes": "stage flux sweep"}
STAGES = ("stage list", *NAMES.values(), "stage rest")


@contextmanager
def timed(owner: type, method: str, name: Callable[..., str], spent: dict[str, float]) -> Iterator[None]:
    """Add the CPU seconds of owner.method(...) to spent[name(...)]."""
    plain = getattr(owner, method)

    def wrapped(self: Any, *arguments: Any) -> Any:
        began = process_time()
        result = plain(self, *arguments)
        spent[name(*arguments)] += process_time() - began
        return result

    setattr(owner, method, wrapped)
    try:
        yield
    finally:
        setattr(owner, method, plain)


def stage_of(function: Any, rows: int, *arguments: Any) -> str:
    """Name of the stage that a call of threads belongs to, or "other"."""
    word = type(arguments[0]).__name__ if function.__name__ == "sweep" else function.__name__
    return NAMES.get(word, "other")


def stages(particles: int, blocks: int) -> dict[str, np.ndarray]:
    """Nanoseconds per particle and evaluation by name of the stage, one value per block."""
    spent: dict[str, float] = defaultdict(float)
    laps: list[dict[str, float]] = []

    def keep():
        laps.append(dict(spent))
        spent.clear()

    with timed(Threads, "__call__", stage_of, spent), \
            timed(PairLists, "must_relist", lambda *_: "stage list", spent), \
            timed(PairLists, "relist", lambda *_: "stage list", spent):
        total = block_seconds(particles, blocks, between=keep)
    for lap, seconds in zip(laps[1:], total, strict=True):
        lap["stage rest"] = seconds - sum(lap.get(name, 0.0) for name in STAGES[:-1])
    return {name: np.array([per_evaluation(lap.get(name, 0.0), particles) for lap in laps[1:]])
            for name in STAGES}
