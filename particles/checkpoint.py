"""Checkpoints of a run as HDF5 files. A new file replaces the last one only when it is complete."""
import hashlib
import io
import os
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from errno import ENOSPC
from functools import cached_property, partial
from pathlib import Path, PurePath
from types import CodeType, FunctionType, MethodType
from typing import Any

import h5py
import numpy as np

from continuum.jit import source_hash
from particles.plan import Plan, Run

SCALARS = ("step", "samples", "reflections", "skin", "cpu_s", "compile_s")
#: size in bytes of the block before the HDF5 data, which HDF5 readers skip: it holds the hash of the data
SEAL = 512
#: types whose repr identifies a value completely
PLAIN = (bool, int, float, complex, str, bytes, np.generic, type(None), type(...), Enum, PurePath)


def told(value: Any, within: tuple[int, ...] = ()) -> str:
    """Text that identifies a value, the same in every process. Raises TypeError: no text identifies it."""
    value = getattr(value, "py_func", value)        # of a compiled function, its Python source
    if isinstance(value, PLAIN):
        return repr(value)
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__}"
    if id(value) in within:
        return "itself"
    parts, inner = _parts(value), (*within, id(value))
    texts = ([f"{name}={told(part, inner)}" for name, part in parts.items()] if isinstance(parts, dict)
             else [told(part, inner) for part in parts])
    return f"{type(value).__name__}({', '.join(texts)})"


def _parts(value: Any) -> Any:
    """Parts that identify a value; of an object all attributes except cached properties."""
    match value:
        case np.ndarray() if value.dtype.names or value.dtype.hasobject:    # bytes hold gaps, pointers
            return str(value.dtype), value.tolist()
        case np.ndarray():
            return str(value.dtype), value.shape, hashlib.sha256(value.tobytes()).hexdigest()
        case FunctionType():
            cells = [cell.cell_contents for cell in value.__closure__ or ()]
            preset = value.__defaults__, value.__kwdefaults__
            return value.__module__, value.__qualname__, value.__code__, preset, cells
        case CodeType():
            return hashlib.sha256(value.co_code).hexdigest(), value.co_names, value.co_consts
        case MethodType():
            return value.__func__.__qualname__, value.__self__
        case partial():
            return value.func, value.args, value.keywords
        case Mapping():
            return [*value.items()]
        case set() | frozenset():
            return sorted(map(told, value))
        case tuple() | list():
            return value
    if is_dataclass(value):
        return {field.name: getattr(value, field.name) for field in fields(value)}
    if not hasattr(value, "__dict__"):
        raise TypeError(f"a checkpoint cannot tell {value!r} from another {type(value).__name__}: make it of "
                        "numbers, arrays, functions and classes, or run without a checkpoint")
    return {name: part for name, part in vars(value).items()
            if not isinstance(getattr(type(value), name, None), cached_property)}


def _identity(method: Any, plan: Plan, start: np.ndarray) -> dict[str, str]:
    """Texts that must agree between a checkpoint and the run that continues it."""
    words = (f"{told(method)} dt={plan.dt!r} every={plan.every} mean_from={plan.mean_from!r} "
             f"{told(plan.series)} {told(plan.means)}")
    return {"code": source_hash(), "parameters": words, "start": told(start)}


def save(path: Path, method: Any, plan: Plan, start: np.ndarray, now: Run) -> None:
    """Write the run to `path`. Raises OSError, as on a full disk; the former checkpoint then stays."""
    beside = path.with_name(f"{path.name}.part")
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        content = _packed(_identity(method, plan, start), plan, now)
        with beside.open("wb") as file:
            file.write(_seal(content) + content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        why = "the disk is full" if error.errno == ENOSPC or "No space" in str(error) else str(error)
        raise OSError(f"cannot write checkpoint {path} at step {now.step}: {why}; the former one is "
                      "kept") from error


def _seal(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode().ljust(SEAL, b"\0")


def _packed(identity: dict[str, str], plan: Plan, now: Run) -> bytes:
    """The run as HDF5 data without the seal. Series and sums are numbered, as their names may be any text."""
    whole = io.BytesIO()
    with h5py.File(whole, "w", userblock_size=SEAL) as file:
        for name, text in identity.items():
            file[name] = text       # HDF5 limits the size of attributes
        for name in (*SCALARS, "state", "ids", "anchor", "times"):
            file[name] = [] if getattr(now, name) is None else getattr(now, name)
        for group, names in _groups(plan):
            values = getattr(now, group)
            for number, name in enumerate(names if values else ()):
                file[f"{group}/{number}"] = values[name]
    return whole.getvalue()[SEAL:]


def _groups(plan: Plan) -> tuple[tuple[str, list[str]], ...]:
    return ("series", [*plan.series]), ("sums", [*plan.means])


def load(path: Path | None, method: Any, plan: Plan, start: np.ndarray) -> Run | None:
    """Load the run at `path`, None without one. Raises ValueError: unreadable, of another run, too long."""
    if path is None:
        return None
    wanted = _identity(method, plan, start)
    if not path.exists():
        return None
    try:
        whole = path.read_bytes()
        if whole[:SEAL] != _seal(whole[SEAL:]):
            raise OSError("it is not as it was written")
        with h5py.File(io.BytesIO(whole), "r") as file:
            _same(path, {name: file[name].asstr()[()] for name in wanted}, wanted)
            numbers = {name: file[name][()].item() for name in SCALARS}
            arrays = {name: file[name][()] for name in ("state", "ids", "anchor")}
            arrays["anchor"] = arrays["anchor"] if arrays["anchor"].size else None    # fixed points have none
            groups = {group: {name: file[f"{group}/{number}"][()] for number, name in enumerate(names)}
                      for group, names in _groups(plan) if group in file}
            times = file["times"][()].tolist()
        if arrays["state"].shape != start.shape or sorted(arrays["ids"]) != [*range(start.shape[1])]:
            raise OSError(f"its state {arrays['state'].shape} or numbers of particles do not fit a start "
                          f"{start.shape}")
    except (OSError, KeyError) as error:
        raise ValueError(f"checkpoint {path} cannot be read ({error}): delete it") from error
    if numbers["step"] > plan.steps:
        raise ValueError(f"checkpoint {path} is at step {numbers['step']}, beyond steps = {plan.steps}: "
                         "take more steps, or delete it to start anew")
    series = {name: values.tolist() for name, values in groups.get("series", {}).items()}
    return Run(**arrays, **numbers, times=times, series=series, sums=groups.get("sums", {}))


def _same(path: Path, stored: dict[str, str], wanted: dict[str, str]) -> None:
    for what, value in wanted.items():
        if (had := stored[what]) != value:
            same = next((k for k, (a, b) in enumerate(zip(had, value, strict=False)) if a != b), 0)
            cut = slice(max(0, same - 20), same + 40)
            raise ValueError(f"checkpoint {path} is of other {what}: it has ...{had[cut]}..., this run "
                             f"...{value[cut]}...; delete it to start anew, or run what it was made with")
