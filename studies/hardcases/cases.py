"""Which methods meet which case, by size: a method is a line, a case is a line."""
from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import Any

from continuum.fluid import DenseFluid, IdealGas
from continuum.gas.ghosts import FluxForm
from particles.run import STUDIES
from particles.weights import Lucy, Monaghan
from studies.build import variant, variants
from studies.build.setting import positions
from studies.build.spam import PRINTED
from studies.hardcases import high_ra, largest_step, tubes
from studies.hardcases.extremes import LAYERS, ROWS, SITUATIONS, Inside, Open, Smooth, Tiled
from studies.hardcases.fig10 import Square
from studies.hardcases.high_ra import FineGrid, HighRa, Rippled, Steadiness
from studies.hardcases.interface import Interface
from studies.hardcases.largest_step import Limit
from studies.hardcases.survival import GRID, SAMPLES, Hard, HardOnGrid, ShearWave, marched
from studies.hardcases.tubes import ETAS, MethodTube
from studies.kit.case import Case

LATTICE, JITTERED, MOVING = "fixed-lattice", "fixed-jittered-delaunay", "moving"
NESTED, NO_WALLS = "fixed-lattice-nested-only", "spam-no-walls"
RANDOM = (JITTERED, MOVING)     # whose points lie as a seed says
TILED = Tiled(variant(GRID))

#: name -> (what runs it, variant)
Runners = dict[str, tuple[Any, Any]]
#: tubes
IN_TUBES: Runners = {GRID: (tubes.grid, FluxForm())} | {
    name: (tubes.points, variant(name)) for name in (LATTICE, JITTERED, MOVING)}
#: the highest Ra, likewise
IN_LAYERS: Runners = {
    GRID: (high_ra.on_grid, ROWS),
    LATTICE: (high_ra.on_points, Rippled(variant(LATTICE))),
    JITTERED: (high_ra.on_points, Rippled(variant(JITTERED))),
    MOVING: (high_ra.on_points, variant(MOVING)),
}
#: limits of the step, likewise; at h = 3 the lattice of drifting points itself gives way
AT_REST: Runners = {
    GRID: (largest_step.on_grid, FluxForm()),
    "spam-range-2.5": (largest_step.spam, PRINTED._replace(h=2.5)),
    "spam-wendland-c2-range-4": (largest_step.spam, variant("spam-wendland-c2")._replace(h=4.0)),
    "spam-direct-range-2.5": (largest_step.spam, variant("spam-direct")._replace(h=2.5)),
    **{name: (largest_step.fixed, variant(name)) for name in (LATTICE, NESTED, JITTERED)},
    "moving-literal-h4": (largest_step.drifting, variant("moving-literal")._replace(h=4.0)),
    "moving-constant-mass-h4": (largest_step.drifting, variant("moving-constant-mass")._replace(h=4.0)),
    MOVING: (largest_step.moving, variant(MOVING)),
}


def smooth(*names: str) -> dict[str, Any]:
    """Smooth particles by their names."""
    return {name: Smooth(chosen) for name, chosen in variants(*names).items()}


#: the map: name -> what has ready(scene)
SPAM = smooth("spam", "spam-wendland-c2")
MOVE = variants("moving-literal", "moving-constant-mass", MOVING)
#: those that are tried on all layers and on the vortex
USUAL = SPAM | variants(LATTICE, NESTED, JITTERED) | MOVE
DISORDERED = variants(LATTICE, JITTERED, "fixed-random-delaunay", "fixed-jittered-plain",
                      "fixed-jittered-closed")
NARROW = {f"spam-range-{h:g}": Smooth(PRINTED._replace(h=h)) for h in (0.9, 1.2, 1.5, 2.0)} | {
    f"fixed-lattice-h{h:g}": variant(LATTICE)._replace(h=h) for h in (0.9, 1.2, 1.5)} | variants(LATTICE)
CORNERS = SPAM | {NO_WALLS: Smooth(PRINTED)} | smooth(
    "spam-walls-odd", "spam-walls-own-pressure", "spam-direct")


def positions_inside(width: float, height: float, size: float, seed: int) -> Any:
    """Points that keep away from where plates would be, on a torus too."""
    return positions(width, height, size, seed)


MOVE_INSIDE = {name: Inside(motion) for name, motion in MOVE.items()}
FIXED_INSIDE = {LATTICE: variant(LATTICE), JITTERED: variant(JITTERED)._replace(points=positions_inside)}
SHEARED = SPAM | MOVE_INSIDE | FIXED_INSIDE
#: which methods take which case; all others take the usual ones
TAKES: dict[str, dict[str, Any]] = {
    "disordered points": DISORDERED, "narrow weight": NARROW, "wall corner": CORNERS}

WITHOUT_PLATES = ("zero viscosity", "vacuum")       # for smooth particles and the grid

LENGTHS = (24, 36, 48, 72, 96, 144, 192)
MORE_SEEDS = 16         # of the longest viscous tube of smooth particles, whose ringing is near its limit
METHOD_LENGTHS = (24, 36, 48, 72, 96)
#: scale, k a, number of seeds
RIPPLES = ((1.0, 0.25, 3), (1.0, 0.75, 3), (2.0, 0.25, 8), (4.0, 0.25, 7))
#: viscosity and conductivity, spacing times speed of sound is 1.4: what the step is limited by
FLUIDS = {"zero viscosity": (0.0, 0.0), "balanced": (0.3, 0.3), "Prandtl 0.01": (0.05, 5.0),
          "Prandtl 100": (5.0, 0.05)}
SLOW = (MOVING, "spam-direct-range-2.5")         # methods in two of them only
GRIDS = (ROWS, 2*ROWS, 3*ROWS)
#: where three left undecided what is a tenth off
MORE_GRIDS = {"Ra 1e5": (4*ROWS, 6*ROWS), "high pressure": (4*ROWS, 6*ROWS, 8*ROWS)}


def cases(size: str) -> Iterator[Case]:
    """All of them; `quick` is for trying the path out."""
    if size == "quick":
        yield from quick()
        return
    yield from squares()
    yield from smooth_tubes(LENGTHS, (0.0, 0.5), range(1, 4))
    yield from smooth_tubes(LENGTHS[-1:], (0.5,), range(4, MORE_SEEDS + 1))
    yield from method_tubes(METHOD_LENGTHS, 3)
    yield from interfaces(RIPPLES)
    yield from highest()
    yield from limits(AT_REST, FLUIDS)
    yield from hard()
    yield from shear_waves()
    yield Steadiness(ra=3.5e5, rows=ROWS)


def quick() -> Iterator[Case]:
    """A few of each kind that takes seconds."""
    yield from smooth_tubes((12, 15, 18), (0.0, 0.5), (1,))
    yield from method_tubes((12, 15, 18), 1)
    yield from interfaces(((0.5, 0.25, 1),))
    yield from limits((GRID, "spam-range-2.5", LATTICE), ("balanced",))
    scene, time = SITUATIONS["Prandtl 100"]
    yield Hard(case="Prandtl 100", method=LATTICE, variant=variant(LATTICE), scene=scene, time=time/10)


def squares() -> Iterator[Case]:
    """Both weights and fluids with the printed viscosities; what pairs also nearer to onset, at 5012."""
    fluids = (IdealGas(), 67150.0), (DenseFluid(), 511200.0)
    for (eos, ra), weight in product(fluids, (Monaghan, Lucy)):
        yield Square(eos=eos, weight=weight, ra=ra, t_end=25.0, mean_from=15.0)
    yield Square(weight=Monaghan, ra=1e4, t_end=40.0, mean_from=30.0)


def interfaces(ripples: Iterable[tuple[float, float, int]]) -> Iterator[Case]:
    """All seeds of some sizes and steepnesses."""
    for scale, steep, last in ripples:
        for seed in range(1, last + 1):
            yield Interface(scale=scale, steep=steep, seed=seed)


def smooth_tubes(lengths: Sequence[int], etas: Sequence[float], seeds: Iterable[int]) -> Iterator[Case]:
    """Smooth particles; profiles of the longest."""
    for L, eta, seed in product(lengths, etas, seeds):
        yield MethodTube(method="spam", tube=tubes.smooth, variant=Lucy, eta=eta, L=L, seed=seed,
                         step=STUDIES, keep=L == max(lengths) and seed == 1)


def method_tubes(lengths: Sequence[int], seeds: int) -> Iterator[Case]:
    """All methods, viscosities, lengths; several seeds of disordered points in the most viscous gas."""
    for (method, (tube, chosen)), eta, step, L in product(IN_TUBES.items(), ETAS, tubes.STEPS, lengths):
        last = seeds if method in RANDOM and eta == max(ETAS) else 1
        for seed in range(1, last + 1):
            yield MethodTube(method=method, tube=tube, variant=chosen, eta=eta, L=L, seed=seed, step=step,
                             keep=L == max(lengths) and seed == 1)


def highest() -> Iterator[Case]:
    """Five starts each, three of the moving points, which cost most."""
    yield FineGrid()
    for (method, (attempt, chosen)), step in product(IN_LAYERS.items(), high_ra.STEPS):
        for seed in range(1, 4 if method == MOVING else 6):
            yield HighRa(method=method, attempt=attempt, variant=chosen, seed=seed, step=step)


def limits(methods: Any, scenes: Any) -> Iterator[Case]:
    """Of the time step."""
    for method, scene in product(methods, scenes):
        trial, chosen = AT_REST[method]
        eta, k = FLUIDS[scene]
        if method not in SLOW or scene in ("balanced", "Prandtl 100"):
            yield Limit(method=method, trial=trial, variant=chosen, scene=scene, eta=eta, k=k)


def hard() -> Iterator[Case]:
    """Layers and boxes; a flow without plates has none for smooth particles and for the grid, either."""
    for case, (scene, time) in LAYERS.items():
        for rows in GRIDS + MORE_GRIDS.get(case, ()):
            yield HardOnGrid(case=case, scene=scene, time=time, rows=rows)
    for case, (scene, time) in SITUATIONS.items():
        for method, chosen in TAKES.get(case, USUAL).items():
            without = isinstance(chosen, Smooth) and case in WITHOUT_PLATES
            place = Open(scene) if without or method == NO_WALLS else scene
            yield Hard(case=case, method=method, variant=chosen, scene=place, time=time)
    for case in WITHOUT_PLATES:
        yield Hard(case=case, method=GRID, variant=TILED, follow=marched, **SITUATIONS[case]._asdict())
    scene, time = SITUATIONS["wall corner"]     # nothing moves but for round-off
    yield HardOnGrid(case="wall corner", scene=scene, time=time, rows=round(scene.L), energy=0.0)


def shear_waves() -> Iterator[Case]:
    """All methods that take a torus."""
    for method, chosen in SHEARED.items():
        yield ShearWave(method=method, variant=chosen)
    yield ShearWave(method=GRID, variant=TILED, follow=marched, samples=SAMPLES)
