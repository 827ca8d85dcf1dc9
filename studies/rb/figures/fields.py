"""Views of the flow: particles as arrows, fields as contours, profiles [KHP95, Figs 2, 3, 7, 9, 12]."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from scipy.spatial import cKDTree

from continuum.published import published
from studies.kit.figure import figure
from studies.kit.table import Tables
from studies.rb.looks import GRID, KIND, LAYER, SPAM, finest, nearest, rows

PLACES = 30     # over the height: 1800 in all [KHP95, Fig. 12]
MANY = 2000     # particles
RANGE = 3.0     # of Lucy's weight, in spacings
FIXED_ROWS = SPAM | {"variant": "printed-fixed-rows"}
#: column, name with unit, what to see
CONTOURS = (("rho", r"density  [$m/\sigma^2$]"), ("T", r"temperature  [$\varepsilon/k_B$]"))


def fig2_3(tables: Tables) -> Figure | None:
    """Arrows of particles, what is behind the walls as open circles."""
    panels = [(one_run(tables, "particles", **who, **LAYER), title) for who, title in
              ((FIXED_ROWS, "fixed particles behind the plates    [KHP95, Fig. 2]"),
               (SPAM, "images behind the plates    [KHP95, Fig. 3]"))]
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
    half = half_width(run)
    others = run[(run["kind"] != "fluid") & (run["y"].abs() > 0.5) & (run["x"].abs() <= half)]
    axes.plot(others["x"], others["y"], "o", markersize=2.2, markerfacecolor="none", markeredgewidth=0.4,
              color="#D55E00")


def half_width(run: pd.DataFrame) -> float:
    """Half of the aspect ratio, a multiple of 1/2."""
    return float(np.ceil(2*run.loc[run["kind"] == "fluid", "x"].abs().max() - 1e-9)/2) if "kind" in run else 1.0


def box(axes: Axes, run: pd.DataFrame, title: str, scale: float) -> None:
    """Equal scales, plates as lines; how fast an arrow is."""
    for y in (-0.5, 0.5):
        axes.axhline(y, color="0.3", lw=1, marker="", ls="-")
    half = half_width(run)
    axes.set(aspect="equal", xlim=(-half, half), ylabel="$y/L$", title=title,
             xlabel=rf"$x/L$;  an arrow of length $L/10$ is {scale/10:.2g} $(\varepsilon/m)^{{1/2}}$")
    axes.grid(False)


def fig7(tables: Tables) -> Figure | None:
    """Few van der Waals particles already roll."""
    run = coarsest(rows(tables, "particles", **SPAM, **LAYER | {"eos": "vdw"}))
    return two_views(run, "van der Waals gas, at one instant    [KHP95, Fig. 7]")


def coarsest(runs: pd.DataFrame) -> pd.DataFrame:
    """Rows of the run with the fewest particles nearest to Ra = 10 000, its first seed."""
    run = nearest(runs[runs["resolution"] == runs["resolution"].min()])
    return run[run["seed"] == run["seed"].min()]


def fig12(tables: Tables) -> Figure | None:
    """The same instant as particles and as a smoothed field."""
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
    rows = min(PLACES, round(1/spacing))
    columns = round(2*half*rows)
    x, y = (q.ravel() for q in np.meshgrid((np.arange(columns) + 0.5)/rows - half, (np.arange(rows) + 0.5)/rows - 0.5))
    at, around = (cKDTree(np.stack(points, axis=1)) for points in ((x, y), (run["x"], run["y"])))
    near = at.sparse_distance_matrix(around, RANGE*spacing, output_type="ndarray")
    q = near["v"]/(RANGE*spacing)
    w = (1 + 3*q)*(1 - q)**3
    vx, vy, ones = (np.bincount(near["i"], w*v[near["j"]], len(x))
                    for v in (run["vx"].to_numpy(float), run["vy"].to_numpy(float), np.ones(len(run))))
    return pd.DataFrame({"x": x, "y": y, "vx": vx/ones, "vy": vy/ones})


def fig9(tables: Tables) -> Figure | None:
    """Density (upper) and temperature (lower), grid (left) and particles (right), same levels."""
    spam = one_run(tables, "fields", **SPAM, **LAYER)
    cells = one_run(tables, "fields", **GRID, **LAYER)
    sides = [(run, title) for run, title in ((cells, "grid"), (spam, "particles, mean")) if len(run)]
    if not sides or len({run["ra"].iloc[0] for run, _ in sides}) > 1:
        return None
    page, all_axes = figure(2, len(sides), width=4.6, height=2.5, squeeze=False, sharex=True, sharey=True)
    for line, (column, label) in zip(all_axes, CONTOURS):
        levels = common_levels([run[column] for run, _ in sides])
        for axes, (run, title) in zip(line, sides):
            drawn = contours(axes, run, column, levels)
            axes.set_title(f"{title}, {run['resolution'].iloc[0]:.0f} rows")
        page.colorbar(drawn, ax=line, label=label, shrink=0.9)
    for axes in all_axes[-1]:
        axes.set_xlabel("$x/L$")
        axes.locator_params(axis="x", nbins=5)
    for axes in all_axes[:, 0]:
        axes.set_ylabel("$y/L$")
    ra = sides[0][0]["ra"].iloc[0]
    page.suptitle(f"Density and temperature, Ra = {ra:g}, same levels    [KHP95, Fig. 9]", fontsize=10)
    return page


def common_levels(columns: list[pd.Series]) -> np.ndarray:
    """About a dozen round levels over the range of both."""
    return np.asarray(MaxNLocator(14).tick_values(min(c.min() for c in columns), max(c.max() for c in columns)))


def on_grid(run: pd.DataFrame, column: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x, y and a field (y, x) from rows."""
    field = run.pivot(index="y", columns="x", values=column)
    return field.columns.to_numpy(float), field.index.to_numpy(float), field.to_numpy(float)


def contours(axes: Axes, run: pd.DataFrame, column: str, levels: np.ndarray) -> Any:
    """Filled contours with lines, which remain in grey."""
    x, y, field = on_grid(run, column)
    drawn = axes.contourf(x, y, field, levels)
    axes.contour(x, y, field, levels, colors="black", linewidths=0.4)
    axes.set(aspect="equal")
    axes.grid(False)
    return drawn


def profiles(tables: Tables) -> Figure | None:
    """Horizontal means of temperature and density over the height."""
    spam, cells = one_run(tables, "fields", **SPAM, **LAYER), one_run(tables, "fields", **GRID, **LAYER)
    if spam.empty and cells.empty:
        return None
    page, both = figure(1, 2, width=4, height=4.2, sharey=True)
    for axes, (column, label) in zip(both, reversed(CONTOURS)):
        for kind, run, name in (("grid", cells, "compressible grid"), ("kp", spam, "particles")):
            if len(run):
                mean = run.groupby("y")[column].mean()
                axes.plot(mean, mean.index, label=f"{name}, {run['resolution'].iloc[0]:.0f} rows",
                          **KIND[kind] | {"markersize": 3.5})
        axes.set_xlabel(f"horizontal mean {label}")
    hot, cold = (published(f"khp95-temperature-{plate}").value for plate in ("hot", "cold"))
    both[0].plot([hot, cold], [-0.5, 0.5], color="0.6", marker="", ls=":", label="conduction")
    both[1].axvline(1, color="0.6", marker="", ls=":")
    both[0].set(ylabel="$y/L$", ylim=(-0.5, 0.5))
    both[0].legend()
    page.suptitle(f"Layers at the plates, Ra = {max([*spam['ra'], *cells['ra']]):g}: grid and particles", fontsize=10)
    return page
