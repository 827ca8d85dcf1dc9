"""A repository of its own with one study, which is run as it is typed, and what waits for it."""
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from studies.kit import key

LIMIT = 180     # seconds after which something hangs: a run takes five on an idle machine


class Toy:
    """A copy of the kit, the study `toy` and a package of formulas in a folder."""

    def __init__(self, folder: Path, study: str, **formulas: str):
        self.folder = folder
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(key.ROOT/"studies/kit", folder/"studies/kit", ignore=ignored)
        (folder/"continuum").mkdir()
        (folder/"studies/toy.py").write_text(study)
        for name in ("studies/__init__", "continuum/__init__"):
            (folder/f"{name}.py").touch()
        for name, text in formulas.items():
            (folder/f"continuum/{name}.py").write_text(text)

    def start(self, *words: str, **environment: str) -> subprocess.Popen:
        """The study, in a group of its own, as Ctrl-C wants it."""
        return subprocess.Popen([sys.executable, "-m", "studies.toy", *words], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, **environment})

    def run(self, *words: str, **environment: str) -> tuple[int, str]:
        """Exit status and all that is printed."""
        return finish(self.start(*words, **environment))

    def log(self) -> list[list[str]]:
        """What cases wrote, a line each, since last asked."""
        path = self.folder/"log"
        lines = path.read_text().splitlines() if path.exists() else []
        return [line.split() for line in lines]

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
