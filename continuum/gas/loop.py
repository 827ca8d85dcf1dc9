"""Compiled loop of the compressible grid [KHP95, Sec. V]: v, e at nodes; rho, P, Q in cells.

A block `S[field, j, i]` holds the state; j counts rows upwards, i columns. Nodes are (1..ny+1, 1..nx+1), the
outer ones on the walls; between periodic sides the last node repeats the first. Cell (j, i) has node (j, i)
as its lower left corner. Ghosts lie outside: `ghosts.fill` sets them, the loop knows no walls.
"""
from continuum.fluid import conductivity, pressure, stress, temperature, viscosity
from continuum.gas.ghosts import RHO, VX, VY, E, EdgeHeat, FluxForm, PaperForm, fill, node_density
from continuum.jit import generic, jit

BULK_VISCOSITY = 0.0  # [KHP95, Sec. II]


@generic
def density_rate(form, S, n, j, i):
    """d rho/dt times 2 h in cell (j, i); n[j % 2, i] is the density at node (j, i)."""


@density_rate.of(FluxForm)
def _(form, S, n, j, i):
    """-div(rho v) times 2 h, from the mass fluxes through the faces of cell (j, i)."""
    vx, vy, a, b = S[VX], S[VY], j % 2, (j + 1) % 2
    return (n[a, i]*(vx[j, i] + vy[j, i]) - n[a, i + 1]*(vx[j, i + 1] - vy[j, i + 1])
            + n[b, i]*(vx[j + 1, i] - vy[j + 1, i]) - n[b, i + 1]*(vx[j + 1, i + 1] + vy[j + 1, i + 1]))


@density_rate.of(PaperForm)
def _(form, S, n, j, i):
    rho = S[RHO]
    (vx, vx_x, _), (vy, _, vy_y) = corners(S[VX], j, i), corners(S[VY], j, i)
    return -(rho[j, i]*(vx_x + vy_y)
             + vx*(rho[j, i + 1] - rho[j, i - 1]) + vy*(rho[j + 1, i] - rho[j - 1, i]))


@generic
def work(form, sxx, sxy, syy, P, f, xx, xy, yx, yy):
    """(sigma - P):grad v times 2 h, from sigma - P and differences of v times 2 h; f is eta/(2 h)."""


@work.of(FluxForm)
@work.of(PaperForm)
def _(form, sxx, sxy, syy, P, f, xx, xy, yx, yy):
    return sxx*xx + sxy*(xy + yx) + syy*yy


@work.of(EdgeHeat)
def _(form, sxx, sxy, syy, P, f, xx, xy, yx, yy):
    return f*((xx*xx + yy*yy) + (xy*xy + yx*yx)) - P*(xx + yy)


@jit
def corners(f, j, i):
    """Mean over the corners of cell (j, i), and slopes along x and y times 2 h."""
    sw, se, nw, ne = f[j, i], f[j, i + 1], f[j + 1, i], f[j + 1, i + 1]
    up, down = ne - sw, se - nw
    return 0.25*((sw + ne) + (se + nw)), up + down, up - down


@jit
def node_row(eos, S, n, T, j):
    """Density and temperature at the nodes of row j."""
    for i in range(1, S.shape[2]):
        n[i] = node_density(S[RHO], j, i)
        T[i] = temperature(eos, n[i], S[E, j, i])


@jit
def cell_row(eos, law, form, box, S, n, T, cell, out, j):
    """Set sigma - P, k grad T and `work` in the cells of row j, and the rate of their density."""
    to_slope = 0.5/box.h
    rho, nx = S[RHO], S.shape[2] - 2
    a, b = j % 2, (j + 1) % 2
    for i in range(1, nx + 1):
        _, xx, yx = corners(S[VX], j, i)
        _, xy, yy = corners(S[VY], j, i)
        e = 0.25*((S[E, j, i] + S[E, j + 1, i + 1]) + (S[E, j, i + 1] + S[E, j + 1, i]))
        up, down = T[b, i + 1] - T[a, i], T[a, i + 1] - T[b, i]
        theta = temperature(eos, rho[j, i], e)
        eta, k = viscosity(law, rho[j, i], theta), conductivity(law, rho[j, i], theta)
        P = pressure(eos, rho[j, i], e)
        sxx, sxy, syy = stress(to_slope*eta, BULK_VISCOSITY, xx, xy, yx, yy)
        sxx, syy = sxx - P, syy - P
        cell[0, i], cell[1, i], cell[2, i] = sxx, sxy, syy
        cell[3, i], cell[4, i] = to_slope*k*(up + down), to_slope*k*(up - down)
        cell[5, i] = work(form, sxx, sxy, syy, P, to_slope*eta, xx, xy, yx, yy)
        out[RHO, j, i] = to_slope*density_rate(form, S, n, j, i)
    cell[:, 0] = cell[:, nx]


@jit
def rate_row(box, S, n, low, high, out, j):
    """dv/dt = -v.grad v + div(sigma - P)/rho - g, de/dt = -v.grad e + (work - div Q)/rho at nodes."""
    to_slope = 0.5/box.h
    for i in range(box.first, S.shape[2] - 1):
        vx, vy, per_mass = S[VX, j, i], S[VY, j, i], 1/n[i]
        xx_up, xx_down = high[0, i] - low[0, i - 1], low[0, i] - high[0, i - 1]
        xy_up, xy_down = high[1, i] - low[1, i - 1], low[1, i] - high[1, i - 1]
        yy_up, yy_down = high[2, i] - low[2, i - 1], low[2, i] - high[2, i - 1]
        qx_up, qx_down = high[3, i] - low[3, i - 1], low[3, i] - high[3, i - 1]
        qy_up, qy_down = high[4, i] - low[4, i - 1], low[4, i] - high[4, i - 1]
        work = 0.5*((high[5, i] + low[5, i - 1]) + (low[5, i] + high[5, i - 1]))
        fx = (xx_up + xx_down) + (xy_up - xy_down)
        fy = (xy_up + xy_down) + (yy_up - yy_down)
        heat = (qx_up + qx_down) + (qy_up - qy_down) + 0.5*work
        out[VX, j, i] = to_slope*(fx*per_mass - along(S[VX], vx, vy, j, i))
        out[VY, j, i] = to_slope*(fy*per_mass - along(S[VY], vx, vy, j, i)) - box.g
        out[E, j, i] = to_slope*(heat*per_mass - along(S[E], vx, vy, j, i))


@jit
def along(f, vx, vy, j, i):
    """v.grad f at node (j, i), times 2 h."""
    return vx*(f[j, i + 1] - f[j, i - 1]) + vy*(f[j + 1, i] - f[j - 1, i])


@jit
def rates(sides, eos, law, form, box, S, rows, out):
    """d/dt of the block S; intermediate results are kept for two rows at a time, in `rows` (2, 8, nx + 2)."""
    fill(sides, eos, law, form, box, S)
    n, T, cell, ny = rows[:, 6], rows[:, 7], rows[:, :6], S.shape[1] - 2
    if box.lowest == 1:     # the last row of cells lies below the first; ny must be even
        node_row(eos, S, n[0], T[0], ny)
        node_row(eos, S, n[1], T[1], ny + 1)
        cell_row(eos, law, form, box, S, n, T, cell[0], out, ny)
    node_row(eos, S, n[1], T[1], 1)
    for j in range(1, ny + 1):
        above, here = (j + 1) % 2, j % 2
        node_row(eos, S, n[above], T[above], j + 1)
        cell_row(eos, law, form, box, S, n, T, cell[here], out, j)
        if j >= box.lowest:
            rate_row(box, S, n[here], cell[above], cell[here], out, j)


@jit
def blend(a, b, s, out):
    for f in range(a.shape[0]):
        for j in range(a.shape[1]):
            for i in range(a.shape[2]):
                out[f, j, i] = a[f, j, i] + s*b[f, j, i]


@jit
def advance(sides, eos, law, form, box, S, work, rows, dt, steps):
    """Classical fourth-order Runge-Kutta steps, in place; `work` is three blocks like S, zero on walls."""
    rate, stage, start = work[0], work[1], work[2]
    for _ in range(steps):
        start[:] = S
        for to_stage, weight in ((0.0, 1/6), (0.5, 1/3), (0.5, 1/3), (1.0, 1/6)):
            blend(start, rate, to_stage*dt, stage)
            rates(sides, eos, law, form, box, stage, rows, rate)
            blend(S, rate, weight*dt, S)
    fill(sides, eos, law, form, box, S)
