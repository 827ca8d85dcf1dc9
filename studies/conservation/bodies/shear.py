"""Shear between sliding sides and between fixed rows as cases; flow driven between fixed rows    [RR98, Secs III, IV]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import end_rows, held, together
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.integral.sheared import Sheared
from particles.integral.stream import Stream
from particles.limits import limit_of
from particles.run import Plan, Run, run
from particles.threads import Team
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report

COLUMNS = 8             # of flows that do not depend on x: wider than two ranges of the weights
OF_LIMIT = 0.9
TIMES = 20.0            # of the slowest motion between plates, H^2/(pi^2 nu)
BOXES = 2.0             # lengths of the box that the images slide


def whole_steps(limit: float, piece: float) -> float:
    """The longest step below the limit that divides a piece of time.

    With the time of one spacing as the piece, the bends of the shares of sliding edges fall between steps.
    """
    return piece/np.ceil(piece/limit)


@dataclass(frozen=True, kw_only=True)
class SlidingShear(Case):
    """Homogeneous shear between sliding sides, `rows` square, from the exact profile on, with heating by friction."""
    rows: int
    difference: float = 0.1     # of the speeds of neighbouring boxes
    eta: float = 0.3

    @property
    def label(self) -> str:
        return f"shear between sliding sides, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        points, rate = lattice((self.rows, self.rows)), self.difference/self.rows
        method = Sheared(points=points, edges=renormalised(points, Lucy.of(h=2.0)), eos=IdealGas(),
                         law=ConstEta(self.eta, self.eta), rate=rate)
        exact = np.stack([rate*points.x[:, 1], 0*points.x[:, 1]], axis=1)
        first = method.state(1.0, exact, 1.0)
        dt = whole_steps(OF_LIMIT*limit_of(method, first), 1/self.difference)
        plan = Plan(dt=dt, steps=round(BOXES/rate/dt))
        done = run(method, first, plan, report)
        V, last = method.edges.V, done.state
        stress = method.start(points.n, Team(1)).through(last)[1]/points.box[0]
        lost = np.abs(last[:4]@V - first[:4]@V)/V.sum()
        heat = (last[3]@V - first[3]@V)/V.sum()/(plan.steps*dt)
        return Outcome({"shear": [{"kind": "sliding sides", "rows": self.rows, "stress": abs(stress/(self.eta*rate) - 1),
                                   "heating": abs(heat/(self.eta*rate**2) - 1),
                                   "profile": float(np.abs((last[1:3]/last[0]).T - exact).max()/self.difference),
                                   "mass_drift": lost[0], "momentum_drift": float(lost[1:3].max()/self.difference),
                                   "slid": last[4, 0]/self.rows, "steps": plan.steps, "cpu_s": done.cpu_s,
                                   "compile_s": done.compile_s}]})


@dataclass(frozen=True, kw_only=True)
class TurningWave(Case):
    """A plane wave across the shear, which turns it from k = (1, 1) 2 pi/L to (1, -1) 2 pi/L: exact in 2D at low Mach number.

    Vorticity decays as exp(-nu int k^2 dt), its wave vector is k_y = k_x (1 - rate t)    [Kelvin 1887]
    """
    rows: int
    difference: float = 0.1
    eta: float = 0.02/32        # per row: the same Reynolds number at all sizes
    size: float = 1e-3          # of the wave, so small that its square does not count

    @property
    def label(self) -> str:
        return f"turning wave between sliding sides, {self.rows} rows"

    @property
    def rate(self) -> float:
        return self.difference/self.rows

    def run(self, report: Report, folder: Path) -> Outcome:
        points, eta = lattice((self.rows, self.rows)), self.eta*self.rows
        method = Sheared(points=points, edges=renormalised(points, Lucy.of(h=2.0)), eos=IdealGas(), law=ConstEta(eta, eta),
                         rate=self.rate)
        v, p = self.wave(points, 0.0)
        first = method.state(1 + p/2, v, 1 + p/2)          # isentropic: gamma = 2, P = 1
        dt = whole_steps(OF_LIMIT*limit_of(method, first), 1/self.difference)
        plan = Plan(dt=dt, steps=round(BOXES/self.rate/dt))
        done = run(method, first, plan, report)
        wanted, _ = self.wave(points, plan.steps*dt)
        shear = np.stack([self.rate*points.x[:, 1], 0*points.x[:, 1]], axis=1)
        turning, divergent = parts((done.state[1:3]/done.state[0]).T - wanted, self.rows)
        scale = float(np.sqrt(((wanted - shear)**2).sum(axis=1).mean()))
        V = method.edges.V
        return Outcome({"wave": [{"rows": self.rows, "error": turning/scale, "divergent": divergent/scale,
                                  "mach": self.difference/np.sqrt(2.0),
                                  "mass_drift": abs(float(V@done.state[0]/(V@first[0])) - 1),
                                  "slid": done.state[4, 0]/self.rows, "steps": plan.steps, "cpu_s": done.cpu_s,
                                  "compile_s": done.compile_s}]})

    def wave(self, points: Points, t: float) -> tuple[np.ndarray, np.ndarray]:
        """(velocity (n, 2) with the shear, pressure (n,)) at a time: grad^2 p = -2 rho rate dv/dx."""
        (x, y), rate, kx = points.x.T, self.rate, 2*np.pi/self.rows
        ky = kx*(1 - rate*t)
        k2, damped = kx**2 + ky**2, kx**2*t + (kx**3 - ky**3)/(3*rate*kx)
        stream = self.size*kx/k2*np.exp(-self.eta*self.rows*damped)
        phase = kx*x + ky*y
        return (np.stack([rate*y - ky*stream*np.sin(phase), kx*stream*np.sin(phase)], axis=1),
                2*rate*kx**2*stream/k2*np.cos(phase))


def parts(v: np.ndarray, rows: int) -> tuple[float, float]:
    """Rms of the parts of a velocity (n, 2) without divergence and without rotation; the mean belongs to the first."""
    F = np.fft.fft2(v.reshape(rows, rows, 2), axes=(0, 1))/rows**2
    k = np.fft.fftfreq(rows)
    kx, ky = np.meshgrid(k, k, indexing="ij")
    size = np.where((kx == 0) & (ky == 0), 1.0, np.hypot(kx, ky))
    along = np.abs(kx*F[:, :, 0] + ky*F[:, :, 1])**2/size**2
    whole = (np.abs(F)**2).sum(axis=2)
    return float(np.sqrt((whole - along).sum())), float(np.sqrt(along.sum()))


def channel(make: Callable[[Points, Any], Edges], h: float, rows: int, speed: float, eta: float,
            push: float = 0.0) -> tuple[Stream, np.ndarray]:
    """A fluid between fixed rows, as many as the range, that move with -+speed; and the rows y of its free points."""
    fixed = int(np.ceil(h))
    points = lattice((COLUMNS, rows + 2*fixed))
    lower, upper = end_rows(points, fixed)
    body = together(held(lower, (-speed, 0.0), 1.0), held(upper, (speed, 0.0), 1.0))
    method = Stream(x=points.x, edges=make(points, Lucy.of(h=h)), eos=IdealGas(), law=ConstEta(eta, eta), held=body,
                    push=(push, 0.0))
    return method, np.setdiff1d(np.arange(points.n), body.which)


def until_steady(method: Stream, first: np.ndarray, height: float, eta: float, report: Report) -> tuple[Run, float]:
    """A run of TIMES, and what the last tenth of it changed of the velocity, relative to the largest."""
    dt = OF_LIMIT*limit_of(method, first)
    steps = round(TIMES*height**2/(np.pi**2*eta)/dt)
    before = run(method, first, Plan(dt=dt, steps=steps - steps//10), report)
    done = run(method, before.state, Plan(dt=dt, steps=steps//10))
    u, earlier = (q.state[1]/q.state[0] for q in (done, before))
    return done, float(np.abs(u - earlier).max()/np.abs(u).max())


@dataclass(frozen=True, kw_only=True)
class MovingRows(Case):
    """Couette flow between rows of fixed points that move, `rows` of fluid between them."""
    rows: int
    difference: float = 0.1
    eta: float = 0.3

    @property
    def label(self) -> str:
        return f"shear between fixed rows, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        method, free = channel(renormalised, 2.0, self.rows, self.difference/2, self.eta)
        height = self.rows + 1.0            # from first fixed row to first fixed row
        rate, y, V = self.difference/height, method.x[:, 1], method.edges.V
        T = 1 + np.maximum(rate**2/2*(height**2/4 - y**2), 0)      # eta = k: friction's heat is conducted to the rows
        first = method.state(1/T, np.stack([np.clip(rate*y, -self.difference/2, self.difference/2), 0*y], axis=1), T)
        done, _ = until_steady(method, first, height, self.eta, report)
        sums, last = method.start(len(y), Team(1)), done.state
        sums.force(last)
        upper = method.held.v[:, 0] > 0
        drag, heat = sums.received[upper, 0].sum(), (sums.received[:, 2] - sums.received[:, 0]*method.held.v[:, 0]).sum()
        u = (last[1]/last[0])[free]
        return Outcome({"shear": [{"kind": "fixed rows", "rows": self.rows, "stress": abs(-drag/COLUMNS/(self.eta*rate) - 1),
                                   "heating": abs(heat/(COLUMNS*height)/(self.eta*rate**2) - 1),
                                   "profile": float(np.abs(u - rate*y[free]).max()/self.difference),
                                   "mass_drift": abs(float(V@last[0]/(V@first[0])) - 1),
                                   "momentum_drift": float(abs(last[1]@V)/V.sum()/self.difference), "slid": 0.0,
                                   "steps": done.step, "cpu_s": done.cpu_s, "compile_s": done.compile_s}]})


@dataclass(frozen=True, kw_only=True)
class FixedRows(Case):
    """Flow driven along a channel between fixed rows at rest: where do they stop it?"""
    maker: str
    make: Callable[[Points, Any], Edges]
    h: float
    rows: int
    speed: float = 1e-3
    eta: float = 1.0

    @property
    def label(self) -> str:
        return f"fixed rows {self.maker} h {self.h:g}, {self.rows} rows"

    def run(self, report: Report, folder: Path) -> Outcome:
        push = 12*self.eta*self.speed/self.rows**2
        method, free = channel(self.make, self.h, self.rows, 0.0, self.eta, push)
        y, half = method.x[:, 1], (self.rows + 1)/2
        start = np.maximum(push/(2*self.eta)*(half**2 - y**2), 0)
        first = method.state(1.0, np.stack([start, 0*y], axis=1), 1.0)
        done, steady = until_steady(method, first, self.rows + 1.0, self.eta, report)
        u = (done.state[1]/done.state[0])[free]
        bend, top = parabola(y[free], u, self.rows/2 - self.h)
        mean = u.mean()*self.rows
        return Outcome({"walls": [{"maker": self.maker, "h": self.h, "rows": self.rows,
                                   "offset": float(np.sqrt(top/bend)) - self.rows/2,
                                   "error_plate": mean/(push*self.rows**3/(12*self.eta)) - 1,
                                   "error_row": mean/(push*(self.rows + 1)**3/(12*self.eta)) - 1,
                                   "bend": bend/(push/(2*self.eta)) - 1, "steady": steady, "cpu_s": done.cpu_s,
                                   "compile_s": done.compile_s}]})


def parabola(y: np.ndarray, u: np.ndarray, within: float) -> tuple[float, float]:
    """(B, A) of u = A - B y^2 by least squares, of rows |y| < within: those that no wall's edge reaches."""
    chosen = np.abs(y) < within
    (bend, top), *_ = np.linalg.lstsq(np.stack([-y[chosen]**2, np.ones(chosen.sum())], axis=1), u[chosen])
    return float(bend), float(top)
