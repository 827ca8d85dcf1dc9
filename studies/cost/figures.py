"""Error against CPU seconds, and seconds against the number of particles, from the tables of the study `speed`."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.cost.derive import LEVELS
from studies.cost.names import FAMILIES, ORDER, family
from studies.kit.figure import LINES, below, figure, look
from studies.kit.table import Tables
from studies.rb.looks import groups

#: scene, quantity, title of each panel
PANELS = (("convection", "K", "Rayleigh-Benard, Ra 10 000: K, steady"), ("convection", "velocity", "velocity, steady"),
          ("convection", "temperature", "temperature, steady"), ("convection", "K(t)", "K(t), 30 free-fall times"),
          ("taylor-green", "velocity", "Taylor-Green: velocity"), ("sound", "velocity", "sound wave: velocity"),
          ("conduction", "temperature", "heat conduction: temperature"), ("couette", "velocity", "Couette: velocity"))
ACROSS = 4
WORST = 10.0        # relative error that is drawn: ten times the answer; what is beyond is told by its number
#: a family each; those with many members have one that shows how it is filled
SHAPES = {"compressible": "X", "MAC": "P", "py-pde": "*", "DIH lattice": "o", "DIH Delaunay": "^", "SPAM": "s", "moving": "D"}
HOLLOW = {"markerfacecolor": "white"}
FILLS: tuple[dict[str, str], ...] = ({}, HOLLOW, *({"fillstyle": side, "markerfacecoloralt": "white"}
                                                   for side in ("left", "bottom", "right", "top")))


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    found: dict[str, Figure] = {}
    if len(tables.get("points", ())):
        found["work_precision"] = work_precision(tables["points"])
    if len(tables.get("memory", ())):
        found["memory"] = memory(tables["memory"])
    if len(tables.get("growth", ())):
        found["growth"] = growth(tables["growth"])
    return found


def work_precision(points: pd.DataFrame) -> Figure:
    """A panel a quantity; a line a method, its resolutions from left to right."""
    shown = [panel for panel in PANELS if len(pick(points, *panel[:2]))]
    across = min(ACROSS, len(shown))
    down = -(-len(shown)//across)
    page, all_axes = figure(down, across, width=4.1, height=3.9, squeeze=False)
    for axes, (scene, quantity, title) in zip(all_axes.flat, shown):
        rows = pick(points, scene, quantity)
        draw(axes, rows, "cpu_s", "error")
        beyond(axes, rows)
        for level in LEVELS:
            axes.axhline(level, color="grey", linewidth=0.6, linestyle=":")
        loglog(axes, title, "CPU seconds, setting up included")
    for axes in list(all_axes.flat)[len(shown):]:
        axes.set_visible(False)
    for axes in all_axes[:, 0]:
        axes.set_ylabel("relative error")
    legend(page, all_axes)
    page.suptitle("What does an error cost?\n"
                  "Each method at its own best step (py-pde: by formula), one thread, without compiling; bars: 95 %; arrows: "
                  "beyond the axis. MAC and py-pde, Boussinesq: another fluid, against its own limit", fontsize=10)
    return page


def pick(points: pd.DataFrame, scene: str, quantity: str) -> pd.DataFrame:
    """Rows of one panel; grids of another fluid, told against their own limit, are shown beside those of the gas."""
    return points[points["scene"].isin([scene, f"{scene}-boussinesq"]) & (points["quantity"] == quantity) & (points["error"] > 0)]


def draw(axes: Axes, rows: pd.DataFrame, x: str, y: str) -> None:
    """All methods, with errors in both directions."""
    for name in [name for name in ORDER if name in set(rows["method"])]:
        series = rows[(rows["method"] == name) & (rows[x] > 0)].sort_values("resolution")     # a short time may drown
        errs: dict[str, Any] = {f"{side}err": limited(series, column) for side, column in (("x", x), ("y", y))}
        axes.errorbar(series[x], series[y], label=name, **errs, **style(name))


def style(name: str) -> dict[str, Any]:
    """Look of a method, the same in every figure: colour and marker of its family, filling and line its own."""
    member = [other for other in ORDER if family(other) == family(name)].index(name)
    return {"color": FAMILIES[family(name)][0], "marker": SHAPES[family(name)], "linestyle": LINES[member], "markersize": 6,
            **FILLS[member]}


def beyond(axes: Axes, rows: pd.DataFrame) -> None:
    """End the axes at WORST; errors that are larger are told by an arrow and their number."""
    large = rows[rows["error"] > WORST]
    for _, row in large.iterrows():
        colour = style(row["method"])["color"]
        axes.annotate(f"{float(f'{row.error:.2g}'):.0f}", (row["cpu_s"], WORST), (0, -26), ha="center", fontsize=8,
                      color=colour, textcoords="offset points", arrowprops={"arrowstyle": "->", "color": colour})
    if len(large):
        axes.set(yscale="log")
        axes.set_ylim(top=WORST)


def limited(rows: pd.DataFrame, column: str) -> np.ndarray:
    """Bars (2, n) that end above zero on a logarithmic axis."""
    value, err = (rows[name].to_numpy(float) for name in (column, f"{column}_err"))
    return np.stack([np.minimum(err, 0.9*value), err])


def loglog(axes: Axes, title: str, xlabel: str) -> None:
    """Logarithmic axes whose numbers are written out."""
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel)
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        subs = (1,) if high > 100*low else (1, 2, 5) if high > 4*low else (1, 1.5, 2, 3, 4, 6)
        axis.set_major_locator(LogLocator(subs=subs))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def legend(page: Figure, all_axes: np.ndarray) -> None:
    """One for all panels, below; without bars, which hide markers."""
    handles: dict = {}
    for axes in all_axes.flat:
        handles |= dict(zip(*axes.get_legend_handles_labels()[::-1], strict=True))
    order = [name for name in ORDER if name in handles]
    page.legend([handles[name].lines[0] for name in order], order, loc="outside lower center", ncols=4, handlelength=4)


def memory(rows: pd.DataFrame) -> Figure:
    """Bytes a point of each method in each scene, at its highest resolution."""
    scenes = list(dict.fromkeys(rows["scene"]))
    order = [name for name in ORDER if name in set(rows["method"])]
    page, axes = figure(width=7.5, height=1.3 + 0.28*len(order))
    for number, scene in enumerate(scenes):
        some = rows[rows["scene"] == scene]
        places = [len(order) - 1 - order.index(name) for name in some["method"]]
        axes.plot(some["bytes_a_point"], places, label=scene, **{**look(number), "linestyle": "none"})
    axes.set_yticks(range(len(order)), labels=order[::-1])
    axes.set(xscale="log", xlabel="bytes of arrays a point while it runs", title="Memory at the highest resolution")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    page.legend(loc="outside lower center", ncols=5)
    return page


def growth(rows: pd.DataFrame) -> Figure:
    """Nanoseconds a particle and step by number of particles; two threads by the time that passes."""
    panels = (("cpu", "one thread, CPU time"), ("wall", "time that passes"))
    shown = [panel for panel in panels if (rows["clock"] == panel[0]).any()]
    page, all_axes = figure(1, len(shown), width=4.6, height=4.4, squeeze=False)
    for axes, (clock, title) in zip(all_axes[0], shown, strict=True):
        some = rows[rows["clock"] == clock].sort_values("points")
        for (method, threads), series in groups(some, ["method", "threads"]):
            value, err = (1e9*series[name]/series["points"] for name in ("step_s", "step_s_err"))
            told = style(method) | {"markerfacecolor": "white" if threads > 1 else style(method)["color"],
                                    "linestyle": LINES[int(threads) - 1], "fillstyle": "full"}
            axes.errorbar(series["points"], value, err, label=f"{method}, {threads:.0f} thread{'s'*(threads > 1)}", **told)
        loglog(axes, title, "particles or points")
        below(axes)
    all_axes[0, 0].set_ylabel("a particle and step  [ns]")
    page.suptitle("How does the cost of a step grow? Lists of neighbours included; bars: 95 %", fontsize=10)
    return page
