"""A study as it is typed: workers, Ctrl-C, words that are wrong."""
import errno
import os
import signal
from dataclasses import replace

import pytest
from toy import CUBES, Cube, Toy, finish, until

from studies.kit import store, study
from studies.kit.claim import Claim
from studies.kit.figure import figure
from studies.kit.study import Study, main
from studies.kit.table import Table, read


def test_an_interrupted_study_goes_on_with_the_same_command(tmp_path):
    toy = Toy(tmp_path, "def wave(x):\n    return x**3\n")
    running = toy.start(OMP_NUM_THREADS="2")
    until(lambda: len(toy.began()) == 4 and toy.kept() == 3, running)
    assert toy.run()[1].startswith("toy: toy runs in results already: let it end, or give another --out")
    os.killpg(running.pid, signal.SIGINT)       # as Ctrl-C does: to the study and to its workers
    code, text = finish(running)
    assert code == 130 and "3 of 6 cases are finished and kept, the same command goes on from there" in text
    assert "Traceback" not in text and "KeyboardInterrupt" not in text
    assert sorted(toy.began()) == ["0.1", "1", "2", "3"], "4 and 5 time themselves: they wait for the others"
    assert {tuple(line[3:]) for line in toy.log()} == {("1", "deaf")}, "one thread each, the study has Ctrl-C"

    (tmp_path/"go").touch()
    (tmp_path/"log").unlink()
    code, text = toy.run()
    assert code == 0 and toy.began()[0] == "2" and sorted(toy.began()) == ["2", "4", "5"]
    assert "holds" in text and "measured 125 +- 0" in text
    assert list(read(tmp_path/"results/toy/waves.csv").y.round(3)) == [0.001, 1, 8, 27, 64, 125]
    assert (tmp_path/"results/toy/waves.png").exists()
    assert list(read(tmp_path/"results/claims.csv").verdict) == ["holds"]


@pytest.mark.parametrize(("words", "rule"), [
    (["--size", "huge"], "choose one of quick, paper, fine"), (["--workers", "0"], "at least 1, got 0"),
    (["bake"], "no command is called 'bake': there are run, figures, claims"),
    (["--onyl", "x"], "no option is called --onyl; near to it are --only")])
def test_what_is_not_understood_is_said_before_anything_runs(words, rule, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(Study(name="toy", cases=lambda size: pytest.fail("ran"), tables=[]), words)
    assert rule in capsys.readouterr().err


def derive(tables):
    """Each row halved, and the sum of all."""
    frame = tables["cubes"]
    halves = [{"x": row.x, "half": row.y/2} for row in frame.itertuples()]
    return {"halves": [*halves, {"x": -1, "half": frame.y.sum()}]}


def drawn(tables):
    page, axes = figure()
    axes.plot(tables["cubes"].x, tables["cubes"].y)
    return {"cubes": page}


STUDY = Study(name="toy", cases=lambda size: [Cube(x=1.0), Cube(x=1/3), Cube(x=7.0, name="Quartic")],
              derive=derive, figures=drawn,
              tables=[CUBES, Table("halves", key=["x"], columns=["x", "half"], about="a test"),
                      Table("never", key=["x"], columns=["x"], about="a test")],
              claims=[Claim(id="grows", source="KHP95, Sec. V", statement="cubes grow", at_least=1,
                            because="1 is there", value=lambda tables: (tables["cubes"].y.max(), 0.0))])


@pytest.mark.parametrize(("kind", "name"), [("tables", "cubes"), ("claims", "grows")])
def test_two_things_of_one_name_are_refused_when_a_study_is_made(kind, name):
    one, *_ = getattr(STUDY, kind)
    with pytest.raises(ValueError, match=f"two {kind} of one study are called '{name}'"):
        replace(STUDY, **{kind: [one, one]})


@pytest.fixture
def typed(tmp_path, monkeypatch, capsys):
    """What a command does: exit status and all that it prints; its results are in tmp_path/results."""
    monkeypatch.delenv("SIZE", raising=False)
    monkeypatch.setattr(store, "RESULTS", tmp_path/"results")
    monkeypatch.chdir(tmp_path)

    def type_(*words, study=STUDY):
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
    assert "python -m studies toy --size fine --only quartic" in (toy/"cubes.csv").read_text()
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
    assert text == ("toy: no case of size paper has 'quintic' in its label; near to it are Quartic; "
                    "SIZE=fine has more; the first labels are: "
                    "Cube 1 plain; Cube 0.333333 plain; Cube 7 Quartic\n")
    code, text = typed("figures", "--only", "plain")
    assert code == 2 and "--only chooses what to run, figures reads whole tables" in text


OWN = replace(STUDY, own=study.Own(
    cases=lambda text, rows, seeds: [Cube(x=float(rows + seed), name=text) for seed in range(seeds)],
    beside=lambda cases, *both: [f"{len(cases)} cases, rows {[len(tables['cubes']) for tables in both]}"]))


def test_rows_try_out_a_method_beside_the_tables_which_stay_as_they_are(typed, tmp_path):
    typed()
    before = {path: path.read_bytes() for path in (tmp_path/"results").rglob("*") if path.is_file()}
    code, text = typed("--only", "mine", "--rows", "16", "--seeds", "2", study=OWN)
    assert code == 0 and "2 cases, rows [2, 3]" in text and "figure" not in text and "holds" not in text
    assert text.endswith("all of it is in results/own, what is in results stays as it is\n")
    assert {path: path.read_bytes() for path in before} == before
    own = tmp_path/"results/own/toy/cubes.csv"
    assert list(read(own).x) == [16, 17] and "--only mine\n" in own.read_text()


@pytest.mark.parametrize(("tried", "words", "rule"), [
    (OWN, ["--rows", "7", "--only", "a"], "--rows must be at least 8, got 7"),
    (OWN, ["--rows", "16", "--seeds", "0", "--only", "a"], "--seeds 0: give 1 or more"),
    (OWN, ["--rows", "16"], "give --only TEXT, too"),
    (OWN, ["--only", "a", "--seeds", "2"], "and --rows, too"),
    (STUDY, ["--rows", "16", "--only", "plain"], "leave --rows out, --size chooses among them")])
def test_rows_that_cannot_run_are_one_line(typed, tried, words, rule):
    code, text = typed(*words, study=tried)
    assert code == 2 and rule in text.splitlines()[-1]


def test_quick_leaves_the_tables_of_other_sizes_alone(typed, tmp_path):
    typed("--size", "paper")
    before = {path: path.read_bytes() for path in (tmp_path/"results").rglob("*") if path.is_file()}
    code, text = typed("--size", "quick")
    assert code == 0
    assert text.endswith("all of it is in results/quick, what is in results stays as it is\n")
    for command in ("figures", "claims"):
        assert typed(command, "--size", "quick")[0] == 0
    quick = tmp_path/"results/quick"
    assert {path: path.read_bytes() for path in before} == before
    assert {path.name for path in (quick/"toy").iterdir()} == {"cubes.csv", "halves.csv", "cubes.png"}
    assert (quick/"claims.csv").exists() and len(list((quick/"raw/toy").glob("*.json"))) == 3
    assert STUDY.run("quick", workers=1, only="quartic").keys() == {"cubes", "halves"}
    assert sizes(quick/"toy/cubes.csv")[7] == "quick"
    assert {path: path.read_bytes() for path in before} == before


@pytest.mark.parametrize(("words", "folder"), [
    ([], "results/toy"), (["--size", "quick"], "results/quick/toy"), (["--out", "here"], "here/toy")])
@pytest.mark.parametrize("command", ["figures", "claims"])
def test_without_tables_nothing_is_drawn_or_judged(typed, tmp_path, command, words, folder):
    code, text = typed(command, *words)
    assert (code, text) == (1, f"toy: no table in {folder}: run the study first\n")
    assert not list(tmp_path.iterdir())


def test_an_out_that_is_no_folder_is_one_line(typed, tmp_path):
    (tmp_path/"file").touch()
    for out, words in (("file", "File exists: 'file'"), ("file/below", "Not a directory: 'file/below'")):
        code, text = typed("--out", out)
        assert code == 2 and text.splitlines()[-1].endswith(words)


def test_what_cannot_be_written_is_one_line(typed, monkeypatch):
    def refused(*arguments):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "claims.csv")
    monkeypatch.setattr(study, "put_claims", refused)
    code, text = typed()
    assert code == 1 and text.splitlines()[-1] == "toy: [Errno 28] No space left on device: 'claims.csv'"
