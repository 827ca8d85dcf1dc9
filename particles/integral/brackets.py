"""How the pressures of two points make the one between them, where mass is constant    [RR98 Eqs 13, 50]"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy, pressure
from particles.integral.dih import Flow


class Crossed(NamedTuple):
    """P_ij = P(rho_i, T_j)    [RR98 Eq. 13]"""

    def both(self, eos: Any, a: Flow, b: Flow) -> tuple[np.ndarray, np.ndarray]:
        """(P_ab, P_ba); in the energy P_ab goes with v_a."""
        return pressure(eos, a.rho, energy(eos, a.rho, b.T)), pressure(eos, b.rho, energy(eos, b.rho, a.T))


CROSSED = Crossed()


class Powers(NamedTuple):
    """P_ij + P_ji = P_i/(m_i^a m_j^b) + P_j/(m_j^a m_i^b), m the density    [RR98 Eq. 50 and note 18]

    Consistent with Eq. 49 for a + b = 0 only: the force is -grad (P/rho^(a+b)). What the points' own pressure
    does is done with the velocity of the other, so that internal energy changes by -P_i times the growth of
    the volume.
    """
    a: float = 0.0
    b: float = 0.0

    def both(self, eos: Any, a: Flow, b: Flow) -> tuple[np.ndarray, np.ndarray]:
        """(P_ab, P_ba); in the energy P_ab goes with v_a."""
        return b.P/(b.rho**self.a*a.rho**self.b), a.P/(a.rho**self.a*b.rho**self.b)
