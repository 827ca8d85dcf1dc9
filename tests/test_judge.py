"""The judge praises what is good, and has a verdict for what is wrong, on each rung without a traceback."""
import pandas as pd
import pytest
import strangers

from studies.judge import ladder
from studies.judge.__main__ import main
from studies.judge.ladder import RUNGS, Take, climb, judged
from studies.judge.measures import convergence, right
from studies.judge.page import pace
from studies.kit.key import ROOT

QUICK = ["--rows", "8", "12", "--out"]


@pytest.fixture
def verdicts():
    """Of a class at 8 rows, by rung."""
    def of(method):
        takes = climb(method, (8,), 5.0)
        return {rung.name: judged(rung, takes).words for rung in RUNGS}
    return of


def test_the_example_is_judged_and_has_a_page(tmp_path, capsys):
    assert main(["examples.your_method:Cells", *QUICK, str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    for words in ("stays at rest", "keeps mass, momentum and energy", "repeats itself bit by bit",
                  "is stable up to 1.0", "couette: converges with order 2.0"):
        assert words in out
    assert "[16/16] rayleigh-benard, 12 rows:" in err
    page, table = (tmp_path/f"judge-Cells.{end}" for end in ("html", "csv"))
    # a picture may spell http, as one in forty does, but has no colon
    assert "data:image/png;base64,iVBOR" in page.read_text() and "://" not in page.read_text()
    assert 0.01 < pace() < 100       # else the star that stands for it is off the figure
    numbers = pd.read_csv(table, comment="#").query("rung == 'couette' and quantity == 'error'")["value"]
    assert numbers.iloc[1] == pytest.approx(numbers.iloc[0]*(8/12)**2, rel=0.05)


def test_steps_of_ones_own_climb_the_same_ladder(verdicts):
    told = verdicts(strangers.Heun)
    assert told["contract"] == "has all that a run asks for"
    assert told["repeat"] == "repeats itself bit by bit"
    assert told["rayleigh-benard"].startswith("K is 1.4 % high")     # as the example's


def test_a_wrong_shape_is_told_with_the_right_one(verdicts):
    told = verdicts(strangers.Transposed)
    assert "fields gives v of shape (2, 64) where rho has 64 points: it must be (64, 2)" in told["contract"]
    assert all("Error" in words for name, words in told.items() if name not in ("contract", "repeat"))
    assert told["repeat"] == "repeats itself bit by bit"     # asks for states alone


def test_what_diverges_is_told_with_step_and_value(verdicts):
    told = verdicts(strangers.Hasty)
    assert told["contract"] == "has all that a run asks for"
    assert "step" in told["conservation"] and "rho = " in told["conservation"]
    assert told["step"].startswith("claims too long a step: is stable up to 0.07 of")
    assert all(take.fault.startswith("left out") for take in climb(strangers.Hasty, (8,), 0.0))


def test_dice_are_found_out(verdicts):
    told = verdicts(strangers.Dicing)
    assert told["repeat"].startswith("is not deterministic: two runs of one seed differ by")
    assert told["rest"].startswith("trembles at rest")
    assert "does not keep" in told["conservation"]


def test_what_lacks_fields_is_told_so_has_a_page_and_ends_with_1_as_the_help_says(tmp_path, capsys):
    assert main(["strangers:NoFields", "--rows", "8", "--out", str(tmp_path)]) == 1
    out = capsys.readouterr().out
    assert "contract: Breach: lacks fields(state), which gives Fields(x, v, rho, T, V)" in out
    assert "NoFields' object has no attribute 'fields'" in out
    assert (tmp_path/"judge-NoFields.html").exists()
    with pytest.raises(SystemExit):
        main(["--help"])
    assert "1 if none is" in " ".join(capsys.readouterr().out.split())


def test_a_ladder_that_is_stopped_says_so(tmp_path, capsys, monkeypatch):
    def stop(self, state, out):
        raise KeyboardInterrupt
    monkeypatch.setattr(strangers.Transposed, "rates", stop)
    assert main(["strangers:Transposed", *QUICK, str(tmp_path)]) == 130
    assert "stopped" in capsys.readouterr().err and not list(tmp_path.iterdir())


def test_what_is_unstable_comes_first_and_nothing_is_told_twice():
    takes = [Take(rung.name, 8, {}, 1.0, "rho = -1") for rung in RUNGS if rung.name != "step"]
    takes.append(Take("step", 8, {"claimed": 1.0, "share": float("nan"), "grows": 1.0}, 1.0))
    (first, verdict), second, *others = ladder.verdicts(takes)
    assert first.name == "step" and verdict.words.startswith("is unstable at any step") and not verdict.good
    assert second[1].words == "rho = -1" and "the same as contract" in {one.words for _, one in others}


@pytest.mark.parametrize("verdict, errors, err, told", [
    (convergence, (0.4, 0.1), 0.0, "converges with order 2.0: 10 % off with 16 rows"),
    (convergence, (0.4, 0.3), 0.0,
     "has no order on these rows, its errors fall too slowly: 30 % off with 16 rows, 40 % with 8"),
    (right, (0.3, -0.1), 0.0, "has no order, as its errors change sign: K is 10 % low with 16 rows"),
    (right, (0.3, -0.1), 0.3, "cannot be told, as K is uncertain by 30 %: K is 10 % low with 16 rows")])
def test_verdicts_on_known_errors(verdict, errors, err, told):
    taken = [(rows, {"error": error, "error_err": err}) for rows, error in zip((8, 16), errors)]
    assert verdict(taken).words.startswith(told)


@pytest.mark.parametrize("words, why", [("spamm", "no method is called 'spamm'"), ("nowhere:A", "nowhere"),
                                        ("strangers:np", "name a class that takes a scene"),
                                        ("strangers:Nobody", "Nobody")])
def test_what_is_no_method_is_refused_in_one_line(words, why, capsys):
    assert main([words]) == 1
    assert why in capsys.readouterr().err


def test_the_page_shows_the_code_that_is_judged():
    code = (ROOT/"examples"/"your_method.py").read_text()
    shown = (ROOT/"examples"/"your_method.md").read_text().split("```python\n")[1].split("```")[0]
    assert shown in code
