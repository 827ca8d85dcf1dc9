"""What changes of a scheme do to K: errors beside those of the whole scheme, a line for each variant."""
from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.labels import label
from studies.build.moving import MOTIONS
from studies.build.rr98_moving import DRIFT_MOTIONS
from studies.build.spam import VARIANTS
from studies.kit.figure import figure
from studies.kit.table import Tables
from studies.rb.looks import ENERGIES, KIND, LAYER, MARKS, OPEN, cross_out, diverged, errors

RA = 10000
#: how much lower the next coarser resolution stands
LOWER = 0.36
#: errors up to here are drawn linearly, larger ones logarithmically  [%]
LINEAR = 10
TICKS = (-1000, -300, -100, -30, -10, -5, 0, 5, 10, 30, 100, 300, 1000)


def variants(tables: Tables) -> Figure | None:
    """Errors of the kinetic energy of smooth particles, one line for each change of the printed scheme.
    Filled marks have 50 rows of particles, open ones 25.
    """
    energies = {"Kp": ENERGIES["kp"][1], "Kg": ENERGIES["kg"][1]}
    return changes(tables, "spam", VARIANTS, (50, 25), energies, "Which change of the printed scheme helps?")


def moving_points(tables: Tables) -> Figure | None:
    """Errors of the kinetic energy on points that move: the scheme, without each of its ingredients, and the
    motions of RR98. Filled marks have 40 rows of points, open ones 25.
    """
    question = "Points that move: what do their ingredients do?"
    return changes(tables, "dih", (*MOTIONS, *DRIFT_MOTIONS), (40, 25), {"Kp": "$K$"}, question)


def changes(tables: Tables, method: str, order: Iterable[str], sizes: tuple[int, int],
            energies: dict[str, str], title: str) -> Figure | None:
    """Errors of those variants that were run with as many rows; none if there is nothing to compare."""
    frame, gone = (frame[frame["resolution"].isin(sizes)] for frame in (
        errors(tables, method=method, ra=RA, **LAYER), diverged(tables, method=method, ra=RA, **LAYER)))
    frame, gone = (frame[frame["variant"].isin([*order])] for frame in (frame, gone))
    names = [name for name in order if name in {*frame["variant"], *gone["variant"]}]
    at: dict[Any, int] = {name: number for number, name in enumerate(names)}
    if len(names) < 2 or frame.empty:
        return None
    page, axes = figure(width=8.4, height=1.8 + 0.3*len(names))
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    for lower, size in zip((0, LOWER), sizes):
        for energy, words in energies.items():
            series = frame[(frame["resolution"] == size) & (frame["energy"] == energy)]
            dots(axes, series, series["variant"].map(at) + lower, words, KIND[energy.lower()])
    for row in gone.itertuples():
        say_diverged(axes, row, at[row.variant] + LOWER*sizes.index(row.resolution))
    axes.set_yticks(range(len(names)), labels=[label(method, name) for name in names], fontsize=8)
    axes.set(ylabel="variant", ylim=(len(names) - 0.4, -0.6), title=f"{title}  Ra = {RA}",
             xlabel=f"error of $K$ against the grid  [%], linear to {LINEAR} %, logarithmic beyond")
    symlog(axes, frame["error"])
    page.legend(loc="outside lower center", ncols=3, title_fontsize=8,
                title=f"filled: {sizes[0]} rows, open: {sizes[1]}; bars: 95 % intervals")
    return page


def dots(axes: Axes, series: pd.DataFrame, y: pd.Series, words: str, style: dict) -> None:
    """The error [%] of each variant on its line; those below a line are open."""
    if series.empty:
        return
    error, lower = 100*series["error"], bool((y % 1).any())
    axes.errorbar(error, y, xerr=100*series["error_err"], label="" if lower else words,
                  **style | MARKS | (OPEN if lower else {}))
    cross_out(axes, error, y, series["steady"])


def say_diverged(axes: Axes, row: Any, height: float) -> None:
    """In place of a point, or beside one that other seeds have left, that runs diverged."""
    seeds = "" if row.lost == row.seeds else f"{row.lost} of {row.seeds} seeds "
    words = f"{row.resolution:.0f} rows: {seeds}diverged"
    axes.annotate(words, (0.99, height), xycoords=("axes fraction", "data"), ha="right", va="center",
                  fontsize=7)


def symlog(axes: Axes, error: pd.Series) -> None:
    """Ticks of errors with their sign, in the range that there is."""
    axes.set_xscale("symlog", linthresh=LINEAR)
    ticks = [tick for tick in TICKS if abs(tick) <= max(LINEAR, 100*np.abs(error).max())]
    axes.set_xticks(ticks, labels=[f"{tick:g}" for tick in ticks])
