"""Figures of the study fluctuations, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    wanted = {"printed": printed, "gradient": flows, "steps": steps, "spectrum": spectrum, "modes": modes, "cubes": cubes,
              "shear": shear, "tail": tail}
    needed = {"gradient": ("gradient", "onset"), "shear": ("shear", "flows"), "tail": ("tail", "tail_sampled")}
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


def shear(tables: Tables) -> Figure:
    """Enhancement along a shear flow by Lyapunov solves, and samples about given flows mode by mode."""
    page, (left, right) = figure(1, 2)
    for number, (_, rows) in enumerate(tables["shear"].sort_values("wavenumber").groupby("U")):
        U, k = rows["U"].iloc[0], rows["wavenumber"].to_numpy()
        left.plot(k, rows["extra"]/U**2, **{**look(number), "linestyle": "none"}, label=f"$U = {U:g}$")
        left.plot(k, rows["vortical"]/U**2, color=look(number)["color"], marker="", lw=0.8)
        if number == 0:
            left.plot(k, rows["second"].iloc[-1]/U**2*(k/k[-1])**-4, color="grey", linestyle=":", marker="", label="$k^{-4}$")
    left.set(xscale="log", yscale="log", xlabel="$ka$ along the flow", ylabel=r"$(\langle v_yv_y\rangle - 1)/U^2$",
             title=r"$u = U\,\sin(qy)$; lines: incompressible")
    left.set_xticks([0.1, 0.2, 0.4], labels=["0.1", "0.2", "0.4"])
    left.minorticks_off()
    left.legend()
    for number, (flow, rows) in enumerate(tables["flows"].groupby("flow")):
        found, err = (rows[name]*rows["exact"] for name in ("ratio", "ratio_err"))
        errorbar(right, rows["exact"].tolist(), found.tolist(), err.tolist(), number=number,
                 label={"Shear": "shear flow", "Stream": "uniform stream"}[str(flow)])
    ends = [tables["flows"]["exact"].min(), tables["flows"]["exact"].max()]
    right.plot(ends, ends, color="black", marker="", lw=1)
    right.set(xlabel="variance over equilibrium, Lyapunov", ylabel="sampled, full equations", title="waves on jittered points")
    right.legend()
    return page


def tail(tables: Tables) -> Figure:
    """Velocity autocorrelation of a point, exact and sampled."""
    page, (left, right) = figure(1, 2)
    for number, (_, rows) in enumerate(tables["tail"].groupby("share")):
        for fill, side in (("full", rows["side"].max()), ("none", rows["side"].min())):
            some = rows[(rows["side"] == side) & (rows["correlation"] > 1e-6)].sort_values("nu_t")
            if some.empty:
                continue
            share = some["share"].iloc[0]
            left.plot(some["nu_t"], some["correlation"], **look(number), fillstyle=fill,
                      label=f"{100*share:.0f} % along edges, {side:.0f}$^2$ points")
    t = np.array([3.0, 100.0])
    for factor, style in ((1, "-"), (4, ":")):
        left.plot(t, factor/(8*np.pi*t), color="black", linestyle=style, marker="", lw=0.8,
                  label=rf"${factor}/(8\pi\nu t)$")
    left.set(xscale="log", yscale="log", xlabel=r"$\nu t/a^2$", ylabel=r"$\langle v(0)\,v(t)\rangle\rho/kT$", title="exact")
    below(left, ncols=2, fontsize=7, bbox_to_anchor=(0.5, -0.2))
    for number, (_, rows) in enumerate(tables["tail_sampled"].query("lag > 0").sort_values("lag").groupby("share")):
        errorbar(right, rows["lag"].tolist(), rows["measured"].tolist(), rows["measured_err"].tolist(), number=number,
                 label=f"{100*rows['share'].iloc[0]:.0f} % along edges")
        right.plot(rows["lag"], rows["exact"], color=look(number)["color"], marker="", lw=0.8)
    right.axhline(3/tables["tail_sampled"]["side"].max()**2, color="black", linestyle=":", marker="", lw=0.8, label="null modes")
    right.set(xscale="log", xlabel="$t$", title="sampled; bars: 95 %; lines: exact")
    right.legend()
    return page
