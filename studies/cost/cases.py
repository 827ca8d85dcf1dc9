"""Which methods take part in which scene, at which resolutions.

Every method runs at rising resolutions, each at the longest step that is good enough beside the error of its space
(studies/cost/problem.py has the rule; py-pde's is by its formula); CPU seconds of one thread, medians of repeats, without
compiling; nothing else runs. A ladder of resolutions, four at least, ends before its cases take more than DEAREST seconds
each, and all of them more than TOGETHER. `paper` takes an hour, `quick` minutes.
"""
from collections.abc import Iterable, Iterator
from typing import Any

from studies.cost import contestants, convection, direct, names, pypde
from studies.cost.contestants import Contestant
from studies.cost.flows import Plates, Vortex, Wave
from studies.cost.growth import Growth, Threads
from studies.cost.layer import LOWER_RA, SETTLED
from studies.cost.problem import Price, Race
from studies.kit.case import Case

SEEDS = (1, 2, 3)
DEAREST, TOGETHER = 300.0, 55*60.0   # seconds
#: name -> method of `studies.build`
LATTICES = {names.NEAREST: "fixed-lattice-h1.2", names.LATTICE: "fixed-lattice", names.WIDE: "fixed-lattice-h3"}
WEIGHTS = {names.LATTICE_MONAGHAN: "fixed-lattice-monaghan", names.LATTICE_WENDLAND: "fixed-lattice-wendland-c2"}
PARTICLES = {names.LUCY: "spam", names.MONAGHAN: "spam-monaghan", names.WENDLAND: "spam-wendland-c2"}
MORE_PARTICLES = {**PARTICLES, names.LESS_STATIC: "spam-less-static-50"}


# --- who takes part ---------------------------------------------------------------------------------------------


def vortex(mach: float = 0.05) -> dict[str, Any]:
    """Contestants by name."""
    flow, price = Vortex(mach), Price(0.5, 1.3e-5, 3)
    points = {**LATTICES, **WEIGHTS, names.JITTERED: "fixed-jittered-delaunay"}
    return by_name(
        *(Contestant(name, flow, method, price) for name, method in points.items()),
        Contestant(names.TWO_STEP, flow, "fixed-lattice", Price(0.5, 0.013), contestants.two_step_points),
        *(Contestant(name, flow, method, Price(1.3, 1e-4, 3), contestants.particles, 0.7, True)
          for name, method in PARTICLES.items()),
        Contestant(names.MOVING, flow, "moving", Price(0.5, 1.8e-4, 3)),
        contestants.OnGrid(names.GRID, flow, Price(0.5, 8e-6, 3)), contestants.OnMac(names.MAC_IMEX),
        pypde.InFlow(names.PYPDE_GAS, flow, Price(5, 3e-5, 3), pypde.vortex))


def wave() -> dict[str, Any]:
    """In sound."""
    flow, price = Wave(), Price(0.5, 7e-5)
    points = {**LATTICES, **WEIGHTS, names.JITTERED: "fixed-jittered-delaunay"}
    dear = {names.MONAGHAN: 2e-3}
    return by_name(
        *(Contestant(name, flow, method, price) for name, method in points.items()),
        Contestant(names.TWO_STEP, flow, "fixed-lattice", Price(0.5, 4e-4), contestants.two_step_points),
        *(Contestant(name, flow, method, Price(1.5, dear.get(name, 0.0)), contestants.particles)
          for name, method in PARTICLES.items()),
        Contestant(names.LUCY_TWO_STEP, flow, "spam", Price(1.5, 2e-3), contestants.two_step_particles),
        Contestant(names.MOVING, flow, "moving", Price(0.3, 2.7e-4), contestants.on_lattice),
        contestants.OnGrid(names.GRID, flow, Price(0.3, 3e-5)),
        pypde.InFlow(names.PYPDE_GAS, flow, Price(5, 1e-4), pypde.sound))


def between(name: str) -> dict[str, Any]:
    """Between plates; those of moving points do not slide."""
    flow, price = Plates(name), Price(0.5, 7e-5)
    moving = (Contestant(names.MOVING, flow, "moving", Price(0.3, 1.3e-4)),)
    return by_name(
        contestants.OnGrid(names.GRID, flow, price),
        *(Contestant(name, flow, method, price) for name, method in LATTICES.items()),
        Contestant(names.JITTERED, flow, "fixed-jittered-plates", price, contestants.less_jittered),
        *(Contestant(name, flow, method, Price(1.7), contestants.particles, 0.7, True)
          for name, method in PARTICLES.items()),
        *(moving if name == "conduction" else ()),
        pypde.InFlow(names.PYPDE_GAS, flow, Price(5, 2e-4), pypde.between))


def layer() -> dict[str, Any]:
    """In convection; relaxing random points takes minutes where they are many."""
    price, dear = Price(1, 2.2e-4, 3), Price(1, 5.3e-4, 3)
    return by_name(
        convection.OnGrid(names.GRID),
        *(convection.OnPoints(name, method, price) for name, method in LATTICES.items()),
        convection.OnPoints(names.JITTERED, "fixed-jittered-plates", dear),
        convection.OnPoints(names.RELAXED, "relaxed-plates", Price(1, 0.11)),
        convection.OnPoints(names.MOVING, "moving", Price(1, 2.1e-3, 3), 1.0, SETTLED),
        *(convection.OnParticles(name, method) for name, method in MORE_PARTICLES.items()),
        direct.OnNewton(names.NEWTON), pypde.InLayer(names.PYPDE_GAS, True))


def boussinesq() -> dict[str, Any]:
    """Another fluid, which is no answer for the gas."""
    return by_name(convection.OnMac(names.MAC_IMEX), direct.OnMacNewton(names.MAC_NEWTON),
                   pypde.InLayer(names.PYPDE_BOUSSINESQ, False))


def lower() -> dict[str, Any]:
    """The two that decide what fixed points cost, at half the Rayleigh number."""
    grid, nearest = (layer()[name] for name in (names.GRID, names.NEAREST))
    return by_name(grid._replace(ra=LOWER_RA), nearest._replace(ra=LOWER_RA))


def by_name(*methods: Any) -> dict[str, Any]:
    """Methods by the name that tables and figures have for them."""
    return {method.name: method for method in methods}


#: scene -> its contestants
CONTESTS = {"taylor-green": vortex(), "sound": wave(), "conduction": between("conduction"), "couette": between("couette"),
            "convection": layer(), "convection-5000": lower(), "convection-boussinesq": boussinesq()}


# --- at which resolutions ---------------------------------------------------------------------------------------


def race(scene: str, who: Iterable[str], resolutions: Iterable[int], seeds: Iterable[int] = (1,),
         **more: Any) -> Iterator[Race]:
    """Methods in a scene."""
    for name in who:
        method = CONTESTS[scene][name]
        kind = direct.Direct if hasattr(method, "solve") else Race
        for size in resolutions:
            yield from (kind(scene=scene, method=method, resolution=size, seed=seed, **more) for seed in seeds)


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    return list(quick() if size == "quick" else paper())


def quick() -> Iterator[Case]:
    """A few methods on small scenes, against coarse references."""
    small, fast, slow = layer_sizes(8, 10, 12), 0.001, vortex(0.2)
    for method in (slow[names.NEAREST], slow[names.MAC_IMEX]):
        yield from (Race(scene="taylor-green", method=method, resolution=n, short=fast) for n in (16, 20, 24))
    for name in (names.GRID, names.LATTICE):
        method = CONTESTS["convection"][name]._replace(sizes=small)
        yield from (Race(scene="convection", method=method, resolution=n, short=fast) for n in (8, 10, 12))
    for scene in ("conduction", "couette"):
        yield from race(scene, (names.GRID, names.LATTICE), (8, 12, 16), short=fast)
    yield from race("sound", (names.NEAREST,), (16, 24, 32), short=fast)
    yield from (Growth(rows=rows, fixed=fixed, short=fast) for fixed in (False, True) for rows in (16, 22, 32))


def layer_sizes(*rows: int) -> convection.Sizes:
    """Coarse references."""
    return convection.Sizes(rows, rows)  # type: ignore[arg-type]


def paper() -> Iterator[Case]:
    """All."""
    yield from vortices()
    yield from waves()
    yield from slabs()
    yield from layers()
    yield from numbers()


def vortices() -> Iterator[Case]:
    """Smooth particles are far off at any resolution; of one lattice up to 0.02 %, of the grid to 0.1 %."""
    yield from race("taylor-green", (*LATTICES, names.MAC_IMEX), (16, 24, 32, 48, 64))
    yield from race("taylor-green", (names.GRID,), (16, 24, 32, 48, 64, 96, 128))
    yield from race("taylor-green", (names.LATTICE,), (96, 128, 192))
    yield from race("taylor-green", (names.PYPDE_GAS,), (16, 24, 32, 48, 64))
    yield from race("taylor-green", WEIGHTS, (16, 24, 32, 48))
    yield from race("taylor-green", (names.JITTERED,), (16, 24, 32, 48, 64), SEEDS)
    yield from race("taylor-green", (names.TWO_STEP, *PARTICLES), (12, 16, 24, 32))
    yield from race("taylor-green", (names.MOVING,), (12, 16, 24, 32, 48), SEEDS[:2])


def waves() -> Iterator[Case]:
    """Sound: two periods take a hundred spacings for 1 %."""
    yield from race("sound", (*LATTICES, names.TWO_STEP, *WEIGHTS), (16, 24, 32, 48, 64, 96, 128))
    yield from race("sound", (names.MOVING,), (16, 24, 32, 48, 64, 96, 128, 192))
    yield from race("sound", (names.GRID,), (16, 24, 32, 48, 64, 96, 128, 192, 256))
    yield from race("sound", (names.PYPDE_GAS,), (16, 24, 32, 48, 64, 96, 128))
    yield from race("sound", (*PARTICLES, names.LUCY_TWO_STEP), (16, 24, 32, 48, 64))
    yield from race("sound", (names.JITTERED,), (16, 24, 32, 48, 64, 96, 128), SEEDS)


def slabs() -> Iterator[Case]:
    """Heat conduction and Couette flow; seeds of what is jittered. Smooth particles err alike at any resolution."""
    for scene in ("conduction", "couette"):
        loose = [name for name in (names.JITTERED, names.MOVING) if name in CONTESTS[scene]]
        yield from race(scene, (names.GRID, *LATTICES, names.PYPDE_GAS), (8, 12, 16, 24, 32, 48, 64, 96))
        yield from race(scene, PARTICLES, (16, 32, 48, 64, 96))
        yield from race(scene, loose, (8, 12, 16, 24, 32, 48, 64), SEEDS)


def layers() -> Iterator[Case]:
    """Rayleigh-Benard. Grids go on to 0.1 %, which no points pay."""
    yield from race("convection", (names.GRID,), (8, 12, 16, 20, 24, 32, 40, 48, 64, 88))
    yield from race("convection", LATTICES, (12, 16, 24, 32, 48))
    yield from race("convection", (names.JITTERED,), (12, 16, 24, 32, 40), SEEDS[:2])
    yield from race("convection", (names.RELAXED,), (8, 10, 12, 16))
    yield from race("convection", (names.MOVING,), (10, 12, 16, 24, 32, 44))
    yield from race("convection", (names.LUCY,), (16, 20, 25, 30))
    yield from race("convection", (names.MONAGHAN, names.WENDLAND, names.LESS_STATIC), (12, 16, 20, 25))
    yield from race("convection", (names.NEWTON,), (8, 12, 16, 24, 32, 48))
    yield from race("convection", (names.PYPDE_GAS,), (12, 16, 24, 32))
    yield from race("convection-5000", (names.GRID,), (8, 12, 16, 24, 32, 48))
    yield from race("convection-5000", (names.NEAREST,), (8, 10, 12, 16, 24, 32, 48))   # K: 1 % at ten rows already
    yield from race("convection-boussinesq", (names.MAC_IMEX,), (12, 16, 20, 24, 32))
    yield from race("convection-boussinesq", (names.MAC_NEWTON,), (8, 12, 16, 24, 32, 48, 64, 112))
    yield from race("convection-boussinesq", (names.PYPDE_BOUSSINESQ,), (12, 16, 24, 32))


def numbers() -> Iterator[Case]:
    """A thousand to a million, of stored edges more sizes, which see the caches; two threads from 20 000 on."""
    rows = (22, 30, 40, 53, 71, 95, 126, 168, 224, 299, 398, 531, 707)
    for fixed in (False, True):
        yield from (Growth(rows=number, fixed=fixed) for number in rows)
    for fixed in (False, True):
        yield from (Threads(rows=number, fixed=fixed) for number in (100, 224))
