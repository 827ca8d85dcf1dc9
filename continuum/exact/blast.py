"""Point explosion in a cold gas of uniform density, in d dimensions    [Sedov 1959; Kamm & Timmes 2007]

The shock is at R = (E t^2/(alpha rho))^(1/(d + 2)) and has speed D. Behind it, as functions of x = r/R,
velocity is D f, density rho g, pressure rho D^2 h.
"""
from functools import cache
from math import gamma as factorial
from math import pi
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

CENTRE = 1e-3       # lower end of the integration over x; less than a millionth of the energy is inside


class Blast(NamedTuple):
    """alpha = E t^2/(rho R^(d + 2)), and the mean radius of the energy over R."""
    alpha: float
    radius: float


def slopes(x: float, q: np.ndarray, gamma: float, d: int) -> np.ndarray:
    """d/dx of f, g, h, of the energy and of its first moment, both over |S| rho D^2 R^d.

    (f - x) g' + g f' = -(d - 1) f g/x,   (f - x) f' + h'/g = d f/2,   (f - x)(h'/h - gamma g'/g) = d
    """
    f, g, h = q[:3]
    lag = f - x
    fluid = np.array([[g, lag, 0], [g*lag, 0, 1], [0, -gamma*lag/g, lag/h]])
    energy = (g*f**2/2 + h/(gamma - 1))*x**(d - 1)
    return np.array([*np.linalg.solve(fluid, [-(d - 1)*f*g/x, d*g*f/2, d]), energy, x*energy])


@cache
def blast(gamma: float, d: int = 2) -> Blast:
    """Integrate inwards from a strong shock. Raises ValueError: gamma is not above 1 and at most 2."""
    if not 1 < gamma <= 2:
        raise ValueError(f"gamma must lie above 1 and up to 2, got {gamma}: take 1 + 1/cv of the gas")
    strong = [2/(gamma + 1), (gamma + 1)/(gamma - 1), 2/(gamma + 1), 0, 0]
    done = solve_ivp(slopes, (1, CENTRE), strong, args=(gamma, d), method="LSODA", rtol=1e-9, atol=1e-14)
    energy, moment = -done.y[3:, -1]
    sphere = 2*pi**(d/2)/factorial(d/2)
    return Blast(sphere*(2/(d + 2))**2*energy, moment/energy)
