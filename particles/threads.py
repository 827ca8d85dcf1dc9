"""Threads that share the rows of a loop."""
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np

from continuum.jit import overload


class Threads:
    """Call a compiled function(first, last, ...) on equal row ranges, one per thread, bitwise as on one."""

    def __init__(self, number: int = 1):
        if not (isinstance(number, (int, np.integer)) and number >= 1):
            raise ValueError(f"the number of threads must be at least 1, got {number}")
        self.number: int = int(number)
        self._pool: ThreadPoolExecutor | None = ThreadPoolExecutor(number - 1) if number > 1 else None

    def __call__(self, function: Callable, rows: int, *arguments: Any) -> list:
        """List of the results of function(first, last, *arguments), one per range."""
        if self._pool is None or rows < 64*self.number:
            return [function(0, rows, *arguments)]
        cuts = [rows*t//self.number for t in range(self.number + 1)]
        others = [self._pool.submit(function, a, b, *arguments) for a, b in pairwise(cuts[1:])]
        return [function(0, cuts[1], *arguments), *(other.result() for other in others)]


def shared(function: Callable) -> Any:
    """Turn a compiled function(first, last, ...) into call(threads, rows, ...), whose rows threads share.

    In compiled code one thread takes all rows, whatever `threads` is.
    """
    def call(threads, rows, *arguments):
        return threads(function, rows, *arguments)

    @overload(call)
    def _(threads, rows, *arguments):
        return lambda threads, rows, *arguments: function(0, rows, *arguments)

    return call
