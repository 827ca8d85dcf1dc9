"""Figures of the study transport, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import errorbar, figure, look
from studies.kit.table import Tables

SHOWN = ("viscosity", "bulk viscosity", "conductivity", "sound speed")
#: curves of the first figure: transport, maker, points; all with Lucy's weight, h = 3 a, zeta = 0.2
CURVES = (("nested", "renormalised", "lattice"), ("pairwise", "renormalised", "lattice"), ("nested", "exact", "jittered-0.3"),
          ("pairwise", "exact", "jittered-0.3"), ("nested", "delaunay", "jittered-0.3"),
          ("pairwise", "delaunay", "jittered-0.3"))


#: points between plates, how they are marked and joined
WALLED = (("lattice", "full", "-"), ("jittered-0.2", "none", "--"), ("jittered-0.2, plates", "right", ":"))


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    found = {}
    if "coefficients" in tables:
        found["coefficients"] = coefficients(tables["coefficients"])
    if "shear_means" in tables:
        found["shear"] = shear(tables["shear_means"])
    return found


def coefficients(rows: pd.DataFrame) -> Figure:
    """Errors over the wavelength: points measured, lines the lattice symbol."""
    page, axes = figure(2, 2, width=4.2, height=3.2, sharex=True)
    rows = rows[(rows["weight"] == "Lucy") & (rows["h"] == 3.0) & (rows["zeta"] > 0) & (rows["direction"] == "axis")]
    for one, quantity in zip(axes.ravel(), SHOWN, strict=True):
        for number, (transport, maker, points) in enumerate(CURVES):
            some = rows[(rows["quantity"] == quantity) & (rows["transport"] == transport) & (rows["maker"] == maker)
                        & (rows["points"] == points)].sort_values("wavelength")
            if len(some):
                errorbar(one, some["wavelength"].tolist(), np.abs(some["error"]).tolist(), some["error_err"].tolist(),
                         number=number, label=f"{transport}, {points}" + (f", {maker}" if points != "lattice" else ""))
                symbol = np.abs(some["lattice"]/some["continuum"] - 1)
                one.plot(some["wavelength"], symbol, **{**look(number), "marker": "", "linestyle": "-"})
        one.plot([8, 64], [0.3, 0.3/64], color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        one.set(xscale="log", yscale="log", title=quantity)
        one.set_xticks([8, 16, 32, 64], labels=["8", "16", "32", "64"])
        one.minorticks_off()
    for one in axes[1]:
        one.set_xlabel(r"wavelength $\lambda/a$")
    for one in axes[:, 0]:
        one.set_ylabel("|measured/continuum - 1|")
    page.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle(r"Lucy, $h = 3a$, $\zeta = 0.2$; lines: lattice symbol; bars: 95 % over point sets", fontsize=10)
    return page


def shear(rows: pd.DataFrame) -> Figure:
    """Rms errors over the number of rows between the plates."""
    page, both = figure(1, 2, width=4.2, height=4.0, sharey=True)
    times = sorted(set(rows["time"]))
    for axes, flow in zip(both, ("couette", "poiseuille"), strict=True):
        for points, filled, line in WALLED:
            for number, time in enumerate(times):
                some = rows[(rows["flow"] == flow) & (rows["points"] == points) & (rows["time"] == time)].sort_values("rows")
                if len(some):
                    errorbar(axes, some["rows"].tolist(), some["rms"].tolist(), some["rms_err"].tolist(), number=number,
                             linestyle=line, fillstyle=filled,
                             label=rf"{points}, $t = {time:g}\,H^2/\nu$")
        axes.plot([8, 64], [4e-3, 4e-3/64], color="grey", linestyle=":", marker="", label=r"rows$^{-2}$")
        axes.set(xscale="log", yscale="log", title=flow, xlabel="rows between the plates")
        axes.set_xticks([8, 16, 32, 64], labels=["8", "16", "32", "64"])
        axes.minorticks_off()
    both[0].set_ylabel("rms error of the velocity")
    page.legend(*both[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return page
