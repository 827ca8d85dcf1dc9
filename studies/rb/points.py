"""Which cases on points: on a lattice, irregular ones, points that move; all of size `fine`."""
from collections.abc import Iterator
from functools import partial
from itertools import product
from typing import Any

from continuum.scene import RayleighBenard, Walls
from studies.build import variant
from studies.build.fixed import SCHEMES
from studies.build.moving import CARRIAGES, DRIFT_MOTIONS, MOTIONS
from studies.kit.case import Case
from studies.rb.runs.points import CarriedRun, DihRun, DriftRun, MovingRun
from studies.rb.runs.space import InSpace

SEEDS = (1, 2, 3)
#: rows of the schemes on points that converge; 40 of the others
MOST = {"fixed-lattice": 80, "fixed-lattice-printed-heat": 80, "fixed-lattice-h3": 80,
        "fixed-lattice-nested": 80, "fixed-jittered-plates": 64, "fixed-random-plates": 50,
        "relaxed-plates": 50, "fixed-jittered-delaunay": 50, "fixed-random-delaunay": 50,
        "relaxed-delaunay": 50}
#: schemes that only other studies run
ELSEWHERE = {"fixed-lattice-h1.2", "fixed-lattice-monaghan", "fixed-lattice-wendland-c2"}
#: of RR98's own motions, those with 40 rows besides 25
FINER = ("moving-literal", "moving-convective", "moving-constant-mass", "moving-less-static")


LONG, SQUARE = {"t_end": 400.0, "mean_from": 300.0}, {"aspect": 1.0, "sides": Walls()}
#: of points that move with their triangulation: Ra, rows, seeds, times, box; below and above the usual Ra
CARRIED: tuple[tuple[Any, ...], ...] = (
    ((5e3, 1e4), (12, 16, 20, 25, 32, 40, 50, 64), SEEDS, {}, {}),
    ((1e4,), (80,), (1,), {}, {}),
    ((1e4,), (25,), (4, 5, 6, 7, 8), {}, {}),       # three left open whether they are off by less than 0.3 %
    ((2000.0, 2500.0, 3000.0), (16, 20, 25), SEEDS, LONG, {}),
    ((2e4, 5e4), (16, 25, 40), SEEDS, {}, {}),
    ((1e5, 1e6), (25, 40, 64), SEEDS, {"mean_from": 100.0}, {}),        # the flow itself oscillates
    ((7e3, 1e4, 2e4), (20, 28, 40), SEEDS, {}, SQUARE),
)


def points() -> Iterator[Case]:
    """Discretized integral hydrodynamics: points on a lattice, irregular points, moving points."""
    for ra, height in product((5e3, 1e4), (25.0, 40.0, 50.0, 64.0, 80.0)):
        yield from on_points(RayleighBenard(ra=ra, L=height))
    yield from carried()
    few, many = (RayleighBenard(ra=1e4, L=height) for height in (25.0, 40.0))
    # seeds differ by 0.03 %, ingredients by more
    for name, where, seed in product(sorted({*MOTIONS} - {"moving"}), (few, many), SEEDS[:2]):
        yield MovingRun(scene=where, variant=MOTIONS[name], seed=seed)
    for motion, seed in product(DRIFT_MOTIONS.values(), SEEDS):
        yield DriftRun(scene=few, variant=motion, seed=seed)
    # a third seed of those whose claims decide an equation
    for name, seed in (*product(FINER, SEEDS[:2]), (FINER[0], SEEDS[2]), (FINER[2], SEEDS[2])):
        yield DriftRun(scene=many, variant=DRIFT_MOTIONS[name], seed=seed)


def carried() -> Iterator[Case]:
    """Points that move with their triangulation, also with shorter steps and with an entropy-stable flux."""
    for ras, heights, seeds, times, box in CARRIED:
        for ra, rows, seed in product(ras, heights, seeds):
            keep = seed == 1 and rows in (25, 40) and ra in (5e3, 1e4) and not box
            yield CarriedRun(scene=RayleighBenard(ra=ra, L=float(rows), **box), seed=seed, keep=keep, **times)
    for name, rows in product(sorted(CARRIAGES.keys() - {"moving-delaunay"}), (16, 25)):
        yield CarriedRun(scene=RayleighBenard(ra=1e4, L=float(rows)), variant=CARRIAGES[name])
    for seed in range(1, 9):        # single starts differ by as much as the flux is allowed to change
        yield CarriedRun(scene=RayleighBenard(ra=1e4, L=25.0), seed=seed,
                         variant=variant("moving-delaunay-entropy-stable"))


def on_points(where: RayleighBenard) -> Iterator[Case]:
    """All schemes on points that stay, as fine as each is run, and the one on points that move."""
    for name in sorted(SCHEMES.keys() - ELSEWHERE):
        seeds = SEEDS[:1] if "lattice" in name else SEEDS
        if where.L <= MOST.get(name, 40):
            yield from (DihRun(scene=where, variant=SCHEMES[name], seed=seed) for seed in seeds)
    # an error of first order, from the plates, shows in the finest
    finest = SEEDS[:2] if where.ra == 1e4 else ()
    yield from (MovingRun(scene=where, seed=seed) for seed in (SEEDS if where.L <= 64 else finest))


def in_space() -> Iterator[Case]:
    """A box of 2:2:1: rolls, which are those of the plane, rolls that others cross, and squares."""
    lattices = {"rolls": (16, 20, 24, 32), "crossed": (8, 12, 16, 20), "squares": (12, 16, 20, 24)}
    for start, sizes in lattices.items():
        # rolls across stronger ones fade by a half in 24 free-fall times
        case = partial(InSpace, start=start, t_end=200.0 if start == "crossed" else 120.0)
        yield from (case(scene=RayleighBenard(ra=5e3, L=float(rows))) for rows in sizes)
        yield from (case(scene=RayleighBenard(ra=5e3), n=n) for n in (13, 15, 17))
