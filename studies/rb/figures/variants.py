"""What walls and other changes of the printed scheme do: dots with error bars, one line a variant, the grid across.

A variant whose runs diverged has no dot: a text stands in its place.
"""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from continuum.published import published
from studies.kit.figure import figure, look
from studies.kit.table import Tables
from studies.rb.figures.errors import RA_SHOWN
from studies.rb.figures.names import SPAM_GROUPS, WALLS, grouped, words
from studies.rb.looks import (
    GRID,
    KIND,
    LABELS,
    LAYER,
    TIME,
    cross_out,
    diverged,
    errors,
    groups,
    nearest,
    of_energy,
    over_seeds,
    reference,
    rows,
    steady,
)

#: particle rows that the variants are compared at
SIZES = (25, 50)
#: errors beyond are told in words  [%]
WIDEST = 100
#: neither has the colour of an energy
PLATES = {"lower": {**look(2), "marker": "P", "linestyle": "--"}, "upper": {**look(3), "marker": "v", "linestyle": ":"}}
PLATE_NAMES = {"lower": "hot plate", "upper": "cold plate"}
#: dots of the plates stand as much below and above the variant's line, not to cover each other
APART = {"lower": 0.07, "upper": -0.07}
HEAT = {"lower": "hot", "upper": "cold"}
XLABELS = (r"kinetic energy $K$  [$10^{-3}\varepsilon/m$]", "Nusselt number", r"density next to the plate  [$m/\sigma^2$]",
           r"jump $|T - T_\mathrm{plate}|$  [$\varepsilon/k_B$]")


def walls(tables: Tables) -> Figure | None:
    """Energies, heat flow and the layer at each plate for every wall rule."""
    found, lost = (of_walls(frame) for frame in (rows(tables, "means", method="spam", **LAYER), diverged(tables, **LAYER)))
    names = [name for name in WALLS if name in {*found["variant"], *lost["variant"]}]
    if len(names) < 2 or found.empty:
        return None
    ra = found["ra"].iloc[0]
    lost = lost[lost["ra"] == ra]
    found = found.assign(steady=steady(tables, found))
    others = {*found.loc[found["variant"] != "printed", "resolution"], *lost["resolution"]}
    found = found[found["resolution"].isin(others)]
    page, axes = figure(1, 4, width=3, height=0.55*len(names) + 2.4, sharey=True)
    at = {name: float(number) for number, name in enumerate(names)}
    for column, label, kind in (("ke", "$K_p$", "kp"), ("ke_field", "$K_g$", "kg")):
        dots(axes[0], at, found, column, f"{column}_err", label, KIND[kind], scale=1000)
    dots(axes[1], at, found, "nu", "nu_err", "through the fluid", KIND["kp"] | {"color": "black"})
    at_plates(axes[1:], at, rows(tables, "walls", method="spam", **LAYER, ra=ra), found)
    references(axes, tables, ra, found["resolution"].max())
    tell_diverged(axes[0], at, lost, sizes_of(found, lost))
    for one, xlabel in zip(axes, XLABELS):
        one.set_xlabel(xlabel, fontsize=9)
        one.xaxis.set_major_locator(MaxNLocator(5))
        one.margins(x=0.1)
        if one.get_legend_handles_labels()[0]:
            one.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=7, ncols=2)
    axes[0].set_yticks(range(len(names)), labels=[WALLS[name] for name in names])
    axes[0].set(ylabel="wall rule", ylim=(len(names) - 0.5, -0.5))
    page.suptitle(f"What does the wall rule do at Ra = {ra:g}?\nvertical lines: grid; next to a plate: one spacing from it; "
                  f"{sizes(found)}; bars: 95 % intervals", fontsize=10)
    return page


def of_walls(found: pd.DataFrame) -> pd.DataFrame:
    """Rows of the wall rules at the Ra nearest to 10 000."""
    return nearest(found[found["variant"].isin(WALLS)])


def sizes_of(*frames: pd.DataFrame) -> list[float]:
    """Resolutions, the finest first."""
    return sorted({size for frame in frames for size in frame["resolution"]}, reverse=True)


def sizes(*frames: pd.DataFrame) -> str:
    """Which mark is which resolution."""
    fine, *coarse = (f"{size:.0f}" for size in sizes_of(*frames))
    return f"filled: {fine} rows" + (f", open: {', '.join(coarse)}" if coarse else "")


#: how much lower the next coarser resolution stands
LOWER = 0.36


def dots(axes: Axes, at: dict[str, float], found: pd.DataFrame, column: str, err: str, label: str, style: dict,
         scale: float = 1.0, order: list[float] | None = None, shift: float = 0.0) -> None:
    """One mark a variant, which stands `at` a height, and resolution; the finest filled, coarser ones open and lower."""
    for number, size in enumerate(order or sizes_of(found)):
        group = found[found["resolution"] == size]
        face = {"markerfacecolor": "white"} if number else {}
        y = pd.Series([at[name] + LOWER*number + shift for name in group["variant"]], group.index, float)
        axes.errorbar(scale*group[column], y, xerr=scale*group[err], label=label if number == 0 else "",
                      **style | face | {"linestyle": "none"})
        if "steady" in group:
            cross_out(axes, scale*group[column], y, group["steady"])


def tell_diverged(axes: Axes, at: dict[str, float], lost: pd.DataFrame, order: list[float]) -> None:
    """In place of a point or, when other seeds have left one, below it that runs diverged."""
    for _, row in lost.iterrows():
        whole, height = row["lost"] == row["seeds"], at[row["variant"]]
        seeds = "" if whole else f"{row['lost']} of {row['seeds']} seeds "
        say(axes, height + (LOWER*order.index(row["resolution"]) if whole else 2*LOWER), 0.5,
            f"{row['resolution']:.0f} rows: {seeds}diverged at t = {round(row['t'], 2 - int(np.log10(row['t']))):g} {TIME}")


def say(axes: Axes, y: float, x: float, words: str) -> None:
    """Words at the height of a variant, x as a fraction of the axes; in front of lines, behind marks."""
    axes.annotate(words, (x, y), xycoords=("axes fraction", "data"), ha="center" if x == 0.5 else "right", va="center",
                  fontsize=7, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5}, zorder=1)


def at_plates(axes: Any, at: dict[str, float], found: pd.DataFrame, means: pd.DataFrame) -> None:
    """Nusselt number, density and jump of the temperature at the hot and the cold plate, means over seeds."""
    found = found[found["variant"].isin(at) & found["resolution"].isin(means["resolution"])]
    found = found.assign(jump=(found["T_layer"] - found["T_wall"]).abs())
    for plate, style in PLATES.items():
        here = found[found["plate"] == plate]
        for one, column, err in zip(axes, ("nu_plate", "rho_layer", "jump"), ("nu_plate_err", "", "")):
            mean = over_seeds(here, ["variant", "resolution"], column, err)
            if len(mean):
                dots(one, at, mean, column, "err", PLATE_NAMES[plate], style, order=sizes_of(means), shift=APART[plate])


def references(axes: Any, tables: Tables, ra: float, size: float) -> None:
    """Vertical lines: the extrapolated grid, and its fields half a spacing from the plates."""
    style = {"color": "black", "marker": "", "ls": "-", "lw": 1, "zorder": 0}
    limit = reference(tables, **LAYER, ra=ra)
    for ke, nu in zip(limit["ke"], limit["nu"]):
        axes[0].axvline(1000*ke, **style)
        axes[1].axvline(nu, **style)
    fields = rows(tables, "fields", **GRID, **LAYER, ra=ra)
    mean = fields.groupby("y")[["rho", "T"]].mean()
    for plate, edge, inward in (("lower", mean, 1), ("upper", mean.iloc[::-1], -1)) if len(mean) > 1 else ():
        step = (inward*(edge.index[1] - edge.index[0]), 0.5 + inward*edge.index[0] - 0.5/size)
        at = edge.iloc[0] - (edge.iloc[1] - edge.iloc[0])*step[1]/step[0]
        jump = abs(at["T"] - published(f"khp95-temperature-{HEAT[plate]}").value)
        for one, value in zip(axes[2:], (at["rho"], jump)):
            one.axvline(value, **style | {"color": PLATES[plate]["color"], "ls": PLATES[plate]["linestyle"], "lw": 1.5})


def variants(tables: Tables) -> Figure | None:
    """Errors of Kp and Kg of every variant, by what it changes; the Ra with the most of them first."""
    found, lost = (at_sizes(frame) for frame in (of_energy(errors(tables, method="spam", **LAYER)), diverged(tables, **LAYER)))
    there = {ra: {*found.loc[found["ra"] == ra, "variant"], *lost.loc[lost["ra"] == ra, "variant"]}
             for ra in {*found["ra"], *lost["ra"]}}
    shown = sorted(there, key=lambda ra: (-len(there[ra]), -ra))
    if not shown or len(there[shown[0]]) < 2:
        return None
    groups_at = {ra: grouped(there[ra], SPAM_GROUPS) for ra in shown}
    heights = [0.6 + sum(1 + len(names) for names in groups_at[ra].values()) for ra in shown]
    page, all_axes = figure(len(shown), 1, width=8.4, height=(0.32*sum(heights) + 1.4)/len(shown), sharex=True, squeeze=False,
                            height_ratios=heights)
    for axes, ra in zip(all_axes[:, 0], shown):
        one_ra(axes, lines(axes, groups_at[ra]), found[found["ra"] == ra], lost[lost["ra"] == ra])
        axes.set(title=f"Ra = {ra:g}", ylabel="variant")
    all_axes[-1, 0].set(xlabel=r"error against the grid, for $K_g$ smoothed likewise  [%]", xlim=span(found["error"]))
    handles = {label: handle for axes in all_axes[:, 0] for handle, label in zip(*axes.get_legend_handles_labels())}
    if handles:
        page.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3, title_fontsize=8,
                    title=f"{sizes(found, lost)}; bars: 95 % intervals")
    page.suptitle("Which change of the printed scheme helps?", fontsize=10)
    return page


def span(error: pd.Series) -> tuple[float, float]:
    """Limits of the axis [%]: what is not told in words, and room for words."""
    inside = 100*error[error.abs() <= WIDEST/100]
    return min([*inside, 0]) - 8, max([*inside, 0]) + 25


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


def at_sizes(found: pd.DataFrame) -> pd.DataFrame:
    """What the variants are compared at."""
    return found[found["resolution"].isin(SIZES) & found["ra"].isin(RA_SHOWN)]


def one_ra(axes: Axes, at: dict[str, float], found: pd.DataFrame, lost: pd.DataFrame) -> None:
    """All variants at one Ra; errors too large for the axis in words, at its edge."""
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    order = sizes_of(found, lost)
    inside = found["error"].abs() <= WIDEST/100
    for energy, label in LABELS.items():
        one = found[inside & (found["energy"].str.lower() == energy)]
        dots(axes, at, one, "error", "error_err", label, KIND[energy], 100, order)
    for (variant, size), rest in groups(found[~inside], ["variant", "resolution"]):
        told = ", ".join(f"${name[0]}_{name[1]}$ {100*error:+.0f} %" for name, error in zip(rest["energy"], rest["error"]))
        say(axes, at[variant] + LOWER*order.index(size), 0.99, f"{size:.0f} rows: {told} $\\rightarrow$")
    tell_diverged(axes, at, lost, order)
