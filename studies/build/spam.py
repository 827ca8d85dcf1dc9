"""Smooth particles: the scheme as printed and its variants, in any scene    [KHP95]"""
from collections.abc import Callable
from functools import cache
from math import isclose
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas, energy, pressure
from continuum.gas.fields import interpolate
from continuum.gas.solve import steady_on
from continuum.scene import RayleighBenard, Torus
from particles.limits import step_limit
from particles.observe import PlateHeat, field_kinetic, heat_flow, particle_kinetic
from particles.smooth.corrected import AllCorrected, Corrected, Reversed, Symmetrised
from particles.smooth.meshless import AdiabaticMfm, Crksph, Mfm
from particles.smooth.riemann import LowDissipationSums
from particles.smooth.shifting import DeltaPlus
from particles.smooth.spam import LessStatic, Spam
from particles.smooth.sums import Direct, Nested
from particles.smooth.transport import TransportVelocity, transported_heat
from particles.terms import ArithmeticGradients, Gradients
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import Odd
from particles.walls.periodic import periodic
from particles.weights import WEIGHTS, Lucy, Monaghan, WendlandC2
from studies.build.names import START_JITTER
from studies.build.setting import Ready, check_spacings, check_taken, no_still_layer
from studies.build.setting import walls as around

#: time step over its limit: dt = 0.4 for the printed scheme. Plates reflect particles up to v dt beyond them,
#: an error of first order: half of the step raises Nu by 4 % at 16 rows, 0.6 % at 25, 0.2 % at 50.
OF_LIMIT = 0.22
#: further factor where pairs lack P0, which makes the limit too long: 0.25 a/c of Adami, Hu & Adams 2013
STEPPED = 0.4
FRICTIONLESS = ConstEta(0.0, 0.0)
#: number of walls of a box; tolerance of the area that particles of given densities fill
ENDS, FILLED = 4, 0.1


def images(scene: Any) -> tuple:
    """Images at rest with the plate's temperature, pressure of the particle    [KHP95, Fig. 3]"""
    return around(scene)


def images_odd(scene: Any) -> tuple:
    """Images with v -> -v, T -> 2 T_w - T, pressure of the particle."""
    return around(scene, Odd())


def images_own(scene: Any) -> tuple:
    """Images at rest with the plate's temperature, pressure from the image's own state."""
    return around(scene, own_pressure=True)


def images_odd_own(scene: Any) -> tuple:
    """Images with v -> -v, T -> 2 T_w - T, pressure from the image's own state."""
    return around(scene, Odd(), own_pressure=True)


def fixed_rows(scene: Any) -> tuple:
    """Six rows of fixed particles behind each plate, periodic sides    [KHP95, Fig. 2]"""
    return (*fixed_plates(scene.L, scene.T_hot, scene.T_cold), *periodic(scene.width))


def developed(scene: Any, x: np.ndarray) -> tuple:
    """(1, v, T) of the grid's steady flow at x (n, 2): a start that weak rolls need not reach."""
    grid = steady_on(scene, (16, 24))[-1].fields
    at = interpolate(grid, x[:, 0], np.clip(x[:, 1], -scene.L/2, scene.L/2))
    return np.ones(len(x)), np.stack([at.vx, at.vy], axis=1), at.T


class Variant(NamedTuple):
    """One way to build the method; the defaults are the scheme as printed with the walls of Fig. 3.

    weight : a class of `particles.weights`; h : its range. step : time step over its limit. fraction : share
    of the static pressure that is left out, and of the gravity on a fluid of density rho0 with it.
    begin : (scene, x) -> (rho, v, T) at the start; None for the scene's own.
    """

    name: str
    weight: Any = Lucy
    h: float = 3.0
    walls: Callable = images
    gradients: Any = Gradients()
    transport: type[Nested] | type[Direct] = Nested
    fraction: float = 0.0
    rho0: float = 1.0
    step: float = OF_LIMIT
    begin: Callable | None = None

    def refuses(self, scene: Any) -> str:
        """The part of a scene that this cannot take; empty if none. Images allow all sides."""
        if self.begin is developed and not isinstance(scene, RayleighBenard):
            return f"a {type(scene).__name__}, which has no rolls to begin with"
        return no_still_layer(scene) if self.walls is fixed_rows else ""

    def ready(self, scene: Any, seed: int = 1, x: Any = None, fields: Any = None) -> Ready:
        check_taken(self, scene)
        begun = self.transport.complete(start(scene, seed, self.begin, x, fields), 1.0, 1.0)
        return Ready(method(scene, self), begun, step(scene, self))

    @property
    def series(self) -> dict[str, Any]:
        return {"kp": particle_kinetic, "kg": field_kinetic, "heat": heat_flow,
                "lower": PlateHeat(-1, self.moves), "upper": PlateHeat(1, self.moves)}

    @property
    def moves(self) -> bool:
        """Whether images move, so that their pressure does work."""
        return self.walls in (images_odd, images_odd_own)


class Transporting(Variant):
    """A variant whose masses move with v + d: its heat flux counts what d carries."""
    __slots__ = ()

    @property
    def series(self) -> dict[str, Any]:
        return super().series | {"heat": transported_heat}


PRINTED = Variant("printed")
VARIANTS = {v.name: v for v in (
    PRINTED,
    Variant("printed-half-step", step=OF_LIMIT/2),
    Variant("printed-from-flow", begin=developed),
    Variant("printed-fixed-rows", walls=fixed_rows),
    Variant("printed-monaghan", weight=Monaghan),
    Variant("walls-odd", walls=images_odd),
    Variant("walls-own-pressure", walls=images_own),
    Variant("walls-odd-own-pressure", walls=images_odd_own),
    Variant("arithmetic-mean", gradients=ArithmeticGradients()),
    Variant("direct", transport=Direct),
    Variant("more-static-400", fraction=-4.0),
    Variant("more-static-100", fraction=-1.0),
    Variant("less-static-50", fraction=0.5),
    Variant("less-static-90", fraction=0.9),
    Variant("direct-less-static-90", transport=Direct, fraction=0.9),
    *(Variant(name, weight=kind) for name, kind in WEIGHTS.items() if kind not in (Lucy, Monaghan)),
    Variant("wendland-c2-walls-odd", weight=WendlandC2, walls=images_odd),
    Variant("range-4", h=4.0),
    Variant("range-6", h=6.0),
)}
#: methods in use today: friction and heat along pairs; the mean of image and particle is the plate's value
TODAY = {v.name: v._replace(weight=WendlandC2, walls=images_odd) for v in (
    Variant("sph", transport=Direct),
    Variant("sph-less-static", transport=Direct, fraction=1.0, step=STEPPED*OF_LIMIT),
    Variant("sumB", transport=Corrected),
    Variant("RKGC", transport=Reversed),
    Variant("bonet-lok", transport=Symmetrised),
    Variant("corrected", transport=AllCorrected),
    Variant("corrected-half-step", transport=AllCorrected, step=OF_LIMIT/2),
    Variant("CRKSPH", transport=Crksph),
    Variant("MFM", transport=Mfm),
    Variant("MFM-adiabatic", transport=AdiabaticMfm),
    Variant("riemann", transport=LowDissipationSums),
    Variant("delta-plus", transport=DeltaPlus),
    Transporting("transport-velocity", transport=TransportVelocity, fraction=1.0, rho0=0.0,
                 step=STEPPED*OF_LIMIT),
    Transporting("transport-velocity-hydrostatic", transport=TransportVelocity, fraction=1.0,
                 step=STEPPED*OF_LIMIT),
    Transporting("transport-velocity-whole", transport=TransportVelocity),
)}
#: images copy P, though it has a slope: particles sink to a plate, and densities by continuity do not rise
TODAY["delta-plus-own-pressure"] = TODAY["delta-plus"]._replace(name="delta-plus-own-pressure",
                                                                walls=images_odd_own)
#: shorter and shorter steps: does a frozen fluid stay frozen in their limit?
STEPS = {name: PRINTED._replace(name=name, step=OF_LIMIT/part)
         for name, part in (("printed-quarter-step", 4), ("printed-eighth-step", 8),
                            ("printed-sixteenth-step", 16))}
JOINT = "-joint"


def variant_of(name: str, rows: float) -> Variant:
    """The variant of a name; with `-joint` its range grows as rows^(1/2)    [Zhu, Hernquist & Li 2015]"""
    usual = (VARIANTS | TODAY | STEPS)[name.removesuffix(JOINT)]
    return usual._replace(name=name, h=usual.h*(rows/25)**0.5) if name.endswith(JOINT) else usual


def method(scene: Any, variant: Variant) -> Spam:
    """The method on particles of unit spacing and mass; the scene has L = rows spacings.

    Raises TypeError: the weight is not a class of weights. ValueError: there are not four walls.
    """
    weight, eos = variant.weight, scene.eos
    if not (isinstance(weight, type) and hasattr(weight, "of")):
        raise TypeError(f"the weight of a variant must be a class of weights, got {weight!r}: give the "
                        "class, such as Lucy, and its range as h")
    if not callable(variant.walls):
        raise TypeError(f"walls of a variant are a function of the scene, got {variant.walls!r}: give one of "
                        "studies.build.spam, such as images_odd, or your own")
    p = pressure(eos, 1.0, energy(eos, 1.0, scene.T_mean))
    walls = (around if isinstance(scene.sides, Torus) else variant.walls)(scene)
    if len(walls) != ENDS:
        raise ValueError(f"walls of {variant.name} are {len(walls)}, a box has {ENDS} ends: make one each")
    return Spam(weight=weight.of(variant.h), eos=eos, law=scene.law, walls=walls,
                box=(scene.width, scene.L), g=scene.g, gradients=variant.gradients,
                transport=variant.transport,
                static=LessStatic(variant.fraction, float(p), variant.rho0))


@cache
def step(scene: Any, variant: Variant) -> float:
    """Time step, the same for all seeds: a fraction of the limit of a lattice at the plates' temperatures."""
    plates = np.array([scene.T_cold, scene.T_hot])
    return variant.step*step_limit(method(scene, variant), energy(scene.eos, 1.0, plates))


def start(scene: Any, seed: int = 1, begin: Any = None, x: Any = None, fields: Any = None) -> np.ndarray:
    """Start state (5, n), before `transport.complete`; begin : as in `Variant`."""
    x = scattered(scene, seed) if x is None else x
    if fields:
        check_mass(scene, fields[0]*np.ones(len(x)))
    _, v, T = fields or (begin(scene, x) if begin else scene.fields(x))
    return np.array([*x.T, *v.T, energy(scene.eos, 1.0, T)])


def check_mass(scene: Any, rho: np.ndarray) -> None:
    """Check that particles of unit mass with these densities fill the box. Raises ValueError."""
    filled, room = float(np.sum(1/rho)), scene.width*scene.L
    if not isclose(filled, room, rel_tol=FILLED):
        raise ValueError(f"{len(rho)} particles of unit mass fill {filled:.4g} of a box of {room:.4g} at the "
                         "densities given, which smooth particles have by their places: give other places")


def scattered(scene: Any, seed: int) -> np.ndarray:
    """Positions (n, 2) on a jittered square lattice."""
    check_spacings(scene)
    columns, rows = round(scene.width), round(scene.L)
    x, y = np.meshgrid(np.arange(columns) + 0.5 - scene.width/2, np.arange(rows) + 0.5 - scene.L/2)
    shift = np.random.default_rng(seed).uniform(-START_JITTER, START_JITTER, (2, columns*rows))
    return np.stack([x.ravel() + shift[0], y.ravel() + shift[1]]).T


def fluid(weight: Any, box: tuple[float, float], eos: Any = IdealGas(), law: Any = FRICTIONLESS,  # noqa: B008
          **more: Any) -> Spam:
    """The scheme as printed, in a box that is periodic along both axes    [KHP95, Sec. II]"""
    walls = (*periodic(box[0]), *periodic(box[1], axis=1))
    return Spam(weight=weight, eos=eos, law=law, walls=walls, box=box, **more)


def at_rest(x: np.ndarray, e: Any) -> np.ndarray:
    """State (5, n) of particles at x (n, 2) that do not move."""
    return np.array([*x.T, *np.zeros((2, len(x))), np.broadcast_to(e, len(x))], float)
