"""Figures of a study and their style: series differ in colour, marker and line, so in grey, too."""
import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib
import numpy as np
import pandas as pd
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from matplotlib.transforms import ScaledTranslation
from PIL import Image

from studies.kit.csvfile import write_atomic
from studies.kit.stats import Numbers
from studies.kit.table import Tables, check_once

#: Okabe and Ito's colours, which colour-blind readers can tell apart, with dark red instead of yellow
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#882255")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
LINES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 3)))
#: fill styles of markers of the same shape
FILLS: tuple[dict[str, str], ...] = ({}, {"markerfacecolor": "white"}, *(
    {"fillstyle": half, "markerfacecoloralt": "white"} for half in ("left", "bottom")))

DIGIT = 6.4     # width of a digit of a tick label  [points]
GROWS = 1.15    # least factor by which the layout enlarges axes
BELOW = -0.42   # from axes to a legend below their label  [inches]

matplotlib.rcParams.update({
    "axes.prop_cycle": cycler(color=COLOURS) + cycler(marker=MARKERS) + cycler(linestyle=LINES),
    "axes.grid": True, "axes.titlesize": 10, "grid.alpha": 0.3, "font.size": 10, "legend.fontsize": 8,
    "legend.frameon": False, "lines.markersize": 5, "lines.linewidth": 1.2, "errorbar.capsize": 2.5,
    "savefig.dpi": 150, "figure.dpi": 100, "figure.titlesize": 10, "image.cmap": "viridis",
})


def figure(rows: int = 1, columns: int = 1, *, width: float = 4.5, height: float = 3.4,
           **more: Any) -> tuple[Figure, Any]:
    """A figure of rows x columns axes, each ``width`` x ``height`` inches; axes as from plt.subplots."""
    page = Figure(figsize=(width*columns, height*rows), layout="constrained")
    return page, page.subplots(rows, columns, **more)


def look(number: int) -> dict[str, Any]:
    """Colour, marker and line of series ``number``, the same in every figure."""
    number %= len(COLOURS)
    return {"color": COLOURS[number], "marker": MARKERS[number], "linestyle": LINES[number]}


def errorbar(axes: Axes, x: Numbers, y: Numbers, err: Numbers, *, number: int = 0, label: str = "",
             **more: Any) -> None:
    """Points with their 95 % intervals; no line unless ``linestyle`` is given."""
    axes.errorbar(x, y, yerr=err, label=label, **{**look(number), "linestyle": "none", **more})


def bars(axes: Axes, rows: pd.DataFrame, x: str, y: str, **more: Any) -> None:
    """Plot column y with its errors against column x."""
    rows = rows.sort_values(x)
    errorbar(axes, rows[x], rows[y], rows[f"{y}_err"], **more)


def plain_ticks(axes: Axes, values: Sequence[float]) -> None:
    """Set ticks along x at these values; a tick has no label if it would touch an earlier one."""
    scale = np.log10 if axes.get_xscale() == "log" else float
    low, high = map(scale, axes.get_xlim())
    points = 72*width(axes)/(high - low)
    kept: dict[float, tuple[float, float]] = {}
    for value in values:
        at, half = points*(scale(value) - low), DIGIT*(len(f"{value:.0f}") + 0.5)/2
        if all(abs(at - other) > half + reach for other, reach in kept.values()):
            kept[value] = at, half
    axes.set_xticks(list(kept), labels=[f"{value:.0f}" for value in kept])
    axes.set_xticks(sorted({*values} - {*kept}), minor=True)
    axes.tick_params(axis="x", which="minor", labelbottom=False)


def logarithmic(axes: Axes, along: Sequence[float]) -> None:
    """Set log scales, with labels at these values along x, and at more than powers of ten if y has few."""
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(along, labels=[f"{value:g}" for value in along])
    axes.minorticks_off()
    low, high = axes.get_ylim()
    if high < 100*low:
        numbered(axes.yaxis)


def numbered(axis: Any, steps: tuple[float, ...] = ()) -> None:
    """Label a log axis at these multiples of powers of ten only (default: as many as fit), no exponents."""
    low, high = axis.get_view_interval()
    steps = steps or ((1,) if high > 100*low else (1, 2, 5))
    axis.set_major_locator(LogLocator(subs=steps) if high > 5*low else MaxNLocator(5))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def width(axes: Axes) -> float:
    """Approximate width of the axes after the layout [inches]."""
    inches = axes.get_window_extent().transformed(axes.figure.dpi_scale_trans.inverted()).width
    return float(GROWS*inches)


def below(axes: Axes, **more: Any) -> None:
    """Put the legend below the axes and their label, where it covers no data."""
    lower = axes.transAxes + ScaledTranslation(0, BELOW, axes.figure.dpi_scale_trans)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0), bbox_transform=lower, **more)


def save(page: Figure, path: Path) -> None:
    """Write a PNG, all or nothing; the same figure gives the same bytes. Raises ValueError: path not .png."""
    if path.suffix != ".png":
        raise ValueError(f"{path.name} ends in {path.suffix or 'nothing'}: give a name that ends in .png, or "
                         f"draw without a name and .savefig({path.name!r}) the figure")
    write_atomic(path, compact(page))


def compact(page: Figure) -> bytes:
    """PNG with 256 colours, a third of the size: the eye does not see that blended colours change."""
    full, small = io.BytesIO(), io.BytesIO()
    page.savefig(full, format="png")
    picture = Image.open(full)
    # kmeans moves each colour of the palette to the mean of the pixels that get it
    fewer = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)
    fewer.save(small, "png", optimize=True, dpi=picture.info["dpi"])
    return small.getvalue()


class Drawing(NamedTuple):
    """A figure that needs rows in all its tables. draw : takes their frames; its docstring is the caption."""
    name: str
    tables: tuple[str, ...]
    draw: Callable[..., Figure | None]

    def page(self, tables: Tables) -> Figure | None:
        """The figure; None if a table has no rows, or none to show."""
        if not all(len(tables.get(name, ())) for name in self.tables):
            return None
        return self.draw(*(tables[name] for name in self.tables))


class Overview(Drawing):
    """A figure of those of its tables that exist. draw : takes `Tables`; its docstring is the caption."""

    def page(self, tables: Tables) -> Figure | None:
        """The figure; None if the tables have nothing to show."""
        there = {name: tables[name] for name in self.tables if name in tables}
        return self.draw(Tables(there))


class Drawings:
    """Drawings and overviews of a study; a call with tables returns figures by name."""

    def __init__(self, *drawings: Drawing):
        check_once("figures", (drawing.name for drawing in drawings))
        self.drawings = drawings

    def __call__(self, tables: Tables) -> dict[str, Figure]:
        """Figures by name, those whose tables have rows to show."""
        pages = {drawing.name: drawing.page(tables) for drawing in self.drawings}
        return {name: page for name, page in pages.items() if page is not None}


def caption(drawing: Drawing) -> str:
    """First paragraph of the docstring of ``draw``, or the figure's name."""
    text = (drawing.draw.__doc__ or drawing.name.replace("_", " ")).split("\n\n")[0]
    return " ".join(text.split())
