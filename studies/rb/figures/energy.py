"""Kinetic energy: against Ra^-1/2 and time, KHP95's Fig. 8; what changes of a scheme do to it."""
from collections.abc import Iterable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.moving import DRIFT_MOTIONS, MOTIONS
from studies.build.names import ENERGY, name_of
from studies.build.spam import VARIANTS
from studies.kit.figure import figure
from studies.kit.table import Tables, groups
from studies.rb import looks
from studies.rb.looks import ENERGIES, GRID, KIND, LAYER, MARKS, OPEN, SPAM
from studies.rb.tables import STILL

#: how far marks at the same Ra are moved apart, in Ra^-1/2
ASIDE = 1.5e-4
RA = 10000      # of Fig. 8, and of what changes of a scheme do
#: how much lower the next coarser resolution stands
LOWER = 0.36
#: errors up to here are drawn linearly, larger ones logarithmically  [%]
LINEAR = 10
TICKS = (-1000, -300, -100, -30, -10, -5, 0, 5, 10, 30, 100, 300, 1000)


def grid(axes: Axes, limit: pd.DataFrame, words: str) -> None:
    """Line and markers of an extrapolated grid; the line stops where motion dies out."""
    style, flow = KIND["grid"], limit[limit.ke > STILL]
    if len(flow):
        axes.errorbar(flow.ra**-0.5, flow.ke, flow.ke_err, label=words, **style)
        axes.plot(limit.ra**-0.5, limit.ke, **style | MARKS)


def energies(axes: Axes, spam: pd.DataFrame, column: str, words: str, style: dict, aside=0.0) -> None:
    """An energy of particles by Ra, marks a little to the right; no interval reaches below zero."""
    if spam.empty:
        return
    x, ke, err = spam.ra**-0.5 + aside, spam[column], spam[f"{column}_err"]
    axes.errorbar(x, ke, [np.minimum(err, ke), err], label=words, **style | MARKS)
    looks.cross_out(axes, x, ke, spam.steady)


def name_frozen(axes: Axes, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """Mark Ra at which the grid convects, while the finest particles stand still on a lattice."""
    both = spam.merge(limit[["ra", "ke"]], on="ra", suffixes=("", "_grid"))
    frozen = both[(both.ke_grid > STILL) & (both.ke_field < 0.01*both.ke_grid)]
    line = {"arrowstyle": "-", "lw": 0.6, "shrinkB": 4}
    for ra in frozen.ra:
        axes.annotate("at rest, started from weak rolls", (ra**-0.5, 0), xytext=(-14, 16),
                      textcoords="offset points", fontsize=8, ha="right", arrowprops=line)


def fig8(tables: Tables) -> Figure | None:
    """Kinetic energy against time while weak rolls grow: particles, one line a seed, and the grid."""
    spam = looks.rows(tables, "history", **SPAM, **LAYER, ra=RA)
    # KHP95's 5000 particles; finer runs keep few samples
    spam = looks.finest(spam[spam.resolution <= 50])
    cells = looks.finest(looks.rows(tables, "history", **GRID, **LAYER, ra=RA))
    if spam.empty or cells.empty:
        return None
    page, axes = figure(width=7, height=4.2)
    for kind, (column, words) in ENERGIES.items():
        for number, (_, run) in enumerate(groups(spam, "seed")):
            style = KIND[kind] | {"marker": "", "lw": 0.9, "alpha": 0.8}
            first = "" if number else f"{words}, one line a seed"
            axes.plot(run.t_viscous, run[column], label=first, **style)
    style = KIND["grid"] | {"marker": "", "lw": 2.2}
    axes.plot(cells.t_viscous, cells.ke, label="grid", **style)
    axes.set(title=f"Particles (spam) lag behind the grid and end too low, Ra = {RA}    [KHP95, Fig. 8]",
             xlabel=r"time  [$L^2/\nu$]; 1 is 5000 in KHP95's units", ylabel=ENERGY, ylim=(0, None))
    axes.legend(loc="upper right")
    return page


def variants(tables: Tables) -> Figure | None:
    """Errors of the kinetic energy of smooth particles, one line for each change of the printed scheme.
    Filled marks have 50 rows of particles, open ones 25.
    """
    energies = {"Kp": ENERGIES["kp"][1], "Kg": ENERGIES["kg"][1]}
    see = "None of these changes makes both energies right"
    return changes(tables, "spam", VARIANTS, (50, 25), energies, see)


def moving_points(tables: Tables) -> Figure | None:
    """Errors of the kinetic energy on points that move: with their triangulation, over closed faces with and
    without each ingredient, by the motions of RR98. Filled marks have 40 rows of points, open ones 25.
    """
    see = "Over faces moving points need the shift and volumes that follow; RR98's motions lose much of K"
    return changes(tables, "dih", ("moving-delaunay", *MOTIONS, *DRIFT_MOTIONS), (40, 25), {"Kp": "$K$"}, see)


def changes(tables: Tables, method: str, order: Iterable[str], sizes: tuple[int, int],
            kinds: dict[str, str], title: str) -> Figure | None:
    """Errors of those variants that were run with as many rows; none if there is nothing to compare."""
    scene = LAYER | {"method": method, "ra": RA}
    frame, gone = (frame[frame.resolution.isin(sizes) & frame.variant.isin([*order])]
                   for frame in (looks.errors(tables, **scene), looks.diverged(tables, **scene)))
    there = {*frame.variant, *gone.variant}
    names = [name for name in order if name in there]
    at: dict[Any, int] = {name: number for number, name in enumerate(names)}
    if len(names) < 2 or frame.empty:
        return None
    page, axes = figure(width=8.4, height=1.8 + 0.3*len(names))
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    for (lower, size), energy in product(zip((0, LOWER), sizes), kinds):
        series = frame[(frame.resolution == size) & (frame.energy == energy)]
        y = series.variant.map(at) + lower
        dots(axes, series, y, kinds[energy], KIND[energy.lower()])
    for row in gone.itertuples():
        say_diverged(axes, row, at[row.variant] + LOWER*sizes.index(row.resolution))
    axes.set_yticks(range(len(names)), labels=[name_of(method, name) for name in names], fontsize=8)
    axes.set(ylabel="method", ylim=(len(names) - 0.4, -0.6),
             xlabel=f"error of $K$ against the grid  [%], linear to {LINEAR} %, logarithmic beyond")
    symlog(axes, frame.error)
    page.suptitle(f"{title}; Ra = {RA}")
    page.legend(loc="outside lower center", ncols=3, title_fontsize=8,
                title=f"filled: {sizes[0]} rows, open: {sizes[1]}; bars: 95 % intervals")
    return page


def dots(axes: Axes, series: pd.DataFrame, y: pd.Series, words: str, style: dict) -> None:
    """The error [%] of each variant on its line; those below a line are open."""
    if series.empty:
        return
    error, lower = 100*series.error, bool((y % 1).any())
    axes.errorbar(error, y, xerr=100*series.error_err, label="" if lower else words,
                  **style | MARKS | (OPEN if lower else {}))
    looks.cross_out(axes, error, y, series.steady)


def say_diverged(axes: Axes, row: Any, height: float) -> None:
    """Say that runs diverged, in place of their point or beside the point of the other seeds."""
    seeds = "" if row.lost == row.seeds else f"{row.lost} of {row.seeds} seeds "
    words = f"{row.resolution:.0f} rows: {seeds}diverged"
    axes.annotate(words, (0.99, height), xycoords=("axes fraction", "data"), ha="right", va="center",
                  fontsize=7)


def symlog(axes: Axes, error: pd.Series) -> None:
    """Axis of errors with their sign, with ticks in the range of the errors."""
    axes.set_xscale("symlog", linthresh=LINEAR)
    ticks = [tick for tick in TICKS if abs(tick) <= max(LINEAR, 105*error.abs().max())]
    axes.set_xticks(ticks, labels=map(str, ticks))
