"""Results of `solve` and `compare`: numbers with errors, a history, fields, a picture, a file."""
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation

from continuum.fluid import Fields
from studies.build import answer
from studies.kit.figure import errorbar, figure, look, numbered, save
from studies.kit.stats import Measured, with_errors

ARROWS = 11         # number over the height
LONG = 3.0          # width/height from which on (also up to 1/2) fields are drawn along a line, not as a map
NAMES = {"rho": "density", "vx": "velocity $v_x$", "T": "temperature"}


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A method's solution of a scene.

    numbers : by name, each with the half width of its 95 % interval. history : columns t, K, ... ; t in the
    unit of time of the scene, for convection the free-fall time. at : fields as arrays, at the points or
    nodes of the method. cpu_s : CPU seconds without compiling.
    """
    scene: Any
    method: str
    rows: int
    seed: int
    numbers: dict[str, Measured]
    history: pd.DataFrame = field(repr=False)
    at: Fields = field(repr=False)
    dt: float = 0.0
    steps: int = 0
    cpu_s: float = 0.0

    def __getitem__(self, name: str) -> Measured:
        """A number by its name. Raises AttributeError: there is none."""
        if name not in self.numbers:
            raise AttributeError(f"{self.method} has no {name} in this scene; it has "
                                 f"{', '.join(self.numbers)}")
        return self.numbers[name]

    @property
    def K(self) -> Measured:
        """Kinetic energy per mass."""
        return self["K"]

    @property
    def Nu(self) -> Measured:
        """Nusselt number: heat transport over that of conduction alone."""
        return self["Nu"]

    @property
    def error(self) -> Measured:
        """Relative difference from the exact answer."""
        return self["error"]

    def fields(self) -> pd.DataFrame:
        """Table of x, y, vx, vy, rho, T and the volume V, one row per point or node."""
        x, v, *others = self.at
        columns = ("x", "y", "vx", "vy", "rho", "T", "V")
        return pd.DataFrame(dict(zip(columns, (*x.T, *v.T, *others))))

    def plot(self, path: str | Path | None = None) -> Figure:
        """The figure of temperature, velocities and the history; as PNG at `path`, if given."""
        many = len(self.history) > 1
        page, axes = figure(1, 1 + many, width=5.2, squeeze=False)
        flow(axes[0, 0], self)
        if many:
            past(axes[0, 1], self.history)
        page.suptitle(str(self), fontsize=9)
        return written(page, path)

    def save(self, path: str | Path) -> Path:
        """Write a file, whole or not at all: ".h5" has fields, history, numbers; ".vtu" fields for ParaView.

        Raises ValueError: the name has another ending.
        """
        place, kinds = Path(path), {".h5": as_hdf5, ".vtu": as_vtu}
        if place.suffix not in kinds:
            raise ValueError(f"{place.name} ends in {place.suffix or 'nothing'}: give a name that ends in "
                             f"{' or '.join(kinds)}")
        place.parent.mkdir(parents=True, exist_ok=True)
        beside = place.with_name(f"{place.stem}.part{place.suffix}")
        try:
            kinds[place.suffix](self, beside)
            beside.replace(place)
        finally:
            beside.unlink(missing_ok=True)
        return place

    def __str__(self) -> str:
        """Method, rows, numbers and cost in one line."""
        numbers = ", ".join(f"{name} = {brief(value)}" for name, value in self.numbers.items())
        return f"{self.method}, {self.rows} rows: {numbers}  ({self.cpu_s:.1f} s of CPU, {self.steps} steps)"


def as_hdf5(solution: Solution, path: Path) -> None:
    """Write groups fields and history, one dataset per column; numbers and parameters as attributes."""
    with h5py.File(path, "w") as file:
        file.attrs["scene"] = repr(solution.scene)
        for name in ("method", "rows", "seed", "dt", "steps"):
            file.attrs[name] = getattr(solution, name)
        for name, value in solution.numbers.items():
            file.attrs[name], file.attrs[f"{name}_err"] = value
        for group, frame in (("fields", solution.fields()), ("history", solution.history)):
            for column in frame:
                file[f"{group}/{column}"] = frame[column].to_numpy()


def as_vtu(solution: Solution, path: Path) -> None:
    """Write each point as a cell with its fields; positions and velocities as 3D vectors."""
    import meshio  # takes half a second, and few need it
    at, third = solution.at, ((0, 0), (0, 1))
    data = {"velocity": np.pad(at.v, third), "rho": at.rho, "T": at.T, "V": at.V}
    cells = [("vertex", np.arange(len(at.x))[:, None])]
    meshio.write(path, meshio.Mesh(np.pad(at.x, third), cells, point_data=data))


@dataclass(frozen=True)
class Comparison:
    """Solutions of several methods. diverged : messages of runs without solution, by method and rows."""
    solutions: list[Solution]
    diverged: dict[str, str]

    @property
    def table(self) -> pd.DataFrame:
        """One row per method and resolution: numbers, each with its error, and their cost."""
        return pd.DataFrame([row(one, with_errors(**one.numbers)) for one in self.solutions])

    def plot(self, path: str | Path | None = None) -> Figure:
        """Flows at the finest resolution, and numbers against cost. Raises ValueError: no solution."""
        if not self.solutions:
            raise ValueError("every run diverged: there is nothing to draw; take more rows or another method")
        by_rows = sorted(self.solutions, key=lambda one: one.rows)
        finest = {one.method: one for one in by_rows}.values()
        table = self.table
        names = [name for name in ("K", "Nu", "error") if name in table]
        page = Figure(figsize=(3.4*max(len(finest), len(names)), 5.6), layout="constrained")
        halves: Any = page.subfigures(2, 1)
        above, below = halves
        for axes, one in zip(above.subplots(1, len(finest), squeeze=False)[0], finest):
            flow(axes, one)
            axes.set_title(one.method)
        for axes, name in zip(below.subplots(1, len(names), squeeze=False)[0], names):
            against_cost(axes, table.dropna(subset=[name]), name)
        return written(page, path)

    def __str__(self) -> str:
        """The table, with errors in units of the last digit, then the runs that diverged."""
        rows = pd.DataFrame([row(one, {name: brief(q) for name, q in one.numbers.items()})
                             for one in self.solutions])
        table = rows.to_string(index=False, na_rep="", float_format="{:.2g}".format)
        diverged = [f"{name}: {why}" for name, why in self.diverged.items()]
        return "\n".join([table]*bool(self.solutions) + diverged)


def brief(number: Measured) -> str:
    """A number as text, with its error over time; with five digits where that is below the fifth."""
    return str(number if number.err > 1e-5*abs(number.value) else Measured(number.value))


def row(one: Solution, numbers: dict[str, Any]) -> dict[str, Any]:
    """Row of the table for one solution."""
    return {"method": one.method, "rows": one.rows, **numbers, "cpu_s": one.cpu_s, "steps": one.steps}


# --- pictures -----------------------------------------------------------------------------------------------


def written(page: Figure, path: str | Path | None) -> Figure:
    """The figure, written as PNG if a path is given."""
    if path is not None:
        page.draw_without_rendering()       # ticks may change with the layout, which then has to follow
        save(page, Path(path))
    return page


def flow(axes: Axes, solution: Any) -> None:
    """Draw a map of the fields, or in a long strip the fields along it."""
    aspect = solution.scene.width/solution.scene.L
    if 1/2 < aspect < LONG:
        mapped(axes, solution.scene, solution.fields())
    else:
        along(axes, solution, "x" if aspect > 1 else "y")


def mapped(axes: Axes, scene: Any, at: pd.DataFrame) -> None:
    """Draw temperature (or density, if it varies more) as colours, velocity as arrows."""
    L, shown = scene.L, "T" if np.ptp(at["T"]) > np.ptp(at["rho"]) else "rho"
    mesh = Triangulation(at["x"]/L, at["y"]/L)
    colours = axes.tripcolor(mesh, at[shown], shading="gouraud", cmap="cividis")
    axes.figure.colorbar(colours, cax=axes.inset_axes((1.03, 0, 0.05, 1)), label=NAMES[shown])
    x, y = (np.arange(-size/2 + 0.5/ARROWS, size/2, 1/ARROWS) for size in (scene.width/L, 1))
    X, Y = np.meshgrid(x, y)
    vx, vy = (LinearTriInterpolator(mesh, at[name])(X, Y) for name in ("vx", "vy"))
    if at[["vx", "vy"]].any(axis=None):      # arrows of a fluid at rest have no scale
        axes.quiver(X, Y, vx, vy, color="white", edgecolor="black", linewidth=0.3, pivot="mid", width=0.006)
    axes.set(aspect="equal", xlabel="x/L", ylabel="y/L")
    axes.grid(False)


def along(axes: Axes, solution: Any, axis: str) -> None:
    """Plot every point's fields against one coordinate, and the exact answer, if known, in black."""
    at = solution.fields().sort_values(axis)
    exact = answer(solution.scene, at[["x", "y"]].to_numpy())
    for number, name in enumerate(exact or ("rho", "vx", "T")):
        dots = look(number) | {"linestyle": "none", "markersize": 2}
        axes.plot(at[axis], at[name], **dots, label=NAMES[name])
        if exact:
            axes.plot(at[axis], exact[name], color="black", marker="", linestyle="-", linewidth=0.8)
    axes.set(xlabel=axis, ylabel="black: exact" if exact else "")
    axes.legend()


def past(axes: Axes, history: pd.DataFrame) -> None:
    """Plot K against time, and Nu if heat passes."""
    axes.plot(history["t"], history["K"], marker="", label="K")
    axes.set(xlabel="time, in units of the scene", ylabel="K", ylim=(0, None))
    if "Nu" in history:
        late = history["Nu"][len(history)//4:]      # at the start it may be a hundred times as large
        right = axes.twinx()
        right.plot(history["t"], history["Nu"], marker="", color="#D55E00", linestyle="--")
        right.set(ylabel="Nu (dashed)", ylim=(min(0.0, 1.1*late.min()), max(1.0, 1.2*late.max())))
        right.grid(False)


def against_cost(axes: Axes, table: pd.DataFrame, name: str) -> None:
    """Plot one number of all methods, with errors, against CPU seconds; points are labelled with rows."""
    for number, (method, rows) in enumerate(table.groupby("method", sort=False)):
        errorbar(axes, rows["cpu_s"], rows[name], rows[f"{name}_err"], number=number, label=str(method),
                 linestyle=look(number)["linestyle"])
    for rows, *place in table[["rows", "cpu_s", name]].itertuples(index=False):
        axes.annotate(f"{rows}", (place[0], place[1]), textcoords="offset points", xytext=(4, 4), fontsize=7)
    axes.set(xscale="log", xlabel="CPU  [s]", ylabel=name, yscale="log" if name == "error" else "linear")
    numbered(axes.xaxis)
    if name == "error":
        numbered(axes.yaxis)
    axes.legend(fontsize=7)
