"""How wrong and how dear: errors of K and of heat transport against resolution, of K against cost; the particles' noise."""
from collections.abc import Iterator

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.kit.figure import below, figure, look, plain_ticks
from studies.kit.table import Tables
from studies.rb.figures.names import METHODS, method
from studies.rb.looks import GRID, KIND, LABELS, LAYER, NUSSELT, SPAM, cross_out, errors, groups, of_energy, over_seeds, rows

#: Rayleigh numbers that have a panel
RA_SHOWN = (5000, 10000)
#: grids with another number of rolls, other temperatures or wrong heating, which the particles are not compared with
OTHER_FLOWS = ("two-rolls", "fig10", "edge-heat")
#: of discretized integral hydrodynamics; the others have a figure of their own
POINTS = ("fixed-lattice", "fixed-jittered-plates", "moving")
#: what an error is relative to: the grid, for Kg its field smoothed as the particles smooth theirs
RELATIVE = r"$|K_p/K - 1|$, $|K_g/K_\mathrm{smoothed} - 1|$"
NU_ERROR = r"$|\mathrm{Nu}_p/\mathrm{Nu} - 1|$"
SIGNS = "filled marks: too large, open: too small; bars: 95 % intervals"
PALE = "pale lines: no power law, but a range"
#: K_s of the printed weight, see the table `smoothed`
PRINTED_WEIGHT = {"weight": "Lucy", "h": 3}


def convergence(tables: Tables) -> Figure | None:
    """Relative errors of Kp, Kg and Nu against rows over the height, and what smoothing alone takes from the grid."""
    found = errors(tables, **LAYER)
    panels = shown(found[(found["method"] == SPAM["method"]) | (found["energy"] == "Kp")])
    if not panels:
        return None
    page, all_axes = figure(1, len(panels), width=5, height=5.8, sharex=True, sharey=True, squeeze=False)
    whole = pd.concat([group for _, group in panels])
    sizes = [whole["error"].abs()]
    for axes, (ra, group) in zip(all_axes[0], panels):
        for series, label, style in methods(group):
            powers(axes, series, label, style)
        sizes.append(smoothing(axes, tables, ra))
    floor(all_axes[0, 0], pd.concat(sizes))
    particles = sorted({*whole.loc[whole["method"] == SPAM["method"], "resolution"]})
    for axes, (ra, _) in zip(all_axes[0], panels):
        loglog(axes, f"Ra = {ra:g}", "rows over the height $L$", PALE)
        plain_ticks(axes, particles or sorted({*whole["resolution"]}), whole["resolution"])
    heat = any("Nu" in set(group["energy"]) for _, group in panels)
    all_axes[0, 0].set_ylabel("relative error")
    page.suptitle(f"Does $K$ converge{', does the heat transport' if heat else ''}?\n"
                  f"{RELATIVE}{', ' + NU_ERROR if heat else ''}\n{SIGNS}", fontsize=10)
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
    """Errors of one method with the power law through them or, where there is none, the range that they have."""
    n, error, err = (series[name].to_numpy(float) for name in ("resolution", "error", "error_err"))
    if len(n) > 1:
        fit, slope_err = power(n, np.abs(error), err)
        straight = falling(error)
        line = np.exp(np.polyval(fit, np.log(n))) if straight else np.abs(error)
        axes.plot(n, line, **style | {"marker": "", "lw": 0.8, "alpha": 1 if straight else 0.4})
        label += (f": slope {fit[0]:.1f}" + (f" $\\pm$ {slope_err:.1f}" if slope_err > 0.05 else "") if straight
                  else f": {100*error.min():+.2g} to {100*error.max():+.2g} %")
    signed(axes, series, "resolution", label, style)


def falling(error: np.ndarray) -> bool:
    """Whether three errors or more, of one sign, become smaller from each to the next: others have no power."""
    return bool(len(error) > 2 and abs(np.sign(error).sum()) == len(error) and (np.diff(np.abs(error)) < 0).all())


def power(n: np.ndarray, size: np.ndarray, err: np.ndarray) -> tuple[np.ndarray, float]:
    """(slope, constant) of log size over log n, and the half width of the slope's 95 % interval.

    Where the points scatter about the line by more than their errors, the interval is as much wider.
    """
    weight = size/np.maximum(err, 1e-6*size)
    fit, cov = np.polyfit(np.log(n), np.log(size), 1, w=weight, cov="unscaled")
    chi2 = float(np.sum((1.96*weight*(np.log(size) - np.polyval(fit, np.log(n))))**2))
    return fit, float(np.sqrt(cov[0, 0]*max(1.0, chi2/max(1, len(n) - 2))))


def signed(axes: Axes, series: pd.DataFrame, column: str, label: str, style: dict) -> None:
    """|error| over a column, with its interval; filled where the error is positive, open where negative, as in no legend."""
    axes.errorbar([], [], [], label=label, **style | {"linestyle": style.get("linestyle", "-"), "lw": 0.8})
    size = series["error"].abs()
    down = np.minimum(series["error_err"], 0.999*size)       # a logarithmic axis has no room for an interval across zero
    for sign, face in ((series["error"] >= 0, {}), (series["error"] < 0, {"markerfacecolor": "white"})):
        if sign.any():
            axes.errorbar(series.loc[sign, column], size[sign], [down[sign], series.loc[sign, "error_err"]],
                          **style | face | {"linestyle": "none"})
    cross_out(axes, series[column], size, series["steady"])


def floor(axes: Axes, size: pd.Series) -> None:
    """Intervals that reach zero leave the picture below the smallest error."""
    axes.set_ylim(0.4*size[size > 0].min(), 2*size.max())


def loglog(axes: Axes, title: str, xlabel: str, note: str = "") -> None:
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 2000*low else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    below(axes, title=note or None, title_fontsize=8)


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
        loglog(axes, f"Ra = {ra:g}", "CPU seconds: all seeds; grids, points with coarser ones")
    all_axes[0, 0].set_ylabel("relative error" if len(panels) else "")
    if len(steps):
        step_cost(all_axes[0, -1], steps)
    page.suptitle(f"What does an error of $K$ cost, compiling apart?\n{RELATIVE}\n{SIGNS}", fontsize=10)
    return page


def methods(found: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, str, dict]]:
    """(rows by resolution, label, look) of each method: particles for Kp, Kg and Nu, each grid once."""
    for (name, variant, energy), series in groups(found.sort_values("resolution"), ["method", "variant", "energy"]):
        if name == "spam":
            yield series, (LABELS | NUSSELT)[energy.lower()], KIND[energy.lower()]
        elif energy == "Kp":      # the field is all that a grid has
            yield series, *method(name, variant)


def dear(axes: Axes, series: pd.DataFrame, label: str, style: dict) -> None:
    """One method's errors over its seconds; the legend has its rows."""
    axes.plot(series["cpu_s"], series["error"].abs(), **style | {"marker": "", "lw": 0.8})
    signed(axes, series, "cpu_s", f"{label}: {', '.join(f'{size:.0f}' for size in series['resolution'])} rows", style)


def step_cost(axes: Axes, steps: pd.DataFrame) -> None:
    """Nanoseconds a point and step."""
    known = {tuple(SPAM.values()): ("printed particles", KIND["kp"])} | METHODS
    for number, ((*what, eos, sides), series) in enumerate(groups(steps, ["method", "variant", "eos", "sides"])):
        series = series.sort_values("points")
        nanoseconds, err = (1e9*series[name]/series["points"] for name in ("step_s", "step_s_err"))
        label, style = known.get(tuple(what), (", ".join(what), look(number + 2)))
        axes.errorbar(series["points"], nanoseconds, err, label=f"{label}: {eos}, {sides}", **style)
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
        plain_ticks(axes, sorted({*found[one]}))
    left.set(xlabel="Rayleigh number Ra", ylabel=r"energy of the noise $K_p - K_g$  [$\varepsilon/m$]")
    right.set_xlabel("rows over the height $L$")
    page.suptitle("Particles tremble: how much of their kinetic energy is not flow? Bars: 95 % intervals", fontsize=10)
    return page
