"""Discretized integral hydrodynamics: which points, edges and motions converge on the grid?"""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import below, figure, look, plain_ticks
from studies.kit.table import Tables
from studies.rb.figures.errors import PALE, RA_SHOWN, SIGNS, floor, loglog, powers
from studies.rb.figures.names import FIXED_GROUPS, MOVING_GROUPS, grouped, numbered, words
from studies.rb.figures.variants import LOWER, dots, lines, say, sizes, sizes_of, tell_diverged
from studies.rb.looks import LAYER, diverged, errors, groups, reference, rows

#: errors of moving points below are drawn linearly, above logarithmically  [%]
LINEAR = 1.0
RELATIVE = r"relative error  $|K/K_\mathrm{grid} - 1|$"
MOVE = ("moving", "motion")     # how the names of schemes begin whose points move


def moves(variant: pd.Series) -> pd.Series:
    """Which variants are of points that move."""
    return variant.str.startswith(MOVE).astype(bool)


def fixed(tables: Tables) -> Figure | None:
    """Errors of K on points that stay, against rows: a line of panels for each kind of points, a column for each Ra."""
    found = errors(tables, method="dih", energy="Kp", **LAYER)
    found = found[~moves(found["variant"]) & found["ra"].isin(RA_SHOWN)]
    others, lost = (frame[~moves(frame["variant"])] for frame in (other_flows(tables), lost_runs(tables)))
    if found.empty:
        return None
    kinds, panels = grouped({*found["variant"], *others["variant"], *lost["variant"]}, FIXED_GROUPS), sorted({*found["ra"]})
    page, all_axes = figure(len(kinds), len(panels), width=5.4, height=4.7, sharex=True, sharey="row", squeeze=False)
    for line, (kind, names) in zip(all_axes, kinds.items()):
        drawn = found[found["variant"].isin(names)]
        for axes, ra in zip(line, panels):
            for name, style in numbered(names).items():
                here = [frame[(frame["variant"] == name) & (frame["ra"] == ra)] for frame in (drawn, others, lost)]
                one_scheme(axes, name, style, *here)
        size = pd.concat([drawn["error"], others.loc[others["variant"].isin(names), "error"]]).abs()
        if len(size):
            floor(line[0], size)
        for axes, ra in zip(line, panels):
            if not axes.has_data():
                axes.set_visible(False)
                continue
            loglog(axes, f"Ra = {ra:g}: {kind}", "rows over the height $L$", PALE)
            plain_ticks(axes, sorted({*found["resolution"]}))
            axes.tick_params(labelbottom=True)
        for axes in [axes for axes in line if axes.get_visible()][:1]:
            axes.tick_params(labelleft=True)
            axes.set_ylabel(RELATIVE)
    page.suptitle(f"What do fixed points and their edges make of $K$?\n{SIGNS}", fontsize=10)
    return page


def one_scheme(axes: Axes, name: str, style: dict, found: pd.DataFrame, others: pd.DataFrame, lost: pd.DataFrame) -> None:
    """Errors over rows; what went to another flow is drawn too, what diverged is told in the legend."""
    told = [f"{row['resolution']:.0f} rows: {row['rolls']:.0f} rolls instead of two" for _, row in others.iterrows()]
    told += [f"{row['resolution']:.0f} rows: diverged" for _, row in lost.iterrows()]
    label = words(name) + (f"\n[{'; '.join(told)}]" if told else "")
    if len(found):
        powers(axes, found.sort_values("resolution"), label, style)
    elif told:
        axes.errorbar([], [], [], label=label, **style)
    for _, row in others.iterrows():
        axes.plot(row["resolution"], abs(row["error"]), **style | {"markerfacecolor": "white", "markersize": 8})


def lost_runs(tables: Tables) -> pd.DataFrame:
    """Points at which runs diverged."""
    found = diverged(tables, method="dih", **LAYER)
    return found[found["ra"].isin(RA_SHOWN)]


def other_flows(tables: Tables) -> pd.DataFrame:
    """Points that ended in another number of rolls than the grid: no errors of the same flow, so in no row of `errors`."""
    found = rows(tables, "means", method="dih", **LAYER)
    found = found[np.isfinite(found["resolution"].astype(float)) & found["ra"].isin(RA_SHOWN)]
    limit = reference(tables, **LAYER).set_index("ra")
    found = found[found["ra"].isin(limit.index[limit["ke"] > 0])]
    found = found.assign(error=found["ke"]/found["ra"].map(limit["ke"]).astype(float) - 1)
    return found[found["rolls"] != found["ra"].map(limit["rolls"])]


def moving(tables: Tables) -> Figure | None:
    """Errors of K on moving points: over rows, and, where there are variants, without each ingredient."""
    found = errors(tables, method="dih", energy="Kp", **LAYER)
    found = found[moves(found["variant"]) & found["ra"].isin(RA_SHOWN)]
    others, lost = (frame[moves(frame["variant"])] for frame in (other_flows(tables), lost_runs(tables)))
    scheme = found[found["variant"] == "moving"]
    ra = max([*found["ra"], *others["ra"], *lost["ra"]], default=0)
    found, others, lost = (frame[frame["ra"] == ra] for frame in (found, others, lost))
    names = {name for frame in (found, others, lost) for name in frame["variant"]}
    if not names:
        return None
    many = len(names) > 1
    page, all_axes = figure(1, 1 + many, width=5 + many, height=max(5, 0.36*len(names) + 2.2*many), squeeze=False,
                            width_ratios=(2, 3) if many else None)
    for number, (value, series) in enumerate(groups(scheme.sort_values("resolution"), "ra")):
        powers(all_axes[0, 0], series, f"moving points, Ra = {value:g}", look(number))
    if len(scheme):
        floor(all_axes[0, 0], scheme["error"].abs())
    loglog(all_axes[0, 0], "all ingredients: over rows", "rows over the height $L$", SIGNS)
    if len(scheme):
        plain_ticks(all_axes[0, 0], sorted({*scheme["resolution"]}))
    all_axes[0, 0].set_ylabel(RELATIVE)
    if many:
        ingredients(all_axes[0, 1], found, others, lost, names)
        all_axes[0, 1].set_title(f"other motions and ingredients, Ra = {ra:g}")
    page.suptitle("Points that move: does $K$ converge" + (", what do its ingredients do?" if many else "?"), fontsize=10)
    return page


def ingredients(axes: Axes, found: pd.DataFrame, others: pd.DataFrame, lost: pd.DataFrame, names: set[str]) -> None:
    """One line for each variant; errors with their sign, logarithmic where they are large."""
    found = found[found["resolution"].isin(found.loc[found["variant"] != "moving", "resolution"])]
    at = lines(axes, grouped(names, MOVING_GROUPS))
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    order = sizes_of(found, others, lost)
    dots(axes, at, found, "error", "error_err", "$K$", {**look(0), "marker": "o"}, 100, order)
    tell_diverged(axes, at, lost, order)
    for _, row in others.iterrows():
        say(axes, at[row["variant"]] + LOWER*order.index(row["resolution"]), 0.5,
            f"{row['resolution']:.0f} rows: {row['rolls']:.0f} rolls instead of two, {100*row['error']:+.0f} %")
    axes.set_xscale("symlog", linthresh=LINEAR)
    large = 100*found["error"].abs().max() if len(found) else LINEAR
    ticks = [tick for tick in (-1000, -100, -10, -1, 0, 1, 10, 100, 1000) if abs(tick) <= max(large, LINEAR)]
    axes.set_xticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axes.set_xticks([sign*tick for tick in (3, 30, 300) if tick <= large for sign in (1, -1)], minor=True)
    axes.tick_params(axis="x", which="minor", labelbottom=False)
    axes.set_xlabel(f"error of $K$ against the grid  [%]\nlinear to {LINEAR:g} %, logarithmic beyond")
    below(axes, title=f"{sizes(found, others, lost)}; bars: 95 % intervals", title_fontsize=8)
