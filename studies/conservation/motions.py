"""RR98's moving points: equations on given fields, speeds of waves, positions    [RR98 Eqs 39-50]"""
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.linalg import norm

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Pairwise
from particles.integral.drifts import Powers
from particles.integral.points import Points, jittered, lattice
from particles.integral.rr98_moving import scale_of
from particles.integral.rr98_moving_plain import MOTIONS, ConstantMass, Convective, convected
from particles.integrators import RK4, Euler, TwoStep
from particles.limits import rates_of
from particles.threads import Threads
from particles.weights import Lucy
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row

ALONG = Pairwise(mended=False)
STILL, C = ConstEta(0.0, 0.0), np.sqrt(2.0)     # c^2 = gamma P/rho = 2 at rho = T = 1
AMPLITUDE = 1e-4        # of waves: quadratic terms are 1e-4 of linear ones, and of another wavelength
BREADTH = 8             # spacings across a wave: more than twice the widest weight
LENGTH = 32             # spacings of a wave on which equations are evaluated without steps
STREAM = 0.2
DT = 0.2                # time step of waves on moving points, with RK4


def strip(wavelength: int, breadth: int = BREADTH) -> Points:
    """Lattice of one wavelength, or of several where one is shorter than the breadth."""
    waves = max(1, -(-breadth//wavelength))
    return lattice((wavelength*waves, breadth))


def moving(kind: Any, points: Points, weight: Any, law: Any = STILL, **more: Any) -> Any:
    """A motion on points with renormalised edges and friction along edges, by default as printed."""
    settings = {"transport": ALONG, "scale": scale_of(points, weight), **more}
    return kind(box=tuple(points.box), weight=weight, eos=IdealGas(), law=law, **settings)


# --- equations evaluated on given fields --------------------------------------------------------


def acceleration(method: Any, state: np.ndarray) -> np.ndarray:
    """dv/dt = (dp/dt - v dm/dt)/m, (d, n)."""
    d, rates = method.places, rates_of(method, state)
    m, dm, dp = state[d], rates[d], rates[d + 1:2*d + 1]
    return (dp - method.velocity(state)*dm)/m


class Identity(Case, table="identity", same="transport reynolds"):
    """Accelerations by Eqs 46-48 against those by Eq. 49: random fields on 10 x 10 jittered points.

    transport : its name, law : its terms. reynolds : U a/nu with U = 0.1; infinite without viscosity.
    """
    transport: str
    law: Any
    reynolds: float

    def measure(self, report: Report) -> Iterator[Row]:
        points, rng, eta = jittered((10, 10), 0.2, 2), np.random.default_rng(0), 0.1/self.reynolds
        rho = rng.uniform(0.9, 1.1, points.n)
        v = rng.normal(0, 0.1, (points.n, 2))
        T = rng.uniform(0.9, 1.1, points.n)

        def accelerated(kind: type) -> np.ndarray:
            method = moving(kind, points, Lucy.of(h=3.0), ConstEta(eta, eta), transport=self.law)
            return acceleration(method, method.state(points.x, rho, v, T))
        exact, other = accelerated(ConstantMass), accelerated(Convective)
        yield {"convective": np.abs(other - exact).max()/np.abs(exact).max()}


class Signs(Case, table="signs"):
    """Term that Eqs 46-48 add to d/dt, over v.grad of smooth fields on a lattice, by least squares."""

    def measure(self, report: Report) -> Iterator[Row]:
        points, k = strip(LENGTH), 2*np.pi/LENGTH
        edges = moving(Convective, points, Lucy.of(h=3.0)).fluid(points.x, points.V).edges
        v = np.tile([0.3, -0.1], (points.n, 1))
        for equation, phase in ((46, 0.0), (47, 0.7), (48, 1.9)):
            along = k*points.x[:, 0] + phase
            exact = -0.3*k*np.sin(along)
            [added] = convected(edges, v, np.cos(along)[None])
            yield {"equation": equation, "wavelength": LENGTH, "factor": added@exact/(exact@exact)}


class BracketForce(Case, table="brackets", same="a b"):
    """Acceleration by Eq. 50 with powers a and b, over -grad P/rho, in an isentropic wave (P = rho^2)."""
    a: float
    b: float

    def measure(self, report: Report) -> Iterator[Row]:
        points, k = strip(LENGTH), 2*np.pi/LENGTH
        x = points.x[:, 0]
        wave = 1 + AMPLITUDE*np.cos(k*x)
        method = moving(ConstantMass, points, Lucy.of(h=3.0), bracket=Powers(self.a, self.b))
        along, _ = acceleration(method, method.state(points.x, wave, 0*points.x, wave))
        # -grad rho^2 = 2 k A sin kx
        yield {"force": np.mean(along*np.sin(k*x))/(k*AMPLITUDE)}


# --- speeds -------------------------------------------------------------------------------------


def march(method: Any, state: np.ndarray, dt: float, steps: int, look: Callable[[np.ndarray], Any],
          integrator: Any = RK4) -> np.ndarray:
    """look(state) before the first step and after every step."""
    stepper, looks = integrator(state.shape, Threads(1)), [look(state)]
    for _ in range(steps):
        stepper.step(method, state, dt)
        looks.append(look(state))
    return np.array(looks)


def amplitude(q: np.ndarray, x: np.ndarray, k: float) -> complex:
    """Mean of (q - <q>) exp(-ikx)."""
    return complex(np.mean((q - q.mean())*np.exp(-1j*k*x)))


def frequency(series: np.ndarray, dt: float) -> float:
    """omega > 0 of a standing wave, its series fitted as a sum of two powers by least squares."""
    known = np.stack([series[:-2], series[1:-1]], axis=1)
    b, c = np.linalg.lstsq(known, series[2:], rcond=None)[0]
    powers = np.asarray(np.roots([1.0, -c, -b]), complex)
    return float((np.log(powers)/dt).imag.max())


def by_halves(series: np.ndarray, measure: Callable[[np.ndarray], float]) -> Measured:
    """A number from the whole series; its error is the difference between the two halves."""
    one, other = (measure(half) for half in np.array_split(series, 2))
    return Measured(float(measure(series)), float(abs(one - other)))


class Pattern(Case, table="patterns", same="motion h wavelength"):
    """Speed of a density wave at uniform pressure over that of the stream that carries it, no viscosity.

    motion : a name in MOTIONS. Error: difference of the run's halves.
    """
    motion: str
    wavelength: int
    time: float = 10.0
    h = 3.0

    def measure(self, report: Report) -> Iterator[Row]:
        points, k = strip(self.wavelength), 2*np.pi/self.wavelength
        method = moving(MOTIONS[self.motion], points, Lucy.of(h=self.h))
        rho = 1 + AMPLITUDE*np.cos(k*points.x[:, 0])
        v = np.tile([STREAM, 0.0], (points.n, 1))
        first = method.state(points.x, rho, v, 1/rho)
        waves = march(method, first, DT, round(self.time/DT), lambda state: amplitude(state[2], state[0], k))
        phases = np.unwrap(np.angle(waves))
        speed = by_halves(-phases/(k*STREAM*DT), lambda part: np.polyfit(np.arange(len(part)), part, 1)[0])
        yield with_errors(speed=speed)


class MovingSound(Case, table="moving_sound", same="motion weight h wavelength"):
    """Speed of a standing sound wave over c, from two periods without viscosity. weight : class."""
    motion: str
    wavelength: int
    weight: Any = Lucy
    h: float = 3.0

    @property
    def cost(self) -> float:
        return 1e-5*self.wavelength**2*self.h**2

    def measure(self, report: Report) -> Iterator[Row]:
        points, k = strip(self.wavelength, 2*int(self.h) + 2), 2*np.pi/self.wavelength
        method, one = moving(MOTIONS[self.motion], points, self.weight.of(h=self.h)), np.ones(points.n)
        wave = np.sin(k*points.x[:, 0])
        v = AMPLITUDE*np.stack([wave, 0*wave], axis=1)
        steps = round(2*self.wavelength/C/DT)
        waves = march(method, method.state(points.x, one, v, one), DT, steps, lambda state: state[3]@wave)
        yield with_errors(speed=by_halves(waves, lambda part: frequency(part, DT)/(k*C)))


# --- positions ----------------------------------------------------------------------------------


def sound(x: np.ndarray, box: np.ndarray) -> tuple[np.ndarray, ...]:
    """rho, v, T of a travelling sound wave: no phase of it is special."""
    wave = 0.02*np.sin(2*np.pi*x[:, 0]/box[0])
    return 1 + wave/C, np.stack([wave, 0*wave], axis=1), 1 + wave/C


def vortices(x: np.ndarray, box: np.ndarray) -> tuple[np.ndarray, ...]:
    """rho, v, T of Taylor-Green vortices with their steady pressure."""
    (X, Y), u = (2*np.pi*x/box).T, 0.1
    v = u*np.stack([np.sin(X)*np.cos(Y), -np.cos(X)*np.sin(Y)], axis=1)
    return np.ones(len(x)), v, 1 + u*u/4*(np.cos(2*X) + np.cos(2*Y))


class Places(Case, table="accuracy", same="motion flow"):
    """Rms error of positions with new velocities [Eq. 41] over that with old ones [Eq. 40], against RK4.

    All take as many steps; the error of RK4 is its difference from RK4 in half as many. flow : function of
    positions and box that gives rho, v, T.
    """
    motion: str
    flow: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]
    counts: tuple[int, int]
    law: ConstEta
    time: float
    steps: int

    def measure(self, report: Report) -> Iterator[Row]:
        exact, coarse = self.places(RK4, self.steps), self.places(RK4, self.steps//2)
        new, old = (norm(self.places(integrator, self.steps) - exact) for integrator in (TwoStep, Euler))
        err = norm(exact - coarse)
        yield {"ratio": new/old, "ratio_err": new/old*(err/new + err/old)}

    def places(self, integrator: Any, steps: int) -> np.ndarray:
        """Positions (n, 2) at the end."""
        points = lattice(self.counts)
        method = moving(MOTIONS[self.motion], points, Lucy.of(h=3.0), self.law, transport=Pairwise())
        state = method.state(points.x, *self.flow(points.x, points.box))
        march(method, state, self.time/steps, steps, lambda state: None, integrator)
        return method.fields(state).x


#: sound for one and a half periods: after whole periods the errors of some integrators are small by chance
PLACES = (
    Places(motion="literal", flow=sound, counts=(16, 7), law=STILL, time=13.0, steps=240),
    Places(motion="constant-mass", flow=sound, counts=(16, 7), law=STILL, time=18.9, steps=320),
    Places(motion="constant-mass", flow=vortices, counts=(12, 12), law=ConstEta(0.2, 0.2), time=10.0,
           steps=320))
