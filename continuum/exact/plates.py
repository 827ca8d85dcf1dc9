"""Flows between plates that depend only on the height, by collocation at Chebyshev points.

    rho' = -(rho v)_s        v' = -v v_s + (eta v_s - P)_s/rho        u' = -v u_s + eta u_ss/rho
    T' = -v T_s + (-P v_s + eta (v_s^2 + u_s^2) + k T_ss)/rho

with P = rho T, C_V = 1, eta = k, in 2D without bulk viscosity. The height s runs from 0 to 1; all lengths are
in heights of the layer. At the plates v = 0, T = 1, and u = 0 below, U above.
"""
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from scipy.integrate import quad, solve_ivp

# eta = k: sound crosses many times while heat does once, and boundary layers are many spacings wide
MU = 0.02
WAVE = 3            # half waves of the decaying perturbation, over the height
DEGREE, COARSER = 40, 32
NEAR = 1e-10        # relative tolerance of the integration in time


class PlateFlow(NamedTuple):
    """Start with temperature 1 + heat sin(3 pi s) at uniform pressure and velocity U (s + sin(3 pi s)/2)."""
    name: str
    heat: float = 0.0
    U: float = 0.0
    time: float = 0.01/MU       # of the end, in heights over the unit of velocity

    def start(self, s: np.ndarray) -> np.ndarray:
        """(rho, v, u, T) at heights s (n,), (4, n); the mean density is 1."""
        wave = np.sin(WAVE*np.pi*s)
        T = 1 + self.heat*wave
        mean = quad(lambda q: 1/(1 + self.heat*np.sin(WAVE*np.pi*q)), 0, 1, epsabs=1e-13)[0]
        return np.array([1/(mean*T), 0*s, self.U*(s + wave/2), T])


FLOWS = {flow.name: flow for flow in (PlateFlow("conduction", heat=0.1), PlateFlow("couette", U=0.1))}


@cache
def solved(flow: PlateFlow, degree: int = DEGREE) -> np.ndarray:
    """Chebyshev coefficients (degree + 1, 4) of (rho, v, u, T) at the time of the end."""
    x = np.cos(np.pi*np.arange(degree, -1, -1)/degree)
    to_values = chebyshev.chebvander(x, degree)
    slope = 2*chebyshev.chebval(x, chebyshev.chebder(np.eye(degree + 1))).T@np.linalg.inv(to_values)

    def rates(time: float, flat: np.ndarray) -> np.ndarray:
        rho, v, _, T = flat.reshape(4, -1)
        _, vs, us, Ts = slopes = flat.reshape(4, -1)@slope.T
        Ps, (_, vss, uss, Tss) = slope@(rho*T), slopes@slope.T
        out = np.array([-slope@(rho*v), -v*vs + (MU*vss - Ps)/rho, -v*us + MU*uss/rho,
                        -v*Ts + (-rho*T*vs + MU*(vs**2 + us**2) + MU*Tss)/rho])
        out[1:, [0, -1]] = 0
        return out.ravel()
    first = flow.start((x + 1)/2)
    done = solve_ivp(rates, (0, flow.time), first.ravel(), method="LSODA", rtol=NEAR, atol=NEAR/100)
    return np.linalg.solve(to_values, done.y[:, -1].reshape(4, -1).T)


def fields(flow: PlateFlow, s: np.ndarray, degree: int = DEGREE) -> np.ndarray:
    """(rho, v, u, T) at heights s (n,) at the time of the end, (4, n)."""
    return chebyshev.chebval(2*s - 1, solved(flow, degree))
