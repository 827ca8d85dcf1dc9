"""Worker processes: one that dies takes its own case along and nothing else, and none outlives the study."""
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from toy import until

from studies.kit import key
from studies.kit.case import Case, Outcome
from studies.kit.dispatch import Processes, dispatch
from studies.kit.store import CannotRun, kept


@dataclass(frozen=True, kw_only=True)
class Step(Case):
    """Waits until told to go on by a file, or dies; notes its process."""
    x: float
    folder: str
    waits: str = ""
    dies: bool = False

    def run(self, report, folder):
        (Path(self.folder)/f"pid-{self.x:g}").write_text(str(os.getpid()))
        while self.waits and not (Path(self.folder)/self.waits).exists():
            time.sleep(0.02)
        if self.dies:
            os._exit(9)
        return Outcome({"steps": [{"x": self.x}]})


class Fuse(str):
    """Name of a file with a letter for each process that it shall end as it is opened there."""

    def __reduce__(self):
        return opened, (str(self),)


def opened(name):
    left = Path(name).read_text()
    if left:
        Path(name).write_text(left[1:])
        os._exit(9)
    return Fuse(name)


def pid(folder, x):
    path = folder/f"pid-{x}"
    return int(path.read_text()) if path.exists() and path.read_text() else 0


def alive(pid):
    state = Path(f"/proc/{pid}/stat")
    return state.exists() and state.read_text().rpartition(")")[2].split()[0] != "Z"


def run(cases, folder, workers):
    return dispatch(cases, folder, "toy", lambda bar: Processes(workers, folder, bar))


def test_a_worker_that_dies_takes_along_no_case_of_another(tmp_path):
    """The second waits for the first to be dead and the third, which a new worker runs, to be done."""
    first, *others = cases = [Step(x=1.0, folder=str(tmp_path), dies=True), Step(x=3.0, folder=str(tmp_path)),
                              Step(x=2.0, folder=str(tmp_path), waits="pid-3")]
    failure, = run([first, others[1], others[0]], tmp_path/"raw", 2)
    assert failure.label == first.label
    assert "its worker process died, perhaps for want of memory" in failure.message
    assert [kept(case, tmp_path/"raw") is None for case in cases] == [True, False, False]
    assert not any(alive(pid(tmp_path, x)) for x in (1, 2, 3))


def test_a_case_whose_worker_dies_at_its_start_gets_another_one_and_fails_after_the_third(tmp_path):
    for name, left in (("once", "x"), ("ever", "x"*9)):
        (tmp_path/name).write_text(left)
    cases = [Step(x=float(x), folder=str(tmp_path), waits=Fuse(tmp_path/name) if name else "")
             for x, name in enumerate(("", "once", "ever", ""))]
    failure, = run(cases, tmp_path/"raw", 1)
    assert failure.label == cases[2].label and failure.message.startswith("3 worker processes died before")
    assert [kept(case, tmp_path/"raw") is None for case in cases] == [False, False, True, False]
    assert (tmp_path/"ever").read_text() == "x"*6


def test_workers_that_end_before_they_begin_a_case_are_told(tmp_path, monkeypatch):
    elsewhere = [path for path in sys.path if Path(path).name != "tests"]       # no `Step` there
    monkeypatch.setattr(sys, "path", elsewhere)
    with pytest.raises(CannotRun, match="worker processes end before they run a case: --workers 1 shows why"):
        run([Step(x=1.0, folder=str(tmp_path))], tmp_path, 1)


def test_a_study_that_is_killed_leaves_no_workers_and_keeps_what_is_finished(tmp_path):
    script = tmp_path/"study.py"
    script.write_text(f"""
import sys
from pathlib import Path
sys.path[:0] = [{str(key.ROOT/"tests")!r}, {str(key.ROOT)!r}]
from test_kit_processes import Step, run

folder = Path({str(tmp_path)!r})
if __name__ == "__main__":
    run([Step(x=1.0, folder=str(folder)), Step(x=2.0, folder=str(folder), waits="never")], folder, 1)
""")
    study = subprocess.Popen([sys.executable, script])
    until(lambda: pid(tmp_path, 2), study)
    assert alive(pid(tmp_path, 2))
    study.kill()
    study.wait()
    until(lambda: not alive(pid(tmp_path, 2)))
    assert len(list(tmp_path.glob("*.json"))) == 1
