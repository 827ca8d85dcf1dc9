"""Sod's shock tube: how near is a method to the exact solution?

Density 1 and pressure 1 against 0.125 and 0.1, gamma = 1.4 [Sod 1978]. At the time 0.4 L, L being half of the
tube, the shock is at 0.70 L from the diaphragm. A viscous gas is followed on a fine grid: one-dimensional
Navier-Stokes-Fourier in flux form, between mirrors.
"""
import numpy as np
from scipy.integrate import solve_ivp

from continuum.exact.riemann import GasState, solution
from continuum.fluid import IdealGas

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = GasState(1.0, 0.0, 1.0), GasState(0.125, 0.0, 0.1)
END = 0.4                       # time over L
FINE = 0.25                     # cells of the grid, spacings
ACCURATE = 1e-6                 # relative, of the grid's steps in time: a thousandth of the errors compared
NAMES = ("rho", "v", "P")


def exact(L: float, x: np.ndarray) -> np.ndarray:
    """(3, n): rho, v, P of the frictionless gas at the end, 0 < x < 2 L."""
    return solution(DENSE, THIN, GAMMA, (x - L)/(END*L))


def viscous(L: float, eta: float, x: np.ndarray) -> np.ndarray:
    """The same of a gas with viscosity and conductivity eta on the fine grid; not numbers if it has none."""
    if not eta:
        return np.full((3, len(x)), np.nan)
    cells = (np.arange(round(2*L/FINE)) + 0.5)*FINE
    fields = march(start(cells < L), eta, END*L)
    return np.array([np.interp(x, cells, field) for field in fields])


def start(dense: np.ndarray) -> np.ndarray:
    """rho, v, P (3, n), dense gas in some cells."""
    return np.where(dense, np.array(DENSE)[:, None], np.array(THIN)[:, None])


def march(start: np.ndarray, eta: float, time: float) -> np.ndarray:
    """rho, v, P (3, n) of fine cells after a time."""
    rho, v, P = start
    U = np.array([rho, rho*v, EOS.cv*P + rho*v**2/2])

    def slopes(t: float, U: np.ndarray) -> np.ndarray:
        return rates(U.reshape(3, -1), eta).ravel()
    done = solve_ivp(slopes, (0, time), U.ravel(), rtol=ACCURATE, atol=ACCURATE, t_eval=[time])
    last = done.y.reshape(3, -1)
    rho, v, e = primitive(last)
    return np.array([rho, v, e*rho/EOS.cv])


def primitive(U: np.ndarray) -> np.ndarray:
    """rho, v, e from densities of mass, momentum and energy."""
    rho, p, energy = U
    v = p/rho
    return np.array([rho, v, energy/rho - v**2/2])


def rates(U: np.ndarray, eta: float) -> np.ndarray:
    """dU/dt from fluxes on faces; behind both ends is a mirror image. In 2D friction is eta dv/dx."""
    rho, v, e = np.pad(primitive(U), ((0, 0), (1, 1)), "edge")
    v[[0, -1]] *= -1
    T = e/EOS.cv
    friction = eta*np.diff(v)/FINE
    heat = eta*np.diff(T)/FINE
    rho, v, e, P = ((q[1:] + q[:-1])/2 for q in (rho, v, e, rho*T))
    momentum = rho*v**2 + P - friction
    energy = (rho*(e + v**2/2) + P - friction)*v - heat
    flux = np.array([rho*v, momentum, energy])
    return -np.diff(flux, axis=1)/FINE


def compared(fields: np.ndarray, truth: np.ndarray, twin: np.ndarray) -> dict[str, float]:
    """rho_exact to P_grid, mean |difference| of fields (3, n) from both others over their range; wiggles."""
    size = np.ptp(truth, axis=1)
    errors = {}
    for of, other in (("exact", truth), ("grid", twin)):
        apart = np.abs(fields - other).mean(axis=1)
        for name, error in zip(NAMES, apart/size, strict=True):
            errors[f"{name}_{of}"] = float(error)
    return errors | {"wiggles": wiggles(fields[1], truth[1])}


def wiggles(v: np.ndarray, truth: np.ndarray) -> float:
    """Variation of a velocity beyond that of the exact one, over it."""
    variation = np.abs(np.diff(v)).sum()
    return float(variation/np.abs(np.diff(truth)).sum() - 1)
