"""Figures of the study, from its tables."""
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables

DRAWN = 12.0        # widest range that the eye tells oscillations apart at
WEIGHTS = {"Lucy": "Lucy", "Monaghan": "Monaghan", "WendlandC2": "Wendland C2"}
LATTICES = {"hexagonal": "hexagonal lattice", "square": "square lattice, sheared along an axis",
            "diagonal": "square lattice, sheared at 45°"}
LAYERS = {("IdealGas", "Lucy", 3000.0, 1.0): "ideal gas, Lucy, Ra 3000",
          ("IdealGas", "Monaghan", 3000.0, 1.0): "ideal gas, Monaghan, Ra 3000",
          ("DenseFluid", "Lucy", 3000.0, 1.0): "dense fluid, Lucy, Ra 3000",
          ("IdealGas", "Lucy", 1e4, 1.0): "ideal gas, Lucy, Ra 10 000",
          ("IdealGas", "Lucy", 1e4, 0.25): "the same, a quarter of the step"}
STEPS = {"rk4": "Runge-Kutta 4, as printed",
"leapfrog": "leapfrog", "whole numbers": "leapfrog in whole numbers"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    return {name: draw(*(tables[source] for source in sources)) for name, (draw, sources) in DRAWINGS.items()
            if all(len(tables.get(source, ())) for source in sources)}


def moduli(rows: pd.DataFrame) -> Figure:
    """Over the range, a row a weight: lattice sums, dotted where negative; points: particles."""
    rows = rows[rows["h"] <= DRAWN].sort_values("h")
    page, all_axes = figure(len(WEIGHTS), len(LATTICES), width=3.9, height=2.6, sharex=True, sharey=True)
    for (number, weight), (place, kind) in product(enumerate(WEIGHTS), enumerate(LATTICES)):
        some = rows[(rows["lattice"] == kind) & (rows["weight"] == weight)]
        stiffness(all_axes[number, place], some, look(number))
    for axes, label in zip(all_axes[:, 0], WEIGHTS.values(), strict=True):
        axes.set_ylabel(f"{label}\n|shear| / bulk modulus")
    for axes, title in zip(all_axes[0], LATTICES.values(), strict=True):
        axes.set_title(title)
    for axes in all_axes[-1]:
        axes.set_xlabel("range $h$ / spacings")
    page.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("How stiff is a fluid of smooth particles on a lattice? |shear modulus| / bulk modulus, a "
                  "row a weight\nthin grey: KHP95's range and 1 %", fontsize=10)
    return page


def stiffness(axes: Any, rows: pd.DataFrame, style: dict[str, Any]) -> None:
    """Moduli of one lattice and weight, and powers of the range beside them."""
    line = {"color": style["color"], "marker": ""}
    h, exact = rows["h"], rows["exact"]
    axes.plot(h, exact.where(exact > 0), **line, linestyle="-", label="lattice sums")
    axes.plot(h, (-exact).where(exact <= 0), **line, linestyle=":", label="negative: unstable")
    summed = rows[rows["measured"].notna()].iloc[::5]
    axes.plot(summed["h"], summed["measured"].abs(), **{**style, "linestyle": "none"}, label="the sums that "
                                                                                             "run")
    ends = np.array([3.0, DRAWN])
    for power, dashes in ((-2.5, "--"), (-3.5, "-.")):
        axes.plot(ends, 0.05*(ends/3)**power, color="grey",
                              linestyle=dashes, marker="", label=rf"$h^{{{power}}}$")
    axes.axvline(3.0, color="grey", linewidth=0.6)
    axes.axhline(0.01, color="grey", linewidth=0.6)
    axes.set(xscale="log", yscale="log", ylim=(1e-6, 0.3))
    axes.set_xticks([2, 3, 4, 6, 8, 12], labels=["2", "3", "4", "6", "8", "12"])
    axes.minorticks_off()


def pairs(rows: pd.DataFrame) -> Figure:
    """Over the range: the part of the particles that share a site, and how many are on one."""
    page, (left, right) = figure(1, 2, width=4.3, height=3.8, sharex=True)
    for number, (weight, label) in enumerate(WEIGHTS.items()):
        some = rows[rows["weight"] == weight].groupby("h")
        middle, shift = some[["shared", "sites", "predicted"]].mean(), 0.06*(number - 1)
        spread = (some["shared"].max() - some["shared"].min())/2
        errorbar(left, middle.index.tolist(), middle["shared"].tolist(), spread.tolist(), number=number, label=label,
                 linestyle=look(number)["linestyle"])
        right.plot(middle.index, middle["sites"] + shift, **{**look(number), "linestyle": "none"}, label=label)
        right.plot(middle.index, middle["predicted"] + shift, **{**look(number), "marker": ""})
    left.axhline(float(rows["chance"].mean()), color="grey", linestyle=":", label="particles at random")
    left.set(xlabel="range $h$ / spacings", ylabel="part with another within half a spacing")
    right.set(xlabel="range $h$ / spacings", ylabel="particles a site", yticks=[1, 2, 3, 4])
    page.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("One particle a site, or pairs?\nideal gas left to rest, 256 particles; bars: all seeds; "
                  "right: points the median of runs,\nlines the hexagonal lattice of least energy (shifted a "
                  "little to be told apart)", fontsize=10)
    return page


def freezing(rows: pd.DataFrame, limits: pd.DataFrame) -> Figure:
    """Over the pressure: energy of the mean flow, and fluctuation of neighbours' distances."""
    page, (left, right) = figure(1, 2, width=4.6, height=3.7)
    keys = ["eos", "weight", "ra", "step"]
    rows, limits = rows.set_index(keys).sort_values("P"), limits.set_index(keys)
    for number, (layer, label) in enumerate(LAYERS.items()):
        if layer not in rows.index:
            continue
        some = rows.loc[[layer]]
        errorbar(left, some["P"].tolist(), some["flow"].tolist(), some["flow_err"].tolist(), number=number, label=label)
        right.plot(some["P"], some["lindemann"], **{**look(number), "linestyle": "none"})
        for name, style in (("melting", "--"), ("barrier", ":")):
            at = float(limits.loc[[layer]][name].mean())
            left.axvline(at, color=look(number)["color"], linestyle=style, linewidth=0.9)
    left.set(xscale="log", ylabel="K of mean flow / grid's, smoothed")
    right.set(xscale="log", ylabel="fluctuation of distances", ylim=(0, None))
    for axes in (left, right):
        axes.axhline(0.1, color="grey", linewidth=0.6)
        axes.set_xlabel(r"static pressure $P\sigma^2/\epsilon$")
    right.set_xticks([0.5, 1, 2, 4, 8], labels=["0.5", "1", "2", "4", "8"])
    right.minorticks_off()
    page.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    page.suptitle("At which pressure do 512 particles freeze that should convect?\ndashed: printed criterion "
                  "of melting, dotted: of the largest potential; grey: a tenth", fontsize=10)
    return page


def reversal(rows: pd.DataFrame, twins: pd.DataFrame) -> Figure:
    """Over the time there and back: distance from the start; beside it how fast twins part."""
    page, axes = figure(width=5.8, height=4.2)
    for number, (name, label) in enumerate(STEPS.items()):
        some = rows[rows["integrator"] == name].groupby("time")["apart"].mean()
        axes.plot(some.index, some.clip(lower=1e-17), **look(number), label=label)
    axes.plot(twins["time"], twins["apart"], **look(3), label="molecules beside smooth particles")
    axes.axhline(0.1, color="grey", linewidth=0.6)
    axes.set(yscale="log",
             ylim=(3e-18, 30), xlabel=r"time $t/\sigma(m/\epsilon)^{1/2}$", ylabel=r"rms distance / $\sigma$")
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    page.suptitle(r"Do paths run back? $P\propto\rho^2$, Lucy's weight" "\nforward, velocities turned, and back; "
                  "whole numbers: exactly 0, drawn at $10^{-17}$", fontsize=10)
    return page


def ringing(rows: pd.DataFrame) -> Figure:
    """Over the length of a wave: velocities across it when it has rung for two periods."""
    page, axes = figure(width=5.8, height=4.6)
    rows = rows.assign(across=rows["across"]/rows["wave"], foretold=rows["foretold"]/rows["wave"])
    for number, ((kind, weight, h), some) in enumerate(rows.groupby(["lattice", "weight", "h"])):
        label = f"{kind}, {WEIGHTS[str(weight)]}, $h$ = {h:g}"
        axes.plot(some["length"], some["across"], **{**look(number), "linestyle": "none"}, label=label)
        line = some.groupby("length")["foretold"].mean()
        axes.plot(line.index, line, color=look(number)["color"], linestyle="-", marker="")
    axes.axhline(1.0, color="grey", linewidth=0.8)
    axes.set(yscale="log", xscale="log", ylim=(1e-11, 1e6), xlabel="length of the wave / spacings",
             ylabel="velocity across the wave / the wave's")
    axes.set_xticks([40, 60, 100, 200, 300], labels=["40", "60", "100", "200", "300"])
    axes.minorticks_off()
    below(axes, ncols=2)
    page.suptitle("When does a lattice melt into a sound wave?\npoints: runs, two periods on; lines: "
                  "round-off that grew, by lattice sums", fontsize=10)
    return page


DRAWINGS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "moduli": (moduli, ("moduli",)), "pairs": (pairs, ("fates",)), "freezing": (freezing, ("freezing", "freezing_limits")),
    "reversal": (reversal, ("reversal", "twins")), "ringing": (ringing, ("ringing",))}
