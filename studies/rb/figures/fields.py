"""Views of the flow: particles as arrows, fields as contours [KHP95, Figs 2, 3, 7, 9, 12]."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from scipy.spatial import cKDTree

from studies.kit.figure import figure
from studies.kit.table import Tables
from studies.rb.looks import GRID, LAYER, SPAM, finest, nearest, rows

PLACES = 30     # over the height: 1800 in all [KHP95, Fig. 12]
MANY = 2000     # particles
RANGE = 3.0     # of Lucy's weight, in spacings
FIXED_ROWS = SPAM | {"variant": "printed-fixed-rows"}
#: column, name with unit
CONTOURS = (("rho", r"density  [$m/\sigma^2$]"), ("T", r"temperature  [$\varepsilon/k_B$]"))
BEHIND = ((FIXED_ROWS, "fixed particles behind the plates    [KHP95, Fig. 2]"),
          (SPAM, "images behind the plates    [KHP95, Fig. 3]"))


# --- particles ------------------------------------------------------------------------------------


def fig2_3(tables: Tables) -> Figure | None:
    """Particles in convection, one instant. Arrows are velocities, open circles what stands behind the plates."""
    panels = [(one_run(tables, "particles", **who, **LAYER), title) for who, title in BEHIND]
    panels = [(run, title) for run, title in panels if len(run)]
    if not panels:
        return None
    page, all_axes = figure(len(panels), 1, width=7, height=4.4, squeeze=False, sharey=True)
    scale = max(arrow_scale(some(fluid(run))) for run, _ in panels)
    for axes, (run, title) in zip(all_axes[:, 0], panels):
        arrows(axes, some(fluid(run)), scale)
        behind_plates(axes, run)
        box(axes, run, f"{heading(run)}: {title}", scale)
    return page


def one_run(tables: Tables, name: str, **wanted: Any) -> pd.DataFrame:
    """Rows of the finest run nearest to Ra = 10 000, its first seed."""
    run = finest(nearest(rows(tables, name, **wanted)))
    return run[run["seed"] == run["seed"].min()]


def fluid(run: pd.DataFrame) -> pd.DataFrame:
    """Particles that move."""
    return run[run["kind"] == "fluid"]


def some(at: pd.DataFrame) -> pd.DataFrame:
    """One particle in four of many: more arrows are a grey."""
    return at.sort_values("number").iloc[::4] if len(at) > MANY else at


def heading(run: pd.DataFrame) -> str:
    """How many particles at which Ra."""
    number = len(fluid(run))
    return f"{'one in four of ' if number > MANY else ''}{number} particles, Ra = {run['ra'].iloc[0]:g}"


def arrow_scale(at: pd.DataFrame) -> float:
    """Velocity of an arrow as long as L: the fastest 1 % of the particles have arrows longer than two spacings."""
    spacing = (np.ptp(at["x"])*np.ptp(at["y"])/len(at))**0.5
    return float(np.quantile(np.hypot(at["vx"], at["vy"]), 0.99)/(2*spacing))


def arrows(axes: Axes, at: pd.DataFrame, scale: float) -> None:
    """Velocities."""
    axes.quiver(at["x"], at["y"], at["vx"], at["vy"], color="black", angles="xy", scale_units="xy", scale=scale,
                width=0.0015, headwidth=4, headlength=5, headaxislength=4.5)


def behind_plates(axes: Axes, run: pd.DataFrame) -> None:
    """Open circles at fixed and image particles; copies of the periodic sides are left out."""
    inside = run["x"].abs() <= half_width(run)
    others = run[(run["kind"] != "fluid") & (run["y"].abs() > 0.5) & inside]
    axes.plot(others["x"], others["y"], "o", markersize=2.2, markerfacecolor="none", markeredgewidth=0.4,
              color="#D55E00")


def half_width(run: pd.DataFrame) -> float:
    """Half of the aspect ratio, a multiple of 1/2."""
    return float(np.ceil(2*fluid(run)["x"].abs().max() - 1e-9)/2) if "kind" in run else 1.0


def box(axes: Axes, run: pd.DataFrame, title: str, scale: float) -> None:
    """Equal scales, plates as lines; how fast an arrow is."""
    for y in (-0.5, 0.5):
        axes.axhline(y, color="0.3", lw=1, marker="", ls="-")
    half = half_width(run)
    axes.set(aspect="equal", xlim=(-half, half), ylabel="$y/L$", title=title,
             xlabel=rf"$x/L$;  an arrow of length $L/10$ is {scale/10:.2g} $(\varepsilon/m)^{{1/2}}$")
    axes.grid(False)


def fig7(tables: Tables) -> Figure | None:
    """512 particles of a van der Waals gas already roll. Above the particles at one instant, below their smoothed velocities."""
    runs = rows(tables, "particles", **SPAM, **LAYER | {"eos": "vdw"})
    run = nearest(runs[runs["resolution"] == runs["resolution"].min()])
    run = run[run["seed"] == run["seed"].min()]
    return two_views(run, "van der Waals gas, at one instant    [KHP95, Fig. 7]")


def fig12(tables: Tables) -> Figure | None:
    """5000 particles in convection. Above the particles at one instant, below their velocities smoothed by the weight."""
    return two_views(one_run(tables, "particles", **SPAM, **LAYER), "at one instant    [KHP95, Fig. 12]")


def two_views(run: pd.DataFrame, title: str) -> Figure | None:
    """Particles above, below them their velocities of the same instant smoothed by the weight, in the same scale."""
    if run.empty:
        return None
    field = smoothed(run)
    page, (upper, lower) = figure(2, 1, width=7, height=3.75)
    scale = arrow_scale(some(fluid(run)))
    arrows(upper, some(fluid(run)), scale)
    box(upper, run, f"{heading(run)}, {title}", scale)
    arrows(lower, field, scale)
    box(lower, field, f"the same instant, smoothed: $\\langle v \\rangle$ at {len(field)} places", scale)
    for axes in (upper, lower):
        axes.set_ylim(-0.54, 0.54)
    return page


def smoothed(run: pd.DataFrame) -> pd.DataFrame:
    """<v> = sum v w/sum w at the places of Fig. 12, or at as many as there are particles; Lucy's weight    [KHP95, Sec. II]

    Particles behind plates and sides are in the sums, as in a run.
    """
    half, spacing = half_width(run), 1/float(run["resolution"].iloc[0])
    number = min(PLACES, round(1/spacing))
    across, up = np.arange(round(2*half*number)) + 0.5, np.arange(number) + 0.5
    x, y = (q.ravel() for q in np.meshgrid(across/number - half, up/number - 0.5))
    places, around = cKDTree(np.stack([x, y], axis=1)), cKDTree(run[["x", "y"]].to_numpy(float))
    near = places.sparse_distance_matrix(around, RANGE*spacing, output_type="ndarray")
    q = near["v"]/(RANGE*spacing)
    w = (1 + 3*q)*(1 - q)**3
    ones = np.bincount(near["i"], w, len(x))
    vx, vy = (np.bincount(near["i"], w*run[name].to_numpy(float)[near["j"]], len(x)) for name in ("vx", "vy"))
    return pd.DataFrame({"x": x, "y": y, "vx": vx/ones, "vy": vy/ones})


# --- fields ---------------------------------------------------------------------------------------


def fig9(tables: Tables) -> Figure | None:
    """Density (above) and temperature (below) of the steady flow: left the grid, right the mean of the particles. Both
    sides have the same levels.
    """
    runs = {"grid": one_run(tables, "fields", **GRID, **LAYER),
            "particles, mean": one_run(tables, "fields", **SPAM, **LAYER)}
    runs = {title: run for title, run in runs.items() if len(run)}
    ras = {run["ra"].iloc[0] for run in runs.values()}
    if len(ras) != 1:
        return None
    page, all_axes = figure(2, len(runs), width=4.6, height=2.5, squeeze=False, sharex=True, sharey=True)
    for line, (column, label) in zip(all_axes, CONTOURS):
        levels = common_levels([run[column] for run in runs.values()])
        for axes, (title, run) in zip(line, runs.items()):
            drawn = contours(axes, run, column, levels)
            axes.set_title(f"{title}, {run['resolution'].iloc[0]:.0f} rows")
        page.colorbar(drawn, ax=line, label=label, shrink=0.9)
    for axes in all_axes[-1]:
        axes.set_xlabel("$x/L$")
        axes.locator_params(axis="x", nbins=5)
    for axes in all_axes[:, 0]:
        axes.set_ylabel("$y/L$")
    page.suptitle(f"Density and temperature, Ra = {ras.pop():g}, same levels    [KHP95, Fig. 9]", fontsize=10)
    return page


def common_levels(columns: list[pd.Series]) -> np.ndarray:
    """About a dozen round levels over the range of both."""
    low, high = min(c.min() for c in columns), max(c.max() for c in columns)
    return np.asarray(MaxNLocator(14).tick_values(low, high))


def contours(axes: Axes, run: pd.DataFrame, column: str, levels: np.ndarray) -> Any:
    """Filled contours with lines, which remain in grey."""
    field = run.pivot(index="y", columns="x", values=column)
    x, y, values = field.columns.to_numpy(float), field.index.to_numpy(float), field.to_numpy(float)
    drawn = axes.contourf(x, y, values, levels)
    axes.contour(x, y, values, levels, colors="black", linewidths=0.4)
    axes.set(aspect="equal")
    axes.grid(False)
    return drawn
