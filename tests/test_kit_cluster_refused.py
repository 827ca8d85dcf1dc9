"""What goes wrong between a study and a Dask cluster, each said in a line; no cluster is started."""
import pickle
import socket
import sys
from types import SimpleNamespace

import pytest
import toy
from distributed import KilledWorker
from toy import CUBES, Cube

from studies.kit import cluster, csvfile, key
from studies.kit.cluster import check_scheduler, check_worker, unpacked
from studies.kit.dispatch import THREADS
from studies.kit.store import CannotRun
from studies.kit.study import Study, main


def test_the_scheduler_that_the_text_starts_listens_on_this_machine_alone():
    text = (key.ROOT/"results/README.md").read_text()
    assert text.count("dask scheduler") == text.count("dask scheduler --host 127.0.0.1 --no-dashboard`") == 1


STUDY = Study(name="toy", cases=lambda size: [Cube(x=1.0), Cube(x=2.0)], tables=[CUBES])
WORKER = SimpleNamespace(address="tcp://here:1", state=SimpleNamespace(nthreads=1))


def typed(*words):
    with pytest.raises(SystemExit) as ended:
        main(STUDY, words)
    return ended.value.code


def test_without_an_answer_nothing_is_lost(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cluster, "CONNECT", 0.5)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        nowhere = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    assert typed("--workers", "1", "--out", str(tmp_path), "--only", "Cube 1") == 0
    before = (tmp_path/"toy/cubes.csv").read_text()
    capsys.readouterr()
    assert typed("--scheduler", nowhere, "--out", str(tmp_path)) == 1
    text = capsys.readouterr().err
    assert f"toy: no Dask scheduler answers at {nowhere} within 0.5 s: start one by dask scheduler" in text
    assert "1 of 2 cases are finished and kept" in text and "Traceback" not in text
    assert (tmp_path/"toy/cubes.csv").read_text() == before
    assert list(STUDY.run("paper", workers=1, out=tmp_path)["cubes"].y) == [1, 8]
    assert typed("--scheduler", nowhere, "--out", str(tmp_path)) == 0, "all is kept: nobody is asked"


def ended(error: Exception, status: str) -> SimpleNamespace:
    """A future that has ended with an error."""
    def result():
        raise error
    return SimpleNamespace(result=result, status=status)


def test_a_scheduler_that_is_lost_ends_the_study_and_a_deadly_case_only_itself():
    with pytest.raises(CannotRun, match="the connection to the scheduler was lost"):
        cluster.outcome(ended(OSError("Timed out trying to connect"), "cancelled"), "Cube 1")
    killed = KilledWorker("task", SimpleNamespace(address="tcp://here:2"), 1)
    failure = cluster.outcome(ended(killed, "error"), "Cube 1")
    assert str(failure).startswith("  Cube 1: 2 workers died while they ran it, the last one tcp://here:2")


def test_without_the_package_the_way_out_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(CannotRun,
                       match=r"needs the package distributed .*: make .venv/ready-cluster installs it; wi"):
        STUDY.run("paper", out=tmp_path, scheduler="tcp://here:1")


@pytest.mark.parametrize("address", ["here:8786", "tcp://here", "http://here:8786", "8786"])
def test_what_is_no_address_is_said_before_anything_runs(address, capsys):
    assert typed("--scheduler", address) == 2
    text = capsys.readouterr().err
    assert f"SCHEDULER={address} is no address of a Dask scheduler: give tcp://host:port" in text
    check_scheduler("tls://[::1]:8786")


@pytest.mark.parametrize(("threads", "environment", "versions", "words"), [
    (2, "1", None, "runs 2 cases at once: it needs --nthreads 1"),
    (1, "4", None, "computes with more threads than one: it needs OMP_NUM_THREADS=1 MKL_NUM_THREADS=1"),
    (1, "1", "python 2", "has python 3.* the study python 2")])
def test_a_worker_that_would_compute_otherwise_is_refused(threads, environment, versions, words, monkeypatch):
    for name in THREADS:
        monkeypatch.setenv(name, environment if name.startswith(("OMP", "MKL")) else "1")
    worker = SimpleNamespace(address="tcp://here:1", state=SimpleNamespace(nthreads=threads))
    with pytest.raises(CannotRun, match=words):
        check_worker(worker, versions or csvfile.versions())


def test_a_case_that_means_something_else_is_refused(monkeypatch):
    case = Cube(x=2.0)
    case.__dict__["key"] = "of other code"
    sent = pickle.dumps(case)
    with pytest.raises(CannotRun, match=r"has other code than the study: Cube 2 plain has another key there"):
        unpacked(sent, WORKER)
    monkeypatch.delattr(toy, "Cube")
    with pytest.raises(CannotRun, match=r"has other code than the study .*Cube"):
        unpacked(sent, WORKER)
