"""A solution in two pictures: its fields at the end, and its history."""
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation

from studies.build.answers import answer
from studies.kit.figure import figure, look, save

ARROWS = 11         # over the height
LONG = 3.0          # times as long as wide, or more: fields along the axis tell more than a map
NAMES = {"rho": "density", "vx": "velocity $v_x$", "T": "temperature"}


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
    """A map of the fields, or what they are along a strip."""
    aspect = solution.scene.width/solution.scene.L
    if aspect >= LONG or aspect*2 <= 1:
        along(axes, solution, "x" if aspect > 1 else "y")
    else:
        mapped(axes, solution)
    axes.set_title(title)


def mapped(axes: Axes, solution: Any) -> None:
    """Colours: temperature, or density where that changes more; arrows: velocity."""
    at, scene = solution.places, solution.scene
    L, shown = scene.L, "T" if np.ptp(at["T"]) > np.ptp(at["rho"]) else "rho"
    mesh = Triangulation(at["x"]/L, at["y"]/L)
    colours = axes.tripcolor(mesh, at[shown], shading="gouraud", cmap="cividis")
    axes.figure.colorbar(colours, ax=axes, label=NAMES[shown], shrink=0.8)
    x, y = (np.arange(-size/L/2 + 0.5/ARROWS, size/L/2, 1/ARROWS) for size in (scene.width, L))
    X, Y = np.meshgrid(x, y)
    vx, vy = (LinearTriInterpolator(mesh, at[name])(X, Y) for name in ("vx", "vy"))
    axes.quiver(X, Y, vx, vy, color="white", edgecolor="black", linewidth=0.3, pivot="mid", width=0.006)
    axes.set(aspect="equal", xlabel="x/L", ylabel="y/L")
    axes.grid(False)


def along(axes: Axes, solution: Any, axis: str) -> None:
    """Every point's fields against one coordinate, and the exact answer, where it is known, in black."""
    at = solution.places.sort_values(axis)
    exact = answer(solution.scene, at[["x", "y"]].to_numpy())
    for number, name in enumerate(exact or ("rho", "vx", "T")):
        dots = look(number) | {"linestyle": "none", "markersize": 2}
        axes.plot(at[axis], at[name], **dots, label=NAMES[name])
        if exact:
            axes.plot(at[axis], exact[name], color="black", marker="", linestyle="-", linewidth=0.8)
    axes.set(xlabel=axis, ylabel="exact: black line" if exact else "")
    axes.legend()


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
