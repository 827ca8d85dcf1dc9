"""Which methods meet which case, by size: a method is a line, a case is a line."""
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

from continuum.fluid import DenseFluid, IdealGas
from particles.run import STUDIES
from particles.weights import Lucy, Monaghan
from studies.build import variant, variants
from studies.build.spam import PRINTED
from studies.hardcases import high_ra, printed, robust, trials, tubes
from studies.hardcases.columns import COLUMNS
from studies.hardcases.extremes import LAYERS, ROWS, SITUATIONS, Smooth, Tiled, WithoutPlates, falls
from studies.hardcases.high_ra import FineGrid, HighRa, Rippled
from studies.hardcases.printed import Interface, Square
from studies.hardcases.robust import STABLE
from studies.hardcases.survival import GRID, PROBES, Hard, HardOnGrid, Probe
from studies.hardcases.tubes import BARELY, ETAS, STEPS, MethodTube
from studies.kit.case import Case

LATTICE, JITTERED = "fixed-lattice", "fixed-jittered-delaunay"
CARRIED, MOVING = "moving-delaunay", "moving"
NESTED = "fixed-lattice-nested-only"
RANDOM = (JITTERED, CARRIED, MOVING)    # whose points lie as a seed says
CHEAP = (LATTICE, JITTERED, *STABLE, CARRIED)       # enough to be tried with 32 rows
TILED = Tiled(variant(GRID))

#: name -> (what runs it, variant)
Runners = dict[str, tuple[Any, Any]]
#: tubes
IN_TUBES: Runners = {GRID: (tubes.grid, variant(GRID))} | {
    name: (tubes.points, variant(name)) for name in (LATTICE, JITTERED, CARRIED, MOVING)}
#: the highest Ra, likewise
IN_LAYERS: Runners = {
    GRID: (high_ra.on_grid, ROWS),
    LATTICE: (high_ra.on_points, Rippled(variant(LATTICE))),
    JITTERED: (high_ra.on_points, Rippled(variant(JITTERED))),
    **{name: (high_ra.on_points, variant(name)) for name in (CARRIED, MOVING)},
}


def smooth(*names: str) -> dict[str, Any]:
    """Smooth particles by their names."""
    return {name: Smooth(chosen) for name, chosen in variants(*names).items()}


#: the map: name -> what has ready(scene)
SPAM = smooth("spam", "spam-wendland-c2", "spam-corrected")
POINTS = variants(LATTICE, NESTED, JITTERED, *STABLE)
MOVE = variants("moving-literal", "moving-constant-mass", MOVING)
TRIANGLES = variants(CARRIED)
USUAL = SPAM | POINTS | MOVE | TRIANGLES
#: of the vortex and the strip: held rows stick even without viscosity, as the plates of smooth particles do
NO_PLATES = {**USUAL, GRID: TILED,
             **{name: WithoutPlates(USUAL[name]) for name in (*SPAM, CARRIED, STABLE[-1])}}
#: case -> who takes part in place of the usual ones
TAKES: dict[str, dict[str, Any]] = {
    **dict.fromkeys(("Ra 1e7", "Ra 1e8"), variants(*CHEAP, MOVING) | smooth("spam", "spam-corrected")),
    "disordered points": variants(LATTICE, JITTERED, *STABLE, "fixed-random-delaunay", "fixed-jittered-plain",
                                  "fixed-jittered-closed", CARRIED),
    "narrow weight": variants(LATTICE)
    | {f"spam-range-{h:g}": Smooth(PRINTED._replace(h=h)) for h in (0.9, 1.2, 1.5, 2.0)}
    | {f"fixed-lattice-h{h:g}": variant(LATTICE)._replace(h=h) for h in (0.9, 1.2, 1.5)},
    "zero viscosity": NO_PLATES,
    "vacuum": NO_PLATES,
    "wall corner": SPAM | TRIANGLES | variants(LATTICE, JITTERED, *STABLE)
    | smooth("spam-walls-odd", "spam-walls-own-pressure", "spam-direct")
    | {"spam-no-walls": WithoutPlates(Smooth(PRINTED))},
    "long rest": variants(LATTICE, JITTERED, CARRIED),
    "a million points": {name: NO_PLATES[name] for name in (GRID, "spam")} | TRIANGLES,
}


#: case -> who is asked for a number in it: densities that alternate no smooth particle has, and no node of
#: the grid sees
PROBED = dict.fromkeys(PROBES, USUAL | {GRID: TILED})
PROBED["alternating densities"] = variants(LATTICE, JITTERED, *STABLE, CARRIED, MOVING)

#: layers that are tried with 32 rows, too
TALL = ("Ra 1e5", "Ra 1e6", "Ra 1e7", "Ra 1e8", "Prandtl 0.01", "Prandtl 100", "high pressure")
LENGTHS = (24, 36, 48, 72, 96, 144, 192)
MORE_SEEDS = 16         # of the longest viscous tube of smooth particles, whose ringing is near its limit
MORE_MOVING = 12        # the same of moving points, whose error is near its limit
MORE_STARTS = 8         # of the search with moving points at the usual step, which scatters
#: scale, k a, number of seeds
RIPPLES = ((1.0, 0.25, 3), (1.0, 0.75, 3), (2.0, 0.25, 8), (4.0, 0.25, 7))
#: case -> rows of grids between plates; more where three left undecided what is a tenth off
ON_GRIDS = {**dict.fromkeys(LAYERS, (16, 32, 48)), "Ra 1e5": (16, 32, 48, 64, 96),
            "high pressure": (16, 32, 48, 64, 96, 128), "wall corner": (12,), "long rest": (ROWS,)}


def cases(size: str) -> Iterator[Case]:
    """All of them; `quick` is for trying the path out."""
    return quick() if size == "quick" else paper()


def quick() -> Iterator[Case]:
    """A few of each kind that takes seconds."""
    yield from smooth_tubes((12, 15, 18), (0.0, 0.5), (1,))
    yield from method_tubes((12, 15, 18), 1)
    yield Interface(scale=0.5)
    scene, time = SITUATIONS["Prandtl 100"]
    yield Hard(case="Prandtl 100", method=LATTICE, variant=variant(LATTICE), scene=scene, time=time/10)
    for method in (LATTICE, STABLE[0]):
        yield trials.Trial(case="Toro 2", scene=COLUMNS["Toro 2"].scene, method=method, rows=20)


def paper() -> Iterator[Case]:
    """Squares with the printed viscosities, what pairs also nearer to onset, at 5012; all else in turn."""
    for (eos, ra), weight in product(((IdealGas(), 67150.0), (DenseFluid(), 511200.0)), (Monaghan, Lucy)):
        yield Square(eos=eos, weight=weight, ra=ra, t_end=25.0, mean_from=15.0)
    yield Square(weight=Monaghan, ra=1e4, t_end=40.0, mean_from=30.0)
    yield from smooth_tubes(LENGTHS, (0.0, 0.5), range(1, 4))
    yield from smooth_tubes(LENGTHS[-1:], (0.5,), range(4, MORE_SEEDS + 1))
    yield from method_tubes(LENGTHS[:5], 3)
    attempt, moving = IN_LAYERS[MOVING]
    for seed in range(4, MORE_MOVING + 1):
        yield MethodTube(method=MOVING, tube=tubes.points, variant=moving, eta=max(ETAS), L=96, seed=seed)
    for seed in range(4, MORE_STARTS + 1):
        yield HighRa(method=MOVING, attempt=attempt, variant=moving, seed=seed)
    for method, eta, L in product(STABLE, ETAS, (48, 96)):      # whose steps are as short as they need anyway
        yield MethodTube(method=method, tube=tubes.points, variant=variant(method), eta=eta, L=L)
    for scale, steep, last in RIPPLES:
        for seed in range(1, last + 1):
            yield Interface(scale=scale, steep=steep, seed=seed)
    yield from highest()
    yield from hard()
    yield from robust.cases()
    yield from trials.cases()


def smooth_tubes(lengths: Sequence[int], etas: Sequence[float], seeds: Iterable[int]) -> Iterator[Case]:
    """Smooth particles; profiles of the longest."""
    for L, eta, seed in product(lengths, etas, seeds):
        yield MethodTube(method="spam", tube=printed.smooth, variant=Lucy, eta=eta, L=L, seed=seed,
                         step=STUDIES, keep=L == max(lengths) and seed == 1)


def method_tubes(lengths: Sequence[int], seeds: int) -> Iterator[Case]:
    """All methods, viscosities, lengths; several seeds of disordered points in the most viscous gas, and
    of the longest tube that may ring.
    """
    for (method, (tube, chosen)), eta, step, L in product(IN_TUBES.items(), ETAS, tubes.STEPS, lengths):
        several = eta == max(ETAS) or (eta, L, step) == (BARELY, max(lengths), max(STEPS))
        last = seeds if method in RANDOM and several else 1
        for seed in range(1, last + 1):
            yield MethodTube(method=method, tube=tube, variant=chosen, eta=eta, L=L, seed=seed, step=step,
                             keep=L == max(lengths) and seed == 1)


def highest() -> Iterator[Case]:
    """Five starts each, three of the moving points, which cost most; `paper` has more."""
    yield FineGrid()
    for (method, (attempt, chosen)), step in product(IN_LAYERS.items(), high_ra.STEPS):
        for seed in range(1, 4 if method == MOVING else 6):
            yield HighRa(method=method, attempt=attempt, variant=chosen, seed=seed, step=step)


def hard() -> Iterator[Case]:
    """Layers and boxes, in a corner nothing moves but for round-off; numbers that are known."""
    for case, (scene, time) in SITUATIONS.items():
        for rows in ON_GRIDS.get(case, ()):
            yield HardOnGrid(case=case, scene=scene, time=time, rows=rows)
        for method, chosen in TAKES.get(case, USUAL).items():
            yield Hard(case=case, method=method, variant=chosen, scene=scene, time=time)
    for case in TALL:
        small, time = SITUATIONS[case]
        scene = replace(small, L=2.0*ROWS)
        later = time*falls(scene, 1.0)/falls(small, 1.0)
        for method, chosen in variants(*CHEAP).items():
            yield Hard(case=case, method=method, variant=chosen, scene=scene, time=later)
    for case, takes in PROBED.items():
        for method, chosen in takes.items():
            yield Probe(case=case, method=method, variant=chosen, question=PROBES[case])
