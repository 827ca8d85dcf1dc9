"""Figures of the study conservation, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, bars, figure, logarithmic, look, numbered, plain_ticks

#: RR98's motions, by their names, with their equations
MOTIONS = {"literal": "moving-literal (39-41)", "convective": "moving-convective (46-48)",
           "carried": "moving-carried (46-48)", "constant-mass": "moving-constant-mass (49)"}
BODIES = {"surface": "points on the surface", "frozen": "frozen lattice points",
          "frozen-grown": "frozen, half a spacing more"}


def speeds(patterns: pd.DataFrame, sound: pd.DataFrame) -> Figure:
    """How fast a density pattern goes on a stream, and sound."""
    page, (left, right) = figure(1, 2, width=4.4, height=4.0)
    draw_speeds(left, patterns)
    draw_speeds(right, sound[sound["weight"] == "Lucy"])
    left.set(ylabel="speed of the pattern over the stream's", title="density pattern on a uniform stream")
    right.set(ylabel="speed of sound over $c$", title="standing sound")
    right.axhline(np.sqrt(2), color="grey", linewidth=0.6)
    right.annotate(r"$\sqrt{2}$", (8, np.sqrt(2)), textcoords="offset points", xytext=(0, -14))
    page.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("Of RR98's motions two carry patterns and sound near the right speed\n"
                  "Lucy's weight, $h = 3a$; dotted: predicted from sums over the lattice")
    return page


def draw_speeds(axes: Axes, rows: pd.DataFrame) -> None:
    """Of each motion over the wavelength; some lie on each other."""
    for number, (name, words) in enumerate(MOTIONS.items()):
        group = rows[rows["motion"] == name].sort_values("wavelength")
        style = {"markerfacecolor": "none", "markersize": 10 - 2*number}
        bars(axes, group, "wavelength", "speed", number=number, label=words, **style)
        axes.plot(group["wavelength"], group["predicted"], color="grey", linestyle=":", marker="")
    axes.set(xlabel=r"wavelength $\lambda/a$", xscale="log")
    plain_ticks(axes, sorted(set(rows["wavelength"])))


def drags(drag: pd.DataFrame) -> Figure:
    """Error of the drag against the published value over the resolution, one panel a solid fraction."""
    fractions = sorted(set(drag["fraction"]))
    page, axes = figure(1, len(fractions), width=4.4, height=4.2, squeeze=False, sharey=True)
    drag = drag.assign(percent=100*drag["error"].abs(), percent_err=100*drag["error_err"])
    for panel, fraction in zip(axes[0], fractions, strict=True):
        draw_drags(panel, drag[drag["fraction"] == fraction].sort_values("rows"))
        for power, style, at in ((1, ":", 60.0), (2, "--", 16.0)):
            radius = np.array([drag["radius"].min(), drag["radius"].max()])
            panel.plot(radius, at*radius**-power, color="grey", linestyle=style, marker="",
                       label=f"$(a/R)^{power}$")
        panel.set(title=f"solid fraction {fraction:g}", xlabel="radius $R/a$")
        logarithmic(panel, (4, 6, 10, 20))
        numbered(panel.yaxis, (1, 3))
    axes[0, 0].set_ylabel("|error| of the drag  [%]")
    page.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle("Points on its surface give a cylinder's drag, frozen lattice points err without order\n"
                  "against Sangani & Acrivos (1982); bars: print and what was not steady")
    return page


def draw_drags(axes: Axes, rows: pd.DataFrame) -> None:
    """Of each variant over the radius."""
    for number, (name, words) in enumerate(BODIES.items()):
        group = rows[rows["variant"] == name]
        bars(axes, group, "radius", "percent", number=number, label=words,
             linestyle=look(number)["linestyle"])


FIGURES = Drawings(
    Drawing("speeds", ("patterns", "moving_sound"), speeds),
    Drawing("drag", ("drag",), drags))
