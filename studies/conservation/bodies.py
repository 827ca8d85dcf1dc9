"""Bodies of held points and sliding sides: drag, torque, shear    [RR98 Secs III, IV]"""
from collections.abc import Iterator
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
from particles.threads import Team
from particles.weights import Lucy
from studies.build.cylinder import PRESSURE, VARIANTS, Obstacle, drag, force, free, momentum, radius_of, stream
from studies.kit.case import Case, Outcome, Report

ETA, SPEED = 2.0, 1e-3      # sound and friction limit the step alike; Re and Mach below 0.01
TIMES = 15.0                # until the end, in those of the slowest motion
OF_LIMIT = 0.9              # of the step to its stability limit: a steady flow knows no error of the step
INNER, OUTER = 0.18, 0.42   # radii over the size of the box
BOXES = 2.0                 # lengths of the box that images slide
DIFFERENCE = 0.1            # of the speeds of neighbouring boxes
SOUND = np.sqrt(2.0)        # its speed at rho = T = 1


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
        first = method.state(1.0, np.full(method.x.shape, [self.speed, 0.0]), 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        steps = round(TIMES*self.rows**2/(self.slowest*ETA)/dt)
        series = {"momentum": momentum, "force": force}
        done = run(method, first, Plan(dt=dt, steps=steps, every=max(1, steps//40), series=series), report)
        return Outcome({"drag": [{**self.columns(method, done), "dt": dt, "steps": steps, **spent(done)}]})

    def columns(self, method: Stream, done: Run) -> dict[str, Any]:
        """Drag, its error, what the fluid and the body are."""
        fluid, radius = free(method), radius_of(self.rows, self.fraction)
        rho, V = method.fields(done.state).rho[fluid], method.edges.V[fluid]
        forces = np.array(done.series["force"])
        drags = drag(method, float(self.rows**2), np.array(done.series["momentum"]), forces)
        last, err = drags[-1], float(np.ptp(drags[-4:]))        # the last tenth of the time
        known, known_err = drag_of(self.fraction)
        return {"variant": self.variant.name, "fraction": self.fraction, "rows": self.rows, "radius": radius,
                "points": int(fluid.sum()), "drag": last, "drag_err": err, "published": known,
                "published_err": known_err, "error": last/known - 1,
                "error_err": float(np.hypot(err/known, last*known_err/known**2)),
                "balance": forces[-1]/(method.push[0]*(V*rho).sum()) - 1, "reynolds": 2*self.speed*radius/ETA,
                "mach": self.speed/SOUND, "density_range": float(np.ptp(rho))}


def spent(done: Run) -> dict[str, float]:
    """Seconds of a run."""
    return {"cpu_s": done.cpu_s, "compile_s": done.compile_s}


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

    def turns(self, r: np.ndarray) -> np.ndarray:
        """Angular velocity at r."""
        inner, outer = INNER*self.rows, OUTER*self.rows
        between = (outer**2/np.maximum(r, inner)**2 - 1)/(outer**2/inner**2 - 1)
        return SPEED/inner*np.clip(between, 0, 1)

    def run(self, report: Report, folder: Path) -> Outcome:
        inner, outer = INNER*self.rows, OUTER*self.rows
        points, turned, fixed = between_circles((self.rows, self.rows), inner, outer)
        body = together(turning(points, turned, SPEED/inner, 1.0), turning(points, fixed, 0.0, 1.0))
        method = Stream(x=points.x, edges=delaunay(points), eos=IdealGas(), law=ConstEta(ETA, ETA), held=body,
                        chi=PRESSURE/ETA)
        x, y = points.x.T
        exact = self.turns(np.hypot(x, y))[:, None]*np.stack([-y, x], axis=1)
        first = method.state(1.0, exact, 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        steps = round(TIMES*(outer - inner)**2/(np.pi**2*ETA)/dt)
        done = run(method, first, Plan(dt=dt, steps=steps), report)
        whole = 4*np.pi*ETA*SPEED*inner/(1 - (inner/outer)**2)
        on_turned, on_fixed = torques(method, done.state)/whole
        profile = float(np.abs(method.fields(done.state).v - exact).max()/SPEED)
        return Outcome({"torque": [{
            "rows": self.rows, "radius": inner, "turned": -on_turned - 1, "fixed": on_fixed - 1,
            "balance": on_turned + on_fixed, "profile": profile, "steps": steps, **spent(done)}]})


def torques(method: Stream, state: np.ndarray) -> np.ndarray:
    """On the cylinder that turns and on the fixed one."""
    sums = method.start(state.shape[1], Team(1))
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


def whole_steps(method: Sheared, first: np.ndarray) -> float:
    """The longest step that divides the time of one spacing: shares of sliding edges bend between steps."""
    spacing = 1/DIFFERENCE
    return spacing/np.ceil(spacing/(OF_LIMIT*limit_of(method, first)))


@dataclass(frozen=True, kw_only=True)
class SlidingShear(Case):
    """Homogeneous shear between sliding sides, from the exact profile on, with heating by friction."""

    rows: int
    eta: float = 0.3

    @property
    def label(self) -> str:
        return f"shear between sliding sides, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = sliding(self.rows, self.eta)
        rate, V, y = method.rate, method.edges.V, method.points.x[:, 1]
        exact = np.stack([rate*y, 0*y], axis=1)
        first = method.state(1.0, exact, 1.0)
        dt = whole_steps(method, first)
        done = run(method, first, Plan(dt=dt, steps=round(BOXES/rate/dt)), report)
        last = done.state
        stress = method.start(len(y), Team(1)).through(last)[1]/self.rows
        mass, px, py, energy, slid = (last@V - first@V)/V.sum()
        heat = energy/(done.step*dt)
        off = method.fields(done.state).v - exact
        return Outcome({"shear": [{
            "rows": self.rows, "stress": abs(stress/(self.eta*rate) - 1),
            "heating": abs(heat/(self.eta*rate**2) - 1), "profile": float(np.abs(off).max()/DIFFERENCE),
            "mass_drift": abs(mass), "momentum_drift": float(max(abs(px), abs(py))/DIFFERENCE),
            "slid": slid/self.rows, "steps": done.step, **spent(done)}]})


@dataclass(frozen=True, kw_only=True)
class TurningWave(Case):
    """A plane wave that the shear turns from k = (1, 1) 2 pi/L to (1, -1) 2 pi/L: exact at low Mach number.

    Vorticity decays as exp(-nu int k^2 dt), its wave vector is k_y = k_x (1 - rate t)    [Kelvin 1887]
    """

    rows: int
    eta: float = 0.02/32        # per row: the same Reynolds number at all sizes
    size: float = 1e-3          # of the wave, so small that its square does not count

    @property
    def label(self) -> str:
        return f"turning wave between sliding sides, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        method = sliding(self.rows, self.eta*self.rows)
        rate, V, y = method.rate, method.edges.V, method.points.x[:, 1]
        v, p = self.wave(method, 0.0)
        first = method.state(1 + p/2, v, 1 + p/2)          # isentropic: gamma = 2, P = 1
        dt = whole_steps(method, first)
        done = run(method, first, Plan(dt=dt, steps=round(BOXES/rate/dt)), report)
        last = method.fields(done.state)
        exact, _ = self.wave(method, done.step*dt)
        of_wave = exact - np.stack([rate*y, 0*y], axis=1)
        scale = float(np.sqrt((of_wave**2).sum(axis=1).mean()))
        mass = V@last.rho/(V@method.fields(first).rho)
        slid = float(done.state[-1, 0]/self.rows)
        return Outcome({"wave": [{
            "rows": self.rows, "error": without_divergence(last.v - exact, self.rows)/scale,
            "mach": DIFFERENCE/SOUND, "mass_drift": abs(float(mass) - 1), "slid": slid, "steps": done.step,
            **spent(done)}]})

    def wave(self, method: Sheared, t: float) -> tuple[np.ndarray, np.ndarray]:
        """(velocity (n, 2) with the shear, pressure (n,)) at a time: grad^2 p = -2 rho rate dv/dx."""
        (x, y), rate, kx = method.points.x.T, method.rate, 2*np.pi/self.rows
        ky = kx*(1 - rate*t)
        k2, damped = kx**2 + ky**2, kx**2*t + (kx**3 - ky**3)/(3*rate*kx)
        stream = self.size*kx/k2*np.exp(-self.eta*self.rows*damped)
        phase = kx*x + ky*y
        v = np.stack([rate*y - ky*stream*np.sin(phase), kx*stream*np.sin(phase)], axis=1)
        return v, 2*rate*kx**2*stream/k2*np.cos(phase)


def without_divergence(v: np.ndarray, rows: int) -> float:
    """Rms of the part of a velocity (n, 2) that has none; the mean belongs to it."""
    F = np.fft.fft2(v.reshape(rows, rows, 2), axes=(0, 1))/rows**2
    k = np.fft.fftfreq(rows)
    kx, ky = np.meshgrid(k, k, indexing="ij")
    size = np.where((kx == 0) & (ky == 0), 1.0, np.hypot(kx, ky))
    along = np.abs(kx*F[:, :, 0] + ky*F[:, :, 1])**2/size**2
    whole = (np.abs(F)**2).sum(axis=2)
    return float(np.sqrt((whole - along).sum()))


SMOOTH = (24, 28, 32, 36, 40, 44, 48, 52, 56)      # sizes where errors are smooth, and where they are not
SCATTERED = tuple(range(24, 50, 2))


def bodies(size: str) -> Iterator[Case]:
    """`quick` has small sizes at one solid fraction, too few and too small to extrapolate drags from."""
    quick = size == "quick"
    waves = (12, 16, 24) if quick else (16, 24, 32, 48, 64)
    yield from (TurningWave(rows=rows) for rows in waves)
    yield from (SlidingShear(rows=rows) for rows in waves[:3])
    yield from (TurningCylinder(rows=rows) for rows in ((16, 20) if quick else range(24, 68, 4)))
    if quick:
        yield from drags(0.1, {"surface": (12, 16), "frozen": (12, 16)})
        return
    for fraction, every in ((0.1, 1), (0.3, 4)):
        scattered = SCATTERED[::every]
        sizes = {"surface": SMOOTH, "surface-unfiltered": (24, 32, 48), "frozen": scattered,
                 "frozen-grown": scattered}
        yield from drags(fraction, sizes)


def drags(fraction: float, sizes: dict[str, tuple[int, ...]]) -> Iterator[Case]:
    """Drags of some variants."""
    for name, rows in sizes.items():
        yield from (CylinderDrag(variant=VARIANTS[name], fraction=fraction, rows=n) for n in rows)
