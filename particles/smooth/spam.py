"""Smooth-particle applied mechanics as printed [KHP95, Sec. II], and its named variants.

Three sums: density; gradients of v and T; divergence of P/rho^2 and Q/rho^2. A variant puts another object in
place of the printed choice: `ArithmeticGradients()` for the mean density, `Direct` for `Nested` transport,
`LessStatic(...)` for the whole pressure, another weight.
"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import constant_viscosity, energy, pressure, viscosity
from continuum.jit import check_formulas
from particles.fields import Fields, check_numbers
from particles.integrators import RK4
from particles.lists import check_room
from particles.smooth.sums import Direct, Nested
from particles.terms import Gradients
from particles.threads import Threads
from particles.weights import check_unit


class LessStatic(NamedTuple):
    """Subtract `fraction` of the static pressure P0 - rho0 g y from P, and its force from gravity.

    This lowers the background pressure, which holds particles on a lattice [KHP95, Sec. IV]; fraction = 0 is
    the printed scheme. The subtracted part works by div v of the second sum (`TransportVelocity`: of
    v + d), so that energy is not exactly conserved.
    """
    fraction: float
    P0: float
    rho0: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Spam:
    """A smooth-particle fluid.

    weight : of `particles.weights`, as ``Lucy.of(h=3)``. eos, law : of `continuum.fluid`. walls : tuple of
    walls. box : (width, height), centred on the origin. g : gravity, downwards. m : mass of every particle.
    gradients, transport, static : by default as printed. skin : of the neighbour lists, in sigma.
    """
    weight: Any
    eos: Any
    law: Any
    walls: tuple
    box: tuple[float, float]
    g: float = 0.0
    m: float = 1.0
    gradients: Any = Gradients()  # noqa: RUF009 (immutable)
    transport: type[Nested] | type[Direct] = Nested
    static: LessStatic = LessStatic(0.0, 0.0)  # noqa: RUF009
    skin: float = 0.7
    integrator: type = RK4

    @property
    def names(self) -> tuple[str, ...]:
        return self.transport.of_state

    def __post_init__(self):
        check_numbers(m=self.m, g=self.g, skin=self.skin)
        if not self.m > 0:
            raise ValueError(f"the mass of a particle must be positive, got {self.m}")
        check_formulas(self.eos, pressure, energy)
        check_formulas(self.law, viscosity)
        check_unit(self.weight)
        check_room(self.weight, self.walls, self.box)
        if not hasattr(self.transport, "symbol"):
            raise TypeError(f"{self.transport} does not say which waves it damps: inherit Nested or Direct, "
                            "or set symbol")
        if self.transport.along_pairs and not constant_viscosity(self.law):
            raise ValueError("friction along pairs lacks a part of the stress where viscosity varies, as by "
                             f"{self.law}: take ConstEta, or Nested or corrected gradients")

    def state(self, x: np.ndarray, rho: Any, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """State (rows, n) from places (n, 2), velocities (n, 2), temperatures (n,), densities rho."""
        state = np.stack([*x.T, *v.T, energy(self.eos, rho, T)*np.ones(len(x))])
        return self.transport.complete(state, rho, self.m)

    def fields(self, state: np.ndarray) -> Fields:
        """Fields of the particles, (n,) each, in the order of the state; density by the method's own sum."""
        sums, _, ids = self.look(state)
        rho, T = (q[:sums.n][np.argsort(ids)] for q in (sums.around.rho, sums.around.T))
        return Fields(state[:2].T.copy(), state[2:4].T.copy(), rho, T, self.m*sums.shares(state)/rho)

    def look(self, state: np.ndarray) -> tuple[Nested | Direct, np.ndarray, np.ndarray]:
        """(sums, state, ids) in the order of new lists; densities, velocities and images are up to date."""
        n = state.shape[1]
        sums, ordered, ids = self.start(n, Threads(1)), state.copy(), np.arange(n)
        sums.around.relist(ordered, ids, 0.0)
        sums.densities(ordered)
        return sums, ordered, ids

    def start(self, n: int, threads: Threads) -> Nested | Direct:
        """The sums of n particles. Raises ValueError: n < 1, or the weight is too wide for the box."""
        if n < 1:
            raise ValueError(f"there are no particles (n = {n}): a run needs at least one")
        return self.transport(self, n, threads)
