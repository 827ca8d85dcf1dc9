"""Dissipative particles: kT, pressure, and whether RR98's equations contain them    [RR98 Sec. III B]

The fluid has a = 25, rho = 3, gamma = 4.5, rc = kT = 1, unit masses, in a periodic box.
"""
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from particles.dissipative.dpd import (
    Dpd,
    configurational_temperature,
    forces_squared,
    kinetic_temperature,
    laplacian,
    pressure,
)
from particles.dissipative.integrators import Shardlow
from particles.noise import uniform_of_pair
from particles.run import Plan, Run, run
from particles.threads import Threads
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, mean, with_errors
from studies.kit.table import Row

RHO = 3.0
SETTLE = 10.0       # some twenty friction times, 1/(rho gamma int w^2/d) = 0.5, and of rearrangement
RECORD = 0.1        # time between records: less than any correlation time that matters


class AtRest(Case, table="states", same="integrator side dt time seed"):
    """kT and pressure of particles in a cube at one time step, from a run that settles before."""
    integrator: type
    dt: float = 0.02
    side: float = 8.0
    time: float
    seed: int = 1

    @property
    def cost(self) -> float:
        steps = self.time/self.dt + SETTLE/0.02
        return 5e-7*RHO*self.side**3*steps      # records included

    def measure(self, report: Report) -> Iterator[Row]:
        done = self.recorded(report, kinetic=kinetic_temperature, P=pressure,
                             configurational=configurational_temperature)
        yield row(done, **{name: mean(x) for name, x in done.series.items()})

    def recorded(self, report: Report, **series: Callable) -> Run:
        """A run of the settled fluid with records every `RECORD`."""
        method = Dpd(box=(self.side,)*3, seed=self.seed, integrator=self.integrator)
        every = max(1, round(RECORD/self.dt))
        records = round(self.time/self.dt/every)
        plan = Plan(dt=self.dt, steps=records*every, every=every, series=series)
        return run(method, self.settled(method), plan, report)

    def settled(self, method: Dpd) -> np.ndarray:
        """Equilibrated state from random places, first with Shardlow's splitting, whose kT is most exact."""
        first = replace(method, integrator=Shardlow, seed=self.seed + 1000)
        start = first.random_start(RHO, self.seed)
        state = run(first, start, Plan(dt=0.02, steps=round(SETTLE/0.02))).by_id()
        then = replace(method, seed=self.seed + 2000)
        return run(then, state, Plan(dt=self.dt, steps=round(SETTLE/self.dt))).by_id()


class LongRun(AtRest, table="long"):
    """The same from a long run; configurational kT is a ratio of means, which has no bias of 1/n.

    The pressure contains rho kT with the given kT, 1, as in Allen & Tildesley, not with the measured one.
    """

    def measure(self, report: Report) -> Iterator[Row]:
        done = self.recorded(report, kinetic=kinetic_temperature, F2=forces_squared, lap=laplacian,
                             P=pressure)
        kinetic, F2, lap, P = map(np.array, done.series.values())
        ratio = F2.mean()/lap.mean()
        error = mean((F2 - ratio*lap)/lap.mean()).err
        rho = done.state.shape[1]/self.side**3
        yield row(done, kinetic=mean(kinetic), configurational=Measured(ratio, error),
                  P=mean(P - rho*(kinetic - 1)))


def row(done: Run, **measured: Measured) -> Row:
    """Columns with the CPU time of a run, and means with their errors."""
    return {"n": done.state.shape[1], "cpu_s": done.cpu_s, "compile_s": done.compile_s,
            **with_errors(**measured)}


# --- a special case of Eqs 42, 49, 51 -----------------------------------------------------------


def form() -> float:
    """Largest difference of the compiled forces from RR98's, over the largest force; in 2D and 3D."""
    return max(special(d) for d in (2, 3))


def special(d: int, dt: float = 0.02) -> float:
    """The same in d dimensions, with the noise of the first step.

    Eq. 49 with Eq. 51, B = 0, and the zeta term of Eq. 42, its brackets doubled as in Eq. 35, is

        force on i = sum_j w e_ij [P_ij - A e.(v_i - v_j) - 2 sqrt(2 kT zeta V/dt) Y_ij],    W dV = w

    With w = 1 - r/rc, A = gamma w, 8 zeta V = 2 gamma it is Groot and Warren's; the sign of Y is arbitrary.
    """
    method = Dpd(box=(3.5,)*d)
    state = method.random_start(RHO)
    x, v, _ = np.split(state, 3)
    w, e = neighbours(x, method.box)
    n = x.shape[1]
    sums, forces = method.start(n, Threads(1)), np.empty_like(x)
    sums.resume(Run(state=state, ids=np.arange(n)))
    sums.dt = dt
    sums.forces(x, v, forces)
    gamma, zeta, seed = method.gamma, method.gamma/4, method.seed     # zeta times V
    Y = [[uniform_of_pair(seed, 1, i, j) for j in range(n)] for i in range(n)]
    along = (e*(v[:, :, None] - v[:, None, :])).sum(axis=0)
    noise = np.sqrt(8*method.kT*zeta/dt)*np.array(Y)
    due = (w*e*(method.a - gamma*w*along + noise)).sum(axis=2)
    return float(np.abs(forces - due).max()/np.abs(due).max())


def neighbours(x: np.ndarray, box: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Weights w (n, n) and unit vectors e_ij (d, n, n) of particles at x (d, n), by their nearest images."""
    sides = np.array(box)[:, None, None]
    apart = x[:, :, None] - x[:, None, :]
    apart -= sides*np.round(apart/sides)
    r = np.sqrt((apart**2).sum(axis=0))
    np.fill_diagonal(r, 2)           # no particle is its own neighbour
    return np.maximum(1 - r, 0), apart/r


def unmodified() -> float:
    """|Q - 2 kT Gamma|/|Q| where friction has the weight w of the noise, not w^2, and the same trace as Q."""
    method = Dpd(box=(3.0, 3.0, 3.0))
    w, e = neighbours(method.random_start(RHO)[:3], method.box)
    Q, friction = blocks(w**2, e), blocks(w, e)
    due = friction*np.trace(Q)/np.trace(friction)
    return float(np.abs(Q - due).max()/np.abs(Q).max())


def blocks(weight: np.ndarray, e: np.ndarray) -> np.ndarray:
    """Matrix (d n, d n) of the pair forces weight e e.(v_i - v_j)."""
    d, n = e.shape[:2]
    pairs = weight*e[:, None]*e[None]                       # (d, d, n, n)
    own = pairs.sum(axis=3)[..., None]*np.eye(n)
    return (own - pairs).transpose(0, 2, 1, 3).reshape(d*n, d*n)
