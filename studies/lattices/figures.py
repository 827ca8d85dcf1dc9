"""Figures of the study, from its tables."""
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, errorbar, figure, look

#: by weight and step
LAYERS = {("Lucy", 1.0): "Lucy", ("Monaghan", 1.0): "Monaghan", ("Lucy", 0.25): "Lucy, a quarter of the step"}
STEPS = {"rk4": "Runge-Kutta 4, as printed", "leapfrog": "leapfrog",
         "whole numbers": "leapfrog in whole numbers"}


def freezing(rows: pd.DataFrame, limits: pd.DataFrame) -> Figure:
    """Over the pressure: energy of the mean flow, and fluctuation of neighbours' distances."""
    page, (left, right) = figure(1, 2, width=4.6, height=3.7)
    keys = ["weight", "step"]
    rows, limits = rows.sort_values("P").set_index(keys), limits.groupby(keys).mean(numeric_only=True)
    for number, (layer, label) in enumerate(LAYERS.items()):
        some, style = rows.loc[[layer]], look(number)
        errorbar(left, some["P"], some["flow"], some["flow_err"], number=number, label=label)
        right.plot(some["P"], some["lindemann"], **{**style, "linestyle": "none"})
        for name, dashes in (("melting", "--"), ("barrier", ":")):
            left.axvline(limits.loc[layer, name], color=style["color"], linestyle=dashes, linewidth=0.9)
    left.set(ylabel="K of mean flow / grid's, smoothed")
    right.set(ylabel="fluctuation of distances", ylim=(0, None))
    for axes in (left, right):
        axes.axhline(0.1, color="grey", linewidth=0.6)
        axes.set(xscale="log", xlabel=r"static pressure $P\sigma^2/\epsilon$")
    right.set_xticks([0.5, 1, 2, 4, 8], labels=["0.5", "1", "2", "4", "8"])
    right.minorticks_off()
    page.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle("At which pressure do 512 particles freeze that should convect? Ideal gas, Ra 3000\n"
                  "dashed: printed criterion of melting, dotted: of the largest potential; grey: a tenth",
                  fontsize=10)
    return page


def reversal(rows: pd.DataFrame, twins: pd.DataFrame) -> Figure:
    """Over the time there and back: distance from the start; beside it how fast twins part."""
    page, axes = figure(width=5.8, height=4.2)
    for number, (name, label) in enumerate(STEPS.items()):
        some = rows[rows["integrator"] == name].groupby("time")["apart"].mean()
        axes.plot(some.index, some.clip(lower=1e-17), **look(number), label=label)
    axes.plot(twins["time"], twins["apart"], **look(3), label="molecules beside smooth particles")
    axes.axhline(0.1, color="grey", linewidth=0.6)
    axes.set(yscale="log", ylim=(3e-18, 30), xlabel=r"time $t/\sigma(m/\epsilon)^{1/2}$",
             ylabel=r"rms distance / $\sigma$")
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    page.suptitle(r"Do paths run back? $P\propto\rho^2$, Lucy's weight"
                  "\nforward, velocities turned, and back; whole numbers: exactly 0, drawn at $10^{-17}$",
                  fontsize=10)
    return page


FIGURES = Drawings(
    Drawing("freezing", ("freezing", "freezing_limits"), freezing),
    Drawing("reversal", ("reversal", "twins"), reversal))
