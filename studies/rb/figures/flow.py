"""Views of the flow: particles as arrows, fields as contours    [KHP95, Figs 9, 12]"""
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
#: column, name with unit
CONTOURS = (("rho", r"density  [$m/\sigma^2$]"), ("T", r"temperature  [$\varepsilon/k_B$]"))


def run_of(tables: Tables, name: str, **wanted: Any) -> pd.DataFrame:
    """Rows of the finest run nearest to Ra = 10 000, its first seed."""
    run = finest(nearest(rows(tables, name, **wanted)))
    return run[run.seed == run.seed.min()]


def fig12(tables: Tables) -> Figure | None:
    """5000 particles in convection. Above the particles at one instant, below their smoothed velocities."""
    run = run_of(tables, "particles", **SPAM, **LAYER)
    if run.empty:
        return None
    page, (upper, lower) = figure(2, 1, width=7, height=3.75)
    scale, half, field = arrow_scale(run), half_width(run), smoothed(run)
    arrows(upper, fluid(run), scale)
    arrows(lower, field, scale)
    box(upper, half, f"Particles tremble about the flow: {heading(run)}    [KHP95, Fig. 12]", scale)
    box(lower, half, f"this flow: velocities smoothed, $\\langle v \\rangle$, at {len(field)} places", scale)
    for axes in (upper, lower):
        axes.set_ylim(-0.54, 0.54)
    return page


def fluid(run: pd.DataFrame) -> pd.DataFrame:
    """Particles that move; one in four of many: more arrows are a grey."""
    moving = run[run.kind == "fluid"].sort_values("number")
    return moving.iloc[::4] if len(moving) > MANY else moving


def heading(run: pd.DataFrame) -> str:
    """How many particles at which Ra."""
    number = (run.kind == "fluid").sum()
    return f"{'one in four of ' if number > MANY else ''}{number} particles, Ra = {run['ra'].iloc[0]:g}"


def arrow_scale(run: pd.DataFrame) -> float:
    """Velocity of an arrow as long as L: arrows of the fastest 1 % are longer than two spacings."""
    at = fluid(run)
    spacing = (np.ptp(at.x)*np.ptp(at.y)/len(at))**0.5
    return float(np.quantile(np.hypot(at.vx, at.vy), 0.99)/(2*spacing))


def arrows(axes: Axes, at: pd.DataFrame, scale: float) -> None:
    """Velocities."""
    axes.quiver(at.x, at.y, at.vx, at.vy, angles="xy", scale_units="xy", scale=scale,
                color="black", width=0.0015, headwidth=4, headlength=5, headaxislength=4.5)


def half_width(run: pd.DataFrame) -> float:
    """Half of the aspect ratio, a multiple of 1/2."""
    return float(np.ceil(2*fluid(run)["x"].abs().max() - 1e-9)/2)


def box(axes: Axes, half: float, title: str, scale: float) -> None:
    """Equal scales, plates as lines; how fast an arrow is."""
    for y in (-0.5, 0.5):
        axes.axhline(y, color="0.3", lw=1, marker="", ls="-")
    axes.set(aspect="equal", xlim=(-half, half), ylabel="$y/L$", title=title,
             xlabel=rf"$x/L$;  an arrow of length $L/10$ is {scale/10:.2g} $(\varepsilon/m)^{{1/2}}$")
    axes.grid(False)


def smoothed(run: pd.DataFrame) -> pd.DataFrame:
    """<v> = sum v w/sum w at the places of Fig. 12, or as many as there are particles; Lucy's weight [KHP95,
    Sec. II]

    Particles behind plates and sides are in the sums, as in a run.
    """
    half, spacing = half_width(run), 1/float(run.resolution.iloc[0])
    number = min(PLACES, round(1/spacing))
    across, up = np.arange(round(2*half*number)) + 0.5, np.arange(number) + 0.5
    x, y = (q.ravel() for q in np.meshgrid(across/number - half, up/number - 0.5))
    places, around = cKDTree(np.stack([x, y], axis=1)), cKDTree(run[["x", "y"]].to_numpy(float))
    w = places.sparse_distance_matrix(around, RANGE*spacing, output_type="coo_matrix").tocsr()
    q = w.data/(RANGE*spacing)
    w.data = (1 + 3*q)*(1 - q)**3
    ones = w.sum(axis=1).A1
    return pd.DataFrame({"x": x, "y": y, **{name: w@run[name].to_numpy(float)/ones for name in ("vx", "vy")}})


def fig9(tables: Tables) -> Figure | None:
    """Density (above) and temperature (below) of the steady flow: left the grid, right the mean of the
    particles. Both sides have the same levels.
    """
    runs = {"grid": run_of(tables, "fields", **GRID, **LAYER),
            "spam, mean": run_of(tables, "fields", **SPAM, **LAYER)}
    ras = {ra for run in runs.values() for ra in run.ra.unique()}
    if len(ras) != 1 or any(run.empty for run in runs.values()):
        return None
    page, all_axes = figure(2, 2, width=4.6, height=2.5, sharex=True, sharey=True)
    for line, (column, words) in zip(all_axes, CONTOURS):
        both = pd.concat([run[column] for run in runs.values()])
        levels = MaxNLocator(14).tick_values(both.min(), both.max())
        for axes, (title, run) in zip(line, runs.items()):
            drawn = contours(axes, run, column, levels)
            axes.set(title=f"{title}, {run['resolution'].iloc[0]:.0f} rows", aspect="equal")
        line[0].set_ylabel("$y/L$")
        page.colorbar(drawn, ax=line, label=words, shrink=0.9)
    for axes in all_axes[1]:
        axes.set_xlabel("$x/L$")
    page.suptitle("Particles come near the grid; their density is farthest off at the plates\n"
                  f"same levels, Ra = {ras.pop():g}    [KHP95, Fig. 9]")
    return page


def contours(axes: Axes, run: pd.DataFrame, column: str, levels: Any) -> Any:
    """Filled contours with lines, which remain in grey."""
    field = run.pivot(index="y", columns="x", values=column)
    drawn = axes.contourf(field.columns, field.index, field, levels)
    axes.contour(field.columns, field.index, field, levels, colors="black", linewidths=0.4)
    axes.grid(False)
    return drawn
