"""The two weights as KHP95 print them (Sec. II), and lattices of particles summed with them.

Lengths in sigma, mass 1 a particle, density 1. `particles.weights` normalises its weights by quadrature. Here
the printed factors stand, so that they can be judged.
"""
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

R = Polynomial([0, 1])
RANGE = 3.0
#: primitive vectors, as columns
AXES = {"square": np.eye(2), "hexagonal": np.array([[1.0, 0.5], [0.0, np.sqrt(3)/2]])}
SITES = (1, 2, 3, 4)        # particles on a site of a lattice


class Printed(NamedTuple):
    """A weight of range 3 in pieces (upper end, polynomial in r)."""
    pieces: tuple[tuple[float, Polynomial], ...]

    def __call__(self, r, h: float = RANGE):
        """w(r) of range h; the printed one stretched, its integral kept."""
        s = np.asarray(r)*RANGE/h
        inside = [s < end for end, _ in self.pieces]
        values = [piece(s) for _, piece in self.pieces]
        return (RANGE/h)**2*np.select(inside, values, 0.0)

    @property
    def integral(self) -> float:
        """Over the plane."""
        total, begin = 0.0, 0.0
        for end, piece in self.pieces:
            disc = (2*np.pi*R*piece).integ()
            total += disc(end) - disc(begin)
            begin = end
        return float(total)

    def jumps(self, order: int) -> list[float]:
        """Jumps of the derivative of that order at the ends of the pieces, over w(0); at r = 0 the slope."""
        slopes = [piece.deriv(order) if order else piece for _, piece in self.pieces]
        slopes.append(Polynomial([0.0]))
        ends = [end for end, _ in self.pieces]
        jumps = [slopes[i + 1](end) - slopes[i](end) for i, end in enumerate(ends)]
        at_zero = [slopes[0](0.0)] if order == 1 else []
        return [jump/float(self(0.0)) for jump in jumps + at_zero]


LUCY = Printed(((3.0, 5/(9*np.pi)*(1 + R)*(1 - R/3)**3),))
MONAGHAN = Printed(((1.5, 40/(63*np.pi)*(1 - 2/3*R**2 + 2/9*R**3)), (3.0, 80/(63*np.pi)*(1 - R/3)**3)))
BOTH = (LUCY, MONAGHAN)


def lattice(kind: str, per_site: float = 1.0, reach: float = 12.0) -> np.ndarray:
    """(2, sites): a lattice of density 1 with so many particles a site, one site at the origin."""
    axes = AXES[kind]
    n = np.arange(-int(2*reach), int(2*reach) + 1)
    sites = axes@np.stack(np.meshgrid(n, n)).reshape(2, -1)
    return sites*np.sqrt(per_site/np.linalg.det(axes))


def density(weight: Printed, kind: str, per_site: float = 1.0, h: float = RANGE) -> float:
    """The density sum at a particle of a lattice of density 1."""
    r = np.hypot(*lattice(kind, per_site))
    return float(per_site*weight(r, h).sum())


def shear_modulus(weight: Printed, kind: str, h: float, angle: float, step: float = 1e-3) -> float:
    """Shear over bulk modulus of the ideal gas on a lattice turned by an angle, by differences of three sums.

    At constant area only the sum of the density changes: G = P d2(rho)/d(gamma)^2, B = rho c^2 = 2 P, gamma =
    2 step.
    """
    cos, sin = np.cos(angle), np.sin(angle)
    turn = np.array([[cos, sin], [-sin, cos]])
    sums = []
    for s in (-step, 0.0, step):
        stretch = np.diag([np.exp(s), np.exp(-s)])
        sums.append(weight(np.hypot(*(stretch@turn@lattice(kind))), h).sum())
    return float(np.diff(sums, 2)[0]/step**2/4/2)


def largest_modulus(weight: Printed, kind: str, h: float = RANGE) -> float:
    """Largest |G/B| of shears along an axis and at 45 degrees."""
    return max(abs(shear_modulus(weight, kind, h, angle)) for angle in (0.0, np.pi/4))


def decay(kind: str) -> float:
    """Largest |G/B| at range 6 over that at range 3, the worse of both weights."""
    return max(largest_modulus(weight, kind, 6.0)/largest_modulus(weight, kind) for weight in BOTH)


def least(weight: Printed, kind: str) -> tuple[float, int]:
    """Least density sum, and so least energy at any pressure, and how many particles a site have it."""
    return min((density(weight, kind, sites), sites) for sites in SITES)
