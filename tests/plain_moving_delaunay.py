"""The steps of `moving_delaunay` in numpy, triangle by triangle: its slow twin.

A triangulation is a dictionary: the corner k on the left of each directed edge (i, j). An edge's S and k are
sums over the triangles on both sides, S_ij = R(x_k - (x_i + x_j)/2)/3 and cot_k/2 of each, so that all that
passes an edge is a sum over triangles, and sides are no special case.
"""
import numpy as np

from continuum.fluid import conductivity, diffusivity, pressure, temperature, viscosity
from particles.integral.carried import hold
from particles.integral.march import LATER, NEW, REAL
from particles.integral.rings import FLAT


def left_of(corner):
    """The dictionary of triangles (T, 3), counterclockwise."""
    return {(int(t[s - 2]), int(t[s - 1])): int(t[s]) for t in corner for s in range(3)}


def triangles_of(left):
    """Triangles (T, 3) of such a dictionary, each once."""
    return np.array(sorted({min((i, j, k), (j, k, i), (k, i, j)) for (i, j), k in left.items()}))


class Plain:
    """A method's points and triangles in time."""

    def __init__(self, method, corner):
        self.method, self.left, self.flips = method, left_of(corner), 0
        self.free = np.ones(len(method.x))
        self.free[method.held.which] = 0.0

    def apart(self, x, i, j):
        """x_j - x_i (2, ...) by the nearest image."""
        d, rings = (x[:, j] - x[:, i]).T, self.method.rings
        return (d - rings.size*np.rint(d*rings.per)).T

    def doubled(self, x, i, j, k):
        """Twice the area of triangles."""
        return cross(self.apart(x, i, j), self.apart(x, i, k))

    def cot(self, x, i, j, k):
        """Cotangent of the angle at k."""
        return (self.apart(x, k, i)*self.apart(x, k, j)).sum(axis=0)/self.doubled(x, i, j, k)

    def step(self, y, dt):
        """Advance a state (9, n) in place."""
        middle, held, method = y[:2] + dt/2*y[2:4], self.method.held, self.method
        self.flip_all(middle, y)
        hold(method.eos, held, y)
        t, i, j, S, k = self.edges(middle)
        flow, (strain, pull) = self.volume_rate(y, i, j, S), self.strain_and_pull(y, middle, t, i, j, S)
        parts = int(np.ceil(dt*self.stiffness(y, middle, t, i, j, k)/REAL))
        for _ in range(parts):
            once, first = 0.0, y[4:].copy()
            for s, new in enumerate(NEW):
                if s < 2:
                    again = self.rest_of_stress(y, t)
                    again[4, method.held.which] += method.held.heat
                    once = once + LATER[s]*(again - once)
                rates = self.exchange(y, i, j, S, k) + once
                rates[3] = flow
                rates[1] -= method.g*y[6]
                rates[4] -= method.g*y[5]
                y[4:] = first + new*(y[4:] - first + dt/parts/2*rates)
                hold(method.eos, held, y)
        y[:2] += dt*y[2:4]
        y[2:4] = np.where(self.free, y[4:6]/y[6] + method.shift*strain*pull, y[2:4])

    def edges(self, x):
        """Triangles (3, T); edges i, j, S, k of all triangles, one after the other."""
        t = triangles_of(self.left).T
        i, j, k = (np.concatenate([t[s], t[s - 2], t[s - 1]]) for s in range(3))
        towards = self.apart(x, i, k) - self.apart(x, i, j)/2
        return t, i, j, rotated(towards)/3, self.cot(x, i, j, k)/2

    def flip_all(self, x, y):
        """Until every edge has k >= 0: Delaunay's."""
        stack = [(i, j) for i, j in self.left if i < j]
        while stack:
            i, j = stack.pop()
            k, l = self.left.get((i, j)), self.left.get((j, i))
            if k is None or l is None or self.cot(x, i, j, k) + self.cot(x, j, i, l) >= 2*FLAT:
                continue
            self.remap(y, i, j, k, l)
            del self.left[i, j], self.left[j, i]
            self.left |= left_of(np.array([[i, l, k], [j, k, l]]))
            stack += [(j, k), (k, i), (i, l), (l, j)]
            self.flips += 1

    def remap(self, y, i, j, k, l):
        """Each of the four takes along what is in its dV; the surplus of all is shared by volume."""
        four, x = [i, j, k, l], y[:2]
        left, right = self.doubled(x, i, j, k)/2, self.doubled(x, i, l, j)/2
        at_i, at_j, both = self.doubled(x, i, l, k)/2, self.doubled(x, j, k, l)/2, left + right
        dV = np.array([at_i - both, at_j - both, both - left, both - right])/3
        V, q = y[7, four], y[np.ix_([4, 5, 6, 8], four)]
        q = q + q/V*dV - (q/V*dV).sum(axis=1, keepdims=True)*(V + dV)/V.sum()
        y[np.ix_([4, 5, 6, 8], four)] = q
        y[7, four] = V + dV

    def volume_rate(self, y, i, j, S):
        """dV/dt = sum_j S_ij.(w_i + w_j)/2."""
        through = (S*(y[2:4, i] + y[2:4, j])).sum(axis=0)/2
        return gathered(y.shape[1], through, i, -through, j)

    def strain_and_pull(self, y, x, t, i, j, S):
        """The largest |grad v| of free points, and from each point to the middle of its triangles, (2, n)."""
        n, area, v = y.shape[1], self.doubled(x, *t)/2, y[4:6]/y[6]
        V = gathered(n, area, t[0], area, t[1], area, t[2])/3
        slopes = [gathered(n, part*(f[j] - f[i])/2, i, part*(f[j] - f[i])/2, j) for f in v for part in S]
        pull = np.zeros((2, n))
        for s in range(3):
            spokes = area*(self.apart(x, t[s], t[s - 2]) + self.apart(x, t[s], t[s - 1]))
            np.add.at(pull.T, t[s], spokes.T)
        return float((np.sqrt(sum(q**2 for q in slopes))/V*self.free).max()), pull/(9*V)

    def stiffness(self, y, x, t, i, j, k):
        """Largest max(chi_i, chi_j) (spread_i + spread_j) of all edges, spread_i = sum_j k_ij/V_i."""
        n, area, (m, V, E), v = y.shape[1], self.doubled(x, *t)/2, y[6:9], y[4:6]/y[6]
        spread = gathered(n, k, i, k, j)/(gathered(n, area, t[0], area, t[1], area, t[2])/3)
        chi = diffusivity(self.method.eos, self.method.law, m/V, E/m - (v**2).sum(axis=0)/2)
        return float((np.maximum(chi[i], chi[j])*(spread[i] + spread[j])).max())

    def rest_of_stress(self, y, t):
        """What forces along edges lack: eta R(v_j - v_k)/2 on corner i, and its work out of the heat."""
        (m, V, E), v = y[6:9], y[4:6]/y[6]
        T = temperature(self.method.eos, m/V, E/m - (v**2).sum(axis=0)/2)
        eta = viscosity(self.method.law, m/V, T)*np.ones(len(m))
        mean, out = eta[t].mean(axis=0), np.zeros((5, len(m)))
        heat = -mean*cross(v[:, t[1]] - v[:, t[0]], v[:, t[2]] - v[:, t[0]])/3
        for s in range(3):
            i, j, k = t[s], t[s - 2], t[s - 1]
            push = mean*rotated(v[:, j] - v[:, k])/2
            np.add.at(out[:2].T, i, push.T)
            np.add.at(out[4], i, heat + (push*v[:, i]).sum(axis=0))
        return out

    def exchange(self, y, i, j, S, c):
        """Rates (5, n) of what passes edges at r = w - v, pressure, friction and heat."""
        (m, V, E), eos, law = y[6:9], self.method.eos, self.method.law
        rho, v = m/V, y[4:6]/m
        e, r = E/m - (v**2).sum(axis=0)/2, y[2:4] - v
        P, T = pressure(eos, rho, e), temperature(eos, rho, e)
        eta, kappa = viscosity(law, rho, T)*np.ones(len(m)), conductivity(law, rho, T)*np.ones(len(m))
        mass = (S*(r[:, i] + r[:, j])).sum(axis=0)/2*(rho[i] + rho[j])/2
        friction = c*(eta[i] + eta[j])/2*(v[:, j] - v[:, i])
        force = mass*(v[:, i] + v[:, j])/2 - S*(P[i] + P[j])/2 + friction
        work = (P[i]*(S*v[:, j]).sum(axis=0) + P[j]*(S*v[:, i]).sum(axis=0))/2
        carried = mass*(e[i] + e[j] + (v[:, i]*v[:, j]).sum(axis=0))/2
        rubbed = (friction*(v[:, i] + v[:, j])).sum(axis=0)/2
        heat = carried - work + rubbed + c*(kappa[i] + kappa[j])/2*(T[j] - T[i])
        return np.array([gathered(len(m), q, i, -q, j) for q in (*force, mass, 0*mass, heat)])


def gathered(n, *parts):
    """Sums (n,) of values at points, given as values, points, values, points ..."""
    return sum(np.bincount(at, q, n) for q, at in zip(parts[::2], parts[1::2], strict=True))


def cross(one, other):
    """one_x other_y - one_y other_x."""
    return one[0]*other[1] - one[1]*other[0]


def rotated(q):
    """R(x, y) = (y, -x)."""
    return np.stack([q[1], -q[0]])
