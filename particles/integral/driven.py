"""A layer whose plates slide along themselves, and whose fluid is pushed along them, in 2D.

A sliding plate adds to the friction along an edge to an image: f (2 U - 2 v) in place of f (-2 v), f = eta k.
"""
from dataclasses import dataclass

import numpy as np

from continuum.fluid import constant_viscosity
from particles.integral.exchange import PRINTED
from particles.integral.layer import Layer, LayerSums
from particles.integral.transposed_stress import MENDED
from particles.threads import Team


@dataclass(frozen=True, kw_only=True, repr=False)
class Driven(Layer):
    """A layer whose plates slide at velocities `slide` (lower, upper), under a force per mass along x.

    For constant viscosity and all transport along edges; the mended heating takes plates to be at rest, of no
    moment where the velocity across the plates is zero.
    """
    slide: tuple[float, float] = (0.0, 0.0)
    force: float = 0.0

    def __post_init__(self):
        if not constant_viscosity(self.law) or self.transport not in (MENDED, PRINTED):
            raise ValueError("sliding plates pull with a constant viscosity along edges only, got "
                             f"{self.law} and {self.transport}: take ConstEta and MENDED or PRINTED")

    def __repr__(self) -> str:
        return f"{super().__repr__()} driven by {self.slide}, {self.force}"

    def sums(self, team: Team) -> "Driving":
        """Of a layer, and what drives it."""
        return Driving(self, team)


class Driving(LayerSums):
    """The compiled sums of a layer, and what drives it."""

    def __init__(self, method: Driven, team: Team):
        super().__init__(method, team)
        beyond, V = method.beyond, method.edges.V
        U = np.array(method.slide)[beyond.plate]
        self.force = method.force
        self.pull, self.work = (np.bincount(beyond.i, 2*method.law.eta*beyond.k*q, self.n)/V
                                for q in (U, U**2))

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(state)/dt of a state (4, n), written to `out`; what drives it adds f 2 U to momentum, f (2 U - 2
        v).U to energy."""
        super().rates(state, out)
        out[1] += self.pull + self.force*state[0]
        out[3] += self.work - self.pull*state[1]/state[0] + self.force*state[1]
