"""Compiled rates of the equations in `continuum.pypde.gas`.

`S[field, i, j]` holds the state and the fields derived from it, with one row of ghosts around; i counts
columns, j rows. rho, e, T, coefficients and normal stresses are in cell (i, j), v_x on its right and v_y on
its upper side, the shear stress at its upper right corner.
"""

from collections import namedtuple

import numpy as np

from continuum.fluid import conductivity, pressure, stress, temperature, viscosity
from continuum.gas.loop import BULK_VISCOSITY
from continuum.jit import formula, jit

RHO, VX, VY, E, T, ETA, K, SXX, SYY, SXY = range(10)


#: Data that the loops need besides fluid and state. torus : whether y is periodic, too, without plates.
Mesh = namedtuple("Mesh", "h g T_hot T_cold torus")


@jit
def fill(box, data, S):
    """Copy the state into S and set ghosts: periodic in x, no slip at plates, rho and e extrapolated."""
    nx, ny = data.shape[1:]
    for f in range(4):
        a, b = ((2.0, -1.0), (-1.0, 0.0), (0.0, 0.0), (2.0, -1.0))[f]
        for i in range(1, nx + 1):
            for j in range(1, ny + 1):
                S[f, i, j] = data[f, i - 1, j - 1]
            if box.torus:
                S[f, i, 0], S[f, i, ny + 1] = S[f, i, ny], S[f, i, 1]
            else:
                S[f, i, 0] = a*S[f, i, 1] + b*S[f, i, 2]
                S[f, i, ny + 1] = a*S[f, i, ny] + b*S[f, i, ny - 1]
        for j in range(ny + 2):
            S[f, 0, j], S[f, nx + 1, j] = S[f, nx, j], S[f, 1, j]


@jit
def coefficients(eos, law, box, S):
    """Set temperature, viscosity and conductivity in all cells, ghosts included."""
    nx, ny = S.shape[1] - 2, S.shape[2] - 2
    for i in range(nx + 2):
        for j in range(1, ny + 1):
            S[T, i, j] = temperature(eos, S[RHO, i, j], S[E, i, j])
        if box.torus:
            S[T, i, 0], S[T, i, ny + 1] = S[T, i, ny], S[T, i, 1]
        else:
            S[T, i, 0] = 2*box.T_hot - S[T, i, 1]
            S[T, i, ny + 1] = 2*box.T_cold - S[T, i, ny]
        for j in range(ny + 2):
            S[ETA, i, j] = viscosity(law, S[RHO, i, j], S[T, i, j])
            S[K, i, j] = conductivity(law, S[RHO, i, j], S[T, i, j])


@formula
def corner_strain(box, S, i, j):
    """d v_x/dy + d v_y/dx at the upper right corner of a cell."""
    return (S[VX, i, j + 1] - S[VX, i, j] + S[VY, i + 1, j] - S[VY, i, j])/box.h


@formula
def cell_strain(box, S, i, j):
    """(d v_x/dx, d v_y/dy) in a cell."""
    return (S[VX, i, j] - S[VX, i - 1, j])/box.h, (S[VY, i, j] - S[VY, i, j - 1])/box.h


@jit
def stresses(eos, box, S):
    """Set normal components of sigma - P in cells and the shear stress at upper right corners."""
    for i in range(S.shape[1] - 1):
        for j in range(S.shape[2] - 1):
            eta = 0.25*(S[ETA, i, j] + S[ETA, i + 1, j] + S[ETA, i, j + 1] + S[ETA, i + 1, j + 1])
            S[SXY, i, j] = eta*corner_strain(box, S, i, j)
    for i in range(1, S.shape[1]):
        for j in range(1, S.shape[2] - (0 if box.torus else 1)):
            xx, yy = cell_strain(box, S, i, j)
            sxx, _, syy = stress(S[ETA, i, j], BULK_VISCOSITY, xx, 0.0, 0.0, yy)
            P = pressure(eos, S[RHO, i, j], S[E, i, j])
            S[SXX, i, j], S[SYY, i, j] = sxx - P, syy - P


@formula
def compress(box, S, i, j):
    """-div(rho v) in a cell."""
    rho = S[RHO]
    right, left = (rho[i, j] + rho[i + 1, j])*S[VX, i, j], (rho[i - 1, j] + rho[i, j])*S[VX, i - 1, j]
    up, down = (rho[i, j] + rho[i, j + 1])*S[VY, i, j], (rho[i, j - 1] + rho[i, j])*S[VY, i, j - 1]
    return -0.5*((right - left) + (up - down))/box.h


@formula
def carry(box, u, v, i, j):
    """v.grad u on the side of a cell where u sits, the velocity along i; v is the other component."""
    along = (u[i + 1, j] + u[i, j])*(u[i + 1, j] - u[i, j]) + (u[i, j] + u[i - 1, j])*(u[i, j] - u[i - 1, j])
    across = ((v[i, j] + v[i + 1, j])*(u[i, j + 1] - u[i, j])
              + (v[i, j - 1] + v[i + 1, j - 1])*(u[i, j] - u[i, j - 1]))
    return 0.25*(along + across)/box.h


@formula
def carry_e(box, S, i, j):
    """v.grad e in a cell."""
    u, v, e = S[VX], S[VY], S[E]
    along = u[i, j]*(e[i + 1, j] - e[i, j]) + u[i - 1, j]*(e[i, j] - e[i - 1, j])
    across = v[i, j]*(e[i, j + 1] - e[i, j]) + v[i, j - 1]*(e[i, j] - e[i, j - 1])
    return 0.5*(along + across)/box.h


@formula
def push(box, normal, shear, rho, i, j):
    """Component along i of div (sigma - P)/rho, on the side of a cell where that velocity sits."""
    force = (normal[i + 1, j] - normal[i, j]) + (shear[i, j] - shear[i, j - 1])
    return 2*force/(rho[i, j] + rho[i + 1, j])/box.h


@formula
def corner_work(box, S, i, j):
    """sigma_xy times the shear rate at the upper right corner of a cell."""
    return S[SXY, i, j]*corner_strain(box, S, i, j)


@formula
def work(box, S, i, j):
    """(sigma - P):grad v in a cell."""
    xx, yy = cell_strain(box, S, i, j)
    shear = (corner_work(box, S, i, j) + corner_work(box, S, i - 1, j)
             + corner_work(box, S, i, j - 1) + corner_work(box, S, i - 1, j - 1))
    return S[SXX, i, j]*xx + S[SYY, i, j]*yy + 0.25*shear


@formula
def conduct(box, S, i, j):
    """-div Q in a cell."""
    k, T_ = S[K], S[T]
    along = ((k[i + 1, j] + k[i, j])*(T_[i + 1, j] - T_[i, j])
             - (k[i, j] + k[i - 1, j])*(T_[i, j] - T_[i - 1, j]))
    across = ((k[i, j + 1] + k[i, j])*(T_[i, j + 1] - T_[i, j])
              - (k[i, j] + k[i, j - 1])*(T_[i, j] - T_[i, j - 1]))
    return 0.5*(along + across)/box.h**2


@jit
def rate(loop, data):
    """d/dt of the state as a new array, (fields, columns, rows); loop : equation of state, law, `Mesh`."""
    (eos, law, box), (nx, ny) = loop, data.shape[1:]
    S, out = np.empty((10, nx + 2, ny + 2)), np.empty_like(data)
    fill(box, data, S)
    coefficients(eos, law, box, S)
    stresses(eos, box, S)
    for i in range(1, nx + 1):
        for j in range(1, ny + 1):
            out[RHO, i - 1, j - 1] = compress(box, S, i, j)
            out[VX, i - 1, j - 1] = (push(box, S[SXX], S[SXY], S[RHO], i, j)
                                     - carry(box, S[VX], S[VY], i, j))
            gained = work(box, S, i, j) + conduct(box, S, i, j)
            out[E, i - 1, j - 1] = gained/S[RHO, i, j] - carry_e(box, S, i, j)
        out[VY, i - 1, ny - 1] = 0.0
        for j in range(1, ny + (1 if box.torus else 0)):
            out[VY, i - 1, j - 1] = (push(box, S[SYY].T, S[SXY].T, S[RHO].T, j, i)
                                     - carry(box, S[VY].T, S[VX].T, j, i) - box.g)
    return out
