"""Figures of the study onset, from its tables alone."""
from math import inf
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.axes import ra_axis
from studies.build.names import ENERGY
from studies.kit.figure import Drawing, Drawings, errorbar, look

#: rows of the gas in KHP95's layer
GAS = ("method == 'compressible' and eos == 'ideal' and transport == 'const-eta' and dT == 1 "
       "and sides == 'periodic'")
BLACK: dict[str, Any] = {"color": "black", "marker": ""}
ZERO = BLACK | {"linewidth": 0.6, "linestyle": "-"}


def line(energies: pd.DataFrame, lines: pd.DataFrame, critical: pd.DataFrame) -> Figure:
    """K over Ra^-1/2 on KHP95's grids with lines, what is left of it; Ra_c by lines and by growth rates."""
    energies = energies.query(GAS)
    page = Figure(figsize=(11.2, 5.2), layout="constrained")
    panels = page.subplot_mosaic([["K", "zeros"], ["rest", "zeros"]], height_ratios=(3, 1))
    upper, lower = panels["K"], panels["rest"]
    longest = lines.query(GAS).query("reach == reach.max() and (resolution < @inf or lines != '')")
    for number, at in enumerate(longest.sort_values("resolution").itertuples()):
        points = energies.query("resolution == @at.resolution")
        one_line(upper, lower, points, at, number)
    upper.set(ylabel=ENERGY, ylim=(0, None))
    lower.axhline(0, **ZERO)
    lower.set(xlabel=r"$\mathrm{Ra}^{-1/2}$", xlim=upper.get_xlim(),
              ylabel="off the line\n[% of largest $K$]")
    ra_axis(upper)
    upper.set(xlabel="")
    upper.legend(title="gas, $\\eta$ constant, line from 1.11 to 4 Ra$_c$")
    zeros(panels["zeros"], critical)
    page.suptitle("K is nearly a straight line; where it ends depends on how far it reaches")
    return page


def one_line(upper: Axes, lower: Axes, points: pd.DataFrame, at: Any, number: int) -> None:
    """K of one grid with its line; below, K less the line, in per cent of the largest K."""
    name, style = f"L = {at.resolution:.0f} cells", look(number) | {"linestyle": "none"}
    if at.resolution == inf:
        name, style = r"$L \to \infty$", style | {"color": "black"}
    x = points.ra**-0.5
    upper.plot(x, points.ke, **style, label=f"{name}: zero at {at.ra_c:.1f}")
    ends = np.array([x.min(), at.ra_c**-0.5])
    upper.plot(ends, at.slope*ends + at.intercept, color=style["color"], linestyle="-", marker="")
    rest = points.ke - at.slope*x - at.intercept
    lower.plot(x, 100*rest/points.ke.max(), **style, markerfacecolor="none")


def zeros(axes: Axes, critical: pd.DataFrame) -> None:
    """Ra_c by lines of each reach and by growth rates; intervals, alike at all L, only at the limit."""
    shown = critical.query(f"{GAS} and resolution >= 24 and (way == 'operator' or way == 'line' and "
                           "(resolution < @inf or quantity.str.contains('extrapolated')))")
    series = shown.sort_values("resolution").groupby(["way", "reach"])
    for number, ((way, reach), group) in enumerate(series):
        label = "growth rates" if way == "operator" else f"line to {reach:g} Ra$_c$"
        err = group.err.where(group.resolution == inf, 0.0)
        errorbar(axes, group.resolution**-2.0*1e3, group.value, err, number=number, label=label)
    known = critical.query("method == 'linear' and quantity == 'ra_c periodic aspect 2'")
    for value in known.value:
        axes.axhline(value, **BLACK, linestyle=":", label=f"Boussinesq, {value:.2f}")
    axes.set(xlabel=r"$10^3\,L^{-2}$, L in cells", ylabel=r"Ra$_c$")
    axes.legend(title=r"bars at $L \to \infty$: 95 %, scatter about the line", title_fontsize=8)


FIGURES = Drawings(Drawing("line", ("energies", "lines", "critical_ra"), line))
