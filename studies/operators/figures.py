"""Figures of the study operators, from its tables."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from particles.integral.edge_makers import MAKERS
from studies.build.setting import DISORDERS
from studies.kit.figure import Drawing, Drawings, bars, errorbar, figure, logarithmic, look

KINDS = list(DISORDERS)
FLOOR = 1e-16       # smaller values, of round-off, are drawn here
#: points between plates -> title
WALLED = {"lattice": "lattice, images behind the plates", "jittered-0.2": "shifted by up to $0.2a$, images",
          "jittered-0.2, plates": "shifted by up to $0.2a$, rows on the plates"}
#: flow -> what U is
FLOWS = {"couette": "Couette flow, $U$: of the upper plate",
         "poiseuille": "Poiseuille flow, $U$: at last, in the middle"}


def legend(page: Figure, axes: Axes, columns: int, **more: Any) -> None:
    """Draw the legend of one panel for the whole page."""
    page.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=columns, **more)


def growth(means: pd.DataFrame) -> Figure:
    """Growth rates of sound at rest by maker of edges and kind of points."""
    groups = means.query("d == 2").groupby("viscosity")
    page, (panels,) = figure(1, len(groups), width=4.2, height=4.0, sharey=True, squeeze=False)
    for axes, (eta, rows) in zip(panels, groups, strict=True):
        for number, maker in enumerate(MAKERS):
            group = rows[rows["maker"] == maker]
            rates = group["rate"].clip(lower=FLOOR)
            places = group["points"].map(KINDS.index) + 0.1*(number - 2.5)
            errors = np.minimum(group["rate_err"], 0.9*rates)
            errorbar(axes, places, rates, errors, number=number, label=maker)
        axes.axhspan(FLOOR/3, 1e-13, color="grey", alpha=0.15)
        axes.set(yscale="log", ylim=(FLOOR/3, 20), title=rf"$\eta$ = {eta:g} $\rho c a$")
        axes.set_xticks(range(len(KINDS)), labels=KINDS, rotation=30)
    panels[0].set_ylabel("largest growth rate, $c/a$; grey: round-off")
    legend(page, panels[0], len(MAKERS))
    page.suptitle("Sound on fixed points at rest: edges that close do not let it grow")
    return page


def shear(rows: pd.DataFrame) -> Figure:
    """Rms errors of shear flows over the rows between the plates, by flow and by kind of points."""
    page, panels = figure(len(FLOWS), len(WALLED), width=3.9, height=3.4, sharex=True, sharey=True)
    for line, flow in zip(panels, FLOWS, strict=True):
        for axes, points in zip(line, WALLED, strict=True):
            series = rows.query("flow == @flow and points == @points").groupby("time")
            for number, (time, group) in enumerate(series):
                bars(axes, group, "rows", "rms", number=number, linestyle=look(number)["linestyle"],
                     label=rf"$t = {time:g}\,H^2/\nu$")
            axes.plot([8, 64], [4e-3, 4e-3/64], color="grey", linestyle=":", marker="", label=r"rows$^{-2}$")
            axes.set_title(WALLED[points])
            logarithmic(axes, (8, 16, 32, 64))
        line[0].set_ylabel(f"{FLOWS[flow]}\nrms error of the velocity over $U$", fontsize=9)
    for axes in panels[-1]:
        axes.set_xlabel("rows between the plates")
    legend(page, panels[0, 0], 6)
    page.suptitle("Shear flows converge as rows$^{-2}$, off a lattice only with points on the plates\n"
                  r"$H$: distance of the plates, $\nu$: kinematic viscosity, $t$: time from the start" "\n"
                  "bars: 95 % over sets of points")
    return page


SHOWN = {"closure": "how far areas are from closed, $1/a$", "linear": "gradients of linear fields",
         "divergence": "pressure gradient of a wave", "laplacian": "Laplacian of a wave"}
SETS = ("lattice", "hexagonal", "jittered-0.1", "jittered-0.3", "random", "relaxed", "flowed")


def makers(orders: pd.DataFrame) -> Figure:
    """What areas get wrong at the finest spacing; RKGC and bonet-lok, near to sumB, are left out."""
    page, panels = figure(2, 2, width=5.0, height=3.6, sharex=True)
    for axes, (quantity, label) in zip(panels.flat, SHOWN.items(), strict=True):
        some = orders[(orders["quantity"] == quantity) & ~orders["maker"].isin(("RKGC", "bonet-lok"))]
        for number, (maker, rows) in enumerate(some.groupby("maker")):
            places = rows["points"].map(SETS.index) + 0.1*(number - 3)
            style = {**look(number), "linestyle": "none"}
            axes.plot(places, rows["finest"].clip(lower=FLOOR), label=maker, **style)
        axes.axhspan(FLOOR/3, 1e-13, color="grey", alpha=0.15)
        floor = FLOOR/3 if quantity in ("closure", "linear") else 5e-4
        axes.set(yscale="log", ylabel=f"{label}\nrms error", ylim=(floor, 6))
        axes.set_xticks(range(len(SETS)), labels=SETS, rotation=30)
    legend(page, panels[0, 0], 5)
    page.suptitle("Off a lattice only closed faces and Delaunay edges close; 48 rows a wave; grey: round-off")
    return page


FIGURES = Drawings(Drawing("growth", ("growth_means",), growth), Drawing("shear", ("shear_means",), shear),
                   Drawing("makers", ("maker_orders",), makers))
