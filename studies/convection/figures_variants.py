"""What walls and other changes of the printed scheme do: dots with error bars, the grid as a line.

A variant whose runs diverged has no dot: a text stands in its place.
"""
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from continuum.published import published
from studies.convection.figures_errors import RA_SHOWN
from studies.convection.pick import (
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
from studies.kit.figure import figure, look
from studies.kit.table import Tables

#: particle rows that the variants are compared at
SIZES = (25, 50)
#: errors beyond are told in words  [%]
WIDEST = 100
#: variants that differ from the printed one in their walls alone
WALLS = {"printed": "images at rest, $T_w$", "printed-fixed-rows": "fixed rows",
         "walls-odd": "images $-v$, $2T_w - T$", "walls-own-pressure": "images at rest, own $P$",
         "walls-odd-own-pressure": "images $-v$, own $P$"}
PLATES = {"lower": {**look(1), "marker": "^", "linestyle": "--"}, "upper": {**look(0), "marker": "v", "linestyle": ":"}}
#: dots of the plates stand as much below and above the variant's line, not to cover each other
APART = {"lower": 0.07, "upper": -0.07}
HEAT = {"lower": "hot", "upper": "cold"}
XLABELS = (r"kinetic energy $K$  [$10^{-3}\varepsilon/m$]", "Nusselt number", r"density in the layer  [$m/\sigma^2$]",
           r"$|T_\mathrm{layer} - T_\mathrm{plate}|$  [$\varepsilon/(m k_B)$]")


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
    page, axes = figure(1, 4, width=3, height=0.55*len(names) + 2, sharey=True)
    for column, label, kind in (("ke", "$K_p$", "kp"), ("ke_field", "$K_g$", "kg")):
        dots(axes[0], names, found, column, f"{column}_err", label, KIND[kind], scale=1000)
    dots(axes[1], names, found, "nu", "nu_err", "through the fluid", KIND["kp"] | {"color": "black"})
    at_plates(axes[1:], names, rows(tables, "walls", method="spam", **LAYER, ra=ra), found)
    references(axes, tables, ra, found["resolution"].max())
    tell_diverged(axes[0], names, lost, sizes_of(found, lost))
    for one, xlabel in zip(axes, XLABELS):
        one.set_xlabel(xlabel, fontsize=9)
        one.xaxis.set_major_locator(MaxNLocator(5))
        one.margins(x=0.1)
        if one.get_legend_handles_labels()[0]:
            one.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=7, ncols=2)
    axes[0].set_yticks(range(len(names)), labels=[WALLS[name] for name in names])
    axes[0].set(ylabel="wall rule", ylim=(len(names) - 0.5, -0.5))
    page.suptitle(f"What the wall rule does at Ra = {ra:g}; layer: one spacing from the plate; "
                  f"{sizes(found)}; vertical lines: grid; bars: 95 %", fontsize=10)
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
LOWER = 0.27


def dots(axes: Axes, names: list[str], found: pd.DataFrame, column: str, err: str, label: str, style: dict,
         scale: float = 1.0, order: list[float] | None = None, shift: float = 0.0) -> None:
    """One mark a variant and resolution; the finest filled, coarser ones open and lower; all of them by `shift`."""
    for number, size in enumerate(order or sizes_of(found)):
        group = found[found["resolution"] == size]
        face = {"markerfacecolor": "white"} if number else {}
        y = pd.Series([names.index(name) + LOWER*number + shift for name in group["variant"]], group.index, float)
        axes.errorbar(scale*group[column], y, xerr=scale*group[err], label=label if number == 0 else "",
                      **style | face | {"linestyle": "none"})
        if "steady" in group:
            cross_out(axes, scale*group[column], y, group["steady"])


def tell_diverged(axes: Axes, names: list[str], lost: pd.DataFrame, order: list[float]) -> None:
    """In place of a point or, when other seeds have left one, below it that runs diverged."""
    for _, row in lost.iterrows():
        whole, at = row["lost"] == row["seeds"], names.index(row["variant"])
        seeds = "" if whole else f"{row['lost']} of {row['seeds']} seeds "
        say(axes, at + (LOWER*order.index(row["resolution"]) if whole else 2*LOWER), 0.5,
            f"{row['resolution']:.0f} rows: {seeds}diverged at t = {row['t']:.3g} {TIME}")


def say(axes: Axes, y: float, x: float, words: str) -> None:
    """Words at the height of a variant, x as a fraction of the axes; in front of lines, behind marks."""
    axes.annotate(words, (x, y), xycoords=("axes fraction", "data"), ha="center" if x == 0.5 else "right", va="center",
                  fontsize=7, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5}, zorder=1)


def at_plates(axes: Any, names: list[str], found: pd.DataFrame, means: pd.DataFrame) -> None:
    """Nusselt number, density and jump of the temperature at the hot and the cold plate, means over seeds."""
    found = found[found["variant"].isin(names) & found["resolution"].isin(means["resolution"])]
    found = found.assign(jump=(found["T_layer"] - found["T_wall"]).abs())
    for plate, style in PLATES.items():
        at = found[found["plate"] == plate]
        for one, column, err in zip(axes, ("nu_plate", "rho_layer", "jump"), ("nu_plate_err", "", "")):
            mean = over_seeds(at, ["variant", "resolution"], column, err)
            if len(mean):
                dots(one, names, mean, column, "err", f"{plate} plate", style, order=sizes_of(means), shift=APART[plate])


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
    """Errors of Kp and Kg of every variant."""
    found, lost = (at_sizes(frame) for frame in (of_energy(errors(tables, method="spam", **LAYER)), diverged(tables, **LAYER)))
    names = sorted({*found["variant"], *lost["variant"]}, key=lambda name: (name != "printed", name))
    if len(names) < 2:
        return None
    shown = sorted({*found["ra"], *lost["ra"]})
    page, all_axes = figure(1, len(shown), width=4.8, height=0.4*len(names) + 1.8, sharey=True, squeeze=False)
    for axes, ra in zip(all_axes[0], shown):
        one_ra(axes, names, found[found["ra"] == ra], lost[lost["ra"] == ra])
        axes.set(title=f"Ra = {ra:g}", xlabel=r"error of $K$ against the grid  [%]")
    handles = {label: handle for axes in all_axes[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    if handles:
        page.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3,
                    title=f"{sizes(found, lost)}; $K_g$ against the grid's field smoothed likewise; bars: 95 %",
                    title_fontsize=8)
    all_axes[0, 0].set_yticks(range(len(names)), labels=names)
    all_axes[0, 0].set(ylabel="variant", ylim=(len(names) - 0.5, -0.5))
    page.suptitle("Which change of the printed scheme helps?", fontsize=10)
    return page


def at_sizes(found: pd.DataFrame) -> pd.DataFrame:
    """What the variants are compared at."""
    return found[found["resolution"].isin(SIZES) & found["ra"].isin(RA_SHOWN)]


def one_ra(axes: Axes, names: list[str], found: pd.DataFrame, lost: pd.DataFrame) -> None:
    """All variants at one Ra; errors too large for the axis in words, at its edge."""
    axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
    order = sizes_of(found, lost)
    inside = found["error"].abs() <= WIDEST/100
    for energy, label in LABELS.items():
        one = found[inside & (found["energy"].str.lower() == energy)]
        dots(axes, names, one, "error", "error_err", label, KIND[energy], 100, order)
    for (variant, size), rest in groups(found[~inside], ["variant", "resolution"]):
        told = ", ".join(f"${name[0]}_{name[1]}$ {100*error:+.0f} %" for name, error in zip(rest["energy"], rest["error"]))
        say(axes, names.index(variant) + LOWER*order.index(size), 0.98, f"{told} $\\rightarrow$")
    tell_diverged(axes, names, lost, order)
