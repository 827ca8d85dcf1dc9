"""Dissipative particles: kT and pressure, a cylinder of frozen ones, the special case    [RR98 Sec. III B]

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
    pressure,
    shear_stress,
)
from particles.dissipative.pairs3d import Uniform
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.noise import uniform_of_pair
from particles.run import Plan, Run, run
from particles.threads import Threads
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured, mean

RHO = 3.0
SETTLE = 10.0       # time: some twenty times of friction, 1/(rho gamma int w^2/d) = 0.5, and of rearrangement
RECORD = 0.1        # between records: less than any correlation that counts


@dataclass(frozen=True, kw_only=True)
class Fluid(Case):
    """Common parameters: a periodic cube of `side`, steps of dt for `time` after settling."""
    integrator: type
    dt: float = 0.02
    side: float = 8.0
    time: float
    seed: int = 1

    @property
    def cost(self) -> float:
        steps = self.time/self.dt + SETTLE/0.02
        return 5e-7*RHO*self.side**3*steps      # records included

    def method(self, rate: float = 0.0) -> Dpd:
        """Particles in the cube, sheared at some rate."""
        return Dpd(box=(self.side,)*3, noise=Uniform(self.seed), integrator=self.integrator, rate=rate)

    def settled(self, method: Dpd) -> np.ndarray:
        """From anywhere: first by splitting, which knows its kT best, then by the integrator itself."""
        first = replace(method, integrator=Shardlow, noise=Uniform(self.seed + 1000))
        start = first.random_start(RHO, self.seed)
        state = run(first, start, Plan(dt=0.02, steps=round(SETTLE/0.02))).by_id()
        then = replace(method, noise=Uniform(self.seed + 2000))
        return run(then, state, Plan(dt=self.dt, steps=round(SETTLE/self.dt))).by_id()

    def recorded(self, method: Dpd, report: Report, **series: Callable) -> Run:
        """A run of the settled fluid with records every `RECORD`."""
        every = max(1, round(RECORD/self.dt))
        records = round(self.time/self.dt/every)
        plan = Plan(dt=self.dt, steps=records*every, every=every, series=series)
        return run(method, self.settled(method), plan, report)

    def row(self, done: Run, **measured: Measured) -> dict[str, Any]:
        """What a run is of, what it cost, and means with their errors."""
        row: dict[str, Any] = {
            "integrator": self.integrator.__name__, "side": self.side, "dt": self.dt,
            "n": done.state.shape[1], "time": self.time, "seed": self.seed, "cpu_s": done.cpu_s,
            "compile_s": done.compile_s}
        for name, (value, err) in measured.items():
            row |= {name: value, f"{name}_err": err}
        return row


@dataclass(frozen=True, kw_only=True)
class AtRest(Fluid):
    """kT of velocities and of positions, pressure."""

    def run(self, report: Report, folder: Path) -> Outcome:
        done = self.recorded(self.method(), report, kinetic=kinetic_temperature, P=pressure,
                             configurational=configurational_temperature)
        means = {name: mean(x) for name, x in done.series.items()}
        return Outcome({"states": [self.row(done, **means)]})


@dataclass(frozen=True, kw_only=True)
class LongRun(Fluid):
    """The same for a long time; the configurational kT is one ratio of means, which is not off by 1/n.

    The pressure has rho kT with the kT that is asked for, as that of Allen & Tildesley has.
    """

    def run(self, report: Report, folder: Path) -> Outcome:
        method = self.method()
        done = self.recorded(method, report, kinetic=kinetic_temperature, F2=forces_squared, lap=laplacian,
                             P=pressure)
        kinetic, F2, lap, P = map(np.array, done.series.values())
        ratio = F2.mean()/lap.mean()
        error = mean((F2 - ratio*lap)/lap.mean()).err
        rho = done.state.shape[1]/method.volume
        asked = P - rho*(kinetic - method.kT)
        row = self.row(done, kinetic=mean(kinetic), configurational=Measured(ratio, error), P=mean(asked))
        return Outcome({"long": [row]})


@dataclass(frozen=True, kw_only=True)
class Shear(Fluid):
    """Stress over rate of a fluid between sliding sides [Lees & Edwards 1972]."""
    rate: float

    def run(self, report: Report, folder: Path) -> Outcome:
        done = self.recorded(self.method(self.rate), report, kinetic=kinetic_temperature, stress=shear_stress)
        # a run begins with images that have not slid: what that disturbs is left out, too
        kinetic, stress = (mean(x[round(SETTLE/RECORD):]) for x in done.series.values())
        row = self.row(done, viscosity=stress/self.rate, kinetic=kinetic)
        return Outcome({"shear": [{**row, "rate": self.rate, "time": self.time - SETTLE}]})


# --- a cylinder of frozen particles -----------------------------------------------------------

FRACTION, RADIUS, DEPTH = 0.2, 2.0, 4.0     # solid fraction of a square array, radius, depth of the box
CELL = RADIUS*float(np.sqrt(np.pi/FRACTION))
REYNOLDS, ETA = 2.0, 0.85                   # about, for the push
STEADY = 100.0      # time until the stream is steady: ten times mass over drag, and what enters has entered
BINS = np.linspace(-CELL/2, CELL/2, 17)


@dataclass(frozen=True, kw_only=True)
class Cylinder(Fluid):
    """A stream past a cylinder across the box, in a square array.

    Those of the particles of a settled fluid that are in the cylinder are frozen. The force is on what is
    free, as a mean pressure gradient would be.
    """
    integrator: type = VelocityVerlet
    dt: float = 0.04

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.stream()
        every = round(1/self.dt)        # about what sound needs across the cell
        plan = Plan(dt=self.dt, steps=round(self.time)*every, every=every, means={"flow": flow},
                    series={"speed": speed, "force": force_on_body})
        # a seed of its own: the noise of a run begins anew
        done = run(replace(method, noise=Uniform(self.seed + 3000)), start, plan, report)
        U = mean(done.series["speed"])
        stream = self.row(done, speed=U)
        stream |= {"side": CELL, "held": len(method.held), "force": float(np.mean(done.series["force"]))}
        return Outcome({"cylinder": [stream], "flow": list(velocities(done.means["flow"], U.value))})

    def stream(self) -> tuple[DpdStream, np.ndarray]:
        """The method, and the steady stream (9, n)."""
        still = replace(self.method(), box=(CELL, CELL, DEPTH))
        state = self.settled(still)
        U = REYNOLDS*ETA/(2*RADIUS*RHO)
        drag = drag_of(FRACTION).value*ETA*U*DEPTH
        x, y = in_cell(still.fields(state).x).T
        held = np.flatnonzero(x**2 + y**2 < RADIUS**2)
        method = DpdStream(box=still.box, noise=still.noise, integrator=self.integrator, held=held,
                           push=drag/state.shape[1])
        plan = Plan(dt=self.dt, steps=round(STEADY/self.dt))
        return method, run(method, method.at_rest(state, U), plan).by_id()


def in_cell(x: np.ndarray) -> np.ndarray:
    """Coordinates (n, 2) across the cylinder in its cell of places x (n, 3)."""
    return x[:, :2] - CELL*np.round(x[:, :2]/CELL)


def flow(sums: Any, state: np.ndarray) -> np.ndarray:
    """Momentum along x, y and particles in squares of the cell (3, bins, bins)."""
    fields = sums.method.fields(state)
    x, y = in_cell(fields.x).T
    weights = (*fields.v.T[:2], np.ones_like(x))
    return np.array([np.histogram2d(x, y, bins=[BINS, BINS], weights=w)[0] for w in weights])


def velocities(flow: np.ndarray, U: float) -> Iterator[dict[str, float]]:
    """Rows of the mean field, over the mean velocity U; nan where there never was a particle."""
    *p, count = flow
    u, v = p/np.where(count > 0, count, np.nan)/U
    at = (BINS[1:] + BINS[:-1])/2/RADIUS
    x, y = np.meshgrid(at, at, indexing="ij")
    for values in zip(x.flat, y.flat, u.flat, v.flat):
        yield dict(zip(("x", "y", "u", "v"), map(float, values)))


# --- a special case of Eqs 42, 49, 51 -----------------------------------------------------------


def form() -> float:
    """Largest difference between the forces that run and RR98's, over the largest; 2D and 3D."""
    return max(special(d) for d in (2, 3))


def special(d: int, dt: float = 0.02) -> float:
    """The same in d dimensions, with the noise of the first step.

    Eq. 49 with Eq. 51, B = 0, and the zeta term of Eq. 42 beside it, its brackets doubled as in Eq. 35, is

        force on i = sum_j w e_ij [P_ij - A e.(v_i - v_j) - 2 sqrt(2 kT zeta V/dt) Y_ij],    W dV = w

    With w = 1 - r/rc, A = gamma w, 8 zeta V = 2 gamma these are Groot and Warren's; Y and -Y are alike.
    """
    method = Dpd(box=(3.5,)*d)
    state, w, e = neighbours(method)
    x, v, _ = np.split(state, 3)
    n = x.shape[1]
    sums, forces = method.start(n, Threads(1)), np.empty_like(x)
    sums.resume(Run(state=state, ids=np.arange(n)))
    sums.dt = dt
    sums.forces(x, v, 0.0, forces)
    gamma, zeta, seed = method.gamma, method.gamma/4, method.noise.seed     # zeta times V
    Y = [[uniform_of_pair(seed, 1, i, j) for j in range(n)] for i in range(n)]
    u = v[:, :, None] - v[:, None, :]
    along = (e*u).sum(axis=0)
    noise = np.sqrt(8*method.kT*zeta/dt)*np.array(Y)
    due = (w*e*(method.a - gamma*w*along + noise)).sum(axis=2)
    return float(np.abs(forces - due).max()/np.abs(due).max())


def neighbours(method: Dpd) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A random state (3 d, n), weights w (n, n) by nearest images, unit vectors e_ij (d, n, n)."""
    state, box = method.random_start(RHO), np.array(method.box)[:, None, None]
    x, rc = state[:method.d], method.rc
    apart = x[:, :, None] - x[:, None, :]
    apart -= box*np.round(apart/box)
    r = np.sqrt((apart**2).sum(axis=0))
    np.fill_diagonal(r, 2*rc)           # no particle is its own neighbour
    return state, np.maximum(1 - r/rc, 0), apart/r


def unmodified() -> float:
    """|Q - 2 kT Gamma|/|Q|, friction of the weight of the noise, not its square, as much energy in all."""
    _, w, e = neighbours(Dpd(box=(3.0, 3.0, 3.0)))
    Q, friction = blocks(w**2, e), blocks(w, e)
    due = friction*np.trace(Q)/np.trace(friction)
    return float(np.abs(Q - due).max()/np.abs(Q).max())


def blocks(weight: np.ndarray, e: np.ndarray) -> np.ndarray:
    """(d n, d n) of forces weight e e.(v_i - v_j) between the points of each pair."""
    d, n = e.shape[:2]
    pairs = weight*e[:, None]*e[None]                       # (d, d, n, n)
    own = pairs.sum(axis=3)[..., None]*np.eye(n)
    return (own - pairs).transpose(0, 2, 1, 3).reshape(d*n, d*n)
