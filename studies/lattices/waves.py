"""Small motions of inviscid smooth particles on a lattice, by lattice sums    [KHP95, Sec. II]

About rest at summed density rho, without conduction, displacements u exp(ik.r) obey d2u/dt2 = -M u,

    M(k) = (m/rho)^2 (c^2 - 2 P/rho) S S^T + (2 m P/rho^2) D
    S = sum_r grad w sin k.r
    D = sum_r (grad grad w)(1 - cos k.r)

The sums are over the neighbours r of a particle; c is the isentropic speed of sound. For P ~ rho^2 only D is
left, the dynamical matrix of molecules with the potential 2 P w/rho^2. A negative eigenvalue of M is a motion
that grows.
"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import pressure, pressure_slopes
from particles.weights import value_and_slope

CENTRED = np.array([[0.25, 0.25], [0.75, 0.75]])
#: rectangular cell and the particles in it, density 1; "diagonal" is the square lattice turned by 45 degrees
CELLS = {
    "square": (np.array([1.0, 1.0]), CENTRED[:1]),
    "diagonal": (np.array([1.0, 1.0])*np.sqrt(2), CENTRED),
    "hexagonal": (np.array([1.0, np.sqrt(3)])*np.sqrt(2/np.sqrt(3)), CENTRED),
}


class Lattice(NamedTuple):
    """Points x (n, 2) of density 1 in a periodic box centred on the origin."""
    x: np.ndarray
    box: tuple[float, float]


def lattice(kind: str, cells: tuple[int, int], strain: float = 0.0) -> Lattice:
    """So many cells along x and y, the box stretched by exp(strain) along x and by exp(-strain) along y."""
    cell, inside = CELLS[kind]
    cell = cell*np.exp([strain, -strain])
    box = cell*cells
    corners = whole_numbers(cells).reshape(-1, 1, 2)
    x = ((corners + inside)*cell).reshape(-1, 2)
    return Lattice(x - box/2, (float(box[0]), float(box[1])))


def whole_numbers(counts: Any) -> np.ndarray:
    """(n, 2): all pairs of whole numbers below two counts."""
    grids = np.meshgrid(*map(np.arange, counts), indexing="ij")
    return np.stack(grids, axis=-1).reshape(-1, 2)


def neighbours(kind: str, reach: float) -> np.ndarray:
    """(n, 2): vectors to the neighbours nearer than `reach`, the same for all particles of these lattices."""
    cell, _ = CELLS[kind]
    columns, rows = (int(2*reach/side) + 4 for side in cell)
    x = lattice(kind, (columns, rows)).x
    r = x - x[np.argmin(np.hypot(*x.T))]
    distance = np.hypot(*r.T)
    return r[(distance < reach) & (distance > 0)]


def vectors(kind: str, cells: tuple[int, int]) -> np.ndarray:
    """(n, 2): wave vectors that fit into the box, without those that move all particles alike."""
    cell, inside = CELLS[kind]
    turns = whole_numbers(len(inside)*np.array(cells))
    k = 2*np.pi*turns/(cell*cells)
    phase = k@neighbours(kind, 2.0).T
    return k[np.abs(np.sin(phase/2)).max(axis=1) > 1e-9]


class Sums(NamedTuple):
    """density : sum of w, the particle itself included. S (k, 2), D (k, 2, 2) : see the head of this file."""
    density: float
    S: np.ndarray
    D: np.ndarray


def sums(weight: Any, kind: str, k: np.ndarray) -> Sums:
    """Of wave vectors k (n, 2)."""
    x = neighbours(kind, weight.h)
    r = np.hypot(*x.T)
    w, slope, curvature = np.array([derivatives(weight, one) for one in r]).T
    n = x/r[:, None]
    along = n[:, :, None]*n[:, None, :]
    hessian = slope[:, None, None]*(np.eye(2) - along) + curvature[:, None, None]*along
    phase = k@x.T
    S = np.sin(phase)@(slope[:, None]*x)
    D = np.einsum("kr,rab->kab", 1 - np.cos(phase), hessian)
    return Sums(float(w.sum()) + at_centre(weight), S, D)


def at_centre(weight: Any) -> float:
    """w(0)."""
    return float(value_and_slope(weight, 0.0)[0])


def derivatives(weight: Any, r: float, step: float = 1e-5) -> tuple[float, float, float]:
    """w, w'/r and w'' at r; w'' by a central difference, good to 1e-9."""
    w, slope = value_and_slope(weight, r)
    before, after = (value_and_slope(weight, s)[1]*s for s in (r - step, r + step))
    return w, slope, (after - before)/(2*step)


class Motion(NamedTuple):
    """Displacements a cos k.r, a of unit length, and their omega^2."""
    k: np.ndarray
    a: np.ndarray
    square: float

    @property
    def rate(self) -> float:
        """At which it grows; minus its frequency if it does not."""
        return float(-np.sign(self.square)*np.sqrt(abs(self.square)))


def least_stable(weight: Any, eos: Any, e: float, kind: str, cells: tuple[int, int], m: float = 1.0) -> Motion:
    """The motion with the least omega^2 of those that fit into the box."""
    k = vectors(kind, cells)
    squares, a = np.linalg.eigh(matrices(weight, eos, e, kind, k, m))
    least = int(np.argmin(squares[:, 0]))
    return Motion(k[least], a[least, :, 0], float(squares[least, 0]))


def matrices(weight: Any, eos: Any, e: float, kind: str, k: np.ndarray, m: float = 1.0) -> np.ndarray:
    """M (n, 2, 2) of wave vectors k (n, 2)."""
    density, S, D = sums(weight, kind, k)
    rho = m*density
    P = pressure(eos, rho, e)
    c2 = sound_speed_squared(eos, rho, e)
    return (m/rho)**2*(c2 - 2*P/rho)*S[:, :, None]*S[:, None, :] + 2*m*P/rho**2*D


def sound_speed_squared(eos: Any, rho: float, e: float) -> float:
    """c^2, negative where the fluid itself is unstable."""
    by_rho, by_e = pressure_slopes(eos, rho, e)
    return float(by_rho + pressure(eos, rho, e)/rho**2*by_e)


def sites_of_least_energy(weight: Any, most: int = 4) -> int:
    """Particles a site of the hexagonal lattice in which the isentropic ideal gas has least energy."""
    densities = [hexagonal_density(weight, per_site) for per_site in range(1, most + 1)]
    return 1 + int(np.argmin(densities))


def hexagonal_density(weight: Any, per_site: int) -> float:
    """The summed density at a particle, so many on each site."""
    apart = np.sqrt(per_site)
    r = apart*np.hypot(*neighbours("hexagonal", weight.h/apart).T)
    return per_site*(at_centre(weight) + total(weight, r))


def total(weight: Any, r: np.ndarray) -> float:
    """Sum of w over distances r (n,)."""
    return sum(value_and_slope(weight, one)[0] for one in r)
