"""What is measured on dissipative particles. Each function takes the pair sums and the state (3 d, n) = x, v, f."""
from typing import Any, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from particles.pairs import nothing, rate


class Static(NamedTuple):
    """Sums of the repulsion F in d dimensions: components, Laplacian of its potential, F.r, and (F less friction)_x y."""
    d: int
    stiffness: float        # a/rc


@rate.of(Static)
def _(term, a, b, ab):
    """U'' + (d - 1) U'/r = a/rc - (d - 1) f"""
    fx, fy, fz = ab.f*ab.dx, ab.f*ab.dy, ab.f*ab.dz
    friction = ab.g*(ab.dx*(a.vx - b.vx) + ab.dy*(a.vy - b.vy) + ab.dz*(a.vz - b.vz))
    return (fx, fy, fz, term.stiffness - (term.d - 1)*ab.f, fx*ab.dx + fy*ab.dy + fz*ab.dz, (ab.f - friction)*ab.dx*ab.dy)


nothing.of(Static)(lambda term: (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def static_sums(sums: Any, state: np.ndarray) -> np.ndarray:
    """(n, 6) of `Static`, once for all quantities of a record."""
    if sums.seen is None:
        sums.seen = sums.over_pairs(Static(sums.method.d, sums.method.a/sums.method.rc), state, 6)
    return sums.seen


def peculiar(sums: Any, state: np.ndarray) -> np.ndarray:
    """Velocities (d, n) less the shear."""
    d = sums.places
    v = state[d:2*d].copy()
    v[0] -= sums.method.rate*state[1]
    return v


def kinetic_temperature(sums: Any, state: np.ndarray) -> float:
    """kT of velocities: d (n - 1) of them are free, their sum is conserved."""
    v = peculiar(sums, state)
    return float((v**2).sum()/(len(v)*(v.shape[1] - 1)))


def configurational_temperature(sums: Any, state: np.ndarray) -> float:
    """kT of positions, <|grad U|^2>/<lap U>    [Rugh 1997; Butler et al. 1998]

    A mean over states is one of ratios, too high by about 1/n.
    """
    total = static_sums(sums, state)
    return float((total[:, :3]**2).sum()/total[:, 3].sum())


def pressure(sums: Any, state: np.ndarray) -> float:
    """P = [n kT + sum over pairs F.r/d]/V, kT that of the velocities."""
    n, d = sums.n, sums.places
    return float((n*kinetic_temperature(sums, state) + static_sums(sums, state)[:, 4].sum()/2/d)/sums.method.volume)


def shear_stress(sums: Any, state: np.ndarray) -> float:
    """Stress_xy, positive with the shear: -[sum v_x v_y + sum over pairs (F - friction)_x y]/V; of the noise the mean is zero."""
    v = peculiar(sums, state)
    return float(-(np.sum(v[0]*v[1]) + static_sums(sums, state)[:, 5].sum()/2)/sums.method.volume)


def momentum(sums: Any, state: np.ndarray) -> float:
    """Size of the mean velocity."""
    d = sums.places
    return float(np.abs(state[d:2*d].mean(axis=1)).max())


class Displacement:
    """Mean square distance of particles from where they were `records` records ago at most, then from there again.

    Positions are not wrapped, so that nothing has to be put together again.
    """

    def __init__(self, records: int):
        self.records, self.count = records, 0

    def __call__(self, sums: Any, state: np.ndarray) -> float:
        x = np.empty_like(state[:sums.places])
        x[:, sums.now.ids] = state[:sums.places]
        if self.count % self.records == 0:
            self.start = x
        self.count += 1
        return float(((x - self.start)**2).sum(axis=0).mean())


def waves(d: int, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Wave vectors (2 most + 1,)*d of whole numbers as |n|^2, and its values up to most^2 without zero."""
    axes = np.meshgrid(*[np.arange(-most, most + 1)]*d, indexing="ij")
    square = np.sum([q**2 for q in axes], axis=0)
    return square, np.unique(square[(square > 0) & (square <= most**2)])


class StructureFactor(NamedTuple):
    """S(k) = |sum exp(ik.x)|^2/n of a cube, mean over wave vectors of equal length, up to `most` waves in the box."""
    most: int

    def __call__(self, sums: Any, state: np.ndarray) -> np.ndarray:
        d, k = sums.places, 2*np.pi/sums.method.box[0]*np.arange(-self.most, self.most + 1)
        phases = [np.exp(1j*k[:, None]*q) for q in state[:d]]
        amplitude = np.einsum("ax,bx,cx->abc", *phases) if d == 3 else np.einsum("ax,bx->ab", *phases)
        square, values = waves(d, self.most)
        return np.array([np.mean(np.abs(amplitude[square == n2])**2) for n2 in values])/sums.n


class PairDistribution(NamedTuple):
    """g(r) in `bins` shells up to `reach`, at most half of the box, for `Plan.means`."""
    bins: int
    reach: float

    def __call__(self, sums: Any, state: np.ndarray) -> np.ndarray:
        method, d = sums.method, sums.places
        box = np.array(method.box)
        tree = cKDTree(np.mod(state[:d].T, box) % box, boxsize=box)
        edges = np.linspace(0, self.reach, self.bins + 1)
        counts = np.diff(tree.count_neighbors(tree, edges)).astype(float)      # each point with itself is in the first edge
        shells = {2: np.pi, 3: 4*np.pi/3}[d]*np.diff(edges**d)
        return counts/(sums.n*(sums.n - 1)/method.volume*shells)
