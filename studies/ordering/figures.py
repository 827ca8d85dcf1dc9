"""Figures of the study ordering, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure
from studies.kit.table import Tables
from studies.ordering import flows_figures as ordering_flows_figures
from studies.ordering.brackets import WAVELENGTH
from studies.ordering.flows_claims import WIDTH

#: how a gradient is taken
FORMS = {"single": "$f_j$  [Eq. 1]", "sum": "$f_i + f_j$  [Eqs 14, 34-36]", "difference": "$f_j - f_i$"}
KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random", "relaxed")
MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    of_operators = {"surface": surface(tables["means"]), "makers": makers(tables["means"])} if "means" in tables else {}
    printed = {"brackets": brackets(tables["bracket_means"])} if "bracket_means" in tables else {}
    return {**{name: page for name, page in of_operators.items() if page}, **printed, **ordering_flows_figures.figures(tables)}


def surface(means: pd.DataFrame) -> Figure | None:
    """Error of the gradient over the range of the weight, one curve a wavelength; the ordering of Eq. 45 is between the ends."""
    chosen = means[(means["maker"] == "renormalised") & (means["weight"] == "Lucy")]
    kinds, waves = [kind for kind in KINDS if kind in set(chosen["points"])], sorted(set(chosen["wavelength"]))
    if not kinds:
        return None
    page, rows = figure(2, len(kinds), width=2.4, height=3.0, sharex=True, sharey="row", squeeze=False)
    for column, kind in enumerate(kinds):
        for row, operator in zip(rows, ("gradient", "laplacian"), strict=True):
            axes = row[column]
            for wavelength, group in chosen[chosen["points"] == kind].groupby("wavelength"):
                errorbar(axes, *columns(group.sort_values("h"), "h", operator), number=waves.index(wavelength), linestyle="-",
                         label=rf"$\lambda$ = {wavelength} $a$")
            axes.set(xscale="log", yscale="log")
            axes.set_xticks([1.2, 2, 3, 4, 6], labels=["1.2", "2", "3", "4", "6"])
            axes.minorticks_off()
        rows[0, column].set_title(kind)
        rows[1, column].set_xlabel("range $h/a$")
    rows[0, 0].set_ylabel("relative rms error of grad")
    rows[1, 0].set_ylabel("relative rms error of Laplacian")
    known = dict(pair for axes in rows.ravel() for pair in zip(*axes.get_legend_handles_labels()[::-1]))
    page.legend([known[name] for name in sorted(known, key=lambda name: float(name.split()[-2]))],
                sorted(known, key=lambda name: float(name.split()[-2])), loc="outside lower center", ncols=len(known))
    page.suptitle("Must $a < r_0 < \\lambda$ hold?  Lucy's weight, renormalised; bars: 95 % over point sets", fontsize=10)
    return page


def columns(group: pd.DataFrame, x: str, y: str) -> list[list[float]]:
    """x, y and the error of y."""
    return [group[name].tolist() for name in (x, y, f"{y}_err")]


def makers(means: pd.DataFrame) -> Figure:
    """Errors of all makers of edges as points get finer, on a lattice and on jittered points."""
    page, (left, right) = figure(1, 2, width=4.2, height=4.2, sharey=True)
    for axes, kind in ((left, "lattice"), (right, "jittered-0.3")):
        for number, maker in enumerate(MAKERS):
            some = means[(means["maker"] == maker) & (means["points"] == kind) & (means["weight"] == "Lucy")]
            group = some[some["h"] == (3.0 if 3.0 in set(some["h"]) else 2.0)].sort_values("wavelength")
            if len(group):
                errorbar(axes, *columns(group, "wavelength", "gradient"), number=number, linestyle="-",
                         label=maker + ("" if maker == "delaunay" else ", $h = 3a$"))
        x = np.array([16.0, 96.0])
        axes.plot(x, 0.35*(16/x)**2, color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        axes.set(xscale="log", yscale="log", title=kind, xlabel=r"wavelength $\lambda/a$")
        axes.set_xticks([16, 24, 32, 48, 64, 96], labels=["16", "24", "32", "48", "64", "96"])
        axes.minorticks_off()
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.18))
    left.set_ylabel("relative rms error of grad")
    return page


def brackets(means: pd.DataFrame) -> Figure:
    """Errors of gradients as printed and by differences over the range of the weight, one panel a kind of points."""
    kinds = [kind for kind in KINDS if kind in set(means["points"])]
    page, (row,) = figure(1, len(kinds), width=2.8, height=3.6, sharey=True, squeeze=False)
    for axes, kind in zip(row, kinds, strict=True):
        chosen = means[(means["points"] == kind) & (means["wavelength"] == WAVELENGTH)].sort_values("h")
        for number, (form, words) in enumerate(FORMS.items()):
            errorbar(axes, *columns(chosen[chosen["form"] == form], "h", "error"), number=number, linestyle="-", label=words)
        axes.axvspan(1.1, 1/WIDTH, color="0.9", zorder=0, label="$r_0 < a$")
        axes.set(xscale="log", yscale="log", title=kind, xlabel="range $h/a$", xlim=(1.1, 6.6))
        axes.set_xticks([1.2, 2, 3, 4, 6], labels=["1.2", "2", "3", "4", "6"])
        axes.minorticks_off()
    row[0].set_ylabel("relative rms error of grad")
    handles, labels = row[0].get_legend_handles_labels()
    page.legend(handles, labels, loc="outside lower center", ncols=4)
    page.suptitle(rf"Gradients as printed, and by differences: Lucy's weight, plain quadrature, $\lambda$ = {WAVELENGTH} $a$; "
                  "bars: 95 % over point sets", fontsize=10)
    return page
