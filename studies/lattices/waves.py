"""Small motions of inviscid smooth particles on a lattice that fits into a periodic box: what to expect    [KHP95, Sec. II]

About rest at summed density rho, without conduction, displacements u exp(ik.r) obey d2u/dt2 = -M u,

    M(k) = (m/rho)^2 (c^2 - 2 P/rho) S S^T + (2 m P/rho^2) D,    S = sum_r grad w sin k.r,    D = sum_r (grad grad w)(1 - cos k.r)

sums over the neighbours r of a particle; c the isentropic speed of sound. For P ~ rho^2 only D is left, the dynamical matrix of
molecules with the potential 2 P w/rho^2. A negative eigenvalue of M is a motion that grows.
"""
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import pressure, pressure_slopes
from particles.weights import value_and_slope

CENTRED = np.array([[0.25, 0.25], [0.75, 0.75]])
#: rectangular cell and the particles in it, density 1; "diagonal" is the square lattice turned by 45 degrees
CELLS = {"square": (np.array([1.0, 1.0]), CENTRED[:1]), "diagonal": (np.array([1.0, 1.0])*np.sqrt(2), CENTRED),
         "hexagonal": (np.array([1.0, np.sqrt(3)])*np.sqrt(2/np.sqrt(3)), CENTRED)}


class Lattice(NamedTuple):
    """A lattice of density 1 in a periodic box centred on the origin: points (n, 2), box."""
    x: np.ndarray
    box: tuple[float, float]


def lattice(kind: str, cells: tuple[int, int], strain: float = 0.0) -> Lattice:
    """So many cells along x and y, the box stretched by exp(strain) along x and by exp(-strain) along y."""
    cell, inside = CELLS[kind]
    cell = cell*np.exp([strain, -strain])
    corner = np.stack(np.meshgrid(*(np.arange(n) for n in cells), indexing="ij"), axis=-1).reshape(-1, 1, 2)
    box = cell*cells
    return Lattice(((corner + inside)*cell).reshape(-1, 2) - box/2, (float(box[0]), float(box[1])))


def neighbours(kind: str, reach: float) -> np.ndarray:
    """(n, 2): from a particle to those that are nearer than `reach`; all particles of these lattices are alike."""
    cell, _ = CELLS[kind]
    cells = (int(2*reach/cell[0]) + 4, int(2*reach/cell[1]) + 4)
    x = lattice(kind, cells).x
    r = x - x[np.argmin(np.hypot(*x.T))]
    return r[(np.hypot(*r.T) < reach) & (np.hypot(*r.T) > 0)]


def vectors(kind: str, cells: tuple[int, int]) -> np.ndarray:
    """(n, 2): wave vectors that fit into the box, those that the lattice does not tell from rest left out."""
    cell, inside = CELLS[kind]
    one = [np.arange(len(inside)*n) for n in cells]
    turns = np.stack(np.meshgrid(*one, indexing="ij"), axis=-1).reshape(-1, 2)
    k = 2*np.pi*turns/(cell*cells)
    step = neighbours(kind, 2.0)
    return k[np.abs(np.sin(k@step.T/2)).max(axis=1) > 1e-9]


def sums(weight: Any, kind: str, k: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """sum of w, the particle itself included, S (k, 2) and D (k, 2, 2)."""
    x = neighbours(kind, weight.h)
    r = np.hypot(*x.T)
    w, slope, curvature = (np.array(q) for q in zip(*(derivatives(weight, one) for one in r)))
    n, phase = x/r[:, None], k@x.T
    along = n[:, :, None]*n[:, None, :]
    hessian = slope[:, None, None]*(np.eye(2) - along) + curvature[:, None, None]*along
    return (float(w.sum()) + value_and_slope(weight, 0.0)[0], np.sin(phase)@(slope[:, None]*x),
            np.einsum("kr,rab->kab", 1 - np.cos(phase), hessian))


def derivatives(weight: Any, r: float, step: float = 1e-5) -> tuple[float, float, float]:
    """w, w'/r and w'' at r; w'' by a central difference, good to 1e-9."""
    after, before = ((r + d)*value_and_slope(weight, r + d)[1] for d in (step, -step))
    return *value_and_slope(weight, r), (after - before)/(2*step)


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
    """Of the motions that fit into the box, the one with the least omega^2."""
    k = vectors(kind, cells)
    squares, a = np.linalg.eigh(matrices(weight, eos, e, kind, k, m))
    least = int(np.argmin(squares[:, 0]))
    return Motion(k[least], a[least, :, 0], float(squares[least, 0]))


def matrices(weight: Any, eos: Any, e: float, kind: str, k: np.ndarray, m: float = 1.0) -> np.ndarray:
    """M (k, 2, 2) of wave vectors k (k, 2)."""
    total, S, D = sums(weight, kind, k)
    rho = m*total
    P, c2 = pressure(eos, rho, e), sound_speed_squared(eos, rho, e)
    return (m/rho)**2*(c2 - 2*P/rho)*S[:, :, None]*S[:, None, :] + 2*m*P/rho**2*D


def sound_speed_squared(eos: Any, rho: float, e: float) -> float:
    """c^2, negative where the fluid itself is unstable."""
    by_rho, by_e = pressure_slopes(eos, rho, e)
    return float(by_rho + pressure(eos, rho, e)/rho**2*by_e)


def sites_of_least_energy(weight: Any, most: int = 4) -> int:
    """Particles a site of the hexagonal lattice of density 1 in which the isentropic ideal gas, e ~ rho, has the least energy."""
    def density(per_site: int) -> float:
        r = np.sqrt(per_site)*np.hypot(*neighbours("hexagonal", weight.h/np.sqrt(per_site)).T)
        return per_site*(value_and_slope(weight, 0.0)[0] + sum(value_and_slope(weight, one)[0] for one in r))
    return 1 + int(np.argmin([density(per_site) for per_site in range(1, most + 1)]))
