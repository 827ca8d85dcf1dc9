"""Sod's tube by all methods: profiles against the exact solution, errors against the length."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.hardcases.tube.methods import METHODS
from studies.hardcases.tube.runs import ETAS, STEPS
from studies.hardcases.tube.spam import exact
from studies.kit.figure import figure, look
from studies.kit.table import Tables

ALL = (*METHODS, "smooth particles")
SHIFT = 0.5             # between methods' densities, upwards
SOURCES = ("method_tubes", "method_tube_profiles", "tubes", "tube_profiles")


def figures(tables: Tables) -> dict[str, Figure]:
    """One, beside that of smooth particles."""
    if not all(name in tables and len(tables[name]) for name in SOURCES):
        return {}
    return {"shock_methods": page(*(tables[name] for name in SOURCES))}


def page(rows: pd.DataFrame, profiles: pd.DataFrame, tubes: pd.DataFrame, others: pd.DataFrame) -> Figure:
    """Above: densities, one above the other, without viscosity, with little and with that of smooth particles. Below: errors.

    Of the shorter step: what ends with it is not the step's fault.
    """
    rows, profiles = (frame[frame["step"] == min(STEPS)] for frame in (rows, profiles))
    sheet, axes = figure(2, len(ETAS), width=4.0, height=4.4)
    smooth = tubes.rename(columns={"v_exact": "error"}).assign(method=ALL[-1])
    smooth = smooth[smooth["diverged"].isna()]
    both = pd.concat([rows.rename(columns={"v_exact": "error"}).assign(smooth=False), smooth.assign(smooth=True)])
    lines = pd.concat([profiles, others.assign(method=ALL[-1])])
    for above, under, eta in zip(*axes, ETAS, strict=True):
        densities(above, lines[np.isclose(lines["eta"], eta)], rows[np.isclose(rows["eta"], eta)])
        above.set(title=rf"$\eta = k = {eta:g}$", xlabel="distance from the diaphragm / $L$", xlim=(-0.8, 1.0),
                  ylim=(-0.1, SHIFT*(len(ALL) - 1) + 1.15), yticks=[])
        for number, method in enumerate(ALL):
            some = both[(both["method"] == method) & np.isclose(both["eta"], eta)].dropna(subset=["error"])
            means = some.groupby("L")["error"].mean()
            under.plot(means.index, means, **look(number), label=method)
        under.set(xscale="log", yscale="log", xlabel="half the tube's length $L$ / spacings", ylim=(5e-3, 0.3),
                  ylabel="mean error of $v$ / range")
        under.set_xticks([24, 48, 96, 192], labels=["24", "48", "96", "192"])
        under.set_xlim(22, 210)
        under.minorticks_off()
    axes[0, 0].set_ylabel("density, methods one above the other")
    sheet.legend(*axes[1, 1].get_legend_handles_labels(), loc="outside lower center", ncols=len(ALL))
    sheet.suptitle("Sod's shock tube at $t = 0.4 L$ without artificial viscosity; thin: exact, frictionless", fontsize=10)
    return sheet


def densities(axes: Any, lines: pd.DataFrame, rows: pd.DataFrame) -> None:
    """Each method's own, or when its longest run ended."""
    for number, method in enumerate(ALL):
        some, up = lines[lines["method"] == method].sort_values("x"), SHIFT*number
        run = rows[(rows["method"] == method) & (rows["seed"] == 1)].sort_values("L")
        if len(some):
            x, L = some["x"].to_numpy(), float(some["L"].iloc[0])
            axes.plot(x, up + exact(L, (x + 1)*L)[0], color="black", linewidth=0.7, linestyle="-", marker="")
            axes.plot(x, up + some["rho"], **{**look(number), "linestyle": "none", "markersize": 2})
            axes.text(0.98, up + 0.02, f"{method}, $L$ = {L:g}", ha="right", fontsize=8)
        elif len(run):
            axes.text(0.98, up + 0.2, f"{method}: ended at {run['reached'].iloc[-1]:.2g} of the time", ha="right", fontsize=8)
