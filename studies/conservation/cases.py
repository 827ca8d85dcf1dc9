"""Cases of the study conservation, by size.

On fixed points in periodic boxes every edge maker runs on every point set, with friction along edges for
every weight. Other transports have one weight, and every weight on one point set; so do mirror plates. Any
two values of two factors occur together in some run, if they can: Delaunay edges have no weight; on a lattice
closed and exact edges are plain ones times a number. Size `paper` takes a quarter of an hour on one core.
"""
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

from particles.integral.dih import NestedFluxes, Pairwise
from particles.integral.edge_makers import MAKERS
from particles.integral.rr98_moving_plain import MOTIONS
from particles.integrators import TwoStep
from particles.weights import WEIGHTS, WendlandC2
from studies.build.setting import DISORDERS
from studies.conservation.drift import MODES, OPEN, PAIRWISE, PLATES, UNDER_GRAVITY, LayerDrift, MotionDrift
from studies.conservation.forces import VISCOUS, BesideSpam, EdgeTorque, MotionTorque
from studies.conservation.motions import (
    ALONG,
    PLACES,
    STILL,
    BracketForce,
    Identity,
    MovingSound,
    Pattern,
    Signs,
)
from studies.conservation.slow_flows import CylinderDrag, SlidingShear, TurningWave, frozen, surface
from studies.conservation.sums import CUBE, EVERYTHING, LINE, SQUARE, DihDrift, Unsymmetric
from studies.kit.case import Case

WEIGHT_KINDS = tuple(WEIGHTS.values())
KINDS = ("lattice", "jittered-0.3", "random", "relaxed")
IDEAL = MODES[-1]
#: (edge maker, point set): one on a lattice, one off it
TWO = (("renormalised", "lattice"), ("delaunay", "jittered-0.3"))
KEEP = ("literal", "constant-mass")
POWERS = ((0, 0), (1, -1), (2, -2), (0, -1), (1, 0), (2, 0), (1, 1), (3, 0))
REYNOLDS = (0.1, 10.0, 1000.0, float("inf"))
SMOOTH = (24, 28, 32, 36, 40, 44, 48, 52, 56)      # rows of bodies with smooth errors; with scattered errors
SCATTERED = tuple(range(24, 50, 2))


def pairs(kinds: tuple[str, ...]) -> list[tuple[str, str]]:
    """(edge maker, point set), without closed and exact edges on a lattice: they are scaled plain ones."""
    return sorted({*product(MAKERS, kinds)} - {("closed", "lattice"), ("exact", "lattice")})


def layer(maker: str, points: str, mode=PAIRWISE, wall=OPEN, **more) -> LayerDrift:
    """A long run of the compiled scheme on fixed points."""
    return LayerDrift(mode=mode, maker=MAKERS[maker], points=DISORDERS[points], wall=wall, **more)


def layers(kinds: tuple[str, ...], weights: tuple[type, ...], steps: int) -> Iterator[LayerDrift]:
    """Long runs on fixed points in periodic boxes."""
    for maker, points in pairs(kinds):
        for weight in weights if maker != "delaunay" else weights[:1]:
            yield layer(maker, points, weight=weight, steps=steps)
        for mode in MODES[1:]:
            yield layer(maker, points, mode, steps=steps)
    for mode, weight in product(MODES[1:], weights[1:]):
        yield layer("exact", "jittered-0.3", mode, weight=weight, steps=steps)


def plates(kinds: tuple[str, ...], weights: tuple[type, ...], steps: int) -> Iterator[LayerDrift]:
    """Long runs between mirror plates, which exchange momentum and heat where there is friction."""
    for mode, pair in product((PAIRWISE, IDEAL), pairs(kinds)):
        yield layer(*pair, mode, PLATES, steps=steps)
    for pair in TWO:
        for mode in MODES[1:-1]:
            yield layer(*pair, mode, PLATES, steps=steps)
        yield layer(*pair, IDEAL, UNDER_GRAVITY, steps=steps)
    for weight in weights[1:]:
        yield layer("exact", "jittered-0.3", IDEAL, PLATES, weight=weight, steps=steps)


def dimensions(steps: int, seeds: int) -> Iterator[Case]:
    """Runs in 1D to 3D, also of Eq. 37 as printed; runs of a one-sided pressure: six left the claim open."""
    printed = NestedFluxes(differences=False)
    for box, mode, transport in ((LINE, "pairwise", Pairwise()), (LINE, "nested", NestedFluxes()),
                                 (LINE, "printed", printed), (SQUARE, "printed", printed),
                                 (CUBE, "pairwise", Pairwise())):
        yield DihDrift(mode=mode, transport=transport, box=box, steps=steps)
    for seed in range(1, seeds + 1):
        yield Unsymmetric(seed=seed, steps=steps)


def motions(steps: int, weights: tuple[type, ...]) -> Iterator[Case]:
    """Every motion on jittered points with RK4; the printed motions on a lattice with Eqs 40, 41."""
    for name in MOTIONS:
        yield MotionDrift(motion=name, steps=steps, claimed=EVERYTHING if name in KEEP else "nothing")
    lattice: Any = {"points": DISORDERS["lattice"], "integrator": TwoStep, "dt": 0.05, "steps": steps}
    for weight in weights:
        yield MotionDrift(motion="literal", weight=weight, **lattice)
    yield MotionDrift(motion="convective", claimed="nothing", **lattice)


def once() -> Iterator[Case]:
    """Equations evaluated on given fields; errors of positions by Eqs 40 and 41; Eq. 50 beside SPAM."""
    yield from (Signs(), *PLACES)
    yield from (BracketForce(a=float(a), b=float(b)) for a, b in POWERS)
    yield from (BesideSpam(a=float(a), b=float(b)) for a, b in ((1, -1), (0, 0), (2, 0)))
    for (name, transport), reynolds in product((("nested", NestedFluxes()), ("pairwise", ALONG)), REYNOLDS):
        yield Identity(transport=name, law=transport, reynolds=reynolds)


def speeds(wavelengths: tuple[int, ...]) -> Iterator[Case]:
    """Speeds of density patterns and of sound on moving points."""
    for name, wavelength in product(MOTIONS, wavelengths):
        yield Pattern(motion=name, wavelength=wavelength)
        yield MovingSound(motion=name, wavelength=wavelength)
        if name != "carried" and len(wavelengths) > 1:
            yield MovingSound(motion=name, wavelength=wavelength, weight=WendlandC2, h=4.0)


def drags(body: Callable, fraction: float, sizes: tuple[int, ...]) -> Iterator[Case]:
    """Drags of a cylinder."""
    for rows in sizes:
        yield CylinderDrag(variant=body, fraction=fraction, rows=rows)


def sliding(waves: tuple[int, ...]) -> Iterator[Case]:
    """Flows between sliding (Lees-Edwards) sides."""
    yield from (TurningWave(rows=rows) for rows in waves)
    yield from (SlidingShear(rows=rows) for rows in waves[:3])


def torques(seeds: int) -> Iterator[Case]:
    """Torques of exchanges over edges, of moving points, of smooth particles."""
    for (maker, points), seed in product(pairs(("lattice", "jittered-0.3")), range(1, seeds + 1)):
        if seed == 1 or points != "lattice":
            yield EdgeTorque(maker=MAKERS[maker], points=DISORDERS[points], seed=seed)
    for name, law in product((*MOTIONS, "spam"), (STILL, VISCOUS)):
        yield MotionTorque(motion=name, law=law)


def quick() -> Iterator[Case]:
    """Short runs with one weight on lattice and jittered points; small bodies."""
    some = KINDS[:2], WEIGHT_KINDS[:1]
    yield from (*layers(*some, steps=300), *plates(*some, steps=300))
    yield from (*dimensions(300, seeds=2), *motions(40, WEIGHT_KINDS[:1]), *once(), *speeds((8,)))
    yield from (*sliding((12, 16, 24)), *torques(1))
    yield from (*drags(surface, 0.1, (12, 16)), *drags(frozen, 0.1, (12, 16)))


def paper() -> Iterator[Case]:
    """All cases at full length."""
    yield from (*layers(KINDS, WEIGHT_KINDS, 10_000), *plates(KINDS, WEIGHT_KINDS, 10_000))
    yield from (*dimensions(10_000, seeds=24), *motions(10_000, WEIGHT_KINDS), *once())
    yield from speeds((8, 16, 24, 32))
    yield from (*sliding((16, 24, 32, 48, 64)), *torques(3))
    for fraction, every in ((0.1, 1), (0.3, 4)):
        yield from (*drags(surface, fraction, SMOOTH), *drags(frozen, fraction, SCATTERED[::every]))


def cases(size: str) -> list[Case]:
    """All cases of a size."""
    return list(quick() if size == "quick" else paper())
