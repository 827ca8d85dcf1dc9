"""States of the compressible grid, and measurements: K, Nusselt numbers, rolls, interpolated values."""
from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import RectBivariateSpline

from continuum.fluid import Fields, conductivity, energy, pressure, stress, temperature, viscosity
from continuum.gas.ghosts import RHO, VX, VY, E
from continuum.scene import ROLL_ENERGY, columns_of
from continuum.steady import STILL

#: Values of the fields at points.
Values = namedtuple("Values", "vx vy e T rho")


@dataclass(frozen=True)
class NodeFields:
    """A state on its grid; `at` : values at nodes, walls included, (rows+1, columns+1); `cells` : densities.

    `x`, `y` are the coordinates of the nodes; rows go up. Between periodic sides the last column repeats the
    first, on a torus the last row, too.
    """
    scene: Any
    x: np.ndarray
    y: np.ndarray
    at: Values
    cells: np.ndarray

    @property
    def h(self) -> float:
        return float(self.y[1] - self.y[0])

    @property
    def periodic(self) -> bool:
        return bool(self.scene.sides.axes[0])


def at_nodes(fields: NodeFields) -> Fields:
    """Fields of nodes, row by row upwards; nodes on walls have half of the volume of a cell, corners 1/4."""
    columns, rows = map(shares, (len(fields.x), len(fields.y)), fields.scene.sides.axes)
    kept = np.ix_(rows > 0, columns > 0)
    X, Y, V = *np.meshgrid(fields.x, fields.y), fields.h**2*np.outer(rows, columns)
    x, y, vx, vy, rho, T, V = (q[kept].ravel()
                               for q in (X, Y, fields.at.vx, fields.at.vy, fields.at.rho, fields.at.T, V))
    return Fields(np.stack([x, y], axis=1), np.stack([vx, vy], axis=1), rho, T, V)


def shares(nodes: int, periodic: bool) -> np.ndarray:
    """Fraction of a cell per node along a line: its last node repeats the first, or its ends are on walls."""
    share = np.ones(nodes)
    share[[0, -1]] = (1.0, 0.0) if periodic else 0.5
    return share


def nodes(scene, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """x of the columns and y of the rows of nodes. Raises ValueError as `columns_of` does."""
    columns = columns_of(scene.aspect, rows)
    return scene.width*np.linspace(-0.5, 0.5, columns + 1), scene.L*np.linspace(-0.5, 0.5, rows + 1)


def initial(scene, rows: int, ke: float = ROLL_ENERGY, rolls: int | None = None) -> NodeFields:
    """Initial rolls of kinetic energy `ke` per mass with linear temperature    [KHP95, Sec. VI]"""
    return placed(scene, rows, lambda x, y: (1.0, *scene.flow(x, y, ke, rolls), scene.T(y)))


def placed(scene, rows: int, start: Callable[[np.ndarray, np.ndarray], tuple]) -> NodeFields:
    """Fields of start(x, y) = (rho, v_x, v_y, T): densities at the centres of cells, all else at nodes."""
    x, y = nodes(scene, rows)
    rho, vx, vy, T = (np.broadcast_to(f, (len(y), len(x))).copy() for f in start(*np.meshgrid(x, y)))
    middle = np.meshgrid((x[1:] + x[:-1])/2, (y[1:] + y[:-1])/2)
    cells = np.broadcast_to(start(*middle)[0], middle[0].shape).copy()
    return NodeFields(scene, x, y, Values(vx, vy, energy(scene.eos, rho, T), T, rho), cells)


def block(fields: NodeFields) -> np.ndarray:
    """The block S for the loop; its ghosts are not yet filled."""
    S = np.ones((4, len(fields.y) + 1, len(fields.x) + 1))
    S[VX, 1:, 1:], S[VY, 1:, 1:], S[E, 1:, 1:] = fields.at[:3]
    S[RHO, 1:-1, 1:-1] = fields.cells
    along_x, along_y = fields.scene.sides.axes
    if not along_y:
        S[:2, [1, -1]] = 0
    if not along_x:
        S[:2, :, [1, -1]] = 0
    return S


def unblock(scene, S: np.ndarray) -> NodeFields:
    """Fields of a block whose ghosts are filled."""
    x, y = nodes(scene, S.shape[1] - 2)
    rho = mean(S[RHO])
    vx, vy, e = (S[f, 1:, 1:].copy() for f in (VX, VY, E))
    at = Values(vx, vy, e, temperature(scene.eos, rho, e), rho)
    return NodeFields(scene, x, y, at, S[RHO, 1:-1, 1:-1].copy())


def interpolate(fields: NodeFields, x, y) -> Values:
    """Values at (x, y) by cubic splines through the nodes. Raises ValueError: points outside of the box."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    if fields.periodic:
        x = fields.x[0] + (x - fields.x[0]) % fields.scene.width
    for name, q, grid in (("x", x, fields.x), ("y", y, fields.y)):
        room = 1e-9*fields.h
        if np.any((q < grid[0] - room) | (q > grid[-1] + room)):
            raise ValueError(f"{name} goes from {q.min():.6g} to {q.max():.6g}, the box from {grid[0]:.6g} "
                             f"to {grid[-1]:.6g}: ask for points inside")
    return Values(*(spline(fields, f)(y, x, grid=False) for f in fields.at))


def spline(fields: NodeFields, f: np.ndarray) -> RectBivariateSpline:
    if not fields.periodic:
        return RectBivariateSpline(fields.y, fields.x, f)
    more = 4
    wide = np.pad(f[:, :-1], ((0, 0), (more, more + 1)), mode="wrap")
    return RectBivariateSpline(fields.y, fields.x[0] + fields.h*np.arange(-more, len(fields.x) + more), wide)


def onto(scene, rows: int, fields: NodeFields) -> NodeFields:
    """`fields` on another grid or in another scene of the same shape; interpolated, the mean density is 1."""
    x, y = nodes(scene, rows)
    scale = scene.L/fields.scene.L
    if len(x) == len(fields.x) and len(y) == len(fields.y):
        return NodeFields(scene, x, y, fields.at, fields.cells)
    X, Y = np.meshgrid(x, y)
    centre_x, centre_y = X[:-1, :-1] + scene.L/rows/2, Y[:-1, :-1] + scene.L/rows/2
    cells = interpolate(fields, centre_x/scale, centre_y/scale).rho
    return NodeFields(scene, x, y, interpolate(fields, X/scale, Y/scale), cells/cells.mean())


def kinetic_energy(S: np.ndarray) -> float:
    """Kinetic energy per mass K of a block, in sigma^2 per time^2 (free-fall units for the ideal gas)."""
    rho = mean(S[RHO])[:, :-1]  # the last column of nodes repeats the first or is at rest
    v2 = S[VX, 1:, 1:-1]**2 + S[VY, 1:, 1:-1]**2
    return float(0.5*np.sum(rho*v2)/np.sum(S[RHO, 1:-1, 1:-1]))


def count_rolls(fields: NodeFields) -> int:
    """Number of rolls: changes of sign of v_y along mid-height; 0 at rest."""
    v = fields.at.vy[len(fields.y)//2]
    if np.max(v**2)/2 < STILL:
        return 0
    up = v[np.abs(v) > 1e-6*np.abs(v).max()] > 0
    return int(np.sum(up[1:] != up[:-1]) + (fields.periodic and up[-1] != up[0]))


class Nusselt(NamedTuple):
    """Heat fluxes over k dT/L: in at the bottom, out at the top, upwards on average over the volume."""
    bottom: float
    top: float
    volume: float


def nusselt(fields: NodeFields) -> Nusselt:
    """Nusselt numbers; `bottom`, `top` from one-sided second-order gradients."""
    scene, T = fields.scene, fields.at.T
    unit = scene.k*scene.dT/scene.L
    k = conductivity(scene.law, fields.at.rho, T)*np.ones_like(T)
    south, north = (wall_flux(f, q, fields.h)/(unit*scene.aspect*scene.L)
                    for f, q in ((T, k), (T[::-1], k[::-1])))
    return Nusselt(south, -north, float(np.mean(energy_flux(fields)))/unit)


def wall_flux(T: np.ndarray, k: np.ndarray, h: float) -> float:
    """Heat that enters through the first row of nodes."""
    return float(h*np.trapezoid(k[0]*(3*T[0] - 4*T[1] + T[2])/(2*h)))


def energy_flux(fields: NodeFields) -> np.ndarray:
    """Vertical flux of total energy in cells: rho v_y (e + P/rho + v^2/2 + g y) - (sigma.v)_y - k dT/dy. In a
    steady state between periodic sides its mean over x is the heat flux of the plates at every y."""
    scene, (vx, vy, e, T, rho) = fields.scene, fields.at
    (mx, xx, yx), (my, xy, yy), (mT, _, slope) = (corners(f, fields.h) for f in (vx, vy, T))
    carried = mean(vy*(rho*(e + (vx**2 + vy**2)/2 + scene.g*fields.y[:, None]) + pressure(scene.eos, rho, e)))
    _, sxy, syy = stress(viscosity(scene.law, fields.cells, mT), 0.0, xx, xy, yx, yy)
    return carried - (sxy*mx + syy*my) - conductivity(scene.law, fields.cells, mT)*slope


def mean(f: np.ndarray) -> np.ndarray:
    """Means of four: of values at nodes over the corners of a cell, of densities over the cells at a node."""
    return (f[:-1, :-1] + f[1:, :-1] + f[:-1, 1:] + f[1:, 1:])/4


def corners(f: np.ndarray, h: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean, d/dx and d/dy in cells, from values at their corners."""
    up, down = f[1:, 1:] - f[:-1, :-1], f[:-1, 1:] - f[1:, :-1]
    return mean(f), (up + down)/(2*h), (up - down)/(2*h)
