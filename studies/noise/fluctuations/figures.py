"""Figures of the study fluctuations, from its tables."""
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    drawn = {"printed": printed, "onset": onset, "steps": steps, "spectrum": spectrum, "modes": modes, "cubes": cubes}
    return {name: draw(tables) for name, draw in drawn.items() if name in tables}


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


def onset(tables: Tables) -> Figure:
    """Growth on the way to onset."""
    page, axes = figure(width=5.2, height=3.4)
    for number, (n, group) in enumerate(tables["onset"].groupby("rows")):
        axes.plot(group["below"], group["velocity"] - 1, **look(number), label=f"{n:.0f} rows")
    axes.set(xscale="log", yscale="log", xlabel="$1 - Ra/Ra_c$", ylabel=r"$\langle ww\rangle$/equilibrium $- 1$",
             title="layer heated from below")
    axes.legend()
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


def cubes(tables: Tables) -> Figure:
    """The same in 3D; velocities along and across k."""
    rows: pd.DataFrame = tables["cubes"]
    page, panels = figure(1, 4, width=2.6, height=3.0, sharey=True)
    for axes, names in zip(panels, (("rho",), ("along",), ("across", "across 2"), ("T",)), strict=True):
        for number, (points, group) in enumerate(rows[rows["field"].isin(names)].groupby("points")):
            errorbar(axes, (group["wavenumber"] + 0.03*number).tolist(), group["ratio"].tolist(), group["ratio_err"].tolist(),
                     number=number, label=str(points))
        axes.axhline(1, color="black", lw=1)
        axes.set(title={"rho": r"$\rho$", "T": "$T$"}.get(names[0], f"velocity {names[0]} $k$"), xlabel="$ka$")
    panels[0].set_ylabel("variance / exact")
    panels[-1].legend()
    page.suptitle("Plane waves of a gas at rest in 3D; bars: 95 %, 20 batches", fontsize=10)
    return page
