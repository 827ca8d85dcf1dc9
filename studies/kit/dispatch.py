"""One loop that hands out cases and keeps their outcomes; a transport says where the cases run."""
import multiprocessing
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Protocol

from tqdm import tqdm

from studies.kit.case import Case
from studies.kit.store import Failure, attempt, keep

#: fractions done that a running case may have
BEGUN, ENDING = 1e-9, 1 - 1e-9
FORMAT = "{desc} {percentage:3.0f}%|{bar}| {elapsed}, left {remaining} {postfix}"
#: number of a case, and its outcome as text or a failure
CaseEnd = tuple[int, str | Failure]
LOOK = 0.1      # seconds for which a transport waits for outcomes


class Bar:
    """Progress over the estimated cost of the cases, from the fraction done of each."""

    def __init__(self, cases: Sequence[Case], name: str):
        self.cases = cases
        #: worker processes write into it
        self.fractions = multiprocessing.get_context("spawn").RawArray("d", len(cases))
        seconds = 0.5 if sys.stderr.isatty() else 60.0
        self.line = tqdm(
            total=sum(case.cost for case in cases), desc=name, disable=not cases, bar_format=FORMAT,
            smoothing=0, dynamic_ncols=True, mininterval=seconds, maxinterval=seconds, miniters=0)

    def tell(self, number: int, fraction: float) -> None:
        """A case is so far; what comes after its outcome is dropped."""
        if self.fractions[number] < 1:
            self.fractions[number] = between(fraction)

    def show(self) -> None:
        """Draw, if it is time to."""
        pairs = list(zip(self.cases, self.fractions))
        labels = [case.label for case, fraction in pairs if 0 < fraction < 1]
        done = sum(case.cost*fraction for case, fraction in pairs if fraction > BEGUN)
        self.line.set_postfix_str("; ".join(labels), refresh=False)
        self.line.update(done - self.line.n)


def between(fraction: float) -> float:
    """The fraction of a case that has begun and not ended."""
    return min(max(fraction, BEGUN), ENDING)


class Transport(Protocol):
    """Takes cases, by their numbers, to where they run, and brings their outcomes back."""

    def places(self) -> int: ...                                    # how many may run at once, now
    def submit(self, number: int, case: Case) -> None: ...          # begin one; there is a place
    def ready(self) -> Iterable[CaseEnd]: ...     # those that ended; waits a moment for one
    def close(self) -> None: ...                                    # end what still runs


class Here:
    """This process: a case has ended when it is submitted."""

    def __init__(self, folder: Path, bar: Bar):
        self.folder, self.bar = folder, bar
        self.results: list[CaseEnd] = []

    def places(self) -> int:
        return 1

    def submit(self, number: int, case: Case) -> None:
        def report(fraction: float) -> None:
            self.bar.tell(number, fraction)
            self.bar.show()
        self.results.append((number, attempt(case, self.folder/case.key, report)))

    def ready(self) -> Iterator[CaseEnd]:
        while self.results:
            yield self.results.pop()

    def close(self) -> None:
        pass


def dispatch(cases: Sequence[Case], folder: Path, name: str,
             connect: Callable[[Bar], Transport]) -> list[Failure]:
    """Run cases in their order and keep their outcomes; those that time themselves come last, one by one.

    Each of the two groups has a transport of its own: times are taken in fresh processes.
    Raises KeyboardInterrupt, CannotRun: what ran is ended, what is finished is kept.
    """
    bar, failures = Bar(cases, name), []
    numbers = range(len(cases))
    together = deque(number for number in numbers if not cases[number].alone)
    alone = deque(number for number in numbers if cases[number].alone)
    with remember_interrupt(), bar.line:
        for todo, limit in ((together, len(cases)), (alone, 1)):
            if todo:
                with closing(connect(bar)) as transport:
                    for number, result in drain(transport, cases, todo, limit, bar):
                        failures.append(keep(cases[number], result, folder))
    return [failure for failure in failures if failure]


def drain(transport: Transport, cases: Sequence[Case], todo: deque[int], limit: int,
          bar: Bar) -> Iterator[CaseEnd]:
    """Give each place a case, ``limit`` at once, until all have ended; numbers and outcomes as they come."""
    running = 0
    while todo or running:
        if pressed:
            raise KeyboardInterrupt
        places = min(transport.places(), limit)
        while todo and running < places:
            number = todo.popleft()
            transport.submit(number, cases[number])
            running += 1
        for number, result in transport.ready():
            running -= 1
            bar.fractions[number] = 1.0
            yield number, result
        bar.show()


#: signals to stop that came: Python drops the exception of one that comes within a destructor or a callback
pressed: list[int] = []


@contextmanager
def remember_interrupt() -> Iterator[None]:
    """Keep Ctrl-C and SIGTERM in `pressed`, besides raising KeyboardInterrupt."""
    def stop(number: int, frame: object) -> None:
        pressed.append(number)
        raise KeyboardInterrupt
    if threading.current_thread() is not threading.main_thread():      # only the main thread has handlers
        yield
        return
    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)
              if signal.getsignal(number) is signal.default_int_handler}
    try:
        yield
    finally:
        pressed.clear()
        for number, handler in before.items():
            signal.signal(number, handler)
