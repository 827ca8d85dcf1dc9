"""Loop that distributes cases and stores their outcomes; a transport determines where the cases run.

Two transports are defined here: this process, and workers on this machine with one thread each.
"""
import multiprocessing
import os
import signal
import sys
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, MutableSequence, Sequence
from contextlib import closing, suppress
from functools import partial
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Protocol

from tqdm import tqdm

from studies.kit.case import Case
from studies.kit.store import CannotRun, Failure, attempt, keep, same_code

#: least and largest fraction done of a running case
BEGUN, ENDING = 1e-9, 1 - 1e-9
FORMAT = "{desc} {percentage:3.0f}%|{bar}| {elapsed}, left {remaining} {postfix}"
#: number of a case, and its outcome as text or a failure
CaseEnd = tuple[int, str | Failure]
LOOK = 0.1      # seconds for which a transport waits for outcomes
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
SPAWN = multiprocessing.get_context("spawn")
CHANGED = "the code was changed before this worker loaded it: start the study again"
TRIES = 3       # attempts at a case whose worker dies before it begins the case
NO_WORKER = "worker processes end before they run a case: --workers 1 shows why"
NOT_BEGUN = f"{TRIES} worker processes died before they began it: --workers 1 shows why"
DIED = "its worker process died, perhaps for want of memory: fewer workers need less (--workers 1)"


class Bar:
    """Progress bar over the estimated cost of all cases, from the fraction done of each."""

    def __init__(self, cases: Sequence[Case], name: str):
        self.cases, self.costs = cases, [case.cost for case in cases]    # once: the bar is drawn often
        self.fractions = SPAWN.RawArray("d", len(cases))        # worker processes write into it
        seconds = 0.5 if sys.stderr.isatty() else 60.0
        self.line = tqdm(
            total=sum(self.costs), desc=name, disable=not cases, bar_format=FORMAT,
            smoothing=0, dynamic_ncols=True, mininterval=seconds, maxinterval=seconds, miniters=0)

    def show(self) -> None:
        """Draw the bar, if it is time to."""
        labels = [case.label for case, fraction in zip(self.cases, self.fractions) if 0 < fraction < 1]
        done = sum(cost*fraction for cost, fraction in zip(self.costs, self.fractions) if fraction > BEGUN)
        self.line.set_postfix_str("; ".join(labels), refresh=False)
        self.line.update(done - self.line.n)


def tell(fractions: MutableSequence[float], number: int, fraction: float) -> None:
    """Note the fraction done of a case that runs."""
    fractions[number] = min(max(fraction, BEGUN), ENDING)


def dispatch(cases: Sequence[Case], folder: Path, name: str,
             connect: Callable[[Bar], "Transport"]) -> list[Failure]:
    """Run cases in their order, those ``alone`` last and one by one; store outcomes and return failures.

    Each of the two groups has its own transport, so that times are measured in fresh processes.
    Raises KeyboardInterrupt, CannotRun: running cases are ended, finished ones are kept.
    """
    bar, failures = Bar(cases, name), []
    with bar.line:
        for alone in (False, True):
            todo = deque(number for number, case in enumerate(cases) if case.alone == alone)
            if todo:
                with closing(connect(bar)) as transport:
                    for number, result in drain(transport, cases, todo, 1 if alone else len(cases), bar):
                        failures.append(keep(cases[number], result, folder))
    return [failure for failure in failures if failure]


def drain(transport: "Transport", cases: Sequence[Case], todo: deque[int], limit: int,
          bar: Bar) -> Iterator[CaseEnd]:
    """Run all cases of ``todo``, at most ``limit`` at once; yield number and outcome of each as it ends."""
    running = 0
    while todo or running:
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


class Transport(Protocol):
    """Interface to the place where cases run: takes cases with their numbers and returns outcomes."""

    def places(self) -> int: ...                                    # how many cases may run at once now
    def submit(self, number: int, case: Case) -> None: ...          # begin a case; a place is free
    def ready(self) -> Iterable[CaseEnd]: ...     # cases that have ended; waits a moment for one
    def close(self) -> None: ...                                    # end the cases that still run


class Here:
    """Transport within this process: `submit` runs a case to its end."""

    def __init__(self, folder: Path, bar: Bar):
        self.folder, self.bar = folder, bar
        self.results: list[CaseEnd] = []

    def places(self) -> int:
        return 1

    def submit(self, number: int, case: Case) -> None:
        def report(fraction: float) -> None:
            tell(self.bar.fractions, number, fraction)
            self.bar.show()
        self.results.append((number, attempt(case, self.folder/case.key, report)))

    def ready(self) -> Iterator[CaseEnd]:
        while self.results:
            yield self.results.pop()

    def close(self) -> None:
        pass


class Processes:
    """Transport to ``count`` worker processes at most; a worker that dies loses only its own case."""

    def __init__(self, count: int, folder: Path, bar: Bar):
        self.count, self.folder, self.fractions = count, folder, bar.fractions
        self.workers: dict[Connection, BaseProcess] = {}
        self.busy: dict[Connection, tuple[int, Case]] = {}
        self.tries: Counter[int] = Counter()

    def places(self) -> int:
        return self.count

    def submit(self, number: int, case: Case) -> None:
        idle = [pipe for pipe in self.workers if pipe not in self.busy]
        pipe = idle[0] if idle else self.start()
        self.busy[pipe] = number, case
        self.tries[number] += 1
        with suppress(OSError):     # the worker has died: `ready` notices it
            pipe.send((number, case))

    def start(self) -> Connection:
        """Start a worker with one thread. Ctrl-C is blocked in it: this process ends it."""
        here, there = SPAWN.Pipe()
        worker = SPAWN.Process(target=serve, args=(there, self.folder, self.fractions), daemon=True)
        os.environ.update(dict.fromkeys(THREADS, "1"))      # libraries read it when they are loaded
        resource_tracker.ensure_running()       # else the first worker starts it and unblocks SIGINT
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            worker.start()
            self.workers[here] = worker
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        there.close()       # else the pipe stays open when the worker dies
        return here

    def ready(self) -> Iterator[CaseEnd]:
        for pipe in wait(list(self.workers), LOOK):
            assert isinstance(pipe, Connection)
            try:
                result: str | Failure | None = pipe.recv()
            except (EOFError, OSError):     # the worker died, perhaps without a case
                result = None
                self.workers.pop(pipe).join()
            if pipe in self.busy:
                number, case = self.busy.pop(pipe)
                if not (result or self.fractions[number]) and self.tries[number] < TRIES:
                    self.submit(number, case)
                else:
                    yield number, result or self.died(number, case)

    def died(self, number: int, case: Case) -> Failure:
        """Failure of a case whose worker died. Raises CannotRun: no worker has begun any case."""
        if not any(self.fractions):
            raise CannotRun(NO_WORKER)
        return Failure(case.label, DIED if self.fractions[number] else NOT_BEGUN)

    def close(self) -> None:
        for worker in self.workers.values():
            worker.terminate()
            worker.join()


def serve(pipe: Connection, folder: Path, fractions: MutableSequence[float]) -> None:
    """In a worker: run the cases that the pipe brings, and send back their outcomes."""
    threading.Thread(target=end_with_parent, daemon=True).start()
    with suppress(EOFError, BrokenPipeError):       # the study has ended
        while True:
            number, case = pipe.recv()
            report = partial(tell, fractions, number)
            # a changed formula would give another result under the key that the study has
            same = same_code(case)
            pipe.send(attempt(case, folder/case.key, report) if same else Failure(case.label, CHANGED))


def end_with_parent() -> None:
    """In a worker: end when the study ends, even if it was killed."""
    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)
