"""CSV below a head of comments: where numbers come from, which columns are text, where empty is as above."""
import os
import platform
import re
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
        frame = parsed(path, {*text, *above})
        for name in above:
            full = frame[name].mask(frame[name] == "").ffill()
            frame[name] = full if name in text else pd.to_numeric(full)
    except ValueError as error:     # of pandas, and of letters that are none
        raise OtherTable(f"{path} is no table ({str(error).strip()}): {AGAIN}") from error
    if missing := [name for name in columns if name not in frame]:
        raise OtherTable(f"{path} has no column {', '.join(missing)}: it has an older layout; {AGAIN}")
    if text:
        check_numbers(path, frame[frame.columns.difference(text)])
    return frame


def parsed(path: Path, texts: Iterable[str]) -> pd.DataFrame:
    """The rows, some columns as texts."""
    names = pd.read_csv(path, comment="#", nrows=0).columns
    empty = {name: ["", "nan"] for name in names.difference(list(texts))}
    types = dict.fromkeys(texts, str)
    return pd.read_csv(path, comment="#", dtype=types, keep_default_na=False, na_values=empty)


def check_numbers(path: Path, frame: pd.DataFrame) -> None:
    """Refuse text among numbers."""
    for name in frame:
        for value in frame[name]:
            if isinstance(value, str) and not is_number(value):
                raise OtherTable(f"{path} has {value!r} in {name}, a column of numbers: {AGAIN}")


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
    filled = frame.fillna(dict.fromkeys(text, ""))
    above = without_repeats(filled, once)
    body = f"{TEXT} {', '.join(text)}\n"
    if above:
        body += f"{ABOVE} {', '.join(above)}\n"
    body += filled.assign(**above).to_csv(index=False, float_format=DIGITS)
    unchanged = path.exists() and path.read_text().endswith(body)
    if not unchanged:
        comments = "".join(f"# {line}\n" for line in head)
        write_atomic(path, comments + body)


def put(path: Path, new: pd.DataFrame, *, by: list[str], order: list[str], head: Iterable[str]) -> None:
    """Rows, all the same in the columns ``by``, in place of those that are the same there in the file."""
    rows = new
    if path.exists():
        old = read(path, new.columns)
        replaced = (old[by] == new[by].iloc[0]).all(axis=1)
        rows = new if replaced.all() else pd.concat([old[~replaced], new])
    write(path, rows.sort_values(order), head=head)


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
    values = column.dropna().tolist()
    texts = [value for value in values if isinstance(value, str)]
    if texts and len(texts) < len(values):
        raise ValueError(f"column {column.name} of {path.name} mixes numbers with text such as {texts[0]!r}: "
                         "write infinity as math.inf, nothing as None")
    for text in texts:
        if "#" in text:
            raise ValueError(f"column {column.name} of {path.name} holds {text!r}: # begins a comment in "
                             "a CSV; use another sign")
    return bool(texts)


def write_atomic(path: Path, content: str | bytes) -> None:
    """The whole content or nothing: an interrupt or a full disk leaves the old file as it was."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        if isinstance(content, bytes):
            part.write_bytes(content)
        else:
            part.write_text(content)
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
    models = re.findall(r"model name\s*:\s*(.*\S)", info.read_text()) if info.exists() else []
    model = models[0] if models else platform.machine()
    return f"{model}, {os.cpu_count()} cores"


def now() -> str:
    """Time in UTC to the minute."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
