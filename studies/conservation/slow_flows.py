"""Slow flows around held points and between sliding sides: drag, torque, shear    [RR98 Secs III, IV]"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.exact.cylinder import drag_of
from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import between_circles, together, turning
from particles.integral.edge_makers import renormalised
from particles.integral.points import lattice
from particles.integral.sheared import Sheared
from particles.integral.stream import Stream
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Plan, Run, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.conservation.cylinder import PRESSURE, Obstacle, drag, force, momentum, radius_of, stream
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import Measured

ETA, SPEED = 2.0, 1e-3      # sound and friction limit the step alike; Re and Mach below 0.01
TIMES = 15.0                # until the end, in those of the slowest motion
OF_LIMIT = 0.9              # of the step to its stability limit: a steady flow knows no error of the step
INNER, OUTER = 0.18, 0.42   # radii over the size of the box
BOXES = 2.0                 # lengths of the box that images slide
DIFFERENCE = 0.1            # of the speeds of neighbouring boxes
SOUND = np.sqrt(2.0)        # its speed at rho = T = 1


def spent(done: Run) -> dict[str, float]:
    """How long a run was."""
    return {"steps": done.step, "cpu_s": done.cpu_s, "compile_s": done.compile_s}


# --- bodies -------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class CylinderDrag(Case):
    """A stream through a square array of cylinders, `rows` spacings from one to the next, until it is steady.

    speed : about that which the mean velocity gets, by the published drag.
    """

    variant: Obstacle
    fraction: float
    rows: int
    speed: float = SPEED

    @property
    def cost(self) -> float:
        edges = 2 if self.variant.name.startswith("surface") else 1
        return 4e-5*self.rows**4/self.slowest*edges + 1

    @property
    def label(self) -> str:
        return f"drag {self.variant.name}, solid fraction {self.fraction:g}, {self.rows} rows"

    @property
    def slowest(self) -> float:
        """Rate of the slowest motion in nu/L^2: of the mean velocity, or of sound that friction damps."""
        return min(drag_of(self.fraction).value, 4*np.pi**2)

    def run(self, report: Report, folder: Path) -> Outcome:
        method = stream(self.variant, self.fraction, self.rows, self.speed, ETA)
        v = np.full(method.x.shape, [self.speed, 0.0])
        first = method.state(1.0, v, 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        time = TIMES*self.rows**2/(self.slowest*ETA)
        steps = round(time/dt)
        series = {"momentum": momentum, "force": force}
        plan = Plan(dt=dt, steps=steps, every=max(1, steps//40), series=series)
        done = run(method, first, plan, report)
        known = {"variant": self.variant.name, "fraction": self.fraction, "rows": self.rows, "dt": dt}
        return Outcome({"drag": [{**known, **self.columns(method, done), **spent(done)}]})

    def columns(self, method: Stream, done: Run) -> dict[str, Any]:
        """Drag, its error against print, what the fluid and the body are."""
        radius = radius_of(self.rows, self.fraction)
        pulls = (np.array(done.series[name]) for name in ("momentum", "force"))
        drags = drag(method, float(self.rows**2), *pulls)
        last = Measured(drags[-1], float(np.ptp(drags[-4:])))       # the last tenth of the time
        printed = drag_of(self.fraction)
        published = Measured(printed.value, printed.uncertainty)
        error = last/published - 1
        return {"radius": radius, "drag": last.value, "drag_err": last.err, "published": published.value,
                "published_err": published.err, "error": error.value, "error_err": error.err,
                "reynolds": 2*self.speed*radius/ETA, "mach": self.speed/SOUND}


@dataclass(frozen=True, kw_only=True)
class TurningCylinder(Case):
    """A cylinder that turns inside of one at rest: points on both circles, Delaunay edges.

    Between them velocity over radius is A + B/r^2, the torque is 4 pi eta B    [Taylor-Couette flow, exact]
    """

    rows: int

    @property
    def label(self) -> str:
        return f"turning cylinder, {self.rows} rows"

    @property
    def cost(self) -> float:
        return 4e-7*self.rows**4

    def exact(self, x: np.ndarray) -> np.ndarray:
        """Velocity (n, 2) at x (n, 2)."""
        inner, outer = INNER*self.rows, OUTER*self.rows
        r = np.maximum(np.hypot(*x.T), inner)
        between = (outer**2/r**2 - 1)/(outer**2/inner**2 - 1)
        turns = SPEED/inner*np.clip(between, 0, 1)
        return turns[:, None]*np.stack([-x[:, 1], x[:, 0]], axis=1)

    def run(self, report: Report, folder: Path) -> Outcome:
        inner, outer = INNER*self.rows, OUTER*self.rows
        method = self.method(inner, outer)
        first = method.state(1.0, self.exact(method.x), 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        time = TIMES*(outer - inner)**2/(np.pi**2*ETA)
        done = run(method, first, Plan(dt=dt, steps=round(time/dt)), report)
        whole = 4*np.pi*ETA*SPEED*inner/(1 - (inner/outer)**2)
        on_turned, on_fixed = torques(method, done.state)/whole
        errors = {"turned": -on_turned - 1, "fixed": on_fixed - 1}
        return Outcome({"torque": [{"rows": self.rows, "radius": inner, **errors, **spent(done)}]})

    def method(self, inner: float, outer: float) -> Stream:
        """The gas between the cylinders, and their points."""
        points, turned, fixed = between_circles((self.rows, self.rows), inner, outer)
        in_motion = turning(points, turned, SPEED/inner, 1.0)
        at_rest = turning(points, fixed, 0.0, 1.0)
        return Stream(x=points.x, edges=delaunay(points), eos=IdealGas(), law=ConstEta(ETA, ETA),
                      held=together(in_motion, at_rest), chi=PRESSURE/ETA)


def torques(method: Stream, state: np.ndarray) -> np.ndarray:
    """On the cylinder that turns and on the fixed one."""
    sums = method.start(state.shape[1], Threads(1))
    sums.force(state)
    x, y = method.x[method.held.which].T
    Fx, Fy, _ = sums.received.T
    return np.bincount(method.held.body, x*Fy - y*Fx)


# --- sliding sides ------------------------------------------------------------------------------


def sliding(rows: int, eta: float) -> Sheared:
    """A square box whose images slide, with edges to nearest neighbours."""
    points = lattice((rows, rows))
    return Sheared(points=points, edges=renormalised(points, Lucy.of(h=2.0)), eos=IdealGas(),
                   law=ConstEta(eta, eta), rate=DIFFERENCE/rows)


def slid(method: Sheared, first: np.ndarray, report: Report) -> tuple[Run, float]:
    """A run until images have slid BOXES, and its time.

    The step divides the time of one spacing: shares of sliding edges bend between steps.
    """
    spacing = 1/DIFFERENCE
    dt = spacing/np.ceil(spacing/(OF_LIMIT*limit_of(method, first)))
    done = run(method, first, Plan(dt=dt, steps=round(BOXES/method.rate/dt)), report)
    return done, done.step*dt


@dataclass(frozen=True, kw_only=True)
class SlidingShear(Case):
    """Homogeneous shear between sliding sides, from the exact profile on, with heating by friction."""

    rows: int
    eta: float = 0.3

    def run(self, report: Report, folder: Path) -> Outcome:
        method = sliding(self.rows, self.eta)
        rate, V, y = method.rate, method.edges.V, method.points.x[:, 1]
        exact = np.stack([rate*y, 0*y], axis=1)
        first = method.state(1.0, exact, 1.0)
        done, time = slid(method, first, report)
        last = done.state
        stress = method.start(len(y), Threads(1)).through(last)[1]/self.rows
        mass, px, py, energy, _ = (last@V - first@V)/V.sum()
        heat = energy/time
        change = np.abs(method.fields(last).v - exact).max()
        errors = {"stress": abs(stress/(self.eta*rate) - 1), "heating": abs(heat/(self.eta*rate**2) - 1),
                  "profile": float(change/DIFFERENCE)}
        drifts = {"mass_drift": abs(mass), "momentum_drift": float(max(abs(px), abs(py))/DIFFERENCE)}
        return Outcome({"shear": [{"rows": self.rows, **errors, **drifts, **spent(done)}]})


@dataclass(frozen=True, kw_only=True)
class TurningWave(Case):
    """A plane wave that the shear turns from k = (1, 1) 2 pi/L to (1, -1) 2 pi/L: exact at low Mach number.

    Vorticity decays as exp(-nu int k^2 dt), its wave vector is k_y = k_x (1 - rate t)    [Kelvin 1887]
    """

    rows: int
    eta: float = 0.02/32        # per row: the same Reynolds number at all sizes
    size: float = 1e-3          # of the wave, so small that its square does not count

    def run(self, report: Report, folder: Path) -> Outcome:
        method = sliding(self.rows, self.eta*self.rows)
        v, p = self.wave(method, 0.0)
        first = method.state(1 + p/2, v, 1 + p/2)          # isentropic: gamma = 2, P = 1
        done, time = slid(method, first, report)
        exact, _ = self.wave(method, time)
        y = method.points.x[:, 1]
        of_wave = exact - np.stack([method.rate*y, 0*y], axis=1)
        scale = float(np.sqrt((of_wave**2).sum(axis=1).mean()))
        error = without_divergence(method.fields(done.state).v - exact, self.rows)
        return Outcome({"wave": [{"rows": self.rows, "error": error/scale, **spent(done)}]})

    def wave(self, method: Sheared, t: float) -> tuple[np.ndarray, np.ndarray]:
        """(velocity (n, 2) with the shear, pressure (n,)) at a time: grad^2 p = -2 rho rate dv/dx."""
        (x, y), rate, kx = method.points.x.T, method.rate, 2*np.pi/self.rows
        ky = kx*(1 - rate*t)
        k2 = kx**2 + ky**2
        damped = kx**2*t + (kx**3 - ky**3)/(3*rate*kx)
        stream = self.size*kx/k2*np.exp(-self.eta*self.rows*damped)
        phase = kx*x + ky*y
        vx = rate*y - ky*stream*np.sin(phase)
        vy = kx*stream*np.sin(phase)
        return np.stack([vx, vy], axis=1), 2*rate*kx**2*stream/k2*np.cos(phase)


def without_divergence(v: np.ndarray, rows: int) -> float:
    """Rms of the part of a velocity (n, 2) that has none; the mean belongs to it."""
    waves = np.fft.fft2(v.reshape(rows, rows, 2), axes=(0, 1))/rows**2
    x, y = waves[:, :, 0], waves[:, :, 1]
    k = np.fft.fftfreq(rows)
    kx, ky = np.meshgrid(k, k, indexing="ij")
    k2 = np.maximum(kx**2 + ky**2, 1e-300)
    along = np.abs(kx*x + ky*y)**2/k2
    whole = np.abs(x)**2 + np.abs(y)**2
    return float(np.sqrt((whole - along).sum()))
