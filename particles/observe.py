"""Quantities of smooth particles, from up-to-date sums and a state whose first rows are x, y, vx, vy, e.

KHP95 do not say which kinetic energy their figures show, so all three are kept: Kp of the particles, Kg of
the smoothed field, Kfl = Kp - Kg of the fluctuations.
"""
from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import conductivity, energy, stress, temperature, viscosity
from particles.neighbours import make_lists, sort_into_cells, u32, u64
from particles.pairs import Pairs, entries, interpolate, sweep

#: Smoothed density, velocity, energy per mass and temperature at places, as arrays of their shape.
Smoothed = namedtuple("Smoothed", "rho vx vy e T")


def fields_at(sums: Any, state: np.ndarray, x: np.ndarray, y: np.ndarray) -> Smoothed:
    """rho = sum m w, rho v = sum m v w, rho e = sum m e w at places (x, y)    [KHP95, Sec. II]"""
    around, method = sums.around, sums.method
    e = np.concatenate([state[4], energy(method.eos, around.rho[sums.n:], around.T[sums.n:])])
    shares = np.ones_like(e)
    shares[:sums.n] = sums.shares(state)
    for _, parent, first, last in around.blocks:
        shares[first:last] = shares[parent]
    values = np.stack([np.ones_like(e), around.vx, around.vy, e], axis=1)*shares[:, None]
    out = np.empty((np.size(x), 4))
    cells = sort_into_cells(around.x, around.y, method.weight.h/2)
    at = np.ravel(x).astype(float), np.ravel(y).astype(float)
    lists = make_lists(sums.threads, cells, *at, method.weight.h, 2*len(e))
    sums.threads(interpolate, len(out), method.weight, method.m, *at, lists, around.x, around.y, values, out)
    rho, vx, vy, e = (column.reshape(np.shape(x)) for column in out.T)
    return Smoothed(rho, vx/rho, vy/rho, e/rho, temperature(method.eos, rho, e/rho))


def particle_kinetic(sums: Any, state: np.ndarray) -> float:
    """Kp: kinetic energy per mass of the particles."""
    return float(0.5*np.mean(sums.shares(state)*(state[2]**2 + state[3]**2)))


def field_kinetic(sums: Any, state: np.ndarray) -> float:
    """Kg: kinetic energy per mass of the smoothed field <v> at the particles    [KHP95, Sec. VI]"""
    at = fields_at(sums, state, state[0], state[1])
    return float(0.5*np.mean(sums.shares(state)*(at.vx**2 + at.vy**2)))


def heat_flow(sums: Any, state: np.ndarray) -> float:
    """Mean upward energy flux Q_y + rho v_y (e + P/rho + v^2/2 + g y) - (stress.v)_y: steady Nu."""
    n, around, method = sums.n, sums.around, sums.method
    _, y, vx, vy, e = state[:5]
    rho, T = around.rho[:n], around.T[:n]
    gx_vx, gx_vy, _, _, gy_vx, gy_vy, gy_T, _ = sums.slopes[:n].T
    _, sxy, syy = stress(viscosity(method.law, rho, T), 0.0, gx_vx, gx_vy, gy_vx, gy_vy)
    carried = rho*vy*(e + around.P[:n]/rho + (vx**2 + vy**2)/2 + method.g*y)
    flux = carried - conductivity(method.law, rho, T)*gy_T - sxy*vx - syy*vy
    return float(np.sum(sums.shares(state)*flux*method.m/rho)/(method.box[0]*method.box[1]))


class PlateHeat(NamedTuple):
    """Energy per area and time that particles receive through a plate: side -1 lower, +1 upper.

    The third sum over pairs with points behind the plate: heat, viscous work, and work of pressure if wanted.
    This work is zero at resting plates, but for an error of order dt, as records follow the reflection.
    """
    side: int
    pressure: bool = False

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        """Energy per area and time; densities and gradients must be up to date."""
        term, records = sums.exchange(sums.less if self.pressure else np.zeros_like(sums.less))
        pull = np.zeros((sums.around.rows, sums.pull.shape[1]))
        sums.threads(sweep, sums.n, term, records, pairs_behind(sums, self.side), pull)
        ax, ay, heat, _, work = pull[:sums.n, :5].T
        power = sums.shares(state)*(state[2]*ax + state[3]*ay + heat + work)
        return float(sums.method.m*np.sum(power)/sums.method.box[0])


def pairs_behind(sums: Any, side: int) -> Pairs:
    """Pairs of fluid particles with points behind the lower (-1) or upper (+1) plate."""
    around, pairs, half = sums.around, sums.around.pairs, sums.method.box[1]/2
    row, entry = entries(pairs, np.flatnonzero(side*around.y[:sums.n] > half - sums.method.weight.h))
    behind = side*around.y[pairs.near[entry]] > half
    row, entry = row[behind], entry[behind]
    count = np.bincount(row, minlength=len(pairs.first))
    return pairs._replace(first=(np.cumsum(count) - count).astype(u64), taken=count.astype(u32),
                          near=pairs.near[entry], wx=pairs.wx[entry], wy=pairs.wy[entry])


class Grid(NamedTuple):
    """Smoothed fields (5, rows, columns) at the cell centres of a grid over the box, for `Plan.means`."""
    x: np.ndarray
    y: np.ndarray

    @classmethod
    def over(cls, box: tuple[float, float], rows: int) -> "Grid":
        """Grid of square cells, `rows` over the height; KHP95's Fig. 12 has 30 x 60."""
        columns = round(rows*box[0]/box[1])
        x, y = ((np.arange(columns) + 0.5)*box[0]/columns - box[0]/2,
                (np.arange(rows) + 0.5)*box[1]/rows - box[1]/2)
        return cls(*np.meshgrid(x, y))

    def __call__(self, sums: Any, state: np.ndarray) -> np.ndarray:
        return np.stack(fields_at(sums, state, self.x, self.y))


def wall_layers(sums: Any, state: np.ndarray) -> np.ndarray:
    """(2, 2): density and mean temperature within one spacing of the lower and upper plate."""
    width, height = sums.method.box
    depth = np.sqrt(width*height/sums.n)
    rows = []
    for distance in (state[1] + height/2, height/2 - state[1]):
        near = distance < depth
        rows.append([sums.method.m*near.sum()/(width*depth),
                     sums.around.T[:sums.n][near].mean() if near.any() else np.nan])
    return np.array(rows)
