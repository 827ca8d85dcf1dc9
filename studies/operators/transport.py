"""Transport in time: waves that decay, shear flows between plates    [RR98 Eqs 34-38, 51, Sec. III A]

Waves along x: density, velocity along, temperature and velocity across get a wave each in turn. RK4 advances
the full equations. What all four are after equal times makes propagators U_1, U_2, U_3 (4, 4) of the
amplitudes. The matrix of rates is log(U_3 U_2^-1)/t: off a lattice what is no plane wave has died out or
rings by then.

Shear flows: RR98 leaves walls open. Here they are mirror images, friction seeing 2 U - v behind a plate that
slides with U, or rows of points that are held (`Stream`): triangles off a lattice see a kink in images.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import logm

from continuum.exact.waves import LinearGas, Waves, continuum, quantities
from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import held, together, with_sides
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges, between_plates
from particles.integral.layer import Driven
from particles.integral.points import Points, jittered, lattice
from particles.integral.stream import Stream
from particles.integral.triangulation import between, delaunay
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.build.setting import Disorder
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

NAMES: dict[type, str] = {NestedFluxes: "nested", Pairwise: "pairwise"}       # in tables
AMPLITUDE = 1e-5    # its square is the share of waves that feed back on the first; round-off over it is 1e-11
STEPS = 10          # at least, in a radian of sound: RK4 is off by 5 (1/10)^4/120 of a rate
TRUNCATION = 5*STEPS**-4/120
MARGIN = 1.25       # of the step to its limit
ETA, KAPPA = 0.3, 0.4

LAW = ConstEta(0.5, 0.5)                # of shear flows
TIMES = (0.02, 0.05, 0.1, 0.2, 0.5)     # in height^2/nu
INTERVAL = 0.01                         # of which all of these are multiples
SPEED = 1e-3        # of the flow: heating and compression are of the order of its square, 1e-6 of it
COLUMNS = 8         # nothing depends on x but where points are
JITTER = 0.2        # spacings, of points between plates
FROM_PLATE = 0.25   # of a spacing: jittered points come no nearer to a plate
OF_LIMIT = 0.5      # of the step to its limit: RK4's own errors are (0.02)^4 of a decay


# --- waves --------------------------------------------------------------------------------------------------


def propagators(dih: Dih, x: np.ndarray, k: float, time: float, phases: tuple[float, ...]) -> np.ndarray:
    """U (2 or 3, 4, 4) of amplitudes (rho, u, T, v) after `time`, twice and off a lattice three times that.

    phases : 0 alone where all places are alike, else (0, pi/2), for real and imaginary part of exp(ikx).
    """
    place = k*x[:, 0]
    steps = max(STEPS, ceil(MARGIN*time/step_limit(dih)))
    U = np.zeros((1 + len(phases), 4, 4), complex)
    for field in range(4):
        for phase in phases:
            state = start(dih, AMPLITUDE*np.cos(place - phase), field)
            integrator = RK4(state.shape, Threads(1))
            for part in range(len(U)):
                for _ in range(steps):
                    integrator.step(dih, state, time/steps)
                shifted = np.exp(1j*phase)*amplitudes(dih, state, place)
                U[part, :, field] += shifted*2/len(phases)
    return U/AMPLITUDE


def start(dih: Dih, wave: np.ndarray, field: int) -> np.ndarray:
    """Rest at rho = T = 1, with a wave in one of (rho, u, T, v)."""
    fields = np.array([1.0, 0.0, 1.0, 0.0])[:, None]*np.ones_like(wave)
    fields[field] += wave
    rho, u, T, v = fields
    return dih.state(rho, np.stack([u, v], axis=1), T)


def amplitudes(dih: Dih, state: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Parts exp(ikx) of (rho, u, T, v)."""
    flow, V = dih.flow(state), dih.edges.V
    u, v = flow.v.T
    fields = np.stack([flow.rho - 1, u, flow.T - 1, v])
    return fields@(V*np.exp(-1j*place))/V.sum()


def step_limit(dih: Dih) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at rho = T = 1."""
    sound, spread = dih.edges.fastest
    return 1/(np.sqrt(2)*sound/2.82 + (ETA + dih.zeta + KAPPA)*spread/2.78)


def rates_between(before: np.ndarray, after: np.ndarray, time: float) -> Waves:
    """From two propagators, `time` apart."""
    M = logm(after@np.linalg.inv(before))/time
    return Waves(M[:3, :3], float(-M[3, 3].real))


def measured(dih: Dih, x: np.ndarray, k: float, phases: tuple[float, ...]) -> dict[str, Measured]:
    """Quantities of the last of the times; errors: what the time before gives another one, and RK4's own."""
    gas = LinearGas(ETA, dih.zeta, KAPPA)
    fastest = np.abs(np.linalg.eigvals(continuum(gas, k).matrix)).max()
    time = 1/float(fastest)
    *_, first, second, third = (np.eye(4), *propagators(dih, x, k, time, phases))
    before = quantities(rates_between(first, second, time), k)
    last = quantities(rates_between(second, third, time), k)
    values = {}
    for name, value in last.items():
        change = abs(value - before[name])
        values[name] = Measured(value, change + TRUNCATION*abs(value))
    return values


@dataclass(frozen=True, kw_only=True)
class Decay(Case):
    """Waves of one length along x on one set of points; no rows where there are no such edges.

    make : of `particles.integral.edge_makers.MAKERS`. h : range of Lucy's weight, in spacings. counts : of
    points along x and y.
    """
    transport: NestedFluxes | Pairwise
    make: Callable[[Points, Any], Edges]
    h: float
    disorder: Disorder
    counts: tuple[int, int]
    zeta: float
    seed: int = 1

    @property
    def cost(self) -> float:
        points = self.counts[0]*self.counts[1]
        return (320 if self.even else 1200)*(2e-4 + 3e-7*points*1.6*self.h**2)

    @property
    def even(self) -> bool:
        """Are all places alike?"""
        return self.disorder.name == "lattice"

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        try:
            edges = self.make(points, Lucy.of(h=self.h))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({})
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=self.zeta,
                  transport=self.transport)
        phases = (0.0,) if self.even else (0.0, np.pi/2)
        k = 2*np.pi/self.counts[0]
        values = measured(dih, points.x, k, phases)
        return Outcome({"waves": list(self.rows(values, k))})

    def rows(self, values: dict[str, Measured], k: float) -> Iterator[dict[str, Any]]:
        """One a quantity."""
        key = {"transport": NAMES[type(self.transport)], "maker": self.make.__name__, "h": self.h,
               "points": self.disorder.name, "zeta": self.zeta, "wavelength": self.counts[0],
               "seed": self.seed}
        exact = quantities(continuum(LinearGas(ETA, self.zeta, KAPPA), k), k)
        for name, (value, err) in values.items():
            yield key | {"quantity": name, "measured": value, "measured_err": err, "continuum": exact[name]}


# --- shear flows --------------------------------------------------------------------------------------------


class Drive(NamedTuple):
    """What makes a flow: speed of the upper plate, force height^2/(8 nu), both in SPEED; exact u/SPEED."""
    name: str
    slide: float
    force: float
    series: Callable[[np.ndarray, float], np.ndarray]

    def push(self, rows: int) -> float:
        """The force per mass."""
        return 8*LAW.eta*SPEED*self.force/rows**2


class Between(NamedTuple):
    """Points and plates. method : of a drive, a number of rows and a seed."""
    name: str
    method: Callable[[Drive, int, int], Any]


def on_lattice(drive: Drive, rows: int, seed: int) -> Driven:
    """A lattice of unit spacing and its images, Lucy's weight, h = 2."""
    return between_images(drive, rows, lattice((COLUMNS, rows)).x, renormalised)


def jittered_images(drive: Drive, rows: int, seed: int) -> Driven:
    """Jittered points and their images, Delaunay edges."""
    x = jittered((COLUMNS, rows), JITTER, seed).x
    highest = rows/2 - FROM_PLATE
    y = np.clip(x[:, 1], -highest, highest)
    return between_images(drive, rows, np.stack([x[:, 0], y], axis=1), delaunay)


def between_images(drive: Drive, rows: int, x: np.ndarray, make: Callable) -> Driven:
    """A layer between plates that slide, with images behind."""
    edges, beyond = between_plates(make, x, COLUMNS, rows, Lucy.of(h=2.0))
    return Driven(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=LAW, T_plates=(1.0, 1.0), g=0.0,
                  slide=(0.0, drive.slide*SPEED), force=drive.push(rows))


def between_rows(drive: Drive, rows: int, seed: int) -> Stream:
    """Jittered points with Delaunay edges that end on rows of points on the plates."""
    x, sides = with_sides(jittered((COLUMNS, rows - 1), JITTER, seed).x, (COLUMNS, rows))
    plates = together(held(sides.bottom, T=1.0), held(sides.top, (drive.slide*SPEED, 0.0), T=1.0))
    return Stream(x=x, edges=between(x, COLUMNS, rows), eos=IdealGas(), law=LAW, held=plates,
                  push=(drive.push(rows), 0.0))


@dataclass(frozen=True, kw_only=True)
class ShearFlow(Case):
    """One flow from rest, `rows` spacings high, against its exact series."""
    drive: Drive
    between: Between
    rows: int
    seed: int = 1

    @property
    def cost(self) -> float:
        return 7e-4*self.rows**2*(0.5 + self.rows/64)

    def run(self, report: Report, folder: Path) -> Outcome:
        method = self.between.method(self.drive, self.rows, self.seed)
        state = method.state(1.0, 0*method.x, np.ones(len(method.x)))
        interval = INTERVAL*self.rows**2/LAW.eta
        steps = ceil(interval/(OF_LIMIT*limit_of(method, state)))
        key = {"flow": self.drive.name, "points": self.between.name, "rows": self.rows, "seed": self.seed}
        last, rows = 0.0, []
        for time in TIMES:
            plan = Plan(dt=interval/steps, steps=steps*round((time - last)/INTERVAL))
            state, last = run(method, state, plan).state, time
            report(time/TIMES[-1])
            flow = method.fields(state)
            height = flow.x[:, 1]/self.rows + 0.5
            error = flow.v[:, 0]/SPEED - self.drive.series(height, time)
            rms = float(np.sqrt(flow.V@error**2/flow.V.sum()))
            largest = float(np.abs(error).max())
            rows.append(key | {"time": time, "rms": rms, "largest": largest})
        return Outcome({"shear": rows})
