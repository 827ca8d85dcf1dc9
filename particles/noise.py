"""Random numbers as functions of (seed, step, i, j) or (seed, step, i, component), without a stored state.

Philox4x32-10 [Salmon, Moraes, Dror & Shaw 2011]: ten rounds turn a counter of four 32-bit words under a key
of two into four random words. The key is the seed, the counter (i, j, step, 2 block) of a pair, (i, block,
step, 1) of a point: a number does not depend on lists, threads or restarts.
"""
from numbers import Integral

import numba
import numpy as np

from continuum.jit import INLINED, OPTIONS, jit

u64 = np.uint64
LOW, HALF = u64(0xFFFFFFFF), u64(32)
#: multipliers, and increments of the key per round    [Salmon et al. 2011, Sec. 4.3 and its library]
M0, M1, W0, W1 = u64(0xD2511F53), u64(0xCD9E8D57), u64(0x9E3779B9), u64(0xBB67AE85)
UNIT = 2.0**-32
POINT, TWO = u64(1), u64(2)
#: inlined before loops are vectorised: nine times as fast
inlined = numba.njit(cache=True, nogil=True, **OPTIONS, **INLINED)


def check_seed(seed: int) -> None:
    """Check that a seed is a whole number of 64 bits. Raises ValueError."""
    if not isinstance(seed, Integral) or isinstance(seed, bool) or not 0 <= int(seed) < 2**64:
        raise ValueError(f"the seed must be a whole number from 0 to 2^64 - 1, got {seed!r}")


@inlined
def philox(a, b, c, d, k0, k1):
    """Philox4x32-10: four 32-bit words, each in 64 bits, from a counter (a, b, c, d) under a key (k0, k1)."""
    for _ in range(10):
        p, q = M0*a, M1*c
        a, b, c, d = (q >> HALF) ^ b ^ k0, q & LOW, (p >> HALF) ^ d ^ k1, p & LOW
        k0, k1 = (k0 + W0) & LOW, (k1 + W1) & LOW
    return a, b, c, d


@inlined
def words_of_pair(seed, step, i, j, block):
    """Four random words of a pair, the same for (i, j) and (j, i); block = 1, 2, ... gives more of them."""
    i, j, seed = u64(i), u64(j), u64(seed)
    return philox(min(i, j), max(i, j), u64(step) & LOW, TWO*u64(block), seed & LOW, seed >> HALF)


@inlined
def words_of_point(seed, step, i, block):
    """Four random words of point i; block = 1, 2, ... gives more of them."""
    i, seed = u64(i), u64(seed)
    return philox(i, u64(block), u64(step) & LOW, POINT, seed & LOW, seed >> HALF)


@inlined
def normal(one, other):
    """Two standard normal numbers from two words, at most 6.77 in size    [Box & Muller 1958]"""
    r, angle = np.sqrt(-2*np.log((float(one) + 0.5)*UNIT)), 2*np.pi*UNIT*(float(other) + 0.5)
    return r*np.cos(angle), r*np.sin(angle)


@inlined
def uniform_of_pair(seed, step, i, j):
    """One uniform number of mean 0 and variance 1, symmetric in i, j    [Groot & Warren 1997]"""
    word = words_of_pair(seed, step, i, j, 0)[0]
    return (float(word) + 0.5 - 2.0**31)*(UNIT*np.sqrt(12.0))


@inlined
def normals(words):
    """Four normal numbers from four words."""
    (p, q), (r, s) = normal(words[0], words[1]), normal(words[2], words[3])
    return p, q, r, s


@jit
def fill_normals(first, last, seed, step, out):
    """out[i, c] = normal number of (seed, step, i, c), for points first..last; `out` (points, components)."""
    for i in range(first, last):
        for c in range(0, out.shape[1], 4):
            found = normals(words_of_point(seed, step, i, c//4))
            for k in range(min(4, out.shape[1] - c)):
                out[i, c + k] = found[k]
