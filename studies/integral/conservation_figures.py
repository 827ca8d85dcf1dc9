"""Figures of the study conservation, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.integral.conservation_derive import SUMS
from studies.kit.figure import errorbar, figure, look
from studies.kit.table import Tables

MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
POINTS = dict(zip(KINDS, ("lattice", "shifted by up to $0.3a$", "random", "moved apart"), strict=True))
TITLES = {"plus": "$(f_i + f_j)$ in both, Eqs 34, 35", "adjoint": "differences in the gradient"}
LEAST = 1e-17       # what is drawn for a change of nothing


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    found = {}
    if "drift" in tables:
        found["drift"] = drift(tables["drift"])
    if "sound_means" in tables:
        found["sound"] = sound(tables["sound_means"])
    return found


#: scheme and mode of `drift` -> words
SCHEMES = {"dih pairwise": "1D, 3D: along edges", "dih printed": "1D, 2D: nested, Eq. 37 as printed",
           "dih one-sided": "1D: pressure not symmetric", "layer pairwise": "friction along edges",
           "layer unmended": "along edges, heat as printed", "layer nested": "nested friction", "layer ideal": "no friction",
           "moving pairwise": "points that move"}


def drift(rows: pd.DataFrame) -> Figure:
    """Changes of claimed sums, in other marks where a run stopped early, and of others; one column a scheme, mode and wall."""
    page, axes = figure(1, 1, width=9.4, height=5.6)
    kinds = rows["scheme"] + " " + rows["mode"]
    names = [f"{SCHEMES.get(kind, kind)},\n{wall}" for kind, wall in zip(kinds, rows["wall"], strict=True)]
    place = {kind: number for number, kind in enumerate(SCHEMES)}
    placed = sorted((place.get(kind, len(place)), name) for kind, name in zip(kinds, names, strict=True))
    order = list(dict.fromkeys(name for _, name in placed))
    rows = rows.assign(column=names)
    whole = rows["reached"] == rows["steps"]
    for number, name in enumerate(SUMS):
        claimed = np.array([name in text.split() for text in rows["claimed"]], bool)
        for chosen, more in ((rows[claimed & whole], {"label": name}), (rows[claimed & ~whole], {"fillstyle": "left"}),
                             (rows[~claimed], {"fillstyle": "none"})):
            x = [order.index(column) + 0.15*(number - 1.5) for column in chosen["column"]]
            axes.plot(x, np.maximum(chosen[name], LEAST), **{**look(number), "linestyle": "none", "markersize": 6}, **more)
    axes.set_xlim(-0.6, len(order) - 0.4)
    axes.axhline(1e-13, color="grey", linestyle=":", marker="")
    axes.set(yscale="log", ylabel="largest relative change over the run")
    axes.set_xticks(range(len(order)), labels=order, rotation=60, ha="right", fontsize=8)
    axes.set_title(f"What do schemes on points conserve in {rows['steps'].max()} steps?\n"
                   "filled: what the scheme claims to; left half filled: the same in runs that stopped early (diverged, or sound "
                   "outran the step);\nopen: not claimed, also in such runs; dotted: 1e-13; no change at all is drawn as 1e-17",
                   fontsize=9)
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return page


def sound(rows: pd.DataFrame) -> Figure:
    """Growth of linear sound by makers of edges, for both brackets."""
    page, both = figure(1, 2, width=4.4, height=4.4, sharey=True)
    for axes, bracket in zip(both, ("plus", "adjoint"), strict=True):
        for number, kind in enumerate(KINDS):
            some = rows[(rows["bracket"] == bracket) & (rows["points"] == kind)]
            if len(some):
                x = np.array([MAKERS.index(maker) for maker in some["maker"]]) + 0.12*(number - 1.5)
                errorbar(axes, x.tolist(), np.maximum(some["growth"], LEAST).tolist(), some["growth_err"].tolist(),
                         number=number, label=POINTS[kind])
        axes.set(yscale="log", title=TITLES[bracket], xlabel="edges")
        axes.set_ylim(LEAST/3, 300)
        axes.set_xticks(range(len(MAKERS)), labels=MAKERS, rotation=45, ha="right")
    both[0].set_ylabel("fastest growth of sound per period")
    page.legend(*both[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    page.suptitle("Sound without friction: does it keep its energy? Below 1e-13: round-off; bars: 95 % over sets of points",
                  fontsize=10)
    return page
