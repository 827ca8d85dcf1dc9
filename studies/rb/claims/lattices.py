"""The two weights exactly as KHP95 print them (Sec. II), and what lattices of particles make of them.

Lengths in sigma, mass 1 a particle, density 1. `particles.weights` normalises its weights by quadrature; here the
printed factors stand, so that they can be judged.
"""
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

R = Polynomial([0, 1])
RANGE = 3.0
KINDS = ("square", "hexagonal")


class Printed(NamedTuple):
    """A weight of range 3 in pieces (upper end, polynomial in r)."""
    pieces: tuple[tuple[float, Polynomial], ...]

    def __call__(self, r, h: float = RANGE):
        """w(r) of range h; the printed one stretched, its integral kept."""
        s = np.asarray(r)*RANGE/h
        inside = [s < end for end, _ in self.pieces]
        return (RANGE/h)**2*np.select(inside, [piece(s) for _, piece in self.pieces], 0.0)

    @property
    def integral(self) -> float:
        """Over the plane."""
        begins = (0.0, *(end for end, _ in self.pieces))
        discs = [(2*np.pi*R*piece).integ() for _, piece in self.pieces]
        return float(sum(disc(end) - disc(begin)
                         for disc, begin, (end, _) in zip(discs, begins, self.pieces, strict=False)))

    def jumps(self, order: int) -> list[float]:
        """Jumps of the derivative of that order at the ends of the pieces, over w(0); at r = 0 the slope itself."""
        slopes = [piece.deriv(order) if order else piece for _, piece in self.pieces] + [Polynomial([0.0])]
        found = [slopes[i + 1](end) - slopes[i](end) for i, (end, _) in enumerate(self.pieces)]
        return [jump/float(self(0.0)) for jump in found + ([slopes[0](0.0)] if order == 1 else [])]


LUCY = Printed(((3.0, 5/(9*np.pi)*(1 + R)*(1 - R/3)**3),))
MONAGHAN = Printed(((1.5, 40/(63*np.pi)*(1 - 2/3*R**2 + 2/9*R**3)), (3.0, 80/(63*np.pi)*(1 - R/3)**3)))
BOTH = (LUCY, MONAGHAN)


def lattice(kind: str, per_site: float = 1.0, reach: float = 12.0) -> np.ndarray:
    """(2, sites): a lattice of density 1 with so many particles a site, one site at the origin."""
    axes = np.array([[1.0, 0.0], [0.0, 1.0]] if kind == "square" else [[1.0, 0.5], [0.0, np.sqrt(3)/2]])
    n = np.arange(-int(2*reach), int(2*reach) + 1)
    sites = axes@np.stack(np.meshgrid(n, n)).reshape(2, -1)
    return sites*np.sqrt(per_site/np.linalg.det(axes))


def density(weight: Printed, kind: str, per_site: float = 1.0, h: float = RANGE) -> float:
    """What the density sum gives at a particle of a lattice of density 1."""
    return float(per_site*weight(np.hypot(*lattice(kind, per_site)), h).sum())


def shear_moduli(weight: Printed, kind: str, h: float = RANGE) -> np.ndarray:
    """(2,): shear over bulk modulus of the ideal gas on a lattice, for shears along an axis and at 45 degrees.

    At constant area only the sum of the density changes: G = P d2(rho)/d(gamma)^2, B = rho c^2 = 2 P.
    """
    step, moduli = 1e-3, []
    for angle in (0.0, np.pi/4):
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        stretched = [weight(np.hypot(*(np.diag([np.exp(s), np.exp(-s)])@turn@lattice(kind))), h).sum()
                     for s in (-step, 0.0, step)]
        moduli.append(np.diff(stretched, 2)[0]/step**2/4/2)  # gamma = 2 s
    return np.array(moduli)
