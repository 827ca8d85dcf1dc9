"""How wrong and how dear: errors of K against resolution and cost; the noise of the particles."""
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
    SPAM,
    errors_of_k,
    groups,
    over_seeds,
    rows,
)
from studies.convection.tables import POINT
from studies.kit.figure import figure, look
from studies.kit.table import Tables

#: Rayleigh numbers that have a panel
RA_SHOWN = (5000, 10000)


def convergence(tables: Tables) -> Figure | None:
    """|K/K_grid - 1| against rows over the height."""
    found = errors_of_k(tables, **LAYER)
    panels = [(ra, group) for ra, group in groups(found, "ra") if ra in RA_SHOWN]
    if not panels:
        return None
    page, all_axes = figure(1, len(panels), width=5, height=4.4, sharey=True, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, energy, label, style in methods(group):
            powers(axes, series, energy, label, style)
        floor(axes, group)
        loglog(axes, f"Ra = {ra:g}", "rows over the height $L$")
        plain_ticks(axes, group["resolution"])
    all_axes[0, 0].set_ylabel(r"relative error  $|K/K_\mathrm{grid, extrapolated} - 1|$")
    page.suptitle("Does $K$ converge? Open marks: $K$ too small", fontsize=10)
    return page


def powers(axes: Axes, series: pd.DataFrame, energy: str, label: str, style: dict) -> None:
    """Errors of one method with the power law through them."""
    series = series.sort_values("resolution")
    n, error = series["resolution"].to_numpy(float), series[energy].to_numpy(float)
    err = series[f"{energy}_err"].to_numpy(float)
    if len(n) > 1 and abs(np.sign(error).sum()) == len(n):     # errors that change sign have no power
        fit, slope_err = power(n, np.abs(error), err)
        axes.plot(n, np.exp(np.polyval(fit, np.log(n))), **style | {"marker": "", "lw": 0.8})
        label += f": slope {fit[0]:.1f}" + (f" $\\pm$ {slope_err:.1f}" if slope_err > 0.05 else "")
    signed(axes, n, error, err, label=label, **style)


def power(n: np.ndarray, size: np.ndarray, err: np.ndarray) -> tuple[np.ndarray, float]:
    """(slope, constant) of log size over log n, and the half width of the slope's 95 % interval.

    Where the points scatter about the line by more than their errors, the interval is as much wider.
    """
    weight = size/np.maximum(err, 1e-6*size)
    fit, cov = np.polyfit(np.log(n), np.log(size), 1, w=weight, cov="unscaled")
    chi2 = float(np.sum((1.96*weight*(np.log(size) - np.polyval(fit, np.log(n))))**2))
    return fit, float(np.sqrt(cov[0, 0]*max(1.0, chi2/max(1, len(n) - 2))))


def signed(axes: Axes, x: np.ndarray, error: np.ndarray, err: np.ndarray, label: str, **style: Any) -> None:
    """|error| with its interval; filled where it is positive, open where negative."""
    size = np.abs(error)
    down = np.minimum(err, 0.999*size)       # a logarithmic axis has no room for an interval across zero
    for sign, face in ((error >= 0, None), (error < 0, "white")):
        more = {} if face is None else {"markerfacecolor": face}
        if sign.any():
            axes.errorbar(x[sign], size[sign], [down[sign], err[sign]], label=label,
                          **style | more | {"linestyle": "none"})
            label = ""


def floor(axes: Axes, found: pd.DataFrame) -> None:
    """Intervals that reach zero leave the picture below the smallest error."""
    shown = pd.concat([series[energy].abs() for series, energy, *_ in methods(found)])
    axes.set_ylim(0.4*shown[shown > 0].min(), 2*shown.max())


def loglog(axes: Axes, title: str, xlabel: str) -> None:
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 100*low else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.legend(loc="best")


def plain_ticks(axes: Axes, values: Any) -> None:
    """Ticks at the values there are, instead of powers of ten; of two that are close the first."""
    kept: list[float] = []
    for value in sorted(set(values)):
        kept += [value] if not kept or value > 1.1*kept[-1] else []
    axes.set_xticks(kept, labels=[f"{value:.0f}" for value in kept])
    axes.tick_params(axis="x", which="minor", bottom=False, labelbottom=False)


def cost(tables: Tables) -> Figure | None:
    """|K/K_grid - 1| against CPU seconds; how long a step takes, measured alone, where that is known."""
    found, spent, steps = errors_of_k(tables, **LAYER), rows(tables, "errors", **LAYER), rows(tables, "cost")
    found = found.merge(spent[[*POINT, "cpu_s"]], on=POINT) if len(spent) else found.iloc[:0]
    panels = [(ra, group) for ra, group in groups(found, "ra") if ra in RA_SHOWN]
    count = len(panels) + (len(steps) > 0)
    if not count:
        return None
    page, all_axes = figure(1, count, width=4.8, height=4.2, squeeze=False)
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, energy, label, style in methods(group):
            dear(axes, series.sort_values("resolution"), energy, label, style)
        floor(axes, group)
        loglog(axes, f"Ra = {ra:g}, numbers: rows over the height", "CPU seconds without compiling")
        axes.set_ylabel(r"relative error  $|K/K_\mathrm{grid, extrapolated} - 1|$")
    if len(steps):
        step_cost(all_axes[0, -1], steps)
    page.suptitle("What does an error of $K$ cost? Open marks: $K$ too small", fontsize=10)
    return page


def methods(found: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, str, str, dict]]:
    """(rows, energy, label, look) of each method: the printed particles twice, each grid once."""
    for (method, variant), series in groups(found, ["method", "variant"]):
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
    below = -10 if energy == "kp" and style is KIND["kp"] else 4
    for at, value, size in zip(x, np.abs(error), series["resolution"]):
        axes.annotate(f"{size:.0f}", (at, value), xytext=(5, below), textcoords="offset points", fontsize=7)
    axes.margins(x=0.12)


def step_cost(axes: Axes, steps: pd.DataFrame) -> None:
    """Nanoseconds a point and step."""
    for number, ((method, variant, eos), series) in enumerate(groups(steps, ["method", "variant", "eos"])):
        series = series.sort_values("points")
        nanoseconds, err = (1e9*series[name]/series["points"] for name in ("step_s", "step_s_err"))
        axes.errorbar(series["points"], nanoseconds, err, label=" ".join(filter(None, (method, variant, eos))),
                      **look(number))
    loglog(axes, "one step, measured alone", "points (particles or cells)")
    axes.set_ylabel("time per point and step  [ns]")


def fluctuations(tables: Tables) -> Figure | None:
    """Kfl = Kp - Kg of the printed scheme against Ra and against rows."""
    runs = rows(tables, "kinetic_energy", **SPAM, **LAYER)
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
    page.suptitle("Particles tremble: how much of their kinetic energy is not flow?", fontsize=10)
    return page
