"""Long runs from random starts, with the sums that should be conserved; runs in numpy in 1D to 3D."""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import fsum
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas, energy, pressure
from particles.fields import Fields
from particles.integral.dih import Dih, Pairwise
from particles.integral.edge_makers import exact
from particles.integral.points import Points
from particles.integrators import RK4
from particles.threads import Threads
from particles.weights import Lucy
from studies.build.setting import DISORDERS
from studies.kit.case import Case, Report
from studies.kit.table import Row

ROUND_OFF = 2.2e-16     # of a sum: its terms are rounded twice, adding them up is exact
HARMONICS = 2           # highest wave number of random fields, in waves per box
RECORDS = 20            # number of times that sums of a run are recorded
WIND = 0.1, -0.05, 0.02
OF_LIMIT = 0.5          # time step over its stability limit
EVERYTHING = "mass momentum energy"
ETA, ZETA, SIZE = 0.1, 0.05, 0.1
LOOKS = 100             # number of records of runs that lose momentum

#: (state, steps) -> the state after these steps, and how many were done
Advance = Callable[[np.ndarray, int], tuple[np.ndarray, int]]


def smooth(points: Points, size: float, rng: np.random.Generator) -> np.ndarray:
    """A random field (n,) of rms `size`: long waves with random amplitudes and phases."""
    numbers = np.arange(-HARMONICS, HARMONICS + 1)
    grids = np.meshgrid(*[numbers]*points.d)
    turns = np.stack([grid.ravel() for grid in grids], axis=1)
    turns = turns[np.any(turns != 0, axis=1)]
    start = rng.uniform(0, 2*np.pi, len(turns))
    phase = 2*np.pi*(points.x/points.box)@turns.T + start
    heights = rng.normal(size=len(turns))
    return size*np.sqrt(2/len(turns))*np.cos(phase)@heights


def random_fields(points: Points, size: float, seed: int,
                  plates: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """rho (n,), v (n, d) with mean WIND (only along the plates, if any), T (n,)."""
    rng = np.random.default_rng(seed)
    rho, T, *v = (smooth(points, size, rng) for _ in range(2 + points.d))
    wind = np.array(WIND[:points.d])
    if plates:
        wind[1:] = 0
    return 1 + rho, np.stack(v, axis=1) + wind, 1 + T


def exact_sums(V: np.ndarray, state: np.ndarray) -> np.ndarray:
    """Sums of V times each row, added up without rounding."""
    return np.array([fsum(V*row) for row in state])


def sizes(eos: Any, fields: Fields) -> np.ndarray:
    """Scales of relative changes: mass, sum of |momentum| for each direction, energy."""
    m = fields.rho*fields.V
    squares = (fields.v**2).sum(axis=1)
    momentum = m@np.sqrt(squares)
    total = m@(energy(eos, fields.rho, fields.T) + squares/2)
    return np.array([m.sum(), *[momentum]*fields.v.shape[1], total])


class WatchedRun(Case, same="scheme mode maker weight h points wall zeta seed steps claimed"):
    """A long run from a random start. Each kind gives its columns; `claimed`: sums that it has to keep."""
    steps: int = 10_000
    seed: int = 1
    zeta = 0.0

    def watched(self, advance: Advance, state: np.ndarray, totals: Callable[[np.ndarray], np.ndarray],
                sizes: np.ndarray, report: Report, records: int = RECORDS) -> Iterator[Row]:
        """Run; the row has the largest changes of mass, momentum, energy over their sizes."""
        first, worst = totals(state), np.zeros(len(sizes))

        def look(now: np.ndarray) -> None:
            np.maximum(worst, np.abs(totals(now) - first)/sizes, out=worst)
        reached = in_parts(advance, state, self.steps, look, report, records)
        mass, *momentum, total = worst
        yield {"n": state.shape[1], "reached": reached, "mass": mass, "momentum": max(momentum),
                "energy": total, "d": len(momentum), "err": ROUND_OFF}


def in_parts(advance: Advance, state: np.ndarray, steps: int, look: Callable[[np.ndarray], None],
             report: Report, records: int) -> int:
    """Advance in `records` equal parts, with look(state) after each; returns the number of steps done."""
    before = 0
    for part in range(1, records + 1):
        number = steps*part//records - before
        state, done = advance(state, number)
        if done < number:
            return before + done
        look(state)
        before += number
        report(before/steps)
    return steps


def in_numpy(method: Any, first: np.ndarray, dt: float, integrator: Any = RK4) -> Advance:
    """Steps of a scheme in numpy, in place, until the run diverges."""
    stepper = integrator(first.shape, Threads(1))

    def advance(state: np.ndarray, steps: int) -> tuple[np.ndarray, int]:
        for step in range(steps):
            try:
                stepper.step(method, state, dt)
            except FloatingPointError:
                return state, step
        return state, steps
    return advance


# --- one to three dimensions [RR98 Eqs 34-38] -------------------------------------------------------


class SmallBox(NamedTuple):
    """Number of points along each axis, range of the weight, CPU seconds per step."""
    counts: tuple[int, ...]
    h: float
    cost: float


LINE, SQUARE = SmallBox((32,), 3.0, 5e-4), SmallBox((6, 6), 2.8, 1.5e-3)
CUBE = SmallBox((4, 4, 4), 1.9, 1.5e-3)
SHIFTED = DISORDERS["jittered-0.1"]


class DihDrift(WatchedRun, table="drift"):
    """Long run on jittered points with exact edges. transport : of `dih`, mode : its name."""
    mode: str
    transport: Any
    box: SmallBox
    scheme, maker, weight, points, wall = "dih", "exact", Lucy, SHIFTED, "periodic"
    zeta, claimed = ZETA, EVERYTHING
    kind: ClassVar[type[Dih]] = Dih

    @property
    def cost(self) -> float:
        return self.steps*self.box.cost

    @property
    def h(self) -> float:
        return self.box.h

    def begun(self) -> tuple[Dih, np.ndarray, Advance]:
        """The fluid, its random start, and the function that advances it with RK4."""
        points = SHIFTED.make(self.box.counts, SHIFTED.size, self.seed)
        fluid = self.kind(edges=exact(points, Lucy.of(h=self.h, d=points.d)), eos=IdealGas(),
                          law=ConstEta(ETA, ETA), zeta=ZETA, transport=self.transport)
        state = fluid.state(*random_fields(points, SIZE, self.seed))
        return fluid, state, in_numpy(fluid, state, OF_LIMIT*step_limit(fluid, state))

    def measure(self, report: Report) -> Iterator[Row]:
        fluid, state, advance = self.begun()
        return self.watched(advance, state, lambda now: exact_sums(fluid.edges.V, now),
                            sizes(fluid.eos, fluid.fields(state)), report)


def step_limit(fluid: Dih, state: np.ndarray) -> float:
    """Stable step of RK4, from the fastest sound and fastest diffusion over the edges, at extreme fields."""
    flow = fluid.flow(state)
    sound, spread = fluid.edges.fastest
    fast = np.sqrt(2*flow.T.max()) + np.sqrt((flow.v**2).sum(axis=1)).max()
    nu = (2*ETA + fluid.zeta)/flow.rho.min()
    return float(1/(fast*sound/2.82 + nu*spread/2.78))


@dataclass(frozen=True, kw_only=True)
class OneSided(Dih):
    """A pressure not symmetric in ij: 2 P_ij acts on the first point of an edge, 2 P_ji on the second."""

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """Write d(state)/dt to `out`: P_ij - P_ji is added to the force on both points with the same sign."""
        super().rates(state, out)
        flow, edges = self.flow(state), self.edges
        rho, T, i, j = flow.rho, flow.T, edges.i, edges.j
        P_ij = pressure(self.eos, rho[i], energy(self.eos, rho[i], T[j]))
        P_ji = pressure(self.eos, rho[j], energy(self.eos, rho[j], T[i]))
        more = (P_ij - P_ji)[:, None]*(edges.S/2)
        for row, flux in zip(out[1:-1], more.T, strict=True):
            row -= (np.bincount(i, flux, edges.n) + np.bincount(j, flux, edges.n))/edges.V


class Unsymmetric(DihDrift, table="losses", same="maker points seed steps"):
    """Momentum that an unsymmetric pressure loses on a line, up to the last record before a run diverges."""
    mode: str = "one-sided"
    transport: Any = Pairwise()
    box: SmallBox = LINE
    kind = OneSided

    def measure(self, report: Report) -> Iterator[Row]:
        fluid, state, advance = self.begun()
        _, size, _ = sizes(fluid.eos, fluid.fields(state))
        momenta = [fsum(fluid.edges.V*state[1])]
        in_parts(advance, state, self.steps, lambda now: momenta.append(fsum(fluid.edges.V*now[1])), report,
                 LOOKS)
        reached = self.steps*(len(momenta) - 1)//LOOKS
        yield {"reached": reached, "lost": abs(momenta[-1] - momenta[0])/size}
