"""Compiled scheme on fixed points of a layer: the terms of `dih` over stored edges, in 2D.

RR98 does not specify plates. Convection and pressure see images that slip: fields of their parents, normal
velocity reversed, pressure continued hydrostatically; so the divergence stays the adjoint of the gradient.
Friction and heat see images with -v and 2 T_w - T. Any other combination lets sound grow.
"""
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas, conductivity, constant_viscosity, viscosity
from continuum.jit import jit
from particles.integral import layer_ideal
from particles.integral.edges import Beyond, Edges, fastest
from particles.integral.exchange import PRINTED, Conduction
from particles.integral.fixed import FixedSums, OnPoints, OwnPressure, opened, stored
from particles.integral.transposed_stress import MENDED
from particles.lists import Ghosts
from particles.threads import Threads


class LayerSums(FixedSums):
    """The compiled sums of a layer, with the interface of the time loop."""
    method: "Layer"

    def __init__(self, method: "Layer", threads: Threads):
        n, beyond, T_plates = len(method.x), method.beyond, np.array(method.T_plates)
        ghosts, ghost = np.unique(np.stack([beyond.parent, beyond.plate]), axis=1, return_inverse=True)
        # parent and plate of each image; image of each edge that leads to one
        (self.parent, plate), self.image = ghosts, ghost.ravel()
        self.rise = np.zeros(len(self.parent))      # height of a parent above its image
        self.rise[self.image] = method.x[beyond.parent, 1] - (method.x[beyond.i, 1] + beyond.apart[:, 1])
        edges = stored(method.edges, beyond, n + self.image)
        images = Ghosts(self.parent, -np.ones(len(self.parent)), T_plates[plate])
        self.open = opened(edges)
        super().__init__(method, threads, edges, images, (0.0, -method.g),
                         OwnPressure(method.eos, self.open, n, threads))

    def surround(self, state: np.ndarray) -> None:
        _images(self.parent, self.at.images.plate_T, self.rise, self.method.g, self.points, self.n)

    def heat_through(self, plate: int) -> float:
        """Heat per time that enters through plate 0 (lower) or 1; for the state of the last `look_at`."""
        beyond, here = self.method.beyond, self.method.beyond.plate == plate
        i, image = beyond.i[here], self.n + self.image[here]
        a, b = self.points[i], self.points[image]
        along = float(np.sum(beyond.k[here]*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))
        share = sum(term.share for term in self.method.transport if type(term) is Conduction)
        return share*along + sum(stage.heat(i, image, beyond.S[here]) for stage in self.exchange.stages)


class LinearSums(LayerSums):
    """`LayerSums` of an ideal gas with constant coefficients, see `layer_ideal`."""

    def __init__(self, method: "Layer", threads: Threads):
        super().__init__(method, threads)
        beyond, law, image, size = method.beyond, method.law, self.image, len(self.points)
        self.given, self.lack = np.zeros(size, layer_ideal.Given), np.zeros(size, layer_ideal.Lack)
        self.edges, self.per_V, self.twice_T = tuple(self.at.edges), 1/self.at.V, 2*self.at.images.plate_T
        self.gas = (float(method.eos.cv), viscosity(law, 1.0, 1.0), conductivity(law, 1.0, 1.0))
        self.beyond = (beyond.i, self.n + image, *(beyond.S.T/2).copy(), method.g*self.rise[image])

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        n, given, lack, edges, per_V, gas = self.n, self.given, self.lack, self.edges, self.per_V, self.gas
        self.threads(layer_ideal.give, len(given), state, self.parent, self.twice_T, gas, given)
        self.threads(layer_ideal.exchange, n, given, edges, self.open, per_V, gas, self.method.g, lack, out)
        layer_ideal.plates(self.beyond, self.parent, given, per_V, lack, out)
        self.threads(layer_ideal.heat, n, lack, edges, self.open, per_V, out)


@jit
def _images(parent, plate_T, rise, g, points, n):
    for m in range(len(parent)):
        a, b = points[parent[m]], points[n + m]
        b.rho, b.vx, b.vy, b.T, b.eps = a.rho, a.vx, -a.vy, a.T, a.eps
        b.ux, b.uy, b.Td, b.eta, b.k = -a.ux, -a.uy, 2*plate_T[m] - a.Td, a.eta, a.k
        b.hydro = a.rho*g*rise[m]


@dataclass(frozen=True, kw_only=True)
class Layer(OnPoints):
    """A fluid on fixed points x (n, 2), periodic in x, between plates at T_plates (lower, upper).

    edges, beyond : of `edges.between_plates`. transport : listed terms of friction and heat, `MENDED`,
    `PRINTED` (Eq. 51 as printed), or those of `nested.mixed`. form : class of the sums, None for the fastest
    that the fluid allows, `LayerSums` for the general ones, edge by edge.
    """
    x: np.ndarray
    edges: Edges
    beyond: Beyond
    eos: Any
    law: Any
    T_plates: tuple[float, float]
    g: float
    transport: tuple = MENDED
    form: type[LayerSums] | None = None

    @cached_property
    def fastest(self) -> tuple[float, float]:
        return fastest(self.edges, self.beyond)

    @property
    def sums(self) -> type[LayerSums]:
        linear = (type(self.eos), type(self.law), self.transport) == (IdealGas, ConstEta, MENDED)
        return self.form or (LinearSums if linear else LayerSums)


class Driving(LayerSums):
    """The compiled sums of a driven layer. A plate that slides at U changes the friction along an edge to an
    image, with f = eta k, from f (-2 v) to f (2 U - 2 v)."""
    method: "Driven"

    def __init__(self, method: "Driven", threads: Threads):
        super().__init__(method, threads)
        beyond, V = method.beyond, method.edges.V
        U = np.array(method.slide)[beyond.plate]
        self.pull, self.work = (np.bincount(beyond.i, 2*method.law.eta*beyond.k*q, self.n)/V
                                for q in (U, U**2))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """As for a layer, with f 2 U added to momentum, f (2 U - 2 v).U to energy, and the force per mass."""
        super().rates(state, out)
        force = self.method.force
        out[1] += self.pull + force*state[0]
        out[3] += self.work - self.pull*state[1]/state[0] + force*state[1]


@dataclass(frozen=True, kw_only=True)
class Driven(Layer):
    """A layer whose plates slide at velocities `slide` (lower, upper), under a force per mass along x. For
    constant viscosity, transport along edges, flow along the plates: `MENDED` heats as if plates rested."""
    slide: tuple[float, float] = (0.0, 0.0)
    force: float = 0.0

    sums = Driving

    def __post_init__(self):
        if not constant_viscosity(self.law) or self.transport not in (MENDED, PRINTED):
            raise ValueError("sliding plates pull with a constant viscosity along edges only, got "
                             f"{self.law} and {self.transport}: take ConstEta and MENDED or PRINTED")
