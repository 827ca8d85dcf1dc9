"""Locks: exact versions with hashes, the same in all of them, of what pyproject.toml asks for."""
import re
import tomllib
from functools import cache

import pytest

from studies.kit.key import ROOT

PROJECT = tomllib.loads((ROOT/"pyproject.toml").read_text())["project"]
#: lock -> requirements that it is made from
WANTED = {"requirements.lock": PROJECT["dependencies"]} | {
    f"requirements-{extra}.lock": wanted for extra, wanted in PROJECT["optional-dependencies"].items()}
PIN = re.compile(r"([\w.-]+)==([\w.]+)( ; [^\\]+)?((?: \\\n    --hash=sha256:[0-9a-f]{64})+)")


@cache
def pins(lock: str) -> dict[str, set[str]]:
    """Package -> its versions; AssertionError where anything stands in the lock besides."""
    text = (ROOT/lock).read_text()
    assert not PIN.sub("", text).strip(), f"{lock} has more than versions and hashes"
    versions: dict[str, set[str]] = {}
    for name, version, *_ in PIN.findall(text):
        versions.setdefault(name, set()).add(version)
    return versions


def test_there_is_a_lock_for_each_extra():
    assert {path.name for path in ROOT.glob("requirements*.lock")} == WANTED.keys()


@pytest.mark.parametrize("lock", WANTED)
def test_a_lock_has_what_is_asked_for(lock):
    asked = {re.split(r"[\[<>=!~ ]", one)[0] for one in WANTED[lock]}
    assert asked <= pins(lock).keys()


def test_locks_agree():
    first: dict[str, set[str]] = {}
    assert {name: (first[name], versions) for lock in WANTED for name, versions in pins(lock).items()
            if first.setdefault(name, versions) != versions} == {}


def test_the_core_has_no_notebook_browser_cluster_or_encoder():
    others = {"jupyterlab", "ipython", "selenium", "pytest", "distributed", "imageio-ffmpeg", "mypy"}
    assert not others & pins("requirements.lock").keys()
