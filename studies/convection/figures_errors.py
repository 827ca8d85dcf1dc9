"""How wrong and how dear: errors of K against resolution, cost, walls and variants; the noise of the particles."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.convection.pick import (
    KIND,
    LAYER,
    SPAM,
    errors_of_k,
)
from studies.kit.figure import figure
from studies.kit.table import Tables

LABELS = {"kp": "$K_p$ of particles", "kg": "$K_g$, smoothed field"}
RA_SHOWN = (5000, 10000)
#: variants that differ from the printed one in their walls alone
WALLS = {"printed": "images at rest, $T_w$", "printed-fixed-rows": "fixed rows", "walls-odd": "images $-v$, $2T_w - T$",
         "walls-own-pressure": "images at rest, own $P$", "walls-odd-own-pressure": "images $-v$, own $P$"}
PLATES = {"lower": {**look(1), "marker": "^"}, "upper": {**look(0), "marker": "v"}}


def convergence(tables: Tables) -> Figure | None:
    """|K/K_grid - 1| against rows over the height."""
    found = errors_of_k(tables, **LAYER)
    panels = [(ra, group) for ra, group in found.groupby("ra") if ra in RA_SHOWN]
    if not panels:
        return None
    page, all_axes = figure(1, len(panels), width=5, height=4.4, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, energy, label, style in methods(group):
            powers(axes, series, energy, label, style)
        loglog(axes, f"Ra = {ra:g}", "rows over the height $L$")
        plain_ticks(axes, group["resolution"])
    all_axes[0, 0].set_ylabel(r"relative error of $K$,  $|K/K_\mathrm{grid} - 1|$")
    page.suptitle("Does the kinetic energy converge? Open marks: too small. Reference: grid extrapolated", fontsize=10)
    return page


def powers(axes: Axes, series: pd.DataFrame, energy: str, label: str, style: dict) -> None:
    """Errors of one method with the power law through them."""
    series = series.sort_values("resolution")
    n, error = series["resolution"].to_numpy(float), series[energy].to_numpy(float)
    if len(n) > 1 and (error != 0).all():
        slope, constant = np.polyfit(np.log(n), np.log(np.abs(error)), 1)
        axes.plot(n, np.exp(constant)*n**slope, **style | {"marker": "", "lw": 0.8})
        label += f": slope {slope:+.1f}"
    signed(axes, n, error, series[f"{energy}_err"].to_numpy(float), label=label, **style)


def signed(axes: Axes, x: np.ndarray, error: np.ndarray, err: np.ndarray, label: str, **style: Any) -> None:
    """|error| with its interval; filled where it is positive, open where negative."""
    size = np.abs(error)
    down = np.minimum(err, 0.999*size)       # a logarithmic axis has no room for an interval across zero
    for sign, face in ((error >= 0, None), (error < 0, "white")):
        more = {} if face is None else {"markerfacecolor": face}
        if sign.any():
            axes.errorbar(x[sign], size[sign], [down[sign], err[sign]], label=label, **style | more | {"linestyle": "none"})
            label = ""


def loglog(axes: Axes, title: str, xlabel: str) -> None:
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    axes.legend(loc="best")


def plain_ticks(axes: Axes, values: Any) -> None:
    """Ticks at the resolutions there are, instead of powers of ten."""
    axes.set_xticks(sorted(set(values)), labels=[f"{v:.0f}" for v in sorted(set(values))])
    axes.tick_params(axis="x", which="minor", bottom=False, labelbottom=False)


def cost(tables: Tables) -> Figure | None:
    """|K/K_grid - 1| against CPU seconds; how long a step takes, measured alone, where that is known."""
    found, spent, steps = errors_of_k(tables, **LAYER), rows(tables, "errors", **LAYER), rows(tables, "cost")
    found = found.merge(spent[[*POINT, "cpu_s"]], on=POINT) if len(spent) else found.iloc[:0]
    panels = [(ra, group) for ra, group in found.groupby("ra") if ra in RA_SHOWN]
    count = len(panels) + (len(steps) > 0)
    if not count:
        return None
    page, all_axes = figure(1, count, width=4.8, height=4.2, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, energy, label, style in methods(group):
            dear(axes, series.sort_values("resolution"), energy, label, style)
        loglog(axes, f"Ra = {ra:g}, numbers: rows over the height", "CPU seconds without compiling")
        axes.set_ylabel(r"relative error of $K$,  $|K/K_\mathrm{grid} - 1|$")
    if len(steps):
        step_cost(all_axes[0, -1], steps)
    page.suptitle("What does an error of the kinetic energy cost? Open marks: $K$ too small", fontsize=10)
    return page


def methods(found: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, str, str, dict]]:
    """(rows, energy, label, look) of each method: the printed particles twice, each grid once."""
    for (method, variant), series in found.groupby(["method", "variant"]):
        if (method, variant) == tuple(SPAM.values()):
            yield from ((series, energy, label, KIND[energy]) for energy, label in LABELS.items())
        elif method != "spam":
            own = (method, variant) == tuple(GRID.values())
            yield series, "kp", method if own else f"{method}, {variant}", KIND["grid" if own else "pypde"]


def dear(axes: Axes, series: pd.DataFrame, energy: str, label: str, style: dict) -> None:
    """One method's errors over its seconds, each with its number of rows."""
    x, error = series["cpu_s"].to_numpy(float), series[energy].to_numpy(float)
    axes.plot(x, np.abs(error), **style | {"marker": "", "lw": 0.8})
    signed(axes, x, error, series[f"{energy}_err"].to_numpy(float), label=label, **style)
    for at, value, size in zip(x, np.abs(error), series["resolution"]):
        axes.annotate(f"{size:.0f}", (at, value), xytext=(5, 4), textcoords="offset points", fontsize=7)


def step_cost(axes: Axes, steps: pd.DataFrame) -> None:
    """Nanoseconds a point and step."""
    for number, ((method, variant, eos), series) in enumerate(steps.groupby(["method", "variant", "eos"])):
        series, unit = series.sort_values("points"), 1e9/series.sort_values("points")["points"]
        errorbar(axes, series["points"], series["step_s"]*unit, series["step_s_err"]*unit, number=number,
                 label=" ".join(filter(None, (method, variant, eos))), linestyle="-")
    loglog(axes, "one step, measured alone", "points (particles or cells)")
    axes.set_ylabel("time per point and step  [ns]")


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
        dots(axes[0], names, found, column, f"{column}_err", label, KIND[kind])
    dots(axes[1], names, found, "nu", "nu_err", "", KIND["kp"])
    layers(axes[2:], names, rows(tables, "walls", method="spam", **LAYER, ra=ra), found)
    references(axes, tables, ra, found["resolution"].max())
    for one, xlabel in zip(axes, (ENERGY, "Nusselt number", r"density in the layer  [$m/\sigma^2$]",
                                  r"temperature in the layer  [$\varepsilon/(m k_B)$]")):
        one.set_xlabel(xlabel, fontsize=9)
        one.legend(loc="best", fontsize=7)
    axes[0].set_yticks(range(len(names)), labels=[WALLS[name] for name in names])
    axes[0].set_ylim(len(names) - 0.5, -0.5)
    page.suptitle(f"What the wall rule does at Ra = {ra:g}; layer: one spacing from the plate; open marks: "
                  f"{sizes(found)}; vertical lines: grid", fontsize=10)
    return page


def sizes(found: pd.DataFrame) -> str:
    """Resolutions, the finest first."""
    fine, *coarse = sorted(found["resolution"].unique(), reverse=True)
    return ", ".join(f"{size:.0f}" for size in coarse) + f" rows, filled: {fine:.0f}" if coarse else f"none, filled: {fine:.0f} rows"


def dots(axes: Axes, names: list[str], found: pd.DataFrame, column: str, err: str, label: str, style: dict,
         scale: float = 1.0) -> None:
    """One mark a variant and resolution; the finest filled, coarser ones open and lower."""
    for number, (size, group) in enumerate(sorted(found.groupby("resolution"), key=lambda item: -item[0])):
        face = {"markerfacecolor": "white"} if number else {}
        y = np.array([names.index(name) for name in group["variant"]]) + 0.16*number
        axes.errorbar(scale*group[column], y, xerr=scale*group[err], label=label if number == 0 else "",
                      **style | face | {"linestyle": "none"})


def layers(axes: Any, names: list[str], found: pd.DataFrame, means: pd.DataFrame) -> None:
    """Density and temperature at the hot and the cold plate, means over seeds."""
    found = found[found["variant"].isin(names) & found["resolution"].isin(means["resolution"])]
    for plate, style in PLATES.items():
        at = found[found["plate"] == plate]
        for one, column in zip(axes, ("rho_layer", "T_layer")) if len(at) else ():
            dots(one, names, over_seeds(at, ["variant", "resolution"], column), column, "err", f"{plate} plate", style)


def references(axes: Any, tables: Tables, ra: float, size: float) -> None:
    """Vertical lines: the extrapolated grid, and its fields half a spacing from the plates."""
    style = {"color": "black", "marker": "", "ls": "-", "lw": 1, "zorder": 0}
    for row in reference(tables, **LAYER, ra=ra).itertuples():
        axes[0].axvline(row.ke, **style)
        axes[1].axvline(row.nu, **style)
    fields = rows(tables, "fields", **GRID, **LAYER, ra=ra)
    mean = fields.groupby("y")[["rho", "T"]].mean()
    for edge, inward in ((mean, 1), (mean.iloc[::-1], -1)) if len(mean) > 1 else ():
        step = (inward*(edge.index[1] - edge.index[0]), 0.5 + inward*edge.index[0] - 0.5/size)
        at = edge.iloc[0] - (edge.iloc[1] - edge.iloc[0])*step[1]/step[0]
        axes[2].axvline(at["rho"], **style)
        axes[3].axvline(at["T"], **style)


def variants(tables: Tables) -> Figure | None:
    """Errors of Kp and Kg of every variant."""
    found = errors_of_k(tables, **LAYER, )
    found = found[(found["method"] == "spam") & found["resolution"].isin((25, 50)) & found["ra"].isin(RA_SHOWN)]
    names = sorted(found["variant"].unique(), key=lambda name: (name != "printed", name))
    if len(names) < 2:
        return None
    panels = list(found.groupby("ra"))
    page, all_axes = figure(1, len(panels), width=4.8, height=0.36*len(names) + 1.6, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        axes.axvline(0, color="black", marker="", ls="-", lw=1, zorder=0)
        for energy, label in LABELS.items():
            dots(axes, names, group, energy, f"{energy}_err", label, KIND[energy], scale=100)
        axes.set(title=f"Ra = {ra:g}", xlabel=r"error of $K$ against the grid  [%]")
    all_axes[0, 0].legend(loc="best")
    all_axes[0, 0].set_yticks(range(len(names)), labels=names)
    all_axes[0, 0].set_ylim(len(names) - 0.5, -0.5)
    page.suptitle(f"Which change of the printed scheme helps? Open marks: {sizes(found)}", fontsize=10)
    return page


def fluctuations(tables: Tables) -> Figure | None:
    """Kfl = Kp - Kg of the printed scheme against Ra and against rows."""
    runs = rows(tables, "kinetic_energy", **SPAM, **LAYER)
    if runs.empty:
        return None
    found = over_seeds(runs, ["resolution", "ra"], "ke_fluctuation")
    page, (left, right) = figure(1, 2, width=4.6, height=4, sharey=True)
    for axes, one, other, label in ((left, "ra", "resolution", "{:.0f} rows"), (right, "resolution", "ra", "Ra = {:g}")):
        for number, (value, group) in enumerate(found.groupby(other)):
            errorbar(axes, group[one], group["ke_fluctuation"], group["err"], number=number, label=label.format(value),
                     linestyle=look(number)["linestyle"])
        axes.set(xscale="log", ylim=(0, None))
        axes.legend(loc="best")
        plain_ticks(axes, found[one])
    left.set(xlabel="Rayleigh number Ra", ylabel=r"energy of the noise $K_p - K_g$  [$\varepsilon/m$]")
    right.set_xlabel("rows over the height $L$")
    page.suptitle("Particles tremble: how much of their kinetic energy is not flow?", fontsize=10)
    return page
