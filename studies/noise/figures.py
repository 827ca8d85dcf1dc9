"""Figures of the study, from its tables."""
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, below, errorbar, figure, look
from studies.kit.table import groups

NAMES = {"TwoStep": "RR98 Eqs 40, 41", "GrootWarren": r"Groot-Warren, $\lambda = 1/2$",
         "GrootWarren65": r"Groot-Warren, $\lambda = 0.65$",
         "VelocityVerlet": "velocity-Verlet, friction twice", "Shardlow": "Shardlow's splitting",
         "KickDriftFrictionDriftKick": "kick, drift, friction, drift, kick"}
READINGS: dict[str, dict[str, str]] = {"doubled": {}, "single": {"markerfacecolor": "white"}}
FEW = 100           # particles: a mean of ratios, as the configurational kT is, is off by about 1/n


def printed(rows: pd.DataFrame) -> Figure:
    """Variance that printed noise gives waves, over what is due beside the transport of Eqs 37, 38 (T = 0.7).

    Lines are sums over the lattice. Each equation has two readings.
    """
    page, panels = figure(1, 2, width=3.7, height=4.4, sharey=True)
    shown = ((1, 1.5, "a line, nearest neighbours"), (2, 3.0, "square lattice, $h = 3a$"))
    formulas = sorted(set(zip(rows["equation"], rows["term"], strict=True)))
    for axes, (d, h, title) in zip(panels, shown, strict=True):
        some = rows[(rows["d"] == d) & (rows["h"] == h)]
        for name, group in groups(some, ["equation", "term", "reading"]):
            number = formulas.index(name[:2])
            style, k = look(number) | READINGS[name[2]], group["wavenumber"]
            words = r"Eq. {} $\{}$".format(*name) if name[2] == "doubled" else ""
            more = {"linestyle": "none", "markersize": 7.5 - number}      # some lie on each other
            axes.plot(k, group["ratio"], **style | more, label=words)
            axes.plot(k, group["predicted"], color=style["color"], marker="", lw=0.8)
        axes.axhline(1, color="black", lw=1)
        axes.set(yscale="log", title=title, xlabel="$ka$")
    panels[0].set_ylabel("variance of the noise / $2kT\\Gamma$")
    page.legend(*panels[1].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("No printed noise fits the transport of Eqs 37, 38 at all wavelengths ($T = 0.7$)\n"
                  r"filled: bracket read as $\pi_{ij} + \pi_{ji}$; open: as $\pi_{ij}$; lines: lattice sums",
                  fontsize=10)
    return page


def onset(rows: pd.DataFrame) -> Figure:
    """Growth of fluctuations of the vertical velocity on the way to convection, by Lyapunov solves."""
    page, axes = figure(width=5.2, height=3.4)
    for number, (n, group) in enumerate(rows.groupby("rows")):
        axes.plot(group["below"], group["velocity"] - 1, **look(number), label=f"{n:.0f} rows")
    axes.set(xscale="log", yscale="log", xlabel="$1 - Ra/Ra_c$", title="layer heated from below",
             ylabel=r"$\langle ww\rangle$/equilibrium $- 1$")
    axes.legend()
    return page


def steps(rows: pd.DataFrame) -> Figure:
    """Largest error of a variance over the step, for each integrator, waves of 63 spacings."""
    page, axes = figure(width=5.2, height=4.6)
    some = rows[rows["wavenumber"] == rows["wavenumber"].median()]
    for number, ((integrator, fluid), group) in enumerate(some.groupby(["integrator", "fluid"])):
        axes.plot(group["dt"], group["error"], **look(number), label=f"{integrator}, {fluid}")
    axes.set(xscale="log", yscale="log", xlabel=r"$c^2\Delta t/\nu$", ylabel="largest error of a variance")
    below(axes, ncols=2, fontsize=7)
    return page


def modes(rows: pd.DataFrame) -> Figure:
    """Variance of each plane wave of a gas at rest on jittered points over its exact value."""
    titles = {name: [name] for name in ("rho", "u", "v", "T")}
    return of_waves(rows, titles, "Plane waves of a gas at rest, jittered points, Delaunay edges")


def cubes(rows: pd.DataFrame) -> Figure:
    """The same in 3D, on a lattice and on jittered points; velocities along and across the wave vector."""
    titles = {r"$\rho$": ["rho"], "velocity along $k$": ["along"],
              "velocity across $k$": ["across", "across 2"], "$T$": ["T"]}
    return of_waves(rows, titles, "Plane waves of a gas at rest in 3D")


def of_waves(rows: pd.DataFrame, titles: dict[str, list[str]], what: str) -> Figure:
    """A panel a title with the waves of some fields."""
    page, panels = figure(1, len(titles), width=2.6, height=3.0, sharey=True)
    for axes, (title, fields) in zip(panels, titles.items(), strict=True):
        some = rows[rows["field"].isin(fields)]
        for number, (points, group) in enumerate(some.groupby("points")):
            k = group["wavenumber"] + 0.03*number
            errorbar(axes, k, group["ratio"], group["ratio_err"], number=number, label=str(points))
        axes.axhline(1, color="black", lw=1)
        axes.set(title=title, xlabel="$ka$")
    panels[0].set_ylabel("variance / exact")
    if rows["points"].nunique() > 1:
        panels[-1].legend()
    page.suptitle(f"{what}; bars: 95 %, 20 batches", fontsize=10)
    return page


def temperature(states: pd.DataFrame) -> Figure:
    """Error of kT of dissipative particles over the step: of velocities (left) and of positions (right).

    Grey: within 1 %.
    """
    page, axes = figure(1, 2, width=4.6, height=4.2, sharey=True)
    some = states[states["n"] > FEW].sort_values("time")
    longest = some.drop_duplicates(["integrator", "dt"], keep="last").sort_values("dt")
    for panel, name in zip(axes, ("kinetic", "configurational"), strict=True):
        temperatures(panel, longest, name)
    axes[0].set_ylabel("error of $kT$ in %")
    below(axes[0], ncol=2)
    page.suptitle(r"Dissipative particles, $a = 25$, $\rho = 3$", fontsize=10)
    return page


def temperatures(axes: Axes, states: pd.DataFrame, name: str) -> None:
    """A series an integrator."""
    for number, (integrator, label) in enumerate(NAMES.items()):
        rows = states[states["integrator"] == integrator]
        error, err = 100*(rows[name] - 1), 100*rows[f"{name}_err"]
        errorbar(axes, rows["dt"], error, err, number=number, label=label, linestyle="-")
    axes.axhspan(-1, 1, color="0.9")
    axes.set(title=f"{name} temperature", xlabel=r"$\Delta t$")
    axes.set_yscale("symlog", linthresh=2)


FIGURES = Drawings(
    Drawing("printed", ("printed",), printed), Drawing("onset", ("onset",), onset),
    Drawing("steps", ("steps",), steps), Drawing("modes", ("modes",), modes),
    Drawing("cubes", ("cubes",), cubes), Drawing("temperature", ("states",), temperature))
