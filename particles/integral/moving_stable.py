"""Points that move with their triangulation and a flux that survives: `entropy_fluxes`, `positive` steps.

What passes an edge that moves at {w} passes it at r = w - v, and so the terms keep the sum of V rho s as
they do on points that stay. `stable_rings` steps it.
"""
from dataclasses import dataclass

from continuum.jit import check_formulas
from particles.integral.entropy_fluxes import Dissipation, Logarithmic, MeanPressure, log_means
from particles.integral.fixed import check_number
from particles.integral.moving_delaunay import MovingDelaunay
from particles.integral.stable_rings import StableRings
from particles.threads import Threads


@dataclass(frozen=True, kw_only=True)
class StableDelaunay(MovingDelaunay):
    """A fluid with an entropy on such points. flow : listed terms in place of what crosses edges; the mean
    pressure, as it is nearest to `carried.Crossing`."""
    flow: tuple = ()

    def __post_init__(self):
        super().__post_init__()
        check_formulas(self.eos, log_means)
        usual = Logarithmic(self.eos), MeanPressure(self.eos), Dissipation(self.eos)
        object.__setattr__(self, "flow", self.flow or usual)

    def start(self, n: int, threads: Threads) -> StableRings:
        """The sums over the triangulation. Raises ValueError: a state of another number of points."""
        check_number(n, len(self.x))
        return StableRings(self, threads)
