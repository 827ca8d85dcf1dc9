"""Cases onto the workers of a Dask cluster that is there already, known by the address of its scheduler.

A cluster shares the code with the study and nothing else, no disk either: a case travels to a worker, its rows come back and
the study's process keeps them. Dask gives a case whose worker is lost to another one, as often as the scheduler allows
(``allowed-failures``, 3 unless set). Workers run one case at a time; ``make worker SCHEDULER=tcp://...`` starts one.
"""
import re
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from studies.kit import provenance
from studies.kit.case import Case
from studies.kit.errand import ClusterError, errand, packed
from studies.kit.keep import Failure, keep
from studies.kit.workers import Bar, pressed, remember_interrupt

if TYPE_CHECKING:
    from distributed import Client, Future

CONNECT = 10.0      # seconds: a scheduler that is there and not overloaded answers in less than one
LOOK = 0.1          # seconds between looks at what is finished
ADDRESS = re.compile(r"(tcp|tls|ws|wss)://\S+:\d+")
LOST = "the connection to the scheduler was lost"
WAY_OUT = "make worker SCHEDULER=tcp://..., in an up-to-date copy of this repository, starts one that fits"


def check_scheduler(address: str) -> str:
    """The address itself.

    Raises
    ------
    ValueError
        It is not one of a scheduler.
    """
    if address and not ADDRESS.fullmatch(address):
        raise ValueError(f"SCHEDULER={address} is no address of a Dask scheduler: give tcp://host:port, or nothing to compute "
                         "on this machine")
    return address


def run_on(scheduler: str, cases: Sequence[Case], folder: Path, bar: Bar) -> Iterator[Failure]:
    """Run cases on a cluster; those that time themselves come last, one by one.

    Raises
    ------
    ClusterError
        The scheduler does not answer, is lost, or has a worker that cannot run these cases.
    """
    if not cases:
        return
    together = [number for number, case in enumerate(cases) if not case.alone]
    alone = [number for number, case in enumerate(cases) if case.alone]
    with remember_interrupt(), connected(scheduler) as client:
        client.subscribe_topic(topic(client), show_on(bar))
        yield from drain(client, cases, together, len(cases), folder, bar)
        yield from drain(client, cases, alone, 1, folder, bar)


@contextmanager
def connected(scheduler: str) -> Iterator["Client"]:
    """A connection to the scheduler. When it ends, however it does, the cluster gives up what was not finished."""
    try:
        from distributed import Client
    except ImportError as error:
        raise ClusterError(f"SCHEDULER={scheduler} needs the package distributed ({error}): make env installs it, or pip install "
                           "distributed; without SCHEDULER cases run on this machine") from error
    try:
        client = Client(scheduler, timeout=CONNECT, set_as_default=False)
    except OSError as error:
        raise ClusterError(f"no Dask scheduler answers at {scheduler} within {CONNECT:g} s: start one by dask scheduler, or "
                           "leave SCHEDULER out to compute on this machine") from error
    with client:
        yield client


def topic(client: "Client") -> str:
    """Under which workers tell how far they are; under the name of a client Dask itself tells things."""
    return f"{client.id}-cases"


def show_on(bar: Bar) -> Callable[[tuple[float, tuple[int, float]]], None]:
    """What to do when a worker tells the fraction done of a case."""
    def show(event: tuple[float, tuple[int, float]]) -> None:
        number, fraction = event[1]
        if bar.done[number] < 1:        # it may come after the result
            bar.done[number] = min(max(fraction, 1e-9), 1 - 1e-9)
    return show


def drain(client: "Client", cases: Sequence[Case], numbers: Sequence[int], most: int, folder: Path,
          bar: Bar) -> Iterator[Failure]:
    """Give out a case for each worker, ``most`` at once; keep what comes back, yield failures.

    No case waits at a worker, where it would be suspected together with a case that kills this worker.
    """
    todo, task, some = deque(numbers), errand(), True
    running: dict[Future, int] = {}
    while todo or running:
        if pressed:
            raise KeyboardInterrupt
        for future in [future for future in running if future.done()]:
            number = running.pop(future)
            if failure := keep(cases[number], brought(future, cases[number]), folder):
                yield failure
            bar.done[number] = 1.0
        workers = places(client)
        if some and not workers:
            print(f"the cluster has no worker: {WAY_OUT}; waiting for one", file=sys.stderr)
        some = workers > 0
        while todo and len(running) < min(most, workers):
            number = todo.popleft()
            running[client.submit(task, number, packed(cases[number]), provenance.versions(), topic(client),
                                  pure=False, key=f"{client.id}-{number}")] = number
        bar.show()
        time.sleep(LOOK)


def places(client: "Client") -> int:
    """How many workers there are now."""
    try:
        return len(client.nthreads())
    except OSError as error:
        raise ClusterError(LOST) from error


def brought(future: "Future", case: Case) -> str | Failure:
    """What a worker found: the outcome as text, or a failure."""
    from distributed import KilledWorker
    try:
        return future.result()
    except KilledWorker as error:
        return Failure(case.label, f"{error.allowed_failures + 1} workers died while they ran it, the last one "
                       f"{error.last_worker.address}, perhaps for want of memory: dask worker --memory-limit gives more",
                       story=str(error))
    except Exception as error:      # failures of cases are handed back: whatever is raised is trouble of the cluster
        if future.status != "error":
            raise ClusterError(LOST) from error
        raise ClusterError(f"{error}: {WAY_OUT}") from error
