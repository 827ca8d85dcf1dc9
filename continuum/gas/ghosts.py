"""Ghosts and wall values of a block of the compressible grid: densities behind walls, v and e on walls.

See `continuum.gas.loop` for blocks. Each kind of sides has its own formula of `fill`.
"""
from collections import namedtuple
from typing import NamedTuple

from continuum.fluid import conductivity, energy, temperature
from continuum.jit import generic, jit
from continuum.sides import Periodic, Sides, Slip, Torus, Walls

VX, VY, E, RHO = range(4)
FIELDS = ("v_x", "v_y", "e", "rho")


class NodeGrid(NamedTuple):
    """Spacing, gravity, temperatures of the plates, first column and lowest row of nodes that are stepped."""
    h: float
    g: float
    T_hot: float
    T_cold: float
    first: int
    lowest: int = 2


def box_of(scene, rows: int) -> NodeGrid:
    """The `NodeGrid` of a scene on `rows` rows of cells."""
    first, lowest = (1 if periodic else 2 for periodic in scene.sides.axes)
    return NodeGrid(scene.L/rows, float(scene.g), float(scene.T_hot), float(scene.T_cold), first, lowest)


class FluxForm(NamedTuple):
    """d rho/dt = -div(rho v): mass flows between cells and is conserved to round-off."""


class PaperForm(NamedTuple):
    """d rho/dt = -rho div v - v.grad rho, density 1 in the cells outside of the walls    [KHP95, Sec. V]

    The paper prints the density; the form is inferred.
    """


class EdgeHeat(FluxForm):
    """FluxForm with heating eta |grad v|^2, that of forces along edges: rotation heats, too [RR98, Eq. 51]"""


@generic
def outside(form, near, next_):
    """Density in the cell behind a wall, from the densities of the two cells before the wall."""


outside.of(FluxForm)(lambda form, near, next_: 2*near - next_)
outside.of(PaperForm)(lambda form, near, next_: 1.0)


@jit
def extrapolate(form, rho):
    """Set the densities behind the first and the last row."""
    last = rho.shape[0] - 1
    for i in range(rho.shape[1]):
        rho[0, i] = outside(form, rho[1, i], rho[2, i])
        rho[last, i] = outside(form, rho[last - 1, i], rho[last - 2, i])


@jit
def repeat(box, S):
    """Fill the ghosts beyond periodic sides."""
    ny, nx = S.shape[1] - 2, S.shape[2] - 2
    if box.first == 1:
        S[:, :, 0], S[:, :, nx + 1] = S[:, :, nx], S[:, :, 1]
    if box.lowest == 1:
        S[:, 0], S[:, ny + 1] = S[:, ny], S[:, 1]


@jit
def fill_plates(eos, form, box, S):
    """Set ghost densities behind the plates, then the energy of nodes on plates from their temperature."""
    ny, nx = S.shape[1] - 2, S.shape[2] - 2
    rho = S[RHO]
    extrapolate(form, rho)
    for i in range(1, nx + 2):
        S[E, 1, i] = energy(eos, node_density(rho, 1, i), box.T_hot)
        S[E, ny + 1, i] = energy(eos, node_density(rho, ny + 1, i), box.T_cold)


@jit
def node_density(rho, j, i):
    """Mean of the four cells around a node."""
    return 0.25*((rho[j - 1, i - 1] + rho[j - 1, i]) + (rho[j, i - 1] + rho[j, i]))


@generic
def fill(sides, eos, law, form, box, S):
    """Set the ghosts and wall values of the block S."""


@fill.of(Periodic)
def _(sides, eos, law, form, box, S):
    repeat(box, S)
    fill_plates(eos, form, box, S)
    S[E, :, 0] = S[E, :, S.shape[2] - 2]


fill.of(Torus)(lambda sides, eos, law, form, box, S: repeat(box, S))


@fill.of(Walls)
def _(sides, eos, law, form, box, S):
    ny, nx = S.shape[1] - 2, S.shape[2] - 2
    rho = S[RHO]
    extrapolate(form, rho.T)
    fill_plates(eos, form, box, S)
    for j in range(2, ny + 1):
        T = box.T_hot + (box.T_cold - box.T_hot)*(j - 1)/ny
        for i in (1, nx + 1):
            S[E, j, i] = energy(eos, node_density(rho, j, i), T)


#: A side in numbers alone, so that boxes of all kinds share their compiled code.
#:
#: slip : without friction? v : velocity along the side. T, q : temperature, or nan and the heat flux.
SideRule = namedtuple("SideRule", "slip v T q")


def in_loop(sides):
    """Sides as the loop takes them: four are turned into rules; rules of periodic ones are not read."""
    if not isinstance(sides, Sides):
        return sides
    return Sides(*(SideRule(isinstance(side, Slip), *(getattr(side, name, 0.0) for name in "vTq"))
                   for side in sides))


@jit
def node_temperature(eos, S, j, i):
    return temperature(eos, node_density(S[RHO], j, i), S[E, j, i])


@jit
def side_temperature(side, eos, law, box, S, j, i, up, right):
    """T of a node on a side: the given one, or from the slope -q/k inwards, of second order."""
    if side.T == side.T:        # not nan
        return side.T
    near = node_temperature(eos, S, j + up, i + right)
    next_ = node_temperature(eos, S, j + 2*up, i + 2*right)
    T = (4*near - next_)/3
    return T + 2*box.h*side.q/(3*conductivity(law, node_density(S[RHO], j, i), T))


@jit
def fill_side(side, eos, law, box, S, line, first, last):
    """Set velocity and energy of the nodes first..last - 1 of a side. line : component of velocity along the
    side, node (j, i) before the first, direction (up, right) inwards."""
    along, before, beside, up, right = line
    for n in range(first, last):
        j, i = before + n*abs(right), beside + n*abs(up)
        v = S[along]
        v[j, i] = side.v + side.slip*(4*v[j + up, i + right] - v[j + 2*up, i + 2*right])/3
        T = side_temperature(side, eos, law, box, S, j, i, up, right)
        S[E, j, i] = energy(eos, node_density(S[RHO], j, i), T)


@jit
def fill_corner(beside, level, eos, law, box, S, j, i, up, right):
    """Set the energy of a corner, which is at rest: a given T precedes a flux, two of a kind are averaged."""
    a = side_temperature(beside, eos, law, box, S, j, i, 0, right)
    b = side_temperature(level, eos, law, box, S, j, i, up, 0)
    T, known = 0.5*(a + b), beside.T == beside.T
    if known != (level.T == level.T):
        T = a if known else b
    S[E, j, i] = energy(eos, node_density(S[RHO], j, i), T)


@jit
def even_out(rho):
    """Remove the chessboard mode from the densities of a closed box. No node sees this mode, and flow along
    sides that end in corners would feed it for ever. The mass does not change."""
    ny, nx, squares = rho.shape[0] - 2, rho.shape[1] - 2, 0.0
    for j in range(1, ny + 1):
        for i in range(1, nx + 1):
            squares += (1 - 2*((i + j) % 2))*rho[j, i]
    squares /= nx*ny
    for j in range(1, ny + 1):
        for i in range(1, nx + 1):
            rho[j, i] -= (1 - 2*((i + j) % 2))*squares


@fill.of(Sides)
def _(sides, eos, law, form, box, S):
    ny, nx = S.shape[1] - 2, S.shape[2] - 2
    left, right, bottom, top = sides
    repeat(box, S)
    if box.first == 2 and box.lowest == 2:
        even_out(S[RHO])
    if box.first == 2:
        extrapolate(form, S[RHO].T)
    if box.lowest == 2:
        extrapolate(form, S[RHO])
    if box.first == 2:
        fill_side(left, eos, law, box, S, (VY, 0, 1, 0, 1), box.lowest, ny + 1)
        fill_side(right, eos, law, box, S, (VY, 0, nx + 1, 0, -1), box.lowest, ny + 1)
    if box.lowest == 2:
        fill_side(bottom, eos, law, box, S, (VX, 1, 0, 1, 0), box.first, nx + 1)
        fill_side(top, eos, law, box, S, (VX, ny + 1, 0, -1, 0), box.first, nx + 1)
    if box.first == 2 and box.lowest == 2:
        fill_corner(left, bottom, eos, law, box, S, 1, 1, 1, 1)
        fill_corner(right, bottom, eos, law, box, S, 1, nx + 1, 1, -1)
        fill_corner(left, top, eos, law, box, S, ny + 1, 1, -1, 1)
        fill_corner(right, top, eos, law, box, S, ny + 1, nx + 1, -1, -1)
    repeat(box, S)
