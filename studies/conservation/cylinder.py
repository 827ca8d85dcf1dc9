"""A stream of points that stay through a square array of cylinders: points, edges, what is measured."""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from continuum.exact.cylinder import drag_of
from continuum.fluid import ConstEta, IdealGas
from particles.integral.bodies import held, in_disc, with_surface
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.integral.stream import Stream, Streaming
from particles.integral.triangulation import delaunay
from particles.weights import Lucy

RANGE = 2.0             # spacings: of Lucy's weight, where edges have one
PRESSURE = 0.05         # chi nu/(a^2 c^2) of the filter of the density


class Cell(NamedTuple):
    """Points of spacing 1, numbers of those that are the body, edges."""

    points: Points
    body: np.ndarray
    edges: Edges


class Obstacle(NamedTuple):
    """Points and edges of a body. grown : spacings by which the frozen disc exceeds the body."""

    name: str
    make: Callable[[int, float], Cell]
    grown: float = 0.0
    filtered: float = PRESSURE

    def cell(self, rows: int, radius: float) -> Cell:
        """One cell of the array, ``rows`` spacings wide."""
        return self.make(rows, radius + self.grown)


def frozen(rows: int, radius: float) -> Cell:
    """Lattice points within the disc."""
    points = lattice((rows, rows))
    return Cell(points, in_disc(points, radius), renormalised(points, Lucy.of(h=RANGE)))


def triangulated(rows: int, radius: float) -> Cell:
    """Points on the circle, edges of a triangulation."""
    points, body = with_surface((rows, rows), radius)
    return Cell(points, body, delaunay(points))


VARIANTS = {variant.name: variant for variant in (
    Obstacle("surface", triangulated),
    Obstacle("surface-unfiltered", triangulated, filtered=0.0),
    Obstacle("frozen", frozen),
    Obstacle("frozen-grown", frozen, grown=0.5))}


def radius_of(rows: int, fraction: float) -> float:
    """Radius in spacings."""
    return rows*float(np.sqrt(fraction/np.pi))


def stream(variant: Obstacle, fraction: float, rows: int, speed: float, eta: float) -> Stream:
    """A gas of viscosity eta that is pushed so that the published drag holds it at this mean speed."""
    points, body, edges = variant.cell(rows, radius_of(rows, fraction))
    push = drag_of(fraction).value*eta*speed/rows**2
    return Stream(x=points.x, edges=edges, eos=IdealGas(), law=ConstEta(eta, eta), held=held(body, T=1.0),
                  push=(push, 0.0), chi=variant.filtered/eta)


def momentum(sums: Streaming, state: np.ndarray) -> float:
    """Of all points, along the stream."""
    return float(sums.method.edges.V@state[1])


def force(sums: Streaming, state: np.ndarray) -> float:
    """On the body, along the stream; of the last stage of the last step."""
    return float(sums.received[:, 0].sum())


def free(method: Stream) -> np.ndarray:
    """Which points are fluid (n,)."""
    fluid = np.ones(len(method.x), bool)
    fluid[method.held.which] = False
    return fluid


def drag(method: Stream, cell: float, momentum: np.ndarray, force: np.ndarray) -> np.ndarray:
    """F/(eta U) of a cell of this area: force over edges, and the push on the volume left out."""
    inside = cell - method.edges.V[free(method)].sum()
    return (force + method.push[0]*inside)/(method.law.eta*momentum/cell)
