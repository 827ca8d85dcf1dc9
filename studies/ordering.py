"""Does (dV)^(1/d) < r0 < lambda (RR98 Eq. 45) govern the error, and how?

Gradients and Laplacians of plane waves on lattices, jittered, random and relaxed points: error over a/h and h/lambda, a the
spacing, h the range of the weight (r0 of RR98), lambda the wavelength. Paper size takes some minutes.
Writes results/ordering/*.csv and *.png and the rows of study ordering in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product

from particles.makers import MAKERS
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.integral import ordering_claims, ordering_derive, ordering_figures, tables
from studies.integral.operators import DISORDERS, OperatorErrors
from studies.kit.case import Case
from studies.kit.study import Study, main

H = (1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
SEEDS = (1, 2, 3)


def wave(maker: str, weight, h: float, disorder: str, wavelength: int) -> Iterator[OperatorErrors]:
    """One point of the surface; points with disorder have seeds."""
    for seed in SEEDS if disorder != "lattice" else SEEDS[:1]:
        yield OperatorErrors(maker=maker, make=MAKERS[maker], weight=weight, h=h, disorder=DISORDERS[disorder],
                             wavelength=wavelength, seed=seed)


def cases(size: str) -> list[Case]:
    """`quick` has few wavelengths and kinds of points; relaxing takes the longer the more points there are."""
    if size == "quick":
        return list(surface((16, 32), ["lattice", "jittered-0.3"]))
    loose = [name for name in DISORDERS if name != "relaxed"]
    return [*surface((16, 24, 32, 48, 64, 96), loose), *surface((16, 20, 24, 32), ["relaxed"])]


def surface(wavelengths: tuple[int, ...], disorders: list[str]) -> Iterator[Case]:
    """Lucy's weight everywhere; other weights and all makers of edges at two ranges."""
    for disorder, wavelength in product(disorders, wavelengths):
        for h in H:
            yield from wave("renormalised", Lucy, h, disorder, wavelength)
        for maker, h in product(("plain", "printed", "closed", "exact"), (2.0, 3.0)):
            if maker != "exact" or h == 3.0:
                yield from wave(maker, Lucy, h, disorder, wavelength)
        for weight in (Monaghan, WendlandC2):
            yield from wave("renormalised", weight, 3.0, disorder, wavelength)
        yield from wave("delaunay", Lucy, 2.0, disorder, wavelength)


STUDY = Study(name="ordering", cases=cases, tables=tables.ALL, derive=ordering_derive.derive, figures=ordering_figures.figures,
              claims=ordering_claims.CLAIMS)

if __name__ == "__main__":
    main(STUDY)
