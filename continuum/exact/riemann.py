"""The Riemann problem of an ideal gas: shock or rarefaction beside a contact    [Toro 1997, ch. 4]"""
from math import sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq


class GasState(NamedTuple):
    """Density, velocity and pressure, uniform."""
    rho: float
    v: float
    P: float


class Middle(NamedTuple):
    """Velocity and pressure between both waves; densities left and right of the contact."""
    v: float
    P: float
    left: float
    right: float


def jump(gas: GasState, P: float, gamma: float) -> float:
    """Change of velocity across the wave that takes `gas` to pressure P, towards the gas ahead of it."""
    c = sqrt(gamma*gas.P/gas.rho)
    if P > gas.P:
        return (P - gas.P)/sqrt(gas.rho*((gamma + 1)*P + (gamma - 1)*gas.P)/2)
    return 2*c/(gamma - 1)*((P/gas.P)**((gamma - 1)/(2*gamma)) - 1)


def density(gas: GasState, P: float, gamma: float) -> float:
    """Density behind the wave: on the Hugoniot curve for a shock, on the isentrope for a rarefaction."""
    ratio, g = P/gas.P, (gamma - 1)/(gamma + 1)
    return gas.rho*((ratio + g)/(g*ratio + 1) if P > gas.P else ratio**(1/gamma))


def middle(left: GasState, right: GasState, gamma: float) -> Middle:
    """State between both waves. Raises ValueError: the gases part so fast that a vacuum opens."""
    def gap(P: float) -> float:
        return jump(left, P, gamma) + jump(right, P, gamma) + right.v - left.v
    if gap(0.0) >= 0:
        raise ValueError(f"a vacuum opens between {left} and {right}: let them part more slowly")
    ram = (gamma + 1)*(left.rho + right.rho)*(right.v - left.v)**2
    P = float(brentq(gap, 0.0, 1e3*(left.P + right.P) + ram, xtol=1e-15, rtol=1e-14))
    return Middle(left.v - jump(left, P, gamma), P, density(left, P, gamma), density(right, P, gamma))


def shock_speed(gas: GasState, P: float, gamma: float) -> float:
    """Speed of a shock that raises the pressure to P, relative to the gas ahead of it."""
    return sqrt(((gamma + 1)*P/gas.P + gamma - 1)*gas.P/(2*gas.rho))


def solution(left: GasState, right: GasState, gamma: float, s: np.ndarray) -> np.ndarray:
    """(rho, v, P) at places x/t = s (n,), (3, n)."""
    between = middle(left, right, gamma)
    mirror = [side(GasState(right.rho, -right.v, right.P),
                   Middle(-between.v, between.P, between.right, between.left), gamma, -s)]
    one, other = side(left, between, gamma, s), mirror[0]*np.array([[1], [-1], [1]])
    return np.where(s < between.v, one, other)


def side(gas: GasState, between: Middle, gamma: float, s: np.ndarray) -> np.ndarray:
    """(rho, v, P) at places x/t = s left of the contact, (3, n)."""
    there, c = np.array([[between.left], [between.v], [between.P]]), sqrt(gamma*gas.P/gas.rho)
    if between.P > gas.P:
        return np.where(s < gas.v - shock_speed(gas, between.P, gamma), np.array(gas)[:, None], there)
    slow = sqrt(gamma*between.P/between.left)
    v = 2/(gamma + 1)*(c + (gamma - 1)/2*gas.v + s)
    local = np.maximum(2/(gamma + 1)*(c + (gamma - 1)/2*(gas.v - s)), 0)/c
    fan = np.array([gas.rho*local**(2/(gamma - 1)), v, gas.P*local**(2*gamma/(gamma - 1))])
    return np.where(s < gas.v - c, np.array(gas)[:, None], np.where(s > between.v - slow, there, fan))
