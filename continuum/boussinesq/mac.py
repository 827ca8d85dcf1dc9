"""Staggered (MAC) discretisation of a box of Boussinesq fluid: boundary conditions, assembled operators.

x runs along the plates over `columns` cells, y across over `rows` cells; the height is 1. T sits in cells, u
on faces between neighbours in x, v on faces between neighbours in y, the streamfunction psi on corners. Faces
in a wall carry no unknown: their normal velocity is zero. A state is a vector q = (u, v, T).

Diffusion is the five-point Laplacian with mirrored values beyond a wall; advection is the centred flux form,
a sum of products D[(A q)(B q)]. With div v = 0 in each cell advection conserves v^2 and T^2, so that the flow
has the energy balances of the exact one: Nu from the plates, from <vT> and from dissipation are equal.
"""
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import sparse

from continuum.scene import positive


class End(Enum):
    """Boundary condition at both ends of an axis, for the velocity along the end or the temperature."""
    MIRROR = "is even about the end: free slip, insulated"
    WALL = "is given on the end: no slip, fixed temperature"


@dataclass(frozen=True, kw_only=True)
class BoxEdges:
    """Flow and heat at both ends of an axis; T on a WALL is low (high) + ramp*position along it."""
    flow: End
    heat: End
    low: float = 0.0
    high: float = 0.0
    ramp: float = 0.0


PLATES = BoxEdges(flow=End.WALL, heat=End.WALL, low=0.5, high=-0.5)
SYMMETRY = BoxEdges(flow=End.MIRROR, heat=End.MIRROR)


@dataclass(frozen=True, kw_only=True)
class Box:
    """Width in heights, sides (left, right), plates (bottom, top); T is 1/2 on hot, -1/2 on cold walls."""
    width: float = 1.0
    sides: BoxEdges = SYMMETRY
    plates: BoxEdges = PLATES

    def __post_init__(self):
        positive(width=self.width)
        if End.WALL not in (self.sides.heat, self.plates.heat):
            raise ValueError("no wall has a temperature: fix it on the plates or on the sides")


HALF_LAYER = Box(width=1.0, sides=SYMMETRY)         # half of the periodic box of aspect 2: one of two rolls


class Axis:
    """Differences and means along an axis of cells; `faces` are those between cells, not those in walls."""

    def __init__(self, cells: int, length: float):
        self.cells, self.faces, self.h = cells, cells - 1, length/cells
        self.centre = (np.arange(cells) + 0.5)*self.h
        self.face = (np.arange(self.faces) + 1.0)*self.h
        left, right = (sparse.eye_array(self.faces, cells, k=k) for k in (0, 1))
        self.grad = ((right - left)/self.h).tocsr()     # faces <- cells
        self.mean = ((right + left)/2).tocsr()
        self.div = (-self.grad.T).tocsr()               # cells <- faces, zero in the walls
        self.back = self.mean.T.tocsr()

    def bend(self, end: End) -> sparse.csr_array:
        """Second difference in cells, with 2 T_wall - T beyond a WALL; terms of T_wall are in `Mac.wall`."""
        return self.div@self.grad - 2*sparse.diags_array(self.wall(1.0, 1.0)*(end is End.WALL))/self.h

    def wall(self, low: float, high: float) -> np.ndarray:
        """low/h in the first cell, high/h in the last: the divergence of fluxes that enter at the ends."""
        return np.r_[low, np.zeros(self.cells - 2), high]/self.h


class Mac:
    """Assembled operators of one box on one grid; `lap` (of u, v, T) is still without nu, nu, kappa."""

    def __init__(self, box: Box, rows: int, columns: int):
        self.box = box
        x, y = self.x, self.y = Axis(columns, box.width), Axis(rows, 1.0)
        self.points = (x.face, y.centre), (x.centre, y.face), (x.centre, y.centre)
        self.shapes = [(len(a), len(b)) for a, b in self.points]
        self.ends = np.cumsum([a*b for a, b in self.shapes])
        self.cell = x.h*y.h/box.width                   # volume of a cell over that of the box
        self.lap = sparse.block_diag(self.diffusion()).tocsr()
        self.wall = np.r_[np.zeros(self.ends[1]), self.wall_heat().ravel()]
        around = sparse.csr_array(tuple(self.ends[:2])), sparse.csr_array((rows*columns, 0))
        self.lift = sparse.block_diag([around[0], cross(columns, y.mean), around[1]]).tocsr()   # v from T
        self.A, self.B, self.D = self.advection()
        self.div = sparse.hstack([cross(x.div, rows), cross(columns, y.div)]).tocsr()
        self.grad = (-self.div.T).tocsr()               # of the pressure, onto (u, v)
        self.curl = sparse.vstack([cross(x.faces, y.div), -cross(x.div, y.faces)]).tocsr()

    def split(self, q: np.ndarray) -> list[np.ndarray]:
        """Views (u, v, T) of a state vector, each indexed [x, y]."""
        return [part.reshape(shape) for part, shape in zip(np.split(q, self.ends[:-1]), self.shapes)]

    def diffusion(self) -> tuple[sparse.csr_array, ...]:
        """Laplacians of u, v, T without the temperatures of walls."""
        x, y, sides, plates = self.x, self.y, self.box.sides, self.box.plates
        u = cross(x.grad@x.div, y.cells) + cross(x.faces, y.bend(plates.flow))
        v = cross(x.bend(sides.flow), y.faces) + cross(x.cells, y.grad@y.div)
        T = cross(x.bend(sides.heat), y.cells) + cross(x.cells, y.bend(plates.heat))
        return u, v, T

    def wall_heat(self) -> np.ndarray:
        """Contribution of the temperatures of walls to Lap T, (columns, rows)."""
        def part(edges, across, along):
            ramp = np.outer(across.wall(1, 1), edges.ramp*along)
            enters = across.wall(edges.low, edges.high)[:, None] + ramp
            return 2/across.h*enters*(edges.heat is End.WALL)
        x, y = self.x, self.y
        return part(self.box.sides, x, y.centre) + part(self.box.plates, y, x.centre).T

    def advection(self) -> tuple[sparse.csr_array, ...]:
        """A, B, D of advection -D[(A q)(B q)] with fluxes uu, vv in cells, uv on corners, uT, vT on faces."""
        x, y = self.x, self.y
        u_x, v_y = cross(x.back, y.cells), cross(x.cells, y.back)
        u_y, v_x = cross(x.faces, y.mean), cross(x.mean, y.faces)
        T_x, T_y = cross(x.mean, y.cells), cross(x.cells, y.mean)
        u, v = (sparse.eye_array(a*b) for a, b in self.shapes[:2])
        no_T = sparse.csr_array((u_x.shape[0], T_x.shape[1]))
        A = [[u_x, None, no_T], [None, v_y, None], [u_y, None, None], [u, None, None], [None, v, None]]
        B = [[u_x, None, None], [None, v_y, None], [None, v_x, None], [None, None, T_x], [None, None, T_y]]
        D = [[cross(x.grad, y.cells), None, cross(x.faces, y.div), None, None],
             [None, cross(x.cells, y.grad), cross(x.div, y.faces), None, None],
             [None, None, None, cross(x.div, y.cells), cross(x.cells, y.div)]]
        blocks: list[Any] = [A, B, D]       # None is zero
        return tuple(sparse.block_array(parts).tocsr() for parts in blocks)


def cross(x, y) -> sparse.csr_array:
    """Operator x on the first index and y on the second; an integer n is the identity of size n."""
    x, y = (sparse.eye_array(part) if isinstance(part, int) else part for part in (x, y))
    return sparse.kron(x, y).tocsr()


mac = lru_cache(maxsize=16)(Mac)        # assembled once per box and grid
