"""Slow flows around held points and between sliding sides: drag, shear    [RR98 Secs III, IV]"""
from collections.abc import Callable, Iterator

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.published import published
from particles.integral.bodies import CLEAR, held, on_circle
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice, of_positions
from particles.integral.sheared import Sheared
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Plan, Run, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.kit.case import Case, Report
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row

ETA, SPEED = 2.0, 1e-3      # sound and friction limit the step about equally; Re and Mach below 0.01
PRESSURE = 0.05             # chi nu/(a^2 c^2) of the density filter
TIMES = 15.0                # length of a run in decay times of the slowest motion
OF_LIMIT = 0.9              # time step over its stability limit: a steady flow has no error of the step
BOXES = 2.0                 # distance that images slide during a run, in lengths of the box
DIFFERENCE = 0.1            # difference of the speeds of neighbouring boxes
SOUND = np.sqrt(2.0)        # speed of sound at rho = T = 1
#: lattice of spacing 1 with a disc in its middle: points, indices of the points of the body, edges
Cell = tuple[Points, np.ndarray, Edges]


def spent(done: Run) -> dict[str, float]:
    """Columns with steps and CPU time of a run."""
    return {"steps": done.step, "cpu_s": done.cpu_s, "compile_s": done.compile_s}


def frozen(counts: tuple[int, int], radius: float) -> Cell:
    """A lattice; the body is its points within the disc, its circumference included."""
    points = lattice(counts)
    body = np.flatnonzero(np.hypot(*points.x.T) <= radius*(1 + 1e-12))
    return points, body, renormalised(points, Lucy.of(h=2.0))


def surface(counts: tuple[int, int], radius: float) -> Cell:
    """A lattice with points on the circle; edges of a Delaunay triangulation.

    Lattice points nearer to the circle than CLEAR are left out, so that chords between neighbours on it are
    Delaunay edges. The polygon of n points lacks a fraction (2 pi/n)^2/6 of the area of the disc.
    """
    at, circle = lattice(counts), on_circle(radius)
    r = np.hypot(*at.x.T)
    inside, outside = at.x[r < radius - CLEAR], at.x[r > radius + CLEAR]
    points = of_positions(np.concatenate([circle, inside, outside]), at.box)
    return points, np.arange(len(circle) + len(inside)), delaunay(points)


def drag(sums: Streaming, state: np.ndarray) -> float:
    """F/(eta U): force over edges to the body in the last stage of a step, and push on the body's volume."""
    method, V = sums.method, sums.method.edges.V
    inside = V[method.held.which].sum()
    force = sums.received[:, 0].sum() + method.push[0]*inside
    return float(force/(ETA*(V@state[1])/V.sum()))


class CylinderDrag(Case, table="drag", same="variant fraction rows"):
    """Steady slow stream through a square array of cylinders, `rows` spacings from one to the next.

    variant : how the body is made. fraction : of solid. The push is that of the published drag at the mean
    velocity SPEED.
    """
    variant: Callable[[tuple[int, int], float], Cell]
    fraction: float
    rows: int

    @property
    def cost(self) -> float:
        return 6e-5*self.rows**4/self.slowest + 1

    @property
    def slowest(self) -> float:
        """Slowest decay rate in nu/L^2: of the mean velocity, or of sound damped by friction."""
        return min(published(f"cylinders-drag-{self.fraction:g}").value, 4*np.pi**2)

    def measure(self, report: Report) -> Iterator[Row]:
        radius = self.rows*float(np.sqrt(self.fraction/np.pi))
        method = self.method(radius)
        first = method.state(1.0, np.full(method.x.shape, [SPEED, 0.0]), 1.0)
        dt = OF_LIMIT*limit_of(method, first)
        steps = round(TIMES*self.rows**2/(self.slowest*ETA)/dt)
        plan = Plan(dt=dt, steps=steps, every=max(1, steps//40), series={"drag": drag})
        done = run(method, first, plan, report)
        last = done.series["drag"][-4:]         # the last tenth of the time
        measured = Measured(last[-1], float(np.ptp(last)))
        known = published(f"cylinders-drag-{self.fraction:g}")
        printed = Measured(known.value, known.uncertainty)
        yield {"dt": dt, "radius": radius, "reynolds": 2*SPEED*radius/ETA, "mach": SPEED/SOUND, **spent(done),
               **with_errors(drag=measured, published=printed, error=measured/printed - 1)}

    def method(self, radius: float) -> Stream:
        """The gas on the points of the variant."""
        points, body, edges = self.variant((self.rows, self.rows), radius)
        push = published(f"cylinders-drag-{self.fraction:g}").value*ETA*SPEED/self.rows**2
        return Stream(x=points.x, edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA),
                      held=held(body, T=1.0), push=(push, 0.0), chi=PRESSURE/ETA)


# --- sliding sides ------------------------------------------------------------------------------


def sliding(rows: int, eta: float) -> Sheared:
    """A square box between sliding sides, with edges to nearest neighbours."""
    return Sheared(counts=(rows, rows), weight=Lucy.of(h=2.0), eos=IdealGas(), law=ConstEta(eta, eta),
                   rate=DIFFERENCE/rows)


def slid(method: Sheared, first: np.ndarray, report: Report) -> tuple[Run, float]:
    """A run until images have slid by BOXES lengths of the box, and its time.

    Images slide a spacing in a whole number of steps: the shares of sliding edges have their kinks there.
    """
    spacing = 1/DIFFERENCE
    dt = spacing/np.ceil(spacing/(OF_LIMIT*limit_of(method, first)))
    done = run(method, first, Plan(dt=dt, steps=round(BOXES/method.rate/dt)), report)
    return done, done.step*dt


class SlidingShear(Case, table="shear", same="rows"):
    """Homogeneous shear between sliding sides, started from the exact profile, with frictional heating."""
    rows: int
    eta: float = 0.3

    def measure(self, report: Report) -> Iterator[Row]:
        method = sliding(self.rows, self.eta)
        rate, V = method.rate, method.edges.V
        exact = method.points.x[:, ::-1]*(rate, 0)
        first = method.state(1.0, exact, 1.0)
        done, time = slid(method, first, report)
        last = done.state
        stress = method.start(len(V), Threads(1)).through(last)[1]/self.rows
        mass, px, py, energy, _ = (last@V - first@V)/V.sum()
        change = np.abs(method.fields(last).v - exact).max()
        yield {"stress": abs(stress/(self.eta*rate) - 1), "heating": abs(energy/time/(self.eta*rate**2) - 1),
               "profile": change/DIFFERENCE, "mass_drift": abs(mass),
               "momentum_drift": max(abs(px), abs(py))/DIFFERENCE, **spent(done)}


class TurningWave(Case, table="wave", same="rows"):
    """A plane wave that the shear turns from k = (1, 1) 2 pi/L to (1, -1) 2 pi/L, against its exact solution.

    At low Mach number vorticity decays as exp(-nu int k^2 dt) and k_y = k_x (1 - rate t)    [Kelvin 1887]
    """
    rows: int
    eta: float = 0.02/32        # per row: the same Reynolds number at all sizes
    size: float = 1e-3          # of the wave: its square is negligible

    def measure(self, report: Report) -> Iterator[Row]:
        method = sliding(self.rows, self.eta*self.rows)
        v, p = self.wave(method, 0.0)
        first = method.state(1 + p/2, v, 1 + p/2)          # isentropic: gamma = 2, P = 1
        done, time = slid(method, first, report)
        exact, _ = self.wave(method, time)
        of_wave = exact - method.points.x[:, ::-1]*(method.rate, 0)
        scale = float(np.sqrt((of_wave**2).sum(axis=1).mean()))
        error = without_divergence(method.fields(done.state).v - exact, self.rows)
        yield {"error": error/scale, **spent(done)}

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
    """Rms of the divergence-free part of a velocity (n, 2), the mean included."""
    waves = np.fft.fft2(v.reshape(rows, rows, 2), axes=(0, 1))/rows**2
    k = np.stack(np.meshgrid(*[np.fft.fftfreq(rows)]*2, indexing="ij"), axis=2)
    k /= np.maximum(np.hypot(*k.T).T, 1e-150)[..., None]
    across = waves - k*(k*waves).sum(axis=2)[..., None]
    return float(np.linalg.norm(across))
