"""The slow twin of `particles.smooth.meshless` and `riemann`, for `plain`, with the papers' own formulas.

Each function gives S/2m^2 of pairs (n, points, 2), the force of their pressure over m^2, and its work.
"""
import numpy as np

from continuum.fluid import energy, sound_speed
from particles.smooth.meshless import AdiabaticMfm, Crksph, Mfm
from particles.walls.mirror import Mirror


def everywhere(p, rows, vector=0, slope_of_v=False):
    """Values of rows (n, ...) at all points; images mirror the first `vector` axes."""
    q = np.concatenate([rows, np.zeros((len(p.x) - len(rows), *rows.shape[1:]))])
    for i, image in enumerate(p.made):
        if image is not None:
            q[i] = q[image.of]
            if isinstance(image.wall, Mirror):
                R = np.where(np.arange(2) == image.wall.axis, -1.0, 1.0)
                for axis in range(vector):
                    q[i] = q[i]*R.reshape((2, *[1]*(q[i].ndim - axis - 1)))
                q[i] *= -1 if slope_of_v else 1
    return q


def crksph(method, p, w, grad_w):
    """Frontiere, Raskin & Owen 2017, their A, B and gradients one by one."""
    V, x, eye = method.m/p.rho, p.x[:len(w), None] - p.x[None], np.eye(2)
    m0, m1, m2 = (w@V, np.einsum("ij,j,ija->ia", w, V, x), np.einsum("ij,j,ija,ijb->iab", w, V, x, x))
    d0 = np.einsum("j,ijc->ic", V, grad_w)
    d1 = np.einsum("j,ija,ijc->iac", V, x, grad_w) + m0[:, None, None]*eye
    d2 = np.einsum("j,ija,ijb,ijc->iabc", V, x, x, grad_w)
    d2 += np.einsum("ia,bc->iabc", m1, eye) + np.einsum("ib,ac->iabc", m1, eye)
    inv = np.linalg.inv(m2)
    B, between = -np.einsum("iab,ib->ia", inv, m1), np.einsum("iab,ibdc,ide->iaec", inv, d2, inv)
    A = 1/(m0 - np.einsum("ia,iab,ib->i", m1, inv, m1))
    dA = -A[:, None]**2*(d0 + 2*np.einsum("ia,iac->ic", B, d1) + np.einsum("iabc,ia,ib->ic", between, m1, m1))
    dB = np.einsum("iabc,ib->iac", between, m1) - inv@d1
    A, B, dA, dB = (everywhere(p, q, q.ndim - 1) for q in (A, B, dA, dB))

    def grad(A, B, dA, dB, x, w, grad_w):
        f = 1 + (B*x).sum(axis=-1, keepdims=True)
        return A[..., None]*f*grad_w + w[..., None]*(dA*f + A[..., None]*(
            np.einsum("...ac,...a->...c", dB, x) + B))
    n = len(w)
    own = grad(A[:n, None], B[:n, None], dA[:n, None], dB[:n, None], x, w, grad_w)
    slopes = np.einsum("j,ijc,ija->iac", V, own, -x), np.einsum("j,ijc->ic", V, own)
    assert np.allclose(slopes[0], eye, atol=1e-12) and np.allclose(slopes[1], 0, atol=1e-12)    # exact
    S = (own - grad(A[None], B[None], dA[None], dB[None], -x, w, -grad_w))/2/p.rho[:n, None, None]
    S /= p.rho[None, :, None]
    P, dv = p.P[:, None], p.v[None] - p.v[:n, None]
    return S, (P[:n, None] + P[None])*S, -P[:n]*(S*dv).sum(axis=2)


def mfm(method, p, w, grad_w):
    """Hopkins 2015: Riemann problems between limited states, solved along characteristics."""
    n = len(w)
    x, q = p.x[None] - p.x[:n, None], np.column_stack([p.v, p.P])
    B = np.linalg.inv(np.einsum("ij,ija,ijb->iab", w, x, x))
    slope = B@np.einsum("ij,ija,ijk->iak", w, x, q[None] - q[:n, None])
    B = everywhere(p, B, 2)
    slope = np.concatenate([everywhere(p, slope[..., :2], 1, True), everywhere(p, slope[..., 2:], 1)], axis=2)
    S = np.einsum("ij,ijab,ijb->ija", w, (B/p.rho[:, None, None])[:n, None] + B/p.rho[:, None, None], x)
    S /= 2*method.m
    c = [sound_speed(method.eos, rho, energy(method.eos, rho, T)) for rho, T in zip(p.rho[:n], p.T)]
    Z = p.rho*everywhere(p, np.array(c))
    left = limited(q[:n, None], q[None], q[:n, None] + np.einsum("iak,ija->ijk", slope[:n], x)/2)
    right = limited(q[None], q[:n, None], q[None] - np.einsum("jak,ija->ijk", slope, x)/2)
    size = np.linalg.norm(S, axis=2)
    unit = S/np.where(size > 0, size, 1)[..., None]
    ul, ur = ((side[..., :2]*unit).sum(axis=2) for side in (left, right))
    star = (Z[:n, None]*ul + Z*ur + left[..., 2] - right[..., 2])/(Z[:n, None] + Z)
    P = left[..., 2] + Z[:n, None]*(ul - star)
    return S, 2*P[..., None]*S, 2*P*(np.einsum("ija,ia->ij", S, p.v[:n]) - size*star)


def adiabatic(method, p, w, grad_w):
    """Its force, whose work is shared in halves."""
    S, force, _ = mfm(method, p, w, grad_w)
    return S, force, (force*(p.v[:len(w), None] - p.v)).sum(axis=2)/2


def limited(own, other, value):
    """Value between own - d/2 and the mean + d/4, d = |own - other|, where own < other; else turned round."""
    mean, d = (own + other)/2, abs(own - other)
    up = own < other
    return np.clip(value, np.where(up, own - d/2, mean - d/4), np.where(up, mean + d/4, own + d/2))


def nearing(method, p, dv, d):
    """beta rho c u of pairs, x_i - x_j = d, v_i - v_j = dv    [Zhang, Hu & Adams 2017]"""
    n, r = len(d), np.linalg.norm(d, axis=2)
    u = -(d*dv).sum(axis=2)/np.where(r > 0, r, 1)
    c = np.array([sound_speed(method.eos, rho, energy(method.eos, rho, T)) for rho, T in zip(p.rho, p.T)])
    c, rho = (c[:n, None] + c)/2, (p.rho[:n, None] + p.rho)/2
    return np.minimum(3*np.maximum(u, 0)/c, 1)*rho*c*u


FACES = {Crksph: crksph, Mfm: mfm, AdiabaticMfm: adiabatic}
