"""Checkpoints of a run as HDF5: written beside and then renamed, so the last good one survives."""
import hashlib
import os
from dataclasses import fields, is_dataclass
from errno import ENOSPC
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from continuum.jit import source_hash
from particles.plan import Plan, Run

SCALARS = ("step", "samples", "reflections", "skin", "cpu_s", "compile_s")


def told(value: Any) -> str:
    """What tells a method from another: arrays by the sums of their sizes."""
    if isinstance(value, np.ndarray):
        return repr(float(np.abs(value).sum()))
    if isinstance(value, type) or not (is_dataclass(value) or isinstance(value, tuple)):
        return repr(value)
    parts = value if isinstance(value, tuple) else (getattr(value, field.name) for field in fields(value))
    return f"{type(value).__name__}({', '.join(map(told, parts))})"


def _identity(method: Any, plan: Plan, start: np.ndarray) -> dict[str, str]:
    """What must be the same for a restart to be the same run."""
    words = (f"{told(method)} dt={plan.dt!r} every={plan.every} mean_from={plan.mean_from!r} "
             f"{[*plan.series]} {[*plan.means]}")
    return {"code": source_hash(), "parameters": words, "start": hashlib.sha256(start.tobytes()).hexdigest()}


def save(path: Path, method: Any, plan: Plan, start: np.ndarray, now: Run) -> None:
    """Write the run to `path`; on a full disk the former checkpoint stays and OSError says so."""
    beside = path.with_suffix(".part")
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        with h5py.File(beside, "w") as file:
            file.attrs.update(_identity(method, plan, start))
            for name in SCALARS:
                file.attrs[name] = getattr(now, name)
            for name in ("state", "ids", "anchor", "times"):
                file[name] = [] if getattr(now, name) is None else getattr(now, name)
            for group, values in (("series", now.series), ("sums", now.sums)):
                for name, value in values.items():
                    file[f"{group}/{name}"] = value
        os.replace(beside, path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        why = "the disk is full" if error.errno == ENOSPC or "No space" in str(error) else str(error)
        raise OSError(f"cannot write checkpoint {path.name} at step {now.step}: {why}; the former one is "
                      "kept") from error


def load(path: Path | None, method: Any, plan: Plan, start: np.ndarray) -> Run | None:
    """The run at `path`, None without one. ValueError: unreadable, or of another run."""
    if path is None or not path.exists():
        return None
    try:
        with h5py.File(path, "r") as file:
            _same(path, dict(file.attrs), _identity(method, plan, start))
            numbers = {name: file.attrs[name].item() for name in SCALARS}
            arrays = {name: file[name][()] for name in ("state", "ids", "anchor")}
            arrays["anchor"] = arrays["anchor"] if arrays["anchor"].size else None    # fixed points have none
            groups = {g: {name: item[()] for name, item in file.get(g, {}).items()}
                      for g in ("series", "sums")}
            times = list(file["times"][()])
    except (OSError, KeyError) as error:
        raise ValueError(f"checkpoint {path.name} cannot be read ({error}): delete it") from error
    series = {name: list(values) for name, values in groups["series"].items()}
    return Run(**arrays, **numbers, times=times, series=series, sums=groups["sums"])


def _same(path: Path, stored: dict, wanted: dict[str, str]) -> None:
    for what, value in wanted.items():
        if (had := str(stored.get(what))) != value:
            same = next((k for k, (a, b) in enumerate(zip(had, value, strict=False)) if a != b), 0)
            cut = slice(max(0, same - 20), same + 40)
            raise ValueError(f"checkpoint {path.name} is of other {what}: it has ...{had[cut]}..., this run "
                             f"...{value[cut]}...; delete it to start anew, or run what it was made with")
