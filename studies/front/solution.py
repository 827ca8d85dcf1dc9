"""Result of `solve`: numbers with errors, a history, fields, a picture, a file."""
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd

from continuum.fluid import Fields
from studies.front.picture import picture
from studies.kit.stats import Measured


class NoSuchQuantity(AttributeError):
    """This solution does not have the requested quantity."""


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
    compile_s: float = 0.0

    def __getitem__(self, name: str) -> Measured:
        """A number by its name. Raises NoSuchQuantity: there is none."""
        if name not in self.numbers:
            raise NoSuchQuantity(f"{self.method} has no {name} in this scene; it has "
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

    def plot(self, path: str | Path | None = None) -> Any:
        """The figure of temperature, velocities and the history; as PNG at `path`, if given."""
        return picture(self, path)

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
        numbers = ", ".join(f"{name} = {value}" for name, value in self.numbers.items())
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
