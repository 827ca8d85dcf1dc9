"""What changes of the printed scheme do: dots with error bars, one line a variant, the grid across.

A variant whose runs diverged has no dot: a text stands in its place.
"""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import figure
from studies.kit.table import Tables, groups
from studies.rb.figures.names import SPAM_GROUPS, grouped, words
from studies.rb.looks import KIND, LABELS, LAYER, MARKS, OPEN, RA_SHOWN, TIME, cross_out, diverged, errors, of_energy

#: particle rows that the variants are compared at
SIZES = (25, 50)
#: errors beyond are given in words  [%]
WIDEST = 100
#: how much lower the next coarser resolution stands
LOWER = 0.36


def variants(tables: Tables) -> Figure | None:
    """Errors of the kinetic energy of smooth particles, one line for each change of the printed scheme. Filled marks have
    50 rows of particles, open ones 25.
    """
    chosen = at_sizes(of_energy(errors(tables, method="spam", **LAYER)))
    lost = at_sizes(diverged(tables, **LAYER))
    names = {ra: {*chosen.loc[chosen["ra"] == ra, "variant"], *lost.loc[lost["ra"] == ra, "variant"]}
             for ra in {*chosen["ra"], *lost["ra"]}}
    shown = sorted(names, key=lambda ra: (-len(names[ra]), -ra))
    if not shown or len(names[shown[0]]) < 2:
        return None
    groups_at = {ra: grouped(names[ra], SPAM_GROUPS) for ra in shown}
    heights = [0.6 + sum(1 + len(group) for group in groups_at[ra].values()) for ra in shown]
    page, all_axes = figure(len(shown), 1, width=8.4, height=(0.32*sum(heights) + 1.4)/len(shown), sharex=True,
                            squeeze=False, height_ratios=heights)
    for axes, ra in zip(all_axes[:, 0], shown):
        one_ra(axes, lines(axes, groups_at[ra]), chosen[chosen["ra"] == ra], lost[lost["ra"] == ra])
        axes.set(title=f"Ra = {ra:g}", ylabel="variant")
    xlabel = r"error against the grid, for $K_g$ smoothed likewise  [%]"
    all_axes[-1, 0].set(xlabel=xlabel, xlim=span(chosen["error"]))
    legend(page, all_axes[:, 0], f"{sizes(chosen, lost)}; bars: 95 % intervals")
    page.suptitle("Which change of the printed scheme helps?", fontsize=10)
    return page


def at_sizes(chosen: pd.DataFrame) -> pd.DataFrame:
    """What the variants are compared at."""
    return chosen[chosen["resolution"].isin(SIZES) & chosen["ra"].isin(RA_SHOWN)]


def one_ra(axes: Axes, at: dict[str, float], chosen: pd.DataFrame, lost: pd.DataFrame) -> None:
    """All variants at one Ra; errors too large for the axis in words, at its edge."""
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    order = sizes_of(chosen, lost)
    inside = chosen["error"].abs() <= WIDEST/100
    for energy, label in LABELS.items():
        one = chosen[inside & (chosen["energy"].str.lower() == energy)]
        dots(axes, at, one, label, KIND[energy], order)
    for (variant, size), rest in groups(chosen[~inside], ["variant", "resolution"]):
        large = [f"${name[0]}_{name[1]}$ {100*error:+.0f} %" for name, error in zip(rest["energy"], rest["error"])]
        text = f"{size:.0f} rows: {', '.join(large)} $\\rightarrow$"
        say(axes, at[variant] + LOWER*order.index(size), 0.99, text)
    tell_diverged(axes, at, lost, order)


def span(error: pd.Series) -> tuple[float, float]:
    """Limits of the axis [%]: what is not said in words, and room for words."""
    inside = 100*error[error.abs() <= WIDEST/100]
    return min([*inside, 0]) - 8, max([*inside, 0]) + 25


def legend(page: Figure, all_axes: Any, title: str) -> None:
    """One below the page for all axes."""
    pairs = [axes.get_legend_handles_labels() for axes in all_axes]
    handles = {label: handle for handles, labels in pairs for handle, label in zip(handles, labels)}
    if handles:
        page.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3, title_fontsize=8, title=title)


# --- lines with dots ------------------------------------------------------------------------------


def lines(axes: Axes, groups: dict[str, list[str]]) -> dict[str, float]:
    """A line for each variant, below the title of its group; the height of each."""
    at: dict[str, float] = {}
    labels: list[str] = []
    for title, names in groups.items():
        labels.append(title)
        for name in names:
            at[name] = float(len(labels))
            labels.append(words(name))
    axes.set_yticks(range(len(labels)), labels=labels, fontsize=8)
    for number, tick in enumerate(axes.get_yticklabels()):
        tick.set_fontweight("normal" if number in at.values() else "bold")
    axes.set_ylim(len(labels) - 0.4, -0.6)
    return at


def sizes_of(*frames: pd.DataFrame) -> list[float]:
    """Resolutions, the finest first."""
    return sorted({size for frame in frames for size in frame["resolution"]}, reverse=True)


def sizes(*frames: pd.DataFrame) -> str:
    """Which mark is which resolution."""
    fine, *coarse = (f"{size:.0f}" for size in sizes_of(*frames))
    return f"filled: {fine} rows" + (f", open: {', '.join(coarse)}" if coarse else "")


def dots(axes: Axes, at: dict[str, float], chosen: pd.DataFrame, label: str, style: dict, order: list[float]) -> None:
    """The error [%] of each variant, which stands `at` a height; the finest filled, coarser ones open and lower."""
    for number, size in enumerate(order):
        group = chosen[chosen["resolution"] == size]
        y = pd.Series([at[name] + LOWER*number for name in group["variant"]], group.index, float)
        face = OPEN if number else {}
        axes.errorbar(100*group["error"], y, xerr=100*group["error_err"], label="" if number else label,
                      **style | face | MARKS)
        cross_out(axes, 100*group["error"], y, group["steady"])


def tell_diverged(axes: Axes, at: dict[str, float], lost: pd.DataFrame, order: list[float]) -> None:
    """In place of a point or, when other seeds have left one, below it that runs diverged."""
    for _, row in lost.iterrows():
        whole, height = row["lost"] == row["seeds"], at[row["variant"]]
        seeds = "" if whole else f"{row['lost']} of {row['seeds']} seeds "
        lower = LOWER*order.index(row["resolution"]) if whole else 2*LOWER
        t = round(row["t"], 2 - int(np.log10(row["t"])))
        say(axes, height + lower, 0.5, f"{row['resolution']:.0f} rows: {seeds}diverged at t = {t:g} {TIME}")


def say(axes: Axes, y: float, x: float, text: str) -> None:
    """Words at the height of a variant, x as a fraction of the axes; in front of lines, behind marks."""
    ground = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
    axes.annotate(text, (x, y), xycoords=("axes fraction", "data"), ha="center" if x == 0.5 else "right", va="center",
                  fontsize=7, bbox=ground, zorder=1)
