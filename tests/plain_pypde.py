"""The equations of py-pde in readable form: rates, heat through the volume, with its operators and ghosts.

Slow twins of `continuum.pypde`: differences and means of neighbours alternate.
"""
import numpy as np

from continuum.fluid import conductivity, pressure, stress, temperature, viscosity
from continuum.pypde.boussinesq import Boussinesq
from continuum.pypde.gas import RHO, VX, VY, E, Gas, mx, my

# continuum.jit comes before everything that loads numba
# isort: split
from pde import ScalarField, VectorField, get_backend

PERIODIC = {"x": "periodic"}


def rate(equation, data: np.ndarray) -> np.ndarray:
    """d(data)/dt."""
    return (of_gas if isinstance(equation, Gas) else of_layer)(equation, data)


def volume_nusselt(equation, data: np.ndarray) -> float:
    """Nusselt number on average over the volume."""
    if isinstance(equation, Gas):
        flux, scene = energy_flux(equation, data).mean(axis=0), equation.scene
        return float(np.trapezoid(flux))/equation.rows*scene.L/(scene.k*scene.dT)
    _, T, psi = equation.padded(data)
    v = (psi[:-2] - psi[2:])/(2*equation.h)
    return 1 + float(np.mean(v*T[1:-1], axis=0).sum())*equation.h/equation.kappa


# --- the gas ----------------------------------------------------------------------------------------------


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


def of_gas(gas: Gas, data: np.ndarray) -> np.ndarray:
    """The rates of the gas."""
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


# --- the layer --------------------------------------------------------------------------------------------


def of_layer(layer: Boussinesq, data: np.ndarray) -> np.ndarray:
    """With py-pde's operators; the vorticity's ghosts are Thom's, -2 psi/h^2 on the plates."""
    def thom(full, args=None):
        full[1:-1, 0], full[1:-1, -1] = -2*args[:, 0]/layer.h**2, -2*args[:, -1]/layer.h**2
        full[0], full[-1] = full[-2], full[1]
    psi_bc = PERIODIC | {"y": {"virtual_point": 0}}
    T_bc = PERIODIC | {"y-": {"virtual_point": 0.5}, "y+": {"virtual_point": -0.5}}
    omega, T = layer.state(data)
    psi = ScalarField(layer.grid, layer.streamfunction(omega.data))
    grad_psi, grad_T = psi.gradient(psi_bc), T.gradient(T_bc)
    u = VectorField.from_scalars([grad_psi[1], -grad_psi[0]])
    advected = u.dot(omega.gradient(thom, args=psi.data))
    spread = layer.nu*omega.laplace(thom, args=psi.data)
    return np.array([(spread - advected + grad_T[0]).data,
                     (layer.kappa*T.laplace(T_bc) - u.dot(grad_T)).data])
