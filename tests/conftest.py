"""Before any test: a cache folder of compiled code that belongs to the tests.

Its name holds the hash of the sources, but what a test changes at run time is in no source: a gas or weight
of its own ends in the index of library functions (every later run would compile again), and a
patched formula or constant would be kept under the key of the true one.
"""
import os
import re
import signal
from pathlib import Path

import numba
from xdist.scheduler import LoadFileScheduling

import continuum.jit  # noqa: F401  (names the folder for users)

# workers and subprocesses inherit it, hence once only
os.environ["NUMBA_CACHE_DIR"] = os.environ["NUMBA_CACHE_DIR"].removesuffix("-tests") + "-tests"
numba.config.reload_config()

# a shell that starts the tests in the background has Ctrl-C ignored, which what tests start would inherit
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


class Sharing(LoadFileScheduling):
    """Two processes share tests by file, so that fixtures are made once; they share test_studies by study."""

    def _split_scope(self, nodeid):
        file = Path(nodeid.partition("::")[0]).stem
        if file == "test_studies":
            return re.split(r"[\[\]-]", nodeid)[1]
        return "report" if file.startswith("test_report") else file


def pytest_xdist_make_scheduler(config, log):
    return Sharing(config, log) if config.getvalue("dist") == "loadfile" else None


def pytest_collection_modifyitems(items):
    """What takes longest comes first."""
    items.sort(key=lambda item: item.path.stem != "test_studies")
