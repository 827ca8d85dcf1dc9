"""Figures of the study conservation, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.conservation.derive import SUMS
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


#: scheme, mode, wall as texts begin -> words, in the order in which they are drawn
COLUMNS = {
    ("layer", "pairwise", "periodic"): "friction along edges",
    ("layer", "unmended", "periodic"): "the same, heat as printed",
    ("layer", "nested", "periodic"): "nested friction",
    ("layer", "mixed", "periodic"): "nested and along edges",
    ("layer", "ideal", "periodic"): "no friction",
    ("dih", "printed", ""): "nested, Eq. 37 as printed",
    ("dih", "one-sided", ""): "pressure not symmetric",
    ("dih", "", ""): "1D, 3D, bulk viscosity",
    ("layer", "ideal", "plates, gravity"): "plates, gravity",
    ("layer", "ideal", "plates"): "plates, no friction",
    ("layer", "", "plates"): "plates, friction",
    ("held", "", "body"): "fluid and body",
    ("held", "", ""): "fluid and held rows",
    ("sliding", "", ""): "sliding sides",
    ("motions", "literal", ""): "Eqs 39-41",
    ("motions", "constant", ""): "Eq. 49",
    ("motions", "convective", ""): "Eqs 46-48",
    ("motions", "carried", ""): "the same, volumes follow",
    ("moving", "pairwise", "periodic"): "points that move",
    ("moving", "", "periodic"): "the same, parts left out",
    ("moving", "", "plates"): "the same, plates",
}


def column(scheme: str, mode: str, wall: str) -> int:
    """Where a run is drawn: the first of COLUMNS that fits."""
    fits = [all(text.startswith(start) for text, start in zip((scheme, mode, wall), key, strict=True)) for key in COLUMNS]
    return fits.index(True)


def drift(rows: pd.DataFrame) -> Figure:
    """Changes of claimed sums, in other marks where a run stopped early, and of others; one column a kind of run."""
    page, axes = figure(1, 1, width=9.4, height=5.6)
    rows = rows.assign(column=[column(*run) for run in zip(rows["scheme"], rows["mode"], rows["wall"], strict=True)])
    order = sorted(set(rows["column"]))
    whole = rows["reached"] == rows["steps"]
    for number, name in enumerate(SUMS):
        claimed = np.array([name in text.split() for text in rows["claimed"]], bool)
        for chosen, more in ((rows[claimed & whole], {"label": name}), (rows[claimed & ~whole], {"fillstyle": "left"}),
                             (rows[~claimed], {"fillstyle": "none"})):
            x = [order.index(place) + 0.15*(number - 1.5) for place in chosen["column"]]
            axes.plot(x, np.maximum(chosen[name], LEAST), **{**look(number), "linestyle": "none", "markersize": 6}, **more)
    axes.set_xlim(-0.6, len(order) - 0.4)
    axes.axhline(1e-13, color="grey", linestyle=":", marker="")
    axes.set(yscale="log", ylabel="largest relative change over the run")
    words = list(COLUMNS.values())
    axes.set_xticks(range(len(order)), labels=[words[place] for place in order], rotation=60, ha="right", fontsize=8)
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
