"""Figures of the study conservation, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.integral.conservation_derive import SUMS, finished
from studies.kit.figure import below, errorbar, figure
from studies.kit.table import Tables

MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
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


def drift(rows: pd.DataFrame) -> Figure:
    """Changes of claimed sums in runs that reached the end, of others in all runs; one column a scheme, mode and wall."""
    page, axes = figure(1, 1, width=9.0, height=5.0)
    names = [f"{scheme} {mode}\n{wall}" for scheme, mode, wall in zip(rows["scheme"], rows["mode"], rows["wall"], strict=True)]
    rows, order = rows.assign(column=names), sorted(set(names))
    for number, name in enumerate(SUMS):
        claimed = np.array([name in text.split() for text in rows["claimed"]], bool)
        for chosen, fill in ((finished(rows[claimed]), "full"), (rows[~claimed], "none")):
            x = [order.index(column) + 0.15*(number - 1.5) for column in chosen["column"]]
            errorbar(axes, x, np.maximum(chosen[name], LEAST).tolist(), [0.0]*len(x), number=number, fillstyle=fill,
                     label=name if fill == "full" else "")
    axes.set_xlim(-0.6, len(order) - 0.4)
    axes.axhline(1e-13, color="grey", linestyle=":")
    axes.set(yscale="log", ylabel="largest relative change over the run")
    axes.set_xticks(range(len(order)), labels=order, rotation=60, ha="right", fontsize=8)
    axes.set_title("Filled: claimed to be conserved; open: not; dotted: 1e-13; nothing at all is drawn as 1e-17")
    below(axes, ncols=4, bbox_to_anchor=(0.5, -0.32))
    return page


def sound(rows: pd.DataFrame) -> Figure:
    """Growth of linear sound by makers of edges, for both brackets."""
    page, both = figure(1, 2, width=4.4, height=4.0, sharey=True)
    for axes, bracket in zip(both, ("plus", "adjoint"), strict=True):
        for number, kind in enumerate(KINDS):
            some = rows[(rows["bracket"] == bracket) & (rows["points"] == kind)]
            if len(some):
                x = np.array([MAKERS.index(maker) for maker in some["maker"]]) + 0.12*(number - 1.5)
                errorbar(axes, x.tolist(), np.maximum(some["growth"], LEAST).tolist(), some["growth_err"].tolist(),
                         number=number, label=kind)
        axes.set(yscale="log", title=TITLES[bracket])
        axes.set_ylim(LEAST/3, 300)
        axes.set_xticks(range(len(MAKERS)), labels=MAKERS, rotation=45, ha="right")
    both[0].set_ylabel("fastest growth of sound per period")
    page.legend(*both[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return page
