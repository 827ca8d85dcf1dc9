"""Compiled flips of a triangulation stored as rings, and the transfer between points in a flip."""
import numpy as np

from continuum.fluid import temperature
from continuum.jit import formula, jit
from particles.integral.rings import FLAT, apart
from particles.neighbours import u32, u64

#: rows of the exchanged quantities: volume; momentum, mass and energy, which it carries
VOLUME, CARRIED = 3, (0, 1, 2, 4)


@jit
def slot(rings, i, j):
    """Entry of j in the ring of i, as an index into all entries; the end of the ring if j is not in it."""
    e = rings.edges.first[i]
    end = e + u64(rings.edges.taken[i])
    while e < end and rings.edges.near[e] != j:
        e += u64(1)
    return e


@formula
def beside(rings, i, e):
    """Neighbours of i after and before entry e of its ring."""
    begin, near = rings.edges.first[i], rings.edges.near
    end = begin + u64(rings.edges.taken[i]) - u64(1)
    after, before = near[e + u64(1) if e < end else begin], near[e - u64(1) if e > begin else end]
    return np.int64(after), np.int64(before)


@jit
def drop(rings, i, e):
    """Remove entry e from the ring of i."""
    near, end = rings.edges.near, rings.edges.first[i] + u64(rings.edges.taken[i]) - u64(1)
    for s in range(e, end):
        near[s] = near[s + u64(1)]
    rings.edges.taken[i] -= u32(1)


@jit
def put(rings, i, e, j):
    """Insert j after entry e of the ring of i."""
    near, s = rings.edges.near, rings.edges.first[i] + u64(rings.edges.taken[i])
    while s > e + u64(1):
        near[s] = near[s - u64(1)]
        s -= u64(1)
    near[s] = u32(j)
    rings.edges.taken[i] += u32(1)


@jit
def lengthen(rings, i):
    """Move the full ring of i behind all others, with twice its capacity; False: memory is exhausted."""
    edges, begin, room, end = rings.edges, rings.edges.first[i], u64(rings.room[i]), u64(rings.end[0])
    if end + u64(2)*room > len(edges.near):
        return False
    edges.near[end:end + room] = edges.near[begin:begin + room]
    edges.first[i], rings.room[i], rings.end[0] = end, u64(2)*room, end + u64(2)*room
    return True


@formula
def doubled(x, y, size, per, i, j, k):
    """Twice the area of the triangle (i, j, k), positive if it is counterclockwise."""
    jx, jy = apart(x, y, size, per, i, j)
    kx, ky = apart(x, y, size, per, i, k)
    return jx*ky - jy*kx


@formula
def cotangents(x, y, size, per, i, j, k, l):
    """cot_k + cot_l of the angles opposite to edge (i, j) in the triangles (i, j, k), (i, l, j)."""
    jx, jy = apart(x, y, size, per, i, j)
    kx, ky = apart(x, y, size, per, i, k)
    lx, ly = apart(x, y, size, per, i, l)
    return ((kx*(kx - jx) + ky*(ky - jy))/(jx*ky - jy*kx) + (lx*(lx - jx) + ly*(ly - jy))/(lx*jy - ly*jx))


@jit
def flips(at, state, eos, rings, crossed, changed, stack):
    """Flip edges until all are Delaunay's: (number of flips, -1) or (flips so far, a point with a full ring).

    at (2, n) : positions that decide on flips; volumes belong to those in the state, of `carried`. A flip
    replaces edge (i, j), with k on its left and l on its right, by (l, k), and transfers mass, momentum and
    energy with volume: conservative, and exact on linear fields unless a density or temperature would fall
    by half. changed : points whose rings have changed. stack (m, 2) : scratch memory for edges to check.
    """
    x, y = at
    size, per, near, count = rings.size, rings.per, rings.edges.near, 0
    x0, y0, exchanged = state[0], state[1], state[4:9]
    old, new = np.empty((5, 4)), np.empty((5, 4))
    for row in range(len(crossed)):
        if not crossed[row]:
            continue
        top = 0
        for e in range(rings.edges.first[row], rings.edges.first[row] + u64(rings.edges.taken[row])):
            stack[top, 0], stack[top, 1] = row, near[e]
            top += 1
        while top > 0:
            top -= 1
            i, j = stack[top]
            entry, back = slot(rings, i, j), slot(rings, j, i)
            if entry == rings.edges.first[i] + u64(rings.edges.taken[i]) or on_side(rings, i, entry):
                continue        # removed by another flip, or with a triangle on one side only
            k, l = beside(rings, i, entry)
            if 0.5*cotangents(x, y, size, per, i, j, k, l) >= FLAT:
                continue
            if not (doubled(x, y, size, per, i, l, k) > 0 and doubled(x, y, size, per, j, k, l) > 0):
                continue        # not convex: another flip comes first
            for full in (k, l):
                if rings.edges.taken[full] == rings.room[full] and not lengthen(rings, full):
                    return count, full
            remap(x0, y0, size, per, eos, exchanged, i, j, k, l, old, new)
            drop(rings, i, entry)
            drop(rings, j, back)
            put(rings, k, slot(rings, k, i), l)
            put(rings, l, slot(rings, l, j), k)
            for m in (i, j, k, l):
                changed[m] = True
            for one, other in ((j, k), (k, i), (i, l), (l, j)):
                if top < len(stack):
                    stack[top, 0], stack[top, 1] = one, other
                    top += 1
            count += 1
    return count, -1


@formula
def on_side(rings, i, e):
    """Whether entry e of the ring of i is an edge along a side."""
    begin = rings.edges.first[i]
    return rings.rim[i] and (e == begin or e + u64(1) == begin + u64(rings.edges.taken[i]))


@jit
def remap(x, y, size, per, eos, exchanged, i, j, k, l, old, new):
    """Transfer between the four points of a flip: dV is a third of the change of triangle area at a point.

    x, y : positions to which volumes belong. old, new (5, 4) : scratch memory for the exchanged quantities.
    """
    left, right = doubled(x, y, size, per, i, j, k)/2, doubled(x, y, size, per, i, l, j)/2
    at_i, at_j, both = doubled(x, y, size, per, i, l, k)/2, doubled(x, y, size, per, j, k, l)/2, left + right
    four, dV = (i, j, k, l), ((at_i - both)/3, (at_j - both)/3, (both - left)/3, (both - right)/3)
    for c in range(4):
        for row in range(5):
            old[row, c] = exchanged[row, four[c]]
        new[VOLUME, c] = old[VOLUME, c] + dV[c]
    along_slopes(old, dV, new)
    if not sound(eos, old, new):
        from_givers(old, dV, new)
    for c in range(4):
        for row in range(5):
            exchanged[row, four[c]] = new[row, c]


@formula
def along_slopes(old, dV, new):
    """Volume carries densities of its own point; the excess is taken from all: exact on linear fields."""
    all_volume = old[VOLUME].sum()
    for row in CARRIED:
        excess = 0.0
        for c in range(4):
            excess += dV[c]*old[row, c]/old[VOLUME, c]
        for c in range(4):
            new[row, c] = (old[row, c] + dV[c]*old[row, c]/old[VOLUME, c]
                           - excess*new[VOLUME, c]/all_volume)


@formula
def from_givers(old, dV, new):
    """Lost volume carries its point's densities; gained volume has the mean of what is lost: first order."""
    for row in CARRIED:
        given, volume = 0.0, 0.0
        for c in range(4):
            given += max(-dV[c], 0.0)*old[row, c]/old[VOLUME, c]
            volume += max(-dV[c], 0.0)
        for c in range(4):
            mean = old[row, c]/old[VOLUME, c] if dV[c] < 0 else given/volume
            new[row, c] = old[row, c] + dV[c]*mean


@formula
def sound(eos, old, new):
    """Whether the smallest density and temperature of the four points stay above half of what they were."""
    rho, T, low_rho, low_T = np.inf, np.inf, np.inf, np.inf
    for c in range(4):
        one, other = density_and_temperature(eos, old, c), density_and_temperature(eos, new, c)
        rho, T = min(rho, one[0]), min(T, one[1])
        low_rho, low_T = min(low_rho, other[0]), min(low_T, other[1])
    return low_rho > 0.5*rho and low_T > 0.5*T


@formula
def density_and_temperature(eos, exchanged, c):
    px, py, m, V, E = exchanged[0, c], exchanged[1, c], exchanged[2, c], exchanged[3, c], exchanged[4, c]
    return m/V, temperature(eos, m/V, (E - 0.5*(px*px + py*py)/m)/m)
