"""Galilean invariance of rates, and linear sound without friction, as cases    [RR98 Eqs 34-38]"""
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import expm

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih
from particles.integral.edges import Edges
from particles.integral.points import Points
from studies.conservation.dih import ETA, FORMS, SIZE
from studies.conservation.edges import OnEdges
from studies.conservation.sums import random_fields

WIND = np.array([0.3, -0.2])
SIDE = 8                # spacings: the length of the wave whose periods are counted


@dataclass(frozen=True, kw_only=True)
class Frame(OnEdges):
    """Rates of the same random state at rest and in a wind.

    On fixed points a wind carries the state along with the discrete divergence D: rates may differ by -U.D of the state and by
    what the transformation of momentum and energy asks for, and by nothing else.
    """
    mode: str
    table = "frames"

    def found(self, points: Points, edges: Edges) -> dict[str, Any]:
        fluid = FORMS[self.mode].kind(edges=edges, eos=IdealGas(), law=ConstEta(ETA, ETA), transport=FORMS[self.mode].transport)
        mass, momentum, energy = defects(fluid, fluid.state(*random_fields(points, SIZE, self.seed)))
        return {"mode": self.mode, "mass": mass, "momentum": momentum, "energy": energy}


def defects(fluid: Dih, state: np.ndarray) -> tuple[float, float, float]:
    """Largest differences of the rates of mass, momentum and energy, over the largest rates."""
    off, there = differences(fluid, state)
    mass, momentum, energy = (float(np.abs(off[r]).max()/np.abs(there[r]).max())
                              for r in (slice(0, 1), slice(1, 3), slice(3, 4)))
    return mass, momentum, energy


def differences(fluid: Dih, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rates in the wind less what they should be, and rates in the wind, each (4, n)."""
    moved = in_wind(state)
    still, there = rates(fluid, state), rates(fluid, moved)
    rest, p = still[0], still[1:3]
    expected = np.stack([rest, *(p + rest*WIND[:, None]), still[3] + WIND@p + rest*(WIND@WIND)/2])
    expected += np.stack([-sum(u*(D@q) for u, D in zip(WIND, fluid.edges.D, strict=True))/fluid.edges.V for q in moved])
    return there - expected, there


def in_wind(state: np.ndarray) -> np.ndarray:
    """The state in a frame that moves with -WIND."""
    rho, p, eps = state[0], state[1:3], state[3]
    return np.stack([rho, *(p + rho*WIND[:, None]), eps + WIND@p + rho*(WIND@WIND)/2])


def rates(fluid: Dih, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    fluid.rates(state, out)
    return out


# --- sound ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Sound(OnEdges):
    """Linear sound at rest without friction: rho' = -div v, v' = -grad rho in units of the speed of sound.

    bracket : "plus", the gradient with (f_i + f_j) as in Eqs 34 and 35, or "adjoint", with (f_j - f_i).
    """
    bracket: str
    periods: int = 10_000
    table = "sound"
    counts = (SIDE, SIDE)

    @property
    def cost(self) -> float:
        return 0.3

    def found(self, points: Points, edges: Edges) -> dict[str, Any]:
        L = SIDE*sound(edges, self.bracket)
        growth = float(np.linalg.eigvals(L).real.max())
        # eigenvalues of a matrix that is not normal may be off by the root of round-off where they are defective
        err = np.finfo(float).eps*np.linalg.norm(L, 2)*len(L)
        return {"bracket": self.bracket, "periods": self.periods, "growth": growth, "growth_err": float(err),
                "ln_energy": after(expm(L), self.periods, self.seed)}


def sound(edges: Edges, bracket: str) -> np.ndarray:
    """d/dt of (rho, v) as a matrix, each times the root of the volume: the energy is half of the square."""
    root = sparse.diags_array(1/np.sqrt(edges.V))
    gradient = edges.D if bracket == "plus" else edges.G
    blocks: list[list[Any]] = [[None, *(-root@D@root for D in edges.D)]]
    blocks += [[-root@slope@root, *[None]*edges.d] for slope in gradient]
    return sparse.block_array(blocks).toarray()


def after(step: np.ndarray, times: int, seed: int) -> float:
    """ln of the energy after so many applications to a random state, over that before."""
    state = np.random.default_rng(seed).normal(size=len(step))
    state /= np.linalg.norm(state)
    total = 0.0
    for _ in range(times):
        state = step@state
        size = float(np.linalg.norm(state))
        total += 2*np.log(size)
        state /= size
    return total
