"""Temperature and velocities of a solution on the left, its history on the right."""
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation

from studies.kit.figure import figure, save

ARROWS = 11         # over the height


def picture(solution: Any, path: str | Path | None = None) -> Figure:
    """The figure, and its PNG if a path is given."""
    many = len(solution.history) > 1
    page, axes = figure(1, 1 + many, width=5.2, height=3.4, squeeze=False)
    flow(axes[0, 0], solution)
    if many:
        past(axes[0, 1], solution)
    page.suptitle(str(solution), fontsize=9)
    if path is not None:
        save(page, Path(path))
    return page


def flow(axes: Axes, solution: Any, title: str = "") -> None:
    """Colours: temperature; arrows: velocity; small dots: the points."""
    at, scene = solution.places, solution.scene
    L, shown = scene.L, "T" if np.ptp(solution.places["T"]) > 1e-3*abs(solution.places["T"].mean()) else "rho"
    mesh = Triangulation(at["x"]/L, at["y"]/L)
    colours = axes.tripcolor(mesh, at[shown], shading="gouraud", cmap="cividis")
    axes.figure.colorbar(colours, ax=axes, label={"T": "temperature", "rho": "density"}[shown], shrink=0.8)
    x, y = (np.arange(-size/L/2 + 0.5/ARROWS, size/L/2, 1/ARROWS) for size in (scene.width, L))
    X, Y = np.meshgrid(x, y)
    vx, vy = (LinearTriInterpolator(mesh, at[name])(X, Y) for name in ("vx", "vy"))
    axes.quiver(X, Y, vx, vy, color="white", edgecolor="black", linewidth=0.3, pivot="mid",
                width=0.006)
    axes.set(aspect="equal", xlabel="x/L", ylabel="y/L", title=title)
    axes.grid(False)


def past(axes: Axes, solution: Any) -> None:
    """K against time, and Nu where heat passes."""
    history = solution.history
    axes.plot(history["t"], history["K"], marker="", label="K")
    axes.set(xlabel="time, in units of the scene", ylabel="K", ylim=(0, None))
    if "Nu" in history:
        right = axes.twinx()
        right.plot(history["t"], history["Nu"], marker="", color="#D55E00", linestyle="--")
        right.set_ylabel("Nu (dashed)")
        right.grid(False)
