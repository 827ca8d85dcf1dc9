"""A study as it is typed: workers, Ctrl-C, words that are wrong."""
import errno
import os
import signal
import time
from dataclasses import dataclass, replace

import pytest
from toy import Toy, finish, until

from studies.kit import dispatch, store, study
from studies.kit.case import Case, Outcome
from studies.kit.claim import Claim
from studies.kit.figure import figure
from studies.kit.study import Study, main
from studies.kit.table import Table, read

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
            log.write(f"{self.x:g} {os.environ['OMP_NUM_THREADS']} {'deaf'*deaf}\\n")
        while self.x == 2 and not os.path.exists("go"):
            time.sleep(0.05)
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
               tables=[Table("cubes", key=["x"], columns=["x", "y"], about="a test")],
               figures=figures, claims=[claim]))
'''


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_an_interrupt_that_python_drops_stops_the_study_all_the_same():
    """Exceptions in destructors are printed and forgotten."""
    class Bad:
        def __del__(self):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0)
    with dispatch.remember_interrupt():
        try:
            made = Bad()
            del made
        except KeyboardInterrupt:
            pytest.fail("it was not dropped: the test shows nothing")
        assert dispatch.pressed == [signal.SIGINT]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_interrupted_study_goes_on_with_the_same_command(tmp_path):
    toy = Toy(tmp_path, TOY, law="def power(x):\n    return x**3\n")
    running = toy.start(OMP_NUM_THREADS="2")
    until(lambda: len(toy.log()) == 4 and toy.kept() == 3, running)
    os.killpg(running.pid, signal.SIGINT)       # as Ctrl-C does: to the study and to its workers
    code, text = finish(running)
    assert code == 130 and "3 of 5 cases are finished and kept, the same command goes on from there" in text
    assert "Traceback" not in text and "KeyboardInterrupt" not in text
    ran, threads, deaf = zip(*toy.log())
    assert sorted(ran) == ["0", "1", "2", "3"], "4 times itself: it waits for the others"
    assert {*threads} == {"1"} and {*deaf} == {"deaf"}, "one thread each, and Ctrl-C is left to the study"

    (tmp_path/"go").touch()
    (tmp_path/"log").unlink()
    code, text = toy.run()
    assert code == 0 and [x for x, *_ in toy.log()] == ["2", "4"]
    assert "holds" in text and "measured 64 +- 0" in text
    assert list(read(tmp_path/"results/toy/cubes.csv").y) == [0, 1, 8, 27, 64]
    assert (tmp_path/"results/toy/cubes.png").exists()
    assert list(read(tmp_path/"results/claims.csv").verdict) == ["holds"]


@pytest.mark.parametrize(("words", "rule"), [
    (["--size", "huge"], "choose one of quick, paper, fine"), (["--workers", "0"], "at least 1, got 0"),
    (["bake"], "invalid choice: 'bake'")])
def test_what_is_not_understood_is_said_before_anything_runs(words, rule, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(Study(name="toy", cases=lambda size: pytest.fail("ran"), tables=[]), words)
    assert rule in capsys.readouterr().err


# --- in this process ------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Cube(Case):
    x: float
    name: str = "plain"

    def run(self, report, folder):
        return Outcome({"cubes": [{"x": self.x, "y": self.x**3}]})


def derive(tables):
    """Each row halved, and the sum of all."""
    frame = tables["cubes"]
    halves = [{"x": row.x, "half": row.y/2} for row in frame.itertuples()]
    return {"halves": [*halves, {"x": -1, "half": frame.y.sum()}]}


def drawn(tables):
    page, axes = figure()
    axes.plot(tables["cubes"].x, tables["cubes"].y)
    return {"cubes": page}


CUBES = Study(name="toy", cases=lambda size: [Cube(x=1.0), Cube(x=1/3), Cube(x=7.0, name="Quartic")],
              derive=derive, figures=drawn,
              tables=[Table("cubes", key=["x"], columns=["x", "y"], about="a test"),
                      Table("halves", key=["x"], columns=["x", "half"], about="a test"),
                      Table("never", key=["x"], columns=["x"], about="a test")],
              claims=[Claim(id="grows", source="KHP95, Sec. V", statement="cubes grow", at_least=1,
                            because="1 is there", value=lambda tables: (tables["cubes"].y.max(), 0.0))])


@pytest.fixture
def typed(tmp_path, monkeypatch, capsys):
    """What a command does: exit status and all that it prints; its results are in tmp_path/results."""
    monkeypatch.delenv("SIZE", raising=False)
    monkeypatch.setattr(store, "RESULTS", tmp_path/"results")
    monkeypatch.chdir(tmp_path)

    def type_(*words, study=CUBES):
        with pytest.raises(SystemExit) as ended:
            main(study, [*words, "--workers", "1"])
        said = capsys.readouterr()
        return ended.value.code, said.out + said.err
    return type_


def sizes(path):
    frame = read(path)
    return dict(zip(frame.x.round(2), frame["size"]))


def test_only_runs_what_has_the_text_in_its_label_and_leaves_other_rows_as_they_were(typed, tmp_path):
    toy = tmp_path/"results/toy"
    code, text = typed("--size", "fine", "--only", "quartic")
    assert code == 0 and list(read(toy/"cubes.csv").x) == [7], "Quartic, whatever the capitals"
    assert "python -m studies.toy --size fine --only quartic" in (toy/"cubes.csv").read_text()
    assert (toy/"cubes.png").exists() and "holds" in text

    (toy/"cubes.csv").unlink(), (toy/"halves.csv").unlink()
    assert typed("--only", "plain")[0] == 0
    assert sizes(toy/"cubes.csv") == {1: "paper", 0.33: "paper"}
    before = read(toy/"halves.csv")
    assert typed("--size", "fine", "--only", "quartic")[0] == 0
    assert sizes(toy/"cubes.csv") == {1: "paper", 0.33: "paper", 7: "fine"}
    # the sum has changed and 7 is new: what follows from rows that did not run is not called fine
    assert sizes(toy/"halves.csv") == {-1: "fine", 0.33: "paper", 1: "paper", 7: "fine"}
    assert list(read(toy/"halves.csv").half.round(6)) == [344.037037, 0.018519, 0.5, 171.5]
    assert len(before) == 3
    assert typed("--size", "fine")[0] == 0
    assert set(sizes(toy/"halves.csv").values()) == {"fine"}


def test_only_that_matches_nothing_names_labels_that_exist(typed, tmp_path):
    code, text = typed("--only", "quintic")
    assert code == 2 and not (tmp_path/"results/toy").exists()
    assert text == ("toy: no case of size paper has 'quintic' in its label; some of its 3 labels are: "
                    "Cube 1 plain; Cube 0.333333 plain; Cube 7 Quartic\n")
    code, text = typed("figures", "--only", "plain")
    assert code == 2 and "--only chooses what to run, figures reads whole tables" in text


OWN = replace(CUBES, own=study.Own(
    cases=lambda text, rows, seeds: [Cube(x=float(rows + seed), name=text) for seed in range(seeds)],
    beside=lambda cases, *both: [f"{len(cases)} cases, rows {[len(tables['cubes']) for tables in both]}"]))


def test_rows_try_out_a_method_beside_the_tables_which_stay_as_they_are(typed, tmp_path):
    typed()
    before = {path: path.read_bytes() for path in (tmp_path/"results").rglob("*") if path.is_file()}
    code, text = typed("--only", "mine", "--rows", "16", "--seeds", "2", study=OWN)
    assert code == 0 and "2 cases, rows [2, 3]" in text and "figure" not in text and "holds" not in text
    assert text.endswith("tried out: all of it is in results/own, what is in results stays as it is\n")
    assert {path: path.read_bytes() for path in before} == before
    own = tmp_path/"results/own/toy/cubes.csv"
    assert list(read(own).x) == [16, 17] and "--only mine --rows 16 --seeds 2\n" in own.read_text()
    assert typed("--only", "mine", "--rows", "16", "--keep", study=OWN)[0] == 0
    assert list(read(tmp_path/"results/toy/cubes.csv").x.round(2)) == [0.33, 1, 7, 16]


@pytest.mark.parametrize(("words", "rule"), [
    (["--rows", "7", "--only", "a"], "--rows must be at least 8, got 7"),
    (["--rows", "16", "--seeds", "0", "--only", "a"], "--seeds must be at least 1, got 0"),
    (["--rows", "16"], "give --only TEXT, too"), (["--only", "a", "--keep"], "give --rows, too")])
def test_rows_that_cannot_run_are_one_line(typed, words, rule):
    code, text = typed(*words, study=OWN)
    assert code == 2 and rule in text.splitlines()[-1]


def test_a_study_without_methods_to_try_out_says_so(typed):
    code, text = typed("--rows", "16", "--only", "plain")
    assert code == 2 and text.splitlines()[-1].endswith("leave --rows out, --size chooses among them")


def test_quick_leaves_the_tables_of_other_sizes_alone(typed, tmp_path):
    typed("--size", "paper")
    before = {path: path.read_bytes() for path in (tmp_path/"results").rglob("*") if path.is_file()}
    code, text = typed("--size", "quick")
    assert code == 0
    assert text.endswith("size quick: all of it is in results/quick, what is in results stays as it is\n")
    for command in ("figures", "claims"):
        assert typed(command, "--size", "quick")[0] == 0
    quick = tmp_path/"results/quick"
    assert {path: path.read_bytes() for path in before} == before
    assert {path.name for path in (quick/"toy").iterdir()} == {"cubes.csv", "halves.csv", "cubes.png"}
    assert (quick/"claims.csv").exists() and len(list((quick/"raw/toy").glob("*.json"))) == 3
    assert CUBES.run("quick", workers=1, only="quartic").keys() == {"cubes", "halves"}
    assert sizes(quick/"toy/cubes.csv")[7] == "quick"
    assert {path: path.read_bytes() for path in before} == before


@pytest.mark.parametrize(("words", "way"), [
    ([], "results/toy: run make study-toy first"),
    (["--size", "fine"], "results/toy: run make study-toy first"),
    (["--size", "quick"], "results/quick/toy: run make study-toy SIZE=quick first"),
    (["--out", "here"], "here/toy: run python -m studies.toy --size paper --out here first")])
@pytest.mark.parametrize("command", ["figures", "claims"])
def test_without_tables_nothing_is_drawn_or_judged(typed, tmp_path, command, words, way):
    code, text = typed(command, *words)
    assert (code, text) == (1, f"toy: no table in {way}\n") and not list(tmp_path.iterdir())


def test_an_out_that_is_no_folder_is_one_line(typed, tmp_path):
    (tmp_path/"file").touch()
    for command in ("run", "figures"):
        code, text = typed(command, "--out", "file")
        assert code == 2 and text.splitlines()[-1].endswith("error: --out file is a file: give a folder")
    code, text = typed("--out", "file/below")
    assert code == 2 and "--out file/below cannot be made (Not a directory): give another folder" in text


@pytest.mark.parametrize(("number", "words"), [
    (errno.EROFS, "claims.csv cannot be written: give --out another folder"),
    (errno.EACCES, "claims.csv cannot be written"), (errno.ENOSPC, "the disk is full")])
def test_what_cannot_be_written_is_one_line(typed, monkeypatch, number, words):
    def refused(*arguments):
        raise OSError(number, os.strerror(number), "claims.csv")
    monkeypatch.setattr(study, "put_claims", refused)
    code, text = typed()
    assert code == 1 and text.splitlines()[-1].startswith(f"toy: {words}")
