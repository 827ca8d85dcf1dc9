"""Tables keep the better row and read back as written; verdicts mean what they say."""
import errno
import gzip
import math
import os
import time
from concurrent.futures import ThreadPoolExecutor

import pandas as pd
import pytest

from studies.kit import claim as claims
from studies.kit import csvfile
from studies.kit.claim import CannotTell, Claim, judge, put_claims, verdict
from studies.kit.table import Table, Tables, changed, merge, read
from studies.kit.value import WrongQuestion

SQUARES = Table("squares", key=["x", "note"], columns=["x", "note", "y"], about="a test")


def row(x, y, note="", **more):
    return {"x": x, "note": note, "y": y, **more}


def test_a_row_of_a_better_size_stays_and_equal_sizes_take_the_newer(tmp_path):
    path = tmp_path / "squares.csv"
    merge(path, SQUARES, [row(1/3, 1.0), row(2, 1.0)], size="paper")
    merge(path, SQUARES, [row(2, 2.0), row(3, 2.0)], size="fine")
    frame, better = merge(path, SQUARES, [row(1/3, 3.0), row(2, 3.0), row(4, 3.0)], size="paper")
    assert better == 1
    assert list(zip(frame.x.round(2), frame.y, frame["size"])) == [
        (0.33, 3.0, "paper"), (2, 2.0, "fine"), (3, 2.0, "fine"), (4, 3.0, "paper")]


def test_empty_text_reads_back_as_text_and_numbers_as_numbers(tmp_path):
    path = tmp_path / "squares.csv"
    merge(path, SQUARES, [row(math.inf, None, seed=3), row(2, 1e-7), row(2, 5.0, "a")], size="quick")
    for frame in (read(path), read(path, SQUARES.columns)):
        assert list(frame.note) == ["", "a", ""] and list(frame.x) == [2, 2, math.inf]
        assert list(frame.y[:2]) == [1e-7, 5.0] and math.isnan(frame.y[2])
        assert frame.seed[2] == 3
    assert list(pd.read_csv(path, comment="#").note) == ["(none)", "a", "(none)"]
    head = path.read_text().split("x,note")[0]
    assert all(word in head for word in ("# commit", "numpy", "numba", "py-pde", "cores", "UTC"))


def test_a_commit_of_digits_alone_is_written_in_full(monkeypatch):
    csvfile.commit.cache_clear()
    answers = {"--short=10": "12345e6789", "HEAD": "12345e6789f"}
    monkeypatch.setattr(csvfile, "git", lambda *words: answers.get(words[1], ""))
    assert csvfile.commit() == "12345e6789f"
    csvfile.commit.cache_clear()


RUNS = Table("runs", key=["who", "ra", "t"], columns=["who", "ra", "t", "ke", "kind"], large=True,
             digits={"t": ".3g", "ke": ".4f"}, about="a test")


def long(**more):
    return [{"who": who, "ra": ra, "t": t/3, "ke": -1e-9 if t == 3 else math.pi*t, "kind": ""
             if t == 2 else "a", **more}
            for who in ("spam", "dih") for ra in (1e4, 2.5e3, math.inf) for t in (3, 2, 1)]


def test_large_tables_keep_the_digits_they_need_and_are_packed(tmp_path):
    assert RUNS.file == "runs.csv.gz" and SQUARES.file == "squares.csv"
    path = tmp_path/RUNS.file
    frame, _ = merge(path, RUNS, long(), size="paper")
    end = f"paper,{frame.commit[0]}"
    lines = gzip.decompress(path.read_bytes()).decode().splitlines()
    assert lines[-18:-15] == [f"dih,2500,0.333,3.1416,a,{end}", f"dih,2500,0.667,6.2832,(none),{end}",
                              f"dih,2500,1,0,a,{end}"]            # not -0
    assert frame.kind.tolist() == ["a", "", "a"]*6 and (frame["size"] == "paper").all()
    pd.testing.assert_frame_equal(read(path, RUNS.columns), frame)
    pd.testing.assert_frame_equal(pd.read_csv(path, comment="#").replace("(none)", ""), frame)
    head = [line[2:] for line in lines if line[0] == "#" and "text columns" not in line]
    csvfile.write(tmp_path/"again.csv.gz", frame, head=head)
    assert (tmp_path/"again.csv.gz").read_bytes() == path.read_bytes(), "no time or name in it"


def test_rows_that_differ_in_digits_that_are_not_kept_are_the_same(tmp_path):
    path = tmp_path/RUNS.file
    merge(path, RUNS, long(), size="paper")
    text = path.read_bytes()
    close = [{**row, "t": row["t"]*(1 + 1e-6), "ke": row["ke"] + 1e-6} for row in long()]
    assert changed(path, RUNS, close) == []
    merge(path, RUNS, close, size="paper", command="something else")
    assert path.read_bytes() == text
    frame, _ = merge(path, RUNS, [{**long()[0], "ke": 0.5}], size="fine")
    fine, = frame[frame["size"] == "fine"][RUNS.columns].to_numpy().tolist()
    assert len(frame) == 18 and fine == ["spam", 1e4, 1.0, 0.5, "a"]


PLAIN, PACKED = "squares.csv", "squares.csv.gz"


@pytest.mark.parametrize(("name", "content", "words"), [
    (PLAIN, b"", "is no table"), (PLAIN, b"a,b\n1,2\n3,4,5,6\n", "is no table"),
    (PLAIN, b"\xff\xfe\x00", "is no table"),
    (PLAIN, b"# text columns: note\nx,note,y\n1,one,2\nabc,one,2\n", "is no table .*abc"),
    (PLAIN, b"x,note\n1,one\n", "has no column y: it has an older layout"),
    (PACKED, b"x,note,y\n1,one,2\n", "is no table"),
    (PACKED, gzip.compress(b"x,note,y\n1,one,2\n", mtime=0)[:-9], "is no table")])
def test_a_file_that_is_no_table_is_told_with_the_way_out(tmp_path, name, content, words):
    path = tmp_path/name
    path.write_bytes(content)
    with pytest.raises(csvfile.OtherTable, match=f"{name} {words}.*remove it and run the study again"):
        read(path, SQUARES.columns)
    with pytest.raises(FileNotFoundError, match=f"make study-{tmp_path.name} writes it"):
        read(tmp_path/"energy.csv")


def test_a_table_does_not_depend_on_the_order_of_rows_and_stays_when_nothing_changed(tmp_path):
    one, two, rows = tmp_path / "one.csv", tmp_path / "two.csv", [row(x, x*x/7) for x in (3, 1, 2)]
    for path, order in ((one, rows), (two, rows[::-1])):
        merge(path, SQUARES, order, size="quick")
    assert one.read_text() == two.read_text()
    text = one.read_text()
    merge(one, SQUARES, rows, size="quick", command="something else")
    assert one.read_text() == text


def test_no_rows_leave_a_table_as_it_is_or_make_an_empty_one_that_takes_rows_later(tmp_path):
    path = tmp_path / "squares.csv"
    frame, better = merge(path, SQUARES, [], size="paper")
    assert (len(frame), better) == (0, 0) and list(frame.columns) == ["x", "note", "y", "size", "commit"]
    merge(path, SQUARES, [row(2, 4.0)], size="paper")
    text = path.read_text()
    frame, better = merge(path, SQUARES, [], size="fine", command="something else")
    assert (list(frame.x), list(frame.note), better) == ([2], [""], 0) and path.read_text() == text


@pytest.mark.parametrize(("rows", "words"), [
    ([row(1, 1), row(1.0, 2)], "two rows of table squares have the key 1"),
    ([row(1, 1, speed=3)], "has no column speed"),
    ([{"note": "", "y": 1}], "lack x"),
    ([row("ten", 1), row(2, 1)], "mixes numbers with text such as 'ten'"),
    *(([row(1, 1, text)], f"the text '{text}', which reads back") for text in ("nan", "1e3", "NA", "True")),
    ([row(1, 1, "no. #2")], "begins a comment")])
def test_rows_that_do_not_fit_are_refused(tmp_path, rows, words):
    with pytest.raises((ValueError, TypeError), match=words):
        merge(tmp_path / "squares.csv", SQUARES, rows, size="quick")


def test_a_table_that_cannot_be_written_stays_as_it_was(tmp_path, monkeypatch):
    path = tmp_path / "squares.csv"
    merge(path, SQUARES, [row(1, 1)], size="quick")
    text = path.read_text()

    def full(file):
        raise OSError(errno.ENOSPC, "No space left on device")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        merge(path, SQUARES, [row(1, 2)], size="quick")
    assert path.read_text() == text and [p.name for p in tmp_path.iterdir()] == ["squares.csv"]


# --- claims ---------------------------------------------------------------------------------------

def claim(**more):
    base = dict(source="KHP95, Sec. V", statement="K is 1", printed="1.0", value=lambda tables: (1.0, 0.1))
    return Claim(**{"id": "c", "because": "one printed digit", **base, **more})


@pytest.mark.parametrize(("limits", "value", "err", "expected"), [
    ({"expect": 1.0, "within": 0.5}, 1.25, 0.25, "holds"),             # the interval just fits
    ({"expect": 1.0, "within": 0.5}, 1.25, 0.5, "undecidable"),        # inside, but not known to be
    ({"expect": 1.0, "within": 0.5}, 1.75, 0.5, "undecidable"),        # outside, but not known to be
    ({"expect": 1.0, "within": 0.5}, 1.75, 0.125, "fails"),
    ({"expect": 1.0, "within": 0.5}, 0.25, 0.125, "fails"),
    ({"expect": 1.0, "within": 0.5}, 1.0, 9.0, "undecidable"),         # knows nothing
    ({"at_least": 2.0}, 2.5, 0.5, "holds"), ({"at_least": 2.0}, 2.5, 0.75, "undecidable"),
    ({"at_least": 2.0}, 1.0, 0.5, "fails"), ({"at_most": 2.0}, 1.0, 0.5, "holds"),
    ({"at_most": 2.0}, 3.0, 0.5, "fails"), ({"at_least": 1.0, "at_most": 2.0}, 1.5, 0.25, "holds"),
    ({"expect": 1.0, "within": 0.5}, math.nan, 0.1, "undecidable"),
    ({"expect": 1.0, "within": 0.5}, 9.0, math.nan, "undecidable")])
def test_a_verdict_needs_the_whole_interval(limits, value, err, expected):
    assert verdict(claim(**limits), value, err) == expected


@pytest.mark.parametrize(("wrong", "words"), [
    ({"because": " "}, "no reason for its tolerance"), ({"source": "a friend"}, "not a citation"),
    ({"value": None}, "no value"), ({"within": None}, "give expect= with within="),
    ({"at_least": 1.0}, "give expect= with within="), ({"within": -1.0}, ">= 0"),
    ({"undecidable": "not printed"}, "keep one of them")])
def test_a_claim_without_source_reason_or_limits_is_refused(wrong, words):
    with pytest.raises(ValueError, match=words):
        claim(**{"expect": 1.0, "within": 0.5, **wrong})


def test_claims_of_other_studies_stay(tmp_path):
    path, limits = tmp_path / "claims.csv", {"expect": 1.0, "within": 0.5}

    def cannot(tables):
        raise CannotTell("run SIZE=paper")
    old = [claim(id="a", **limits), claim(id="b", source="de Vahl Davis (1983)", value=cannot, **limits)]
    put_claims(path, judge(old, Tables(), "rb"))
    put_claims(path, judge([claim(id="z", **limits)], Tables(), "speed"))
    open_claim = Claim(id="d", source="RR98, Eq. 5", statement="smooth", undecidable="no number is printed")
    put_claims(path, judge([old[1], open_claim], Tables(), "rb"))
    frame = read(path)
    assert tuple(frame.columns) == claims.COLUMNS
    assert list(frame.low.dropna()) == list(frame.low[frame.id.isin(["b", "z"])]) == [0.5, 0.5]
    assert list(zip(frame.study, frame.id, frame.verdict, frame.reason)) == [
        ("rb", "b", "undecidable", "run SIZE=paper"), ("rb", "d", "undecidable", "no number is printed"),
        ("speed", "z", "holds", "accepted 1 +- 0.5: one printed digit")]


def test_studies_that_judge_at_once_keep_the_claims_of_each_other(tmp_path, monkeypatch):
    def slow(*words):
        frame = read(*words)
        time.sleep(0.05)
        return frame
    path, names = tmp_path/"claims.csv", ["cost", "noise", "rb"]
    put_claims(path, judge([claim(id="a", expect=1.0, within=0.5)], Tables(), "onset"))
    monkeypatch.setattr(claims, "read", slow)
    with ThreadPoolExecutor() as pool:
        list(pool.map(lambda name: put_claims(path, judge([claim(id=name, expect=1.0, within=0.5)], Tables(),
                                                          name)), names))
    assert list(read(path).study) == ["cost", "noise", "onset", "rb"]


def test_a_claim_that_was_fixed_after_a_look_says_so_and_what_had_been_seen():
    limits = {"expect": 1.0, "within": 0.5}
    before, after = judge([claim(**limits), claim(after="two runs", **limits)], Tables(), "rb")
    assert (before["fixed"], after["fixed"]) == ("before", "after")
    assert after["reason"] == before["reason"] + "; asked after two runs"


@pytest.mark.parametrize("value", [
    lambda frame: frame["ke"].max(), lambda frame: frame.ke.max(),
    lambda frame: frame.query("ke > 1")["ra"].max(),
    lambda frame: frame[["ra", "ke"]].max().max(), lambda frame: frame.groupby("ke").size().max()])
def test_a_claim_that_asks_for_a_column_that_is_not_there_says_so(value):
    broken = claim(value=lambda tables: (value(tables["energy"]), 0.0), expect=1.0, within=0.5)
    with pytest.raises(WrongQuestion, match=r"study rb, claim c, .*\bke\b.*; correct the claim") as told:
        judge([broken], Tables(energy=pd.DataFrame({"ra": [1.0]})), "rb")
    assert "\n" not in str(told.value)


def test_a_mistake_of_a_claim_keeps_its_traceback_and_says_whose_it_is():
    with pytest.raises(ZeroDivisionError) as told:
        judge([claim(value=lambda tables: (1/0, 0.0), expect=1.0, within=0.5)], Tables(), "rb")
    assert told.value.__notes__ == ["while judging claim c"]
