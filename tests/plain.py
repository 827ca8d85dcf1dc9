"""The slow readable twin of `particles`: KHP95's sums as numpy double sums, without lists or cells.

It shares only the NamedTuples that describe a scene with particles/; every formula here is written a second
time, weights as they are printed, walls as images of all particles, one by one.
"""
from typing import Any, NamedTuple

import numpy as np
from plain_meshless import FACES, everywhere, nearing
from plain_weights import PRINTED

from continuum.fluid import conductivity, energy, pressure, temperature, viscosity
from particles.smooth.corrected import AllCorrected, Corrected, Reversed, Symmetrised
from particles.smooth.meshless import AdiabaticMfm, Crksph, Mfm
from particles.smooth.riemann import LowDissipationSums
from particles.smooth.spam import Spam
from particles.smooth.sums import Direct, Nested
from particles.terms import ArithmeticGradients
from particles.walls.fixed import FixedRows
from particles.walls.mirror import Mirror, Odd
from particles.walls.periodic import Shift

# --- points: particles, fixed particles, images -----------------------------------------------------------


class Image(NamedTuple):
    wall: Any
    of: int


class Points(NamedTuple):
    """All points; made[i] is None for a row (particle or fixed particle), else an Image. v is (points, 2)."""
    x: np.ndarray
    made: list
    v: np.ndarray
    T: np.ndarray
    rho: np.ndarray
    P: np.ndarray  # less the static part
    rows: int


def fixed(wall, box):
    """(x, y, T) of the particles of fixed rows behind a plate."""
    found = []
    if isinstance(wall, FixedRows):
        for row in range(6):
            y = wall.at - wall.inner*(row + 0.5)
            for column in range(round(box[0])):
                found.append((-box[0]/2 + (column + 0.5)*box[0]/round(box[0]), y,
                              wall.T + wall.slope*(y - wall.at)))
    return found


def images(method: Spam, x: np.ndarray):
    """Positions (points, 2) with all images that can be within range, and how each was made."""
    x, made = [tuple(p) for p in x], [None]*len(x)
    for wall in method.walls:
        if isinstance(wall, FixedRows):
            continue
        for p in range(len(x)):
            if isinstance(wall, Shift) and shifted(p, wall.axis, made):
                continue
            image = list(x[p])
            place = image[wall.axis]
            image[wall.axis] = place + wall.by if isinstance(wall, Shift) else 2*wall.at - place
            if abs(image[wall.axis]) <= method.box[wall.axis]/2 + 1.01*method.weight.h:
                x.append(tuple(image))
                made.append(Image(wall, p))
    return np.array(x), made


def shifted(p: int, axis: int, made: list) -> bool:
    """True if point p is already a periodic image along that axis."""
    while made[p] is not None:
        if isinstance(made[p].wall, Shift) and made[p].wall.axis == axis:
            return True
        p = made[p].of
    return False


def static_pressure(method: Spam, y):
    """The part of the pressure that is left out."""
    return method.static.fraction*(method.static.P0 - method.static.rho0*method.g*y)


def points(method: Spam, state: np.ndarray) -> Points:
    """Positions, velocities, temperatures, densities and pressures of everything."""
    n = state.shape[1]
    held = [p for wall in method.walls for p in fixed(wall, method.box)]
    x, made = images(method, np.array([*state[:2].T, *((p[0], p[1]) for p in held)]))
    rows = n + len(held)
    v, T, rho, P = np.zeros((len(x), 2)), np.zeros(len(x)), np.zeros(len(x)), np.zeros(len(x))
    w, _ = pairs(method, x, rows)
    rho[:rows] = method.m*w.sum(axis=1)
    if len(state) > 5:
        rho[:n] = state[5]
    v[:n], T[n:rows] = state[2:4].T, [p[2] for p in held]
    e = np.append(state[4], energy(method.eos, rho[n:rows], T[n:rows]))
    T[:n] = temperature(method.eos, rho[:n], e[:n])
    P[:rows] = pressure(method.eos, rho[:rows], e) - static_pressure(method, x[:rows, 1])
    for i, image in enumerate(made):
        if image is not None:
            rho[i] = rho[image.of]
            v[i], T[i] = motion(image, x[i], v[image.of], T[image.of])
            P[i] = P[image.of]
            if isinstance(image.wall, Mirror) and image.wall.own_pressure:
                P[i] = pressure(method.eos, rho[i],
                                energy(method.eos, rho[i], T[i])) - static_pressure(method, x[i, 1])
    return Points(x, made, v, T, rho, P, rows)


def motion(image: Image, x, v, T):
    """Velocity and temperature of the image at x of a point with v and T."""
    wall = image.wall
    if isinstance(wall, Shift):
        return v, T
    wall_T = wall.T + wall.slope*x[1 - wall.axis]
    return (-v, 2*wall_T - T) if isinstance(wall.rule, Odd) else (np.zeros(2), wall_T)


def pairs(method: Spam, x: np.ndarray, rows: int):
    """w_ij (rows, points) and its gradient with respect to r_i (rows, points, 2)."""
    d = x[:rows, None, :] - x[None, :, :]
    r = np.sqrt((d**2).sum(axis=2))
    w, slope = PRINTED[type(method.weight)](r, method.weight.h)
    inside = r < method.weight.h
    return np.where(inside, w, 0), np.where(inside, slope/np.where(r > 0, r, 1), 0)[:, :, None]*d


# --- the three sums -----------------------------------------------------------------------------------------


class Rates(NamedTuple):
    """rho (rows,), grad_v[i, a, b] = d_a v_b, grad_T[i, a] (rows, ...), d(x, y, vx, vy, e)/dt (5, n)."""
    rho: np.ndarray
    grad_v: np.ndarray
    grad_T: np.ndarray
    out: np.ndarray


def rates(method: Spam, state: np.ndarray) -> Rates:
    """All three sums of KHP95, Sec. II, or of the variants that the method names."""
    p, n = points(method, state), state.shape[1]
    _, grad_w = pairs(method, p.x, p.rows)
    grad_v, grad_T = (corrected_gradients if method.transport in AREAS else gradients)(method, p, grad_w)
    exchange = {Nested: nested, Direct: direct, LowDissipationSums: direct}.get(method.transport, corrected)
    a, heat = exchange(method, p, grad_w[:n], grad_v, grad_T)
    rho = p.rho[:n]
    a[:, 1] -= method.g*(1 - method.static.fraction*method.static.rho0/rho)
    heat -= static_pressure(method, state[1])/rho*np.trace(grad_v[:n], axis1=1, axis2=2)
    return Rates(p.rho[:p.rows], grad_v, grad_T, np.array([*state[2:4], *a.T, heat]))


def gradients(method: Spam, p: Points, grad_w):
    """(grad v)_i = sum_j m (v_j - v_i)/rho_ij grad_i w_ij, likewise of T."""
    one, other = p.rho[:p.rows, None], p.rho[None, :]
    mean = (one + other)/2 if isinstance(method.gradients, ArithmeticGradients) else np.sqrt(one*other)
    dv, dT = p.v[None] - p.v[:p.rows, None], p.T[None] - p.T[:p.rows, None]
    return (method.m*np.einsum("ijb,ij,ija->iab", dv, 1/mean, grad_w),
            method.m*np.einsum("ij,ij,ija->ia", dT, 1/mean, grad_w))


def nested(method: Spam, p: Points, grad_w, grad_v, grad_T):
    """Acceleration and heating from P/rho^2 and Q/rho^2 of both partners."""
    n, eye = len(grad_w), np.eye(2)
    tensor, heat = np.zeros((len(p.x), 2, 2)), np.zeros((len(p.x), 2))
    for i in range(p.rows):
        eta, k = viscosity(method.law, p.rho[i], p.T[i]), conductivity(method.law, p.rho[i], p.T[i])
        stress = eta*(grad_v[i] + grad_v[i].T - eye*np.trace(grad_v[i]))
        tensor[i], heat[i] = (p.P[i]*eye - stress)/p.rho[i]**2, -k*grad_T[i]/p.rho[i]**2
    for i, image in enumerate(p.made):
        if image is not None:
            tensor[i] = tensor[image.of] + (p.P[i] - p.P[image.of])*eye/p.rho[i]**2
            heat[i] = heat[image.of]
    force = np.einsum("ijab,ijb->ija", tensor[:n, None] + tensor[None], grad_w)
    dv = p.v[None] - p.v[:n, None]
    conduction = np.einsum("ija,ija->i", heat[:n, None] + heat[None], grad_w)
    return -method.m*force.sum(axis=1), -method.m*(0.5*np.einsum("ija,ija->i", force, dv) + conduction)


def direct(method: Spam, p: Points, grad_w, grad_v, grad_T):
    """Pressure of both; viscosity and conduction from differences along the pair (Morris, Brookshaw)."""
    n, P = len(grad_w), p.P/p.rho**2
    eta, k = (np.array([f(method.law, rho, T) for rho, T in zip(p.rho, p.T)])
              for f in (viscosity, conductivity))
    d = p.x[:n, None] - p.x[None]
    r2 = (d**2).sum(axis=2)
    F = np.einsum("ija,ija->ij", d, grad_w)/np.where(r2 > 0, r2, 1)/p.rho[:n, None]/p.rho[None]
    dv, dT = p.v[:n, None] - p.v[None], p.T[:n, None] - p.T[None]
    pressed = P[:n, None] + P[None]
    if method.transport is LowDissipationSums:
        pressed = (p.P[:n, None] + p.P + nearing(method, p, dv, d))/p.rho[:n, None]/p.rho
    force = -pressed[:, :, None]*grad_w + ((eta[:n, None] + eta[None])*F)[:, :, None]*dv
    heat = -0.5*np.einsum("ija,ija->ij", force, dv) + (k[:n, None] + k[None])*F*dT
    return method.m*force.sum(axis=1), method.m*heat.sum(axis=1)


#: weights of B_i grad w and B_j grad w in A and C, and whether friction is corrected
AREAS = {Corrected: (1, 0, False), Reversed: (0, 1, False), Symmetrised: (0.5, 0.5, False),
         AllCorrected: (1, 0, True), Crksph: (1, 0, False), Mfm: (1, 0, False),
         AdiabaticMfm: (1, 0, False)}


def inverse(method: Spam, p: Points, grad_w):
    """B of the rows: the inverse of sum_j V_j (x_j - x_i) grad_i w."""
    return np.linalg.inv(np.einsum("j,ija,ijb->iab", method.m/p.rho, p.x[None] - p.x[:p.rows, None], grad_w))


def corrected_gradients(method: Spam, p: Points, grad_w):
    """B_i sum_j V_j (f_j - f_i) grad_i w_ij, of v and T."""
    B, V = inverse(method, p, grad_w), method.m/p.rho
    dv, dT = (q[None] - q[:p.rows, None] for q in (p.v, p.T))
    return (B@np.einsum("j,ija,ijb->iab", V, grad_w, dv),
            np.einsum("iab,ib->ia", B, np.einsum("j,ijb,ij->ib", V, grad_w, dT)))


def corrected(method: Spam, p: Points, grad_w, grad_v, grad_T):
    """Pressure over A and C, made of gradients times B; friction along pairs, and tau of corrected slopes."""
    n, (a, c, in_friction) = len(grad_w), AREAS[method.transport]
    d, dv, dT = (q[None] - q[:n, None] for q in (p.x, p.v, p.T))
    B, slope = everywhere(p, inverse(method, p, grad_w), 2), everywhere(p, grad_v, 1, True)
    eta, k = (np.array([f(method.law, rho, T) for rho, T in zip(p.rho, p.T)])
              for f in (viscosity, conductivity))
    div = np.trace(slope, axis1=1, axis2=2)[:, None, None]
    tau = eta[:, None, None]*(np.swapaxes(slope, 1, 2) - div*np.eye(2))
    f = 1/p.rho[:n, None]/p.rho[None]
    own, other = np.einsum("ij,iab,ijb->ija", f, B[:n], grad_w), np.einsum("ij,jab,ijb->ija", f, B, grad_w)
    A, C = a*own + c*other, c*own + a*other
    pressed = p.P[:n, None, None]*A + p.P[None, :, None]*C
    work = -p.P[:n, None]*(A*dv).sum(axis=2)
    if method.transport in FACES:
        A, pressed, work = FACES[method.transport](method, p, pairs(method, p.x, n)[0], grad_w)
        C = A
    r2, halves = (d**2).sum(axis=2), np.trace(B, axis1=1, axis2=2)/2
    F = f*np.einsum("ija,ija->ij", d, grad_w)/np.where(r2 > 0, r2, 1)
    F *= (halves[:n, None] + halves[None])/2 if in_friction else 1
    rub = ((eta[:n, None] + eta[None])*F)[:, :, None]*dv
    rub += np.einsum("ija,ijab->ijb", (A + C)/2, tau[:n, None] + tau[None])
    work = work + 0.5*(rub*dv).sum(axis=2)
    return method.m*(rub - pressed).sum(axis=1), method.m*(work + (k[:n, None] + k[None])*F*dT).sum(axis=1)
