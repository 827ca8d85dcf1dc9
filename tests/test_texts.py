"""Numbers of texts are those of the tables: behind a number a comment, which no page shows, says which.

    17.5(15), 26(1)<!-- % low(Kg(35, 100)) --> % too low        1.4<!-- own-speed-fixed-points --> times

A comment has ids of claims or a formula of the functions below; % in front makes per cent of it. It stands
for as many numbers before it as it gives, with the digits that are written. A number with an error has one.
"""
import re
from collections.abc import Iterator
from functools import cache, partial

import numpy as np
import pytest

from bench.lammps_flows import STYLES
from studies.kit.ask import one, over_seeds, per_seed  # noqa: F401 (texts ask `over_seeds`)
from studies.kit.csvfile import read
from studies.kit.key import ROOT
from studies.kit.stats import Measured
from studies.kit.store import RESULTS
from studies.kit.table import Tables
from studies.rb.claims.grid import SPECTRAL  # noqa: F401 (for texts)
from studies.rb.tables import Point, grid, particles, points
from studies.report.equations import with_error

TEXTS = "README.md", "results/README.md", "bench/README.md", "results/findings.md"
CLAIMS = read(RESULTS/"claims.csv").set_index("id")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:\(\d+\))?(?!\w)")
COMMENT = re.compile("<!-- (% )?(.*?) -->")
#: that no row has: the example of how they are written, an error that misses its level, ranges of variants
OTHERS = {"17.5(15)", "44(8)", "5(3)", "8(5)", "1.02(12)"}


class Results(Tables):
    """Tables of all studies by folder and name, read where they are asked for."""

    def __missing__(self, name: str):
        path, = RESULTS.glob(f"{name}.csv*")
        self[name] = read(path)
        return self[name]

    def __contains__(self, name: object) -> bool:
        return True


TABLES = Results()


def row(table: str, column: str, such: str = "", **where) -> Measured:
    return one(table, column, such, **where)(TABLES)


def point(variant: str, rows: float = np.inf) -> Point:
    """Of smooth particles or of points, Ra 10 000."""
    of_points = variant.startswith(("fixed", "moving"))
    return points(1e4, variant, rows) if of_points else particles(1e4, rows, variant)


def error(energy: str, *rows: float, of: str = "printed") -> list[Measured]:
    """Of runs with so many rows, over the grid's, less 1."""
    return [row("rb/errors", "error", energy=energy, **point(of, n)) for n in rows]


def limit(variant: str, column: str = "ke") -> Measured:
    """Of points without end, over the grid's, less 1."""
    return row("rb/means", column, **point(variant))/row("rb/means", column, **grid(1e4)) - 1


def seconds(method: str, scene: str = "convection", quantity: str = "K") -> Measured:
    """To 1 %; the mean half width."""
    where = {"scene": scene, "quantity": quantity, "method": method, "level": 0.01}
    return row("cost/needed", "cpu_s", err="(high - low)/2", **where)


def ns(what: str, table: str = "points", **where) -> float:
    """Of an evaluation, a particle."""
    return row(f"bench/{table}_speed", "ns_per_particle_evaluation", what=what, **where).value


def frozen(weight: str) -> Measured:
    """P at which it freezes, with the error of its multiple of KHP95's rule."""
    P, rule = (per_seed(one("lattices/freezing_limits", column, weight=weight, step=1.0))(TABLES).value
               for column in ("measured", "melting"))
    return Measured(P, rule*claim(f"khp95-hard-freezing-melting-{weight.lower()}").err)


def lammps(scene: str, quantity: str, *rows: int, styles=STYLES) -> list[Measured]:
    return [row("bench/lammps", "value", scene=scene, style=style, quantity=quantity, rows=n, err="err")
            for style in styles for n in rows]


def claim(name: str) -> Measured:
    return Measured(*CLAIMS.loc[name, ["measured", "err"]])


def low(numbers: list[Measured]) -> list[Measured]:
    return [-number for number in numbers]


def streams(scene: str, quantity: str) -> Measured:
    """The stream from which on points that move are cheaper than the grid."""
    where = {"scene": scene, "quantity": quantity, "rival": "grid"}
    return row("streams/crossings", "stream", err="high - stream", **where)


def ethersph(what: str) -> list[Measured]:
    """How far from the printed Nu is what is read, what passes as heat."""
    claims = CLAIMS[CLAIMS.index.str.match(f"ethersph-{what}-")]
    return [Measured(off) for off in 1 - claims["measured"]/claims["printed"].astype(float)]


def hard(case: str, method: str, variant: str) -> Measured:
    return row("hardcases/map", "measured", case=case, method=method, variant=variant)


K, Kg, Nu = (partial(error, energy) for energy in ("Kp", "Kg", "Nu"))
vortex = partial(seconds, scene="taylor-green", quantity="velocity")
sound = partial(seconds, scene="sound", quantity="velocity")


@cache
def values(comment: str) -> list[Measured]:
    """What is to be said in front of a comment."""
    scale, source = COMMENT.fullmatch(comment).groups()
    ids = source.split(", ")
    answer = [*map(claim, ids)] if {*ids} <= {*CLAIMS.index} else eval(source, globals())
    numbers = [answer] if isinstance(answer, (Measured, float)) else answer
    return [Measured(0) + number*(100 if scale else 1) for number in numbers]


def said(path: str) -> Iterator[tuple[re.Match[str], list[re.Match[str]]]]:
    """Each comment and the numbers in front of it."""
    text = (ROOT/path).read_text()
    bare = COMMENT.sub(lambda comment: " "*len(comment[0]), text)
    for comment in COMMENT.finditer(text):
        yield comment, [*NUMBER.finditer(bare, 0, comment.start())][-len(values(comment[0])):]


def written(number: Measured, text: str) -> str:
    """As it stands in a text: with an error, or to as many digits."""
    digits = len(text.partition(".")[2])
    made = with_error(*number) if "(" in text else f"{number.value:.{digits}f}"
    return "+"*(text[0] == "+" and number.value > 0) + made.replace("\N{MINUS SIGN}", "-")


@pytest.mark.parametrize("path", TEXTS)
def test_numbers_are_those_of_the_tables(path):
    wrong = {}
    for comment, numbers in said(path):
        texts = [number[0] for number in numbers]
        made = [written(value, text) for value, text in zip(values(comment[0]), texts, strict=True)]
        wrong |= {comment[0]: (texts, made)} if texts != made else {}
    assert not wrong


@pytest.mark.parametrize("path", TEXTS)
def test_no_number_with_an_error_is_left_unchecked(path):
    checked = {number.span() for _, numbers in said(path) for number in numbers}
    free = [number for number in NUMBER.finditer((ROOT/path).read_text()) if number.span() not in checked]
    assert {number[0] for number in free if "(" in number[0]} <= OTHERS
