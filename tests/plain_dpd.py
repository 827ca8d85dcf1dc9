"""The slow readable twin of dissipative particles: all pairs, nearest images, numpy."""
import numpy as np

from particles.noise import uniform_of_pair


def apart(x: np.ndarray, box: np.ndarray, slid: float = 0.0) -> np.ndarray:
    """r_i - r_j by the nearest image (d, n, n), images above having slid along x; how many boxes lie between (n, n)."""
    d = x[:, :, None] - x[:, None, :]
    over = np.round(d[1]/box[1])
    d[0] -= over*slid
    return d - box[:, None, None]*np.round(d/box[:, None, None]), over


def forces(method, x: np.ndarray, v: np.ndarray, dt: float, step: int, slid: float = 0.0) -> np.ndarray:
    """Forces (d, n) of Groot & Warren [1997]."""
    n, box = x.shape[1], np.array(method.box)
    d, over = apart(x, box, slid)
    u = v[:, :, None] - v[:, None, :]
    u[0] -= over*method.rate*box[1]
    r = np.sqrt((d**2).sum(axis=0)) + np.eye(n)*2*method.rc
    w = np.maximum(1 - r/method.rc, 0)
    zeta = np.array([[uniform_of_pair(method.noise.seed, step, i, j) for j in range(n)] for i in range(n)])
    along = (d*u).sum(axis=0)/r
    size = method.a*w - method.gamma*w**2*along + np.sqrt(2*method.gamma*method.kT/dt)*w*zeta
    return (size*d/r).sum(axis=2)
