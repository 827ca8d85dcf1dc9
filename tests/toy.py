"""A repository of its own with one study, which is run as it is typed, and what waits for it."""
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest

from studies.kit import key
from studies.kit.case import Case, Outcome
from studies.kit.table import Table

LIMIT = 180     # seconds after which something hangs: a run takes five on an idle machine
#: case 2 waits until told to go, 4 and 5 run alone
STUDY = '''
import os, signal, time
from dataclasses import dataclass
from typing import ClassVar
from continuum import law
from studies.kit.case import Case, Outcome
from studies.kit.claim import Claim
from studies.kit.figure import figure
from studies.kit.study import Study
from studies.kit.table import Table

def note(word, case):
    deaf = signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    with open("log", "a") as log:
        log.write(f"{word} {case.x:g} {os.getpid()} {os.environ['OMP_NUM_THREADS']} {'deaf'*deaf}\\n")

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
            return Outcome({"waves": [{"x": self.x, "y": self.law(self.x)}]})
        finally:
            note("end", self)

class Timed(Run):
    alone: ClassVar[bool] = True
    cost = 99.0

def cases(size):
    return [Timed(x=4.0), Timed(x=5.0), *(Run(x=x) for x in (0.1, 1., 2., 3.))]

def figures(tables):
    page, axes = figure()
    axes.plot(tables["waves"].x, tables["waves"].y)
    return {"waves": page}

claim = Claim(id="grows", source="KHP95, Sec. V", statement="waves grow", at_least=-9,
              value=lambda tables: (tables["waves"].y.max(), 0.0), because="a test")
STUDY = Study(name="toy", cases=cases, figures=figures, claims=[claim],
              tables=[Table("waves", key=["x"], columns=["x", "y"], about="a test")])
'''


class Toy:
    """A copy of the kit, the study `toy` and its formula in a folder."""

    def __init__(self, folder: Path, law: str):
        self.folder = folder
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(key.ROOT/"studies/kit", folder/"studies/kit", ignore=ignored)
        shutil.copy(key.ROOT/"studies/__main__.py", folder/"studies")
        files = {"studies/__init__": "", "studies/toy/__init__": STUDY,
                 "continuum/__init__": "", "continuum/law": law}
        for name, text in files.items():
            (folder/name).parent.mkdir(exist_ok=True)
            (folder/f"{name}.py").write_text(text)

    def start(self, *words: str, **environment: str) -> subprocess.Popen:
        """The study, in a group of its own, as Ctrl-C wants it."""
        return subprocess.Popen([sys.executable, "-m", "studies", "toy", *words], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, **environment})

    def run(self, *words: str, **environment: str) -> tuple[int, str]:
        """Exit status and all that is printed."""
        return finish(self.start(*words, **environment))

    def log(self) -> list[list[str]]:
        """What cases wrote, a line each."""
        path = self.folder/"log"
        lines = path.read_text().splitlines() if path.exists() else []
        return [line.split() for line in lines]

    def began(self) -> list[str]:
        """Cases that began, in order."""
        return [x for word, x, *_ in self.log() if word == "begin"]

    def kept(self) -> int:
        """How many cases are finished."""
        return len(list((self.folder/"results/raw/toy").glob("*.json")))


def finish(process: subprocess.Popen) -> tuple[int, str]:
    text = process.communicate(timeout=LIMIT)[0]
    return process.returncode, text


def until(true, running=None):
    """Wait for it, no longer than LIMIT and than a process runs that shall make it true."""
    end = time.monotonic() + LIMIT
    while not true():
        if running and running.poll() is not None:
            pytest.fail(running.communicate()[0])
        assert time.monotonic() < end, f"waited {LIMIT} s in vain"
        time.sleep(0.02)


@dataclass(frozen=True, kw_only=True)
class Cube(Case):
    """A case of a study that runs in this process."""
    x: float
    name: str = "plain"

    def run(self, report, folder):
        return Outcome({"cubes": [{"x": self.x, "y": self.x**3}]})


CUBES = Table("cubes", key=["x"], columns=["x", "y"], about="a test")
