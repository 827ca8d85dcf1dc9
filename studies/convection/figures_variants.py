"""What walls and other changes of the printed scheme do: dots with error bars, the grid as a line."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from continuum.published import published
from studies.convection.figures_errors import RA_SHOWN
from studies.convection.pick import GRID, KIND, LABELS, LAYER, errors_of_k, groups, nearest, over_seeds, reference, rows
from studies.kit.figure import figure, look
from studies.kit.table import Tables

#: variants that differ from the printed one in their walls alone
WALLS = {"printed": "images at rest, $T_w$", "printed-fixed-rows": "fixed rows",
         "walls-odd": "images $-v$, $2T_w - T$", "walls-own-pressure": "images at rest, own $P$",
         "walls-odd-own-pressure": "images $-v$, own $P$"}
PLATES = {"lower": {**look(1), "marker": "^"}, "upper": {**look(0), "marker": "v"}}
HEAT = {"lower": "hot", "upper": "cold"}
XLABELS = (r"kinetic energy $K$  [$10^{-3}\varepsilon/m$]", "Nusselt number", r"density in the layer  [$m/\sigma^2$]",
           r"$|T_\mathrm{layer} - T_\mathrm{plate}|$  [$\varepsilon/(m k_B)$]")


def walls(tables: Tables) -> Figure | None:
    """Energies, heat flow and the layer at each plate for every wall rule."""
    found = rows(tables, "means", method="spam", **LAYER)
    found = nearest(found[found["variant"].isin(WALLS)])
    names = [name for name in WALLS if name in set(found["variant"])]
    if len(names) < 2:
        return None
    found = found[found["resolution"].isin(found.loc[found["variant"] != "printed", "resolution"])]
    ra = found["ra"].iloc[0]
    page, axes = figure(1, 4, width=3, height=0.55*len(names) + 1.8, sharey=True)
    for column, label, kind in (("ke", "$K_p$", "kp"), ("ke_field", "$K_g$", "kg")):
        dots(axes[0], names, found, column, f"{column}_err", label, KIND[kind], scale=1000)
    dots(axes[1], names, found, "nu", "nu_err", "", KIND["kp"])
    layers(axes[2:], names, rows(tables, "walls", method="spam", **LAYER, ra=ra), found)
    references(axes, tables, ra, found["resolution"].max())
    for one, xlabel in zip(axes, XLABELS):
        one.set_xlabel(xlabel, fontsize=9)
        one.xaxis.set_major_locator(MaxNLocator(5))
        one.margins(x=0.1)
        if one.get_legend_handles_labels()[0]:
            one.legend(loc="best", fontsize=7)
    axes[0].set_yticks(range(len(names)), labels=[WALLS[name] for name in names])
    axes[0].set(ylabel="wall rule", ylim=(len(names) - 0.5, -0.5))
    page.suptitle(f"What the wall rule does at Ra = {ra:g}; layer: one spacing from the plate; "
                  f"{sizes(found)}; vertical lines: grid", fontsize=10)
    return page


def sizes(found: pd.DataFrame) -> str:
    """Resolutions, the finest first."""
    fine, *coarse = (f"{size:.0f}" for size in sorted(found["resolution"].unique(), reverse=True))
    return f"filled: {fine} rows" + (f", open: {', '.join(coarse)}" if coarse else "")


def dots(axes: Axes, names: list[str], found: pd.DataFrame, column: str, err: str, label: str, style: dict,
         scale: float = 1.0) -> None:
    """One mark a variant and resolution; the finest filled, coarser ones open and lower."""
    for number, (_, group) in enumerate(reversed(groups(found, "resolution"))):
        face = {"markerfacecolor": "white"} if number else {}
        y = np.array([names.index(name) for name in group["variant"]]) + 0.16*number
        axes.errorbar(scale*group[column], y, xerr=scale*group[err], label=label if number == 0 else "",
                      **style | face | {"linestyle": "none"})


def layers(axes: Any, names: list[str], found: pd.DataFrame, means: pd.DataFrame) -> None:
    """Density and jump of the temperature at the hot and the cold plate, means over seeds."""
    found = found[found["variant"].isin(names) & found["resolution"].isin(means["resolution"])]
    found = found.assign(jump=(found["T_layer"] - found["T_wall"]).abs())
    for plate, style in PLATES.items():
        at = found[found["plate"] == plate]
        for one, column in zip(axes, ("rho_layer", "jump")) if len(at) else ():
            dots(one, names, over_seeds(at, ["variant", "resolution"], column), column, "err", f"{plate} plate", style)


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
            one.axvline(value, **style | {"color": PLATES[plate]["color"], "ls": "--"})


def variants(tables: Tables) -> Figure | None:
    """Errors of Kp and Kg of every variant."""
    found = errors_of_k(tables, **LAYER)
    found = found[(found["method"] == "spam") & found["resolution"].isin((25, 50)) & found["ra"].isin(RA_SHOWN)]
    names = sorted(found["variant"].unique(), key=lambda name: (name != "printed", name))
    if len(names) < 2:
        return None
    panels = groups(found, "ra")
    page, all_axes = figure(1, len(panels), width=4.8, height=0.36*len(names) + 1.6, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
        for energy, label in LABELS.items():
            dots(axes, names, group, energy, f"{energy}_err", label, KIND[energy], scale=100)
        axes.set(title=f"Ra = {ra:g}", xlabel=r"error of $K$ against the grid  [%]")
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2,
                title=sizes(found), title_fontsize=8)
    all_axes[0, 0].set_yticks(range(len(names)), labels=names)
    all_axes[0, 0].set(ylabel="variant", ylim=(len(names) - 0.5, -0.5))
    page.suptitle("Which change of the printed scheme helps?", fontsize=10)
    return page
