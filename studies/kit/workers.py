"""Cases onto worker processes, one thread each, with a bar that knows what is left."""
import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Generator, Iterator, MutableSequence, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path

from tqdm import tqdm

from studies.kit.case import Case
from studies.kit.keep import Failure, run_and_keep, same_code

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
SPAWN = multiprocessing.get_context("spawn")

#: in a worker: the fractions done of all cases, in memory shared with the study
shared: MutableSequence[float] = []


class Bar:
    """Progress over the estimated cost of the cases, from the fraction done of each."""

    def __init__(self, cases: Sequence[Case], name: str):
        self.cases = cases
        self.done = SPAWN.RawArray("d", len(cases))
        seconds = 0.5 if sys.stderr.isatty() else 60.0
        self.bar = tqdm(total=sum(case.cost for case in cases), desc=name, smoothing=0.05, dynamic_ncols=True,
                        mininterval=seconds, maxinterval=seconds, miniters=0, disable=not cases,
                        bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}, left {remaining} {postfix}")

    def show(self) -> None:
        """Draw, if it is time to."""
        running = [case.label for case, done in zip(self.cases, self.done) if 0 < done < 1]
        self.bar.set_postfix_str("; ".join(running), refresh=False)
        self.bar.update(sum(case.cost*done for case, done in zip(self.cases, self.done)) - self.bar.n)


def run_here(cases: Sequence[Case], folder: Path, bar: Bar) -> Iterator[Failure]:
    """Run cases in this process, one after the other."""
    for number, case in enumerate(cases):
        def report(fraction: float, number: int = number) -> None:
            bar.done[number] = min(max(fraction, 1e-9), 1 - 1e-9)
            bar.show()
        report(0.0)
        if failure := run_and_keep(case, folder, report):
            yield failure
        bar.done[number] = 1.0


def run_there(cases: Sequence[Case], folder: Path, bar: Bar, workers: int) -> Iterator[Failure]:
    """Run cases on worker processes; those that time themselves come last, one by one, and alone."""
    together = [number for number, case in enumerate(cases) if not case.alone]
    alone = [number for number, case in enumerate(cases) if case.alone]
    for numbers, count in ((together, workers), (alone, 1)):
        while numbers:
            with pool_of(bar, min(count, len(numbers))) as pool:
                lost = yield from drain(pool, cases, numbers, folder, bar)
            again = [number for number in lost if bar.done[number] == 0]
            if set(again) == set(numbers):
                raise RuntimeError("worker processes end before they run a case: --workers 1 shows why")
            numbers = again


@contextmanager
def pool_of(bar: Bar, workers: int) -> Iterator[ProcessPoolExecutor]:
    """Worker processes that are stopped, not waited for, when something is raised."""
    before = set(multiprocessing.active_children())
    with one_thread(), remember_interrupt(), ProcessPoolExecutor(workers, SPAWN, begin, (bar.done,)) as pool:
        try:
            yield pool
        except BaseException:
            for child in set(multiprocessing.active_children()) - before:
                child.terminate()
            raise


def drain(pool: ProcessPoolExecutor, cases: Sequence[Case], numbers: Sequence[int], folder: Path,
          bar: Bar) -> Generator[Failure, None, list[int]]:
    """Wait for all cases; yields failures, returns the numbers of those that a dying worker took along."""
    with no_interrupt():
        tasks = {pool.submit(run_one, number, cases[number], folder): number for number in numbers}
    waiting: set[Future] = set(tasks)
    lost = []
    while waiting:
        if pressed:
            raise KeyboardInterrupt
        ready, waiting = wait(waiting, timeout=0.2, return_when=FIRST_COMPLETED)
        for task in ready:
            number = tasks[task]
            if isinstance(task.exception(), BrokenProcessPool):
                lost.append(number)
                if bar.done[number] > 0:
                    yield Failure(cases[number].label, "its worker process died, perhaps for want of memory: "
                                  "fewer workers need less (--workers 1)")
            elif failure := task.result():
                yield failure
            bar.done[number] = 0.0 if number in lost and bar.done[number] == 0 else 1.0
        bar.show()
    return lost


def run_one(number: int, case: Case, folder: Path) -> Failure | None:
    """In a worker: run case ``number`` of the study, with the code that the study began with."""
    def report(fraction: float) -> None:
        if shared:
            shared[number] = min(max(fraction, 1e-9), 1 - 1e-9)
    report(0.0)
    if not same_code(case):
        return Failure(case.label, "the code was changed before this worker loaded it: start the study again")
    return run_and_keep(case, folder, report)


def begin(fractions: MutableSequence[float]) -> None:
    """In a worker, first: know the shared fractions, and end when the study ends, however it does."""
    global shared
    shared = fractions
    threading.Thread(target=end_with_parent, daemon=True).start()


def end_with_parent() -> None:
    """A study that was killed leaves no workers behind."""
    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)


@contextmanager
def one_thread() -> Iterator[None]:
    """Processes that start now compute with one thread each: libraries read this when they are loaded."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            os.environ.pop(name, None) if value is None else os.environ.__setitem__(name, value)


#: signals to stop that came: Python drops the exception of one that comes within a destructor or a callback
pressed: list[int] = []


@contextmanager
def remember_interrupt() -> Iterator[None]:
    """Keep in `pressed` that Ctrl-C was pressed or the study was told to end, besides raising KeyboardInterrupt."""
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


@contextmanager
def no_interrupt() -> Iterator[None]:
    """Processes that start now leave Ctrl-C to this one, which stops them."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
