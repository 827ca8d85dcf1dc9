"""What is sent to a worker of a cluster: a case by the names in it, and how it is run there."""
import io
import math
import os
import pickle
import shutil
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from studies.kit import key as source
from studies.kit import provenance
from studies.kit.case import Case, Report, file_of, module_of
from studies.kit.keep import Failure, attempt, same_code
from studies.kit.workers import THREADS

if TYPE_CHECKING:
    from distributed import Worker

TELL = 1.0      # seconds between fractions that a worker tells


class ClusterError(Exception):
    """The cluster cannot run the study; what is finished is kept."""


class Cancelled(BaseException):
    """Nobody waits for this case any more: no ``except Exception`` takes it for a failure."""


class Pack(pickle.Pickler):
    """Calls classes and functions of the script that was started by the name of its module: there, another is __main__."""

    def reducer_override(self, thing: Any) -> Any:
        if getattr(thing, "__module__", "") == "__main__" and hasattr(thing, "__qualname__"):
            return named, (module_of(file_of(thing)), thing.__qualname__)
        return NotImplemented


def packed(case: Case) -> bytes:
    """A case with its key, as bytes."""
    file, _ = io.BytesIO(), case.key
    Pack(file).dump(case)
    return file.getvalue()


def named(module: str, name: str) -> Any:
    """A class or function by its name."""
    return attrgetter(name)(import_module(module))


def errand() -> Callable[..., str | Failure]:
    """What is given out.

    A nested function without a type of ours travels as code: the scheduler, which opens it, needs no copy of the repository.
    """
    def do(number: int, case: bytes, versions: str, topic: str) -> Any:
        from distributed import get_worker
        try:
            from studies.kit.errand import perform
        except ImportError as error:
            raise ImportError(f"worker {get_worker().address} does not find this repository ({error})") from None
        return perform(get_worker(), number, case, versions, topic)
    return do


def perform(worker: "Worker", number: int, sent: bytes, versions: str, topic: str) -> str | Failure:
    """Run a case with the code and the libraries of the study; its outcome as text.

    Checkpoints lie in a folder of the worker, as long as it lives.

    Raises
    ------
    ClusterError
        This worker cannot run it as the study would.
    """
    check_worker(worker, versions)
    case = unpacked(sent, worker)
    scratch = Path(worker.local_directory)/"cases"/case.key
    result = attempt(case, scratch, teller(worker, number, topic))
    if isinstance(result, str):
        shutil.rmtree(scratch)
        return result
    # a full disk is this worker's: it does not end the study
    return replace(result, message=f"{result.message} (on {worker.address})", disk_full=False)


def check_worker(worker: "Worker", versions: str) -> None:
    """Refuse a worker whose results or times would be others than those of the study's own processes."""
    if worker.state.nthreads != 1:
        raise ClusterError(f"worker {worker.address} runs {worker.state.nthreads} cases at once: it needs --nthreads 1")
    os.environ.setdefault("NUMBA_NUM_THREADS", "1")     # numba is loaded with the first case; Dask sets the others
    if more := [name for name in THREADS if os.environ.get(name) != "1"]:
        raise ClusterError(f"worker {worker.address} computes with more threads than one: it needs {'=1 '.join(more)}=1")
    if versions != provenance.versions():
        raise ClusterError(f"worker {worker.address} has {provenance.versions()}, the study {versions}")


def unpacked(sent: bytes, worker: "Worker") -> Case:
    """The case that was sent, if it means the same here."""
    read_code()
    try:
        case = pickle.loads(sent)
    except (ImportError, AttributeError, TypeError) as error:
        raise ClusterError(f"worker {worker.address} has other code than the study ({error})") from error
    read_code()
    if not same_code(case):
        raise ClusterError(f"worker {worker.address} has other code than the study: {case.label} has another key there")
    return case


def read_code() -> None:
    """Remember the code that is loaded: a worker lives long, and files that change later are not what it runs."""
    for path in filter(None, map(source.find, list(sys.modules))):
        source.parse(path)


def teller(worker: "Worker", number: int, topic: str) -> Report:
    """Tells the study the fraction done, once a second; ends the case when nobody waits for it."""
    task, told = worker.get_current_task(), -math.inf

    def report(fraction: float) -> None:
        nonlocal told
        known = worker.state.tasks.get(task)
        if known is None or known.state != "executing":
            raise Cancelled
        if time.monotonic() - told > TELL:
            told = time.monotonic()
            worker.log_event(topic, (number, float(fraction)))
    report(0.0)
    return report
