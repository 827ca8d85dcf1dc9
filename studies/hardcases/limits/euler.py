"""Why forward Euler between plates takes shorter steps than its formula: linear theory of a strip of rows    [RR98 Eqs 37-40]

Nested gradients do not tell a wave across the plates from its partner that alternates from row to row: both have one frequency.
Friction and heat see images that are odd (-v, 2 T_w - T), sound even ones. For waves that alternate odd is what even is for the
others: plates that hold v and T let these waves slip and keep their heat. Waves mix with their partners such that gradients of T,
and of v along the plates, vanish in the rows next to the plates. Where damping is weak two rows of N at the crests of these
gradients are 4/N of all heat conduction. Sound is as fast as before, so that forward Euler's step, damping over c^2, shrinks.
"""
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.edge_makers import renormalised
from particles.integral.points import lattice
from particles.weights import Lucy
from studies.hardcases.limits.linear import seen
from studies.kit.case import Case, Outcome, Report

ROWS, WEAK = (10, 20, 40), "weak heat"
WIDTH = 20          # columns: waves along the plates of 20, 10, ... 2 spacings
FEW = 6             # columns that a point's edges do not go around


class Plates(NamedTuple):
    """What images are to heat and to friction along the plates: -1 where plates hold T and v, 1 where they insulate and slip."""
    heat: int = -1
    friction: int = -1


PLATES = {"holding": Plates(), "insulating": Plates(heat=1), "slipping": Plates(friction=1),
          "insulating, slipping": Plates(1, 1)}


def euler_step(law: ConstEta) -> float:
    """(eta + k/2)/(rho c^2): forward Euler makes sound grow beyond, however long the waves    [RR98 Eq. 40, 2D ideal gas]"""
    return (law.eta + law.k/2)/2


@cache
def star() -> tuple[np.ndarray, np.ndarray]:
    """(neighbours, 2) where the neighbours of a lattice's point are, and S/V of the edges to them."""
    edges = renormalised(lattice((FEW, FEW)), Lucy.of(h=2.0))
    out, back = edges.i == 0, edges.j == 0
    apart, S = (np.concatenate([q[out], -q[back]]) for q in (edges.apart, edges.S))
    return apart, S/edges.V[0]


def gradient(rows: int, k: float, sign: int) -> np.ndarray:
    """(2, rows, rows) d_x, d_y of waves exp(i k x) between plates half a spacing beyond the rows, images times `sign`."""
    G = np.zeros((2, rows, rows), complex)
    for (dx, dy), S in zip(*star(), strict=True):
        for row in range(rows):
            other = row + round(dy)
            inside = min(max(other, -1 - other), 2*rows - 1 - other)
            G[:, row, inside] += S/2*np.exp(1j*k*dx)*(1 if inside == other else sign)
    return G


def minus_square(*pairs: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """-sum A^+ B: a divergence that is the adjoint of a gradient, after another gradient."""
    return -sum(A.conj().T@B for A, B in pairs)


def rates(law: ConstEta, rows: int, k: float, plates: Plates) -> np.ndarray:
    """d/dt of (rho, v_x, v_y, T) at rows, small motions about rho = T = P = 1 of the 2D ideal gas, C_V = 1    [Eqs 34-38]"""
    (ex, ey), (ox, oy) = (gradient(rows, k, sign) for sign in (1, -1))
    hx, hy = gradient(rows, k, plates.heat)
    fx, fy = gradient(rows, k, plates.friction)
    none = np.zeros((rows, rows))
    # traceless stress: xx = -yy = d_x u - d_y v, xy = d_y u + d_x v
    uu, uv = minus_square((fx, fx), (fy, fy)), minus_square((fx, -oy), (fy, ox))
    vu, vv = minus_square((ox, fy), (-oy, fx)), minus_square((ox, ox), (oy, oy))
    heat = minus_square((hx, hx), (hy, hy))
    return np.block([[none, -ex, -oy, none], [-ex, law.eta*uu, law.eta*uv, -ex], [-ey, law.eta*vu, law.eta*vv, -ey],
                     [none, -ex, -oy, law.k*heat]])


def strip_step(law: ConstEta, rows: int, columns: int = WIDTH, plates: Plates = PLATES["holding"]) -> float:
    """The largest step at which no wave of a strip has |1 + lambda dt| > 1."""
    z = seen(np.concatenate([np.linalg.eigvals(rates(law, rows, 2*np.pi*m/columns, plates)) for m in range(columns//2 + 1)]))
    return float(np.min(-2*z.real/np.abs(z)**2))


@dataclass(frozen=True, kw_only=True)
class Strip(Case):
    """The theory's limits of one fluid, with each kind of plates."""
    scene: str
    eta: float
    k: float

    @property
    def cost(self) -> float:
        return 8.0

    @property
    def label(self) -> str:
        return f"limit Euler, theory of a strip, {self.scene}"

    def run(self, report: Report, folder: Path) -> Outcome:
        law = ConstEta(self.eta, self.k)
        return Outcome({"strips": [{"scene": self.scene, "eta": self.eta, "k": self.k, "rows": rows, "plates": name,
                                    "formula": euler_step(law), "step": strip_step(law, rows, plates=plates)}
                                   for rows in ROWS for name, plates in PLATES.items()]})
