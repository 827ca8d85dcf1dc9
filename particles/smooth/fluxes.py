"""Records of the third sum, stress and heat flux of particles and images; what its pairs give    [KHP95]"""
import numpy as np

from continuum.fluid import conductivity, stress, viscosity
from continuum.jit import formula, jit
from particles.walls import image_flux

#: of P/rho^2, h = Q/rho^2 + v.P/2rho^2, v: one cache line
Flux = np.dtype([(name, "f8") for name in ("xx", "xy", "hx", "vx", "one", "yy", "hy", "vy")])


@jit
def fluxes(first, last, law, rho, vx, vy, T, less, slopes, flux):
    """P/rho^2 and Q/rho^2 with P = (P - static) I - stress, Q = -k grad T."""
    for i in range(first, last):
        xx, yx, Tx, _, xy, yy, Ty, _ = slopes[i]  # xy: dvx/dy
        sxx, sxy, syy = stress(viscosity(law, rho[i], T[i]), 0.0, xx, yx, xy, yy)
        k, f, a = conductivity(law, rho[i], T[i]), 1/rho[i]**2, flux[i]
        a.vx, a.vy = vx[i], vy[i]
        a.xx, a.xy, a.yy = (less[i] - sxx)*f, -sxy*f, (less[i] - syy)*f
        wx, wy = _work(a)
        a.hx, a.hy = wx - k*Tx*f, wy - k*Ty*f


@formula
def _work(a):
    """v.P/2rho^2."""
    return 0.5*(a.vx*a.xx + a.vy*a.xy), 0.5*(a.vx*a.xy + a.vy*a.yy)


@jit
def image_fluxes(first, last, wall, parent, rho, vx, vy, less, flux):
    """Stress and heat flux copied from the parents, pressure by the wall's rule    [KHP95, Sec. IV]"""
    for i in range(first, last):
        p = parent[i - first]
        a, b, f, (bx, by) = flux[i], flux[p], (less[i] - less[p])/rho[i]**2, _work(flux[p])
        a.vx, a.vy = vx[i], vy[i]
        xy, qx, qy = image_flux(wall, b.xy, b.hx - bx, b.hy - by, rho[i])
        a.xx, a.xy, a.yy = b.xx + f, xy, b.yy + f
        wx, wy = _work(a)
        a.hx, a.hy = wx + qx, wy + qy


@jit
def closed(first, last, state, flux, pull, out):
    """Rates of particles from sums of what partners bring, times x 0:8 and y 8:16, and from their own."""
    for i in range(first, last):
        a, p, x, y = flux[i], pull[i], pull[i, 4], pull[i, 12]
        own_x, own_y, sent_x, sent_y = a.xx*x + a.xy*y, a.xy*x + a.yy*y, p[0] + p[9], p[1] + p[13]
        heat = a.hx*x + a.hy*y + p[2] + p[14] + 0.5*(a.xx*p[3] + a.xy*(p[7] + p[11]) + a.yy*p[15])
        work = a.vx*(own_x + 0.5*sent_x) + a.vy*(own_y + 0.5*sent_y)
        out[0, i], out[1, i] = state[2, i], state[3, i]
        out[2, i], out[3, i], out[4, i] = -own_x - sent_x, -own_y - sent_y, work - heat
