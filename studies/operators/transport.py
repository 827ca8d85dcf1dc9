"""Transport in time: decaying waves, Euler's step, shear flows    [RR98 Eqs 34-38, 40, 51, Sec. III A]

Waves along x: a wave is given to density, velocity along x, temperature, velocity across x, one at a time.
RK4 advances the full equations. The amplitudes after times t, 2 t, 3 t form propagators U_1, U_2, U_3 (4, 4).
The matrix of rates is log(U_3 U_2^-1)/t: by then all but plane waves has died out or oscillates.

Shear flows: RR98 leaves walls open. Here they are mirror images, with 2 U - v for friction behind a plate
that slides with U, or rows of held points (`Stream`): off a lattice triangles see a kink at images.
"""
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise, product
from math import ceil
from typing import NamedTuple

import numpy as np
from scipy.linalg import logm

from continuum.exact.waves import LinearGas, Waves, continuum, quantities
from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import held, together, with_sides
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges, between_plates
from particles.integral.layer import Driven
from particles.integral.points import Points, jittered
from particles.integral.stream import Stream
from particles.integral.triangulation import between, delaunay
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Threads
from particles.weights import Lucy, WendlandC2
from studies.build.fixed import lattice_waves
from studies.build.setting import positions
from studies.kit.case import Case, Report
from studies.kit.stats import Measured
from studies.kit.table import Row
from studies.operators.points import PointSet

AMPLITUDE = 1e-5    # of waves: nonlinear feedback is about its square, round-off over it is 1e-11
STEPS = 10          # least steps in a radian of sound: RK4's relative error of a rate is 5 (1/10)^4/120
TRUNCATION = 5*STEPS**-4/120
MARGIN = 1.25       # stability limit over the time step
ETA, KAPPA = 0.3, 0.4
GAS = LinearGas(0.3, 0.2, 0.4)
LONG = 5000.0       # wavelength in spacings, infinite to four digits
MODES = 32          # spacings, of which waves in Euler's steps are parts
C2 = 2.0            # gamma P/rho of the ideal gas at rho = T = 1
NULL = 1e-6         # eigenvalues below this belong to waves that the operators do not see

LAW = ConstEta(0.5, 0.5)                # of shear flows
TIMES = (0.02, 0.05, 0.1, 0.2, 0.5)     # in height^2/nu
INTERVAL = 0.01                         # all TIMES are multiples of it
SPEED = 1e-3        # of the flow: heating and compression are of the order of its square
COLUMNS = 8         # of points: nothing but the places of points depends on x
JITTER = 0.2        # spacings, of points between plates
OF_LIMIT = 0.5      # time step over its stability limit: RK4's own errors are (0.02)^4 of a decay


def propagators(dih: Dih, x: np.ndarray, k: float, time: float, phases: tuple[float, ...]) -> np.ndarray:
    """U (2 or 3, 4, 4) of amplitudes (rho, u, T, v) after `time`, twice and off a lattice three times that.

    phases : (0,) if all places are alike, else (0, pi/2), for real and imaginary part of exp(ikx).
    """
    place, (sound, spread) = k*x[:, 0], dih.edges.fastest
    limit = 1/(np.sqrt(2)*sound/2.82 + (ETA + dih.zeta + KAPPA)*spread/2.78)       # of RK4, at rho = T = 1
    steps = max(STEPS, ceil(MARGIN*time/limit))
    U = np.zeros((1 + len(phases), 4, 4), complex)
    for field, phase in product(range(4), phases):
        fields = np.outer([1.0, 0.0, 1.0, 0.0], np.ones_like(place))
        fields[field] += AMPLITUDE*np.cos(place - phase)
        rho, u, T, v = fields
        state = dih.state(rho, np.stack([u, v], axis=1), T)
        integrator = RK4(state.shape, Threads(1))
        for part in U:
            for _ in range(steps):
                integrator.step(dih, state, time/steps)
            part[:, field] += np.exp(1j*phase)*amplitudes(dih, state, place)*2/len(phases)
    return U/AMPLITUDE


def amplitudes(dih: Dih, state: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Fourier amplitudes of exp(ikx) in (rho, u, T, v)."""
    flow, V = dih.flow(state), dih.edges.V
    u, v = flow.v.T
    fields = np.stack([flow.rho - 1, u, flow.T - 1, v])
    return fields@(V*np.exp(-1j*place))/V.sum()


def measured(dih: Dih, x: np.ndarray, k: float, phases: tuple[float, ...]) -> dict[str, Measured]:
    """`quantities` from the last interval; errors: the difference from the one before, plus RK4's own."""
    gas = LinearGas(ETA, dih.zeta, KAPPA)
    time = 1/np.abs(np.linalg.eigvals(continuum(gas, k).matrix)).max()
    U = np.array([np.eye(4), *propagators(dih, x, k, time, phases)])
    rates = [logm(after@np.linalg.inv(before))/time for before, after in pairwise(U[-3:])]
    before, last = (quantities(Waves(M[:3, :3], float(-M[3, 3].real)), k) for M in rates)
    return {name: Measured(value, abs(value - before[name]) + TRUNCATION*abs(value))
            for name, value in last.items()}


#: ways of transport by name
WAYS = {"nested": NestedFluxes(), "pairwise": Pairwise()}


class Decay(PointSet, table="waves", same="transport maker h points zeta wavelength seed"):
    """Decay of waves of one length along x, Lucy's weight; counts: points along x, y; transport: in WAYS."""
    transport: str
    zeta: float

    weight = Lucy

    @property
    def wavelength(self) -> int:
        return self.counts[0]

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        """One row per quantity. One phase is enough on a lattice, where all places are alike."""
        k, way = 2*np.pi/self.wavelength, WAYS[self.transport]
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=self.zeta, transport=way)
        exact = quantities(continuum(LinearGas(ETA, self.zeta, KAPPA), k), k)
        phases = (0.0,) if self.points.name == "lattice" else (0.0, np.pi/2)
        for name, (value, err) in measured(dih, points.x, k, phases).items():
            yield {"quantity": name, "measured": value, "measured_err": err, "continuum": exact[name]}


def of_edges() -> dict[str, float]:
    """Largest relative error of both viscosities of forces along edges, from symbols of long waves."""
    k = 2*np.pi/LONG
    values = quantities(lattice_waves(GAS, Lucy.of(h=8.0), np.array([k, 0.0]), nested=False), k)
    shear, bulk = values["viscosity"]/GAS.eta - 1, values["bulk viscosity"]/GAS.zeta - 1
    return {"viscosities, h = 8 a": max(abs(shear), abs(bulk))}


def euler_limit(eigenvalues: np.ndarray) -> float:
    """Largest dt with |1 + lambda dt| <= 1 for all eigenvalues but null modes; 0 if a mode grows."""
    seen = eigenvalues[np.abs(eigenvalues) > NULL]
    return np.min(np.maximum(-2*seen.real/np.abs(seen)**2, 0), initial=np.inf)


class EulerLimit(Case, table="euler"):
    """Largest stable step of Eq. 40 in the 2D gas, nested transport, for waves along an axis of a lattice."""
    gas: LinearGas

    def measure(self, report: Report) -> Iterator[Row]:
        eta, zeta, kappa = self.gas
        key = {**self.gas._asdict(), "predicted": (eta + zeta + kappa/2)/C2}
        for mode in range(1, MODES//2 + 1):
            k = 2*np.pi*mode/MODES
            waves = lattice_waves(self.gas, WendlandC2.of(h=3.0), np.array([k, 0.0]), nested=True)
            rates = np.append(np.linalg.eigvals(waves.matrix), -waves.shear)
            yield key | {"mode": mode, "k": k, "limit": euler_limit(rates)}


# --- shear flows --------------------------------------------------------------------------------------------


class Drive(NamedTuple):
    """Drive of a flow: speed of the upper plate, force height^2/(8 nu), both in SPEED; exact u/SPEED."""
    name: str
    slide: float
    force: float
    series: Callable[[np.ndarray, float], np.ndarray]

    def push(self, rows: int) -> float:
        """The force per mass."""
        return 8*LAW.eta*SPEED*self.force/rows**2


def between_images(drive: Drive, rows: int, seed: int, jitter: float, make: Callable) -> Driven:
    """A layer of jittered points between sliding plates with mirror images; Lucy's weight, h = 2."""
    x = positions(COLUMNS, rows, jitter, seed)
    edges, beyond = between_plates(make, x, COLUMNS, rows, Lucy.of(h=2.0))
    return Driven(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=LAW, T_plates=(1.0, 1.0), g=0.0,
                  slide=(0.0, drive.slide*SPEED), force=drive.push(rows))


def between_rows(drive: Drive, rows: int, seed: int) -> Stream:
    """Jittered points with Delaunay edges that end on rows of held points on the plates."""
    x, sides = with_sides(jittered((COLUMNS, rows - 1), JITTER, seed).x, (COLUMNS, rows))
    plates = together(held(sides.bottom, T=1.0), held(sides.top, (drive.slide*SPEED, 0.0), T=1.0))
    return Stream(x=x, edges=between(x, COLUMNS, rows), eos=IdealGas(), law=LAW, held=plates,
                  push=(drive.push(rows), 0.0))


#: points and plates -> function of (drive, rows, seed) that makes the method
BETWEEN: dict[str, Callable] = {
    "lattice": partial(between_images, jitter=0.0, make=renormalised),
    "jittered-0.2": partial(between_images, jitter=JITTER, make=delaunay),
    "jittered-0.2, plates": between_rows}


class ShearFlow(Case, table="shear", same="flow points rows seed"):
    """Errors of one flow from rest, `rows` spacings high, against its exact series; points : of BETWEEN."""
    flow: Drive
    points: str
    rows: int
    seed: int = 1

    def measure(self, report: Report) -> Iterator[Row]:
        method = BETWEEN[self.points](self.flow, self.rows, self.seed)
        state = method.state(1.0, 0*method.x, np.ones(len(method.x)))
        interval = INTERVAL*self.rows**2/LAW.eta
        steps = ceil(interval/(OF_LIMIT*limit_of(method, state)))
        last = 0.0
        for time in TIMES:
            plan = Plan(dt=interval/steps, steps=steps*round((time - last)/INTERVAL))
            state, last = run(method, state, plan).state, time
            report(time/TIMES[-1])
            at = method.fields(state)
            error = at.v[:, 0]/SPEED - self.flow.series(at.x[:, 1]/self.rows + 0.5, time)
            yield {"time": time, "rms": np.sqrt(at.V@error**2/at.V.sum()), "largest": np.abs(error).max()}
