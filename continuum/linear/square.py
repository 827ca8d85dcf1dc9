"""Onset of Boussinesq convection in a square with rigid walls and sides of linear temperature.

As in `linear`, sigma = 0 with nu = kappa = Ra^-1/2 makes 1/sqrt(Ra) an eigenvalue of the work of buoyancy
against dissipation; here in two directions: streamfunction psi and temperature are products of the trial
functions of a layer.
"""
import numpy as np

from continuum.linear.layer import onset, trial

DEGREE = 14     # trial functions in each direction: Ra_c has 8 figures; 8 gives 6


def critical_ra_square(number: int = 0, degree: int = DEGREE) -> float:
    """The Rayleigh number at which disturbance `number` grows: 0 is one roll, 1 two rolls side by side."""
    if not 0 <= number < degree:
        raise ValueError(f"number must be from 0 to {degree - 1}, got {number}: higher ones are not resolved")
    return onset(*forms(degree), number)


def forms(degree: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Integrals of (Lap psi)^2, (grad T)^2 and w T, w = d psi/dx, over products of trial functions. psi and
    its slope vanish on the walls: psi_xx psi_yy integrates to psi_xy^2."""
    dz, *psi = trial(2, 2, degree)
    _, *T = trial(1, 1, degree)

    def both(f, g):
        return (f*dz)@g.T
    zero, one, two = (both(f, f) for f in psi)
    friction = np.kron(two, zero) + np.kron(zero, two) + 2*np.kron(one, one)
    mass, slope = both(T[0], T[0]), both(T[1], T[1])
    lift = np.kron(both(psi[1], T[0]), both(psi[0], T[0]))
    return friction, np.kron(slope, mass) + np.kron(mass, slope), lift
