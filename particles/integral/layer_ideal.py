"""Loops of `layer` for an ideal gas with constant coefficients, transport along edges, corrected heating.

There P_ij = rho_i T_j: brackets of Eqs 34-36 and 51 consist of a point's own fields and linear sums over
its neighbours, such as sum_j S.(rho_i v_j + rho_j v_i) = rho_i sum_j S.v_j + v_i.sum_j S rho_j. Vector
instructions compute several of these at a time. Sums take differences, sum_j S (f_j - f_i), which keep the
conservation of edges. Results equal `layer` to round-off. Arrays are passed as plain tuples (a NamedTuple
costs a microsecond each); rows are summed in blocks whose sums stay in the fastest cache.
"""
import numpy as np

from continuum.fluid import IdealGas, temperature
from continuum.jit import jit, jit_records
from particles.neighbours import u64
from particles.pairs import Block, Stored, pair_term, sweep

#: fields of a neighbour, two vectors of four: S takes all but w, k takes u, v and w = eta |v|^2/2 + kappa T
Given = np.dtype([(name, "f8") for name in ("rho", "mx", "my", "eps", "T", "u", "v", "w")])
Lack = np.dtype([("Fx", "f8"), ("Fy", "f8")])
ROWS = 32           # per block


@pair_term(20)
def ProductSums(term, a, b, ab):
    """Sums of S_x, S_y and k times differences of fields; S w and k T only fill up vectors."""
    x, y, k = ab.sx, ab.sy, ab.k
    rho, mx, my, eps = b.rho - a.rho, b.mx - a.mx, b.my - a.my, b.eps - a.eps
    T, u, v, w = b.T - a.T, b.u - a.u, b.v - a.v, b.w - a.w
    return (x*rho, x*mx, x*my, x*eps, x*T, x*u, x*v, x*w, y*rho, y*mx, y*my, y*eps, y*T, y*u, y*v, y*w, k*T,
            k*u, k*v, k*w)


@pair_term(1)
def LackSums(term, a, b, ab):
    """Sum of S.(F_b - F_a)/2, the correction of heating."""
    return (ab.sx*(b.Fx - a.Fx) + ab.sy*(b.Fy - a.Fy),)


@jit_records
def give(first, last, state, parent, twice_T, gas, given):
    """Fields of points, then of images: those of the parent but with -my, -v, and 2 T_w - T in w."""
    n, kappa = u64(state.shape[1]), gas[2]
    for i in range(u64(first), min(u64(last), n)):
        _read(state, i, gas, given[i])
    for i in range(max(u64(first), n), u64(last)):
        b, m = given[i], i - n
        _read(state, u64(parent[m]), gas, b)
        b.my, b.u, b.v, b.w = -b.my, -b.u, -b.v, b.w + kappa*(twice_T[m] - 2*b.T)


@jit
def _read(state, i, gas, a):
    rho, mx, my, eps = state[0, i], state[1, i], state[2, i], state[3, i]
    cv, eta, kappa = gas
    per_rho = 1/rho
    u, v = per_rho*mx, per_rho*my
    q = 0.5*(u*u + v*v)
    T = temperature(IdealGas(cv), rho, per_rho*eps - q)
    a.rho, a.mx, a.my, a.eps = rho, mx, my, eps
    a.T, a.u, a.v, a.w = T, u, v, eta*q + kappa*T


@jit_records
def exchange(first, last, given, edges, open, per_V, gas, g, lack, out):
    """Rates without the correction of heating, and its F."""
    pairs, sums = Stored(*edges), np.empty((ROWS, 20))
    for begin in range(u64(first), u64(last), u64(ROWS)):
        end = min(begin + u64(ROWS), u64(last))
        sweep(begin, end, ProductSums(), given, pairs, Block(begin, sums))
        for i in range(begin, end):
            _products(i, given[i], sums[i - begin], open, per_V[i], gas[1], g, lack[i], out)


@jit
def _products(i, a, s, open, f, eta, g, lack, out):
    """Rates from sums of differences, and from own fields where edges do not close; F from slopes."""
    u, v, rho, T, sx, sy = a.u, a.v, a.rho, a.T, open[i, 0], open[i, 1]
    lack.Fx, lack.Fy = eta*f*(v*s[13] - u*s[14]), eta*f*(u*s[6] - v*s[5])
    flow = s[5] + s[14] + sx*u + sy*v                               # S.v
    Px, Py = rho*(s[4] + T*sx), rho*(s[12] + T*sy)                  # sum S P_ij, of the point's own density
    mass = rho*flow + u*s[0] + v*s[8]
    px = a.mx*flow + u*s[1] + v*s[9] + Px + T*s[0]
    py = a.my*flow + u*s[2] + v*s[10] + Py + T*s[8]
    through = a.eps*flow + u*s[3] + v*s[11] + u*Px + v*Py + T*(s[1] + s[10])
    out[0, i] = -f*mass
    out[1, i], out[2, i] = f*(eta*s[17] - px), f*(eta*s[18] - py) - g*rho
    out[3, i] = f*(s[19] - through) - g*a.my


@jit
def plates(beyond, parent, given, per_V, lack, out):
    """Correct images for convection and pressure: slip, hydrostatics; F is even along a plate, odd across."""
    rows, image, sx, sy, weight = beyond
    for k in range(len(rows)):
        i = rows[k]
        a, b, f = given[i], given[image[k]], per_V[i]
        flow, hydro = -2*sx[k]*b.u, weight[k]*b.rho
        hx, hy = sx[k]*hydro, sy[k]*hydro
        out[0, i] -= f*a.rho*flow
        out[1, i] -= f*(a.mx*flow + hx)
        out[2, i] -= f*(a.my*flow + hy)
        out[3, i] -= f*(a.eps*flow + a.u*hx + a.v*hy)
    n = len(given) - len(parent)
    for m in range(len(parent)):
        lack[n + m].Fx, lack[n + m].Fy = lack[parent[m]].Fx, -lack[parent[m]].Fy


@jit_records
def heat(first, last, lack, edges, open, per_V, out):
    pairs, lost = Stored(*edges), np.empty((ROWS, 1))
    for begin in range(u64(first), u64(last), u64(ROWS)):
        end = min(begin + u64(ROWS), u64(last))
        sweep(begin, end, LackSums(), lack, pairs, Block(begin, lost))
        for i in range(begin, end):
            out[3, i] += per_V[i]*(lost[i - begin, 0] + open[i, 0]*lack[i].Fx + open[i, 1]*lack[i].Fy)
