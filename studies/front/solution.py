"""What `solve` gives: numbers with errors, a history, fields, a picture, a file."""
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from continuum.fluid import Fields
from studies.front.picture import picture
from studies.front.saving import save
from studies.kit.stats import Measured


class NoSuchQuantity(AttributeError):
    """A quantity that this solution does not have."""


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A method's solution of a scene.

    numbers : by name, each with the half width of its 95 % interval. history : columns t, K, ... ; t in the
    unit of time of the scene, for convection the free-fall time. places : columns x, y, vx, vy, rho, T, V, at
    the points or nodes of the method. cpu_s : without compiling.
    """
    scene: Any
    method: str
    rows: int
    seed: int
    numbers: dict[str, Measured]
    history: pd.DataFrame = field(repr=False)
    places: pd.DataFrame = field(repr=False)
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
        """Heat that passes over what conduction alone would carry."""
        return self["Nu"]

    @property
    def error(self) -> Measured:
        """Difference from the exact answer, relative."""
        return self["error"]

    def fields(self) -> pd.DataFrame:
        """x, y, vx, vy, rho, T and the volume V, a row for each point or node."""
        return self.places.copy()

    @property
    def at(self) -> Fields:
        """The same as arrays, places and velocities (n, 2): what functions of a flow take."""
        x, y, vx, vy, *others = self.places.to_numpy().T
        return Fields(np.stack([x, y], axis=1), np.stack([vx, vy], axis=1), *others)

    def plot(self, path: str | Path | None = None) -> Any:
        """The figure of temperature, velocities and the history; written to `path`, if given."""
        return picture(self, path)

    def save(self, path: str | Path) -> Path:
        """Write all of it: ".h5" with history and numbers, ".vtu" the fields for ParaView."""
        return save(self, Path(path))

    def __str__(self) -> str:
        """One line."""
        told = ", ".join(f"{name} = {written(value)}" for name, value in self.numbers.items())
        return f"{self.method}, {self.rows} rows: {told}  ({self.cpu_s:.1f} s of CPU, {self.steps} steps)"


def written(value: Measured) -> str:
    """A value and its error, in as many digits as these deserve."""
    return f"{value.value:.5g}" + (f" +- {value.err:.1g}" if value.err else "")
