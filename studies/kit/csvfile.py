"""CSV below a head of comments: origin of the numbers, names of text columns. Large files are gzipped."""
import fcntl
import gzip
import os
import platform
import re
import subprocess
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from io import StringIO
from pathlib import Path

import pandas as pd

from studies.kit.key import PACKAGES, ROOT

DIGITS = "%.9g"     # format of numbers in tables
TEXT = "# text columns:"                    # line of the head that programs read
LIBRARIES = ("numpy", "scipy", "numba", "py-pde")     # whose versions the head has
AGAIN = "remove it and run the study again: finished cases are kept"
EMPTY = "(none)"                            # stands for an empty text: an empty cell is a missing number
#: texts that pandas reads as a missing number
MISSING = ("", "NA", "N/A", "n/a", "NULL", "null", "None", "<NA>")


class OtherTable(ValueError):
    """A file that is no table, or a table of an older layout: other code wrote it."""


def read(path: Path, columns: Iterable[str] = ()) -> pd.DataFrame:
    """Read a table from CSV, gzipped or not; an empty text is "", a missing number NaN.

    Raises FileNotFoundError. OtherTable: the file is no table, has text among numbers, or lacks some of
    ``columns``.
    """
    if not path.exists():
        raise FileNotFoundError(f"{path} does not exist: make study-{path.parent.name} writes it")
    try:
        body = content(path)
        known = re.search(f"^{TEXT} (.+)$", body, re.MULTILINE)
        text = known[1].split(", ") if known else []
        frame = pd.read_csv(StringIO(body), comment="#", dtype=dict.fromkeys(text, str))
        frame[text] = frame[text].replace(EMPTY, "").fillna("")
        for name in frame.columns.difference(text) if text else ():
            pd.to_numeric(frame[name])
    except (ValueError, LookupError, gzip.BadGzipFile, EOFError, zlib.error) as error:
        raise OtherTable(f"{path} is no table ({str(error).strip()}): {AGAIN}") from error
    if missing := [name for name in columns if name not in frame]:
        raise OtherTable(f"{path} has no column {', '.join(missing)}: it has an older layout; {AGAIN}")
    return frame


def content(path: Path) -> str:
    """Text of a file, gzipped (.gz) or not."""
    return gzip.decompress(path.read_bytes()).decode() if path.suffix == ".gz" else path.read_text()


def is_number(text: str) -> bool:
    """Whether a text reads as a number, True or False."""
    try:
        float(text)
    except ValueError:
        return text in ("True", "False")
    return True


def write(path: Path, frame: pd.DataFrame, *, head: Iterable[str]) -> None:
    """Write CSV below ``head``, one comment per line. An unchanged table keeps its file with the old head.

    Raises ValueError: a column mixes text and numbers, or a text has a #, which begins a comment.
    """
    text = [str(name) for name in frame if is_text(frame[name], path)]
    filled = frame.assign(**{name: frame[name].fillna("").replace("", EMPTY) for name in text})
    body = f"{TEXT} {', '.join(text)}\n" + filled.to_csv(index=False, float_format=DIGITS)
    unchanged = path.exists() and content(path).endswith(body)
    if not unchanged:
        whole = "".join(f"# {line}\n" for line in head) + body
        # mtime=0: the same table has the same bytes
        write_atomic(path, gzip.compress(whole.encode(), mtime=0) if path.suffix == ".gz" else whole)


@contextmanager
def locked(folder: Path, busy: str = "") -> Iterator[None]:
    """Hold the lock of a folder; it is also released when the process ends.

    Waits while another process has it, or raises BlockingIOError with the message ``busy``, if given.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder/"lock").open("a") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | (fcntl.LOCK_NB if busy else 0))
        except BlockingIOError:
            raise BlockingIOError(busy) from None
        yield


def is_text(column: pd.Series, path: Path) -> bool:
    """True for a column of text, False for numbers. Raises ValueError: it mixes both, or a text has a #."""
    texts = [value for value in column if isinstance(value, str)]
    if texts and len(texts) < column.count():
        raise ValueError(f"column {column.name} of {path.name} mixes numbers with text such as {texts[0]!r}: "
                         "write infinity as math.inf, nothing as None")
    if "#" in "".join(texts):
        raise ValueError(f"column {column.name} of {path.name} has a #, which begins a comment in a CSV")
    return bool(texts)


def write_atomic(path: Path, content: str | bytes) -> None:
    """Write the whole content or nothing: an interrupt or a full disk leaves the old file unchanged."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with part.open("wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())     # else the new name may reach the disk before the content
        os.replace(part, path)
    except OSError as error:
        raise OSError(f"{path} cannot be written ({error.strerror}) and is as it was: make room there, or "
                      "choose another folder") from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


@cache
def commit() -> str:
    """Commit of the code, with ``-dirty`` if the packages have uncommitted changes."""
    short = git("rev-parse", "--short=10", "HEAD")
    if not short:
        return "unknown"
    if is_number(short):        # 5988628503, 12345e6789: would be read back as numbers
        short = git("rev-parse", "HEAD")
    return short + ("-dirty" if git("status", "--porcelain", "--", *PACKAGES) else "")


def git(*words: str) -> str:
    """Output of a git command; empty without git or outside a repository."""
    command = ["git", "-C", str(ROOT), *words]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def versions() -> str:
    """Versions of Python and of LIBRARIES."""
    libraries = [f"{name} {version(name)}" for name in LIBRARIES]
    return ", ".join([f"python {platform.python_version()}", *libraries])


def cpu() -> str:
    """Processor model and number of cores."""
    info = Path("/proc/cpuinfo")
    models = re.findall(r"model name\s*:\s*(.*\S)", info.read_text()) if info.exists() else []
    model = models[0] if models else platform.machine()
    return f"{model}, {os.cpu_count()} cores"


def now() -> str:
    """Current time in UTC to the minute."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
