"""Why friction along edges with the mended heating feels a wind off a lattice: slopes that do not commute    [RR98 Eq. 51]

The heating is mended by F_a = tau_ab v_b, tau_ab = B (d_b v_a - delta_ab div v). In the continuum d_a tau_ab = 0, so that forces
along edges need no tau. On points a wind U changes d(eps)/dt by U_b D_a tau_ab, the work of a force that momentum does not get:
B U_b (D_a G_b - D_b G_a) v_a, with the gradient G and the divergence D of the edges, which commute on a lattice alone.
"""
from dataclasses import dataclass
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points
from studies.build.read import Value, select
from studies.conservation.dih import ETA, SIZE
from studies.conservation.edges import OnEdges
from studies.conservation.frames import WIND, differences
from studies.conservation.sums import random_fields
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables


def foretold(edges: Edges, v: np.ndarray, eta: float) -> np.ndarray:
    """B U_b (D_a G_b - D_b G_a) v_a/V of velocities v (n, 2), B = eta in two dimensions without bulk viscosity."""
    G, D = ([M.multiply(1/edges.V[:, None]).tocsr() for M in found] for found in (edges.G, edges.D))
    return eta*sum(WIND[b]*(D[a]@(G[b]@v[:, a]) - D[b]@(G[a]@v[:, a])) for a in range(2) for b in range(2))


@dataclass(frozen=True, kw_only=True)
class Commutator(OnEdges):
    """Friction along edges, from random fields."""
    table = "commutators"

    def found(self, points: Points, edges: Edges) -> dict[str, Any]:
        fluid = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), transport=Pairwise())
        rho, v, T = random_fields(points, SIZE, self.seed)
        off, there = differences(fluid, fluid.state(rho, v, T))
        paper, size = foretold(edges, v, ETA), np.abs(there[3]).max()
        found, told, left = (float(np.abs(q).max()/size) for q in (off[3], paper, off[3] - paper))
        return {"found": found, "foretold": told, "left": left}


def worst(column: str, makers: tuple[str, ...], points: tuple[str, ...]) -> Value:
    """Largest of a column over some edges and points."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "commutators")
        rows = rows[rows["maker"].isin(makers) & rows["points"].isin(points)]
        if rows.empty:
            raise CannotTell("not run yet: no such edges in the table")
        return Measured(float(rows[column].max()), 0.0)
    return value


CLOSING, EVERYWHERE = ("closed", "exact", "delaunay"), ("lattice", "jittered-0.3", "random")
ROUNDED = "round-off of sums of 30 terms"
CLAIMS = (
    Claim(id="own-conservation-galilean-commutator", source="RR98 Eq. 51", at_most=1e-12, because=ROUNDED,
          value=worst("left", CLOSING, EVERYWHERE),
          statement="what a wind U adds to the energy of friction along edges with the mended heating is eta U_b (D_a G_b - D_b "
                    "G_a) v_a, slopes that do not commute, and nothing else: what that leaves, over the largest rate, edges that "
                    "close [derived here]"),
    Claim(id="own-conservation-galilean-commuting", source="RR98 Eq. 51", at_most=1e-12, because=ROUNDED,
          value=worst("found", ("closed", "exact"), ("lattice",)),
          statement="where slopes commute, on a lattice, a wind adds nothing to it"),
)
