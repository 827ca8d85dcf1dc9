"""What does an error cost, and which method is the cheapest for 10, 3, 1, 0.1 %?    [KHP95 Secs II, V-VII; RR98 Sec. III]

Every method that can take a scene runs at rising resolutions, each at the longest step that is good enough beside the error of
its space (studies/cost/problem.py has the rule; py-pde's is by its formula); CPU seconds of one thread, medians of repeats,
without compiling; nothing else runs.
Writes results/cost/*.csv and *.png and the rows of study cost in results/claims.csv; `paper` takes an hour, `quick` minutes.
What a case takes is told beforehand (`python -m studies.cost.plan`): a ladder of resolutions, four at least, ends before
its cases take more than DEAREST seconds each, and all of them more than TOGETHER. Seconds alone, at the steps that are known
and with the errors as they are, are measured anew by `python -m studies.cost.again`: on another machine, after a change
that made something faster.
"""
from collections.abc import Iterable, Iterator

from studies.cost import claims as speed_claims
from studies.cost import convection, names, others, pypde, torus, vortex
from studies.cost import derive as speed_derive
from studies.cost import figures as speed_figures
from studies.cost import plates as slab
from studies.cost import tables as speed_tables
from studies.cost import waves as wave
from studies.cost.growth import Growth, Threads
from studies.cost.problem import Race
from studies.cost.start import Start
from studies.kit.case import Case
from studies.kit.study import Part

SEEDS = (1, 2, 3)
DEAREST, TOGETHER = 300.0, 55*60.0   # seconds


def race(scene: str, methods: Iterable, resolutions: Iterable[int], seeds: Iterable[int] = (1,),
         kind: type[Race] = Race, **more) -> Iterator[Race]:
    """Methods on one scene."""
    for method in methods:
        for resolution in resolutions:
            yield from (kind(scene=scene, method=method, resolution=resolution, seed=seed, **more) for seed in seeds)


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    return list(quick() if size == "quick" else paper())


def quick() -> Iterator[Case]:
    """A few methods on small scenes, against coarse references."""
    small, fast = (8, 10, 12), 0.001
    yield from race("taylor-green", (vortex.OnPoints(names.NEAREST, 1.2, mach=0.2), vortex.MAC), (16, 20, 24), short=fast)
    yield from race("convection", (convection.GRID._replace(sizes=small), convection.LATTICES[1]._replace(sizes=small)),
                    (8, 10, 12), short=fast)
    for scene, methods in slab.CONTESTANTS.items():
        yield from race(scene, [methods[name] for name in (names.GRID, names.LATTICE)], (8, 12, 16), short=fast)
    yield from race("sound", (wave.POINTS[0],), (16, 24, 32), short=fast)
    yield from (Growth(rows=rows, fixed=fixed, short=fast) for fixed in (False, True) for rows in (16, 22, 32))


def paper() -> Iterator[Case]:
    """All."""
    yield from vortices()
    yield from waves()
    yield from slabs()
    yield from layers()
    yield from numbers()


def vortices() -> Iterator[Case]:
    """Smooth particles are far off at any resolution; of one lattice up to 0.02 %, of the grid to 0.1 %, in sound, too."""
    yield from race("taylor-green", (*vortex.POINTS, vortex.MAC), (16, 24, 32, 48, 64))
    yield from race("taylor-green", (torus.VORTEX,), (16, 24, 32, 48, 64, 96, 128))
    yield from race("taylor-green", vortex.POINTS[1:2], (96, 128, 192))
    yield from race("taylor-green", (pypde.VORTEX,), (16, 24, 32, 48, 64), kind=others.Direct)
    yield from race("taylor-green", vortex.WEIGHTS, (16, 24, 32, 48))
    yield from race("taylor-green", (vortex.IRREGULAR,), (16, 24, 32, 48, 64), SEEDS)
    yield from race("taylor-green", (vortex.TWO_STEP,), (12, 16, 24, 32))
    yield from race("taylor-green", vortex.PARTICLES, (12, 16, 24, 32))
    yield from race("taylor-green", (vortex.MOVING,), (12, 16, 24, 32, 48), SEEDS[:2])


def waves() -> Iterator[Case]:
    """Sound: two periods take a hundred spacings for 1 %."""
    yield from race("sound", (*wave.POINTS, wave.TWO_STEP, *wave.WEIGHTS, wave.MOVING), (16, 24, 32, 48, 64, 96, 128))
    yield from race("sound", (wave.MOVING,), (192,))
    yield from race("sound", (torus.WAVE,), (16, 24, 32, 48, 64, 96, 128, 192, 256))
    yield from race("sound", (pypde.WAVE,), (16, 24, 32, 48, 64, 96, 128), kind=others.Direct)
    yield from race("sound", (*wave.PARTICLES, wave.PARTICLES_TWO_STEP), (16, 24, 32, 48, 64))
    yield from race("sound", (wave.IRREGULAR,), (16, 24, 32, 48, 64, 96, 128), SEEDS)


def slabs() -> Iterator[Case]:
    """Heat conduction and Couette flow; seeds of what is jittered. Smooth particles err by about the same at any resolution."""
    for scene, methods in slab.CONTESTANTS.items():
        loose = [methods[name] for name in (names.JITTERED, names.MOVING) if name in methods]
        smooth = [methods[name] for name in (names.LUCY, names.MONAGHAN, names.WENDLAND)]
        yield from race(scene, [one for one in methods.values() if one not in (*loose, *smooth)], (8, 12, 16, 24, 32, 48, 64, 96))
        yield from race(scene, smooth, (16, 32, 48, 64, 96))
        yield from race(scene, loose, (8, 12, 16, 24, 32, 48, 64), SEEDS)
        yield from race(scene, (pypde.SLABS[scene],), (8, 12, 16, 24, 32, 48, 64, 96), kind=others.Direct)


def layers() -> Iterator[Case]:
    """Rayleigh-Benard; relaxing random points takes minutes where they are many. Grids go on to 0.1 %, which no points pay."""
    yield from race("convection", (convection.GRID,), (8, 12, 16, 20, 24, 32, 40, 48, 64, 88))
    yield from race("convection", convection.LATTICES, (12, 16, 24, 32, 48))
    yield from race("convection", (convection.JITTERED,), (12, 16, 24, 32, 40), SEEDS[:2])
    yield from race("convection", (convection.RELAXED,), (8, 10, 12, 16))
    yield from race("convection", (convection.MOVING,), (10, 12, 16, 24, 32, 44))
    yield from race("convection", (convection.PRINTED,), (16, 20, 25, 30))
    yield from race("convection", convection.PARTICLES, (12, 16, 20, 25))
    yield from race("convection", (others.OnNewton(),), (8, 12, 16, 24, 32, 48), kind=others.Direct)
    yield from race("convection", (others.OnPypde(names.PYPDE_GAS, True),), (12, 16, 24, 32), kind=others.Direct)
    yield from race("convection-5000", (convection.GRID_LOWER,), (8, 12, 16, 24, 32, 48))
    yield from race("convection-5000", (convection.NEAREST_LOWER,), (8, 10, 12, 16, 24, 32, 48))     # K: 1 % at ten rows already
    other = "convection-boussinesq"      # another fluid, which is no answer for the gas
    yield from race(other, (others.OnMac(),), (12, 16, 20, 24, 32))
    yield from race(other, (others.OnMacNewton(),), (8, 12, 16, 24, 32, 48, 64, 112), kind=others.Direct)
    yield from race(other, (others.OnPypde(names.PYPDE_BOUSSINESQ, False),), (12, 16, 24, 32), kind=others.Direct)


def numbers() -> Iterator[Case]:
    """A thousand to a million, of stored edges more sizes, which see the caches; two threads from 20 000 on; fresh processes."""
    yield from (Growth(rows=rows, fixed=fixed) for fixed in (False, True)
                for rows in (22, 30, 40, 53, 71, 95, 126, 168, 224, 299, 398, 531, 707))
    yield from (Threads(rows=rows, fixed=fixed) for fixed in (False, True) for rows in (100, 224))
    yield from (Start(scene="conduction", method=name, resolution=32) for name in (
        names.GRID, names.LATTICE, names.LUCY, names.MOVING))


PART = Part(cases=cases, tables=speed_tables.ALL, derive=speed_derive.derive, figures=speed_figures.figures,
              claims=speed_claims.CLAIMS)
