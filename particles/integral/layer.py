"""Fixed points of a layer, compiled: the terms of `dih` over stored edges, in 2D.

Between plates, which RR98 leaves open, convection and pressure see images without friction, so that the
divergence stays the adjoint of the gradient: fields of their parents, velocity across reversed, a pressure
that goes on hydrostatically. Friction and heat see -v and 2 T_w - T. Any other mixture lets sound grow.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas, check_state, conductivity, sound_speed, temperature, viscosity
from continuum.jit import jit
from particles.ghosts import Ghosts
from particles.integral.edges import Beyond, Edges, fastest
from particles.integral.exchange import At, Conduction
from particles.integral.fixed import FixedSums, OnPoints, OwnPressure, Point, opened, stored
from particles.integral.layer_ideal import IdealSums
from particles.integral.transposed_stress import MENDED
from particles.integrators import RK4
from particles.limits import limit_of
from particles.threads import Team


class LayerSums(FixedSums):
    """The compiled sums of a layer, with what the time loop asks for."""
    method: "Layer"

    def __init__(self, method: "Layer", team: Team):
        n, beyond, T_plates = len(method.x), method.beyond, np.array(method.T_plates)
        ghosts, ghost = np.unique(np.stack([beyond.parent, beyond.plate]), axis=1, return_inverse=True)
        # of images; the image of each edge to one
        (self.parent, self.plate), self.image = ghosts, ghost.ravel()
        self.rise = np.zeros(len(self.parent))      # how much higher a parent lies than its image
        self.rise[self.image] = method.x[beyond.parent, 1] - (method.x[beyond.i, 1] + beyond.apart[:, 1])
        edges = stored(method.edges, beyond, n + self.image)
        images = Ghosts(self.parent, -np.ones(len(self.parent)), T_plates[self.plate])
        self.open = opened(edges)
        at = At(np.zeros(n + len(self.parent), Point), edges, images, method.edges.V)
        super().__init__(method, team, at, (0.0, -method.g), OwnPressure(method.eos, self.open, n, team))

    def surround(self, state: np.ndarray) -> None:
        """Images between plates."""
        _images(self.parent, self.at.images.plate_T, self.rise, self.method.g, self.points, self.n)

    def heat_through(self, plate: int) -> float:
        """Heat per time that enters through plate 0 (lower) or 1; needs fields looked at."""
        beyond, here = self.method.beyond, self.method.beyond.plate == plate
        i, image = beyond.i[here], self.n + self.image[here]
        a, b = self.points[i], self.points[image]
        along = float(np.sum(beyond.k[here]*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))
        share = sum(term.share for term in self.method.transport if type(term) is Conduction)
        return share*along + sum(stage.heat(i, image, beyond.S[here]) for stage in self.exchange.stages)


class LinearSums(LayerSums):
    """The same where brackets are products of a point's fields and sums over its neighbours."""

    def __init__(self, method: "Layer", team: Team):
        super().__init__(method, team)
        self.linear = IdealSums(self)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (4, n), written to `out`."""
        self.linear.rates(state, out)


@jit
def _images(parent, plate_T, rise, g, points, n):
    for m in range(len(parent)):
        a, b = points[parent[m]], points[n + m]
        b.rho, b.vx, b.vy, b.T, b.eps = a.rho, a.vx, -a.vy, a.T, a.eps
        b.ux, b.uy, b.Td, b.eta, b.k = -a.ux, -a.uy, 2*plate_T[m] - a.Td, a.eta, a.k
        b.hydro = a.rho*g*rise[m]


#: sums in another form, for fluids that allow it: equation of state, law, and transport
FORMS = {(IdealGas, ConstEta, MENDED): LinearSums}


def quickest(method: "Layer") -> type[LayerSums]:
    """Sums in the form that suits a fluid best."""
    return FORMS.get((type(method.eos), type(method.law), method.transport), LayerSums)


def edge_by_edge(method: "Layer") -> type[LayerSums]:
    """Sums as all fluids have them."""
    return LayerSums


@dataclass(frozen=True, kw_only=True)
class Layer(OnPoints):
    """A fluid on fixed points x (n, 2), periodic in x, between plates at T_plates (lower, upper).

    edges, beyond : of `edges.between_plates`. transport : listed terms of friction and heat: `MENDED`,
    `PRINTED` as Eq. 51 has it, which heats even a rigid rotation, or of `nested.mixed`. form : which sums,
    `quickest` or `edge_by_edge`.
    """
    x: np.ndarray
    edges: Edges
    beyond: Beyond
    eos: Any
    law: Any
    T_plates: tuple[float, float]
    g: float
    transport: tuple = MENDED
    form: Callable[[Any], type[LayerSums]] = quickest
    integrator: type = RK4

    def __repr__(self) -> str:
        """What tells a checkpoint's method from another: edges by their sums."""
        sums = ", ".join(f"{float(np.abs(q).sum())!r}"
                         for q in (self.x, self.edges.S, self.edges.k, self.beyond.S))
        return (f"Layer({len(self.x)}, {sums}, {self.eos}, {self.law}, {self.T_plates}, {self.g}, "
                f"{self.transport}, {self.form(self).__name__}, {self.integrator.__name__})")

    @cached_property
    def fastest(self) -> tuple[float, float]:
        """Largest frequency of sound over its speed, and largest rate of diffusion over the diffusivity."""
        return fastest(self.edges, self.beyond)

    def sums(self, team: Team) -> "LayerSums":
        """In the form that is asked for."""
        return self.form(self)(self, team)


@limit_of.register
def _(method: Layer, start: np.ndarray) -> float:
    """RK4: the fastest sound and diffusion of edges and images together, at the hottest point."""
    rho = start[0]
    e = start[3]/rho - (start[1]**2 + start[2]**2)/(2*rho**2)
    check_state(method.eos, rho, e)
    T, (sound, spread) = temperature(method.eos, rho, e), method.fastest
    slope = (temperature(method.eos, rho, e + 1e-6) - T)/1e-6
    chi = np.maximum(viscosity(method.law, rho, T), conductivity(method.law, rho, T)*slope)/rho
    fast = sound_speed(method.eos, rho, e) + np.sqrt(start[1]**2 + start[2]**2)/rho
    return float(1/(np.max(fast)*sound/2.82 + np.max(chi)*spread/2.78))
