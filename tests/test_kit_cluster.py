"""A study on a Dask cluster: a real one, of a scheduler and two workers on this machine, and what goes wrong with it.

A cluster takes seconds to start, so the tests of `toy` share one and run in their order, each from where the last one left it.
"""
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import pytest

from studies.kit import cluster, key, provenance
from studies.kit.case import Case, Outcome
from studies.kit.cluster import check_scheduler, check_worker, packed, unpacked
from studies.kit.processes import THREADS
from studies.kit.store import CannotRun
from studies.kit.study import Study, main
from studies.kit.table import Table, read

LIMIT = 180     # seconds after which something hangs: the whole file takes twenty on an idle machine
LAW = "import numpy as np\ndef wave(x):\n    return np.sin(np.arange(1, 9)*x/7).sum()\n"
OTHER = "def one():\n    return 1.0\n"
TOY = '''
import os, time
from dataclasses import dataclass
from typing import ClassVar
from continuum import law
from continuum import other
from studies.kit.case import Case, Outcome
from studies.kit.store import CannotRun
from studies.kit.study import Study, main
from studies.kit.table import Table

def note(word, case):
    with open("log", "a") as log:
        log.write(f"{word} {case.x:g} {os.getpid()} {os.environ['OMP_NUM_THREADS']}\\n")

@dataclass(frozen=True, kw_only=True)
class Run(Case):
    x: float
    law: object = law.wave
    def run(self, report, folder):
        note("begin", self)
        try:
            while self.x == 2 and not os.path.exists("go"):
                report(0.5)
                time.sleep(0.05)
            if self.x == 3 and os.path.exists("die"):
                os._exit(9)
            return Outcome({"waves": [{"x": self.x, "y": self.law(self.x)}]})
        finally:
            note("end", self)

class Timed(Run):
    alone: ClassVar[bool] = True
    cost = 99.0

@dataclass(frozen=True, kw_only=True)
class Late(Case):
    x: float
    def run(self, report, folder):
        return Outcome({"waves": [{"x": self.x, "y": other.one()}]})

def cases(size):
    return [Late(x=8.0), Late(x=9.0)] if size == "fine" else [Timed(x=4.0), Timed(x=5.0), *(Run(x=x) for x in (0.1, 1., 2., 3.))]

if __name__ == "__main__":
    main(Study(name="toy", cases=cases,
               tables=[Table("waves", key=["x"], columns=["x", "y"])]))
'''


class Toy:
    """A repository with one study: case 2 waits until told to go, 3 dies if told to, 4 and 5 run alone."""

    def __init__(self, folder: Path):
        self.folder, self.processes = folder, []
        shutil.copytree(key.ROOT / "studies/kit", folder / "studies/kit", ignore=shutil.ignore_patterns("__pycache__"))
        for name, text in {"studies/__init__": "", "studies/toy": TOY, "continuum/__init__": "", "continuum/law": LAW,
                           "continuum/other": OTHER}.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / f"{name}.py").write_text(text)
        # what the cluster's processes find besides is theirs, not this test's: nannies see to one thread
        self.outside = {name: value for name, value in os.environ.items()
                        if name not in ("PYTHONPATH", "SCHEDULER", "SIZE", *THREADS)}

    def dask(self, *words, cwd, **more):
        """One process of the cluster, what it says in a file; a scheduler allows one more try."""
        log = (self.folder / f"dask-{len(self.processes)}.txt").open("w")
        command = [Path(sys.executable).with_name("dask"), *words, "--no-dashboard", "--host", "127.0.0.1"]
        self.processes.append(subprocess.Popen(command, cwd=cwd, stdout=log, stderr=log, start_new_session=True, env={
            **self.outside, **more, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"}))

    def scheduler(self):
        """A scheduler that knows nothing of the repository."""
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()
        found = self.elsewhere / "scheduler.json"
        self.dask("scheduler", "--port", "0", "--scheduler-file", str(found), cwd=self.elsewhere)
        until(found.exists)
        self.address = json.loads(found.read_text())["address"]

    def workers(self):
        """Two workers, that nannies start again when they are killed."""
        for _ in range(2):
            self.dask("worker", self.address, "--nthreads", "1", "--local-directory", str(self.elsewhere), cwd=self.folder,
                      PYTHONPATH=str(self.folder))

    def end(self):
        for process in self.processes:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def start(self, *words, scheduler=True):
        to = {"SCHEDULER": self.address} if scheduler else {"OMP_NUM_THREADS": "1"}
        return subprocess.Popen([sys.executable, "-m", "studies.toy", *words], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, start_new_session=True, env={**self.outside, **to})

    def run(self, *words, **more):
        process = self.start(*words, **more)
        return self.finish(process)

    def finish(self, process):
        text = process.communicate(timeout=LIMIT)[0]
        return process.returncode, text

    def log(self):
        """What cases did since last asked."""
        path = self.folder / "log"
        return [tuple(line.split()) for line in path.read_text().splitlines()] if path.exists() else []

    def forget(self, *names):
        for name in ("log", *names):
            (self.folder / name).unlink(missing_ok=True)
        shutil.rmtree(self.folder / "results", ignore_errors=True)

    def waits(self, running, times=1):
        """The process in which case 2 waits, as soon as it has begun so many times."""
        until(lambda: self.began().count("2") == times, running)
        return [int(pid) for word, x, pid, _ in self.log() if (word, x) == ("begin", "2")][-1]

    def began(self):
        """Cases that began since last asked."""
        return [x for word, x, *_ in self.log() if word == "begin"]

    def kept(self):
        return len(list((self.folder / "results/raw/toy").glob("*.json")))


def until(true, running=None):
    """Wait for it, no longer than LIMIT and than a process runs that shall make it true."""
    end = time.monotonic() + LIMIT
    while not true():
        if running and running.poll() is not None:
            pytest.fail(running.communicate()[0])
        if time.monotonic() > end:
            pytest.fail(f"waited {LIMIT} s in vain")
        time.sleep(0.05)


def free_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


def body(path):
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


@pytest.fixture(scope="module")
def toy(tmp_path_factory):
    toy = Toy(tmp_path_factory.mktemp("cluster"))
    try:
        toy.scheduler()
        yield toy
    finally:
        toy.end()


def test_a_case_whose_worker_is_killed_is_run_again_and_the_rows_are_those_of_one_process(toy):
    running = toy.start()
    until(lambda: "Receive client connection" in (toy.folder / "dask-0.txt").read_text(), running)
    toy.workers()
    victim = toy.waits(running)
    until(lambda: toy.kept() == 3, running)     # what was finished there and not fetched would be run again, too
    os.kill(victim, signal.SIGKILL)
    assert toy.waits(running, times=2) != victim, "in another process, while the study goes on"
    (toy.folder / "go").touch()
    code, text = toy.finish(running)
    assert code == 0, text
    assert "the cluster has no worker: make worker" in text, "it waited for the first one"
    assert sorted(toy.began()) == ["0.1", "1", "2", "2", "3", "4", "5"]
    last = [(word, x) for word, x, *_ in toy.log()][-4:]
    assert last in ([("begin", "4"), ("end", "4"), ("begin", "5"), ("end", "5")],
                    [("begin", "5"), ("end", "5"), ("begin", "4"), ("end", "4")]), "one by one, after all others"
    assert {threads for *_, threads in toy.log()} == {"1"} and toy.kept() == 6
    table = toy.folder / "results/toy/waves.csv"
    assert "make study-toy SIZE=paper SCHEDULER=tcp://...\n" in table.read_text()

    assert toy.run("--workers", "1", "--out", "here", scheduler=False)[0] == 0
    assert body(table) == body(toy.folder / "here/toy/waves.csv") and len(body(table)) == 7
    mine, other = (sorted(path.name for path in (toy.folder / f"{out}/raw/toy").iterdir()) for out in ("results", "here"))
    assert mine == other, "the study keeps what comes back under the same keys, and no scratch folder"


def test_an_interrupt_ends_what_runs_on_the_cluster_and_keeps_what_is_finished(toy):
    toy.forget("go")
    running = toy.start()
    toy.waits(running)
    until(lambda: toy.kept() == 3, running)
    os.killpg(running.pid, signal.SIGINT)
    code, text = toy.finish(running)
    assert code == 130 and "3 of 6 cases are finished and kept, the same command goes on from there" in text
    assert "Traceback" not in text
    until(lambda: ("end", "2") in [(word, x) for word, x, *_ in toy.log()])
    assert not {"4", "5"} & set(toy.began()), "what times itself waits for the others"


def test_the_same_command_goes_on_and_neither_a_damaged_file_nor_a_deadly_case_costs_more_than_itself(toy):
    kept = {path: path.read_text() for path in (toy.folder / "results/raw/toy").iterdir() if path.suffix == ".json"}
    damaged = next(path for path, text in kept.items() if '"x": 1.0' in text)
    deadly = next(path for path, text in kept.items() if '"x": 3.0' in text)
    damaged.write_text("{\"rows\": ")
    deadly.unlink()
    for name in ("go", "die"):
        (toy.folder / name).touch()
    (toy.folder / "log").unlink()
    code, text = toy.run()
    (toy.folder / "die").unlink()
    assert code == 1 and f"{damaged.name} cannot be read" in text and text.count("is run again") == 1
    assert "1 of 6 cases failed" in text and "Run 3 wave: 2 workers died while they ran it" in text
    assert sorted(toy.began()) == ["1", "2", "3", "3", "4", "5"], "0.1 was kept"
    whole = body(toy.folder / "here/toy/waves.csv")
    assert body(toy.folder / "results/toy/waves.csv") == [line for line in whole if not line.startswith("3,")]


def test_a_worker_with_other_code_is_refused_and_the_tables_stay(toy):
    before = body(toy.folder / "results/toy/waves.csv")
    # one of the workers has loaded this file at least, and no case has made it read the file for its key yet
    (toy.folder / "continuum/other.py").write_text(OTHER.replace("1.0", "2.0"))
    code, text = toy.run("--size", "fine")
    assert code == 1 and "has other code than the study: Late " in text and "make worker SCHEDULER=tcp://..." in text
    assert "of 2 cases are finished and kept" in text and "Traceback" not in text
    assert body(toy.folder / "results/toy/waves.csv") == before


def test_a_scheduler_that_is_lost_ends_the_study(toy):
    toy.forget("go")
    running = toy.start()
    toy.waits(running)
    os.killpg(toy.processes[0].pid, signal.SIGKILL)
    code, text = toy.finish(running)
    assert code == 1 and "the connection to the scheduler was lost; " in text
    assert "cases are finished and kept, the same command goes on from there" in text


# --- in this process --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Cube(Case):
    x: float

    def run(self, report, folder):
        return Outcome({"cubes": [{"x": self.x, "y": self.x**3}]})


CUBES = Table("cubes", key=["x"], columns=["x", "y"])
STUDY = Study(name="toy", cases=lambda size: [Cube(x=1.0), Cube(x=2.0)], tables=[CUBES])
WORKER = SimpleNamespace(address="tcp://here:1", state=SimpleNamespace(nthreads=1))


def typed(*words):
    with pytest.raises(SystemExit) as ended:
        main(STUDY, words)
    return ended.value.code


def test_without_an_answer_nothing_is_lost(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cluster, "CONNECT", 0.5)
    nowhere = f"tcp://127.0.0.1:{free_port()}"
    assert typed("--workers", "1", "--out", str(tmp_path), "--only", "Cube 1") == 0
    before = (tmp_path / "toy/cubes.csv").read_text()
    capsys.readouterr()
    assert typed("--scheduler", nowhere, "--out", str(tmp_path)) == 1
    told = capsys.readouterr().err
    assert f"toy: no Dask scheduler answers at {nowhere} within 0.5 s: start one by dask scheduler, or leave SCHEDULER" in told
    assert "1 of 2 cases are finished and kept" in told and "Traceback" not in told
    assert (tmp_path / "toy/cubes.csv").read_text() == before
    assert list(STUDY.run("paper", workers=1, out=tmp_path)["cubes"].y) == [1, 8]
    typed("--scheduler", nowhere, "--out", str(tmp_path)), "all is kept: nobody is asked"


def test_without_the_package_the_way_out_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(CannotRun, match=r"needs the package distributed .*: make env installs it, .* without SCHEDULER"):
        STUDY.run("paper", out=tmp_path, scheduler="tcp://here:1")
    assert list(STUDY.run("paper", out=tmp_path, workers=1)["cubes"].y) == [1, 8]


@pytest.mark.parametrize("address", ["here:8786", "tcp://here", "http://here:8786", "8786"])
def test_what_is_no_address_is_said_before_anything_runs(address, capsys):
    assert typed("--scheduler", address) == 2
    assert f"SCHEDULER={address} is no address of a Dask scheduler: give tcp://host:port" in capsys.readouterr().err
    assert check_scheduler("tls://[::1]:8786") and check_scheduler("") == ""


@pytest.mark.parametrize(("threads", "environment", "versions", "words"), [
    (2, "1", None, "runs 2 cases at once: it needs --nthreads 1"),
    (1, "4", None, "computes with more threads than one: it needs OMP_NUM_THREADS=1 MKL_NUM_THREADS=1"),
    (1, "1", "python 2", "has python 3.* the study python 2")])
def test_a_worker_that_would_compute_otherwise_is_refused(threads, environment, versions, words, monkeypatch):
    for name in ("OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        monkeypatch.setenv(name, environment)
    worker = SimpleNamespace(address="tcp://here:1", state=SimpleNamespace(nthreads=threads))
    with pytest.raises(CannotRun, match=words):
        check_worker(worker, versions or provenance.versions())


def test_a_case_that_means_something_else_is_refused(monkeypatch):
    sent = packed(Cube(x=2.0))
    assert unpacked(sent, WORKER) == Cube(x=2.0)
    other = Cube(x=2.0)
    other.__dict__["key"] = "of other code"
    with pytest.raises(CannotRun, match=r"worker tcp://here:1 has other code than the study: Cube 2 has another key there"):
        unpacked(packed(other), WORKER)
    monkeypatch.delattr(sys.modules[__name__], "Cube")
    with pytest.raises(CannotRun, match=r"has other code than the study .*Cube"):
        unpacked(sent, WORKER)


def test_a_table_without_a_column_is_one_line_and_what_is_finished_stays(tmp_path, capsys):
    path = tmp_path / "toy/cubes.csv"
    path.parent.mkdir()
    path.write_text("# by hand\nx,z\n1,1\n")
    for command in ("run", "claims"):
        assert typed(command, "--workers", "1", "--out", str(tmp_path)) == 1
        told = capsys.readouterr().err
        assert told.splitlines()[-1] == (f"toy: {path} has no column y, size, commit: it has an older layout; remove it "
                                         "and run the study again: finished cases are kept").replace(
                                             ", size, commit" if command == "claims" else "", "")
    assert path.read_text() == "# by hand\nx,z\n1,1\n"
    path.unlink()
    assert typed("--scheduler", "tcp://nowhere:1", "--out", str(tmp_path)) == 0
    assert list(read(path).y) == [1, 8]
