"""A solution in a file: HDF5 with everything, or VTU with the fields for ParaView."""
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np


def save(solution: Any, path: Path) -> Path:
    """Write it, all or nothing. Raises ValueError: the end of the name is neither .h5 nor .vtu."""
    if path.suffix not in KINDS:
        raise ValueError(f"{path.name} ends in {path.suffix or 'nothing'}: give a name that ends in "
                         f"{' or '.join(KINDS)}")
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{os.getpid()}-{path.name}")
    try:
        KINDS[path.suffix](solution, beside)
        os.replace(beside, path)
    finally:
        beside.unlink(missing_ok=True)
    return path


def as_hdf5(solution: Any, path: Path) -> None:
    """Groups fields and history, a dataset a column; numbers and what was solved as attributes."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"scene": repr(solution.scene), "method": solution.method, "rows": solution.rows,
                           "seed": solution.seed, "dt": solution.dt, "steps": solution.steps})
        for name, value in solution.numbers.items():
            file.attrs[name], file.attrs[f"{name}_err"] = value
        for group, frame in (("fields", solution.places), ("history", solution.history)):
            for column in frame:
                file[f"{group}/{column}"] = frame[column].to_numpy()


def as_vtu(solution: Any, path: Path) -> None:
    """Points, each a cell of its own, with their fields; velocity as a vector."""
    import meshio  # takes half a second, for which few ask
    at = solution.places
    x = np.column_stack([at["x"], at["y"], 0*at["x"]])
    data = {name: at[name].to_numpy() for name in ("rho", "T", "V")}
    data["velocity"] = np.column_stack([at["vx"], at["vy"], 0*at["x"]])
    cells = [("vertex", np.arange(len(x))[:, None])]
    meshio.write(path, meshio.Mesh(x, cells, point_data=data), file_format="vtu")


KINDS: dict[str, Callable[[Any, Path], None]] = {".h5": as_hdf5, ".vtu": as_vtu}
