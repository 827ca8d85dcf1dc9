"""Which methods take part in which scene, at which resolutions.

taylor-green   a vortex of Mach 0.05 and Re 100 that decays by e; against the gas of that Mach number
sound          a wave of small amplitude for two periods
conduction, couette   between plates, from smooth starts; nothing depends on x
convection     Rayleigh-Benard at Ra = 10 000, and 5000, from KHP95's rolls

Every method runs at rising resolutions, each with the longest step whose error is small beside that of space
(rule: problem.py; py-pde's step is by its formula). Costs are CPU seconds of one thread, medians of repeats,
without compiling. A case takes DEAREST seconds at most, all take TOGETHER. `quick` takes minutes.
"""
from collections.abc import Callable, Collection, Iterator, Mapping
from itertools import product
from typing import Any, NamedTuple

from continuum.exact.plates import FLOWS
from studies.build import variant, variants
from studies.build.names import START_JITTER
from studies.build.scenes import BetweenPlates, Sound, TaylorGreen
from studies.build.spam import OF_LIMIT
from studies.cost import contestants as of
from studies.cost import rolls
from studies.cost.contestants import ExactFlow
from studies.cost.race import Race
from studies.cost.rolls import LOWER_RA, HeatedLayer
from studies.cost.seconds import Resident, StepTime, TwoThreads
from studies.cost.solvers import SolverRace, SpectralRace, by_pypde, solved
from studies.cost.tables import CARRIED, SPECTRAL
from studies.kit.case import Case

DEAREST, TOGETHER = 300.0, 70*60.0   # seconds
FAST = 0.001        # seconds of timings of size quick
TWO, THREE, NINE = (1, 2), (1, 2, 3), tuple(range(1, 10))       # seeds
MODES = (4, 6, 8, 10, 12, 14, 16, 20, 24)     # functions along an axis
NEAR = (12, 16)         # rows with which moving points have errors about 1 %
ROWS = (22, 30, 40, 53, 71, 95, 126, 168, 224, 299, 398, 531, 707)      # a thousand points to a million


def rungs(least: int, most: int) -> tuple[int, ...]:
    """The usual resolutions from the least to the most."""
    usual = (8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
    return tuple(rung for rung in usual if least <= rung <= most)


class Team(NamedTuple):
    """Methods set up in a flow in the same way, and their resolutions. Other fields are those of `Race`."""
    methods: Mapping[str, Any]
    make: Callable
    price: float
    resolutions: tuple[int, ...]
    seeds: tuple[int, ...] = (1,)
    first: float = 0.9
    kind: type[Race] = Race


class Contest(NamedTuple):
    """A flow and all methods that take part in it."""
    flow: Any
    teams: tuple[Team, ...]

    def cases(self, scene: str, names: Collection[str] = (), resolutions: Collection[int] = (),
              **more: Any) -> Iterator[Race]:
        """All races, or those of some methods or at some resolutions."""
        for team in self.teams:
            chosen = [name for name in team.methods if name in (names or team.methods)]
            for name, rows, seed in product(chosen, resolutions or team.resolutions, team.seeds):
                yield team.kind(scene=scene, method=name, resolution=rows, seed=seed, flow=self.flow,
                                variant=team.methods[name], make=team.make, price=team.price,
                                first=team.first, **more)


LATTICES = variants("fixed-lattice-h1.2", "fixed-lattice", "fixed-lattice-h3")
TRIANGLES = variants(CARRIED)
PARTICLES = variants("spam", "spam-monaghan", "spam-wendland-c2")
#: points that stay, as disordered as moving points at the start
SHAKEN = {"fixed-jittered-0.2-plates": variant("fixed-jittered-plates")._replace(size=START_JITTER)}
#: methods whose growth of seconds is measured
MOVERS = variants("spam", CARRIED)
FAR_OFF = 16, *rungs(32, 96)        # resolutions of particles whose error is alike at all of them


def between(name: str, *more: Team) -> Contest:
    """The contest in a flow between plates."""
    return Contest(ExactFlow(BetweenPlates(flow=FLOWS[name], L=16)), (
        Team(variants("grid"), of.of_mean_one, 8.7e-6, rungs(8, 96)),
        Team(LATTICES, of.points, 1.6e-5, rungs(8, 96)),
        Team(SHAKEN, of.points, 1.6e-5, rungs(8, 64), THREE),
        Team(TRIANGLES, of.points, 1.6e-5, rungs(8, 64), THREE),
        Team(PARTICLES, of.restless, 0.0, FAR_OFF, first=0.7), *more))


#: scene -> contest: a new method is a line, a new scene an entry; convection at half the Rayleigh number has
#: only the methods that decide what points cost
CONTESTS = {
    "taylor-green": Contest(ExactFlow(TaylorGreen(L=16)), (
        Team(variants("fixed-lattice-h1.2", "fixed-lattice-h3"), of.points, 1.3e-5, rungs(16, 64)),
        Team(variants("fixed-lattice"), of.points, 1.3e-5, rungs(16, 192)),
        Team(variants("fixed-jittered-delaunay"), of.points, 1.3e-5, rungs(16, 64), THREE),
        Team(TRIANGLES, of.carried, 1.3e-5, rungs(12, 64), THREE),
        Team(variants("moving"), of.points, 1.8e-4, rungs(12, 48), TWO),
        Team(PARTICLES, of.trembling, 1e-4, rungs(12, 32), first=0.7),     # all far off
        Team(variants("grid"), of.on_grid, 8e-6, rungs(16, 128)),
        Team({"mac": None}, of.on_mac, 0.0, rungs(16, 64)),
        Team({"py-pde": None}, by_pypde, 3e-5, rungs(16, 64), kind=SolverRace))),
    "sound": Contest(ExactFlow(Sound(width=16)), (
        Team(LATTICES, of.points, 8.7e-6, rungs(16, 128)),
        Team(variants("fixed-jittered-delaunay"), of.points, 8.7e-6, rungs(16, 128), THREE),
        Team(TRIANGLES, of.points, 8.7e-6, rungs(16, 128), THREE),
        Team(variants("moving"), of.on_lattice, 3.4e-5, rungs(16, 192)),
        Team(PARTICLES, of.particles, 8.7e-5, rungs(16, 64)),
        Team(variants("grid"), of.on_grid, 3.8e-6, rungs(16, 256)))),
    # plates of moving points do not slide
    "conduction": between("conduction",
                          Team(variants("moving"), of.points, 1.6e-5, rungs(8, 64), THREE)),
    "couette": between("couette"),
    "convection": Contest(HeatedLayer(), (
        Team(variants("grid"), rolls.on_grid, 3.5e-5, (8, 12, 16, 20, 24, 32, 40, 48, 64, 88)),
        Team({SPECTRAL: None}, solved, 0.0, MODES, kind=SpectralRace),
        Team({"py-pde": None}, by_pypde, 4e-5, (*rungs(12, 16), 20, *rungs(24, 48)), kind=SolverRace),
        Team(LATTICES, rolls.on_points, 2.6e-4, rungs(12, 48)),
        Team(variants("fixed-jittered-plates"), rolls.on_points, 2.6e-4, (*rungs(12, 32), 40), TWO),
        Team(TRIANGLES, rolls.on_triangles, 1.7e-4, (8, 10, *rungs(24, 48)), THREE),
        Team(TRIANGLES, rolls.on_triangles, 1.7e-4, (24,), tuple(range(4, 16))),     # for 1 % of velocity
        Team(TRIANGLES, rolls.on_triangles_long, 4e-4, NEAR, NINE),
        Team(variants("moving"), rolls.on_moving, 1e-3, (10, *rungs(12, 32), 44), first=1.0),
        Team(variants("spam"), rolls.of_particles, 3.4e-4, (16, 20, 25, 30), first=2*OF_LIMIT),
        Team(variants("spam-corrected"), rolls.of_particles, 3.4e-4, (20, 25, 30, 36, 44), first=2*OF_LIMIT),
        Team(variants("spam-sumB"), rolls.of_particles, 3.4e-4, (20, 25, 30, 36), first=2*OF_LIMIT),
        Team(variants("spam-monaghan", "spam-wendland-c2", "spam-less-static-50"), rolls.of_particles, 3.4e-4,
             (12, 16, 20, 25), first=2*OF_LIMIT))),
    "convection-5000": Contest(HeatedLayer(ra=LOWER_RA), (
        Team(variants("grid"), rolls.on_grid, 3.5e-5, rungs(8, 48)),
        Team(TRIANGLES, rolls.on_triangles, 1.7e-4, (8, 10, 24, 32), THREE),
        Team(TRIANGLES, rolls.on_triangles_long, 4e-4, NEAR, NINE),
        Team(variants("fixed-lattice-h1.2"), rolls.on_points, 2.6e-4, (8, 10, *rungs(12, 48))))),
}
#: size quick: scene -> flow with a coarser reference, methods, resolutions
QUICK: dict[str, tuple[Any, tuple[str, ...], tuple[int, ...]]] = {
    "taylor-green": (ExactFlow(TaylorGreen(L=16, mach=0.2)), ("fixed-lattice-h1.2", "mac"), (16, 20, 24)),
    "sound": (CONTESTS["sound"].flow, ("fixed-lattice-h1.2",), (16, 24, 32)),
    "conduction": (CONTESTS["conduction"].flow, ("grid", "fixed-lattice"), (8, 12, 16)),
    "couette": (CONTESTS["couette"].flow, ("grid", "fixed-lattice"), (8, 12, 16)),
    "convection": (HeatedLayer(rows=(8, 10, 12)), ("grid", "fixed-lattice", SPECTRAL), (8, 10, 12)),
}


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    return list(quick() if size == "quick" else paper())


def paper() -> Iterator[Case]:
    """All contests, growth of seconds, two threads from 20 000 points on, memory of a million points."""
    for scene, contest in CONTESTS.items():
        yield from contest.cases(scene)
    yield from growth(ROWS)
    for (name, chosen), rows in product(MOVERS.items(), (100, 224)):
        yield TwoThreads(method=name, variant=chosen, rows=rows)
    yield Resident(method=CARRIED, variant=TRIANGLES[CARRIED], rows=ROWS[-1])


def quick() -> Iterator[Case]:
    """A few methods on small scenes, against coarse references."""
    for scene, (flow, names, resolutions) in QUICK.items():
        yield from CONTESTS[scene]._replace(flow=flow).cases(scene, names, resolutions, short=FAST)
    yield from growth((16, 22, 32))
    yield Resident(method=CARRIED, variant=TRIANGLES[CARRIED], rows=16)


def growth(sizes: tuple[int, ...]) -> Iterator[StepTime]:
    """Seconds of a step of so many rows of points."""
    for rows, (name, chosen) in product(sizes, MOVERS.items()):
        yield StepTime(method=name, variant=chosen, rows=rows)
