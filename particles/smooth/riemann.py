"""Classic SPH whose pressures are those of a low-dissipation Riemann problem    [Zhang, Hu & Adams 2017]

    P_i + P_j + beta rho c u,    beta = min(3 u/c, 1)

replaces P_i + P_j in a pair that approaches at speed u > 0; rho and c are means of both. The star velocity is
left out: it serves densities by continuity, which here are summed. The paper has no heat; here each particle
gets half of a pair's work, as in `Direct`, whose friction and heat are used, for constant viscosity.
"""
from typing import Any

import numpy as np

from particles.pairs import pair_term
from particles.smooth.sums import Direct, sound


@pair_term(3)
def LowDissipation(term, a, b, ab):
    """As `DirectFluxes`, with P* = (P_i + P_j)/2 + beta rho c u/2."""
    x, y, u, v = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy
    r2, f, c = max(x*x + y*y, 1e-300), a.irho*b.irho, 0.5*(a.c + b.c)
    near = max(-(x*u + y*v)/np.sqrt(r2), 0.0)
    p = a.P_rho2/a.irho**2 + b.P_rho2/b.irho**2 + min(3*near, c)*near*0.5*(1/a.irho + 1/b.irho)
    F = f*(x*ab.wx + y*ab.wy)/r2
    drag = (a.eta + b.eta)*F
    fx, fy = p*f*ab.wx - drag*u, p*f*ab.wy - drag*v
    return -fx, -fy, 0.5*(u*fx + v*fy) + (a.k + b.k)*F*(a.T - b.T)


class LowDissipationSums(Direct):
    """Sums of classic SPH with the term `LowDissipation`."""
    numbers = f"{Direct.numbers} c"

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around, (_, records) = self.around, super().exchange(less)
        self.threads(sound, len(around.x), self.method.eos, around.rho, around.T, records)
        return LowDissipation(), records
