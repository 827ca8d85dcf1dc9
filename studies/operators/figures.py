"""Figures of the study operators, from its tables."""
from collections.abc import Iterable

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.drawing import Drawing, Drawings
from studies.kit.figure import below, errorbar, figure, look

KINDS = ("lattice", "jittered-0.1", "jittered-0.3", "random", "relaxed")
MAKERS = ("printed", "plain", "renormalised", "closed", "exact", "delaunay")
TOP = 100.0         # largest step that is drawn, over the prediction
FLOOR = 1e-16       # growth rates of round-off are drawn there
TERMS = {name: name for name in ("gradient", "pressure", "viscous nested", "heat nested", "mass", "momentum",
                                 "energy")}
#: operator -> label
FRICTIONS = {"friction, zeta 0": r"$\zeta = 0$",
             "friction, eta(T), foretold": r"$\eta(T)$, with what it lacks",
             "friction, zeta 0.01": r"$\zeta = \eta/2$", "friction, eta(T)": r"$\eta(T)$"}
SHARES = {"gradient": "gradient / $k$", "nested": "nested Laplacian / $k^2$",
          "pairwise": "pairwise Laplacian / $k^2$"}
COEFFICIENTS = ("viscosity", "bulk viscosity", "conductivity", "sound speed")
#: curves of the coefficients: transport, maker, points; all with Lucy's weight, h = 3 a, zeta = 0.2
CURVES = (("nested", "renormalised", "lattice"), ("pairwise", "renormalised", "lattice"),
          ("nested", "exact", "jittered-0.3"), ("pairwise", "exact", "jittered-0.3"),
          ("nested", "delaunay", "jittered-0.3"), ("pairwise", "delaunay", "jittered-0.3"))
#: points between plates -> title
WALLED = {"lattice": "lattice, images behind the plates", "jittered-0.2": "shifted by up to $0.2a$, images",
          "jittered-0.2, plates": "shifted by up to $0.2a$, rows on the plates"}
#: flow -> what U is
FLOWS = {"couette": "Couette flow, $U$: of the upper plate",
         "poiseuille": "Poiseuille flow, $U$: at last, in the middle"}


def logarithmic(axes: Axes, ticks: Iterable[float]) -> None:
    """Both scales."""
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(list(ticks), labels=[f"{tick:g}" for tick in ticks])
    axes.minorticks_off()


def symbols(rows: pd.DataFrame) -> Figure | None:
    """Share of the gradient and of the Laplacian that weights leave of a wave, 2D lattice."""
    rows = rows[rows["d"] == 2]
    if rows.empty:
        return None
    page, panels = figure(1, 3, width=3.6, height=3.8, sharey=True)
    for number, (kind, group) in enumerate(rows.groupby("weight")):
        x, style = group["k"].to_numpy()/np.pi, {**look(number), "marker": ""}
        for axes, column in zip(panels, SHARES, strict=True):
            axes.plot(x, group[column], **style, label=f"{kind}, {group['r0'].iloc[0]:g} $a$")
        panels[0].plot(x, group["smoothed"], **{**style, "linewidth": 2.5, "alpha": 0.25})
    for axes, title in zip(panels, SHARES.values(), strict=True):
        axes.set(title=title, xlabel=r"$k a/\pi$", ylim=(-0.1, 1.05))
    panels[0].set_ylabel("share left of a wave of wave number $k$")
    page.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4,
                title=r"weights with their ranges; broad and pale: $\hat f(k)$ of the same weight, "
                      "without a lattice",
                title_fontsize=8)
    page.suptitle("What weights leave of a wave along an axis; nested transport is blind to the shortest",
                  fontsize=10)
    return page


def convergence(equations: pd.DataFrame, lattice: pd.DataFrame) -> Figure | None:
    """Errors of the terms over the spacing, of forces along edges, and of the exponential weight's first moment."""
    equations = equations[(equations["d"] == 2) & (equations["h"] == 3.0)]
    if equations.empty:
        return None
    page, (left, middle, right) = figure(1, 3, width=3.8, height=4.4)
    for axes, names, title in ((left, TERMS, "terms as printed (trace $2/d$), $h = 3a$"),
                               (middle, FRICTIONS, "friction along edges [Eq. 51], $h = 3a$")):
        for number, (name, label) in enumerate(names.items()):
            group = equations[equations["operator"] == name].sort_values("cells")
            axes.plot(group["cells"], group["error"], **look(number), label=label)
        second_order(axes, equations["cells"], equations["error"].min())
        axes.set(title=title, xlabel=r"spacings in a wave, $\lambda/a$")
    exponential(right, lattice[(lattice["weight"] == "Exponential") & (lattice["how"] == "plain")])
    for axes in (left, middle, right):
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.16))
    left.set_ylabel("relative rms error, 2D lattice")
    return page


def exponential(axes: Axes, lattice: pd.DataFrame) -> None:
    """First moment that the exponential weight loses over the spacing, dotted as predicted."""
    for d, group in lattice.groupby("d"):
        x, style = 1/group["r0"].to_numpy(float), look(int(str(d)) - 1)
        axes.plot(x, (group["value"]/group["d"] - 1).abs(), **{**style, "linestyle": "none"}, label=f"{d}D")
        axes.plot(x, (group["predicted"]/group["d"] - 1).abs(), color=style["color"], linestyle=":",
                  marker="")
    axes.set(xscale="log", yscale="log", title="exponential weight [Eq. 31], dotted: foretold",
             xlabel="$a/r_0$",
             ylabel="first moment lost")
    axes.set_xticks([1/16, 1/8, 1/4, 1/2, 1], labels=["1/16", "1/8", "1/4", "1/2", "1"])
    axes.minorticks_off()


def second_order(axes: Axes, cells: pd.Series, least: float) -> None:
    """Logarithmic axes and a line of slope -2."""
    x = np.array([cells.min(), cells.max()], float)
    axes.plot(x, 0.5*least*(x.max()/x)**2, color="grey", linestyle=":", marker="", label=r"$(a/\lambda)^2$")
    logarithmic(axes, sorted(set(cells)))


def growth(means: pd.DataFrame) -> Figure | None:
    """Growth rates of sound at rest by maker of edges and kind of points."""
    means = means[means["d"] == 2]
    if means.empty:
        return None
    viscosities = sorted(set(means["viscosity"]))
    page, panels = figure(1, len(viscosities), width=4.2, height=4.0, sharey=True, squeeze=False)
    for axes, eta in zip(panels[0], viscosities, strict=True):
        for number, maker in enumerate(MAKERS):
            rows = means[(means["maker"] == maker) & (means["viscosity"] == eta)].set_index("points")
            rows = rows.loc[[kind for kind in KINDS if kind in rows.index]]
            rates = rows["rate"].clip(lower=FLOOR)
            places = [KINDS.index(kind) + 0.1*(number - 2.5) for kind in rows.index]
            errorbar(axes, places, rates.tolist(), np.minimum(rows["rate_err"], 0.9*rates).tolist(),
                     number=number, label=maker)
        axes.axhspan(FLOOR/3, 1e-13, color="grey", alpha=0.15)
        axes.set(yscale="log", ylim=(FLOOR/3, 20), title=rf"$\eta$ = {eta:g} $\rho c a$")
        axes.set_xticks(range(len(KINDS)), labels=KINDS, rotation=30)
    panels[0, 0].set_ylabel("largest growth rate, $c/a$; grey: round-off")
    page.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(MAKERS))
    page.suptitle("Sound on fixed points at rest: edges that close do not let it grow", fontsize=10)
    return page


def euler(rows: pd.DataFrame) -> Figure:
    """Largest stable step of forward Euler over the prediction, by wave number."""
    rows = rows[np.isfinite(rows["limit"])].assign(ratio=rows["limit"]/rows["predicted"])
    page, axes = figure(1, 1, width=5.4, height=3.8)
    for number, (transport, group) in enumerate(rows.groupby("transport")):
        fluids = group.pivot_table(index="k", columns=["eta", "zeta", "kappa"], values="ratio").sort_index()
        first = fluids.iloc[:, 0]
        scatter = fluids.div(first, axis=0).sub(1).abs()[first < TOP].max().max()
        words = f", {fluids.shape[1]} fluids, within {100*scatter:.1g} %" if fluids.shape[1] > 1 else ""
        axes.plot(fluids.index/np.pi, first, **look(number), label=f"{transport}{words}")
    axes.set(yscale="log", ylim=(0.7, TOP), xlabel=r"wave number $k a/\pi$",
             ylabel=r"largest step over $(\eta + \zeta + \kappa/2)/\rho c^2$",
             title="Forward Euler [Eq. 40]: up to which step is sound stable?\n2D gas, $h = 3a$")
    below(axes, bbox_to_anchor=(0.5, -0.16), title=fluids_of(rows), title_fontsize=8)
    return page


def fluids_of(rows: pd.DataFrame) -> str:
    """The viscosities and conductivities that were taken."""
    fluids = rows[["eta", "zeta", "kappa"]].drop_duplicates().sort_values(["eta", "zeta", "kappa"])
    words = "; ".join(f"{eta:g}, {zeta:g}, {kappa:g}" for eta, zeta, kappa in fluids.to_numpy())
    return rf"$\eta, \zeta, \kappa$ in $\rho a (k_BT/m)^{{1/2}}$: {words}"


def coefficients(rows: pd.DataFrame) -> Figure:
    """Do waves have the viscosities, the conductivity and the speed of sound of the fluid? Points measured, lines by sums."""
    page, panels = figure(2, 2, width=4.2, height=3.2, sharex=True)
    rows = rows.query("weight == 'Lucy' and h == 3 and zeta > 0 and direction == 'axis'")
    for axes, quantity in zip(panels.ravel(), COEFFICIENTS, strict=True):
        series = rows[rows["quantity"] == quantity].groupby(["transport", "maker", "points"])
        for number, curve in enumerate(CURVES):
            if curve in series.groups:
                coefficient(axes, series.get_group(curve).sort_values("wavelength"), number)
        axes.plot([8, 64], [0.3, 0.3/64], color="grey", linestyle=":", marker="", label=r"$\lambda^{-2}$")
        axes.set_title(quantity)
        logarithmic(axes, (8, 16, 32, 64))
    for axes in panels[1]:
        axes.set_xlabel(r"wavelength $\lambda/a$")
    for axes in panels[:, 0]:
        axes.set_ylabel("|measured/fluid's - 1|")
    page.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle("Do waves have the viscosities, the conductivity and the speed of sound of the fluid?\n"
                  r"Lucy's weight, $h = 3a$, $\zeta = 0.2\,\rho a (k_BT/m)^{1/2}$" "\n"
                  "full lines: sums over the lattice; bars: 95 % over sets of points", fontsize=10)
    return page


def coefficient(axes: Axes, group: pd.DataFrame, number: int) -> None:
    """One series: measured, and by the lattice symbol."""
    transport, maker, points = group[["transport", "maker", "points"]].iloc[0]
    where = "lattice" if points == "lattice" else f"shifted by up to $0.3a$, {maker}"
    errorbar(axes, group["wavelength"].tolist(), group["error"].abs().tolist(), group["error_err"].tolist(),
             number=number, label=f"{transport}, {where}")
    symbol = (group["lattice"]/group["continuum"] - 1).abs()
    axes.plot(group["wavelength"], symbol, **{**look(number), "marker": "", "linestyle": "-"})


def shear(rows: pd.DataFrame) -> Figure:
    """Rms errors of shear flows over the rows between the plates: a line of panels a flow, a column a kind of points."""
    kinds, times = [name for name in WALLED if name in set(rows["points"])], sorted(set(rows["time"]))
    page, all_axes = figure(len(FLOWS), len(kinds), width=3.9, height=3.4, sharex=True, sharey=True,
                            squeeze=False)
    for line, flow in zip(all_axes, FLOWS, strict=True):
        for axes, points in zip(line, kinds, strict=True):
            runs = rows[(rows["flow"] == flow) & (rows["points"] == points)].sort_values("rows")
            for time, group in runs.groupby("time"):
                number = times.index(time)
                errorbar(axes, group["rows"].tolist(), group["rms"].tolist(), group["rms_err"].tolist(),
                         number=number,
                         linestyle=look(number)["linestyle"], label=rf"$t = {time:g}\,H^2/\nu$")
            axes.plot([8, 64], [4e-3, 4e-3/64], color="grey", linestyle=":", marker="", label=r"rows$^{-2}$")
            axes.set_title(WALLED[points])
            logarithmic(axes, (8, 16, 32, 64))
        line[0].set_ylabel(f"{FLOWS[flow]}\nrms error of the velocity over $U$", fontsize=9)
    for axes in all_axes[-1]:
        axes.set_xlabel("rows between the plates")
    page.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    page.suptitle("Shear flows that start from rest: do they converge on their exact series?\n"
                  r"$H$: distance of the plates, $\nu$: kinematic viscosity, $t$: time from the start" "\n"
                  "bars: 95 % over sets of points", fontsize=10)
    return page


def nested_growth(frame: pd.DataFrame) -> Figure:
    """Nested viscosity and conduction: does the motionless layer stay at rest? Growth over the share along edges."""
    groups = frame.groupby(["h", "ra"])
    shares = sorted(set(frame["share"]))
    page, (panels,) = figure(1, len(groups), width=3.6, height=4.2, sharey=True, squeeze=False)
    for axes, ((h, ra), group) in zip(panels, groups, strict=True):
        for number, (rows, line) in enumerate(group.groupby("rows")):
            axes.plot(line["share"].map(shares.index), line["growth"], label=f"{rows} rows", **look(number))
        axes.axhline(0, color="black", lw=0.8, linestyle="-", marker="")
        axes.set_yscale("symlog", linthresh=1e-5)
        axes.set_xticks(range(len(shares)), labels=[f"{share:g}" for share in shares], rotation=60)
        axes.set(title=f"range $h = {h:g}a$, Ra = {ra:g}", xlabel="share of transport along edges")
        axes.legend(fontsize=7)
    panels[0].set_ylabel("largest growth rate  [$c/a$]")
    panels[0].set_ylim(-2e-6, 2*frame["growth"].max())
    page.suptitle("Nested viscosity and conduction: does the motionless layer stay at rest?\n"
                  "$a$: spacing of the points, $c$: speed of sound; 0: nothing grows", fontsize=10)
    return page


FIGURES = Drawings(Drawing("symbols", ("symbols",), symbols),
                   Drawing("convergence", ("equations", "lattice"), convergence),
                   Drawing("growth", ("growth_means",), growth), Drawing("euler", ("euler",), euler),
                   Drawing("coefficients", ("coefficients",), coefficients),
                   Drawing("shear", ("shear_means",), shear),
                   Drawing("nested_growth", ("nested_growth",), nested_growth))
