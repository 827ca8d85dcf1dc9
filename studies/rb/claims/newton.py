"""Accelerations of a snapshot by all three sums, and by the potential 2 P n^-2 w    [KHP95, Sec. VII]"""
from math import sqrt

import numpy as np
from scipy.spatial import cKDTree

from continuum.fluid import stress_tensor
from studies.build.read import particles, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.rb.claims.snapshots import snapshot
from studies.rb.claims.sums import RANGE, lucy


def accelerations(x: np.ndarray, v: np.ndarray, T: np.ndarray, eta: float,
                  width: float) -> tuple[np.ndarray, np.ndarray]:
    """(n, 2) each: -sum [(P/rho^2)_i + (P/rho^2)_j].grad w of the viscous ideal gas, and -sum 2 grad w (P = n = 1).

    Periodic in x, nothing beyond the plates: right from three ranges off them.
    """
    n, tall = len(x), 10*np.ptp(x[:, 1]) + 10*RANGE
    at = np.stack([np.mod(x[:, 0], width), x[:, 1] - x[:, 1].min()], axis=1)
    tree = cKDTree(at, boxsize=np.array([width, tall]))
    near = tree.sparse_distance_matrix(tree, RANGE, output_type="ndarray")
    i, j, (w, slope) = near["i"], near["j"], lucy(near["v"])
    d = at[i] - at[j]
    d[:, 0] -= width*np.round(d[:, 0]/width)
    grad, rho = slope[:, None]*d, np.bincount(i, w, n)

    def total(terms: np.ndarray) -> np.ndarray:
        flat = terms.reshape(len(i), -1)
        return np.stack([np.bincount(i, column, n) for column in flat.T], axis=1).reshape(n, *terms.shape[1:])

    grad_v = total(grad[:, :, None]*((v[j] - v[i])/np.sqrt(rho[i]*rho[j])[:, None])[:, None, :])
    P = ((rho*T)[:, None, None]*np.eye(2) - stress_tensor(eta, 0.0, grad_v))/rho[:, None, None]**2
    return -total(np.einsum("pab,pb->pa", P[i] + P[j], grad)), -total(2*grad)


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Of what two fields of vectors (n, 2) differ from their means: the mean upwards bears the weight of the fluid."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return float(np.sum(a*b)/sqrt(np.sum(a*a)*np.sum(b*b)))


def newtonian(tables: Tables) -> Measured:
    """Correlation of both accelerations at Ra 10 000, 5000 particles, within layers of twice the range of the weight.

    Particles in range of each other are not independent, so each layer is one sample.
    """
    point = particles(1e4)
    frame = select(tables, "particles", **point)
    if "T" not in frame:
        raise CannotTell("the table particles keeps no temperatures: accelerations need a column T")
    frame, at = frame[(frame["kind"] == "fluid") & (frame["seed"] == frame["seed"].min())], snapshot(tables, point)
    eta = at.height/sqrt(point["ra"])
    real, simple = accelerations(at.x[:at.n], at.v[:at.n], frame["T"].to_numpy(float), eta, 2*at.height)
    inner = at.height/2 - 3*RANGE
    layer = np.digitize(at.x[:at.n, 1], np.arange(-inner, inner + 1e-9, 2*RANGE))
    return combine([(correlation(real[layer == i], simple[layer == i]), 0.0) for i in range(1, layer.max())])
