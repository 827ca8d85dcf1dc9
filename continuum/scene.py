"""The main scene of all solvers: a fluid between two plates, heated from below    [KHP95, Secs IV-VI]

Lengths are in units of sigma, y in (-L/2, L/2) upwards, x in (-aspect L/2, aspect L/2). Mean density is 1;
gravity is chosen such that the density of the state at rest is uniform.
"""
from dataclasses import dataclass
from math import inf
from numbers import Real
from typing import Any, ClassVar

import numpy as np

from continuum import fluid
from continuum.jit import check_formulas
from continuum.sides import Periodic, Torus, Walls

__all__ = ["ROLL_ENERGY", "Periodic", "RayleighBenard", "Torus", "Walls", "columns_of"]
ROLL_ENERGY = 9/5000    # kinetic energy per mass K of the initial rolls    [KHP95, Fig. 9]


def positive(**numbers: Any) -> None:
    """Check that numbers are positive and finite. Raises ValueError: one is not. TypeError: no number."""
    for name, value in numbers.items():
        if not isinstance(value, Real):
            raise TypeError(f"{name} must be a number, got {value!r}: give it without quotes or brackets")
        if not 0 < float(value) < inf:
            raise ValueError(f"{name} must be positive and finite, got {value}")


def columns_of(aspect: float, rows: int) -> int:
    """Number of columns of square cells. Raises ValueError: rows below 8, no whole number of columns."""
    if rows < 8:
        raise ValueError(f"rows must be at least 8, got {rows}: fewer do not resolve a roll")
    columns = round(aspect*rows)
    if not np.isclose(columns, aspect*rows) or columns < 4:
        raise ValueError(f"cells are square: aspect x rows = {aspect} x {rows} must be a whole number, 4 or "
                         "more; change the rows or the aspect")
    return columns


class Heated:
    """What follows from the sizes and the temperatures of a scene."""

    @property
    def width(self: Any) -> float:
        return self.aspect*self.L

    @property
    def dT(self: Any) -> float:
        return self.T_hot - self.T_cold

    @property
    def T_mean(self: Any) -> float:
        return (self.T_hot + self.T_cold)/2


@dataclass(frozen=True, kw_only=True)
class RayleighBenard(Heated):
    """A layer of fluid heated from below.

    ra : Rayleigh number g alpha L^3 dT/(nu kappa) at density 1 and mean temperature, kappa = k/(rho C_V).
    eos : equation of state. transport : class of the transport law; its numbers follow from ra and pr.
    L : height in sigma; it only fixes the units of length and time. aspect : width / height.
    T_hot, T_cold : temperatures of the plates at y = -L/2 and y = +L/2. sides : Periodic() or Walls().
    pr : Prandtl number nu/kappa; KHP95 has 1, eta = k with C_V = 1.
    """
    ra: float
    eos: Any = fluid.IdealGas()  # noqa: RUF009  (immutable)
    transport: Any = fluid.ConstEta
    L: float = 50.0
    aspect: float = 2.0
    T_hot: float = 1.5
    T_cold: float = 0.5
    sides: Any = Periodic()  # noqa: RUF009
    pr: float = 1.0
    slide: ClassVar[float] = 0.0        # velocity of the upper plate along x

    def __post_init__(self):
        positive(ra=self.ra, pr=self.pr, L=self.L, aspect=self.aspect, T_hot=self.T_hot, T_cold=self.T_cold)
        if not self.T_hot > self.T_cold:
            raise ValueError(f"temperatures must obey T_hot > T_cold, got {self.T_hot} and {self.T_cold}")
        if not isinstance(self.sides, (Periodic, Walls)):
            raise ValueError(f"sides must be Periodic() or Walls(), got {self.sides!r}")
        if not isinstance(self.transport, type) or not hasattr(self.transport, "_fields"):
            laws = " or ".join(law.__name__ for law in fluid.viscosity.kinds)
            raise TypeError(f"transport must be a class of transport laws, got {self.transport!r}: give "
                            f"{laws}, without quotes or numbers, which follow from ra and pr")
        fluid.check_eos(self.eos)
        for T in (self.T_hot, self.T_cold):
            fluid.check_state(self.eos, 1.0, fluid.energy(self.eos, 1.0, T))
        try:
            positive(nu=self.nu, k=self.k, time=self.viscous_time, width=self.width)
        except (OverflowError, ZeroDivisionError) as error:
            raise ValueError(f"no float holds nu or L^2/nu of L = {self.L:g}, ra = {self.ra:g}: take L = 50, "
                             "which only fixes the units") from error
        check_formulas(self.law, fluid.viscosity, fluid.conductivity)
        given = [float(q(self.law, 1.0, self.T_mean)) for q in (fluid.viscosity, fluid.conductivity)]
        if not np.allclose(given, [self.nu, self.k]):
            raise ValueError(
                f"{self.transport.__name__} gives eta, k = {given} at rho = 1, T = {self.T_mean}, but Ra = "
                f"{self.ra} needs {self.nu, self.k}: choose temperatures around that of the law")

    @property
    def g(self) -> float:
        """Gravity that balances the pressure gradient (dP/dT)_rho dT/dy at density 1    [KHP95, Sec. IV]"""
        return float(fluid.thermal_pressure(self.eos, 1.0, self.T_mean))*self.dT/self.L

    @property
    def alpha(self) -> float:
        """Thermal expansivity -(1/rho)(drho/dT)_P at density 1 and mean temperature."""
        return float(fluid.expansivity(self.eos, 1.0, self.T_mean))

    @property
    def nu(self) -> float:
        """Kinematic viscosity, sigma^2 per unit of time; at density 1 it equals the shear viscosity."""
        return float(np.sqrt(self.pr*self.g*self.alpha*self.dT*self.L**3/self.ra))

    @property
    def kappa(self) -> float:
        """Thermal diffusivity k/(rho C_V)."""
        return self.nu/self.pr

    @property
    def k(self) -> float:
        """Heat conductivity at density 1."""
        return self.kappa*self.eos.cv

    @property
    def law(self) -> Any:
        """Transport law with the numbers of the scene, for `viscosity` and `conductivity`."""
        known = {"eta": self.nu, "k": self.k, "nu": self.nu, "kappa": self.kappa, "cv": self.eos.cv}
        return self.transport(**{name: known[name] for name in self.transport._fields if name in known})

    @property
    def viscous_time(self) -> float:
        """L^2/nu, the time after which a flow far from onset is steady."""
        return self.L**2/self.nu

    @property
    def free_fall(self) -> float:
        """Free-fall velocity sqrt(g alpha dT L), the unit of Boussinesq solutions; 1 for the ideal gas."""
        return float(np.sqrt(self.g*self.alpha*self.dT*self.L))

    def T(self, y):
        """Conduction profile, linear in y: with density 1 and constant k the exact state at rest."""
        return self.T_mean - self.dT*np.asarray(y)/self.L

    def flow(self, x, y, ke: float, rolls: int | None = None):
        """Velocities (v_x, v_y) of initial rolls with kinetic energy `ke` per mass (density 1). `rolls` is
        their number along x; by default rolls are about as wide as high, and come in pairs if periodic."""
        if not ke >= 0:
            raise ValueError(f"the kinetic energy of the initial rolls cannot be negative, got {ke}")
        if rolls is None:
            step = 2 if isinstance(self.sides, Periodic) else 1
            rolls = step*max(1, round(self.aspect/step))
        u, v = self.sides.rolls(np.asarray(x), np.asarray(y), self.width, self.L, rolls)
        scale = np.sqrt(ke/self._roll_energy(rolls))
        return scale*u, scale*v

    def fields(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Initial density, velocity and temperature at positions (n, 2)    [KHP95, Sec. VI]"""
        return np.ones(len(x)), np.stack(self.flow(x[:, 0], x[:, 1], ROLL_ENERGY), axis=1), self.T(x[:, 1])

    def _roll_energy(self, rolls: int) -> float:
        """Mean of v^2/2 over the unscaled rolls; the midpoint rule is exact for their few harmonics."""
        mid = (np.arange(8*(rolls + 2)) + 0.5)/(8*(rolls + 2)) - 0.5
        u, v = self.sides.rolls(mid*self.width, mid[:, None]*self.L, self.width, self.L, rolls)
        return float(np.mean(u**2 + v**2)/2)
