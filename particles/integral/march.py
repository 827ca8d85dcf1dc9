"""Time steps of points that move with their triangulation: one compiled loop over parts of `carried`."""
import numpy as np

from continuum.jit import jit
from particles.integral.carried import complete, follow, heat, hold, read, stage
from particles.integral.flips import flips
from particles.integral.rings import geometry
from particles.neighbours import u64
from particles.threads import shared

edges_of = shared(geometry)
#: Runge-Kutta of four Euler stages of half a step, third order, strong-stability preserving: NEW is the share
#: of the stage, the rest is the start; limits on the imaginary and the real axis    [Kraaijevanger 1991]
NEW, IMAGINARY, REAL = (1.0, 1.0, 1/3, 1.0), 2.15, 5.14
#: the correction of forces along edges (`complete`) is computed at the first two stages; later stages use the
#: first value and 1/(2 c_2 (b_2 + b_3 + b_4)) of the change: second order in the step
LATER = (1.0, 1.2)
#: largest number of parts of a step, which is divided where triangles would turn over or edges are too stiff
MOST = 64


@jit
def march(threads, steps, dt, fluid, rings, held, y, bench):
    """Advance a state (9, n) in place: (steps done, point with a full ring, point with a turned triangle),
    -1 if there is no such point.

    threads : `Threads` if this is called uncompiled, as `march.py_func`. held : `Held` points.
    """
    n, left = y.shape[1], bench.left
    for step in range(steps):
        if left[0] == 0:
            left[:] = 1
        while left[0] > 0:
            h = dt/left[1]
            halfway(threads, n, h, y, bench.middle)
            edges_of(threads, n, bench.middle, rings, bench.V, bench.pull, bench.spread, bench.crossed)
            full, turned = mend(fluid.eos, y, rings, bench)
            if full >= 0 or (turned >= 0 and left[1] == MOST):
                return step, full, turned
            if turned >= 0:
                left[:] *= 2
                continue
            hold(fluid.eos, held, y)
            read(threads, n, y, fluid.eos, fluid.law, bench.points)
            follow(threads, n, fluid, rings, bench)
            heat(held, 1.0, bench.once)
            shift = fluid.shift*fastest(bench.strain, bench.free)
            parts = int(max(1.0, min(MOST, np.ceil(h*bench.stiffness.max()/REAL))))
            for count in range(4*parts):
                s = count % 4
                if s == 0:
                    bench.before[:] = y[4:9]
                if count > 0:
                    read(threads, n, y, fluid.eos, fluid.law, bench.points)
                if count > 0 and s < 2:
                    complete(threads, n, LATER[s], rings, bench)
                    heat(held, LATER[s], bench.once)
                stage(threads, n, 0.5*h/parts, NEW[s], fluid, rings.edges, bench, y)
                hold(fluid.eos, held, y)
            move(threads, n, h, shift, bench, y)
            left[0] -= 1
    return steps, -1, -1


@shared
@jit
def halfway(first, last, dt, y, middle):
    for i in range(u64(first), u64(last)):
        middle[0, i], middle[1, i] = y[0, i] + 0.5*dt*y[2, i], y[1, i] + 0.5*dt*y[3, i]


@jit
def mend(eos, y, rings, bench):
    """Flip until edges are Delaunay: (point with a full ring, point with a turned triangle), -1 for none."""
    if bench.crossed.any():
        count, full = flips(bench.middle, y, eos, rings, bench.crossed, bench.changed, bench.stack)
        bench.flipped[0] += count
        if full >= 0:
            return full, -1
        geometry(0, len(bench.V), bench.middle, rings, bench.V, bench.pull, bench.spread, bench.crossed,
                 bench.changed)
        bench.changed[:] = False
    for i in range(len(bench.V)):
        if not bench.V[i] > 0:
            return -1, i
    return -1, -1


@jit
def fastest(strain, free):
    """Largest |grad v| of free points."""
    largest = 0.0
    for i in range(len(free)):
        largest = max(largest, strain[i]*free[i])
    return largest


@shared
@jit
def move(first, last, dt, shift, bench, y):
    """Move points; free ones then get the velocity of the fluid and a shift to their triangles' centre."""
    for i in range(u64(first), u64(last)):
        for c in range(2):
            y[c, i] += dt*y[c + 2, i]
            if bench.free[i]:
                y[c + 2, i] = y[c + 4, i]/y[6, i] + shift*bench.pull[i, c]
