"""Discretized integral hydrodynamics: which points, edges and motions converge on the grid?"""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import below, figure, look, plain_ticks
from studies.kit.table import Tables, groups
from studies.rb.figures.errors import PALE, SIGNS, floor, loglog, powers
from studies.rb.figures.names import FIXED_GROUPS, MOVING_GROUPS, grouped, numbered, words
from studies.rb.figures.variants import LOWER, dots, lines, say, sizes, sizes_of, tell_diverged
from studies.rb.looks import LAYER, OPEN, RA_SHOWN, diverged, errors, reference, rows

Frames = tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]     # errors, of other flows, runs that diverged
#: errors of moving points below are drawn linearly, above logarithmically  [%]
LINEAR = 1.0
TICKS = (-1000, -100, -10, -1, 0, 1, 10, 100, 1000)
RELATIVE = r"relative error  $|K/K_\mathrm{grid} - 1|$"
ROWS = "rows over the height $L$"
MOVE = ("moving", "motion")     # how the names of schemes begin whose points move
ROLLS = "{:.0f} rows: {:.0f} rolls instead of two"


def of_points(tables: Tables, *, move: bool) -> Frames:
    """Errors, other flows and lost runs of points that move or stay, at the Ra that have panels."""
    frames = errors(tables, method="dih", energy="Kp", **LAYER), other_flows(tables), diverged(tables, method="dih", **LAYER)
    moves = [frame["variant"].astype(str).str.startswith(MOVE) for frame in frames]
    chosen, others, lost = (frame[(here == move) & frame["ra"].isin(RA_SHOWN)] for frame, here in zip(frames, moves))
    return chosen, others, lost


def other_flows(tables: Tables) -> pd.DataFrame:
    """Points that ended in another number of rolls than the grid: no errors of the same flow, so in no row of `errors`."""
    means = rows(tables, "means", method="dih", **LAYER)
    means = means[np.isfinite(means["resolution"].astype(float))]
    limit = reference(tables, **LAYER).set_index("ra")
    means = means[means["ra"].isin(limit.index[limit["ke"] > 0])]
    grid_ke = means["ra"].map(limit["ke"]).astype(float)
    return means.assign(error=means["ke"]/grid_ke - 1)[means["rolls"] != means["ra"].map(limit["rolls"])]


# --- points that stay -----------------------------------------------------------------------------


def fixed(tables: Tables) -> Figure | None:
    """Errors of K on points that stay, against rows over the height: lattices above, then points off a lattice. Each
    line is one kind of edges.
    """
    frames = of_points(tables, move=False)
    if frames[0].empty:
        return None
    kinds = grouped({name for frame in frames for name in frame["variant"]}, FIXED_GROUPS)
    panels, heights = sorted({*frames[0]["ra"]}), sorted({*frames[0]["resolution"]})
    page, all_axes = figure(len(kinds), len(panels), width=5.4, height=4.7, sharex=True, sharey="row", squeeze=False)
    for line, (kind, names) in zip(all_axes, kinds.items()):
        for axes, ra in zip(line, panels):
            for name, style in numbered(names).items():
                one_scheme(axes, name, style, *(of(frame, variant=name, ra=ra) for frame in frames))
        size = pd.concat([frame.loc[frame["variant"].isin(names), "error"] for frame in frames[:2]]).abs()
        if len(size):
            floor(line[0], size)
        for axes, ra in zip(line, panels):
            finish(axes, f"Ra = {ra:g}: {kind}", heights)
        first = next(axes for axes in line if axes.get_visible())
        first.tick_params(labelleft=True)
        first.set_ylabel(RELATIVE)
    page.suptitle(f"What do fixed points and their edges make of $K$?\n{SIGNS}", fontsize=10)
    return page


def of(frame: pd.DataFrame, **wanted: object) -> pd.DataFrame:
    """The rows in which columns are as said."""
    return frame[np.logical_and.reduce([frame[column] == value for column, value in wanted.items()])]


def finish(axes: Axes, title: str, heights: list[float]) -> None:
    """Axes of a panel; one without data goes."""
    if not axes.has_data():
        axes.set_visible(False)
        return
    loglog(axes, title, ROWS, PALE)
    plain_ticks(axes, heights)
    axes.tick_params(labelbottom=True)


def one_scheme(axes: Axes, name: str, style: dict, chosen: pd.DataFrame, others: pd.DataFrame, lost: pd.DataFrame) -> None:
    """Errors over rows; what went to another flow is drawn too, what diverged is said in the legend."""
    notes = [ROLLS.format(row["resolution"], row["rolls"]) for _, row in others.iterrows()]
    notes += [f"{row['resolution']:.0f} rows: diverged" for _, row in lost.iterrows()]
    label = words(name) + (f"\n[{'; '.join(notes)}]" if notes else "")
    if len(chosen):
        powers(axes, chosen.sort_values("resolution"), label, style)
    elif notes:
        axes.errorbar([], [], [], label=label, **style)
    for _, row in others.iterrows():
        axes.plot(row["resolution"], abs(row["error"]), **style | OPEN | {"markersize": 8})


# --- points that move -----------------------------------------------------------------------------


def moving(tables: Tables) -> Figure | None:
    """Errors of K on points that move. Left against rows over the height; right, where there are others, without each
    ingredient and with the motions of RR98.
    """
    frames = of_points(tables, move=True)
    scheme = of(frames[0], variant="moving")
    ra = max((ra for frame in frames for ra in frame["ra"]), default=0)
    chosen, others, lost = (of(frame, ra=ra) for frame in frames)
    names = {name for frame in (chosen, others, lost) for name in frame["variant"]}
    if not names:
        return None
    many = len(names) > 1
    page, all_axes = figure(1, 1 + many, width=5 + many, height=max(5, 0.36*len(names) + 2.2*many), squeeze=False,
                            width_ratios=(2, 3) if many else None)
    over_rows(all_axes[0, 0], scheme)
    if many:
        ingredients(all_axes[0, 1], chosen, others, lost, names)
        all_axes[0, 1].set_title(f"other motions and ingredients, Ra = {ra:g}")
    question = ", what do its ingredients do?" if many else "?"
    page.suptitle(f"Points that move: does $K$ converge{question}", fontsize=10)
    return page


def over_rows(axes: Axes, scheme: pd.DataFrame) -> None:
    """Errors of the whole scheme."""
    for number, (ra, series) in enumerate(groups(scheme.sort_values("resolution"), "ra")):
        powers(axes, series, f"moving points, Ra = {ra:g}", look(number))
    if len(scheme):
        floor(axes, scheme["error"].abs())
    loglog(axes, "all ingredients: over rows", ROWS, SIGNS)
    if len(scheme):
        plain_ticks(axes, sorted({*scheme["resolution"]}))
    axes.set_ylabel(RELATIVE)


def ingredients(axes: Axes, chosen: pd.DataFrame, others: pd.DataFrame, lost: pd.DataFrame, names: set[str]) -> None:
    """One line for each variant; errors with their sign, logarithmic where they are large."""
    beside = chosen.loc[chosen["variant"] != "moving", "resolution"]
    chosen = chosen[chosen["resolution"].isin(beside)]
    at, order = lines(axes, grouped(names, MOVING_GROUPS)), sizes_of(chosen, others, lost)
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    dots(axes, at, chosen, "$K$", {**look(0), "marker": "o"}, order)
    tell_diverged(axes, at, lost, order)
    for _, row in others.iterrows():
        height = at[row["variant"]] + LOWER*order.index(row["resolution"])
        say(axes, height, 0.5, f"{ROLLS.format(row['resolution'], row['rolls'])}, {100*row['error']:+.0f} %")
    symlog(axes, 100*chosen["error"].abs().max() if len(chosen) else LINEAR)
    axes.set_xlabel(f"error of $K$ against the grid  [%]\nlinear to {LINEAR:g} %, logarithmic beyond")
    below(axes, title=f"{sizes(chosen, others, lost)}; bars: 95 % intervals", title_fontsize=8)


def symlog(axes: Axes, large: float) -> None:
    """Ticks of errors with their sign."""
    axes.set_xscale("symlog", linthresh=LINEAR)
    ticks = [tick for tick in TICKS if abs(tick) <= max(large, LINEAR)]
    axes.set_xticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axes.set_xticks([sign*tick for tick in (3, 30, 300) if tick <= large for sign in (1, -1)], minor=True)
    axes.tick_params(axis="x", which="minor", labelbottom=False)
