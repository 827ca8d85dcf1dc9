"""Transport of cases to the workers of a running Dask cluster, given by the address of its scheduler.

The cluster shares only the code with the study, and no disk: a case is sent to a worker, which returns the
outcome as text. If a worker is lost, Dask gives its case to another one, as often as the scheduler allows
(``allowed-failures``). ``make worker SCHEDULER=tcp://...`` starts a worker, for one case at a time.
"""
import os
import pickle
import re
import shutil
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from studies.kit import csvfile
from studies.kit.case import Case, Report
from studies.kit.dispatch import LOOK, THREADS, Bar, CaseEnd, tell
from studies.kit.store import CannotRun, Failure, attempt, same_code

if TYPE_CHECKING:
    from distributed import Client, Future, Worker

CONNECT = 10.0      # seconds: a scheduler that is there and not overloaded answers in less than one
ADDRESS = re.compile(r"(tcp|tls|ws|wss)://\S+:\d+")
NO_ANSWER = "the connection to the scheduler was lost"
WAY_OUT = "make worker SCHEDULER=tcp://..., in an up-to-date copy of this repository, starts one that fits"


class Cancelled(BaseException):
    """Ends a case that nobody waits for any more; ``except Exception`` does not take it for a failure."""


def check_scheduler(address: str) -> None:
    """Raise ValueError for what is not the address of a scheduler."""
    if address and not ADDRESS.fullmatch(address):
        raise ValueError(f"SCHEDULER={address} is no address of a Dask scheduler: give tcp://host:port, or "
                         "nothing to compute on this machine")


class Cluster:
    """Transport with a place for each worker that is connected now. `close` abandons unfinished cases."""

    def __init__(self, address: str, bar: Bar):
        self.client, self.fractions = connected(address), bar.fractions
        self.running: dict[Future, tuple[int, str]] = {}
        self.complete = True        # False while there is no worker, which is reported once

    def places(self) -> int:
        try:
            workers = len(self.client.nthreads())
        except OSError as error:
            raise CannotRun(NO_ANSWER) from error
        if self.complete and not workers:
            print(f"the cluster has no worker: {WAY_OUT}; waiting for one", file=sys.stderr)
        self.complete = workers > 0
        return workers

    def submit(self, number: int, case: Case) -> None:
        # a lambda is sent as code: the scheduler, which unpacks it, needs no copy of the repository;
        # a case brings the key that it has here, by which a worker sees whether it has other code
        future = self.client.submit(lambda *sent: import_module("studies.kit.cluster").perform(*sent),
                                    pickle.dumps(case), csvfile.versions(), pure=False)
        self.running[future] = number, case.label
        tell(self.fractions, number, 0.0)

    def ready(self) -> Iterator[CaseEnd]:
        time.sleep(LOOK)
        for future in [future for future in self.running if future.done()]:
            number, label = self.running.pop(future)
            yield number, outcome(future, label)

    def close(self) -> None:
        self.client.close()


def connected(address: str) -> "Client":
    """Connection to the scheduler. Raises CannotRun: it does not answer, or Dask is not installed."""
    try:
        from distributed import Client
    except ImportError as error:
        raise CannotRun(f"SCHEDULER={address} needs the package distributed ({error}): make "
                        ".venv/ready-cluster installs it; without SCHEDULER cases run on this machine"
                        ) from error
    try:
        return Client(address, timeout=CONNECT, set_as_default=False)
    except OSError as error:
        raise CannotRun(f"no Dask scheduler answers at {address} within {CONNECT:g} s: start one by dask "
                        "scheduler, or leave SCHEDULER out to compute on this machine") from error


def outcome(future: "Future", label: str) -> str | Failure:
    """Result of a worker: the outcome as text, or a failure. Raises CannotRun: the cluster itself failed."""
    from distributed import KilledWorker
    try:
        return future.result()
    except KilledWorker as error:
        count, last = error.allowed_failures + 1, error.last_worker.address
        message = (f"{count} workers died while they ran it, the last one {last}, perhaps for want of "
                   "memory: dask worker --memory-limit gives more")
        return Failure(label, message, story=str(error))
    except Exception as error:      # of the cluster: a worker returns failures of cases, it raises none
        raise CannotRun(f"{error}: {WAY_OUT}" if future.status == "error" else NO_ANSWER) from error


def perform(sent: bytes, versions: str) -> str | Failure:
    """In a worker: run a case with the code and libraries of the study; its outcome as text, or a failure.

    Checkpoints are in a folder of the worker and are lost when the worker ends.

    Raises CannotRun: threads, libraries or code of this worker differ from those of the study.
    """
    from distributed import get_worker
    worker = get_worker()
    check_worker(worker, versions)
    case = unpacked(sent, worker)
    scratch = Path(worker.local_directory)/"cases"/case.key
    result = attempt(case, scratch, ending(worker))
    if isinstance(result, Failure):
        return replace(result, message=f"{result.message} (on {worker.address})")
    shutil.rmtree(scratch)
    return result


def check_worker(worker: "Worker", versions: str) -> None:
    """Raise CannotRun if the worker runs several cases or threads at once, or has other library versions."""
    name = f"worker {worker.address}"
    if worker.state.nthreads != 1:
        raise CannotRun(f"{name} runs {worker.state.nthreads} cases at once: it needs --nthreads 1")
    os.environ.setdefault("NUMBA_NUM_THREADS", "1")     # Dask sets the other variables
    if more := [variable for variable in THREADS if os.environ.get(variable) != "1"]:
        raise CannotRun(f"{name} computes with more threads than one: it needs {'=1 '.join(more)}=1")
    own = csvfile.versions()
    if versions != own:
        raise CannotRun(f"{name} has {own}, the study {versions}")


def unpacked(sent: bytes, worker: "Worker") -> Case:
    """The case that was sent. Raises CannotRun: it cannot be loaded here, or has another key."""
    other = f"worker {worker.address} has other code than the study"
    try:
        case = pickle.loads(sent)
    except (ImportError, AttributeError, TypeError) as error:
        raise CannotRun(f"{other} ({error})") from error
    if not same_code(case):
        raise CannotRun(f"{other}: {case.label} has another key there")
    return case


def ending(worker: "Worker") -> Report:
    """Progress report of a case: raises Cancelled in the case when nobody waits for it any more."""
    task = worker.get_current_task()

    def report(fraction: float) -> None:
        known = worker.state.tasks.get(task)
        if known is None or known.state != "executing":
            raise Cancelled
    return report
