"""Compiled pair sums of dissipative particles, in blocks of rows whose pairs stay in the cache."""

from collections import namedtuple

import numpy as np

from continuum.jit import jit
from particles.neighbours import u32, u64
from particles.noise import uniform_of_pair
from particles.pairs import pair_at, pair_term, sweep

Record = np.dtype([*((name, "f8") for name in ("x", "y", "z", "vx", "vy", "vz")),
                   ("id", "u8"), ("image", "u8")])
ROWS = 32       # rows of a block: their pairs take some 30 KB


#: Repulsion a, friction gamma, and amplitude sigma of the noise.
Law = namedtuple("Law", "a gamma sigma")

#: Pairs within rc: row i has near, (dx, dy, dz) = r_i - r_j [first[i]:first[i] + taken[i]]; own, other :
#: ids of both. f r is the force that does not depend on velocities, g r^2 the friction coefficient.
Near = namedtuple("Near", "first taken near own other dx dy dz zeta f g")

#: Geometry and coefficients of a pair, as a term reads them.
Apart = namedtuple("Apart", "dx dy dz f g")

pair_at.of(Near)(lambda pairs, k: Apart(pairs.dx[k], pairs.dy[k], pairs.dz[k], pairs.f[k], pairs.g[k]))


@pair_term(3)
def Force(term, a, b, ab):
    """The whole force of a pair, [f - g r.v_ab] r."""
    c = ab.f - ab.g*(ab.dx*(a.vx - b.vx) + ab.dy*(a.vy - b.vy) + ab.dz*(a.vz - b.vz))
    return c*ab.dx, c*ab.dy, c*ab.dz


@jit
def draw(law, seed, step, i, j, count, zeta):
    """Write zeta[k] of the first `count` pairs, of particles with ids i[k], j[k], in a step."""
    if law.sigma == 0:
        zeta[:count] = 0.0
        return
    for k in range(count):
        zeta[k] = uniform_of_pair(seed, step, i[k], j[k])


@jit
def find_near(first, last, particle, lists, pairs):
    """Find the pairs in range of rows first..last, with r^2 in f, without a branch. Returns their number."""
    end = u64(0)
    for i in range(u64(first), u64(last)):
        a, begin = particle[i], end
        for k in range(lists.start[i], lists.start[i] + lists.length[i]):
            b = particle[lists.listed[k]]
            dx, dy, dz = a.x - b.x, a.y - b.y, a.z - b.z
            r2 = dx*dx + dy*dy + dz*dz
            pairs.near[end], pairs.own[end], pairs.other[end] = lists.listed[k], a.id, b.id
            pairs.dx[end], pairs.dy[end], pairs.dz[end], pairs.f[end] = dx, dy, dz, r2
            end += u64(r2 < 1)
        pairs.first[i], pairs.taken[i] = begin, end - begin
    return end


@jit
def weigh_near(law, count, zeta, f, g):
    """f and g of the first `count` pairs, where f holds r^2 before, in a loop that LLVM vectorises."""
    for k in range(count):
        per_r = 1/np.sqrt(f[k])
        w_r = per_r - 1        # w/r
        f[k] = w_r*(law.a + law.sigma*zeta[k])
        g[k] = law.gamma*w_r*w_r


@jit
def room_for(first, last, lists, taken):
    """Arrays for the pairs of the longest block of rows first..last. Each has memory of its own: LLVM
    takes rows of one array for the same memory and does not vectorise."""
    room = 1
    for start in range(first, last, ROWS):
        room = max(room, int(lists.length[start:min(start + ROWS, last)].sum()) + 1)
    return Near(taken[0], taken[1], np.empty(room, u32), np.empty(room, u64), np.empty(room, u64),
                np.empty(room), np.empty(room), np.empty(room), np.empty(room), np.empty(room),
                np.empty(room))


@jit
def sum_pairs(first, last, term, law, seed, step, particle, lists, taken, out):
    """out[i] = sum of the term over the pairs of row i, block by block of rows."""
    pairs = room_for(first, last, lists, taken)
    for start in range(first, last, ROWS):
        end = min(start + ROWS, last)
        count = find_near(start, end, particle, lists, pairs)
        draw(law, seed, step, pairs.own, pairs.other, count, pairs.zeta)
        weigh_near(law, count, pairs.zeta, pairs.f, pairs.g)
        sweep(start, end, term, particle, pairs, out)


@jit
def record(first, last, x, v, ids, parent, shift, particle):
    """Write records of points first..last."""
    for k in range(first, last):
        p, i = particle[k], parent[k]
        p.x, p.y = x[0, i] + shift[k, 0], x[1, i] + shift[k, 1]
        p.vx, p.vy, p.id, p.image = v[0, i], v[1, i], ids[i], i
        p.z, p.vz = (x[2, i] + shift[k, 2], v[2, i]) if len(x) == 3 else (0.0, 0.0)


@jit
def rub_pairs(n, law, seed, step, dt, particle, lists, taken):
    """Apply friction and noise pair by pair, by implicit midpoint: keeps kT at any step    [Shardlow 2003]

    Relative velocity along a pair: u' = u - K (u + u') + 2 s zeta, K = gamma w^2 dt, s^2 = 2 K kT; each of
    the two particles gets half of the change.
    """
    pairs = room_for(0, n, lists, taken)
    for start in range(0, n, ROWS):
        end = min(start + ROWS, n)
        count = find_near(start, end, particle, lists, pairs)
        draw(law, seed, step, pairs.own, pairs.other, count, pairs.zeta)
        for i in range(start, end):
            a = particle[i]
            for k in range(pairs.first[i], pairs.first[i] + pairs.taken[i]):
                image = particle[pairs.near[k]].image
                if image <= i:        # each pair is treated once, in the row of its lower index
                    continue
                b, r = particle[image], np.sqrt(pairs.f[k])
                ex, ey, ez, w = pairs.dx[k]/r, pairs.dy[k]/r, pairs.dz[k]/r, 1 - r
                # y first: the order in which LLVM summed in committed runs
                u = ey*(a.vy - b.vy) + ex*(a.vx - b.vx) + ez*(a.vz - b.vz)
                K = law.gamma*w*w*dt
                q = (law.sigma*dt*w*pairs.zeta[k] - K*u)/(1 + K)
                a.vx, a.vy, a.vz = a.vx + q*ex, a.vy + q*ey, a.vz + q*ez
                b.vx, b.vy, b.vz = b.vx - q*ex, b.vy - q*ey, b.vz - q*ez
