"""How fast is SPAM: three sums, lists, RK4 and walls; beside LAMMPS, in one run.

    python -m bench.spam_speed [--no-lammps]

Ours and LAMMPS take turns, block by block of 64 evaluations, so that both see the same machine; so do one
thread and two. One core: CPU time, which others on the machine do not lengthen; two threads: the time that
passes. Rows are medians and quartiles over the blocks. Compiling (or loading compiled code) is a row of its
own. Writes results/bench/spam_speed.csv; takes about two minutes, on a quiet machine.
"""
import argparse
import os
import resource
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pandas as pd

from bench.convection import BLOCK, DT, EVALUATIONS, block_seconds, lattice, melted, method, per_evaluation
from bench.lammps_sph import Lammps, fastest, find_mpi
from bench.stages import stages
from particles.run import Plan, run
from studies.kit.csvfile import commit, cpu, now, versions, write
from studies.kit.key import ROOT
from studies.kit.timing import compile_and_run_seconds

FILE = ROOT/"results"/"bench"/"spam_speed.csv"
ONE_CORE, THREADED, MILLION = 20_000, 100_000, 1_000_000
COLUMNS = ["what", "particles", "threads", "ns_per_particle_evaluation", "q25", "q75", "repeats", "value",
           "unit"]


def time_row(what: str, particles: int, threads: int, ns: Any) -> dict[str, Any]:
    """Median and quartiles of times per particle and evaluation."""
    low, median, high = np.percentile(ns, [25, 50, 75])
    return {"what": what, "particles": particles, "threads": threads, "ns_per_particle_evaluation": median,
            "q25": low, "q75": high, "repeats": len(ns), "unit": "ns"}


def value_row(what: str, particles: int, threads: int, value: float, unit: str) -> dict[str, Any]:
    """A row with one number that is not a time per evaluation."""
    return {"what": what, "particles": particles, "threads": threads, "value": value, "unit": unit}


def ns(seconds: list[float], particles: int) -> np.ndarray:
    return np.array([per_evaluation(s, particles) for s in seconds])


def one_core(particles: int, blocks: int) -> list[dict[str, Any]]:
    """Rows of SPAM alone and of its stages."""
    rows = [time_row("spam", particles, 1, ns(block_seconds(particles, blocks), particles))]
    return rows + [time_row(name, particles, 1, values) for name, values in stages(particles, blocks).items()]


def beside_lammps(particles: int, blocks: int) -> list[dict[str, Any]]:
    """Rows of SPAM and LAMMPS, measured in turns."""
    theirs: list[float] = []
    other: Lammps = fastest(melted(particles), method(particles).box)
    ours = block_seconds(particles, blocks, between=lambda: theirs.append(other.seconds(BLOCK*EVALUATIONS)))
    print(other.describe())
    skin = value_row("lammps skin", particles, 1, other.skin, "sigma")
    other.close()
    pairs = ns(ours, particles), ns(theirs[1:], particles)
    return [time_row("spam", particles, 1, pairs[0]), time_row("lammps", particles, 1, pairs[1]), skin,
            value_row("lammps / spam", particles, 1, float(np.median(pairs[1])/np.median(pairs[0])), "times")]


def two_threads(particles: int, rounds: int) -> list[dict[str, Any]]:
    """Rows of wall-clock time with one thread and with two, measured in turns."""
    seconds: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(rounds):
        for threads, laps in seconds.items():
            laps += block_seconds(particles, 1, threads=threads, clock=time.perf_counter)
    rows = [time_row("spam, time that passes", particles, threads, ns(laps, particles))
            for threads, laps in seconds.items()]
    one, two = (row["ns_per_particle_evaluation"] for row in rows)
    return [*rows, value_row("speed-up", particles, 2, one/two, "times")]


def peak_memory(particles: int) -> list[dict[str, Any]]:
    """Row of the peak memory of a process that steps some particles."""
    words = [sys.executable, "-m", "bench.spam_speed", "--only-memory", str(particles)]
    printed = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT).stdout
    return [value_row("peak_rss_gb", particles, 1, float(printed), "GB")]


def print_memory(particles: int) -> None:
    """Run in the process of `peak_memory`: make steps with new lists, then print the peak memory."""
    case = method(particles)
    run(case, lattice(case.box), Plan(dt=DT, steps=4))
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(kilobytes*1024/1e9)


def goals(table: pd.DataFrame) -> list[tuple[str, float, str, bool]]:
    """Tuples (goal, measured, unit, met)."""
    def of(what: str, particles: int, column: str = "value") -> float:
        found = table[(table.what == what) & (table.particles == particles)][column]
        return float(found.iloc[0]) if len(found) else float("nan")

    speed, versus = of("spam", ONE_CORE, "ns_per_particle_evaluation"), of("lammps / spam", ONE_CORE)
    many = size(THREADED)
    return [("below 300 ns per particle and evaluation, one core, 20 000", speed, "ns", speed < 300),
            ("at least 2.5 times as fast as LAMMPS", versus, "times", versus >= 2.5),
            ("at least 1.7 times faster on two threads, 100 000", of("speed-up", many), "times",
             of("speed-up", many) >= 1.7),
            ("a million particles in less than 2 GB", of("peak_rss_gb", size(MILLION)), "GB",
             of("peak_rss_gb", size(MILLION)) < 2)]


def size(particles: int) -> int:
    """Number of particles of the box that comes closest to the given number."""
    return lattice(method(particles).box).shape[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--no-lammps", action="store_true", help="leave LAMMPS out")
    parser.add_argument("--only-memory", type=int, metavar="N", help="print the peak memory of N particles")
    words = parser.parse_args()
    if words.only_memory:
        return print_memory(words.only_memory)
    if not words.no_lammps:
        find_mpi()
    measure(words.no_lammps)


def measure(no_lammps: bool) -> None:
    """Measure all rows, write the table, print it with the goals."""
    load = os.getloadavg()[0]
    if load > 0.5:
        print(f"The machine is not quiet (load {load:.1f}): times are too long, those that pass most of all")
    _, compiling, loading = compile_and_run_seconds(lambda: melted(200, BLOCK))
    rows = [value_row("compiling", 200, 1, compiling, "s"),
            value_row("first run, of 200 particles", 200, 1, loading, "s")]
    if no_lammps:
        rows += one_core(ONE_CORE, 15)
    else:
        rows += [*beside_lammps(ONE_CORE, 15), *one_core(ONE_CORE, 9)[1:]]
    rows += one_core(5000, 15)
    rows += two_threads(size(THREADED), 5)
    rows += peak_memory(size(MILLION))
    table = pd.DataFrame(rows, columns=COLUMNS).assign(cpu=cpu(), versions=versions(), date=now(),
                                                       commit=commit())
    write(FILE, table, head=["python -m bench.spam_speed", f"load of the machine at the start: {load:.2f}"])
    print(table[COLUMNS].to_string(index=False, float_format="%.4g", na_rep=""))
    for goal, measured, unit, met in goals(table):
        print(f"{'met' if met else 'NOT MET':8s}{goal}: {measured:.4g} {unit}")


if __name__ == "__main__":
    main()
