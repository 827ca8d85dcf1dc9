"""Dissipative particles at rest and in shear, as cases    [Groot & Warren 1997]"""
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from particles.dissipative.dpd import Dpd
from particles.dissipative.integrators import Shardlow
from particles.dissipative.observe import (
    Displacement,
    PairDistribution,
    StructureFactor,
    configurational_temperature,
    kinetic_temperature,
    momentum,
    pressure,
    shear_stress,
    waves,
)
from particles.dissipative.pairs3d import Uniform
from particles.run import Plan, run
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, combine, mean

SETTLE = 10.0       # time: some twenty times of friction, 1/(rho gamma int w^2/d) = 0.5, and of rearrangement
RECORD = 0.1        # between records: less than any correlation that counts
SEGMENT = 10.0      # of a mean square displacement; its slope is taken from the second half
BATCHES = 20
SHELLS, REACH = 60, 3.0
COST = 5e-7         # CPU seconds of a particle and step, records included


@dataclass(frozen=True, kw_only=True)
class Fluid(Case):
    """Common parameters: a periodic cube (square) of `side`, steps of dt for `time` after settling."""
    integrator: type
    dt: float = 0.02
    a: float = 25.0
    kT: float = 1.0
    rho: float = 3.0
    side: float = 10.0
    d: int = 3
    noise: type = Uniform
    time: float = 150.0
    seed: int = 1

    @property
    def label(self) -> str:
        return (f"{type(self).__name__} {self.integrator.__name__} {self.noise.__name__} {self.d}D a {self.a:g} kT {self.kT:g} "
                f"rho {self.rho:g} side {self.side:g} dt {self.dt:g}")

    @property
    def cost(self) -> float:
        return COST*self.rho*self.side**self.d*(self.time/self.dt + SETTLE/0.02)

    def method(self, rate: float = 0.0) -> Dpd:
        return Dpd(box=(self.side,)*self.d, a=self.a, kT=self.kT, noise=self.noise(self.seed), integrator=self.integrator,
                   rate=rate)

    def settled(self, method: Dpd) -> np.ndarray:
        """From anywhere: first by splitting, which knows its kT best, then for a time by the integrator itself."""
        first = replace(method, integrator=Shardlow, noise=self.noise(self.seed + 1000))
        state = run(first, first.random_start(self.rho, self.seed), Plan(dt=0.02, steps=round(SETTLE/0.02))).by_id()
        then = replace(method, noise=self.noise(self.seed + 2000))
        return run(then, state, Plan(dt=self.dt, steps=round(SETTLE/self.dt))).by_id()

    def plan(self, **more) -> Plan:
        every = max(1, round(RECORD/self.dt))
        return Plan(dt=self.dt, steps=round(self.time/self.dt/every)*every, every=every, **more)


@dataclass(frozen=True, kw_only=True)
class Rest(Fluid):
    """A fluid at rest; pairs: with its pair distribution."""
    pairs: bool = False

    def run(self, report: Report, folder: Path) -> Outcome:
        method, records = self.method(), round(SEGMENT/RECORD)
        series = {"kinetic": kinetic_temperature, "configurational": configurational_temperature, "P": pressure,
                  "drift": momentum, "msd": Displacement(records)}
        if not self.a:
            del series["configurational"]       # no force, no temperature of positions
        plan = self.plan(series=series, means={"g": PairDistribution(SHELLS, REACH)} if self.pairs else {})
        start = self.settled(method)
        done = run(method, start, plan, report)
        row = {"integrator": self.integrator.__name__, "noise": self.noise.__name__, "d": self.d, "a": self.a, "kT": self.kT,
               "rho": start.shape[1]/method.volume, "side": self.side, "dt": self.dt, "n": start.shape[1], "time": self.time,
               "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s, "drift": max(done.series["drift"])}
        measured: dict[str, Measured] = {name: mean(done.series[name]) for name in ("kinetic", "configurational", "P")
                                         if name in series}
        measured["D"] = diffusion(np.array(done.series["msd"]), np.array(done.times), records, self.d)
        for name, (value, err) in measured.items():
            row |= {name: value, f"{name}_err": err}
        r = (np.arange(SHELLS) + 0.5)*REACH/SHELLS
        shells = [{"a": self.a, "rho": row["rho"], "r": x, "g": g} for x, g in zip(r, done.means["g"])] if self.pairs else []
        return Outcome({"states": [row], "pairs": shells})


def diffusion(msd: np.ndarray, times: np.ndarray, records: int, d: int) -> Measured:
    """D from the rise of the mean square displacement over the second half of each segment; error from segments' scatter.

    Nothing if two segments do not fit.
    """
    found: list[tuple[float, float]] = []
    if len(msd) < 2*records:
        return Measured(np.nan, np.nan)
    for start in range(0, len(msd) - records + 1, records):
        middle, end = start + records//2, start + records - 1
        found.append((float((msd[end] - msd[middle])/(times[end] - times[middle])/(2*d)), 0.0))
    return combine(found)


@dataclass(frozen=True, kw_only=True)
class Shear(Fluid):
    """A fluid between sliding sides [Lees & Edwards 1972]."""
    rate: float

    @property
    def label(self) -> str:
        return f"{super().label} rate {self.rate:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = self.method(self.rate)
        start, plan = self.settled(method), self.plan(series={"kinetic": kinetic_temperature, "stress": shear_stress})
        done = run(method, start, plan, report)
        # a run begins with images that have not slid: what that disturbs is left out, too
        (stress, err), (kinetic, kinetic_err) = (mean(done.series[name][round(SETTLE/RECORD):]) for name in ("stress", "kinetic"))
        return Outcome({"dpd_shear": [{
            "integrator": self.integrator.__name__, "a": self.a, "rho": start.shape[1]/method.volume, "side": self.side,
            "dt": self.dt, "rate": self.rate, "n": start.shape[1], "time": self.time - SETTLE, "stress": stress,
            "stress_err": err, "viscosity": stress/self.rate, "viscosity_err": err/self.rate, "kinetic": kinetic,
            "kinetic_err": kinetic_err, "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}]})


@dataclass(frozen=True, kw_only=True)
class Structure(Fluid):
    """Structure factor of long waves, in batches that each last some times of their decay."""
    most: int = 5

    def run(self, report: Report, folder: Path) -> Outcome:
        method = self.method()
        state, every = self.settled(method), round(5*RECORD/self.dt)
        found, cpu_s = [], 0.0
        for batch in range(BATCHES):
            plan = Plan(dt=self.dt, steps=round(self.time/BATCHES/self.dt), every=every, means={"S": StructureFactor(self.most)})
            # a seed of its own: the noise of a run begins anew
            done = run(replace(method, noise=self.noise(self.seed + 3000 + batch)), state, plan)
            state, cpu_s = done.by_id(), cpu_s + done.cpu_s
            found.append(done.means["S"])
            report((batch + 1)/BATCHES)
        _, squares = waves(self.d, self.most)
        rows = []
        for n2, values in zip(squares, np.array(found).T, strict=True):
            S, err = combine([(value, 0.0) for value in values])
            rows.append({"a": self.a, "rho": state.shape[1]/method.volume, "side": self.side, "n2": int(n2),
                         "k": 2*np.pi*np.sqrt(n2)/self.side, "S": S, "S_err": err, "batches": BATCHES, "seed": self.seed})
        return Outcome({"structure": rows})
