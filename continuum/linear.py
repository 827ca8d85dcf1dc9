"""Linear stability of a Boussinesq fluid heated from below: growth rates, critical Rayleigh numbers.

Free-fall units: height H, temperature difference and sqrt(g alpha dT H) are 1, so that nu = sqrt(Pr/Ra) and
kappa = 1/sqrt(Pr Ra). Disturbances w(z), theta(z) times cos(kx) exp(sigma t), with Lap = d2/dz2 - k^2, obey

    sigma Lap w = nu Lap^2 w - k^2 theta,    sigma theta = w + kappa Lap theta.

Multiplied by -w and by k^2 theta and integrated over the height this is a symmetric eigenvalue problem. Trial
functions are Chebyshev polynomials times a factor that meets the conditions at the plates. Gauss sums give
exact integrals; w'' = 0 on a free plate is a natural boundary condition. At onset, with nu = kappa, the
matrix of buoyant work over that of dissipation has the largest eigenvalue Ra^-1/2.
"""
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev
from scipy.linalg import block_diag, eigh
from scipy.optimize import minimize_scalar

from continuum.scene import positive

DEGREE = 20     # trial functions for w and for theta each; from 14 on Ra_c has 12 figures
IN_SQUARE = 14  # trial functions in each direction: Ra_c has 8 figures, with 8 functions 6
#: plates, by the order of the zero of w on both: w = w' = 0, or w = w'' = 0
RIGID, FREE = 2, 1


class Critical(NamedTuple):
    """Onset in the infinite layer: critical Rayleigh number and wavenumber in 1/H."""
    ra: float
    k: float


class Forms(NamedTuple):
    """Integrals of the variational form: matrices (degree, degree) over the trial functions."""
    inertia: np.ndarray         # w'^2 + k^2 w^2
    friction: np.ndarray        # (Lap w)^2
    heat: np.ndarray            # theta^2
    conduction: np.ndarray      # theta'^2 + k^2 theta^2
    lift: np.ndarray            # w theta


@lru_cache
def trial(zero: int, degree: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """(weights, f, f', f'') at Gauss points of z in (-1/2, 1/2); f_n = (1 - 4z^2)^zero T_n(2z)."""
    points, weights = np.polynomial.legendre.leggauss(degree + 6)
    edge = Chebyshev([1, 1])**zero*Chebyshev([1, -1])**zero
    f = [edge*Chebyshev.basis(n) for n in range(degree)]
    values = [np.array([2**m*g.deriv(m)(points) for g in f]) for m in range(3)]
    return weights/2, values[0], values[1], values[2]


def forms(k: float, plates: int, degree: int) -> Forms:
    """All matrices at wavenumber k."""
    dz, w, w1, w2 = trial(plates, degree)
    _, theta, theta1, _ = trial(1, degree)
    lap = w2 - k**2*w
    return Forms(inertia=(w1*dz)@w1.T + k**2*(w*dz)@w.T,
                 friction=(lap*dz)@lap.T,
                 heat=(theta*dz)@theta.T,
                 conduction=(theta1*dz)@theta1.T + k**2*(theta*dz)@theta.T,
                 lift=(w*dz)@theta.T)


def growth_rate(*, ra: float, pr: float, k: float, plates: int = RIGID) -> float:
    """Largest growth rate sigma at wavenumber k (1/H), per free-fall time; negative below onset."""
    positive(ra=ra, pr=pr, k=k)
    nu, kappa = np.sqrt(pr/ra), 1/np.sqrt(pr*ra)
    i = forms(k, plates, DEGREE)
    rate = np.block([[-nu*i.friction,  k**2*i.lift],
                     [k**2*i.lift.T,  -kappa*k**2*i.conduction]])
    return float(eigh(rate, block_diag(i.inertia, k**2*i.heat), eigvals_only=True)[-1])


def critical_ra(k: float, plates: int = RIGID, degree: int = DEGREE) -> float:
    """Rayleigh number at which wavenumber k (1/H) neither grows nor decays, for any Pr."""
    positive(k=k)
    i = forms(k, plates, degree)
    return onset(i.friction/k**2, i.conduction, i.lift)


def onset(friction: np.ndarray, conduction: np.ndarray, lift: np.ndarray) -> float:
    """Lowest Ra at which a disturbance grows: 1/sqrt(Ra) is the largest buoyant work over dissipation."""
    none = np.zeros_like(lift)
    work = np.block([[none, lift], [lift.T, none]])
    return float(eigh(work, block_diag(friction, conduction), eigvals_only=True)[-1]**-2)


@lru_cache
def critical(plates: int = RIGID) -> Critical:
    """Onset in the infinite layer: the smallest Ra over all wavenumbers."""
    lowest = minimize_scalar(lambda k: critical_ra(k, plates), bracket=(1.5, 2.5, 4.5),
                             options={"xtol": 1e-10})
    return Critical(ra=float(lowest.fun), k=float(lowest.x))


def critical_ra_square() -> float:
    """Ra at which a roll begins to grow in a square with rigid walls and sides of linear temperature.

    Streamfunction psi, w = d psi/dx, and temperature are products of the trial functions of a layer. psi and
    its normal slope vanish on the walls, so that psi_xx psi_yy integrates to psi_xy^2.
    """
    dz, *psi = trial(2, IN_SQUARE)
    _, T, T1, _ = trial(1, IN_SQUARE)

    def both(f, g):
        return (f*dz)@g.T
    zero, one, two = (both(f, f) for f in psi)
    friction = np.kron(two, zero) + np.kron(zero, two) + 2*np.kron(one, one)
    mass, slope = both(T, T), both(T1, T1)
    lift = np.kron(both(psi[1], T), both(psi[0], T))
    return onset(friction, np.kron(slope, mass) + np.kron(mass, slope), lift)
