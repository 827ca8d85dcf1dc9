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


#: points between plates -> title
WALLED = {"lattice": "lattice, images behind the plates", "jittered-0.2": "shifted by up to $0.2a$, images",
          "jittered-0.2, plates": "shifted by up to $0.2a$, rows on the plates"}
#: flow -> what U is
FLOWS = {"couette": "Couette flow, $U$: of the upper plate", "poiseuille": "Poiseuille flow, $U$: at last, in the middle"}


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
                where = "lattice" if points == "lattice" else f"shifted by up to $0.3a$, {maker}"
                errorbar(one, some["wavelength"].tolist(), np.abs(some["error"]).tolist(), some["error_err"].tolist(),
                         number=number, label=f"{transport}, {where}")
                symbol = np.abs(some["lattice"]/some["continuum"] - 1)
                one.plot(some["wavelength"], symbol, **{**look(number), "marker": "", "linestyle": "-"})
        one.plot([8, 64], [0.3, 0.3/64], color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        one.set(xscale="log", yscale="log", title=quantity)
        one.set_xticks([8, 16, 32, 64], labels=["8", "16", "32", "64"])
        one.minorticks_off()
    for one in axes[1]:
        one.set_xlabel(r"wavelength $\lambda/a$")
    for one in axes[:, 0]:
        one.set_ylabel("|measured/fluid's - 1|")
    page.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle("Do waves have the viscosities, the conductivity and the speed of sound of the fluid?\n"
                  r"Lucy's weight, $h = 3a$, $\zeta = 0.2\,\rho a (k_BT/m)^{1/2}$" "\n"
                  "full lines: sums over the lattice; bars: 95 % over sets of points", fontsize=10)
    return page


def shear(rows: pd.DataFrame) -> Figure:
    """Rms errors over the number of rows between the plates: a line of panels a flow, a column for each kind of points."""
    kinds, times = [name for name in WALLED if name in set(rows["points"])], sorted(set(rows["time"]))
    page, all_axes = figure(len(FLOWS), len(kinds), width=3.9, height=3.4, sharex=True, sharey=True, squeeze=False)
    for line, flow in zip(all_axes, FLOWS, strict=True):
        for axes, points in zip(line, kinds, strict=True):
            here = rows[(rows["flow"] == flow) & (rows["points"] == points)].sort_values("rows")
            for number, time in enumerate(times):
                some = here[here["time"] == time]
                if len(some):
                    errorbar(axes, some["rows"].tolist(), some["rms"].tolist(), some["rms_err"].tolist(), number=number,
                             linestyle=look(number)["linestyle"], label=rf"$t = {time:g}\,H^2/\nu$")
            axes.plot([8, 64], [4e-3, 4e-3/64], color="grey", linestyle=":", marker="", label=r"rows$^{-2}$")
            axes.set(xscale="log", yscale="log", title=WALLED[points])
            axes.set_xticks([8, 16, 32, 64], labels=["8", "16", "32", "64"])
            axes.minorticks_off()
        line[0].set_ylabel(f"{FLOWS[flow]}\nrms error of the velocity over $U$", fontsize=9)
    for axes in all_axes[-1]:
        axes.set_xlabel("rows between the plates")
    page.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    page.suptitle("Shear flows that start from rest: do they converge on their exact series?\n"
                  r"$H$: distance of the plates, $\nu$: kinematic viscosity, $t$: time from the start" "\n"
                  "bars: 95 % over sets of points", fontsize=10)
    return page
