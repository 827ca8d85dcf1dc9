"""A study as it is typed: workers, Ctrl-C, a worker that dies, code that changed, words that are wrong."""
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from studies.kit import source
from studies.kit.study import Study, main
from studies.kit.table import read

TOY = '''
import os, signal, time
from dataclasses import dataclass
from typing import ClassVar
from continuum import law
from studies.kit.case import Case, Outcome
from studies.kit.claim import Claim
from studies.kit.figure import figure
from studies.kit.study import Study, main
from studies.kit.table import Table

@dataclass(frozen=True, kw_only=True)
class Run(Case):
    x: float
    def run(self, report, folder):
        deaf = signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, [])
        with open("log", "a") as log:
            log.write(f"{self.x:g} {os.environ['OMP_NUM_THREADS']}{' deaf'*deaf}\\n")
        if self.x == 2 and not os.path.exists("go"):
            open("waiting", "w").close()
            time.sleep(60)
        if self.x == 3 and os.path.exists("die"):
            os._exit(9)
        return Outcome({"cubes": [{"x": self.x, "y": law.power(self.x)}]})

class Timed(Run):
    alone: ClassVar[bool] = True
    cost = 99.0

def figures(tables):
    page, axes = figure()
    axes.plot(tables["cubes"].x, tables["cubes"].y)
    return {"cubes": page}

claim = Claim(id="grows", source="KHP95, Sec. V", statement="cubes grow", at_least=8,
              value=lambda tables: (tables["cubes"].y.max(), 0.0), because="2 is in the table")
if __name__ == "__main__":
    main(Study(name="toy", cases=lambda size: [Timed(x=4.0), *(Run(x=x) for x in (0., 1., 2., 3.))],
               figures=figures, tables=[Table("cubes", key=["x"], columns=["x", "y"])], claims=[claim]))
'''


class Toy:
    """A repository with one study: case 2 waits until told to go, 3 dies if told to, 4 runs alone."""

    def __init__(self, folder: Path):
        self.folder = folder
        shutil.copytree(source.ROOT / "studies/kit", folder / "studies/kit",
                        ignore=shutil.ignore_patterns("__pycache__"))
        for name, text in {"studies/__init__": "", "studies/toy": TOY, "continuum/__init__": "",
                           "continuum/law": "def power(x):\n    return x**3\n"}.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / f"{name}.py").write_text(text)

    def start(self, *words):
        return subprocess.Popen([sys.executable, "-m", "studies.toy", *words], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, "OMP_NUM_THREADS": "2"})

    def run(self, *words):
        process = self.start(*words)
        text = process.communicate(timeout=60)[0]
        return process.returncode, text

    def ran(self):
        """Cases that ran since last asked, and how their workers were set up."""
        lines = (self.folder / "log").read_text().splitlines() if (self.folder / "log").exists() else []
        (self.folder / "log").unlink(missing_ok=True)
        return [line.split()[0] for line in lines], {line.split(" ", 1)[1] for line in lines}


def test_a_study_from_the_command_line(tmp_path):
    toy = Toy(tmp_path)

    process = toy.start()
    for _ in range(600):
        if (tmp_path / "waiting").exists() and len(list((tmp_path / "results/raw/toy").glob("*.json"))) == 3:
            break
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGINT)    # as Ctrl-C does: to the study and to its workers
    text = process.communicate(timeout=30)[0]
    assert process.returncode == 130
    assert "3 of 5 cases are finished and kept, the same command goes on from there" in text
    assert "Traceback" not in text and "KeyboardInterrupt" not in text
    ran, workers = toy.ran()
    assert sorted(ran) == ["0", "1", "2", "3"], "4 times itself: it waits for the others"
    assert workers == {"1 deaf"}, "one thread each, and Ctrl-C is left to the study"

    (tmp_path / "go").touch()
    code, text = toy.run()
    assert code == 0 and toy.ran()[0] == ["2", "4"]
    assert "holds" in text and "measured 64 +- 0" in text
    assert list(read(tmp_path / "results/toy/cubes.csv").y) == [0, 1, 8, 27, 64]
    assert (tmp_path / "results/toy/cubes.png").exists()
    assert list(read(tmp_path / "results/claims.csv").verdict) == ["holds"]

    (tmp_path / "continuum/law.py").write_text("def power(x):\n    return 2*x**3\n")
    (tmp_path / "die").touch()
    code, text = toy.run()
    ran = toy.ran()[0]
    assert code == 1 and ran.count("3") == 1 and ran[-1] == "4"
    assert "Run 3: its worker process died" in text
    (tmp_path / "die").unlink()
    code, text = toy.run()
    assert code == 0 and "3" in toy.ran()[0]
    assert list(read(tmp_path / "results/toy/cubes.csv").y) == [0, 2, 16, 54, 128], "other code"


@pytest.mark.parametrize(("words", "rule"), [(["--size", "huge"], "choose one of quick, paper, fine"),
                                             (["--workers", "0"], "at least 1, got 0"),
                                             (["bake"], "invalid choice: 'bake'")])
def test_what_is_not_understood_is_said_before_anything_runs(words, rule, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(Study(name="toy", cases=lambda size: pytest.fail("ran"), tables=[]), words)
    assert rule in capsys.readouterr().err
