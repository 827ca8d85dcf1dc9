"""A cylinder of frozen particles in a stream, in a square array: its drag [Sangani & Acrivos 1982], where its surface lies

A settled fluid fills the box; those of its particles that are in the cylinder are frozen, which leaves the structure as it was.
The body force is on what is free, as a mean pressure gradient would be; with the gradient's force on the body the drag is that on
what is free times all over free.
"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.cylinder import drag_of
from continuum.fluid import ConstEta, IdealGas
from particles.dissipative.stream import DpdStream, force_on_body, speed
from particles.integral.bodies import held
from particles.integral.stream import Stream
from particles.limits import limit_of
from particles.run import Plan, Run, run
from studies.build.cylinder import VARIANTS, force, momentum
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import mean
from studies.kit.table import Table
from studies.noise.dpd.frozen import DEPTH, ETA, Frozen, free_temperature

CYLINDER = ["variant", "fraction", "radius"]
#: streams: force and free particles as they are, speed averaged over the cell; balance: force over push less 1, its error what
#: chance may leave of momentum; inside: density of free particles in the cylinder, fluid: outside
CYLINDERS = Table("cylinders", key=CYLINDER, columns=[
    *CYLINDER, "dt", "side", "depth", "n", "held", "time", "push", "speed", "speed_err", "force", "balance", "balance_err",
    "inside", "fluid", "kinetic", "kinetic_err", "turned"])
#: velocity over the mean one in squares of the cell, places in radii
FLOW = Table("flow", key=[*CYLINDER, "x", "y"], columns=[*CYLINDER, "x", "y", "u", "v"])
#: drag at a Reynolds number over that without inertia, of fixed points [RR98] on the same array
INERTIA = Table("inertia", key=["fraction", "reynolds"], columns=["fraction", "rows", "reynolds", "mach", "ratio"])
#: drag over eta times speed and depth with the viscosity of the table `shear` at the same step, inertia taken out; offset: by
#: which the radius of a cylinder of this drag exceeds that of the frozen one; outer_: with the density of the fluid outside in
#: force and velocity, less than that of all as fluid gets into the cylinder, a reading chosen after the runs
DRAG = Table("drag", key=CYLINDER, columns=[
    *CYLINDER, "reynolds", "viscosity", "viscosity_err", "inertia", "drag", "drag_err", "published", "ratio", "ratio_err",
    "offset", "offset_err", "outer_ratio", "outer_ratio_err", "outer_offset", "outer_offset_err"])
ALL = (CYLINDERS, FLOW, INERTIA, DRAG)

BINS = 16
SETTLED = 100.0     # time until the stream is steady: ten times mass over drag, and what enters the body has entered


class Inside:
    """Whether particles are in a cylinder about the middle of each cell."""

    def __init__(self, radius: float, side: float):
        self.radius, self.side = radius, side

    def place(self, x: np.ndarray) -> np.ndarray:
        """Coordinates (2, n) across the cylinder in the cell."""
        return x[:2] - self.side*np.round(x[:2]/self.side)

    def __call__(self, x: np.ndarray) -> np.ndarray:
        return (self.place(x)**2).sum(axis=0) < self.radius**2

    def turned(self, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Inside and on the way in."""
        return self(x) & ((self.place(x)*v[:2]).sum(axis=0) < 0)

    def count(self, sums, state: np.ndarray) -> float:
        """Free particles in the cylinder."""
        return float((self(state[:3]) & ~sums.is_held[sums.now.ids]).sum())

    def carried(self, sums, state: np.ndarray) -> float:
        """Momentum along x in the cylinder."""
        return float(state[3, self(state[:3])].sum())

    def far(self, sums, state: np.ndarray) -> float:
        """Particles farther than a range outside, whom frozen ones neither push nor rub."""
        return float(((self.place(state)**2).sum(axis=0) > (self.radius + 1)**2).sum())

    def flow(self, sums, state: np.ndarray) -> np.ndarray:
        """Momentum along x, y and particles in squares of the cell (3, BINS, BINS)."""
        x, edges = self.place(state), np.linspace(-self.side/2, self.side/2, BINS + 1)
        found = (np.histogram2d(x[0], x[1], bins=[edges, edges], weights=w)[0] for w in (state[3], state[4], np.ones_like(x[0])))
        return np.array(list(found))


@dataclass(frozen=True, kw_only=True)
class Cylinder(Frozen):
    """A stream past a cylinder across the box at about a Reynolds number of the diameter."""
    fraction: float = 0.2
    radius: float = 2.0
    reynolds: float = 2.0

    @property
    def variant(self) -> str:
        return "turned back" if self.turns else "frozen"

    @property
    def cell(self) -> float:
        """From one cylinder to the next."""
        return self.radius*float(np.sqrt(np.pi/self.fraction))

    @property
    def label(self) -> str:
        return f"Cylinder {self.variant}, solid fraction {self.fraction:g}, radius {self.radius:g}"

    @property
    def cost(self) -> float:
        return 1e-6*self.rho*self.cell**2*DEPTH*(self.time + SETTLED)/self.dt

    def run(self, report: Report, folder: Path) -> Outcome:
        method, n, done = self.streamed(report)
        return Outcome({"cylinders": [self._row(method, n, done)], "flow": self._flow(done)})

    @property
    def settling(self) -> float:
        """Time until the stream is steady."""
        return SETTLED

    def watched(self, inside: Inside) -> dict[str, Any]:
        """What is recorded."""
        return {"speed": speed, "force": force_on_body, "inside": inside.count, "kinetic": free_temperature}

    def streamed(self, report: Report) -> tuple[DpdStream, int, Run]:
        """The method, the number of particles, the run once the stream is steady."""
        inside, U = Inside(self.radius, self.cell), self.reynolds*ETA/(2*self.radius*self.rho)
        push = drag_of(self.fraction)[0]*ETA*U*DEPTH/round(self.rho*self.cell**2*DEPTH)
        method, start = self.stream((self.cell, self.cell), inside, push, U)
        plan = self.records(self.time, series=self.watched(inside), means={"flow": inside.flow})
        return method, start.shape[1], run(self.again(method), start, plan, report)

    def _key(self) -> dict:
        return {"variant": self.variant, "fraction": self.fraction, "radius": self.radius}

    def _row(self, method: DpdStream, n: int, done) -> dict:
        free, body = n - len(method.held), np.pi*self.radius**2*DEPTH
        (U, U_err), (kinetic, kinetic_err) = mean(done.series["speed"]), mean(done.series["kinetic"])
        F, within = float(np.mean(done.series["force"])), float(np.mean(done.series["inside"]))
        # momentum at the start and at the end: two of variance free kT
        chance = 1.96*np.sqrt(2*free*self.kT)/(method.push*free*self.time)
        return {**self._key(), "dt": self.dt, "side": self.cell, "depth": DEPTH, "n": n, "held": len(method.held),
                "time": self.time, "push": method.push, "speed": U, "speed_err": U_err, "force": F,
                "balance": F/(method.push*free) - 1, "balance_err": chance, "inside": within/body,
                "fluid": (free - within)/(method.volume - body), "kinetic": kinetic, "kinetic_err": kinetic_err,
                "turned": done.reflections, "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}

    def _flow(self, done) -> list[dict]:
        px, py, count = done.means["flow"]
        mass = np.where(count > 0, count, np.nan)*np.mean(done.series["speed"])     # a square of few frozen ones may be empty
        at, u, v = ((np.arange(BINS) + 0.5)/BINS - 0.5)*self.cell/self.radius, px/mass, py/mass
        return [{**self._key(), "x": at[i], "y": at[j], "u": u[i, j], "v": v[i, j]} for i in range(BINS) for j in range(BINS)]


@dataclass(frozen=True, kw_only=True)
class Inertia(Case):
    """What inertia adds to the drag: fixed points, at a Reynolds number over at one a hundred times as small.

    eta : so small that the pressure falls by 5 % in a cell of the faster stream, which adds 0.1 % to the drag, and 1.2 % at 0.5.
          The fall is as eta^2 times the Reynolds number.
    """
    fraction: float = 0.2
    reynolds: float = 2.0
    rows: int = 24
    eta: float = 0.25

    @property
    def cost(self) -> float:
        return 30.0

    def run(self, report: Report, folder: Path) -> Outcome:
        slow, fast = self.drag(self.reynolds/100), self.drag(self.reynolds)
        return Outcome({"inertia": [{"fraction": self.fraction, "rows": self.rows, "reynolds": fast[1], "mach": fast[2],
                                     "ratio": fast[0]/slow[0]}]})

    def drag(self, reynolds: float) -> tuple[float, float, float]:
        """Drag over eta U, Reynolds and Mach number of the steady stream."""
        variant, radius = VARIANTS["surface"], self.rows*float(np.sqrt(self.fraction/np.pi))
        points, which, edges = variant.cell(self.rows, radius)
        known, U, cell = drag_of(self.fraction)[0], reynolds*self.eta/2/radius, float(self.rows**2)
        method = Stream(x=points.x, edges=edges, eos=IdealGas(), law=ConstEta(self.eta, self.eta), held=held(which, T=1.0),
                        push=(known*self.eta*U/cell, 0.0), chi=variant.filtered/self.eta)
        first = method.state(1.0, np.full((points.n, 2), [U, 0.0]), 1.0)
        dt = 0.4*limit_of(method, first)        # of RK4 at rest; sound that is carried along is faster
        steps = round(15*cell/(min(known, 4*np.pi**2)*self.eta)/dt)      # as `bodies_drag`
        done = run(method, first, Plan(dt=dt, steps=steps, every=steps, series={"momentum": momentum, "force": force}))
        free = np.ones(points.n, bool)
        free[which] = False
        mean_U = done.series["momentum"][-1]/cell
        total = done.series["force"][-1] + method.push[0]*(cell - edges.V[free].sum())
        return total/(self.eta*mean_U), 2*mean_U*radius/self.eta, mean_U/np.sqrt(2.0)
