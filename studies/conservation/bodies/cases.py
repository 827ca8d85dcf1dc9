"""Which of the boundaries that RR98 leaves open can be had with fixed points, and how good are they?

Sliding sides (Lees and Edwards), rows of fixed points as a wall, frozen points as a rigid body: homogeneous shear, a wave that it
turns, driven flow between rows, a cylinder that turns, and the drag of one in a square array [Sangani & Acrivos 1982]. Units of
KHP95, the spacing is 1. Paper size takes two to three minutes of one core.
Writes results/conservation/*.csv and *.png and the rows of study conservation in results/claims.csv.
"""
from collections.abc import Iterator

from particles.integral.edge_makers import renormalised
from particles.integral.triangulation import delaunay
from studies.conservation.bodies import claims as bodies_claims
from studies.conservation.bodies import derive as bodies_derive
from studies.conservation.bodies import figures as bodies_figures
from studies.conservation.bodies import tables as bodies_tables
from studies.conservation.bodies.drag import SPEED, VARIANTS, CylinderDrag
from studies.conservation.bodies.shear import FixedRows, MovingRows, SlidingShear, TurningWave
from studies.conservation.bodies.turn import TurningCylinder
from studies.kit.case import Case
from studies.kit.study import Part

MAKERS = (("renormalised", renormalised, 2.0), ("renormalised", renormalised, 3.0), ("delaunay", delaunay, 2.0))
SMOOTH = (24, 28, 32, 36, 40, 44, 48, 52, 56)      # sizes where errors are smooth, and where they are not
SCATTERED = tuple(range(24, 50, 2))
SHOWN = (12, 32)


def cases(size: str) -> list[Case]:
    """`quick` has small sizes, at one solid fraction, too few and too small to extrapolate drags from."""
    if size == "quick":
        return [*sides((12, 16, 24)), *walls((12, 16)), *drags("surface", 0.1, (12, 16)), *drags("frozen", 0.1, (12, 16)),
                *turns((16, 20))]
    return [*sides((16, 24, 32, 48, 64)), *walls((12, 16, 24, 32)), *array(), *turns(tuple(range(24, 68, 4)))]


def sides(sizes: tuple[int, ...]) -> Iterator[Case]:
    """Sliding sides, and rows that move."""
    for rows in sizes:
        yield TurningWave(rows=rows)
    for rows in sizes[:3]:
        yield from (SlidingShear(rows=rows), MovingRows(rows=rows))


def walls(sizes: tuple[int, ...]) -> Iterator[Case]:
    """Flow between fixed rows."""
    for maker, make, h in MAKERS:
        yield from (FixedRows(maker=maker, make=make, h=h, rows=rows) for rows in sizes)


def turns(sizes: tuple[int, ...]) -> Iterator[Case]:
    """A cylinder that turns."""
    yield from (TurningCylinder(rows=rows) for rows in sizes)


def array() -> Iterator[Case]:
    """All drags: one stream four times as fast."""
    for fraction, every in ((0.1, 1), (0.3, 4)):
        yield from drags("surface", fraction, SMOOTH)
        yield from drags("surface-unfiltered", fraction, (24, 32, 48))
        yield from drags("frozen", fraction, SCATTERED[::every])
        yield from drags("frozen-grown", fraction, SCATTERED[::every])
    yield from drags("frozen-h3", 0.1, SCATTERED[::4])
    yield CylinderDrag(variant=VARIANTS["surface"], fraction=0.1, rows=24, speed=4*SPEED)


def drags(name: str, fraction: float, sizes: tuple[int, ...]) -> Iterator[Case]:
    """Drags of one variant; two streams of each size are shown."""
    for rows in sizes:
        yield CylinderDrag(variant=VARIANTS[name], fraction=fraction, rows=rows,
                           shows=name in ("surface", "frozen") and fraction == 0.1 and rows in SHOWN)


PART = Part(cases=cases, tables=bodies_tables.ALL, derive=bodies_derive.derive, figures=bodies_figures.figures,
              claims=bodies_claims.CLAIMS)
