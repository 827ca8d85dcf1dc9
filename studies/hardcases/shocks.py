"""Figures of shocks: through smooth particles, and through all methods."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.hardcases.interface import impulse
from studies.hardcases.sod import exact
from studies.hardcases.tubes import ETAS, METHODS, STEPS
from studies.kit.figure import figure, look

ALL = (*METHODS, "smooth particles")
SHIFT = 0.5             # between methods' densities, upwards
LINE: dict[str, Any] = {"linestyle": "-", "marker": ""}


def shocks(profiles: pd.DataFrame, ripples: pd.DataFrame) -> Figure:
    """Above: density and velocity in the longest tube without and with viscosity. Below: the ripple in time.
    """
    page, (above, (height, amplitude)) = figure(2, 2, width=4.4, height=3.2)
    for axes, eta in zip(above, sorted(set(profiles["eta"])), strict=False):
        tube(axes, profiles[profiles["eta"] == eta].sort_values("x"), eta)
    for number, (_, group) in enumerate(ripples.groupby(["steep", "scale"])):
        ripple(height, amplitude, group, {**look(number), "marker": ""})
    expected(height, amplitude, ripples)
    height.set(ylabel="height of the interface / kick x time", title="shocked interface")
    amplitude.set(ylabel="amplitude / that behind the shock", title="its ripple", ylim=(0.4, 2.9))
    for axes, place in ((height, "upper right"), (amplitude, "upper left")):
        axes.set_xlabel("time / time of the shock's arrival")
        axes.legend(loc=place)
    page.legend(*above[-1].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("Shocks through smooth particles as printed, without artificial viscosity\nabove: Sod's tube at "
                  r"$t = 0.4 L$; below: density ratio 4, Mach 1.5; bands: all seeds", fontsize=10)
    return page


def tube(axes: Any, rows: pd.DataFrame, eta: float) -> None:
    """Density and velocity of particles, of the exact solution and of the viscous grid."""
    for number, (name, label) in enumerate((("rho", r"$\rho$"), ("v", "$v$"))):
        style = look(number)
        axes.plot(rows["x"], rows[name], **{**style, "linestyle": "none",
                  "markersize": 2}, label=f"{label}, particles")
        axes.plot(rows["x"], rows[f"{name}_exact"], color="black", linewidth=0.7, **LINE,
                  label="without viscosity, exact" if number else "")
        if rows[f"{name}_grid"].notna().all():
            axes.plot(rows["x"], rows[f"{name}_grid"], **{**style, "linestyle": "--", "marker": ""},
                      label=f"{label}, viscous grid")
    title = rf"$L$ = {rows['L'].iloc[0]:g} spacings, $\eta$ = {eta:g}"
    axes.set(xlabel="distance from the diaphragm / $L$", ylabel=r"$\rho$, $v$", title=title)


def ripple(height: Any, amplitude: Any, rows: pd.DataFrame, style: dict[str, Any]) -> None:
    """Means and all seeds of one size and steepness."""
    scale, steep = (float(rows[name].iloc[0]) for name in ("scale", "steep"))
    theory = impulse(scale, steep)
    heights = rows.groupby("time")["height"].agg(["mean", "min", "max"])
    heights = (heights - heights["mean"].iloc[0])/(theory.kick*theory.back)
    amplitudes = rows.groupby("time")["amplitude"].agg(["mean", "min", "max"])/theory.amplitude
    for axes, some in ((height, heights), (amplitude, amplitudes)):
        x = some.index/theory.meets
        axes.plot(x, some["mean"], **style, label=rf"$ka$ = {steep:g}, {scale:g} x printed size")
        axes.fill_between(x, some["min"], some["max"], color=style["color"], alpha=0.2)


def expected(height: Any, amplitude: Any, ripples: pd.DataFrame) -> None:
    """The exact height of the interface, and impulsive growth of its ripple."""
    theory = impulse(float(ripples["scale"].max()), float(ripples["steep"].max()))
    dashed: dict[str, Any] = {"color": "black", "linestyle": "--", "marker": ""}
    times = np.array([0.0, theory.meets, theory.back])
    heights = theory.kick*np.maximum(times - theory.meets, 0) - theory.fall*times
    height.plot(times/theory.meets, heights/(theory.kick*theory.back), **dashed, label="exact")
    growth = 1 + theory.growth*(times[1:] - theory.meets)/theory.amplitude
    amplitude.plot(times[1:]/theory.meets, growth, **dashed, label="impulsive theory")


def shock_methods(rows: pd.DataFrame, profiles: pd.DataFrame, tubes: pd.DataFrame, others: pd.DataFrame) -> Figure:
    """Above: densities, one above the other, without viscosity, with little and with that of smooth
    particles. Below: errors.

    Of the shorter step: what ends with it is not the step's fault.
    """
    rows, profiles = (frame[frame["step"] == min(STEPS)] for frame in (rows, profiles))
    smooth = tubes[tubes["diverged"].isna()].assign(method=ALL[-1])
    points, lines = pd.concat([rows, smooth]), pd.concat([profiles, others.assign(method=ALL[-1])])
    sheet, all_axes = figure(2, len(ETAS), width=4.0, height=4.4)
    for above, under, eta in zip(*all_axes, ETAS, strict=True):
        densities(above, *(frame[np.isclose(frame["eta"], eta)] for frame in (lines, rows)))
        above.set(title=rf"$\eta = k = {eta:g}$", xlabel="distance from the diaphragm / $L$",
                  xlim=(-0.8, 1.0),
                  ylim=(-0.1, SHIFT*(len(ALL) - 1) + 1.15), yticks=[])
        by_length(under, points[np.isclose(points["eta"], eta)])
    all_axes[0, 0].set_ylabel("density, methods one above the other")
    sheet.legend(*all_axes[1, 1].get_legend_handles_labels(), loc="outside lower center", ncols=len(ALL))
    sheet.suptitle("Sod's shock tube at $t = 0.4 L$ without artificial viscosity; thin: exact, frictionless",
                   fontsize=10)
    return sheet


def by_length(axes: Any, rows: pd.DataFrame) -> None:
    """Errors of v against the exact solution."""
    for number, method in enumerate(ALL):
        some = rows[rows["method"] == method].dropna(subset=["v_exact"])
        means = some.groupby("L")["v_exact"].mean()
        axes.plot(means.index, means, **look(number), label=method)
    axes.set(xscale="log",
             yscale="log", xlabel="half the tube's length $L$ / spacings", ylim=(5e-3, 0.3), xlim=(22, 210),
             ylabel="mean error of $v$ / range")
    axes.set_xticks([24, 48, 96, 192], labels=["24", "48", "96", "192"])
    axes.minorticks_off()


def densities(axes: Any, lines: pd.DataFrame, rows: pd.DataFrame) -> None:
    """Each method's own, or when its longest run ended."""
    for number, method in enumerate(ALL):
        some, up = lines[lines["method"] == method].sort_values("x"), SHIFT*number
        run = rows[(rows["method"] == method) & (rows["seed"] == 1)].sort_values("L")
        if len(some):
            x, L = some["x"].to_numpy(), float(some["L"].iloc[0])
            axes.plot(x, up + exact(L, (x + 1)*L)[0], color="black", linewidth=0.7, **LINE)
            axes.plot(x, up + some["rho"], **{**look(number), "linestyle": "none", "markersize": 2})
            axes.text(0.98, up + 0.02, f"{method}, $L$ = {L:g}", ha="right", fontsize=8)
        elif len(run):
            axes.text(0.98, up + 0.2, f"{method}: ended at {run['reached'].iloc[-1]:.2g} of the time",
                      ha="right", fontsize=8)
