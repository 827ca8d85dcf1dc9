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
from studies.rb.looks import GRID, LAYER, SPAM, finest, rows

RA = 1e4
PLACES = 30     # over the height: 1800 in all [KHP95, Fig. 12]
MANY = 2000     # particles: of more, one in four is drawn, as more arrows are a grey
RANGE = 3.0     # of Lucy's weight, in spacings
#: column, name with unit
CONTOURS = (("rho", r"density  [$m/\sigma^2$]"), ("T", r"temperature  [$\varepsilon/k_B$]"))


def run_of(tables: Tables, name: str, method: dict[str, str]) -> pd.DataFrame:
    """Rows of the finest run of a method at Ra 10 000, its first seed."""
    run = finest(rows(tables, name, **method, **LAYER, ra=RA))
    return run[run.seed == run.seed.min()]


def fig12(tables: Tables) -> Figure | None:
    """5000 particles in convection. Above the particles at one instant, below their smoothed velocities."""
    run = run_of(tables, "particles", SPAM)
    if run.empty:
        return None
    fluid = run[run.kind == "fluid"].sort_values("number")
    shown, words = fluid, f"{len(fluid)} particles, Ra = {RA:g}"
    if len(fluid) > MANY:
        shown, words = fluid.iloc[::4], f"one in four of {words}"
    scale, field = arrow_scale(shown), smoothed(run)
    page, (upper, lower) = figure(2, 1, width=7, height=3.75)
    arrows(upper, shown, scale, f"Particles tremble about the flow: {words}    [KHP95, Fig. 12]")
    arrows(lower, field, scale,
           f"this flow: velocities smoothed, $\\langle v \\rangle$, at {len(field)} places")
    return page


def arrow_scale(at: pd.DataFrame) -> float:
    """Velocity of an arrow as long as L: arrows of the fastest 1 % are longer than two spacings."""
    spacing = (np.ptp(at.x)*np.ptp(at.y)/len(at))**0.5
    return float(np.quantile(np.hypot(at.vx, at.vy), 0.99)/(2*spacing))


def arrows(axes: Axes, at: pd.DataFrame, scale: float, title: str) -> None:
    """Velocities between the plates, which are lines; how fast an arrow is."""
    axes.quiver(at.x, at.y, at.vx, at.vy, angles="xy", scale_units="xy", scale=scale,
                color="black", width=0.0015, headwidth=4, headlength=5, headaxislength=4.5)
    for y in (-0.5, 0.5):
        axes.axhline(y, color="0.3", lw=1, marker="", ls="-")
    axes.set(aspect="equal", xlim=(-1, 1), ylim=(-0.54, 0.54), ylabel="$y/L$", title=title,
             xlabel=rf"$x/L$;  an arrow of length $L/10$ is {scale/10:.2g} $(\varepsilon/m)^{{1/2}}$")
    axes.grid(False)


def smoothed(run: pd.DataFrame) -> pd.DataFrame:
    """<v> = sum v w/sum w at the places of Fig. 12, or as many as there are particles    [KHP95, Sec. II]

    Of Lucy's weight. Particles behind plates and sides are in the sums, as in a run.
    """
    spacing = 1/float(run.resolution.iloc[0])
    number = min(PLACES, round(1/spacing))
    x, y = (q.ravel() for q in np.meshgrid((np.arange(2*number) + 0.5)/number - 1,
                                           (np.arange(number) + 0.5)/number - 0.5))
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
    runs = {"grid": run_of(tables, "fields", GRID), "spam, mean": run_of(tables, "fields", SPAM)}
    if any(run.empty for run in runs.values()):
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
                  f"same levels, Ra = {RA:g}    [KHP95, Fig. 9]")
    return page


def contours(axes: Axes, run: pd.DataFrame, column: str, levels: Any) -> Any:
    """Filled contours with lines, which remain in grey."""
    field = run.pivot(index="y", columns="x", values=column)
    drawn = axes.contourf(field.columns, field.index, field, levels)
    axes.contour(field.columns, field.index, field, levels, colors="black", linewidths=0.4)
    axes.grid(False)
    return drawn
