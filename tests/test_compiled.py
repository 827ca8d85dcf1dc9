"""The same bytes whatever was compiled before, by this process or another, and in which order."""
import os
import subprocess
import sys

import pytest

GRIDS = '''
import sys
from continuum.gas.fields import block, initial
from continuum.gas.newton import Discrete
from continuum.gas.solve import run
from continuum.pypde.gas import Gas
from continuum.pypde.solve import solve
from continuum.scene import RayleighBenard
from continuum.steady import Time

GAS, UNTIL = RayleighBenard(ra=5000), Time(20.0, samples=2)
grid = Discrete(GAS, 12)
WAYS = {"run": lambda: run(GAS, 12, until=UNTIL).fields.cells,
        "rates": lambda: grid.rates(grid.unknowns(block(initial(GAS, 12)))),
        "py-pde": lambda: solve(Gas(GAS, rows=12), until=UNTIL).state}
print(*sorted(f"{way} {WAYS[way]().tobytes().hex()}" for way in sys.argv[1:]))
'''
POINTS = '''
import sys
from particles.limits import limit_of
from particles.run import Plan, run
from tests.test_entropy_stable import GAS, VDW, closed, violent

for eos in sys.argv[1:]:
    method = closed(eos={"ideal": GAS, "vdw": VDW}[eos])
    state = violent(method)
    print(run(method, state, Plan(dt=limit_of(method, state), steps=5)).state.tobytes().hex())
'''


def results(cache, *ways: str, script: str = GRIDS) -> str:
    """Bytes of the solutions of a process that solves in these ways, one after the other."""
    done = subprocess.run([sys.executable, "-c", script, *ways], capture_output=True, text=True, check=True,
                          env={**os.environ, "NUMBA_CACHE_DIR": str(cache)})
    return done.stdout


@pytest.mark.parametrize("ways", [("run", "rates"), ("py-pde",)], ids=" ".join)
def test_a_cold_and_a_warm_cache_give_the_same_bytes_in_any_order(ways, tmp_path):
    cold = results(tmp_path, *ways)
    assert len(cold) > 1000 and cold == results(tmp_path, *ways) == results(tmp_path, *reversed(ways))


def test_formulas_do_not_depend_on_the_loop_that_had_them_compiled_first(tmp_path):
    # the loops that both fluids share come from disk; formulas had taken options and vectors from them
    results(tmp_path, "vdw", script=POINTS)
    assert results(tmp_path, "ideal", script=POINTS) == results(tmp_path/"empty", "ideal", script=POINTS)


@pytest.mark.parametrize("first", ["studies.__main__", "studies.front", "studies.judge", "numba"])
def test_compiled_code_is_kept_under_the_hash_of_all_sources_whatever_is_imported_first(first):
    # numba alone looks at one file: a term of 9 sums ran in a loop that was compiled for its 7
    said = f"import {first}, continuum.jit, numba; print(numba.config.CACHE_DIR)"
    unnamed = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    done = subprocess.run([sys.executable, "-c", said], env=unnamed, capture_output=True, text=True,
                          check=True)
    assert ".numba_cache" in done.stdout
