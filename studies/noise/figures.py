"""Figures of the study, from its tables"""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from studies.kit.drawing import Drawing, Drawings
from studies.kit.figure import COLOURS, below, errorbar, figure, look
from studies.noise.derive import FEW

NAMES = {"TwoStep": "RR98 Eqs 40, 41", "GrootWarren": r"Groot-Warren, $\lambda = 1/2$",
         "GrootWarren65": r"Groot-Warren, $\lambda = 0.65$", "VelocityVerlet": "velocity-Verlet, friction "
                                                                               "twice",
         "Shardlow": "Shardlow's splitting", "KickDriftFrictionDriftKick": "kick, drift, friction, drift, "
                                                                           "kick"}


def printed(rows: pd.DataFrame) -> Figure:
    """Variance that printed noise gives waves, over what is due beside the transport of Eqs 37, 38 (T = 0.7).

    Lines are sums over the lattice.
    """
    page, panels = figure(1, 2, sharey=True)
    shown = ((1, 1.5, "a line, nearest neighbours"), (2, 3.0, "square lattice, $h = 3a$"))
    for axes, (d, h, title) in zip(panels, shown, strict=True):
        some = rows[(rows["d"] == d) & (rows["h"] == h)]
        for number, (name, group) in enumerate(some.groupby(["equation", "term", "reading"])):
            label = r"Eq. {} $\{}$, {}".format(*name)
            with_theory(axes, group, ("wavenumber", "ratio", "predicted"), number, label)
        axes.axhline(1, color="black", lw=1)
        axes.set(yscale="log", title=title, xlabel="$ka$")
        axes.legend(ncols=2, fontsize=6)
    panels[0].set_ylabel("variance of the noise / $2kT\\Gamma$")
    page.suptitle("Printed noise beside the transport of Eqs 37, 38, $T = 0.7$; lines: lattice sums",
                  fontsize=10)
    return page


def with_theory(axes: Axes, rows: pd.DataFrame, columns: tuple[str, str, str], number: int,
                label: str) -> None:
    """Points of a series and the line that is predicted."""
    x, measured, predicted = (rows[name] for name in columns)
    axes.plot(x, measured, **{**look(number), "linestyle": "none"}, label=label)
    axes.plot(x, predicted, color=look(number)["color"], marker="", lw=0.8)


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
    page, panels = figure(1, 4, width=2.6, height=3.0, sharey=True)
    for number, (axes, field) in enumerate(zip(panels, ("rho", "u", "v", "T"), strict=True)):
        some = rows[rows["field"] == field]
        errorbar(axes, *columns(some, "wavenumber", "ratio", "ratio_err"), number=number)
        axes.axhline(1, color="black", lw=1)
        axes.set(title=field, xlabel="$ka$")
    panels[0].set_ylabel("variance / exact")
    page.suptitle("Plane waves of a gas at rest, jittered points, Delaunay edges; bars: 95 %, 20 batches",
                  fontsize=10)
    return page


def cubes(rows: pd.DataFrame) -> Figure:
    """The same in 3D, on a lattice and on jittered points; velocities along and across the wave vector."""
    page, panels = figure(1, 4, width=2.6, height=3.0, sharey=True)
    shown = {r"$\rho$": ("rho",), "velocity along $k$": ("along",),
             "velocity across $k$": ("across", "across 2"),
             "$T$": ("T",)}
    for axes, (title, fields) in zip(panels, shown.items(), strict=True):
        some = rows[rows["field"].isin(fields)]
        for number, (points, group) in enumerate(some.groupby("points")):
            k, ratio, err = columns(group, "wavenumber", "ratio", "ratio_err")
            errorbar(axes, [x + 0.03*number for x in k], ratio, err, number=number, label=str(points))
        axes.axhline(1, color="black", lw=1)
        axes.set(title=title, xlabel="$ka$")
    panels[0].set_ylabel("variance / exact")
    panels[-1].legend()
    page.suptitle("Plane waves of a gas at rest in 3D; bars: 95 %, 20 batches", fontsize=10)
    return page


def columns(rows: pd.DataFrame, *names: str) -> list[list[float]]:
    """Numbers of some columns."""
    return [rows[name].tolist() for name in names]


# --- dissipative particles --------------------------------------------------------------------


def temperature(states: pd.DataFrame) -> Figure:
    """Error of kT of dissipative particles over the step: of velocities (left) and of positions (right).

    Grey: within 1 %.
    """
    page, axes = figure(1, 2, width=4.6, height=4.2, sharey=True)
    some = states[(states["a"] == 25) & (states["n"] > FEW)].sort_values("time")
    some = some.drop_duplicates(["integrator", "dt"], keep="last").sort_values("dt")
    for panel, name in zip(axes, ("kinetic", "configurational"), strict=True):
        for number, (integrator, label) in enumerate(NAMES.items()):
            rows = some[some["integrator"] == integrator]
            off, err = (100*(rows[name] - 1)).tolist(), (100*rows[f"{name}_err"]).tolist()
            errorbar(panel, rows["dt"].tolist(), off, err, number=number, label=label, linestyle="-")
        panel.axhspan(-1, 1, color="0.9")
        panel.set(title=f"{name} temperature", xlabel=r"$\Delta t$")
        panel.set_yscale("symlog", linthresh=2)
    axes[0].set_ylabel("error of $kT$ in %")
    below(axes[0], ncol=2)
    page.suptitle(r"Dissipative particles, $a = 25$, $\rho = 3$", fontsize=10)
    return page


def cylinder(flow: pd.DataFrame, drag: pd.DataFrame) -> Figure:
    """Mean stream of dissipative particles past a cylinder of frozen ones, one of a square array.

    The published drag of a smooth cylinder is that of slow flow; inertia adds about 2 % to it here.
    """
    page, axes = figure(width=5.4, height=4.4)
    u, v = (flow.pivot(index="y", columns="x", values=name) for name in ("u", "v"))
    x, y = u.columns.to_numpy(float), u.index.to_numpy(float)
    speed = np.hypot(u.to_numpy(), v.to_numpy())
    shown = axes.pcolormesh(x, y, speed, shading="nearest", vmin=0)
    arrows = {"color": "white", "edgecolor": "black", "linewidth": 0.4, "width": 0.007}
    axes.quiver(x, y, u.to_numpy(), v.to_numpy(), **arrows)
    axes.add_patch(Circle((0, 0), 1.0, fill=False, color=COLOURS[1], linewidth=1.5))
    row = drag.iloc[0]
    axes.set(aspect="equal", xlabel="$x/R$", ylabel="$y/R$",
             title=f"drag {row['ratio']:.2f}({100*row['ratio_err']:.0f}) of that of a smooth cylinder, "
                   f"Re = {row['reynolds']:.1f}")
    axes.grid(visible=False)
    page.colorbar(shown, ax=axes, label="mean speed over that of the stream")
    return page


FIGURES = Drawings(*(Drawing(draw.__name__, names, draw) for draw, names in (
    (printed, ("printed",)), (onset, ("onset",)), (steps, ("steps",)), (modes, ("modes",)),
    (cubes, ("cubes",)), (temperature, ("states",)), (cylinder, ("flow", "drag")))))
