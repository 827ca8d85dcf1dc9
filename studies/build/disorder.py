"""Kinds of periodic point sets, from a lattice to disorder; lengths in spacings."""
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from particles.integral.points import Points, jittered, lattice, random, relaxed
from particles.weights import WendlandC2

BREADTH = 16        # spacings across a wave
APART = 0.5         # of random points, in spacings


class Disorder(NamedTuple):
    """A kind of point set; `size`: jitter in spacings, or the least distance of random points."""
    name: str
    make: Callable[[tuple[int, ...], float, int], Points]
    size: float = 0.0


def on_lattice(counts: tuple[int, ...], size: float, seed: int) -> Points:
    """The square lattice, whatever the seed."""
    return lattice(counts)


@cache
def relaxed_random(counts: tuple[int, ...], apart: float, seed: int) -> Points:
    """Random points, relaxed until a|c| < 2e-3."""
    return relaxed(random(counts, apart, seed), WendlandC2.of(h=3.0), until=2e-3, sweeps=4000)


DISORDERS = {d.name: d for d in (
    Disorder("lattice", on_lattice),
    Disorder("jittered-0.1", jittered, 0.1),
    Disorder("jittered-0.3", jittered, 0.3),
    Disorder("random", random, APART),
    Disorder("relaxed", relaxed_random, APART))}
