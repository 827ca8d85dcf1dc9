"""Figures of the study onset, from its tables alone."""
from math import inf, sqrt
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.names import ENERGY, ra_axis
from studies.kit.figure import Drawing, Drawings, below, errorbar, figure, look
from studies.onset.tables import means

#: rows of the gas in KHP95's layer
GAS = ("method == 'compressible' and eos == 'ideal' and transport == 'const-eta' and dT == 1 "
       "and sides == 'periodic'")
#: series of growth rates: label -> rows
GRIDS = {
    r"gas, $\eta$ constant": GAS,
    r"gas, $\nu$ constant": GAS.replace("const-eta", "const-nu"),
    "van der Waals": GAS.replace("ideal", "vdw"),
}
#: schemes of particles that have a panel: variant -> title
SCHEMES = {"printed": "particles as printed", "less-static-90": "particles, a tenth of the static pressure"}
GAS_TIME = r"the same for the gas: over $\sqrt{2}$, half of" "\nits gradient is adiabatic"
NARROW = (1550.0, 1860.0)
BLACK: dict[str, Any] = {"color": "black", "marker": ""}
ZERO = BLACK | {"linewidth": 0.6, "linestyle": "-"}
HOLLOW = {"linestyle": "none", "markerfacecolor": "none"}


def growth(rates: pd.DataFrame) -> Figure:
    """sigma against Ra: weak rolls of grids and linear theory; stronger rolls of particles and of the gas."""
    known = rates.query("method == 'linear'").sort_values("ra")
    finite = rates.query("way == 'run'")
    page, panels = figure(1, 1 + len(SCHEMES), width=4.6, height=5.6)
    weak, *strong = panels
    draw_weakest(weak, rates.query("way == 'operator'"), known)
    for axes, (name, title) in zip(strong, SCHEMES.items()):
        theory(axes, known)
        draw_rolls(axes, finite.query("method != 'spam'"), first=0)
        draw_rolls(axes, finite[finite.variant == name], first=1)
        axes.set_title(title)
        axes.sharey(strong[0])
    for axes in panels:
        axes.axhline(0, **ZERO)
        axes.set(xlabel="Rayleigh number Ra", ylabel=r"growth rate $\sigma$  [1/free-fall time]")
        below(axes)
    page.suptitle("From which Ra on do rolls grow? Right: rolls of K = 0.0004; bars: 95 % over seeds",
                  fontsize=10)
    return page


def theory(axes: Axes, known: pd.DataFrame) -> None:
    """Boussinesq fluid of Pr = 2 in the gas's free-fall time: half of the gradient is adiabatic."""
    axes.plot(known.ra, 1/sqrt(2)*known.sigma, **BLACK, linestyle="--", label=GAS_TIME)


def draw_weakest(axes: Axes, rates: pd.DataFrame, known: pd.DataFrame) -> None:
    """Rates of the finest grids."""
    axes.plot(known.ra, known.sigma, **BLACK, linestyle="-", label="linear theory, Pr = 2")
    theory(axes, known)
    rates = rates[rates.ra.between(*NARROW)].sort_values("ra")
    for number, (label, wanted) in enumerate(GRIDS.items()):
        finest = rates.query(wanted).query("resolution == resolution.max()")
        axes.plot(finest.ra, finest.sigma, **look(number) | HOLLOW, label=label)
    axes.set(title="weakest disturbances, finest grids", xlim=NARROW, ylim=(-0.02, 0.03))


def draw_rolls(axes: Axes, runs: pd.DataFrame, first: int) -> None:
    """Means over seeds for each number of rows."""
    grids = runs.groupby(["method", "resolution"])
    for number, ((method, size), group) in enumerate(grids, first):
        where = "" if method == "spam" else "gas on a grid, "
        style = look(number) | {"lw": 0.9, "label": f"{where}{size:.0f} rows"}
        at_ra = means(group)
        errorbar(axes, at_ra.ra, at_ra.sigma, at_ra.sigma_err, **style)


def line(energies: pd.DataFrame, lines: pd.DataFrame, critical: pd.DataFrame) -> Figure:
    """K against Ra^-1/2 on KHP95's grids, its lines, what is left; where they and growth rates put Ra_c."""
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
    upper.legend(title="gas, $\\eta$ constant, line to 4 Ra$_c$")
    zeros(panels["zeros"], critical)
    return page


def one_line(upper: Axes, lower: Axes, points: pd.DataFrame, at: Any, number: int) -> None:
    """K of one grid with its line; below, what is left, in per cent of the largest K."""
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
    """Ra_c of lines of each reach and of growth rates; the interval of a line, alike at all L, once."""
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


FIGURES = Drawings(
    Drawing("growth", ("growth_rates",), growth),
    Drawing("line", ("energies", "lines", "critical_ra"), line))
