"""Figures of KHP95's hard cases, from their tables."""
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.hardcases.interface.runs import impulse
from studies.kit.figure import errorbar, figure, look
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
STEPS = {"rk4": "Runge-Kutta 4, as printed", "leapfrog": "leapfrog", "whole numbers": "leapfrog in whole numbers"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    makers: dict[str, tuple[Any, tuple[str, ...]]] = {
        "moduli": (moduli, ("moduli",)), "pairs": (pairs, ("fates",)), "freezing": (freezing, ("freezing", "freezing_limits")),
        "reversal": (reversal, ("reversal", "twins")),
        "shocks": (partial(shocks, grid=tables.get("ripples_grid")), ("tube_profiles", "ripples"))}
    return {name: make(*(tables[source] for source in sources)) for name, (make, sources) in makers.items()
            if all(source in tables and len(tables[source]) for source in sources)}


def moduli(rows: pd.DataFrame) -> Figure:
    """Over the range, a row a weight: lines the lattice sums, dotted where negative; points the sums of particles."""
    rows = rows[rows["h"] <= DRAWN]
    page, all_axes = figure(len(WEIGHTS), len(LATTICES), width=3.9, height=2.6, sharex=True, sharey=True)
    for (number, weight), (place, kind) in product(enumerate(WEIGHTS), enumerate(LATTICES)):
        axes, some = all_axes[number, place], rows[(rows["lattice"] == kind) & (rows["weight"] == weight)].sort_values("h")
        colour, h, exact = look(number)["color"], some["h"], some["exact"]
        axes.plot(h, exact.where(exact > 0), color=colour, linestyle="-", marker="", label="lattice sums")
        axes.plot(h, (-exact).where(exact <= 0), color=colour, linestyle=":", marker="", label="negative: unstable")
        summed = some[some["measured"].notna()].iloc[::5]
        axes.plot(summed["h"], summed["measured"].abs(), **{**look(number), "linestyle": "none"}, label="the sums that run")
        ends = np.array([3.0, DRAWN])
        for power, style in ((-2.5, "--"), (-3.5, "-.")):
            axes.plot(ends, 0.05*(ends/3)**power, color="grey", linestyle=style, marker="", label=rf"$h^{{{power}}}$")
        axes.axvline(3.0, color="grey", linewidth=0.6)
        axes.axhline(0.01, color="grey", linewidth=0.6)
        axes.set(xscale="log", yscale="log", ylim=(1e-6, 0.3))
        axes.set_xticks([2, 3, 4, 6, 8, 12], labels=["2", "3", "4", "6", "8", "12"])
        axes.minorticks_off()
    for axes, label in zip(all_axes[:, 0], WEIGHTS.values(), strict=True):
        axes.set_ylabel(f"{label}\n|shear| / bulk modulus")
    for axes, title in zip(all_axes[0], LATTICES.values(), strict=True):
        axes.set_title(title)
    for axes in all_axes[-1]:
        axes.set_xlabel("range $h$ / spacings")
    page.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("How stiff is a fluid of smooth particles on a lattice? |shear modulus| / bulk modulus, a row a weight\n"
                  "thin grey: KHP95's range and 1 %", fontsize=10)
    return page


def pairs(rows: pd.DataFrame) -> Figure:
    """Over the range: the part of the particles that share a site, and how many are on one."""
    page, (left, right) = figure(1, 2, width=4.3, height=3.8, sharex=True)
    for number, (weight, label) in enumerate(WEIGHTS.items()):
        some = rows[rows["weight"] == weight].groupby("h")
        middle = some[["shared", "sites", "predicted"]].mean()
        spread = (some["shared"].max() - some["shared"].min())/2
        errorbar(left, middle.index.tolist(), middle["shared"].tolist(), spread.tolist(), number=number, label=label,
                 linestyle=look(number)["linestyle"])
        shift = 0.02*(number - 1)
        right.plot(middle.index, middle["sites"] + 3*shift, **{**look(number), "linestyle": "none"}, label=label)
        right.plot(middle.index, middle["predicted"] + 3*shift, **{**look(number), "marker": ""})
    left.axhline(float(rows["chance"].mean()), color="grey", linestyle=":", label="particles at random")
    left.set(xlabel="range $h$ / spacings", ylabel="part with another within half a spacing")
    right.set(xlabel="range $h$ / spacings", ylabel="particles a site")
    right.set_yticks([1, 2, 3, 4])
    page.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("One particle a site, or pairs?\nideal gas left to rest, 256 particles; bars: all seeds; right: points the "
                  "median of runs,\nlines the hexagonal lattice of least energy (shifted a little to be told apart)", fontsize=10)
    return page


def freezing(rows: pd.DataFrame, limits: pd.DataFrame) -> Figure:
    """Over the pressure: energy of the mean flow, and fluctuation of neighbours' distances."""
    page, (left, right) = figure(1, 2, width=4.6, height=3.7)
    keys = ["eos", "weight", "ra", "step"]
    for number, (layer, label) in enumerate(LAYERS.items()):
        some = rows[(rows[keys] == list(layer)).all(axis=1)].sort_values("P")
        if some.empty:
            continue
        errorbar(left, some["P"].tolist(), some["flow"].tolist(), some["flow_err"].tolist(), number=number, label=label)
        right.plot(some["P"], some["lindemann"], **{**look(number), "linestyle": "none"})
        limit = limits[(limits[keys] == list(layer)).all(axis=1)]
        for name, style in (("melting", "--"), ("barrier", ":")):
            left.axvline(float(limit[name].mean()), color=look(number)["color"], linestyle=style, linewidth=0.9)
    left.axhline(0.1, color="grey", linewidth=0.6)
    right.axhline(0.1, color="grey", linewidth=0.6)
    left.set(xscale="log", ylabel="K of mean flow / grid's, smoothed")
    right.set(xscale="log", ylabel="fluctuation of distances", ylim=(0, None))
    for axes in (left, right):
        axes.set_xlabel(r"static pressure $P\sigma^2/\epsilon$")
    right.set_xticks([0.5, 1, 2, 4, 8], labels=["0.5", "1", "2", "4", "8"])
    right.minorticks_off()
    page.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    page.suptitle("At which pressure do 512 particles freeze that should convect?\n"
                  "dashed: printed criterion of melting, dotted: of the largest potential; grey: a tenth", fontsize=10)
    return page


def reversal(rows: pd.DataFrame, twins: pd.DataFrame) -> Figure:
    """Over the time there and back: distance from the start; beside it how fast twins part."""
    page, axes = figure(width=5.8, height=4.2)
    for number, (name, label) in enumerate(STEPS.items()):
        some = rows[rows["integrator"] == name].groupby("time")["apart"].mean()
        axes.plot(some.index, some.clip(lower=1e-17), **look(number), label=label)
    axes.plot(twins["time"], twins["apart"], **look(3), label="molecules beside smooth particles")
    axes.axhline(0.1, color="grey", linewidth=0.6)
    axes.set(yscale="log", ylim=(3e-18, 30), xlabel=r"time $t/\sigma(m/\epsilon)^{1/2}$", ylabel=r"rms distance / $\sigma$")
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    page.suptitle(r"Do paths run back? $P\propto\rho^2$, Lucy's weight" "\nforward, velocities turned, and back; "
                  "whole numbers: exactly 0, drawn at $10^{-17}$", fontsize=10)
    return page


def shocks(profiles: pd.DataFrame, ripples: pd.DataFrame, grid: pd.DataFrame | None = None) -> Figure:
    """Above: density and velocity in the longest tube without and with viscosity. Below: the ripple in time, and on a grid."""
    page, all_axes = figure(2, 2, width=4.4, height=3.2)
    for axes, eta in zip(all_axes[0], sorted(set(profiles["eta"])), strict=False):
        tube(axes, profiles[profiles["eta"] == eta].sort_values("x"), eta)
    for number, (_, group) in enumerate(ripples.groupby(["steep", "scale"])):
        scale, steep = (float(group[name].iloc[0]) for name in ("scale", "steep"))
        theory = impulse(scale, steep)
        for axes, name, unit in ((all_axes[1, 0], "height", theory.kick*theory.back),
                                 (all_axes[1, 1], "amplitude", theory.amplitude)):
            some = group.groupby("time")[name].agg(["mean", "min", "max"])
            start = some["mean"].iloc[0] if name == "height" else 0.0
            x, y = some.index/theory.meets, (some["mean"] - start)/unit
            axes.plot(x, y, **{**look(number), "marker": ""}, label=rf"$ka$ = {steep:g}, {scale:g} x printed size")
            axes.fill_between(x, (some["min"] - start)/unit, (some["max"] - start)/unit, color=look(number)["color"], alpha=0.2)
    ended = np.array([theory.meets, theory.back])
    drawn: dict[str, Any] = {"color": "black", "linestyle": "--", "marker": ""}
    fall = np.array([0, -theory.fall*theory.meets, theory.kick*(theory.back - theory.meets) - theory.fall*theory.back])
    all_axes[1, 0].plot([0, 1, theory.back/theory.meets], fall/(theory.kick*theory.back), **drawn, label="exact")
    all_axes[1, 1].plot(ended/theory.meets, 1 + theory.growth*(ended - theory.meets)/theory.amplitude, **drawn,
                        label="impulsive theory")
    if grid is not None and len(grid):
        steep, eta = grid["steep"].max(), grid["eta"].min()
        least, theory = grid[(grid["steep"] == steep) & (grid["eta"] == eta)].sort_values("time"), impulse(1.0, float(steep))
        all_axes[1, 1].plot(least["time"]/theory.meets, least["amplitude"]/theory.amplitude, **{**drawn, "linestyle": "-"},
                            label=rf"$ka$ = {steep:g}, grid, $\eta$ = {eta:g}")
    all_axes[1, 0].set(ylabel="height of the interface / kick x time", title="shocked interface")
    all_axes[1, 1].set(ylabel="amplitude / that behind the shock", title="its ripple",
                        ylim=(0.4, 2.9))
    for axes in all_axes[1]:
        axes.set_xlabel("time / time of the shock's arrival")
    for axes, place in zip(all_axes[1], ("upper right", "upper left")):
        axes.legend(loc=place)
    page.legend(*all_axes[0, -1].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("Shocks through smooth particles as printed, without artificial viscosity\nabove: Sod's tube at "
                  r"$t = 0.4 L$; below: density ratio 4, Mach 1.5; bands: all seeds", fontsize=10)
    return page


def tube(axes: Any, rows: pd.DataFrame, eta: float) -> None:
    """Density and velocity of particles, of the exact solution and of the viscous grid."""
    for number, (name, label) in enumerate((("rho", r"$\rho$"), ("v", "$v$"))):
        axes.plot(rows["x"], rows[name], **{**look(number), "linestyle": "none", "markersize": 2}, label=f"{label}, particles")
        axes.plot(rows["x"], rows[f"{name}_exact"], color="black", linewidth=0.7, linestyle="-", marker="",
                  label="without viscosity, exact" if number else "")
        if rows[f"{name}_grid"].notna().all():
            axes.plot(rows["x"], rows[f"{name}_grid"], **{**look(number), "linestyle": "--", "marker": ""},
                      label=f"{label}, viscous grid")
    title = rf"$L$ = {rows['L'].iloc[0]:g} spacings, $\eta$ = {eta:g}"
    axes.set(xlabel="distance from the diaphragm / $L$", ylabel=r"$\rho$, $v$", title=title)
