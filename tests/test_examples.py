"""Every example is short, runs at a small size, and ends in a picture."""
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from examples.your_study import STUDY
from studies.kit.key import ROOT

EXAMPLES = sorted(path.stem for path in (ROOT/"examples").glob("[!_]*.py"))


@pytest.fixture
def small(tmp_path, monkeypatch):
    """Where pictures go, at the small size."""
    monkeypatch.setenv("SIZE", "quick")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.chdir(tmp_path)
    return tmp_path/"results"/"own"


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_short_and_ends_in_a_picture_that_it_names(name, small, capfd):
    assert len((ROOT/"examples"/f"{name}.py").read_text().splitlines()) < 40
    if name == "sweep":     # its workers import it anew
        subprocess.run([sys.executable, "-m", f"examples.{name}"], check=True, env=os.environ)
    else:
        runpy.run_path(str(ROOT/"examples"/f"{name}.py"), run_name="__main__")
    picture: Path = small/f"{name}.png"
    assert picture.stat().st_size > 3000 and f"picture: results/own/{name}.png" in capfd.readouterr().out


def test_the_study_to_copy_makes_its_table_figure_and_verdict(tmp_path):
    STUDY.run("quick", out=tmp_path, only="grid 1 ", workers=1)
    assert STUDY.draw(tmp_path) and [row["verdict"] for row in STUDY.judge(tmp_path)] == ["holds"]
