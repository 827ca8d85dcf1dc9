"""Which methods run in which hard case, by size; each method and each case is one line."""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Any

from continuum.fluid import DenseFluid, IdealGas
from particles.weights import Lucy, Monaghan
from studies.build import SCENES, duration, variant, variants, with_rows
from studies.build.spam import PRINTED, Variant
from studies.build.stable import BODIES
from studies.hardcases import columns, extremes, high_ra, impacts, runs
from studies.hardcases.columns import BLENDED, CARRIED, COLUMNS, EDGES, HELD, JITTERED, LATTICE, PAIRS, STABLE
from studies.hardcases.extremes import ALTERNATING, CHESSBOARD, LAYERS, ROWS, SITUATIONS, OnGrid, falls
from studies.hardcases.high_ra import HighRa
from studies.hardcases.printed import Interface, Square
from studies.hardcases.runs import GRID, By, Hard, without_plates
from studies.kit.case import Case

MOVING = "moving"
NESTED = "fixed-lattice-nested-only"
CHEAP = (LATTICE, JITTERED, *STABLE, CARRIED)       # cheap enough for 32 rows
TILED = By(runs.tiled, variant(GRID))

#: name of a method -> what sets it up, by ready(scene, seed)
Entrants = dict[str, Any]
#: the highest Ra: method -> function that runs it at one Ra, and the variant that this function takes
IN_LAYERS: dict[str, tuple[Any, Any]] = {
    GRID: (high_ra.on_grid, ROWS),
    **{name: (high_ra.on_points, By(high_ra.rippled, variant(name))) for name in (LATTICE, JITTERED)},
    **{name: (high_ra.on_points, variant(name)) for name in (CARRIED, MOVING)},
}


def smooth(*names: str) -> Entrants:
    """Smooth particles by their names, set up by `runs.smooth`."""
    return {name: By(runs.smooth, chosen) for name, chosen in variants(*names).items()}


#: methods of the map
SPAM = smooth("spam", "spam-wendland-c2", "spam-corrected")
POINTS = variants(LATTICE, NESTED, JITTERED, *STABLE)
MOVE = variants("moving-literal", "moving-constant-mass", MOVING)
TRIANGLES = variants(CARRIED)
USUAL = SPAM | POINTS | MOVE | TRIANGLES
#: methods for vortex and strip, without plates where these, or held rows, stick even at zero viscosity
NO_PLATES = {**USUAL, GRID: TILED,
             **{name: By(without_plates, USUAL[name]) for name in (*SPAM, CARRIED, STABLE[-1])}}
#: case -> methods that run in it in place of `USUAL`
TAKES: dict[str, Entrants] = {
    **dict.fromkeys(("Ra 1e7", "Ra 1e8"), variants(*CHEAP, MOVING) | smooth("spam", "spam-corrected")),
    "disordered points": variants(LATTICE, JITTERED, *STABLE, "fixed-random-delaunay", "fixed-jittered-plain",
                                  "fixed-jittered-closed", CARRIED),
    "zero viscosity": NO_PLATES,
    "vacuum": NO_PLATES,
    "wall corner": SPAM | TRIANGLES | variants(LATTICE, JITTERED, *STABLE)
    | smooth("spam-walls-odd", "spam-walls-own-pressure", "spam-direct")
    | {"spam-no-walls": By(without_plates, By(runs.smooth, PRINTED))},
    "long rest": variants(LATTICE, JITTERED, CARRIED),
    "a million points": {name: NO_PLATES[name] for name in (GRID, "spam")} | TRIANGLES,
}
#: methods whose densities can alternate: smooth particles have none, and nodes of the grid do not see them
ALTERNATE = variants(LATTICE, JITTERED, *STABLE, CARRIED, MOVING)
#: methods of the trials (known answer, no viscosity); of today's smooth particles the consistent one
TRIED = (GRID, LATTICE, JITTERED, CARRIED, MOVING, "spam", "spam-corrected", *STABLE)
#: (method, case) -> further sizes
LARGER = {**{(name, "Sod"): (200,) for name in STABLE}, (STABLE[0], "Sod"): (200, 400),
          (STABLE[0], "Mach 10"): (400,), (HELD, "Mach 3 body"): (192,), (STABLE[0], "100 turns"): (32,),
          **{(name, "shocked ripple"): (800,) for name in (STABLE[0], BLENDED)}}
ROOMY = 2*impacts.HEIGHT     # where gases part, points that move are 3 spacings apart, and reach half of that
#: smooth flows: scene, rows, methods; convection of moving points, which takes several starts, is in study rb
FLOWS = (("rayleigh-benard", (48, 64), EDGES[:1]),
         ("taylor-green", (32, 64), EDGES), ("sound", (32,), EDGES))

#: layers that also run with 32 rows
TALL = ("Ra 1e5", "Ra 1e6", "Ra 1e7", "Ra 1e8", "Prandtl 0.01", "Prandtl 100", "high pressure")
MORE_STARTS = 8         # starts of the search with moving points at the usual step, whose limits scatter
#: shocked interface: scale, k a, number of seeds
RIPPLES = ((1.0, 0.25, 3), (1.0, 0.75, 3), (2.0, 0.25, 8), (4.0, 0.25, 7))
#: case -> rows of grids between plates; more where three grids do not decide what is off by a tenth
ON_GRIDS = {**dict.fromkeys(LAYERS, (16, 32, 48)), "Ra 1e5": (16, 32, 48, 64, 96),
            "high pressure": (16, 32, 48, 64, 96, 128), "wall corner": (12,), "long rest": (ROWS,)}


def cases(size: str) -> Iterator[Case]:
    """All cases of a size; `quick` only tries out that everything runs."""
    return quick() if size == "quick" else paper()


def quick() -> Iterator[Case]:
    """A few cases of each kind that takes seconds only."""
    yield Interface(scale=0.5)
    scene, time = SITUATIONS["Prandtl 100"]
    yield survival("Prandtl 100", LATTICE, variant(LATTICE), scene, time/10)
    for method in (LATTICE, STABLE[0]):
        yield trial("Toro 2", method, variant(method), 20)


def paper() -> Iterator[Case]:
    """All cases. Squares have the printed viscosities; the gas that pairs also runs nearer to onset, 5012."""
    for (eos, ra), weight in product(((IdealGas(), 67150.0), (DenseFluid(), 511200.0)), (Monaghan, Lucy)):
        yield Square(eos=eos, weight=weight, ra=ra, t_end=25.0, mean_from=15.0)
    yield Square(weight=Monaghan, ra=1e4, t_end=40.0, mean_from=30.0)
    for scale, steep, last in RIPPLES:
        yield from (Interface(scale=scale, steep=steep, seed=seed) for seed in range(1, last + 1))
    yield from (*highest(), *hard(), *flows(), *trials())


# --- the highest Ra -----------------------------------------------------------------------------------------

def highest() -> Iterator[Case]:
    """Searches for the highest Ra, five starts each; of moving points MORE_STARTS, three in short steps."""
    for (method, (attempt, chosen)), step in product(IN_LAYERS.items(), high_ra.STEPS):
        moving = MORE_STARTS if step == high_ra.STEPS[0] else 3
        for seed in range(1, 1 + (moving if method == MOVING else 5)):
            yield HighRa(method=method, attempt=attempt, variant=chosen, seed=seed, step=step)


# --- the map ------------------------------------------------------------------------------------------------

def survival(case: str, method: str, entrant: Any, scene: Any, time: float) -> Hard:
    """The run of a method in a case of the map."""
    return Hard(into="hard_runs", which={"case": case, "method": method, "rows": round(scene.L)},
                entrant=entrant, scene=scene, time=time, question=extremes.SURVIVAL)


def hard() -> Iterator[Case]:
    """Cases of the map: layers and boxes (in a corner only round-off moves), and densities that alternate."""
    for case, (scene, time) in SITUATIONS.items():
        for rows in ON_GRIDS.get(case, ()):
            yield OnGrid(into="hard_runs", which={"case": case, "method": GRID, "rows": rows},
                         entrant=rows, scene=scene, time=time, question=extremes.SURVIVAL)
        for method, entrant in TAKES.get(case, USUAL).items():
            yield survival(case, method, entrant, scene, time)
    for case in TALL:
        small, time = SITUATIONS[case]
        scene = replace(small, L=2.0*ROWS)
        later = time*falls(scene, 1.0)/falls(small, 1.0)
        yield from (survival(case, name, chosen, scene, later) for name, chosen in variants(*CHEAP).items())
    for method, entrant in ALTERNATE.items():
        yield Hard(into="probes", which={"case": ALTERNATING, "method": method}, scene=CHESSBOARD, time=300.0,
                   entrant=By(without_plates, entrant), question=extremes.UNEVENNESS)


def flows() -> Iterator[Case]:
    """Smooth flows by edges without and with the entropy-stable flux, and by both of its pressures."""
    for scene, rows, names in FLOWS:
        for count, name in product(rows, names):
            yield from (flow(method, scene, count) for method in (name, PAIRS[name]))
    for name in (STABLE[0], BLENDED):
        yield flow(name, "rayleigh-benard", 24)


def flow(method: str, name: str, rows: int) -> Hard:
    """The run of a method in a smooth flow."""
    scene = SCENES[name](rows)
    times, unit = duration(scene)
    return Hard(into="smooth_flows", which={"scene": name, "method": method, "rows": rows},
                entrant=variant(method), scene=scene, time=times*unit, question=columns.SMOOTHNESS)


def trials() -> Iterator[Case]:
    """Trials: several starts and steps at the smallest size, one run at each larger size."""
    for case, column in COLUMNS.items():
        for method, chosen in (column.only or variants(*TRIED)).items():
            small, *large = *column.sizes, *LARGER.get((method, case), ())
            several = not column.only or column.only is BODIES
            chance = several and "lattice" not in method and method != GRID
            for seed in (1, 2, 3)[:3 if chance else 1]:
                yield trial(case, method, chosen, small, seed=seed)
            if not column.only:
                yield trial(case, method, chosen, small, step=0.5)
            yield from (trial(case, method, chosen, rows) for rows in large)


def trial(case: str, method: str, chosen: Any, rows: int, seed: int = 1, step: float = 1.0) -> Hard:
    """The run of a method in a case whose answer is known. step : over the usual one."""
    scene = COLUMNS[case].scene
    if method == STABLE[-1] and isinstance(scene, impacts.Strip):
        scene = replace(scene, L=ROOMY)
    scene = with_rows(scene, rows)
    way = runs.of_one_mass if isinstance(chosen, Variant) else runs.hurried
    question = columns.SWITCHING if "entropy-stable" in method else columns.AT_END
    return Hard(into="trials", entrant=By(way, chosen), scene=scene, time=scene.time, question=question,
                which={"case": case, "method": method, "rows": rows, "seed": seed, "step": step},
                seed=seed, step=step)
