"""Figures of the study fluctuations, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    wanted = {"printed": printed, "gradient": flows, "steps": steps, "spectrum": spectrum, "modes": modes}
    needed = {"gradient": ("gradient", "onset")}
    return {name: draw(tables) for name, draw in wanted.items() if set(needed.get(name, (name,))) <= set(tables)}


def printed(tables: Tables) -> Figure:
    """Temperature that printed noise gives waves, over the right one."""
    rows = tables["printed"]
    page, panels = figure(1, 2, sharey=True)
    for axes, d, h, title in ((panels[0], 1, 1.5, "a line, nearest neighbours"), (panels[1], 2, 3.0, "square lattice, $h = 3a$")):
        some = rows[(rows["d"] == d) & (rows["h"] == h)]
        for number, ((equation, term, reading), group) in enumerate(some.groupby(["equation", "term", "reading"])):
            label = rf"Eq. {equation} $\{term}$, {reading}"
            axes.plot(group["wavenumber"], group["ratio"], **{**look(number), "linestyle": "none"}, label=label)
            axes.plot(group["wavenumber"], group["predicted"], color=look(number)["color"], marker="", lw=0.8)
        axes.axhline(1, color="black", lw=1)
        axes.set(yscale="log", title=title, xlabel="$ka$")
        axes.legend(ncols=2, fontsize=6)
    panels[0].set_ylabel("variance of the noise / $2kT\\Gamma$")
    page.suptitle("Printed noise beside the transport of Eqs 37, 38, $T = 0.7$; lines: lattice sums", fontsize=10)
    return page


def flows(tables: Tables) -> Figure:
    """Enhancement under a gradient, and growth on the way to onset."""
    page, (left, right) = figure(1, 2)
    rows = tables["gradient"].sort_values("wavenumber")
    left.plot(rows["wavenumber"], rows["extra"], **{**look(0), "linestyle": "none"}, label="Lyapunov")
    left.plot(rows["wavenumber"], rows["predicted"], color="black", marker="", label="closed form")
    k = rows["wavenumber"].to_numpy()
    high = k > 2*np.pi/rows["period"].iloc[0]           # the gradient of one period looks uniform from there on
    left.plot(k[high], rows["predicted"].iloc[-1]*(k[high]/k[-1])**-4, color="grey", linestyle=":", marker="", label="$k^{-4}$")
    left.set(xscale="log", yscale="log", xlabel="$ka$ across the gradient", ylabel=r"$\langle TT\rangle - 1$ over contrast$^2$",
             title="temperature gradient")
    left.set_xticks([0.05, 0.1, 0.2, 0.4], labels=["0.05", "0.1", "0.2", "0.4"])
    left.minorticks_off()
    left.legend()
    for number, (n, group) in enumerate(tables["onset"].groupby("rows")):
        right.plot(group["below"], group["velocity"] - 1, **look(number), label=f"{n:.0f} rows")
    right.set(xscale="log", yscale="log", xlabel="$1 - Ra/Ra_c$", ylabel=r"$\langle ww\rangle$/equilibrium $- 1$",
              title="layer heated from below")
    right.legend()
    return page


def steps(tables: Tables) -> Figure:
    """Largest error of a variance over the step."""
    rows = tables["steps"]
    page, axes = figure(width=5.2, height=4.6)
    some = rows[rows["wavenumber"] == rows["wavenumber"].median()]
    for number, ((integrator, fluid), group) in enumerate(some.groupby(["integrator", "fluid"])):
        axes.plot(group["dt"], group["error"], **look(number), label=f"{integrator}, {fluid}")
    axes.set(xscale="log", yscale="log", xlabel=r"$c^2\Delta t/\nu$", ylabel="largest error of a variance")
    below(axes, ncols=2, fontsize=7)
    return page


def spectrum(tables: Tables) -> Figure:
    """Dynamic structure factor."""
    rows = tables["spectrum"]
    page, axes = figure(width=5.2, height=3.4)
    for number, (turns, group) in enumerate(rows.groupby("turns")):
        axes.plot(group["omega"], group["measured"], **{**look(number), "linestyle": "none", "markersize": 3},
                  label=f"{turns:.0f} waves on {group['points'].iloc[0]:.0f} points")
        axes.plot(group["omega"], group["predicted"], color=look(number)["color"], marker="", lw=1)
    axes.set(yscale="log", xlabel=r"$\omega$", ylabel=r"$S(k, \omega)/S(k)$",
             title="Rayleigh and Brillouin peaks; lines: lattice symbols")
    axes.legend()
    return page


def modes(tables: Tables) -> Figure:
    """Variance of each mode over its exact value: of the density the static structure factor."""
    rows: pd.DataFrame = tables["modes"]
    page, panels = figure(1, 4, width=2.6, height=3.0, sharey=True)
    for axes, (number, field) in zip(panels, enumerate(("rho", "u", "v", "T")), strict=True):
        some = rows[rows["field"] == field]
        errorbar(axes, some["wavenumber"].tolist(), some["ratio"].tolist(), some["ratio_err"].tolist(), number=number)
        axes.axhline(1, color="black", lw=1)
        axes.set(title=field, xlabel="$ka$")
    panels[0].set_ylabel("variance / exact")
    page.suptitle("Plane waves of a gas at rest, jittered points, Delaunay edges; bars: 95 %, 20 batches", fontsize=10)
    return page
