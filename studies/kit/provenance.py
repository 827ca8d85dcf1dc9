"""Where a number comes from: commit, versions, machine, time."""
import platform
import subprocess
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from os import cpu_count
from pathlib import Path

from studies.kit.key import PACKAGES, ROOT

LIBRARIES = ("numpy", "scipy", "numba", "py-pde")


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
    return f"{models[0] if models else platform.machine()}, {cpu_count()} cores"


def now() -> str:
    """Time in UTC to the minute."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
