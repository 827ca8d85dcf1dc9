"""Transport measured in time, as cases: waves that decay, and shear flows between plates    [RR98 Eqs 34-38, 51, Sec. III A]

Waves: density, velocities along and across k, and temperature get a wave each in turn; RK4 advances the full equations,
and what all four have become after equal times are propagators U_1, U_2, U_3 (4, 4) of the amplitudes. log(U_3 U_2^-1)/t
is the matrix of rates: on points off a lattice what is no plane wave has died out or rings by then.

Shear flows: RR98 leaves walls open. Here they are mirror images, friction seeing 2 U - v behind a plate that slides with
U, or rows of points that are held (`Stream`), which triangles of points off a lattice need: their images would see a kink.
"""
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import logm

from continuum.exact.shear import couette, poiseuille
from continuum.exact.waves import QUANTITIES, LinearGas, Waves, continuum, quantities
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from particles.integral.bodies import held, together, with_plates
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.driven import Driven
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges, between_plates
from particles.integral.points import Points, jittered, lattice
from particles.integral.stream import Stream
from particles.integral.triangulation import between, delaunay
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build.disorder import Disorder
from studies.build.symbols import lattice_waves
from studies.kit.case import Case, Outcome, Report

AMPLITUDE = 1e-5    # its square is the share of waves that feed back on the first; round-off over it is 1e-11
STEPS = 10          # at least, in a radian of sound: RK4 is off by 5 (1/10)^4/120 of a rate
TRUNCATION = 5*STEPS**-4/120
MARGIN = 1.25       # of the step to its limit
#: of Eqs 37, 38 and of Eq. 51
TRANSPORT = {"nested": NestedFluxes(), "pairwise": Pairwise()}
ETA, KAPPA = 0.3, 0.4

LAW = ConstEta(0.5, 0.5)                # of shear flows
TIMES = (0.02, 0.05, 0.1, 0.2, 0.5)     # in height^2/nu
INTERVAL = 0.01                         # of which all of these are multiples
SPEED = 1e-3        # of the flow: heating and compression are of the order of its square, 1e-6 of it
COLUMNS = 8         # nothing depends on x but where points are
FROM_PLATE = 0.25   # of a spacing: jittered points come no nearer to a plate
OF_LIMIT = 0.5      # of the step to its limit: RK4's own errors are (0.02)^4 of a decay

#: quantity -> (measured, error)
Pairs = dict[str, tuple[float, float]]


# --- waves --------------------------------------------------------------------------------------------------


def propagators(dih: Dih, points: Points, k: np.ndarray, time: float,
                phases: tuple[float, ...]) -> np.ndarray:
    """U (2 or 3, 4, 4) of amplitudes (rho, u along k, T, v across k) after `time`, twice and off a lattice three times that.

    phases : 0 alone where all places are alike, (0, pi/2) where they are not: exp(ik.r) by its real and imaginary part.
    """
    n = k/np.hypot(*k)
    frame, place = np.array([n, [-n[1], n[0]]]), points.x@k
    steps = max(STEPS, ceil(MARGIN*time/step_limit(dih)))
    U = np.zeros((2 if len(phases) == 1 else 3, 4, 4), complex)
    for field in range(4):
        for phase in phases:
            wave = AMPLITUDE*np.cos(place - phase)
            state = start(dih, wave, field, frame)
            integrator = RK4(state.shape, Team(1))
            for part in range(len(U)):
                for _ in range(steps):
                    integrator.step(dih, state, time/steps)
                U[part, :, field] += np.exp(1j*phase)*amplitudes(dih, state, place, frame)*2/len(phases)
    return U/AMPLITUDE


def start(dih: Dih, wave: np.ndarray, field: int, frame: np.ndarray) -> np.ndarray:
    """Rest at rho = T = 1, with a wave in one of (rho, u, T, v)."""
    rho, u, T, v = (1.0*(number in (0, 2)) + wave*(number == field) for number in range(4))
    return dih.state(rho, u[:, None]*frame[0] + v[:, None]*frame[1], T)


def amplitudes(dih: Dih, state: np.ndarray, place: np.ndarray, frame: np.ndarray) -> np.ndarray:
    """Parts exp(ik.r) of (rho, u, T, v)."""
    flow, V = dih.flow(state), dih.edges.V
    fields = np.stack([flow.rho - 1, flow.v@frame[0], flow.T - 1, flow.v@frame[1]])
    return fields@(V*np.exp(-1j*place))/V.sum()


def step_limit(dih: Dih) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at rho = T = 1."""
    sound, spread = dih.edges.fastest
    return 1/(np.sqrt(2)*sound/2.82 + (ETA + dih.zeta + KAPPA)*spread/2.78)


def rates(U: np.ndarray, time: float) -> list[Waves]:
    """From the last two of the times."""
    waves, ends = [], [np.eye(4), *U]
    for before, after in (ends[-3:-1], ends[-2:]):
        M = logm(after@np.linalg.inv(before))/time
        waves.append(Waves(M[:3, :3], float(-M[3, 3].real)))
    return waves


def measured(dih: Dih, points: Points, k: np.ndarray, phases: tuple[float, ...]) -> Pairs:
    """Quantities and their errors: what the last two times differ by, and RK4's own."""
    size = float(np.hypot(*k))
    time = 1/float(np.abs(np.linalg.eigvals(continuum(LinearGas(ETA, dih.zeta, KAPPA), size).matrix)).max())
    before, last = (quantities(one, size) for one in rates(propagators(dih, points, k, time, phases), time))
    return {name: (last[name], abs(last[name] - before[name]) + TRUNCATION*abs(last[name]))
            for name in QUANTITIES}


@dataclass(frozen=True, kw_only=True)
class Decay(Case):
    """Waves of one length on one set of points.

    transport : name in TRANSPORT. make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in
    spacings. counts : points along x and y. turns : whole waves along x and y, (1, 0) or (1, 1).
    """
    transport: str
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    counts: tuple[int, int]
    turns: tuple[int, int] = (1, 0)
    zeta: float = 0.0
    seed: int = 1

    @property
    def cost(self) -> float:
        points, edges = self.counts[0]*self.counts[1], 3 if self.maker == "delaunay" else 1.6*self.h**2
        return (320 if self.even else 1200)*(2e-4 + 3e-7*points*edges)

    @property
    def even(self) -> bool:
        """Are all places alike?"""
        return self.disorder.name == "lattice"

    @property
    def label(self) -> str:
        edges = f"{self.transport} {self.maker} {self.weight.__name__} h {self.h:g}"
        return (f"{edges}, {self.disorder.name}, {self.counts}, "
                f"zeta {self.zeta:g}, seed {self.seed}")

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        k, weight = 2*np.pi*np.array(self.turns)/np.array(self.counts), self.weight.of(h=self.h)
        try:
            edges = self.make(points, weight)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            values = dict.fromkeys(QUANTITIES, (np.nan, np.nan))
        else:
            dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=self.zeta,
                      transport=TRANSPORT[self.transport])
            values = measured(dih, points, k, (0.0,) if self.even else (0.0, np.pi/2))
        return Outcome({"waves": self.rows(values, k, weight)})

    def rows(self, values: Pairs, k: np.ndarray, weight: Any) -> list[dict[str, Any]]:
        """One a quantity: measured, by the lattice symbol, of the continuum."""
        size, gas = float(np.hypot(*k)), LinearGas(ETA, self.zeta, KAPPA)
        exact = quantities(continuum(gas, size), size)
        symbol = dict.fromkeys(QUANTITIES, np.nan)
        if self.even:
            symbol = quantities(lattice_waves(gas, weight, k, self.transport == "nested"), size)
        key = {"transport": self.transport, "maker": self.maker, "weight": self.weight.__name__, "h": self.h,
               "points": self.disorder.name, "direction": "axis" if 0 in self.turns else "diagonal",
               "zeta": self.zeta, "wavelength": 2*np.pi/size, "seed": self.seed}
        return [{**key, "quantity": name, "measured": values[name][0], "measured_err": values[name][1],
                 "lattice": symbol[name], "continuum": exact[name]} for name in QUANTITIES]


# --- shear flows --------------------------------------------------------------------------------------------


class Drive(NamedTuple):
    """What makes a flow: velocity of the upper plate, force height^2/(8 nu), both in SPEED, and the exact u/SPEED."""
    name: str
    slide: float
    force: float
    series: Callable[[np.ndarray, float], np.ndarray]


FLOWS = {"couette": Drive("couette", 1.0, 0.0, couette),
         "poiseuille": Drive("poiseuille", 0.0, 1.0, poiseuille)}


def driven(drive: Drive, rows: int, jitter: float, seed: int) -> Driven:
    """A layer of unit spacing: a lattice with Lucy's weight, h = 2, or jittered points with Delaunay edges."""
    at = jittered((COLUMNS, rows), jitter, seed) if jitter else lattice((COLUMNS, rows))
    x = np.stack([at.x[:, 0], np.clip(at.x[:, 1], -rows/2 + FROM_PLATE, rows/2 - FROM_PLATE)], axis=1)
    edges, beyond = between_plates(delaunay if jitter else renormalised, x, COLUMNS, rows, Lucy.of(h=2.0))
    return Driven(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=LAW, T_plates=(1.0, 1.0), g=0.0,
                  slide=(0.0, drive.slide*SPEED), force=8*LAW.eta*SPEED*drive.force/rows**2)


def between_rows(drive: Drive, rows: int, jitter: float, seed: int) -> Stream:
    """The same on jittered points with Delaunay edges that end on rows of points on the plates."""
    x, lower, upper = with_plates(jittered((COLUMNS, rows - 1), jitter, seed).x, COLUMNS, rows)
    plates = together(held(lower, T=1.0), held(upper, (drive.slide*SPEED, 0.0), T=1.0))
    return Stream(x=x, edges=between(x, COLUMNS, rows), eos=IdealGas(), law=LAW, held=plates,
                  push=(8*LAW.eta*SPEED*drive.force/rows**2, 0.0))


@dataclass(frozen=True, kw_only=True)
class ShearFlow(Case):
    """One flow from rest, `rows` spacings high, on a lattice (jitter 0) or on jittered points; `plates`: of points."""
    drive: Drive
    rows: int
    jitter: float = 0.0
    plates: bool = False
    seed: int = 1

    @property
    def cost(self) -> float:
        return 5e-4*self.rows**2*(0.5 + self.rows/64)*(1 + 2*self.jitter)

    @property
    def label(self) -> str:
        return f"{self.drive.name}, {self.rows} rows, {self.points}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = (between_rows if self.plates else driven)(self.drive, self.rows, self.jitter, self.seed)
        state, last, rows = method.state(1.0, 0*method.x, np.ones(len(method.x))), 0.0, []
        interval = INTERVAL*self.rows**2/LAW.eta
        steps = ceil(interval/(OF_LIMIT*limit_of(method, state)))
        for time in TIMES:
            plan = Plan(dt=interval/steps, steps=steps*round((time - last)/INTERVAL))
            state, last = run(method, state, plan).state, time
            report(time/TIMES[-1])
            rows.append({**self.key_of_row, "time": time, **self.errors(method.fields(state), time)})
        return Outcome({"shear": rows})

    def errors(self, flow: Fields, time: float) -> dict[str, float]:
        """Of the velocity against the series, and what the series neglect: heating, compression, velocity across."""
        difference = flow.v[:, 0]/SPEED - self.drive.series(flow.x[:, 1]/self.rows + 0.5, time)
        return {"rms": float(np.sqrt(flow.V@difference**2/flow.V.sum())),
                "largest": float(np.abs(difference).max()),
                "heating": float(np.abs(flow.T - 1).max()), "compression": float(np.abs(flow.rho - 1).max()),
                "across": float(np.abs(flow.v[:, 1]).max()/SPEED)}

    @property
    def points(self) -> str:
        return (f"jittered-{self.jitter:g}" if self.jitter else "lattice") + ", plates"*self.plates

    @property
    def key_of_row(self) -> dict[str, Any]:
        return {"flow": self.drive.name, "points": self.points, "rows": self.rows, "seed": self.seed}
