"""Compiled exchange between points that move with their triangulation; `march` makes the time steps.

The volume of a point grows at the rate sum_j S_ij.(w_i + w_j)/2, w the velocity of points: exactly, if S is
taken at the middle of the step. The fluid, of velocity v, crosses edges at the relative velocity r = w - v.
"""
from collections import namedtuple

import numpy as np

from continuum.fluid import conductivity, diffusivity, energy, pressure, temperature, viscosity
from continuum.jit import formula, jit, jit_records
from particles.neighbours import u64
from particles.pairs import Block, pair_term, sweep
from particles.threads import shared

formula(diffusivity)        # makes it callable from compiled code
#: rows of a state: position, velocity of points, then exchanged: momentum, mass, volume, total energy
ROWS = ("x", "y", "wx", "wy", "px", "py", "m", "V", "E")
EXCHANGED = slice(4, 9)
BLOCK = 32

#: ux, uy share memory with vx, vy, as there are no images: what most loops read fills one cache line
FIELDS = "vx vy rx ry rho P e Td eta k ux uy".split()
OFFSETS = [*range(0, 80, 8), 0, 8]
Point = np.dtype({"names": FIELDS, "formats": ["f8"]*len(FIELDS), "offsets": OFFSETS, "itemsize": 80})


#: Constants of all steps. shift : rate of drift to the triangles' centre, over the largest |grad v|.
Fluid = namedtuple("Fluid", "eos law terms g shift")

#: Scratch memory of a step: fields of points, the state at its start, `geometry` at its middle, gains.
#:
#: strain, stiffness (n,) : |grad v|, and an upper bound of the rate of diffusion over the edges of a point.
#: Stages alone need `before` (5, n): arrays that they do not need share its memory, and strain overwrites V.
#: left (2,) : how many parts of the current step are still to be made, and how many it has.
Bench = namedtuple("Bench", "points before middle spread V strain stiffness pull flow once crossed changed "
                            "stack free flipped left")


@pair_term(4)
def Crossing(term, a, b, ab):
    """Convection at the relative velocity r = w - v, and pressure with its work.

    Mass m' = S.(r_a + r_b)/2 (rho_a + rho_b)/2 carries the mean velocity and (e_a + e_b + v_a.v_b)/2, which
    conserves kinetic energy. The force omits the pressure of the row's own point, since edges close.
    """
    sx, sy = ab.sx, ab.sy
    mass = 0.5*(sx*(a.rx + b.rx) + sy*(a.ry + b.ry))*(a.rho + b.rho)
    P, half = b.P - a.P, 0.5*mass
    work = a.P*(sx*b.vx + sy*b.vy) + b.P*(sx*a.vx + sy*a.vy)
    return (mass, half*(a.vx + b.vx) - sx*P, half*(a.vy + b.vy) - sy*P,
            half*(a.e + b.e + a.vx*b.vx + a.vy*b.vy) - work)


@shared
@jit
def read(first, last, y, eos, law, points):
    """Set the fields of points from the state."""
    for i in range(u64(first), u64(last)):
        a, m = points[i], y[6, i]
        per_m = 1/m
        a.rho, a.vx, a.vy = m/y[7, i], per_m*y[4, i], per_m*y[5, i]
        a.rx, a.ry = y[2, i] - a.vx, y[3, i] - a.vy
        a.e = per_m*y[8, i] - 0.5*(a.vx**2 + a.vy**2)
        a.P, a.Td = pressure(eos, a.rho, a.e), temperature(eos, a.rho, a.e)
        a.eta, a.k = viscosity(law, a.rho, a.Td), conductivity(law, a.rho, a.Td)


@shared
@jit
def follow(first, last, fluid, rings, bench):
    """dV/dt, |grad v|, stiffness, and the stress that forces along edges lack, at the start of a step."""
    points, edges, spread = bench.points, rings.edges, bench.spread
    for i in range(u64(first), u64(last)):
        a, begin = points[i], edges.first[i]
        flow, xx, xy, yx, yy, most = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for e in range(begin, begin + edges.taken[i]):
            b, sx, sy = points[edges.near[e]], edges.sx[e], edges.sy[e]
            du, dv = b.vx - a.vx, b.vy - a.vy
            flow += sx*(a.rx + a.vx + b.rx + b.vx) + sy*(a.ry + a.vy + b.ry + b.vy)
            xx, xy, yx, yy = xx + sx*du, xy + sy*du, yx + sx*dv, yy + sy*dv
            most = max(most, spread[edges.near[e]])
        bench.flow[i], bench.strain[i] = flow, np.sqrt(xx*xx + xy*xy + yx*yx + yy*yy)/bench.V[i]
        bench.stiffness[i] = diffusivity(fluid.eos, fluid.law, a.rho, a.e)*(most + spread[i])
        complete_row(i, 1.0, rings, points, bench.once)


@shared
@jit
def complete(first, last, part, rings, bench):
    for i in range(u64(first), u64(last)):
        complete_row(i, part, rings, bench.points, bench.once)


@formula
def complete_row(i, part, rings, points, once):
    """Update the force and heating that forces along edges lack: once = (1 - part) old + part new.

    The force on corner i of a triangle (i, j, k) is eta R(v_j - v_k)/2, R(x, y) = (y, -x), with the mean eta
    of its corners. Its work on all three corners, eta (v_j - v_i) x (v_k - v_i), is taken from their heat in
    equal shares. So every triangle conserves energy, the result is Galilean invariant, and a rigid rotation
    does not heat.
    """
    a, edges, begin, rim = points[i], rings.edges, rings.edges.first[i], u64(rings.rim[i])
    end = begin + u64(edges.taken[i])
    c = points[edges.near[begin if rim else end - u64(1)]]
    u, v, eta = c.vx - a.vx, c.vy - a.vy, a.eta + c.eta
    px, py, heat = 0.0, 0.0, 0.0
    for e in range(begin + rim, end):
        b = points[edges.near[e]]
        du, dv, mean = b.vx - a.vx, b.vy - a.vy, (eta + b.eta)/3
        px -= 0.5*mean*(dv - v)
        py += 0.5*mean*(du - u)
        heat -= mean*(u*dv - v*du)/3
        u, v, eta = du, dv, a.eta + b.eta
    once[i, 0] += part*(px - once[i, 0])
    once[i, 1] += part*(py - once[i, 1])
    once[i, 2] += part*(heat + px*a.vx + py*a.vy - once[i, 2])


@shared
@jit_records
def stage(first, last, dt, new, fluid, edges, bench, y):
    """Runge-Kutta stage (1 - new) before + new (now + dt d/dt), in a form that rounds less than this sum."""
    sums, before, once, g = np.empty((BLOCK, 4)), bench.before, bench.once, fluid.g
    for begin in range(u64(first), u64(last), u64(BLOCK)):
        end = min(begin + u64(BLOCK), u64(last))
        sweep(begin, end, fluid.terms, bench.points, edges, Block(begin, sums))
        for i in range(begin, end):
            s, m, py = sums[i - begin], y[6, i], y[5, i]
            y[4, i] = later(before[0, i], y[4, i], new, dt*(s[1] + once[i, 0]))
            y[5, i] = later(before[1, i], py, new, dt*(s[2] + once[i, 1] - g*m))
            y[6, i] = later(before[2, i], m, new, dt*s[0])
            y[7, i] = later(before[3, i], y[7, i], new, dt*bench.flow[i])
            y[8, i] = later(before[4, i], y[8, i], new, dt*(s[3] + once[i, 2] - g*py))


@formula
def later(before, now, new, change):
    return before + new*(now - before + change)


@jit
def heat(held, part, once):
    """Add to `once` the heat given to held points; `hold` overrides it where a temperature is prescribed."""
    which, _, _, _, given = held
    for s in range(len(which)):
        once[which[s], 2] += part*given[s]


@jit
def hold(eos, held, y):
    """Set momentum of held points, and energy of those with a temperature; add the side's work to others."""
    which, v, T, _, _ = held
    for s in range(len(which)):
        i = which[s]
        m = y[6, i]
        y[8, i] += v[s, 0]*(m*v[s, 0] - y[4, i]) + v[s, 1]*(m*v[s, 1] - y[5, i])
        y[4, i], y[5, i] = m*v[s, 0], m*v[s, 1]
        if T[s] == T[s]:        # not nan
            y[8, i] = m*(energy(eos, m/y[7, i], T[s]) + 0.5*(v[s, 0]**2 + v[s, 1]**2))


@jit
def receive(fluid, rings, held, y, bench, received):
    """Momentum and energy that held points take per time; `rings` must have the geometry of this state."""
    (which, v, T, _, given), n, eos = held, y.shape[1], fluid.eos
    read(None, n, y, eos, fluid.law, bench.points)
    follow(None, n, fluid, rings, bench)
    sums = np.empty((1, 4))
    for s in range(len(which)):
        i, once = which[s], bench.once[which[s]]
        sweep(i, i + 1, fluid.terms, bench.points, rings.edges, Block(i, sums))
        mass, m, V, e = sums[0, 0], y[6, i], y[7, i], bench.points[i].e
        fx, fy = sums[0, 1] + once[0] - v[s, 0]*mass, sums[0, 2] + once[1] - v[s, 1]*mass
        taken = fx*v[s, 0] + fy*v[s, 1] - given[s]
        if T[s] == T[s]:
            rho, d = m/V, 1e-6*m/V
            slope = (energy(eos, rho + d, T[s]) - energy(eos, rho - d, T[s]))/(2*d)
            change = mass*e + slope*(mass - rho*bench.flow[i])*rho
            taken = sums[0, 3] + once[2] - change - 0.5*(v[s, 0]**2 + v[s, 1]**2)*mass
        received[s, 0], received[s, 1], received[s, 2] = fx, fy, taken
