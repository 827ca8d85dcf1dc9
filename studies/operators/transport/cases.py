"""Which viscosities, conductivity and speed of sound does discretized integral hydrodynamics have?    [RR98 Eqs 34-38, 51]

Small waves of density, velocity and temperature decay on lattices and on irregular points: what comes out is held against the
lattice symbol, in closed form from the weight, and against the continuum. Couette and Poiseuille flow start from rest between
plates and are held against their series. Units: spacing a = 1, rho = T = 1, ideal gas with C_V = 1 in 2D. Paper size takes
about six minutes. Writes results/operators/*.csv and *.png and the rows of study operators in results/claims.csv.
"""
from collections.abc import Iterator
from itertools import product
from typing import Any

from particles.integral.edge_makers import MAKERS
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.kit.case import Case
from studies.kit.study import Part
from studies.operators.transport import claims as transport_claims
from studies.operators.transport import derive as transport_derive
from studies.operators.transport import figures as transport_figures
from studies.operators.transport import tables as transport_tables
from studies.operators.transport.walls import FLOWS, ShearFlow
from studies.operators.transport.waves import Decay
from studies.ordering.waves import DISORDERS

ZETA = 0.2
SEEDS = (1, 2, 3)
MANY = tuple(range(1, 13))      # sets of points between rows of points: their errors scatter by a tenth
LONG = 32           # spacings: longer waves on irregular points cost seconds each
JITTER = 0.2        # spacings, of points between plates
#: transport and bulk viscosity: forces along edges share out the two viscosities with zeta > 0 only in 2D
GASES = (("nested", ZETA), ("pairwise", 0.0), ("pairwise", ZETA))


def on_lattice(wavelengths: tuple[int, ...]) -> Iterator[Case]:
    """Waves along an axis, the strip across as narrow as the range allows; along a diagonal where directions differ."""
    for (transport, zeta), weight, h in product(GASES, (Lucy, Monaghan, WendlandC2), (2.0, 3.0)):
        same: dict[str, Any] = {"transport": transport, "zeta": zeta, "maker": "renormalised", "make": MAKERS["renormalised"],
                                "weight": weight, "h": h, "disorder": DISORDERS["lattice"]}
        yield from (Decay(**same, counts=(n, round(2*h) + 1)) for n in wavelengths)
        if weight is Lucy and zeta:
            yield from (Decay(**same, counts=(n, n), turns=(1, 1)) for n in (24, 32, 48) if n <= max(wavelengths))


def irregular(wavelengths: tuple[int, ...]) -> Iterator[Case]:
    """Points jittered by 0.3 a, three sets each; the longest waves with the least that Eq. 51 can be."""
    for (transport, zeta), maker, n, seed in product(GASES, ("delaunay", "exact"), wavelengths, SEEDS):
        if n > LONG and (transport, zeta) != GASES[1]:
            continue
        yield Decay(transport=transport, zeta=zeta, maker=maker, make=MAKERS[maker], weight=Lucy, h=3.0,
                    disorder=DISORDERS["jittered-0.3"], counts=(n, 12), seed=seed)


def shear(rows: tuple[int, ...], mirrored: tuple[int, ...], held: tuple[int, ...], seeds: tuple[int, ...]) -> Iterator[Case]:
    """Between plates: a lattice, jittered points and their mirror images, jittered points between rows of held ones."""
    for drive in FLOWS.values():
        yield from (ShearFlow(drive=drive, rows=n) for n in rows)
        for plates, n, seed in (*product((False,), mirrored, SEEDS), *product((True,), held, seeds)):
            yield ShearFlow(drive=drive, rows=n, jitter=JITTER, plates=plates, seed=seed)


def cases(size: str) -> list[Case]:
    """`quick` has three short wavelengths, one kind of irregular points and layers of few rows."""
    if size == "quick":
        return [*on_lattice((16, 24, 32)), *list(irregular((16,)))[:3], *shear((8, 12, 16), (8,), (8,), SEEDS)]
    return [*on_lattice((8, 16, 24, 32, 48, 64)), *irregular((16, 24, 32, 48)),
            *shear((8, 16, 32, 64), (8, 16, 32, 48), (8, 16, 32, 48, 64), MANY)]


PART = Part(cases=cases, tables=transport_tables.ALL, derive=transport_derive.derive,
              figures=transport_figures.figures, claims=transport_claims.CLAIMS)
