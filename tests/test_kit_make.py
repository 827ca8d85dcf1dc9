"""make: names that exist before anything is set up; locks that it sets up from, exact and the same in all."""
import os
import re
import shutil
import subprocess
import sys
import tomllib
from functools import cache

import pytest

from studies.kit.key import ROOT

PROJECT = tomllib.loads((ROOT/"pyproject.toml").read_text())["project"]
#: lock -> requirements that it is made from
WANTED = {"requirements.lock": PROJECT["dependencies"]} | {
    f"requirements-{extra}.lock": wanted for extra, wanted in PROJECT["optional-dependencies"].items()}
PIN = re.compile(r"([\w.-]+)==([\w.]+)( ; [^\\]+)?((?: \\\n    --hash=sha256:[0-9a-f]{64})+)")


@pytest.fixture
def make(tmp_path):
    """make in a repository of the studies one and two; nothing can be set up in it."""
    if not shutil.which("make"):
        pytest.skip("no make")
    shutil.copy(ROOT / "Makefile", tmp_path)
    for lock in ROOT.glob("requirements*.lock"):
        (tmp_path / lock.name).touch()
    for name, text in {"one": "STUDY = 1\n", "two": "STUDY = 2\n", "kit": ""}.items():
        (tmp_path / f"studies/{name}").mkdir(parents=True)
        (tmp_path / f"studies/{name}/__init__.py").write_text(text)

    def run(*words: str) -> tuple[int, str]:
        # below another make it would say which folder it enters
        done = subprocess.run(["make", "--no-print-directory", "PYTHON=false", *words], cwd=tmp_path,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout
    return run


@pytest.mark.parametrize(("target", "name"),
                         [("study-three", "three"), ("figures-three", "three"), ("study-", "named")])
def test_an_unknown_study_is_told_those_that_exist_before_anything_is_set_up(make, target, name, tmp_path):
    code, text = make(target)
    assert code != 0 and f"no study {name}: there are one two" in text
    assert "Setting up" not in text and not (tmp_path / ".venv").exists()


def test_a_study_that_was_renamed_is_told_its_new_name(make):
    code, text = make("study-dpd")
    assert code
    assert text.splitlines()[0] == "no study dpd any more: it is part of noise: there are one two"


def test_help_lists_every_target_by_the_name_that_is_typed(make):
    code, text = make()
    assert code == 0 and "%" not in text
    listed = [line.split()[0] for line in text.splitlines() if line.startswith("  ")]
    assert {"study-one", "study-two", "figures-one", "figures-two", "env", "test", "help"} <= set(listed)
    assert "one" not in listed


@pytest.mark.parametrize(("size", "last"),
                         [("paper", ["films", "execute", "report equations", "report tables", "report"]),
                          ("quick", ["report --out results/quick"])])
def test_all_studies_become_notebooks_films_and_the_page_last(make, size, last, tmp_path):
    set_up(tmp_path, "ready", "ready-lab", "ready-films")
    code, text = make("-n", "studies", f"SIZE={size}")
    lines = [line.strip() for line in text.splitlines()
             if line.strip().startswith((".venv/bin/python", "for one in"))]
    wanted = ["studies one", "studies two", *last]
    assert code == 0 and len(lines) == len(wanted), text
    assert all(word in line for word, line in zip(wanted, lines)), lines


def set_up(folder, *stamps):
    (folder / ".venv").mkdir()
    for stamp in stamps:    # in order: each is younger than those before it
        (folder / ".venv" / stamp).touch()


@pytest.mark.parametrize(("words", "added"), [
    (["study-one"], []), (["figures-one"], []), (["report"], ["films"]),
    (["films"], ["films"]), (["lint"], ["test"]), (["test"], ["test", "cluster", "films"]),
    (["notebooks"], ["lab"]), (["lab"], ["lab"]), (["bench"], ["bench"]),
    (["study-one", "SCHEDULER=tcp://h:1"], ["cluster"]), (["worker", "SCHEDULER=tcp://h:1"], ["cluster"])])
def test_a_target_adds_what_it_needs_and_no_more(make, tmp_path, words, added):
    set_up(tmp_path, "ready")
    code, text = make("-n", *words)
    assert code == 0 and re.findall(r"Adding requirements-(\w+).lock", text) == added


def test_a_worker_is_told_that_it_needs_the_address_of_a_scheduler_before_anything_is_set_up(make, tmp_path):
    code, text = make("worker")
    assert not (tmp_path / ".venv").exists() and "Setting up" not in text
    assert code and "make worker SCHEDULER=tcp://host:port: the address that dask scheduler" in text


@pytest.mark.parametrize(("words", "told"), [
    (["worker", "SCHEDULER=foo"], "SCHEDULER=foo is no address of a Dask scheduler: give tcp://host:port"),
    (["study-one", "SCHEDULER=tcp://foo"], "SCHEDULER=tcp://foo is no address"),
    (["report", "SIZE=foo"], "unknown size 'foo': choose one of quick, paper, fine"),
    (["solve", "METHODS=grid", f"PYTHON={sys.executable}"], "is called METHODS; near to it is METHOD."),
    (["solve", "RA=5000"], 'called RA; there are SIZE ARGS SCHEDULER SCENE METHOD ROWS NUMBERS TEXT PYTHON; '
                           'numbers of a scene go into NUMBERS="ra=5000 pr=0.7"')])
def test_a_word_that_is_wrong_is_refused_in_one_line_before_anything_is_set_up(make, tmp_path, words, told):
    code, text = make(*words)
    assert code and told in text and len(text.splitlines()) == 1 and not (tmp_path/".venv").exists()


def test_all_of_what_is_typed_reaches_a_solution(make, tmp_path):
    set_up(tmp_path, "ready")
    code, text = make("-n", "solve", "METHOD=grid,spam", "NUMBERS:=ra=1,pr=2", "ARGS=--out a=b",
                      "OMP_NUM_THREADS=1")
    assert code == 0 and text.split("studies.front ")[1].split() == [
        *"rayleigh-benard grid spam --rows 16 --numbers ra=1 pr=2 --out a=b".split()]


def test_two_that_set_up_at_once_do_it_once_beside_the_environment_that_runs(make, tmp_path):
    set_up(tmp_path, "ready")
    os.utime(tmp_path/".venv/ready", (0, 0))
    (tmp_path/".venv/runs").touch()
    python = tmp_path/"python"
    python.write_text(f"""#!/bin/sh
case "$*" in
-c*) exec {sys.executable} "$@";;
*venv*) mkdir -p .venv-new/bin; cp "$0" .venv-new/bin/python; sleep 0.5; ls .venv >> seen;;
esac
""")
    python.chmod(0o755)
    both = [subprocess.Popen(["make", "env", f"PYTHON={python}"], cwd=tmp_path) for _ in range(2)]
    assert [one.wait() for one in both] == [0, 0]
    assert (tmp_path/"seen").read_text().split() == ["ready", "runs"]
    assert sorted(path.name for path in tmp_path.glob(".venv*")) == [".venv", ".venv-lock"]
    assert sorted(path.name for path in (tmp_path/".venv").iterdir()) == ["bin", "ready"]


# --- locks ------------------------------------------------------------------------------------------

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
