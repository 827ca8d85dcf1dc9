"""Constitutive relations of all solvers: equations of state, transport laws, stress.

Units of KHP95: m = kB = sigma = epsilon = 1. `rho` is mass per area, `e` internal energy per mass, `T`
temperature. Every relation is plain arithmetic on numbers or arrays, in Python and in compiled code.
An equation of state or a transport law is a NamedTuple; a new one is a class and its formulas in this file.
"""
from functools import wraps
from typing import Any, NamedTuple

import numpy as np

from continuum.jit import check_formulas, formula, generic

#: numbers of laws that must not be negative; others may have either sign
NOT_NEGATIVE = ("b", "eta", "k", "nu", "kappa")


def _numbers(kind: type) -> type:
    """Let a law check its numbers: finite, and not negative in `NOT_NEGATIVE`. Raises ValueError."""
    plain: Any = kind.__new__

    @wraps(plain)       # compiled code reads the signature
    def checked(cls: type, *args: Any, **named: Any) -> Any:
        law = plain(cls, *args, **named)
        for name, value in zip(law._fields, law):
            if np.asarray(value).dtype.kind not in "iuf" or not np.isfinite(value).all():
                raise ValueError(f"{name} of {kind.__name__} must be a finite number, got {value!r}")
            if name in NOT_NEGATIVE and not np.all(np.asarray(value) >= 0):
                raise ValueError(f"{name} of {kind.__name__} must not be negative, got {value}: 0 "
                                 "switches it off")
            if name == "cv" and not np.all(np.asarray(value) > 0):
                raise ValueError(f"cv of {kind.__name__} must be positive, got {value}: heat would cool")
        return law
    setattr(kind, "__new__", checked)  # noqa: B010  (mypy allows it so)
    return kind


@_numbers
class IdealGas(NamedTuple):
    """P = rho e, T = e: two-dimensional ideal gas, C_V = 1    [KHP95, Eq. 1]"""
    cv: float = 1.0


@_numbers
class VanDerWaals(NamedTuple):
    """P = rho T/(1 - rho b) - a rho^2, e = T - a rho    [KHP95, Eq. 2]"""
    a: float = 0.5
    b: float = 0.5
    cv: float = 1.0


@_numbers
class DenseFluid(NamedTuple):
    """Quadratic fit to molecular dynamics around rho = 1, T = 1, e = 1.443    [KHP95, Eq. 3]

    The printed T(rho, e) and e(rho, T) are separate expansions: at rho = 1, T(rho, e(rho, T)) - 1 is
    1.05 (T - 1). P and e violate the Maxwell relation even at the reference state [KHP95, Sec. IV].
    """
    cv: float = 1.5


class Fields(NamedTuple):
    """Positions x (n, d), nan if a method has none, velocity v (n, d), density, temperature, volume (n,)."""
    x: np.ndarray
    v: np.ndarray
    rho: np.ndarray
    T: np.ndarray
    V: np.ndarray


@generic
def pressure(eos, rho, e):
    """P(rho, e)."""


@generic
def temperature(eos, rho, e):
    """T(rho, e)."""


@generic
def energy(eos, rho, T):
    """e(rho, T), energy per mass."""


@generic
def pressure_slopes(eos, rho, e):
    """(dP/drho at constant e, dP/de at constant rho)."""


@generic
def thermal_pressure(eos, rho, T):
    """dP/dT at constant rho; times |dT/dy|/rho it is the gravity that keeps rho uniform in a still layer."""


@generic
def valid(eos, rho, e):
    """True where the equation of state may be used."""


pressure.of(IdealGas)(lambda eos, rho, e: rho*e/eos.cv)
temperature.of(IdealGas)(lambda eos, rho, e: e/eos.cv)
energy.of(IdealGas)(lambda eos, rho, T: eos.cv*T)
pressure_slopes.of(IdealGas)(lambda eos, rho, e: (e/eos.cv, rho/eos.cv))
thermal_pressure.of(IdealGas)(lambda eos, rho, T: rho)
valid.of(IdealGas)(lambda eos, rho, e: (rho > 0) & (e > 0))
pressure.of(VanDerWaals)(lambda eos, rho, e: rho*(e + eos.a*rho)/eos.cv/(1 - rho*eos.b) - eos.a*rho**2)
temperature.of(VanDerWaals)(lambda eos, rho, e: (e + eos.a*rho)/eos.cv)
energy.of(VanDerWaals)(lambda eos, rho, T: eos.cv*T - eos.a*rho)


@pressure_slopes.of(VanDerWaals)
def _(eos, rho, e):
    room = 1 - rho*eos.b
    T = (e + eos.a*rho)/eos.cv
    return T/room**2 + rho*eos.a/eos.cv/room - 2*eos.a*rho, rho/eos.cv/room


thermal_pressure.of(VanDerWaals)(lambda eos, rho, T: rho/(1 - rho*eos.b))
valid.of(VanDerWaals)(lambda eos, rho, e: (rho > 0) & (rho*eos.b < 1) & (e + eos.a*rho > 0))


@pressure.of(DenseFluid)
def _(eos, rho, e):
    dn, du = rho - 1, e - 1.443
    return rho*(5 + 8*dn + 2.5*du + 9*dn**2 + 2*dn*du)


@temperature.of(DenseFluid)
def _(eos, rho, e):
    dn, du = rho - 1, e - 1.443
    return 1 - dn + 0.7*du - 0.8*dn**2 - 0.5*dn*du


@energy.of(DenseFluid)
def _(eos, rho, T):
    dn, dt = rho - 1, T - 1
    return 1.443 + 1.5*dn + 1.5*dt + 2.4*dn**2 + 1.2*dn*dt


@pressure_slopes.of(DenseFluid)
def _(eos, rho, e):
    dn, du = rho - 1, e - 1.443
    per_rho = 5 + 8*dn + 2.5*du + 9*dn**2 + 2*dn*du
    return per_rho + rho*(8 + 18*dn + 2*du), rho*(2.5 + 2*dn)


@thermal_pressure.of(DenseFluid)
def _(eos, rho, T):
    dn = rho - 1
    return rho*(2.5 + 2*dn)*(1.5 + 1.2*dn)


@valid.of(DenseFluid)
def _(eos, rho, e):
    # the fit has no physical limit: it is valid while sound speed squared and temperature are positive
    slopes = pressure_slopes(eos, rho, e)
    stiff = slopes[0] + pressure(eos, rho, e)/rho**2*slopes[1] > 0
    return (rho > 0) & stiff & (temperature(eos, rho, e) > 0)


EQUATIONS_OF_STATE = {"ideal": IdealGas(), "vdw": VanDerWaals(), "dense": DenseFluid()}


@formula
def sound_speed(eos, rho, e):
    """c = sqrt(dP/drho + (P/rho^2) dP/de), from the slope of the pressure along an isentrope."""
    by_rho, by_e = pressure_slopes(eos, rho, e)
    return np.sqrt(by_rho + pressure(eos, rho, e)/rho**2*by_e)


def expansivity(eos, rho: float, T: float) -> float:
    """alpha = -(1/rho) (drho/dT)_P at (rho, T), from (dP/drho)_T = P_rho + P_e (de/drho)_T."""
    step = 1e-6*rho
    e_rho = (energy(eos, rho + step, T) - energy(eos, rho - step, T))/(2*step)
    by_rho, by_e = pressure_slopes(eos, rho, energy(eos, rho, T))
    return thermal_pressure(eos, rho, T)/(rho*(by_rho + by_e*e_rho))


def check_eos(eos: Any) -> None:
    """Check that the equation of state has all formulas: TypeError. A class itself is left to `energy`."""
    if isinstance(eos, str):
        raise TypeError(f"eos must be an object such as IdealGas(), got {eos!r}: EQUATIONS_OF_STATE of "
                        f"continuum.fluid has {', '.join(EQUATIONS_OF_STATE)}")
    if not isinstance(eos, type):
        check_formulas(eos, pressure, temperature, energy, pressure_slopes, thermal_pressure, valid)


def check_state(eos, rho: Any, e: Any) -> None:
    """Raise ValueError for the first state for which the equation of state is not valid."""
    rho, e = np.broadcast_arrays(rho, e)
    bad = np.flatnonzero(~valid(eos, rho, e))
    if bad.size:
        r, u = rho.flat[bad[0]], e.flat[bad[0]]
        rule = f"rho b = {r*eos.b:.4g} must stay below 1 and " if isinstance(eos, VanDerWaals) else ""
        raise ValueError(f"rho = {r:.6g}, e = {u:.6g} (item {bad[0]}) is outside the validity of "
                         f"{type(eos).__name__}: {rule}rho, T and c^2 must be positive")


@_numbers
class ConstEta(NamedTuple):
    """Constant shear viscosity eta and conductivity k, bulk viscosity 0    [KHP95, Sec. IV, first choice]"""
    eta: float
    k: float


@_numbers
class ConstNu(NamedTuple):
    """Constant nu = eta/rho and diffusivity kappa = k/(rho C_V)    [KHP95, Sec. IV, second]"""
    nu: float
    kappa: float
    cv: float = 1.0


@_numbers
class PowerLaw(NamedTuple):
    """eta and k proportional to rho^m T^n: an example of transport that depends on the state."""
    eta: float
    k: float
    m: float = 0.0
    n: float = 0.5


@generic
def viscosity(transport, rho, T):
    """Shear viscosity eta(rho, T)."""


@generic
def conductivity(transport, rho, T):
    """Heat conductivity k(rho, T)."""


viscosity.of(ConstEta)(lambda transport, rho, T: transport.eta)
conductivity.of(ConstEta)(lambda transport, rho, T: transport.k)
viscosity.of(ConstNu)(lambda transport, rho, T: rho*transport.nu)
conductivity.of(ConstNu)(lambda transport, rho, T: rho*transport.cv*transport.kappa)
viscosity.of(PowerLaw)(lambda transport, rho, T: transport.eta*rho**transport.m*T**transport.n)
conductivity.of(PowerLaw)(lambda transport, rho, T: transport.k*rho**transport.m*T**transport.n)


def diffusivity(eos, law, rho, e):
    """The larger of kinematic viscosity nu and thermal diffusivity k/(rho de/dT) at (rho, e)."""
    T = temperature(eos, rho, e)
    slope = (temperature(eos, rho, e + 1e-6) - T)/1e-6
    return np.maximum(viscosity(law, rho, T), conductivity(law, rho, T)*slope)/rho


def constant_viscosity(law: Any) -> bool:
    """True if the shear viscosity is the same in all states; unknown laws count as varying."""
    return isinstance(law, ConstEta)


@formula
def stress(eta, zeta, xx, xy, yx, yy):
    """(sxx, sxy, syy) of eta (grad v + grad v^T - I div v) + zeta I div v in 2D; `xy` is dv_y/dx."""
    div = (zeta - eta)*(xx + yy)
    return 2*eta*xx + div, eta*(xy + yx), 2*eta*yy + div


def stress_tensor(eta, zeta, grad: np.ndarray) -> np.ndarray:
    """Newtonian stress in any dimension, (..., d, d); grad[..., a, b] = d_a v_b; trace factor 2/d."""
    d = grad.shape[-1]
    div = np.trace(grad, axis1=-2, axis2=-1)[..., None, None]*np.eye(d)
    eta, zeta = (np.asarray(q)[..., None, None] for q in (eta, zeta))
    return eta*(grad + np.swapaxes(grad, -1, -2) - 2/d*div) + zeta*div
