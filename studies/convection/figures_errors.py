"""How wrong and how dear: errors of K and of heat transport against resolution, of K against cost; the particles' noise."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.convection.pick import (
    GRID,
    KIND,
    LABELS,
    LAYER,
    NUSSELT,
    SPAM,
    cross_out,
    errors,
    groups,
    of_energy,
    over_seeds,
    rows,
)
from studies.kit.figure import below, figure, look
from studies.kit.table import Tables

#: Rayleigh numbers that have a panel
RA_SHOWN = (5000, 10000)
#: grids with another number of rolls, other temperatures or wrong heating, which the particles are not compared with
OTHER_FLOWS = ("two-rolls", "fig10", "edge-heat")
#: of discretized integral hydrodynamics; the others have a figure of their own
POINTS = ("fixed-lattice", "fixed-jittered-plates", "moving")
#: an error with what it is relative to: the grid, for Kg its field smoothed as the particles smooth theirs
RELATIVE = r"relative error  $|K_p/K - 1|$, $|K_g/K_\mathrm{smoothed} - 1|$"
#: K_s of the printed weight, see the table `smoothed`
PRINTED_WEIGHT = {"weight": "Lucy", "h": 3}


def convergence(tables: Tables) -> Figure | None:
    """Relative errors of Kp, Kg and Nu against rows over the height, and what smoothing alone takes from the grid."""
    found = errors(tables, **LAYER)
    panels = shown(found[(found["method"] == SPAM["method"]) | (found["energy"] == "Kp")])
    if not panels:
        return None
    page, all_axes = figure(1, len(panels), width=5, height=5.4, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, label, style in methods(group):
            powers(axes, series, label, style)
        floor(axes, pd.concat([group["error"].abs(), smoothing(axes, tables, ra)]))
        loglog(axes, f"Ra = {ra:g}", "rows over the height $L$")
        plain_ticks(axes, group["resolution"])
    heat = any("Nu" in set(group["energy"]) for _, group in panels)
    all_axes[0, 0].set_ylabel(RELATIVE + (r", $|\mathrm{Nu}_p/\mathrm{Nu} - 1|$" if heat else ""), fontsize=9)
    page.suptitle(f"Does $K$ converge{', does the heat transport' if heat else ''}?\n"
                  "Open marks: too small; bars: 95 % intervals", fontsize=10)
    return page


def shown(found: pd.DataFrame) -> list[tuple[float, pd.DataFrame]]:
    """The Rayleigh numbers of the panels, each with its rows of grids, of the printed particles and of some on points."""
    printed = found[(found["method"] != "spam") | (found["variant"] == SPAM["variant"])]
    printed = printed[~printed["variant"].isin(OTHER_FLOWS) & ((printed["method"] != "dih") | printed["variant"].isin(POINTS))]
    return [(ra, group) for ra, group in groups(printed, "ra") if ra in RA_SHOWN]


def smoothing(axes: Axes, tables: Tables, ra: float) -> pd.Series:
    """1 - K_smoothed/K of the grid's own field: what the weight alone takes away, drawn as a line."""
    found = rows(tables, "smoothed", **GRID, **LAYER, **PRINTED_WEIGHT, ra=ra).sort_values("rows")
    taken = 1 - found["ke_smoothed"]/found["ke"]
    if len(found):
        axes.plot(found["rows"], taken, color=KIND["kg"]["color"], marker="", lw=2.5, ls=":",
                  label=r"$1 - K_\mathrm{smoothed}/K$: the smoothing alone")
    return taken


def powers(axes: Axes, series: pd.DataFrame, label: str, style: dict) -> None:
    """Errors of one method with the power law through them."""
    n, error, err = (series[name].to_numpy(float) for name in ("resolution", "error", "error_err"))
    if len(n) > 1 and abs(np.sign(error).sum()) == len(n):     # errors that change sign have no power
        fit, slope_err = power(n, np.abs(error), err)
        axes.plot(n, np.exp(np.polyval(fit, np.log(n))), **style | {"marker": "", "lw": 0.8})
        label += f": slope {fit[0]:.1f}" + (f" $\\pm$ {slope_err:.1f}" if slope_err > 0.05 else "")
    signed(axes, series, "resolution", label, style)


def power(n: np.ndarray, size: np.ndarray, err: np.ndarray) -> tuple[np.ndarray, float]:
    """(slope, constant) of log size over log n, and the half width of the slope's 95 % interval.

    Where the points scatter about the line by more than their errors, the interval is as much wider.
    """
    weight = size/np.maximum(err, 1e-6*size)
    fit, cov = np.polyfit(np.log(n), np.log(size), 1, w=weight, cov="unscaled")
    chi2 = float(np.sum((1.96*weight*(np.log(size) - np.polyval(fit, np.log(n))))**2))
    return fit, float(np.sqrt(cov[0, 0]*max(1.0, chi2/max(1, len(n) - 2))))


def signed(axes: Axes, series: pd.DataFrame, column: str, label: str, style: dict) -> None:
    """|error| over a column, with its interval; filled where the error is positive, open where negative."""
    size = series["error"].abs()
    down = np.minimum(series["error_err"], 0.999*size)       # a logarithmic axis has no room for an interval across zero
    for sign, face in ((series["error"] >= 0, {}), (series["error"] < 0, {"markerfacecolor": "white"})):
        if sign.any():
            axes.errorbar(series.loc[sign, column], size[sign], [down[sign], series.loc[sign, "error_err"]], label=label,
                          **style | face | {"linestyle": "none"})
            label = ""
    cross_out(axes, series[column], size, series["steady"])


def floor(axes: Axes, size: pd.Series) -> None:
    """Intervals that reach zero leave the picture below the smallest error."""
    axes.set_ylim(0.4*size[size > 0].min(), 2*size.max())


def loglog(axes: Axes, title: str, xlabel: str) -> None:
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 2000*low else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    below(axes)


def plain_ticks(axes: Axes, values: Any) -> None:
    """Ticks at the values there are, instead of powers of ten; of two that are close only the first has its number."""
    kept: list[float] = []
    for value in sorted(set(values)):
        kept += [value] if not kept or value > 1.1*kept[-1] else []
    axes.set_xticks(kept, labels=[f"{value:.0f}" for value in kept])
    axes.set_xticks(sorted({*values} - {*kept}), minor=True)
    axes.tick_params(axis="x", which="minor", labelbottom=False)


def cost(tables: Tables) -> Figure | None:
    """Relative errors of Kp and Kg against CPU seconds; how long a step takes, measured alone, where that is known."""
    panels, steps = shown(of_energy(errors(tables, **LAYER))), rows(tables, "cost")
    count = len(panels) + (len(steps) > 0)
    if not count:
        return None
    page, all_axes = figure(1, count, width=4.8, height=5.2, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, label, style in methods(group):
            dear(axes, series, label, style)
        floor(axes, group["error"].abs())
        loglog(axes, f"Ra = {ra:g}, numbers: rows over the height", "CPU seconds: all seeds; grids with those they started from")
        axes.set_ylabel(RELATIVE)
    if len(steps):
        step_cost(all_axes[0, -1], steps)
    page.suptitle("What does an error of $K$ cost, compiling apart?\nOpen marks: $K$ too small; bars: 95 % intervals",
                  fontsize=10)
    return page


def methods(found: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, str, dict]]:
    """(rows by resolution, label, look) of each method: particles for Kp, Kg and Nu, each grid once."""
    others = 0
    for (method, variant, energy), series in groups(found.sort_values("resolution"), ["method", "variant", "energy"]):
        if method == "spam":
            yield series, (LABELS | NUSSELT)[energy.lower()], KIND[energy.lower()]
        elif (method, variant) == tuple(GRID.values()) and energy == "Kp":      # the field is all that a grid has
            yield series, "compressible grid", KIND["grid"]
        elif energy == "Kp":
            yield series, f"{method}, {variant}", look(4 + others)
            others += 1


def dear(axes: Axes, series: pd.DataFrame, label: str, style: dict) -> None:
    """One method's errors over its seconds, each with its number of rows."""
    size = series["error"].abs()
    axes.plot(series["cpu_s"], size, **style | {"marker": "", "lw": 0.8})
    signed(axes, series, "cpu_s", label, style)
    where = {"xytext": (-5, -3), "ha": "right"} if style is KIND["kp"] else {"xytext": (5, 4)}
    for at, value, resolution in zip(series["cpu_s"], size, series["resolution"]):
        axes.annotate(f"{resolution:.0f}", (at, value), textcoords="offset points", fontsize=7, **where)
    axes.margins(x=0.12)


def step_cost(axes: Axes, steps: pd.DataFrame) -> None:
    """Nanoseconds a point and step."""
    known = {(*SPAM.values(), "ideal", "periodic"): KIND["kp"], (*GRID.values(), "ideal", "periodic"): KIND["grid"]}
    for number, (what, series) in enumerate(groups(steps, ["method", "variant", "eos", "sides"])):
        series = series.sort_values("points")
        nanoseconds, err = (1e9*series[name]/series["points"] for name in ("step_s", "step_s_err"))
        axes.errorbar(series["points"], nanoseconds, err, label=", ".join(filter(None, what)),
                      **known.get(what, look(number + 2)))
    loglog(axes, "one step, measured alone", "points (particles or cells)")
    axes.set_ylabel("CPU time per point and step  [ns]")


def fluctuations(tables: Tables) -> Figure | None:
    """Kfl = Kp - Kg of the printed scheme against Ra and against rows."""
    runs = rows(tables, "kinetic_energy", **SPAM, **LAYER)
    runs = runs[runs["ke"].notna()]        # not those that diverged
    if runs.empty:
        return None
    found = over_seeds(runs, ["resolution", "ra"], "ke_fluctuation")
    page, (left, right) = figure(1, 2, width=4.6, height=4, sharey=True)
    for axes, one, other, label in ((left, "ra", "resolution", "{:.0f} rows"),
                                    (right, "resolution", "ra", "Ra = {:g}")):
        for number, (value, group) in enumerate(groups(found, other)):
            axes.errorbar(group[one], group["ke_fluctuation"], group["err"], label=label.format(value), **look(number))
        axes.set(xscale="log", ylim=(0, None))
        axes.legend(loc="best")
        plain_ticks(axes, found[one])
    left.set(xlabel="Rayleigh number Ra", ylabel=r"energy of the noise $K_p - K_g$  [$\varepsilon/m$]")
    right.set_xlabel("rows over the height $L$")
    page.suptitle("Particles tremble: how much of their kinetic energy is not flow? Bars: 95 % intervals", fontsize=10)
    return page
