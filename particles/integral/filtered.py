"""A filter of the density as a kind of transport, for fixed and moving points."""
from dataclasses import dataclass
from typing import Any

from particles.integral.dih import Dih, Flow, Fluxes, Pairwise


@dataclass(frozen=True, kw_only=True)
class Filtered:
    """Transport and a filter of the density: mass chi k_ij (rho_i - rho_j) leaves i for j, with the mean v and e of both.

    Conserves as all exchange over edges does. The density obeys rho' = chi lap rho besides, also at wave lengths of two spacings,
    which no gradient sees. corrected : only what differs from a linear density is exchanged: fourth order in the wave number.
    """
    chi: float
    transport: Any = Pairwise()  # noqa: RUF009  (immutable)
    corrected: bool = False

    def __post_init__(self):
        if not self.chi >= 0:
            raise ValueError(f"the filter's diffusivity chi must not be negative, got {self.chi}: a tenth of spacing times sound "
                             "speed is enough")

    def fluxes(self, dih: Dih, flow: Flow) -> Fluxes:
        """Through all edges."""
        edges, found = dih.edges, self.transport.fluxes(dih, flow)
        i, j = edges.i, edges.j
        step = flow.rho[j] - flow.rho[i]
        if self.corrected:
            slope = edges.grad(flow.rho)
            step -= ((slope[i] + slope[j])*edges.apart).sum(axis=1)/2
        mass, internal = -self.chi*edges.k*step, flow.eps/flow.rho - (flow.v**2).sum(axis=1)/2
        # v_i.v_j/2, not the mean of v^2/2: then the internal energy that leaves is what comes in
        whole = (internal[i] + internal[j] + (flow.v[i]*flow.v[j]).sum(axis=1))/2
        return Fluxes(found.mass + mass, found.momentum + mass[:, None]*(flow.v[i] + flow.v[j])/2, found.energy + mass*whole)
