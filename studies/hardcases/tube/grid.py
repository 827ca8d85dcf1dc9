"""The shock tube on a fine grid: one-dimensional Navier-Stokes-Fourier, central differences in flux form, between mirrors."""
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from continuum.fluid import ConstEta, pressure, stress, temperature

ACCURATE = 1e-6     # relative, of the steps in time: a thousandth of the errors that are compared


def march(eos: Any, law: ConstEta, dx: float, start: np.ndarray, time: float) -> np.ndarray:
    """rho, v, e (3, n) of cells after a time, from those at the start."""
    rho, v, e = start
    U = np.array([rho, rho*v, rho*(e + v**2/2)])
    done = solve_ivp(lambda t, U: rates(eos, law, dx, U.reshape(3, -1)).ravel(), (0, time), U.ravel(), method="RK45",
                     rtol=ACCURATE, atol=ACCURATE, t_eval=[time])
    return primitive(done.y[:, -1].reshape(3, -1))


def primitive(U: np.ndarray) -> np.ndarray:
    """rho, v, e from densities of mass, momentum and energy."""
    return np.array([U[0], U[1]/U[0], U[2]/U[0] - (U[1]/U[0])**2/2])


def rates(eos: Any, law: ConstEta, dx: float, U: np.ndarray) -> np.ndarray:
    """dU/dt from fluxes on faces: means of both cells and differences between them; behind both ends is a mirror image."""
    rho, v, e = np.pad(primitive(U), ((0, 0), (1, 1)), "edge")
    v[0], v[-1] = -v[1], -v[-2]
    T, P = temperature(eos, rho, e), pressure(eos, rho, e)
    rho, u, e, P = ((q[1:] + q[:-1])/2 for q in (rho, v, e, P))
    friction = stress(law.eta, 0.0, np.diff(v)/dx, 0.0, 0.0, 0.0)[0]
    flux = np.array([rho*u, rho*u*u + P - friction,
                     (rho*(e + u*u/2) + P - friction)*u - law.k*np.diff(T)/dx])
    return -np.diff(flux, axis=1)/dx
