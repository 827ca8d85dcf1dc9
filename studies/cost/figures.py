"""Error against CPU seconds."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.cost.tables import BOUSSINESQ, LEVELS, METHODS
from studies.kit.figure import FILLS, LINES, Drawing, Drawings, figure, numbered

#: scene, quantity, title of each panel
PANELS = (
    ("convection", "K", "a smooth flow: K of convection, Ra 10 000; LAMMPS' is another fluid, Boussinesq's"),
    ("taylor-green", "velocity", "a vortex: velocity"),
    ("sound", "velocity", "a sound wave: velocity"),
    ("conduction", "temperature", "conduction: temperature"),
)
WORST = 10.0        # largest relative error that is drawn
#: levels of error at which members of a family are compared: the first that one of them reaches
DECIDE = (0.01, 0.03, 0.1)
#: how the names of a family begin -> its colour, its marker
FAMILIES = {
    "grid": ("#000000", "X"),
    "mac": ("#882255", "P"),
    "py-pde": ("#E69F00", "*"),
    "spectral": ("#332288", "p"),
    "fixed-lattice": ("#0072B2", "o"),
    "fixed-jittered": ("#56B4E9", "^"),
    "spam-corrected": ("#CC79A7", "v"),
    "spam-sumB": ("#999933", "h"),
    "spam": ("#D55E00", "s"),
    "moving": ("#009E73", "D"),
    "LAMMPS sph": ("#666666", "<"),
    "LAMMPS RHEO": ("#666666", ">"),
}


def work_precision(points: pd.DataFrame, needed: pd.DataFrame) -> Figure:
    """Relative error against CPU seconds: a panel a question, a line the best method of each family. LAMMPS
    computes a Boussinesq fluid, judged by its own spectral answer, for all of 90 free-fall times, with steps
    at which a vortex has converged; the others stop when K is as near to its end as their error.

    Best is what needs the least seconds for 1 %, else for 3 %, else for 10 %, else has the least error.
    """
    page, grid = figure(2, 3, width=2.6, height=3.4)
    wide, *narrow = all_axes = [grid[0, 0], *grid[1]]
    for axes in grid[0, 1:]:
        axes.remove()
    wide.set_subplotspec(wide.get_gridspec()[0, :])
    for axes, (scene, quantity, title) in zip(all_axes, PANELS):
        scenes = [scene, BOUSSINESQ] if scene == "convection" else [scene]
        here = f"scene in {scenes} and quantity == '{quantity}'"
        panel(axes, points.query(f"{here} and error > 0"), needed.query(here), title)
    for axes in (wide, narrow[0]):
        axes.set_ylabel("relative error")
    wide.set_ylim(bottom=1e-4)
    least = points.query("method == 'spectral-gas' and error > 0").error.min()
    wide.text(0.08, 1.3e-4, f"spectral-gas: on to {least:.0e}", fontsize=8)
    legend(page, np.array(all_axes))
    page.suptitle("1 % of convection costs alike on grids, lattices, moving points; elsewhere grids win\n"
                  "the best of each family, at its own best step, one thread, with setting up; bars: 95 %")
    return page


def panel(axes: Axes, rows: pd.DataFrame, needed: pd.DataFrame, title: str) -> None:
    """Draw the panel of one scene and quantity."""
    draw(axes, rows[rows.method.isin(best(rows, needed))])
    for level in LEVELS:
        axes.axhline(level, color="grey", linewidth=0.6, linestyle=":")
    loglog(axes, title, "CPU seconds")
    axes.set_ylim(top=min(WORST, axes.get_ylim()[1]))


def best(rows: pd.DataFrame, needed: pd.DataFrame) -> list[str]:
    """The best member of each family."""
    reached = needed[needed.reached != "no"]
    seconds = reached.pivot(index="method", columns="level", values="cpu_s")
    marks = seconds.reindex(present(rows), columns=DECIDE)
    marks["error"] = rows.groupby("method").error.min()
    return list(marks.groupby(family, sort=False).apply(foremost))


def foremost(marks: pd.DataFrame) -> str:
    """The method with the least value in the first column that has one."""
    first = marks.notna().any().idxmax()
    return str(marks[first].idxmin())


def draw(axes: Axes, rows: pd.DataFrame) -> None:
    """Draw errors of all methods over seconds, with error bars in both directions."""
    rows = rows[rows.cpu_s > 0]     # a short time may be lost in noise
    for name in present(rows):
        series = rows[rows.method == name].sort_values("resolution")
        xerr, yerr = (limited(series, column) for column in ("cpu_s", "error"))
        axes.errorbar(series.cpu_s, series.error, xerr=xerr, yerr=yerr, label=name, **style(name))


def present(rows: pd.DataFrame) -> list[str]:
    """Methods of some rows, in the order of METHODS."""
    return [name for name in METHODS if name in set(rows.method)]


def style(name: str) -> dict[str, Any]:
    """Look of a method: colour and marker of its family, filling and line its own."""
    start = family(name)
    members = [other for other in METHODS if family(other) == start]
    member = members.index(name)
    colour, marker = FAMILIES[start]
    return {"color": colour, "marker": marker, "linestyle": LINES[member], "markersize": 6, **FILLS[member]}


def family(name: str) -> str:
    """The family of a method: how its name begins."""
    return next(start for start in FAMILIES if name.startswith(start))


def limited(rows: pd.DataFrame, column: str) -> np.ndarray:
    """Error bars (2, n) that end above zero, for a logarithmic axis."""
    value, err = (rows[name].to_numpy(float) for name in (column, f"{column}_err"))
    return np.stack([np.minimum(err, 0.9*value), err])


def loglog(axes: Axes, title: str, xlabel: str) -> None:
    """Make axes logarithmic, with numbers written out."""
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        numbered(axis)


def legend(page: Figure, all_axes: np.ndarray) -> None:
    """Draw one legend for all panels, below them, without error bars, which hide markers."""
    handles: dict = {}
    for axes in all_axes.flat:
        bars, names = axes.get_legend_handles_labels()
        handles |= dict(zip(names, bars, strict=True))
    order = [name for name in METHODS if name in handles]
    lines = [handles[name].lines[0] for name in order]
    page.legend(lines, order, loc="outside lower center", ncols=3, handlelength=4)


FIGURES = Drawings(Drawing("work_precision", ("points", "needed"), work_precision))
