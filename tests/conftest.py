"""Before any test: a cache folder of compiled code that belongs to the tests.

Its name holds the hash of the sources, but what a test changes at run time is in no source: a gas or weight of its own
ends in the index of library functions (every later run would throw that index away and compile again), and a
patched formula or constant would be kept under the key of the true one.
"""
import os
import signal

import numba
import pytest

import continuum.jit  # noqa: F401  (names the folder for users)

# workers and subprocesses inherit it, hence once only
os.environ["NUMBA_CACHE_DIR"] = os.environ["NUMBA_CACHE_DIR"].removesuffix("-tests") + "-tests"
numba.config.reload_config()

# a shell that starts the tests in the background, as nohup does, has Ctrl-C ignored, and what tests start would inherit that
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Two processes share tests by file, whose fixtures are made once, and test_studies by study."""
    for item in items:
        name = item.path.stem
        shared = item.callspec.params["study"] if name == "test_studies" else name
        item.add_marker(pytest.mark.xdist_group("report" if name.startswith("test_report") else shared))
    items.sort(key=lambda item: item.path.stem != "test_studies")
