"""Random numbers: known answers, symmetry, moments, independence of neighbouring counters."""
from itertools import product

import numpy as np
import pytest
from scipy.stats import kstest

from continuum.jit import jit
from particles.noise import (
    check_seed,
    fill_normals,
    philox,
    uniform_of_pair,
    words_of_pair,
    words_of_point,
)

u64 = np.uint64
#: counter, key, answer: kat_vectors of the library of Salmon et al. 2011; the third are digits of pi
KNOWN = [
    ((0, 0, 0, 0), (0, 0), (0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8)),
    ((0xffffffff,)*4, (0xffffffff,)*2, (0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd)),
    ((0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344), (0xa4093822, 0x299f31d0),
     (0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1)),
]
SIGMAS = 5.0     # of a mean over n numbers: passes wrongly but once in two million


@jit
def over_pairs(seed, step, n, out):
    """Uniform numbers of all pairs of n points, row by row."""
    k = 0
    for i in range(n):
        for j in range(i + 1, n):
            out[k] = uniform_of_pair(seed, step, i, j)
            k += 1


def uniforms(seed=1, step=7, n=600):
    out = np.empty(n*(n - 1)//2)
    over_pairs(seed, step, n, out)
    return out


def normals(seed=1, step=7, shape=(40_000, 5)):
    out = np.empty(shape)
    fill_normals(0, shape[0], seed, step, out)
    return out


@pytest.mark.parametrize("counter, key, answer", KNOWN)
def test_known_answers(counter, key, answer):
    assert philox(*map(u64, (*counter, *key))) == answer


def test_pairs_are_symmetric_and_points_are_not_pairs():
    for i, j in product((0, 1, 77, 2**32 - 1), repeat=2):
        assert uniform_of_pair(3, 4, i, j) == uniform_of_pair(3, 4, j, i)
        assert words_of_pair(3, 4, i, j, 0) == words_of_pair(3, 4, j, i, 0)
        assert words_of_pair(3, 4, i, j, 0) != words_of_point(3, 4, i, j)


def test_every_argument_counts():
    base = (5, 6, 7, 8, 9)
    found = {words_of_pair(*base)}
    for place in range(5):
        for bit in (0, 1, 15, 31):      # of the seed also the upper half
            other = list(base)
            other[place] ^= 1 << bit if place else 1 << 2*bit
            found.add(words_of_pair(*other))
    assert len(found) == 1 + 5*4


def moments(x):
    """Means of x, x^2, x^4, with the standard deviations that independent numbers would give them."""
    return [(float(np.mean(x**p)), float(np.std(x**p)/np.sqrt(x.size))) for p in (1, 2, 4)]


@pytest.mark.parametrize("x, known, law", [
    (uniforms(), (0, 1, 9/5), ("uniform", (-np.sqrt(3), 2*np.sqrt(3)))),
    (normals().ravel(), (0, 1, 3), ("norm", ()))])
def test_moments_and_law(x, known, law):
    for (measured, spread), expected in zip(moments(x), known, strict=True):
        assert abs(measured - expected) < SIGMAS*spread
    assert kstest(x, *law).pvalue > 1e-6


def test_components_are_independent():
    x = normals()
    cross = x.T@x/len(x) - np.eye(5)
    assert np.abs(cross[~np.eye(5, dtype=bool)]).max() < SIGMAS/np.sqrt(len(x))


@pytest.mark.parametrize("lag", [1, 2, 3, 64])
def test_neighbouring_counters_are_independent(lag):
    """Correlations along i, from step to step and from seed to seed, of numbers and of squares."""
    x, others = normals(), (normals(step=7 + lag), normals(seed=1 + lag))
    limit = SIGMAS/np.sqrt(x.size)
    for a, b in ((x[lag:], x[:-lag]), *((x, other) for other in others)):
        assert abs(np.mean(a*b)) < limit
        assert abs(np.mean((a**2 - 1)*(b**2 - 1))) < 2*limit     # the squares have variance 2
    u = uniforms()
    assert abs(np.mean(u[lag:]*u[:-lag])) < SIGMAS/np.sqrt(u.size)


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, "one", True])
def test_bad_seeds(seed):
    with pytest.raises(ValueError, match="the seed must be a whole number from 0 to"):
        check_seed(seed)
