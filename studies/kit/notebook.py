"""Helpers of notebooks: computed sentences, numbers with intervals, tables, small pictures."""
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from IPython.display import HTML, Image, Markdown, display
from matplotlib import rcParams
from matplotlib.figure import Figure

from studies.kit.csvfile import read
from studies.kit.figure import compact
from studies.kit.stats import Measured

rcParams.update({"savefig.dpi": 70, "legend.fontsize": 8})
# print only the message of a warning: the path of the file says nothing to a reader
warnings.formatwarning = lambda message, *_, **__: f"{message}\n"
ROUND_OFF = 1e-13       # smaller numbers are printed as zero


def say(sentence: str) -> None:
    """Display a sentence as a finding."""
    display(Markdown(f"**Finding.** {sentence}"))


def note(*words: str) -> None:
    """Display a note, such as on results used in place of others; nothing if there are no words."""
    if any(words):
        display(Markdown(f"**Note.** {'; '.join(filter(None, words))}."))


def show(page: Figure) -> None:
    """Display a small picture of a figure."""
    display(Image(compact(page)))


def drawn(pages: Mapping[str, Figure], name: str) -> None:
    """Display a small picture of a figure by name, or a note if the figure is missing."""
    show(pages[name]) if name in pages else note(f"{name}: not run yet")


def table(frame: pd.DataFrame) -> None:
    """Display a table, with texts in full."""
    with pd.option_context("display.max_colwidth", None):
        display(HTML(frame.to_html(index=False, na_rep="")))


def listed(words: Iterable[Any]) -> str:
    """Words joined to "a, b and c"; "none" if there are none."""
    *first, last = [str(word) for word in words] or ["none"]
    return f"{', '.join(first)} and {last}" if first else last


def pm(value: float, err: float = 0.0) -> str:
    """A value with its interval in units of the last digit, such as 0.00312(2)."""
    if not np.isfinite(value):
        return ""
    exact = not err > 1e-9*abs(value)       # no error, or round-off
    return f"{value:.4g}" if exact else str(Measured(value, err))


def percent(value: float, err: float = 0.0) -> str:
    """A fraction in per cent with its interval, such as -1.34(4) %."""
    if not np.isfinite(value):
        return "none"
    return f"{pm(100*value, 100*err)} %" if abs(value) > ROUND_OFF else "0 %"


def verdicts(results: Path, study: str, *, source: str = "") -> None:
    """Display counts of a study's claims by verdict, and those that do not hold. source : its beginning."""
    claims = claims_of(results, study)
    chosen = claims[claims["source"].str.startswith(source)]
    verdict = chosen["verdict"]
    holds, fails, undecidable = (sum(verdict == word) for word in ("holds", "fails", "undecidable"))
    say(f"Of {len(chosen)} statements {holds} hold, {fails} fail, {undecidable} are undecidable. "
        "Those that do not hold:")
    table(stated(chosen[verdict != "holds"]))


def claims_of(results: Path, study: str) -> pd.DataFrame:
    """Claims of a study, by id."""
    claims = read(results/"claims.csv", ["study", "id", "measured", "err", "verdict"])
    return claims[claims["study"] == study].set_index("id")


def measured(claims: pd.DataFrame, name: str) -> str:
    """Measured value of a claim with its interval, as text."""
    return pm(claims["measured"][name], claims["err"][name])


def stated(claims: pd.DataFrame) -> pd.DataFrame:
    """Claims as a table for readers: source, statement, numbers with intervals, verdict."""
    told = claims.assign(measured=list(map(pm, claims["measured"], claims["err"])))
    return columns(told, ["source", "statement", "printed", "measured", "verdict"])


def columns(frame: pd.DataFrame, names: Sequence[str]) -> pd.DataFrame:
    """These columns of a table, in this order."""
    return frame[list(names)]
