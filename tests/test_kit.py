"""Nothing finished is lost, nothing stale is taken for finished."""
import math
import multiprocessing
import re
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from studies.kit.case import Case, Outcome
from studies.kit.store import kept
from studies.kit.study import Study
from studies.kit.sweep import CasesFailed
from studies.kit.table import Table, read

SQUARES = Table("squares", key=["x", "note"], columns=["x", "note", "y"], about="a test")


class Lens(NamedTuple):
    power: float


EYE = Lens(2.0)


@dataclass(frozen=True, kw_only=True)
class Square(Case):
    x: float
    log: str = ""
    lens: Lens = EYE
    trouble: str = ""

    @property
    def cost(self) -> float:
        return 1 + self.x

    def run(self, report, folder):
        report(0.5)
        with open(self.log, "a") as log:
            log.write(f"{self.x:g} ")
        if self.trouble == "interrupt" and not (folder / "checkpoint").exists():
            (folder / "checkpoint").write_text("half")
            raise KeyboardInterrupt
        if self.trouble == "bug":
            raise ZeroDivisionError("x is off")
        return Outcome({"squares": [{"x": self.x, "note": "", "y": np.float64(self.x**2)}]})


class Bench:
    """A sweep in a folder of its own, in this process, that remembers what ran."""

    def __init__(self, folder: Path):
        self.folder, self.log = folder, folder / "log"

    def cases(self, *xs, **more):
        return [Square(x=float(x), log=str(self.log), **more) for x in xs]

    def sweep(self, cases, size="paper"):
        study = Study(name="toy", cases=lambda size: cases, tables=[SQUARES])
        return study.run(size, workers=1, out=self.folder)

    def ran(self):
        text = self.log.read_text() if self.log.exists() else ""
        self.log.unlink(missing_ok=True)
        return text.split()


@pytest.fixture
def bench(tmp_path):
    return Bench(tmp_path)


def test_a_finished_case_is_not_run_again_and_the_longest_starts_first(bench):
    first = bench.sweep(bench.cases(1, 3, 2, 3))
    assert bench.ran() == ["3", "2", "1"]
    second = bench.sweep(bench.cases(1, 2, 3, 4))
    assert bench.ran() == ["4"]
    assert list(first["squares"].y) == [1, 4, 9] and list(second["squares"].y) == [1, 4, 9, 16]


def test_an_interrupted_study_goes_on_where_it_stopped(bench):
    cases = bench.cases(3) + bench.cases(2, trouble="interrupt") + bench.cases(1)
    with pytest.raises(KeyboardInterrupt, match="1 of 3 cases are finished and kept, the same command"):
        bench.sweep(cases)
    assert bench.ran() == ["3", "2"]
    assert list(bench.sweep(cases)["squares"].y) == [1, 4, 9]
    assert bench.ran() == ["2", "1"], "the checkpoint of case 2 was there, case 3 was kept"
    assert not [path for path in (bench.folder / "raw/toy").iterdir() if path.is_dir()], "scratch folders go"


def test_a_study_that_is_killed_at_any_time_ends_with_the_same_tables(tmp_path):
    whole, killed = Bench(tmp_path/"whole"), Bench(tmp_path/"killed")
    cases = [Square(x=float(x), log="/dev/null") for x in range(40)]
    begin = time.monotonic()
    whole.sweep(cases)
    longest = time.monotonic() - begin
    for wait in np.random.default_rng(1).uniform(0, longest, 12):
        study = multiprocessing.get_context("fork").Process(target=killed.sweep, args=(cases,))
        study.start()
        time.sleep(wait)
        study.kill()
        study.join()
    killed.sweep(cases)
    # without the head, which has the date
    one, other = ((bench.folder/"toy/squares.csv").read_text().split("# text") for bench in (whole, killed))
    assert one[1] == other[1]


def test_a_kept_outcome_that_is_damaged_is_reported_and_run_again(bench, capsys):
    case, other = bench.cases(2, 3)
    bench.sweep([case, other])
    folder = bench.folder/"raw/toy"
    path, rows = folder/f"{case.key}.json", kept(case, folder)
    whole = path.read_bytes()
    flips = [bytes([*whole[:bit//8], whole[bit//8] ^ 1 << bit % 8, *whole[bit//8 + 1:]])
             for bit in range(8*len(whole))]
    unsealed = re.sub(rb',\s*"seal": "\w+"', b"", whole)
    assert unsealed != whole
    for damaged in (b"", b"[]", unsealed, (folder/f"{other.key}.json").read_bytes(), *flips):
        path.write_bytes(damaged)
        assert kept(case, folder) in (None, rows)       # a digit beyond the last of a float tells nothing
    path.write_bytes(unsealed)
    bench.ran(), capsys.readouterr()
    assert list(bench.sweep([case])["squares"].y) == [4, 9] and bench.ran() == ["2"]
    text = capsys.readouterr().err
    assert "cannot be read" in text and text.count("Square 2") == text.count("is run again") == 1


def test_a_case_that_raises_leaves_the_others_and_tells_where_the_story_is(bench):
    with pytest.raises(CasesFailed) as told:
        bench.sweep(bench.cases(1, 3) + bench.cases(2, trouble="bug"))
    text = str(told.value)
    story = Path(text.split("traceback: ")[1])
    assert "1 of 3 cases failed" in text and "ZeroDivisionError: x is off" in text
    assert "x is off" in story.read_text() and "in run" in story.read_text()
    assert list(read(bench.folder / "toy/squares.csv").y) == [1, 9]


def test_a_label_has_the_parameters_as_people_write_them():
    assert Square(x=0.1, log="b").label == "Square 0.1 b Lens(power=2) "


def test_the_key_of_a_case_is_that_of_its_parameters():
    base = Square(x=0.1)
    others = [base, replace(base, x=math.nextafter(0.1, 1)), replace(base, lens=Lens(3.0)),
              replace(base, log="b")]
    assert len({case.key for case in others}) == len(others)
    assert Square(x=0.1).key == base.key
    with pytest.raises(TypeError, match="a case cannot hold"):
        _ = replace(base, lens=lambda: 0).key
