"""Steps of points that move with their triangulation: one compiled loop over what `carried` has."""
import numpy as np

from continuum.jit import jit
from particles.integral.carried import differ, heat, hold, read, stage
from particles.integral.flips import flips
from particles.integral.rings import geometry
from particles.neighbours import u64

#: how a march ends: all steps done; a triangle has turned over; a ring is full
DONE, TURNED, FULL = 0, 1, 2


@jit
def march(steps, dt, fluid, rings, held, y, bench):
    """Advance a state (9, n) in place: (how it ended, steps done, a point).

    held : `Held` points.
    """
    n = y.shape[1]
    for step in range(steps):
        halfway(0, n, dt, y, bench.middle)
        geometry(0, n, bench.middle, rings, bench.V, bench.pull, bench.crossed)
        full, turned = mend(y, rings, bench)
        if full >= 0:
            return FULL, step, full
        if turned >= 0:
            return TURNED, step, turned
        hold(fluid.eos, held, y)
        read(0, n, y, fluid.eos, fluid.law, bench.points)
        differ(0, n, rings, bench)
        bench.before[:] = y[4:]
        heat(held, bench)
        for new in (1.0, 1/4, 2/3):
            stage(0, n, dt, new, fluid, rings.edges, bench, y)
            hold(fluid.eos, held, y)
            if new != 2/3:
                read(0, n, y, fluid.eos, fluid.law, bench.points)
        rate_of_strain = fastest(bench)
        move(0, n, dt, fluid.shift*rate_of_strain, bench, y)
    return DONE, steps, -1


@jit
def halfway(first, last, dt, y, middle):
    for i in range(u64(first), u64(last)):
        middle[0, i], middle[1, i] = y[0, i] + 0.5*dt*y[2, i], y[1, i] + 0.5*dt*y[3, i]


@jit
def mend(y, rings, bench):
    """Flip what is not Delaunay's: (a point without room for a neighbour, one whose triangle has turned)."""
    if bench.crossed.any():
        count, full = flips(bench.middle, y, rings, bench.crossed, bench.changed, bench.stack)
        bench.flipped[0] += count
        if full >= 0:
            return full, -1
        for i in range(len(bench.changed)):
            if bench.changed[i]:
                bench.changed[i] = False
                geometry(i, i + 1, bench.middle, rings, bench.V, bench.pull, bench.crossed)
    for i in range(len(bench.V)):
        if not bench.V[i] > 0:
            return -1, i
    return -1, -1


@jit
def fastest(bench):
    """The largest |grad v| of free points."""
    largest = 0.0
    for i in range(len(bench.V)):
        largest = max(largest, bench.strain[i]*bench.free[i])
    return np.sqrt(largest)


@jit
def move(first, last, dt, shift, bench, y):
    """Points go on; then they follow the fluid, and shift to the middle of their triangles."""
    for i in range(u64(first), u64(last)):
        y[0, i] += dt*y[2, i]
        y[1, i] += dt*y[3, i]
        y[2, i] = bench.free[i]*(y[4, i]/y[6, i] + shift*bench.pull[i, 0])
        y[3, i] = bench.free[i]*(y[5, i]/y[6, i] + shift*bench.pull[i, 1])
