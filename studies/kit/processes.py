"""A transport to worker processes of this machine, one thread each."""
import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, MutableSequence
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from studies.kit.case import Case
from studies.kit.dispatch import LOOK, Bar, CaseEnd, between
from studies.kit.store import CannotRun, Failure, attempt, same_code

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
SPAWN = multiprocessing.get_context("spawn")
CHANGED = "the code was changed before this worker loaded it: start the study again"


class Processes:
    """So many workers at most; one that dies takes its case along and no other."""

    def __init__(self, count: int, folder: Path, bar: Bar):
        self.count, self.folder, self.fractions = count, folder, bar.fractions
        self.workers: dict[Connection, BaseProcess] = {}
        self.busy: dict[Connection, tuple[int, Case]] = {}

    def places(self) -> int:
        return self.count

    def submit(self, number: int, case: Case) -> None:
        pipe = next((pipe for pipe in self.workers if pipe not in self.busy), None) or self.start()
        self.busy[pipe] = number, case
        pipe.send((number, case))

    def start(self) -> Connection:
        """A new worker."""
        here, there = SPAWN.Pipe()
        worker = SPAWN.Process(target=serve, args=(there, self.folder, self.fractions), daemon=True)
        with as_workers_start():
            worker.start()
            self.workers[here] = worker
        there.close()       # when the worker dies, nobody has that end
        return here

    def ready(self) -> Iterator[CaseEnd]:
        pipes = wait(list(self.workers), LOOK)
        for pipe in [pipe for pipe in self.workers if pipe in pipes]:
            try:
                result: str | Failure | None = pipe.recv()
            except (EOFError, OSError):     # it died, perhaps without a case
                result = None
                self.workers.pop(pipe).join()
            if pipe in self.busy:
                number, case = self.busy.pop(pipe)
                yield number, result or self.died(case)

    def died(self, case: Case) -> Failure:
        """The failure of a case whose worker died. Raises CannotRun: No worker has begun a case."""
        if not any(self.fractions):
            raise CannotRun("worker processes end before they run a case: --workers 1 shows why")
        return Failure(case.label, "its worker process died, perhaps for want of memory: "
                                   "fewer workers need less (--workers 1)")

    def close(self) -> None:
        for worker in self.workers.values():
            worker.terminate()
            worker.join()


def serve(pipe: Connection, folder: Path, fractions: MutableSequence[float]) -> None:
    """In a worker: run the cases that come."""
    threading.Thread(target=end_with_parent, daemon=True).start()
    with suppress(EOFError, BrokenPipeError):       # the study is no more
        while True:
            number, case = pipe.recv()
            pipe.send(result_of(number, case, folder, fractions))


def result_of(number: int, case: Case, folder: Path, fractions: MutableSequence[float]) -> str | Failure:
    """In a worker: run case ``number`` with the code that the study began with."""
    def report(fraction: float) -> None:
        fractions[number] = between(fraction)
    report(0.0)
    return attempt(case, folder / case.key, report) if same_code(case) else Failure(case.label, CHANGED)


def end_with_parent() -> None:
    """In a worker: a study that was killed leaves no workers behind."""
    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)


@contextmanager
def as_workers_start() -> Iterator[None]:
    """Processes that start now have one thread each, and leave Ctrl-C to this one, which ends them."""
    before = {name: os.environ[name] for name in THREADS if name in os.environ}
    resource_tracker.ensure_running()       # starts with the first process otherwise, and unblocks
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    os.environ.update(dict.fromkeys(THREADS, "1"))      # libraries read this when they are loaded
    try:
        yield
    finally:
        for name in THREADS:
            del os.environ[name]
        os.environ.update(before)
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
