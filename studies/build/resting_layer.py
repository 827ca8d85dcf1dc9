"""A layer whose viscosity and conductivity are given, zero too, between plates that are all but equally warm."""
from dataclasses import dataclass

from continuum.scene import RayleighBenard

TINY = 1e-12     # in place of zero: the grid divides by coefficients


@dataclass(frozen=True, kw_only=True)
class Slab(RayleighBenard):
    """A layer of L rows at rest: any solver that takes a layer takes it. `ra` and `pr` say nothing here."""
    viscosity: float
    heat: float
    ra: float = 1.0
    T_hot: float = 1 + 1e-9
    T_cold: float = 1 - 1e-9

    @property
    def nu(self) -> float:
        """Of density 1, as given."""
        return max(self.viscosity, TINY)

    @property
    def kappa(self) -> float:
        """k/(rho C_V), as given."""
        return max(self.heat/float(self.eos.cv), TINY)
