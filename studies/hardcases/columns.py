"""Hard cases without viscosity and with a known answer: scene, sizes, number judged, its value, tolerance.

A scene has `time`, the end of a run, `fastest`, the largest |v| + c until then, and seen(first, at), numbers
measured from the fields at the start and at the end. Numbers belong to the method and not to its size: the
error of a wave is in spacings, that of a flow is the part that is left. Tolerances were fixed before the
runs; those of waves when the errors of two methods at 100 spacings were known.
"""
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact import gresho
from continuum.exact.blast import blast
from continuum.exact.shear import growing_wave, layer_with_wave
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields, kinetic_energy
from studies.build import answer, variants
from studies.build.scenes import SOUND, Start, TaylorGreen
from studies.build.stable import BODIES, switched
from studies.hardcases.extremes import SPEED
from studies.hardcases.impacts import EOS, GAMMA, PROBLEMS, Bow, Frictionless, Ripple, Strip, radii
from studies.hardcases.runs import GRID, Course, Question, Row, copied, fate

#: methods that exist without and with the entropy-stable flux
EDGES = LATTICE, JITTERED, CARRIED = "fixed-lattice", "fixed-jittered-delaunay", "moving-delaunay"
PAIRS = {name: f"{name}-entropy-stable" for name in EDGES}
STABLE = tuple(PAIRS.values())
BLENDED = f"{LATTICE}-entropy-stable-blended"
#: method with points on plates, or on a body
HELD = "fixed-jittered-plates-entropy-stable"
COLD = 1e-6         # temperature that counts as zero
U, BEGIN = 0.15, 0.01       # of the shear flow: speed, Mach number 0.1; size of its wave at the start over U


@dataclass(frozen=True, kw_only=True)
class Sedov(Frictionless):
    """Blast of a hot disc, two spacings in radius, in cold gas, until the shock is at 0.35 L with speed 1."""
    eos: Any = EOS
    hot: float = 2.0

    @property
    def radius(self) -> float:
        return 0.35*self.L

    @property
    def time(self) -> float:
        """From R = D t (d + 2)/2 with the shock's speed D = 1 in d = 2 dimensions."""
        return self.radius/2

    @property
    def T(self) -> float:
        return 4*blast(GAMMA).alpha*self.radius**2/(pi*self.hot**2*EOS.cv)

    @property
    def fastest(self) -> float:
        """Twice the speed of sound of the hot disc: gas leaves the disc about as fast as sound."""
        return 2*float(GAMMA*self.T)**0.5

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.zeros((len(x), 2)), np.where(np.hypot(*x.T) < self.hot, self.T, COLD)

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Shock radius from the mean radius of the energy, against that of a blast of the initial energy."""
        heat, now = (f.rho*f.V*(EOS.cv*f.T + (f.v**2).sum(axis=1)/2) for f in (first, at))
        should = (heat.sum()*self.time**2/blast(GAMMA).alpha)**0.25
        has = now@radii(at)/now.sum()/blast(GAMMA).radius
        return {"measured": abs(has - should), "plateau": has/should - 1}


@dataclass(frozen=True, kw_only=True)
class Noh(Frictionless):
    """Cold gas that falls to the middle at speed 1 and rests behind a shock: rho = 16, P = 16/3 at r < t/3.
    Its speed at the start falls to zero over the last 0.05 L before the sides    [Noh 1987]"""
    eos: Any = IdealGas(cv=1.5)  # noqa: RUF009 (immutable)
    fastest: ClassVar[float] = 7/3      # above c = sqrt(gamma P/rho) = 0.75 behind the shock, |v| = 1 ahead

    @property
    def time(self) -> float:
        return 0.3*self.L

    def fields(self, x: np.ndarray) -> Start:
        r = np.hypot(*x.T)
        inwards = -np.clip((0.5 - r/self.L)/0.05, 0, 1)/np.maximum(r, 1e-12)
        return np.ones(len(x)), inwards[:, None]*x, COLD*np.ones(len(x))

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Shock radius from the heat around the middle; behind the shock there is 8 per area."""
        here = radii(at) < 0.25*self.L/2
        heat = (at.rho*at.V*self.eos.cv*at.T)[here].sum()
        has, should = (heat/(8*pi))**0.5, self.time/3
        return {"measured": abs(has - should), "plateau": has/should - 1}


@dataclass(frozen=True, kw_only=True)
class Gresho(Frictionless):
    """Vortex of uniform density balanced by its pressure, at Mach 0.1, for one turn where it is fastest."""
    speed: ClassVar[float] = 0.1*SOUND
    fastest: ClassVar[float] = 1.1*SOUND

    @property
    def time(self) -> float:
        return 0.4*pi*self.L/self.speed

    def fields(self, x: np.ndarray) -> Start:
        place = x/self.L
        v, P = self.speed*gresho.velocity(place), 1 + self.speed**2*gresho.pressure(place)
        return np.ones(len(x)), v, P

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Part of the flow that is left: velocities projected on the exact ones, which leaves out noise."""
        v, m = gresho.velocity(at.x/self.L)*self.speed, at.rho*at.V
        return {"measured": float(m@(at.v*v).sum(axis=1)/(m@(v**2).sum(axis=1)))}


def left(first: Fields, at: Fields) -> dict[str, float]:
    """Kinetic energy at the end over that at the start."""
    return {"measured": kinetic_energy(at)/kinetic_energy(first)}


@dataclass(frozen=True, kw_only=True)
class KelvinHelmholtz(Frictionless):
    """Waves on u = U sin ky for ten growth times, until they have broken; K is constant to Mach squared."""
    fastest: ClassVar[float] = SOUND + U
    wide: ClassVar[int] = 2

    @property
    def time(self) -> float:
        k = 2*pi/self.L
        return 10/growing_wave(U, k, k/2)[0]

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, layer_with_wave(x, U, 2*pi/self.L, BEGIN), one

    seen = staticmethod(left)


@dataclass(frozen=True, kw_only=True)
class Turns(TaylorGreen):
    """Taylor-Green vortex without viscosity: K is constant."""
    turns: float = 100.0
    mach: float = SPEED/SOUND
    law: ConstEta = ConstEta(0.0, 0.0)  # type: ignore[misc]  # noqa: RUF009 (immutable)
    fastest: ClassVar[float] = 1.1*SOUND

    @property
    def time(self) -> float:
        return self.turns*self.L/self.speed

    seen = staticmethod(left)


class Column(NamedTuple):
    """A scene, its sizes, the number that is judged, its expected value, its tolerance and the reason for it.

    only : the methods that run, where runs are long or methods need a body; empty: the usual ones.
    """
    scene: Any
    sizes: tuple[int, ...]
    number: str
    expected: float
    within: float
    because: str
    only: Mapping[str, Any] = MappingProxyType({})

    def right(self, value: float) -> bool:
        """Whether a value is within the tolerance."""
        return abs(value - self.expected) <= self.within


OFF, LEFT = "spacings off", "left/start"
WAVES = OFF, 0.0, 4.0, ("a wave over w spacings costs w/4 of its jump: a shock over 3, a contact over 8, "
                        "both ends of a fan over 2 cost 4 if each had the whole range")
FRONT = OFF, 0.0, 1.0, "a shock is two spacings thin at best: half of that to either side"
A_TENTH = "a tenth, which separates right from wrong on all of the map"
FLOW = LEFT, 1.0, 0.1, A_TENTH
COLUMNS = {name: Column(Strip(problem=problem, cells=50), (50, 100), *WAVES)
           for name, problem in PROBLEMS.items()} | {
    "Sedov": Column(Sedov(L=48), (48, 96), *FRONT),
    "Noh": Column(Noh(L=48), (48, 96), *FRONT),
    "Gresho": Column(Gresho(L=24), (24, 48), *FLOW),
    "Kelvin-Helmholtz": Column(KelvinHelmholtz(L=16), (16, 32), *FLOW),
    "100 turns": Column(Turns(L=16), (16,), *FLOW, variants(GRID, *EDGES, *STABLE)),
    "800 turns": Column(Turns(L=16, turns=800.0), (16,), *FLOW, variants(*STABLE[:2])),
    "Mach 3 body": Column(Bow(L=48), (48, 96), "P/exact", 1.0, 0.1, A_TENTH, BODIES),
    "shocked ripple": Column(Ripple(L=200), (200, 400), "growth/theory", 1.0, 0.1, A_TENTH,
                             variants(LATTICE, STABLE[0], BLENDED)),
}


# --- questions ----------------------------------------------------------------------------------------------

def measured(scene: Any, course: Course) -> Row:
    """Numbers that a scene measures of a run, if it reached its end."""
    numbers = scene.seen(course.seen[0], course.seen[-1]) if course.reached == 1 else {}
    return fate(course.reached) | numbers


def halved(sums: Any, state: np.ndarray) -> int:
    """Number of parts of steps halved so far."""
    return sums.refused     # type: ignore[no-any-return]


def limited(sums: Any, state: np.ndarray) -> int:
    """Number of Euler steps with limited fluxes so far."""
    return sums.limited     # type: ignore[no-any-return]


def switching(scene: Any, course: Course) -> Row:
    """As `measured`, with the share of edges that dissipate, the number of halvings and of limited steps."""
    if course.reached < 1:
        return measured(scene, course)
    share, halves, limits = (course.watched[name] for name, _ in WATCHED)
    return measured(scene, course) | {
        "switched": float(np.mean(share)), "halved": halves[-1], "limited": limits[-1]}


def smooth_error(scene: Any, course: Course) -> Row:
    """Rms error of velocities over the largest exact one; K of convection, whose flow is not known."""
    first, last = course.seen[0], course.seen[-1]
    known, exact = (velocities(scene, at) for at in (first, last))
    if not known.any():
        return {"value": kinetic_energy(last)}
    rms = np.sqrt(((last.v - exact)**2).mean())
    return {"value": float(rms/np.abs(known).max())}


def velocities(scene: Any, at: Fields) -> np.ndarray:
    """Exact velocities (n, 2), zero where there is no exact answer."""
    known = answer(scene, at.x)
    return np.stack([known.get(name, np.zeros(len(at.x))) for name in ("vx", "vy")], axis=1)


WATCHED = ("switched", switched), ("halved", halved), ("limited", limited)
AT_END = Question(copied, measured, samples=1)
SWITCHING = Question(copied, switching, 30, WATCHED)
SMOOTHNESS = Question(copied, smooth_error, 30)
