"""Kinetic energy against time: KHP95's Fig. 8."""
from functools import partial

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.axes import ENERGY
from studies.kit.figure import figure
from studies.kit.table import Tables, groups
from studies.rb.looks import GRID, KIND, LABELS, LAYER, SPAM, TIME, finest, nearest, rows

ENERGIES = {"kp": "ke", "kg": "ke_field"}
STROKES = ("-", "--", ":")      # of seeds


def fig8(tables: Tables) -> Figure | None:
    """Kinetic energy against time while weak rolls grow to steady ones: particles, one line a seed, and the grid."""
    spam = nearest(rows(tables, "history", **SPAM, **LAYER))
    spam = finest(spam[spam["resolution"] <= 50])     # KHP95's 5000 particles; finer runs keep few samples
    cells = finest(nearest(rows(tables, "history", **GRID, **LAYER)))
    if spam.empty and cells.empty:
        return None
    page, axes = figure(width=7, height=4.2)
    unit = viscous_time(spam if len(spam) else cells)
    for kind, column in ENERGIES.items():
        for number, (_, run) in enumerate(groups(spam, "seed")):
            draw_run(axes, run["t_viscous"]*unit, run[column], kind, number)
    if len(cells):
        t = cells["t_viscous"]*unit
        axes.plot(t, cells["ke"], label="compressible grid", **KIND["grid"] | {"marker": "", "lw": 2.2})
        name_line(axes, t, cells["ke"], "grid")
    time_axes(axes, unit)
    if len(spam) and set(spam["ra"]) == set(cells["ra"]):
        words = differences(spam, cells)
        axes.text(0.98, 0.03, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=8)
    ra = max([*spam["ra"], *cells["ra"]])
    axes.set(title=f"Approach to steady rolls at Ra = {ra:g}, grid and particles    [KHP95, Fig. 8]",
             ylabel=ENERGY, ylim=(0, None))
    axes.legend(loc="upper right")
    return page


def draw_run(axes: Axes, t: pd.Series, ke: pd.Series, kind: str, number: int) -> None:
    """An energy of one seed; the first has a name."""
    style = KIND[kind] | {"marker": "", "lw": 0.9, "alpha": 0.8, "linestyle": STROKES[number % 3]}
    axes.plot(t, ke, label="" if number else f"{LABELS[kind]}, one line a seed", **style)
    if number == 0:
        name_line(axes, t, ke, LABELS[kind].split(",")[0])


def differences(spam: pd.DataFrame, cells: pd.DataFrame) -> str:
    """How K(t) of the particles, mean over seeds, differs from the grid's, in words: at the start, and as a lag."""
    cells = cells.sort_values("t")
    mean = spam.groupby("t", as_index=False)[["ke", "ke_field"]].mean()
    words = [f"At $t$ = {mean['t'].iloc[0]:.0f} the jitter of the lattice has raised $K_p$ to {mean['ke'].iloc[0]:.2g}; "
             f"the rolls alone begin with {cells['ke'].iloc[0]:.2g}.",
             "Largest difference from the grid, over the grid's last $K$:"]
    for kind, column in ENERGIES.items():
        plain, (shift, least) = apart(mean["t"], mean[column], cells), lag(mean["t"], mean[column], cells)
        words.append(f"{LABELS[kind].split(',')[0]}  {plain:.2f},  {least:.2f} if it came {shift:.0f} earlier")
    return "\n".join(words)


def apart(t: pd.Series, ke: pd.Series, cells: pd.DataFrame, shift: float = 0.0) -> float:
    """Largest |K(t + shift) - K_grid(t)| over the grid's last K, while both are known."""
    both = t.between(shift, shift + cells["t"].max())
    other = np.interp(t[both] - shift, cells["t"], cells["ke"])
    return float((ke[both] - other).abs().max()/cells["ke"].iloc[-1])


def lag(t: pd.Series, ke: pd.Series, cells: pd.DataFrame) -> tuple[float, float]:
    """The shift in time that leaves the least difference, and that; of the grid's samples in the first fifth of its run."""
    shifts = cells["t"][cells["t"] <= cells["t"].max()/5]
    least, shift = min((apart(t, ke, cells, at), at) for at in shifts)
    return float(shift), least


def name_line(axes: Axes, t: pd.Series, y: pd.Series, name: str) -> None:
    """A name where a line ends: colours alone do not separate lines in grey."""
    end = (t.max(), y.iloc[t.argmax()])
    axes.annotate(name, end, xytext=(4, 0), textcoords="offset points", va="center", fontsize=8)


def viscous_time(history: pd.DataFrame) -> float:
    """L^2/nu in units of time, from any row after the start."""
    return float(history["t"].max()/history["t_viscous"].max())


def time_axes(axes: Axes, unit: float) -> None:
    """Time in units of the gas below, in viscous times above."""
    top = axes.secondary_xaxis("top", functions=(partial(np.multiply, 1/unit), partial(np.multiply, unit)))
    top.set_xlabel(r"time  [$L^2/\nu$]")
    axes.set_xlabel(f"time  [{TIME}]")
    axes.set_xlim(0, 1.07*axes.dataLim.x1)      # room for names
