"""A study on a Dask cluster: a real one, of a scheduler and two workers on this machine, and what goes wrong.

A cluster takes seconds to start: the tests of `toy` share one, each goes on where the last one ended.
"""
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from toy import Toy, finish, until

from studies.kit.dispatch import THREADS

LAW = "import numpy as np\ndef wave(x):\n    return np.sin(np.arange(1, 9)*x/7).sum()\n"


class Clustered(Toy):
    """With the processes of a cluster."""

    def __init__(self, folder: Path):
        super().__init__(folder, LAW)
        self.processes: list[subprocess.Popen] = []
        self.elsewhere = folder/"elsewhere"     # the scheduler knows nothing of the repository
        self.elsewhere.mkdir()
        address = self.elsewhere/"scheduler.json"
        self.dask("scheduler", "--port", "0", "--scheduler-file", str(address), cwd=self.elsewhere)
        until(address.exists)
        self.address = json.loads(address.read_text())["address"]

    def dask(self, *words, cwd, **more):
        """One process of the cluster, what it says in a file."""
        log = (self.folder/f"dask-{len(self.processes)}.txt").open("w")
        command = [Path(sys.executable).with_name("dask"), *words, "--no-dashboard", "--host", "127.0.0.1"]
        # nannies see to one thread
        outside = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", *THREADS)}
        self.processes.append(subprocess.Popen(command, cwd=cwd, stdout=log, stderr=log,
                                               start_new_session=True, env={**outside, **more}))

    def workers(self):
        """Two workers, that nannies start again when they are killed."""
        for _ in range(2):
            self.dask("worker", self.address, "--nthreads", "1", "--local-directory", str(self.elsewhere),
                      cwd=self.folder, PYTHONPATH=str(self.folder))

    def end(self):
        for process in self.processes:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def waits(self, running, times=1):
        """The process in which case 2 waits, as soon as it has begun so many times."""
        until(lambda: self.began().count("2") == times, running)
        return [int(pid) for word, x, pid, *_ in self.log() if (word, x) == ("begin", "2")][-1]


def body(path):
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


@pytest.fixture(scope="module")
def toy(tmp_path_factory):
    toy = Clustered(tmp_path_factory.mktemp("cluster"))
    try:
        yield toy
    finally:
        toy.end()


def test_a_case_whose_worker_is_killed_is_run_again_and_an_interrupt_keeps_what_is_finished(toy):
    running = toy.start(SCHEDULER=toy.address)
    until(lambda: "Receive client connection" in (toy.folder/"dask-0.txt").read_text(), running)
    toy.workers()
    victim = toy.waits(running)
    until(lambda: toy.kept() == 3, running)     # what was not fetched would be run again, too
    os.kill(victim, signal.SIGKILL)
    assert toy.waits(running, times=2) != victim, "in another process, while the study goes on"
    os.killpg(running.pid, signal.SIGINT)
    code, text = finish(running)
    assert code == 130 and "3 of 6 cases are finished and kept, the same command goes on from there" in text
    assert "the cluster has no worker: make worker" in text, "it waited for the first one"
    assert "Traceback" not in text
    until(lambda: ["end", "2"] in [line[:2] for line in toy.log()])
    assert not {"4", "5"} & set(toy.began()), "what times itself waits for the others"


def test_the_same_command_goes_on_and_the_rows_are_those_of_one_process(toy):
    (toy.folder/"go").touch()
    (toy.folder/"log").unlink()
    code, text = toy.run(SCHEDULER=toy.address)
    assert code == 0, text
    words = [(word, x) for word, x, *_ in toy.log()]
    assert words[:2] == [("begin", "2"), ("end", "2")], "three were kept"
    four, five = ([("begin", x), ("end", x)] for x in ("4", "5"))
    assert words[2:] in (four + five, five + four), "one by one, after all others"
    assert {line[3] for line in toy.log()} == {"1"} and toy.kept() == 6
    table = toy.folder/"results/toy/waves.csv"
    assert "make study-toy SIZE=paper SCHEDULER=tcp://...\n" in table.read_text()
    assert toy.run("--workers", "1", "--out", "here", OMP_NUM_THREADS="1", SCHEDULER="")[0] == 0
    assert body(table) == body(toy.folder/"here/toy/waves.csv") and len(body(table)) == 7
    mine, other = ({path.name for path in (toy.folder/out/"raw/toy").iterdir()}
                   for out in ("results", "here"))
    assert mine == other, "the study keeps what comes back under the same keys, and no scratch folder"
