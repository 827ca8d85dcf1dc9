"""How errors of K and of heat transport fall with resolution, and what errors in other figures share."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.kit.figure import below, figure, plain_ticks
from studies.kit.table import Tables, groups
from studies.rb.figures.names import method
from studies.rb.looks import GRID, KIND, LABELS, LAYER, MARKS, NUSSELT, OPEN, PRINTED_WEIGHT, RA_SHOWN, SPAM, cross_out, rows
from studies.rb.looks import errors as errors_of

Style = dict[str, Any]
#: grids with another number of rolls, other temperatures or wrong heating, which the particles are not compared with
OTHER_FLOWS = ("two-rolls", "fig10", "edge-heat")
#: of discretized integral hydrodynamics; the others have a figure of their own
POINTS = ("fixed-lattice", "fixed-jittered-plates", "moving")
#: what an error is relative to: the grid, for Kg its field smoothed as the particles smooth theirs
RELATIVE = r"$|K_p/K - 1|$, $|K_g/K_\mathrm{smoothed} - 1|$"
NU_ERROR = r"$|\mathrm{Nu}_p/\mathrm{Nu} - 1|$"
SIGNS = "filled marks: too large, open: too small; bars: 95 % intervals"
PALE = "pale lines: no power law, but a range"


def convergence(tables: Tables) -> Figure | None:
    """Relative errors of kinetic energy and heat transport against rows over the height, for each method. A dotted line is
    what smoothing alone takes from the grid.
    """
    chosen = errors_of(tables, **LAYER)
    panels = shown(chosen[(chosen["method"] == SPAM["method"]) | (chosen["energy"] == "Kp")])
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
    heat = (whole["energy"] == "Nu").any()
    all_axes[0, 0].set_ylabel("relative error")
    page.suptitle(f"Does $K$ converge{', does the heat transport' if heat else ''}?\n"
                  f"{RELATIVE}{', ' + NU_ERROR if heat else ''}\n{SIGNS}", fontsize=10)
    return page


def shown(chosen: pd.DataFrame) -> list[tuple[float, pd.DataFrame]]:
    """The Rayleigh numbers of the panels, each with its rows of grids, of the printed particles and of some on points."""
    variant, of_points = chosen["variant"], chosen["method"] == "dih"
    printed = (chosen["method"] != "spam") | (variant == SPAM["variant"])
    chosen = chosen[printed & ~variant.isin(OTHER_FLOWS) & (~of_points | variant.isin(POINTS))]
    return [(ra, group) for ra, group in groups(chosen, "ra") if ra in RA_SHOWN]


def methods(chosen: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, str, Style]]:
    """(rows by resolution, label, look) of each method: particles for Kp, Kg and Nu, each grid once."""
    for (name, variant, energy), series in groups(chosen.sort_values("resolution"), ["method", "variant", "energy"]):
        if name == "spam":
            yield series, (LABELS | NUSSELT)[energy.lower()], KIND[energy.lower()]
        elif energy == "Kp":      # the field is all that a grid has
            yield series, *method(name, variant)


def smoothing(axes: Axes, tables: Tables, ra: float) -> pd.Series:
    """1 - K_smoothed/K of the grid's own field: what the weight alone takes away, drawn as a line."""
    seen = rows(tables, "smoothed", **GRID, **LAYER, **PRINTED_WEIGHT, ra=ra).sort_values("rows")
    taken = 1 - seen["ke_smoothed"]/seen["ke"]
    if len(seen):
        axes.plot(seen["rows"], taken, color=KIND["kg"]["color"], marker="", lw=2.5, ls=":",
                  label=r"$1 - K_\mathrm{smoothed}/K$: the smoothing alone")
    return taken


# --- errors over a resolution ---------------------------------------------------------------------


def powers(axes: Axes, series: pd.DataFrame, label: str, style: Style) -> None:
    """Errors of one method with the power law through them or, where there is none, the range that they have."""
    n, error, err = (series[name].to_numpy(float) for name in ("resolution", "error", "error_err"))
    line = style | {"marker": "", "lw": 0.8}
    if len(n) > 1 and falling(error):
        fit, slope_err = power(n, np.abs(error), err)
        axes.plot(n, np.exp(np.polyval(fit, np.log(n))), **line)
        label += f": slope {fit[0]:.1f}" + (f" $\\pm$ {slope_err:.1f}" if slope_err > 0.05 else "")
    elif len(n) > 1:
        axes.plot(n, np.abs(error), **line | {"alpha": 0.4})
        label += f": {100*error.min():+.2g} to {100*error.max():+.2g} %"
    signed(axes, series, label, style)


def falling(error: np.ndarray) -> bool:
    """Whether three errors or more, of one sign, become smaller from each to the next: others have no power."""
    one_sign = abs(np.sign(error).sum()) == len(error)
    return bool(len(error) > 2 and one_sign and (np.diff(np.abs(error)) < 0).all())


def power(n: np.ndarray, size: np.ndarray, err: np.ndarray) -> tuple[np.ndarray, float]:
    """(slope, constant) of log size over log n, and the half width of the slope's 95 % interval.

    Where the points scatter about the line by more than their errors, the interval is as much wider.
    """
    weight = size/np.maximum(err, 1e-6*size)
    fit, cov = np.polyfit(np.log(n), np.log(size), 1, w=weight, cov="unscaled")
    left = np.log(size) - np.polyval(fit, np.log(n))
    chi2 = float(np.sum((1.96*weight*left)**2))
    return fit, float(np.sqrt(cov[0, 0]*max(1.0, chi2/max(1, len(n) - 2))))


def signed(axes: Axes, series: pd.DataFrame, label: str, style: Style) -> None:
    """|error| over rows, with its interval; filled where the error is positive, open where negative, as in no legend."""
    axes.errorbar([], [], [], label=label, **style | {"linestyle": style.get("linestyle", "-"), "lw": 0.8})
    x, size, err = series["resolution"], series["error"].abs(), series["error_err"]
    down = np.minimum(err, 0.999*size)       # a logarithmic axis has no room for an interval across zero
    positive = series["error"] >= 0
    for sign, face in ((positive, {}), (~positive, OPEN)):
        if sign.any():
            axes.errorbar(x[sign], size[sign], [down[sign], err[sign]], **style | face | MARKS)
    cross_out(axes, x, size, series["steady"])


def floor(axes: Axes, size: pd.Series) -> None:
    """Intervals that reach zero leave the picture below the smallest error."""
    axes.set_ylim(0.4*size[size > 0].min(), 2*size.max())


def loglog(axes: Axes, title: str, xlabel: str, note: str = "") -> None:
    """Logarithmic axes with plain numbers, and the legend below."""
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 2000*low else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    below(axes, title=note or None, title_fontsize=8)
