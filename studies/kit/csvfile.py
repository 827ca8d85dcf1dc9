"""CSV below a head of comments: where numbers come from, which columns are text, where empty is as above."""
import os
import platform
import subprocess
from collections.abc import Iterable
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path

import pandas as pd

from studies.kit.key import PACKAGES, ROOT

DIGITS = "%.9g"     # of numbers in tables
TEXT, ABOVE = "# text columns:", "# empty is as above:"     # what the head tells programs
LIBRARIES = ("numpy", "scipy", "numba", "py-pde")     # whose versions a head tells
AGAIN = "remove it and run the study again: finished cases are kept"


class OtherTable(ValueError):
    """A file that is no table, or a table of an older layout: other code wrote it."""


def read(path: Path, columns: Iterable[str] = ()) -> pd.DataFrame:
    """A table from CSV; empty text is "", an empty number NaN.

    Raises FileNotFoundError, OtherTable: there is no such file; it is no table, lacks some of ``columns``, or
    has text among numbers.
    """
    path = Path(path)
    if not path.exists():
        raise FileNotFoundError(f"{path} does not exist: make study-{path.parent.name} writes it")
    try:
        text, above = named(path, TEXT), named(path, ABOVE)
        names = pd.read_csv(path, comment="#", nrows=0).columns
        if missing := [column for column in columns if column not in names]:
            raise OtherTable(f"{path} has no column {', '.join(missing)}: it has an older layout; {AGAIN}")
        frame = parsed(path, [name for name in names if name not in (*text, *above)], [*text, *above])
        for name in above:
            full = frame[name].mask(frame[name] == "").ffill()
            frame[name] = full if name in text else pd.to_numeric(full)
    except OtherTable:
        raise
    except ValueError as error:     # of pandas, and of letters that are none
        raise OtherTable(f"{path} is no table ({str(error).strip()}): {AGAIN}") from error
    for name in frame.columns.difference(text) if text else ():
        if words := [value for value in frame[name] if isinstance(value, str) and not is_number(value)]:
            raise OtherTable(f"{path} has {words[0]!r} in {name}, a column of numbers: {AGAIN}")
    return frame


def parsed(path: Path, numbers: Iterable[str], texts: Iterable[str]) -> pd.DataFrame:
    """The rows, some columns as texts."""
    empty = {name: ["", "nan"] for name in numbers}
    types = dict.fromkeys(texts, str)
    return pd.read_csv(path, comment="#", dtype=types, keep_default_na=False, na_values=empty)


def is_number(text: str) -> bool:
    """Whether a column of numbers, or of True and False, may hold this."""
    try:
        float(text)
    except ValueError:
        return text in ("True", "False")
    return True


def named(path: Path, begin: str) -> list[str]:
    """The columns that a line of the head names: empty texts, say, do not tell that they are texts."""
    with path.open() as lines:
        for line in lines:
            if line.startswith(begin):
                return line.removeprefix(begin).strip().split(", ")
    return []


def write(path: Path, frame: pd.DataFrame, *, head: Iterable[str], once: Iterable[str] = ()) -> None:
    """CSV below ``head``, one comment a line. A table that did not change keeps the head it was written with.

    Of columns ``once`` what repeats the cell above is left out, unless something is empty there anyway.

    Raises ValueError: A column mixes text and numbers, or a text holds the sign of a comment.
    """
    text = [str(name) for name in frame if is_text(frame[name], path)]
    frame = frame.assign(**{name: frame[name].fillna("") for name in text})
    above = without_repeats(frame, once)
    notes = [f"{TEXT} {', '.join(text)}\n"]
    if above:
        notes.append(f"{ABOVE} {', '.join(above)}\n")
    body = "".join(notes) + frame.assign(**above).to_csv(index=False, float_format=DIGITS)
    if not (path.exists() and path.read_text().endswith(body)):
        write_atomic(path, "".join(f"# {line}\n" for line in head) + body)


def without_repeats(frame: pd.DataFrame, once: Iterable[str]) -> dict[str, pd.Series]:
    """Those columns ``once`` that have no empty cell, as texts, empty where they repeat the one above."""
    columns = {}
    for name in once if len(frame) else ():
        texts = frame[name].map(written)
        if not texts.isin(["", "nan"]).any():
            columns[name] = texts.mask(texts == texts.shift(), "")
    return columns


def written(value: object) -> str:
    """A cell as it stands in the file."""
    return DIGITS % value if isinstance(value, float) else str(value)


def is_text(column: pd.Series, path: Path) -> bool:
    """True for text, False for numbers; anything in between is refused."""
    there = column.dropna()
    texts = [value for value in there if isinstance(value, str)]
    if texts and len(texts) < len(there):
        raise ValueError(f"column {column.name} of {path.name} mixes numbers with text such as {texts[0]!r}: "
                         "write infinity as math.inf, nothing as None")
    if comments := [value for value in texts if "#" in value]:
        raise ValueError(f"column {column.name} of {path.name} holds {comments[0]!r}: # begins a comment in "
                         "a CSV; use another sign")
    return bool(texts)


def write_atomic(path: Path, text: str) -> None:
    """The whole text or nothing: an interrupt or a full disk leaves the old file as it was."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        part.write_text(text)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


@cache
def commit() -> str:
    """Commit of the code, with ``-dirty`` when the packages hold changes that it lacks."""
    short = git("rev-parse", "--short=10", "HEAD")
    if not short:
        return "unknown"
    return short + ("-dirty" if git("status", "--porcelain", "--", *PACKAGES) else "")


def git(*words: str) -> str:
    """What git answers; empty without git or outside a repository."""
    command = ["git", "-C", str(ROOT), *words]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def versions() -> str:
    """Python and the libraries that compute."""
    libraries = [f"{name} {version(name)}" for name in LIBRARIES]
    return ", ".join([f"python {platform.python_version()}", *libraries])


def cpu() -> str:
    """Model and number of cores."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return f"{models[0] if models else platform.machine()}, {os.cpu_count()} cores"


def now() -> str:
    """Time in UTC to the minute."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
