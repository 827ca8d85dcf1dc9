"""Figures of the study operators, from its tables."""
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random", "relaxed")
MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
TOP = 100.0         # largest step that is drawn, over the prediction
FLOOR = 1e-16       # growth rates of round-off are drawn there
TERMS = {name: name for name in ("gradient", "pressure", "viscous nested", "heat nested", "mass", "momentum", "energy")}
#: operator -> label
FRICTIONS = {"friction, zeta 0": r"$\zeta = 0$", "friction, eta(T), foretold": r"$\eta(T)$, with what it lacks",
             "friction, zeta 0.01": r"$\zeta = \eta/2$", "friction, eta(T)": r"$\eta(T)$"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    wanted = {"symbols": ("symbols",), "convergence": ("equations", "lattice"), "growth": ("growth_means",), "euler": ("euler",)}
    draw: dict[str, Callable[..., Figure]] = {"symbols": symbols, "convergence": convergence, "growth": growth, "euler": euler}
    there = {name: part(rows) for name, part in SHOWN.items() if (rows := tables.get(name)) is not None}
    return {name: draw[name](*(there[table] for table in need)) for name, need in wanted.items()
            if all(table in there and len(there[table]) for table in need)}


#: table -> its rows that are drawn
SHOWN: dict[str, Callable[[pd.DataFrame], pd.DataFrame]] = {
    "symbols": lambda rows: rows[rows["d"] == 2],
    "equations": lambda rows: rows[(rows["d"] == 2) & (rows["h"] == 3.0)],
    "lattice": lambda rows: rows[(rows["weight"] == "Exponential") & (rows["how"] == "plain")],
    "growth_means": lambda rows: rows[rows["d"] == 2], "euler": lambda rows: rows[np.isfinite(rows["limit"])]}


def symbols(rows: pd.DataFrame) -> Figure:
    """Share of the gradient and of the Laplacian that is left of a wave, 2D lattice."""
    page, axes = figure(1, 3, width=3.6, height=3.8, sharey=True)
    for number, (kind, group) in enumerate(rows.groupby("weight")):
        x, style = group["k"].to_numpy()/np.pi, {**look(number), "marker": ""}
        for panel, column in zip(axes, ("gradient", "nested", "pairwise"), strict=True):
            panel.plot(x, group[column], **style, label=f"{kind}, {group['r0'].iloc[0]:g} $a$")
        axes[0].plot(x, group["smoothed"], **{**style, "linewidth": 2.5, "alpha": 0.25})
    for panel, title in zip(axes, ("gradient / $k$", "nested Laplacian / $k^2$", "pairwise Laplacian / $k^2$"), strict=True):
        panel.set(title=title, xlabel=r"$k a/\pi$", ylim=(-0.1, 1.05))
    axes[0].set_ylabel("share left of a wave of wave number $k$")
    handles, labels = axes[0].get_legend_handles_labels()
    page.legend(handles, labels, loc="outside lower center", ncols=4,
                title=r"weights with their ranges; broad and pale: $\hat f(k)$ of the same weight, without a lattice",
                title_fontsize=8)
    page.suptitle("What weights leave of a wave along an axis; nested transport is blind to the shortest", fontsize=10)
    return page


def convergence(equations: pd.DataFrame, lattice: pd.DataFrame) -> Figure:
    """Errors of the terms over the spacing, of forces along edges, and of the exponential weight's first moment."""
    page, (left, middle, right) = figure(1, 3, width=3.8, height=4.4)
    for axes, names, title in ((left, TERMS, "terms as printed (trace $2/d$), $h = 3a$"),
                               (middle, FRICTIONS, "friction along edges [Eq. 51], $h = 3a$")):
        for number, (name, label) in enumerate(names.items()):
            group = equations[equations["operator"] == name].sort_values("cells")
            axes.plot(group["cells"], group["error"], **look(number), label=label)
        second_order(axes, equations["cells"], equations["error"].min())
        axes.set(title=title, xlabel=r"spacings in a wave, $\lambda/a$")
    for d, group in lattice.groupby("d"):
        x, style = 1/group["r0"].to_numpy(float), look(int(str(d)) - 1)
        right.plot(x, (group["value"]/group["d"] - 1).abs(), **{**style, "linestyle": "none"}, label=f"{d}D")
        right.plot(x, (group["predicted"]/group["d"] - 1).abs(), color=style["color"], linestyle=":", marker="")
    right.set(xscale="log", yscale="log", title="exponential weight [Eq. 31], dotted: foretold", xlabel="$a/r_0$",
              ylabel="first moment lost")
    right.set_xticks([1/16, 1/8, 1/4, 1/2, 1], labels=["1/16", "1/8", "1/4", "1/2", "1"])
    right.minorticks_off()
    for axes in (left, middle, right):
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.16))
    left.set_ylabel("relative rms error, 2D lattice")
    return page


def second_order(axes: Axes, cells: pd.Series, least: float) -> None:
    """Logarithmic axes and a line of slope -2."""
    x = np.array([cells.min(), cells.max()], float)
    axes.plot(x, 0.5*least*(x.max()/x)**2, color="grey", linestyle=":", marker="", label=r"$(a/\lambda)^2$")
    axes.set(xscale="log", yscale="log")
    ticks = sorted(set(cells))
    axes.set_xticks(ticks, labels=[f"{n:g}" for n in ticks])
    axes.minorticks_off()


def growth(means: pd.DataFrame) -> Figure:
    """Growth rates of sound at rest by maker of edges and kind of points."""
    viscosities = sorted(set(means["viscosity"]))
    page, panels = figure(1, len(viscosities), width=4.2, height=4.0, sharey=True, squeeze=False)
    for axes, eta in zip(panels[0], viscosities, strict=True):
        for number, maker in enumerate(MAKERS):
            group = means[(means["maker"] == maker) & (means["viscosity"] == eta)].set_index("points")
            there = [kind for kind in KINDS if kind in group.index]
            rates: Any = group.loc[there, "rate"].clip(lower=FLOOR)
            errorbar(axes, [KINDS.index(kind) + 0.1*(number - 2.5) for kind in there], rates.tolist(),
                     np.minimum(group.loc[there, "rate_err"], 0.9*rates).tolist(), number=number, label=maker)
        axes.axhspan(FLOOR/3, 1e-13, color="grey", alpha=0.15)
        axes.set(yscale="log", ylim=(FLOOR/3, 20), title=rf"$\eta$ = {eta:g} $\rho c a$")
        axes.set_xticks(range(len(KINDS)), labels=KINDS, rotation=30)
    panels[0, 0].set_ylabel("largest growth rate, $c/a$; grey: round-off")
    page.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(MAKERS))
    page.suptitle("Sound on fixed points at rest: edges that close do not let it grow", fontsize=10)
    return page


def euler(rows: pd.DataFrame) -> Figure:
    """Largest stable step of forward Euler over the prediction."""
    page, axes = figure(1, 1, width=5.4, height=3.8)
    for number, (transport, group) in enumerate(rows.groupby("transport")):
        fluids = [one.sort_values("k") for _, one in group.groupby(["eta", "zeta", "kappa"])]
        first, *others = (one["limit"].to_numpy()/one["predicted"].to_numpy() for one in fluids)
        shown = first < TOP
        same = max((float(np.abs(other/first - 1)[shown].max()) for other in others if len(other) == len(first)), default=0.0)
        told = f", {len(fluids)} fluids, within {100*same:.1g} %" if len(fluids) > 1 else ""
        axes.plot(fluids[0]["k"].to_numpy()/np.pi, first, **look(number), label=f"{transport}{told}")
    axes.set(yscale="log", ylim=(0.7, TOP), xlabel=r"wave number $k a/\pi$",
             ylabel=r"largest step over $(\eta + \zeta + \kappa/2)/\rho c^2$",
             title="Forward Euler [Eq. 40]: up to which step is sound stable?\n2D gas, $h = 3a$")
    below(axes, bbox_to_anchor=(0.5, -0.16), title=fluids_of(rows), title_fontsize=8)
    return page


def fluids_of(rows: pd.DataFrame) -> str:
    """The viscosities and conductivities that were taken."""
    found = rows[["eta", "zeta", "kappa"]].drop_duplicates().sort_values(["eta", "zeta", "kappa"])
    told = "; ".join(f"{eta:g}, {zeta:g}, {kappa:g}" for eta, zeta, kappa in found.to_numpy())
    return rf"$\eta, \zeta, \kappa$ in $\rho a (k_BT/m)^{{1/2}}$: {told}"
