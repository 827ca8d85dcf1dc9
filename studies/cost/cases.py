"""Which methods take part in which scene, at which resolutions.

taylor-green   a vortex of Mach 0.05 and Re 100 that decays by e; against the gas of that Mach number
sound          a wave of small amplitude for two periods
conduction, couette   between plates, from smooth starts; nothing depends on x
convection     Rayleigh-Benard at Ra = 10 000, and 5000, from KHP95's rolls

Every method runs at rising resolutions, each at the longest step that is good enough beside the error of its
space (rule: problem.py; py-pde's is by its formula). CPU seconds of one thread, medians of repeats, without
compiling. A case takes DEAREST seconds at most, all take TOGETHER. `paper` takes an hour, `quick` minutes.
"""
from collections.abc import Collection, Iterator, Mapping
from itertools import product
from typing import Any, NamedTuple

from continuum.exact.plates import FLOWS
from studies.build import variant, variants
from studies.build.names import START_JITTER
from studies.build.spam import OF_LIMIT
from studies.cost import pypde, rolls
from studies.cost.contestants import (
    DecayingVortex,
    SlabFlow,
    StandingWave,
    of_mean_one,
    on_grid,
    on_lattice,
    on_mac,
    particles,
    points,
    restless,
    trembling,
)
from studies.cost.pypde import SolverRace
from studies.cost.race import Entry, Price, Race
from studies.cost.rolls import LATE, LOWER_RA, SETTLED, HeatedLayer
from studies.cost.seconds import Flock, StepTime, TwoThreads, Web
from studies.cost.tables import (
    AS_MOVING,
    GRID,
    JITTERED,
    LATTICE,
    LESS_STATIC,
    LUCY,
    MAC,
    MONAGHAN,
    MOVING,
    NEAREST,
    ON_TORUS,
    PYPDE,
    WENDLAND,
    WIDE,
)
from studies.kit.case import Case

DEAREST, TOGETHER = 300.0, 55*60.0   # seconds
FAST = 0.001        # seconds of timings of size quick
TWO, THREE = (1, 2), (1, 2, 3)          # seeds
RUNGS = (8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
ROWS = (22, 30, 40, 53, 71, 95, 126, 168, 224, 299, 398, 531, 707)      # a thousand points to a million
Entries = dict[str, Entry]


# --- who takes part -----------------------------------------------------------------------------------------

LATTICES = variants(NEAREST, LATTICE, WIDE)
STAYING = {**LATTICES, **variants(ON_TORUS)}
HELD = {**LATTICES, **variants(JITTERED)}
SHAKEN = {**LATTICES, AS_MOVING: variant(JITTERED)._replace(size=START_JITTER)}
PARTICLES = variants(LUCY, MONAGHAN, WENDLAND)
MORE_PARTICLES = {**PARTICLES, **variants(LESS_STATIC)}
POINTS_THAT_MOVE = variants(MOVING)
CELLS = variants(GRID)


def entries(methods: Mapping[str, Any], *rest: Any) -> Entries:
    """Methods by name, with the rest of what an entry has: a flow, `make`, price, first step."""
    return {name: Entry(name, rest[0], method, *rest[1:]) for name, method in methods.items()}


def vortex(mach: float = 0.05) -> Entries:
    """In the vortex."""
    flow = DecayingVortex(mach)
    return {
        **entries(STAYING, flow, points, Price(0.5, 1.3e-5, 3)),
        **entries(PARTICLES, flow, trembling, Price(1.3, 1e-4, 3), 0.7),
        **entries(POINTS_THAT_MOVE, flow, points, Price(0.5, 1.8e-4, 3)),
        **entries(CELLS, flow, on_grid, Price(0.5, 8e-6, 3)),
        **entries({MAC: None}, flow, on_mac, Price(0.3)),
        **entries({PYPDE: None}, flow, pypde.vortex, Price(5, 3e-5, 3)),
    }


def wave() -> Entries:
    """In sound."""
    flow = StandingWave()
    return {
        **entries(STAYING, flow, points, Price(0.5, 7e-5)),
        **entries(PARTICLES, flow, particles, Price(1.5, 7e-4)),
        **entries(POINTS_THAT_MOVE, flow, on_lattice, Price(0.3, 2.7e-4)),
        **entries(CELLS, flow, on_grid, Price(0.3, 3e-5)),
    }


def between(flow: SlabFlow, methods: Mapping[str, Any]) -> Entries:
    """Between plates."""
    return {
        **entries(CELLS, flow, of_mean_one, Price(0.5, 7e-5)),
        **entries(methods, flow, points, Price(0.5, 1.3e-4)),
        **entries(PARTICLES, flow, restless, Price(1.7), 0.7),
    }


def convection(flow: HeatedLayer = HeatedLayer()) -> Entries:  # noqa: B008 (immutable)
    """In convection."""
    moving, smooth = (flow._replace(late=late) for late in (SETTLED, LATE))
    return {
        **entries(HELD, flow, rolls.on_points, Price(1, 5.3e-4, 3)),
        **entries(MORE_PARTICLES, smooth, rolls.of_particles, Price(4, 6.8e-4, 3), 2*OF_LIMIT),
        **entries(POINTS_THAT_MOVE, moving, rolls.on_points, Price(1, 2.1e-3, 3), 1.0),
        **entries(CELLS, flow, rolls.on_grid, Price(0.3, 7e-5, 3)),
    }


#: scene -> entries by name; at half the Rayleigh number those two that decide what fixed points cost
CONTESTS = {
    "taylor-green": vortex(),
    "sound": wave(),
    "conduction": between(SlabFlow(FLOWS["conduction"]), {**SHAKEN, **POINTS_THAT_MOVE}),
    "couette": between(SlabFlow(FLOWS["couette"]), SHAKEN),      # plates of moving points do not slide
    "convection": convection(),
    "convection-5000": convection(HeatedLayer(ra=LOWER_RA)),
}


# --- at which resolutions -----------------------------------------------------------------------------------


class Ladder(NamedTuple):
    """Rising resolutions of some methods in a scene."""
    scene: str
    names: Collection[str]
    resolutions: tuple[int, ...]
    seeds: tuple[int, ...] = (1,)
    kind: type[Race] = Race

    def cases(self, contest: Entries, **more: Any) -> Iterator[Race]:
        """Of the methods of a contest."""
        for name, resolution, seed in product(self.names, self.resolutions, self.seeds):
            yield self.kind(scene=self.scene, entry=contest[name], resolution=resolution, seed=seed, **more)


def rungs(least: int, most: int) -> tuple[int, ...]:
    """The usual ones from the least to the most."""
    return tuple(rung for rung in RUNGS if least <= rung <= most)


LADDERS = (
    Ladder("taylor-green", (NEAREST, WIDE, MAC), rungs(16, 64)),
    Ladder("taylor-green", (LATTICE,), rungs(16, 192)),
    Ladder("taylor-green", (GRID,), rungs(16, 128)),
    Ladder("taylor-green", (PYPDE,), rungs(16, 64), kind=SolverRace),
    Ladder("taylor-green", (ON_TORUS,), rungs(16, 64), THREE),
    Ladder("taylor-green", PARTICLES, rungs(12, 32)),       # they are far off at any resolution
    Ladder("taylor-green", (MOVING,), rungs(12, 48), TWO),
    Ladder("sound", LATTICES, rungs(16, 128)),
    Ladder("sound", (MOVING,), rungs(16, 192)),
    Ladder("sound", (GRID,), rungs(16, 256)),
    Ladder("sound", PARTICLES, rungs(16, 64)),
    Ladder("sound", (ON_TORUS,), rungs(16, 128), THREE),
    Ladder("conduction", (GRID, *LATTICES), rungs(8, 96)),
    Ladder("conduction", PARTICLES, (16, *rungs(32, 96))),      # they err alike at any resolution
    Ladder("conduction", (AS_MOVING, MOVING), rungs(8, 64), THREE),
    Ladder("couette", (GRID, *LATTICES), rungs(8, 96)),
    Ladder("couette", PARTICLES, (16, *rungs(32, 96))),
    Ladder("couette", (AS_MOVING,), rungs(8, 64), THREE),
    Ladder("convection", (GRID,), (*rungs(8, 16), 20, 24, 32, 40, 48, 64, 88)),
    Ladder("convection", LATTICES, rungs(12, 48)),
    Ladder("convection", (JITTERED,), (*rungs(12, 32), 40), TWO),
    Ladder("convection", (MOVING,), (10, *rungs(12, 32), 44)),
    Ladder("convection", (LUCY,), (16, 20, 25, 30)),
    Ladder("convection", (MONAGHAN, WENDLAND, LESS_STATIC), (12, 16, 20, 25)),
    Ladder("convection-5000", (GRID,), rungs(8, 48)),
    Ladder("convection-5000", (NEAREST,), (8, 10, *rungs(12, 48))),     # K: 1 % at ten rows already
)


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    return list(quick() if size == "quick" else paper())


def paper() -> Iterator[Case]:
    """All; two threads from 20 000 points on."""
    for ladder in LADDERS:
        yield from ladder.cases(CONTESTS[ladder.scene])
    for rows in ROWS:
        yield StepTime(name=LUCY, kind=Flock, rows=rows)
        yield StepTime(name=LATTICE, kind=Web, rows=rows, a_point=2.5e-5)
    for rows in (100, 224):
        yield TwoThreads(name=LUCY, rows=rows)


def quick() -> Iterator[Case]:
    """A few methods on small scenes, against coarse references."""
    small = convection(HeatedLayer(rows=(8, 10, 12)))
    yield from Ladder("taylor-green", (NEAREST, MAC), (16, 20, 24)).cases(vortex(0.2), short=FAST)
    yield from Ladder("sound", (NEAREST,), rungs(16, 32)).cases(wave(), short=FAST)
    for scene in ("conduction", "couette"):
        yield from Ladder(scene, (GRID, LATTICE), (8, 12, 16)).cases(CONTESTS[scene], short=FAST)
    yield from Ladder("convection", (GRID, LATTICE), (8, 10, 12)).cases(small, short=FAST)
    for rows in (16, 22, 32):
        yield StepTime(name=LUCY, kind=Flock, rows=rows, short=FAST)
        yield StepTime(name=LATTICE, kind=Web, rows=rows, a_point=2.5e-5, short=FAST)
