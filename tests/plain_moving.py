"""Slow, readable twin of `closed_faces`: faces as entries of dense matrices, closed to round-off."""
import numpy as np

from continuum.fluid import conductivity, constant_viscosity, pressure, sound_speed, temperature, viscosity
from particles.integral.closed_faces import EXCHANGED
from particles.integral.transposed_stress import MENDED
from particles.weights import value_and_slope


def ghosts(x, y, box, T_plates):
    """Places of points and images; of each its origin, its turn (-1 behind plates), T of the plate.

    All is periodic in x. Plates are at y = -+ height/2; without their temperatures y is periodic, too.
    """
    (width, height), which, ones = box, np.arange(len(x)), np.ones(len(x))
    found = [(x, y, which, ones, 0*ones)]
    for side in (-1, 1):
        if T_plates is None:
            found.append((x, y + side*height, which, ones, 0*ones))
        else:
            found.append((x, side*height - y, which, -ones, T_plates[(side + 1)//2]*ones))
    found += [(gx + by, *rest) for gx, *rest in found for by in (-width, width)]
    return [np.concatenate(q) for q in zip(*found, strict=True)]


def faces(method, T_plates, state):
    """S, k, x_ij (n, all, ...), the pull to even spacing (n, 2), the count of points by w (n,), images."""
    n, V = state.shape[1], state[7]
    gx, gy, origin, turn, T = ghosts(state[0], state[1], method.box, T_plates)
    apart = np.stack([gx[None] - state[0][:, None], gy[None] - state[1][:, None]], axis=2)
    r = np.sqrt((apart**2).sum(axis=2))
    near = (r < method.weight.h) & (r > 0)
    w, f = np.zeros((2, n, len(gx)))
    for i, j in np.argwhere(near):
        w[i, j], f[i, j] = value_and_slope(method.weight, r[i, j])
    F = -f                                  # value_and_slope gives w'/r
    Vg = V[origin]
    pull = (Vg[None, :, None]*F[:, :, None]*apart).sum(axis=1)
    count = w.sum(axis=1) + value_and_slope(method.weight, 0.0)[0]
    moment = np.einsum("j,ij,ija,ijb->iab", Vg, F, apart, apart)
    B, s = np.linalg.inv(moment), 2/np.einsum("iaa->i", moment)
    R = np.stack([np.ones(len(turn)), turn], axis=1)
    Bg = B[origin]*R[:, :, None]*R[:, None, :]
    VV = V[:, None]*Vg[None]
    S = VV[:, :, None]*F[:, :, None]*np.einsum("ijab,ijb->ija", B[:, None] + Bg[None], apart)
    k = VV*F*(s[:, None] + s[origin][None])
    return S, k, apart, pull, count, (origin, turn, T, R)


def closed(S, k, apart, V, origin, R):
    """Faces that close and are exact on linear fields, changed least: dense least squares over phi, psi."""
    n = len(V)
    out = S.copy()
    for a in (0, 1):
        # phi, psi_x, psi_y
        sign = {0: np.stack([np.ones_like(R[:, 1]), np.ones_like(R[:, 1]), R[:, 1]], axis=1),
                1: np.stack([R[:, 1], R[:, 1], np.ones_like(R[:, 1])], axis=1)}[a]
        basis = np.zeros((n, len(origin), 3*n))         # what each unknown adds to each face
        for i in range(n):
            for g, o in enumerate(origin):
                if k[i, g]:
                    basis[i, g, 3*o] += k[i, g]*sign[g, 0]
                    basis[i, g, 3*i] -= k[i, g]
                    for b in (0, 1):
                        basis[i, g, 3*o + 1 + b] += k[i, g]*apart[i, g, b]*sign[g, 1 + b]
                        basis[i, g, 3*i + 1 + b] += k[i, g]*apart[i, g, b]
        rows = np.concatenate([basis.sum(axis=1),
                               *(np.einsum("ig,igu->iu", apart[:, :, b], basis) for b in (0, 1))])
        missing = np.concatenate([-S[:, :, a].sum(axis=1),
                                  *(2*V*(a == b) - (S[:, :, a]*apart[:, :, b]).sum(axis=1) for b in (0, 1))])
        out[:, :, a] += basis@np.linalg.lstsq(rows, missing, rcond=1e-12)[0]
    return out


def rates(method, state, S, k, apart, shift, count, images):
    """d/dt of momentum, mass, volume, energy (5, n)."""
    chosen, (origin, turn, T_plate, R) = method.ingredients, images
    px, py, m, V, E = state[EXCHANGED]
    v, rho = np.stack([px, py], axis=1)/m[:, None], m/V
    e = E/m - (v**2).sum(axis=1)/2
    T, P, c = (of(method.eos, rho, e) for of in (temperature, pressure, sound_speed))
    held = -method.g*state[1]
    P0 = (V*(P - held)).sum()/V.sum()
    P = P - held - P0
    eta, kappa = (of(method.law, rho, T)*np.ones_like(T) for of in (viscosity, conductivity))

    def both(q):
        """The sum of both ends."""
        return q[:, None] + q[origin][None]

    def mirrored(q):
        """The sum of vectors at both ends."""
        return q[:, None] + (q[origin]*R)[None]

    def step(q):
        return q[origin][None] - q[:, None]
    slip, friction = v[origin]*R, v[origin]*turn[:, None]
    Td = np.where(turn < 0, 2*T_plate - T[origin], T[origin])
    half, du = S/2, friction[None] - v[:, None]
    grad_v = np.einsum("ija,ijb->iab", half, du)/V[:, None, None]
    grad_P = np.einsum("ija,ij->ia", half, step(P))/V[:, None]
    mended = chosen.transport == MENDED
    F = mended*eta[:, None]*np.stack([v[:, 1]*grad_v[:, 1, 0] - v[:, 0]*grad_v[:, 1, 1],
                                      v[:, 0]*grad_v[:, 0, 1] - v[:, 1]*grad_v[:, 0, 0]], axis=1)
    varies = mended and not constant_viscosity(method.law)
    tau = varies*eta[:, None, None]*np.stack(
        [[-grad_v[:, 1, 1], grad_v[:, 1, 0]], [grad_v[:, 0, 1], -grad_v[:, 0, 0]]]).transpose(2, 0, 1)
    adjoint = np.stack([turn, np.ones_like(turn)], axis=1)[:, :, None]
    left = (half*mirrored(shift)).sum(axis=2) + chosen.follow*k*step(V*count)
    linear = 0.5*chosen.smooth*(apart*mirrored(grad_P)).sum(axis=2)
    mass = left*both(rho)/2 + chosen.spread/4*both(1/c)*k*(step(P) - linear)
    to_i, to_j = np.einsum("ija,ia->ij", half, v), np.einsum("ija,ja->ij", half, slip)
    force = 0.5*(both(eta)*k)[:, :, None]*du - half*both(P)[:, :, None]
    force += 0.5*mass[:, :, None]*(v[:, None] + slip[None])
    force += np.einsum("ija,ijab->ijb", half, tau[:, None] + (adjoint*tau[origin])[None])
    work = 0.25*both(eta)*k*(du*(friction[None] + v[:, None])).sum(axis=2)
    work += 0.5*both(kappa)*k*(Td[None] - T[:, None]) + (half*mirrored(F)).sum(axis=2)
    work += 0.5*mass*(both(e) + np.einsum("ia,ja->ij", v, slip)) - P[:, None]*to_j - P[origin][None]*to_i
    flow, weight = (to_i + to_j).sum(axis=1), method.g*(m - V)
    p = force.sum(axis=1)
    return np.stack([p[:, 0], p[:, 1] - weight, mass.sum(axis=1), flow + left.sum(axis=1),
                     work.sum(axis=1) - (P0 + held)*flow - weight*v[:, 1]])


def shift(method, state, pull):
    """Velocity of points towards even spacing, at most 0.3 of the fastest flow."""
    found = -method.ingredients.shift*pull
    most = 0.3*np.sqrt(((state[4]**2 + state[5]**2)/state[6]**2).max())
    return found*np.minimum(1, most/np.maximum(np.hypot(*found.T), 1e-300))[:, None]
