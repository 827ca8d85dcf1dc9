"""The gas in py-pde in readable form: rates, heat through the volume, with py-pde's ghosts.

Slow twins of `continuum.pypde`: differences and means of neighbours alternate.
"""
import numpy as np

from continuum.fluid import conductivity, pressure, stress, temperature, viscosity
from continuum.pypde.gas import RHO, VX, VY, E, Gas, mx, my

# continuum.jit comes before everything that loads numba
# isort: split
from pde import get_backend

PERIODIC = {"x": "periodic"}


def volume_nusselt(gas: Gas, data: np.ndarray) -> float:
    """Nusselt number on average over the volume."""
    flux, scene = energy_flux(gas, data).mean(axis=0), gas.scene
    return float(np.trapezoid(flux))/gas.rows*scene.L/(scene.k*scene.dT)


def padded(gas: Gas, data: np.ndarray) -> np.ndarray:
    """(rho, v_x, v_y, e, T), each (columns+2, rows+2), with ghosts of py-pde."""
    scene, torus = gas.scene, gas.loop.box.torus
    full = np.empty((5, *(n + 2 for n in gas.grid.shape)))
    extrapolated, rest, still = {"curvature": 0}, {"value": 0}, {"virtual_point": 0}
    plates = ((extrapolated, extrapolated), (rest, rest), (still, still), (extrapolated, extrapolated),
              ({"value": scene.T_hot}, {"value": scene.T_cold}))
    T = temperature(scene.eos, data[RHO], data[E])
    for f, ghosts, (bottom, top) in zip((*data, T), full, plates):
        across = {"y": "periodic"} if torus else {"y-": bottom, "y+": top}
        pad = get_backend("numpy").make_full_data_setter(gas.grid.get_boundary_conditions(PERIODIC | across))
        pad(ghosts, f)
    full[:, [0, -1]] = full[:, [-2, 1]]     # py-pde leaves the corners as they were
    return full


def differences(gas: Gas) -> tuple:
    """Differences of neighbours in x and in y, between them."""
    return lambda f: (f[1:] - f[:-1])/gas.h, lambda f: (f[:, 1:] - f[:, :-1])/gas.h


def rate(gas: Gas, data: np.ndarray) -> np.ndarray:
    """d(data)/dt."""
    rho, u, v, e, T = padded(gas, data)
    (dx, dy), eos, law = differences(gas), gas.scene.eos, gas.scene.law
    P = pressure(eos, rho, e)[1:, 1:]
    eta, k = viscosity(law, rho, T)*np.ones_like(T), conductivity(law, rho, T)*np.ones_like(T)
    slope, strain = dx(v)[:, :-1], dy(u)[:-1]
    sxx, _, syy = stress(eta[1:, 1:], 0.0, dx(u)[:, 1:], 0, 0, dy(v)[1:])
    sxy = mx(my(eta))*(slope + strain)
    work = ((sxx - P)*dx(u)[:, 1:] + (syy - P)*dy(v)[1:])[:-1, :-1] + mx(my(sxy*(slope + strain)))
    minus_div_q = dx(mx(k)*dx(T))[:, 1:-1] + dy(my(k)*dy(T))[1:-1]
    out = np.empty_like(data)
    out[RHO] = -dx(mx(rho)*u[:-1])[:, 1:-1] - dy(my(rho)*v[:, :-1])[1:-1]
    out[VX] = ((dx(sxx - P)[:, :-1] + dy(sxy)[1:])/mx(rho)[1:, 1:-1]
               - mx(mx(u)*dx(u))[:, 1:-1] - my(mx(v)[:, :-1]*strain)[1:])
    out[VY] = ((dy(syy - P)[:-1] + dx(sxy)[:, 1:])/my(rho)[1:-1, 1:]
               - my(my(v)*dy(v))[1:-1] - mx(my(u)[:-1]*slope)[:, 1:] - gas.scene.g)
    if not gas.loop.box.torus:
        out[VY, :, -1] = 0
    out[E] = (work + minus_div_q)/rho[1:-1, 1:-1] - mx(u[:-1]*dx(e))[:, 1:-1] - my(v[:, :-1]*dy(e))[1:-1]
    return out


def energy_flux(gas: Gas, data: np.ndarray) -> np.ndarray:
    """Upward flux of energy at the points of v_y: rho v_y (e + P/rho + v^2/2) - (sigma.v)_y - k dT/dy.

    Between periodic sides its mean over x is the same at every y when steady: no mass crosses any level.
    """
    rho, u, v, e, T = padded(gas, data)
    (dx, dy), eos, law, up = differences(gas), gas.scene.eos, gas.scene.law, v[1:-1, :-1]
    eta, k = viscosity(law, rho, T)*np.ones_like(T), conductivity(law, rho, T)*np.ones_like(T)
    v2 = mx(my(u))[:-1]**2 + up**2
    carried = up*(my(rho*e + pressure(eos, rho, e)) + 0.5*my(rho)*np.pad(v2, ((1, 1), (0, 0))))[1:-1]
    sxy = mx(my(eta))*(dx(v)[:, :-1] + dy(u)[:-1])
    _, _, syy = stress(eta[1:, 1:], 0.0, dx(u)[:, 1:], 0, 0, dy(v)[1:])
    dragged = mx(sxy*my(u)[:-1]) + up*np.pad(my(syy)[:-1], ((0, 0), (1, 0)))
    return carried - dragged - (my(k)*dy(T))[1:-1]
