"""Figures of one solution (final fields, history) and of a comparison (flows, numbers against cost)."""
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation

from studies.build.answers import answer
from studies.kit.figure import errorbar, figure, look, numbered, save

ARROWS = 11         # number over the height
LONG = 3.0          # width/height from which on (also up to 1/2) fields are drawn along a line, not as a map
NAMES = {"rho": "density", "vx": "velocity $v_x$", "T": "temperature"}


def picture(solution: Any, path: str | Path | None = None) -> Figure:
    """Figure of a solution, written as PNG if a path is given."""
    many = len(solution.history) > 1
    page, axes = figure(1, 1 + many, width=5.2, squeeze=False)
    flow(axes[0, 0], solution)
    if many:
        past(axes[0, 1], solution.history)
    page.suptitle(str(solution), fontsize=9)
    return written(page, path)


def pictures(comparison: Any, path: str | Path | None = None) -> Figure:
    """Flows at the finest resolution above, numbers against cost below. Raises ValueError: no solution."""
    if not comparison.solutions:
        raise ValueError("every run diverged: there is nothing to draw; take more rows or another method")
    by_rows = sorted(comparison.solutions, key=lambda one: one.rows)
    finest = {one.method: one for one in by_rows}.values()
    names = [name for name in ("K", "Nu", "error") if name in comparison.table]
    page = Figure(figsize=(3.4*max(len(finest), len(names)), 5.6), layout="constrained")
    halves: Any = page.subfigures(2, 1)
    above, below = halves
    for axes, one in zip(above.subplots(1, len(finest), squeeze=False)[0], finest):
        flow(axes, one)
        axes.set_title(one.method)
    for axes, name in zip(below.subplots(1, len(names), squeeze=False)[0], names):
        against_cost(axes, comparison.table.dropna(subset=[name]), name)
    return written(page, path)


def written(page: Figure, path: str | Path | None) -> Figure:
    """The figure, written as PNG if a path is given."""
    if path is not None:
        page.draw_without_rendering()       # ticks may change with the layout, which then has to follow
        save(page, Path(path))
    return page


def flow(axes: Axes, solution: Any) -> None:
    """Draw a map of the fields, or in a long strip the fields along it."""
    aspect = solution.scene.width/solution.scene.L
    if 1/2 < aspect < LONG:
        mapped(axes, solution.scene, solution.fields())
    else:
        along(axes, solution, "x" if aspect > 1 else "y")


def mapped(axes: Axes, scene: Any, at: pd.DataFrame) -> None:
    """Draw temperature (or density, if it varies more) as colours, velocity as arrows."""
    L, shown = scene.L, "T" if np.ptp(at["T"]) > np.ptp(at["rho"]) else "rho"
    mesh = Triangulation(at["x"]/L, at["y"]/L)
    colours = axes.tripcolor(mesh, at[shown], shading="gouraud", cmap="cividis")
    axes.figure.colorbar(colours, cax=axes.inset_axes((1.03, 0, 0.05, 1)), label=NAMES[shown])
    x, y = (np.arange(-size/2 + 0.5/ARROWS, size/2, 1/ARROWS) for size in (scene.width/L, 1))
    X, Y = np.meshgrid(x, y)
    vx, vy = (LinearTriInterpolator(mesh, at[name])(X, Y) for name in ("vx", "vy"))
    if at[["vx", "vy"]].any(axis=None):      # arrows of a fluid at rest have no scale
        axes.quiver(X, Y, vx, vy, color="white", edgecolor="black", linewidth=0.3, pivot="mid", width=0.006)
    axes.set(aspect="equal", xlabel="x/L", ylabel="y/L")
    axes.grid(False)


def along(axes: Axes, solution: Any, axis: str) -> None:
    """Plot every point's fields against one coordinate, and the exact answer, if known, in black."""
    at = solution.fields().sort_values(axis)
    exact = answer(solution.scene, at[["x", "y"]].to_numpy())
    for number, name in enumerate(exact or ("rho", "vx", "T")):
        dots = look(number) | {"linestyle": "none", "markersize": 2}
        axes.plot(at[axis], at[name], **dots, label=NAMES[name])
        if exact:
            axes.plot(at[axis], exact[name], color="black", marker="", linestyle="-", linewidth=0.8)
    axes.set(xlabel=axis, ylabel="exact: black line" if exact else "")
    axes.legend()


def past(axes: Axes, history: pd.DataFrame) -> None:
    """Plot K against time, and Nu if heat passes."""
    axes.plot(history["t"], history["K"], marker="", label="K")
    axes.set(xlabel="time, in units of the scene", ylabel="K", ylim=(0, None))
    if "Nu" in history:
        right = axes.twinx()
        right.plot(history["t"], history["Nu"], marker="", color="#D55E00", linestyle="--")
        right.set_ylabel("Nu (dashed)")
        right.grid(False)


def against_cost(axes: Axes, table: pd.DataFrame, name: str) -> None:
    """Plot one number of all methods, with errors, against CPU seconds; points are labelled with rows."""
    for number, (method, rows) in enumerate(table.groupby("method", sort=False)):
        errorbar(axes, rows["cpu_s"], rows[name], rows[f"{name}_err"], number=number, label=str(method),
                 linestyle=look(number)["linestyle"])
    for rows, *place in table[["rows", "cpu_s", name]].itertuples(index=False):
        axes.annotate(f"{rows}", (place[0], place[1]), textcoords="offset points", xytext=(4, 4), fontsize=7)
    axes.set(xscale="log", xlabel="CPU  [s]", ylabel=name, yscale="log" if name == "error" else "linear")
    numbered(axes.xaxis)
    axes.legend(fontsize=7)
