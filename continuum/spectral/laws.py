"""Conservation laws at a point: d(stored)/dt = source - d(flux_x)/dx - d(flux_y)/dy.

The laws are those of x and y momentum, mass and energy. Lengths are in heights of the layer. Fields are given
as (4, 3, ...): v_x, v_y, density or pressure, temperature, as deviations from the state at rest, each with
its slopes along x and y. The formulas are analytic, so that complex steps give exact derivatives.
"""
from dataclasses import dataclass
from typing import Any

import numpy as np

from continuum.fluid import conductivity, energy, pressure, stress, viscosity


@dataclass(frozen=True)
class GasLaws:
    """Laws of the compressible gas in a layer; scene : `RayleighBenard` or another with its attributes."""
    scene: Any

    @property
    def width(self) -> float:
        return self.scene.aspect

    @property
    def units(self) -> tuple[float, float, float]:
        """Units: free-fall velocity, temperature difference, heat flux of conduction alone."""
        return self.scene.free_fall, self.scene.dT, self.scene.k*self.scene.dT/self.scene.L

    def terms(self, at: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(law, term, ...): terms source, flux_x, flux_y, stored, of momentum, mass, total energy."""
        scene, (u, u_x, u_y), (v, v_x, v_y), (warm, T_x, T_y) = self.scene, *at[[0, 1, 3]]
        rho, T, weight = 1 + at[2, 0], warm + scene.T(scene.L*y), scene.g*scene.L
        e, k = energy(scene.eos, rho, T), conductivity(scene.law, rho, T)/scene.L
        P, eta = pressure(scene.eos, rho, e), viscosity(scene.law, rho, T)/scene.L
        sxx, sxy, syy = stress(eta, 0.0, u_x, v_x, u_y, v_y)
        total, steep = rho*(e + (u*u + v*v)/2 + weight*y), T_y - scene.dT
        return stacked([
            [0, rho*u*u + P - sxx, rho*u*v - sxy, rho*u],
            [-rho*weight, rho*u*v - sxy, rho*v*v + P - syy, rho*v],
            [0, rho*u, rho*v, rho],
            [0, (total + P - sxx)*u - sxy*v - k*T_x, (total + P - syy)*v - sxy*u - k*steep, total]])


@dataclass(frozen=True)
class BoussinesqLaws:
    """Laws of the Boussinesq fluid in free-fall units; third field: pressure; fourth law: that of T."""
    ra: float
    pr: float
    width: float = 2.0

    @property
    def units(self) -> tuple[float, float, float]:
        """As in `GasLaws`; the last is the thermal diffusivity."""
        return 1.0, 1.0, float((self.pr*self.ra)**-0.5)

    def terms(self, at: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(law, term, ...): terms source, flux_x, flux_y, stored."""
        return self.of_T(at, at[3, 0], y, (0, 1))

    def of_T(self, at: np.ndarray, lift: np.ndarray, s: np.ndarray, falls: tuple[int, int]) -> np.ndarray:
        """Terms with T = warm - s, `falls` = grad s, (1, 0) or (0, 1), and `lift`, the buoyancy."""
        (u, u_x, u_y), (v, v_x, v_y), (p, _, _), (warm, T_x, T_y) = at
        nu, kappa, T = float((self.pr/self.ra)**0.5), self.units[2], warm - s
        return stacked([
            [0, u*u + p - nu*u_x, u*v - nu*u_y, u],
            [lift, u*v - nu*v_x, v*v + p - nu*v_y, v],
            [0, u, v, 0],
            [0, u*T - kappa*(T_x - falls[0]), v*T - kappa*(T_y - falls[1]), T]])


def stacked(laws: list) -> np.ndarray:
    """Terms as one array; those that are numbers are broadcast."""
    return np.array([np.broadcast_arrays(*law, laws[0][1])[:-1] for law in laws])
