"""Slow readable twin of the compressible grid: whole arrays, no ghosts kept, one line an equation."""
from typing import NamedTuple

import numpy as np

from continuum.fluid import conductivity, energy, pressure, temperature, viscosity
from continuum.gas.ghosts import EdgeHeat, PaperForm
from continuum.scene import Periodic


class State(NamedTuple):
    """v_x, v_y, e at nodes (rows+1, columns+1), rho in cells (rows, columns)."""
    vx: np.ndarray
    vy: np.ndarray
    e: np.ndarray
    rho: np.ndarray

    def plus(self, s, rate):
        return State(*(a + s*b for a, b in zip(self, rate)))


def mean(q):
    return (q[1:, 1:] + q[1:, :-1] + q[:-1, 1:] + q[:-1, :-1])/4


def d_dx(q, h):
    return (q[1:, 1:] + q[:-1, 1:] - q[1:, :-1] - q[:-1, :-1])/(2*h)


def d_dy(q, h):
    return d_dx(q.T, h).T


def around(scene, form, rho):
    """Densities with one ghost cell on every side."""
    outside = (lambda a, b: np.ones_like(a)) if isinstance(form, PaperForm) else (lambda a, b: 2*a - b)
    left, right = outside(rho[:, 0], rho[:, 1]), outside(rho[:, -1], rho[:, -2])
    if isinstance(scene.sides, Periodic):
        left, right = rho[:, -1], rho[:, 0]
    rho = np.column_stack([left, rho, right])
    return np.vstack([outside(rho[0], rho[1]), rho, outside(rho[-1], rho[-2])])


def walls(scene, form, s):
    """The state with the energy of its wall nodes set from their temperature."""
    rho, e = mean(around(scene, form, s.rho)), s.e.copy()
    T = scene.T(np.linspace(-0.5, 0.5, len(e))*scene.L)
    edges = [np.s_[0, :], np.s_[-1, :]]
    if not isinstance(scene.sides, Periodic):
        edges += [np.s_[1:-1, 0], np.s_[1:-1, -1]]
    for edge in edges:
        e[edge] = energy(scene.eos, rho, np.broadcast_to(T[:, None], e.shape))[edge]
    return s._replace(e=e)


def rates(scene, form, s):
    h, law, periodic = scene.L/len(s.rho), scene.law, isinstance(scene.sides, Periodic)
    s = walls(scene, form, s)
    rho_near = around(scene, form, s.rho)
    rho_nodes = mean(rho_near)
    T = temperature(scene.eos, rho_nodes, s.e)

    # in cells
    e, T_cell = mean(s.e), temperature(scene.eos, s.rho, mean(s.e))
    eta, k, P = viscosity(law, s.rho, T_cell), conductivity(law, s.rho, T_cell), pressure(scene.eos, s.rho, e)
    vx_x, vx_y, vy_x, vy_y = d_dx(s.vx, h), d_dy(s.vx, h), d_dx(s.vy, h), d_dy(s.vy, h)
    sxx, sxy, syy = eta*(vx_x - vy_y) - P, eta*(vx_y + vy_x), eta*(vy_y - vx_x) - P
    qx, qy = -k*d_dx(T, h), -k*d_dy(T, h)
    work = sxx*vx_x + sxy*(vx_y + vy_x) + syy*vy_y
    if isinstance(form, EdgeHeat):
        work = eta*(vx_x**2 + vx_y**2 + vy_x**2 + vy_y**2) - P*(vx_x + vy_y)
    if isinstance(form, PaperForm):
        rho_x = (rho_near[1:-1, 2:] - rho_near[1:-1, :-2])/(2*h)
        rho_y = (rho_near[2:, 1:-1] - rho_near[:-2, 1:-1])/(2*h)
        rho_t = -s.rho*(vx_x + vy_y) - mean(s.vx)*rho_x - mean(s.vy)*rho_y
    else:
        rho_t = -d_dx(rho_nodes*s.vx, h) - d_dy(rho_nodes*s.vy, h)

    # at nodes that move
    wide = (lambda q: np.column_stack([q[:, -1], q, q[:, 0]])) if periodic else (lambda q: q)
    nodes = (lambda q: np.column_stack([q[:, -2], q, q[:, 1]])) if periodic else (lambda q: q)
    inside = np.s_[1:-1, :] if periodic else np.s_[1:-1, 1:-1]
    vx, vy, rho = s.vx[inside], s.vy[inside], rho_nodes[inside]

    def along(f):
        f = nodes(f)
        return vx*(f[1:-1, 2:] - f[1:-1, :-2])/(2*h) + vy*(f[2:, 1:-1] - f[:-2, 1:-1])/(2*h)

    out = State(*(np.zeros_like(f) for f in s[:3]), rho_t)
    out.vx[inside] = (d_dx(wide(sxx), h) + d_dy(wide(sxy), h))/rho - along(s.vx)
    out.vy[inside] = (d_dx(wide(sxy), h) + d_dy(wide(syy), h))/rho - along(s.vy) - scene.g
    out.e[inside] = (mean(wide(work)) - d_dx(wide(qx), h) - d_dy(wide(qy), h))/rho - along(s.e)
    return out


def step(scene, form, s, dt):
    """One classical Runge-Kutta step."""
    a = rates(scene, form, s)
    b = rates(scene, form, s.plus(dt/2, a))
    c = rates(scene, form, s.plus(dt/2, b))
    d = rates(scene, form, s.plus(dt, c))
    return walls(scene, form, s.plus(dt/6, a).plus(dt/3, b).plus(dt/3, c).plus(dt/6, d))
