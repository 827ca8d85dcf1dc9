"""Dissipative particles: kT and pressure at rest, viscosity in shear, a cylinder of frozen ones

The fluid has a = 25, rho = 3, gamma = 4.5, rc = kT = 1, unit masses, in a periodic cube.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.cylinder import drag_of
from particles.dissipative.dpd import Dpd
from particles.dissipative.integrators import Shardlow, VelocityVerlet
from particles.dissipative.observe import (
    configurational_temperature,
    forces_squared,
    kinetic_temperature,
    laplacian,
    momentum,
    pressure,
    shear_stress,
)
from particles.dissipative.pairs3d import Uniform
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.run import Plan, Run, run
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, mean

SETTLE = 10.0       # time: some twenty times of friction, 1/(rho gamma int w^2/d) = 0.5, and of rearrangement
RECORD = 0.1        # between records: less than any correlation that counts
COST = 5e-7         # CPU seconds of a particle and step, records included


@dataclass(frozen=True, kw_only=True)
class Fluid(Case):
    """Common parameters: a periodic cube of `side`, steps of dt for `time` after settling."""
    integrator: type
    dt: float = 0.02
    a: float = 25.0
    kT: float = 1.0
    rho: float = 3.0
    side: float = 8.0
    time: float
    seed: int = 1

    @property
    def label(self) -> str:
        name = f"{type(self).__name__} {self.integrator.__name__}"
        return f"{name} a {self.a:g} side {self.side:g} dt {self.dt:g}"

    @property
    def cost(self) -> float:
        return COST*self.rho*self.side**3*(self.time/self.dt + SETTLE/0.02)

    def method(self, rate: float = 0.0) -> Dpd:
        """Particles in the cube, sheared at some rate."""
        return Dpd(box=(self.side,)*3, a=self.a, kT=self.kT, noise=Uniform(self.seed),
                   integrator=self.integrator, rate=rate)

    def settled(self, method: Dpd) -> np.ndarray:
        """From anywhere: first by splitting, which knows its kT best, then by the integrator itself."""
        first = replace(method, integrator=Shardlow, noise=Uniform(self.seed + 1000))
        start = first.random_start(self.rho, self.seed)
        state = run(first, start, Plan(dt=0.02, steps=round(SETTLE/0.02))).by_id()
        then = replace(method, noise=Uniform(self.seed + 2000))
        return run(then, state, Plan(dt=self.dt, steps=round(SETTLE/self.dt))).by_id()

    def plan(self, **more: Any) -> Plan:
        """Records every `RECORD`."""
        every = max(1, round(RECORD/self.dt))
        return Plan(dt=self.dt, steps=round(self.time/self.dt/every)*every, every=every, **more)

    def row(self, done: Run, **measured: Measured) -> dict[str, Any]:
        """What a run is of, what it cost, and means with their errors."""
        n = done.state.shape[1]
        row: dict[str, Any] = {
            "integrator": self.integrator.__name__, "a": self.a, "side": self.side, "dt": self.dt, "n": n,
            "time": self.time, "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        for name, (value, err) in measured.items():
            row |= {name: value, f"{name}_err": err}
        return row


@dataclass(frozen=True, kw_only=True)
class AtRest(Fluid):
    """kT of velocities and of positions, pressure; drift: the largest mean velocity."""

    def run(self, report: Report, folder: Path) -> Outcome:
        series: dict[str, Callable] = {"kinetic": kinetic_temperature, "P": pressure, "drift": momentum}
        if self.a:      # without a force positions have no temperature
            series["configurational"] = configurational_temperature
        method = self.method()
        done = run(method, self.settled(method), self.plan(series=series), report)
        drift = max(done.series["drift"])
        means = {name: mean(done.series[name]) for name in series if name != "drift"}
        return Outcome({"states": [{**self.row(done, **means), "drift": drift}]})


@dataclass(frozen=True, kw_only=True)
class LongRun(Fluid):
    """The same for a long time, without the noise of two readings.

    The configurational kT is one ratio of means, which is not off by 1/n; the pressure has rho kT with the kT
    that is asked for, as that of Allen & Tildesley has.
    """

    def run(self, report: Report, folder: Path) -> Outcome:
        series: dict[str, Callable] = {"kinetic": kinetic_temperature, "F2": forces_squared,
                                       "lap": laplacian, "P": pressure}
        method = self.method()
        done = run(method, self.settled(method), self.plan(series=series), report)
        kinetic, F2, lap, P = (np.array(done.series[name]) for name in series)
        ratio, rho = F2.mean()/lap.mean(), done.state.shape[1]/method.volume
        configurational = Measured(ratio, mean((F2 - ratio*lap)/lap.mean()).err)
        means = {"kinetic": mean(kinetic), "configurational": configurational,
                 "P": mean(P - rho*(kinetic - self.kT))}
        return Outcome({"long": [self.row(done, **means)]})


@dataclass(frozen=True, kw_only=True)
class Shear(Fluid):
    """Stress over rate of a fluid between sliding sides [Lees & Edwards 1972]."""
    rate: float

    def run(self, report: Report, folder: Path) -> Outcome:
        method = self.method(self.rate)
        plan = self.plan(series={"kinetic": kinetic_temperature, "stress": shear_stress})
        done = run(method, self.settled(method), plan, report)
        # a run begins with images that have not slid: what that disturbs is left out, too
        kinetic, stress = (mean(done.series[name][round(SETTLE/RECORD):]) for name in ("kinetic", "stress"))
        means = {"viscosity": Measured(*stress)/self.rate, "kinetic": kinetic}
        row = {**self.row(done, **means), "rate": self.rate, "time": self.time - SETTLE}
        return Outcome({"shear": [row]})


# --- a cylinder of frozen particles -----------------------------------------------------------


FRACTION, RADIUS, DEPTH = 0.2, 2.0, 4.0     # solid fraction of a square array, radius, depth of the box
CELL = RADIUS*float(np.sqrt(np.pi/FRACTION))
BODY = np.pi*RADIUS**2*DEPTH
REYNOLDS, ETA = 2.0, 0.85                   # about, for the push
STEADY = 100.0      # time until the stream is steady: ten times mass over drag, and what enters has entered
BINS = 16


@dataclass(frozen=True, kw_only=True)
class Cylinder(Fluid):
    """A stream past a cylinder across the box, in a square array.

    A settled fluid fills the box; those of its particles that are in the cylinder are frozen, which leaves
    the structure as it was. The force is on what is free, as a mean pressure gradient would be.
    """
    integrator: type = VelocityVerlet
    dt: float = 0.04

    @property
    def cost(self) -> float:
        return 1e-6*self.rho*CELL**2*DEPTH*(self.time + STEADY)/self.dt

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.stream()
        every = round(1/self.dt)        # about what sound needs across the cell
        series = {"speed": speed, "force": force_on_body, "inside": free_inside}
        steps, means = round(self.time)*every, {"flow": flow}
        plan = Plan(dt=self.dt, steps=steps, every=every, series=series, means=means)
        # a seed of its own: the noise of a run begins anew
        done = run(replace(method, noise=Uniform(self.seed + 3000)), start, plan, report)
        free = done.state.shape[1] - len(method.held)
        inside = float(np.mean(done.series["inside"]))
        force = float(np.mean(done.series["force"]))
        numbers = {"side": CELL, "held": len(method.held), "push": method.push, "force": force,
                   "inside": inside/BODY, "fluid": (free - inside)/(method.volume - BODY)}
        stream = {**self.row(done, speed=mean(done.series["speed"])), **numbers}
        return Outcome({"cylinder": [stream], "flow": list(self.velocities(done, stream["speed"]))})

    def stream(self) -> tuple[DpdStream, np.ndarray]:
        """The method, and the steady stream (9, n)."""
        still = replace(self.method(), box=(CELL, CELL, DEPTH))
        state = self.settled(still)
        U = REYNOLDS*ETA/(2*RADIUS*self.rho)
        drag = drag_of(FRACTION).value*ETA*U*DEPTH
        method = DpdStream(box=still.box, a=self.a, kT=self.kT, noise=still.noise, integrator=self.integrator,
                           held=np.flatnonzero(is_inside(still.fields(state).x)), push=drag/state.shape[1])
        plan = Plan(dt=self.dt, steps=round(STEADY/self.dt))
        return method, run(method, method.at_rest(state, U), plan).by_id()

    def velocities(self, done: Run, U: float) -> Iterator[dict[str, float]]:
        """Rows of the mean field, over the mean velocity; nan where there never was a particle."""
        px, py, count = done.means["flow"]
        mass = np.where(count > 0, count, np.nan)*U
        at = ((np.arange(BINS) + 0.5)/BINS - 0.5)*CELL/RADIUS
        for i, j in np.ndindex(BINS, BINS):
            u, v = px[i, j]/mass[i, j], py[i, j]/mass[i, j]
            yield {"x": float(at[i]), "y": float(at[j]), "u": u, "v": v}


def across(x: np.ndarray) -> np.ndarray:
    """Coordinates (n, 2) across the cylinder in its cell of places x (n, 3)."""
    return x[:, :2] - CELL*np.round(x[:, :2]/CELL)


def is_inside(x: np.ndarray) -> np.ndarray:
    """Which of the places x (n, 3) are in a cylinder about the middle of each cell."""
    return (across(x)**2).sum(axis=1) < RADIUS**2


def free_inside(sums: Any, state: np.ndarray) -> float:
    """Free particles in the cylinder."""
    return float((is_inside(sums.method.fields(state).x) & ~sums.is_held[sums.now.ids]).sum())


def flow(sums: Any, state: np.ndarray) -> np.ndarray:
    """Momentum along x, y and particles in squares of the cell (3, BINS, BINS)."""
    fields = sums.method.fields(state)
    x, y = across(fields.x).T
    edges = np.linspace(-CELL/2, CELL/2, BINS + 1)
    weights = (*fields.v.T[:2], np.ones_like(x))
    return np.array([np.histogram2d(x, y, bins=[edges, edges], weights=w)[0] for w in weights])
