"""Hard cases without viscosity whose answer is known: scene, sizes, what is judged, what is right.

A scene has `time`, when it is looked at, `fastest`, the largest |v| + c until then, and seen(first, at), what
is measured of the fields at the start and then. Lengths in spacings, so that a number is the method's, not
that of its size: waves are so many spacings off, a flow keeps a part of itself. What is allowed was fixed
before the runs, of waves with the errors of two methods at 100 spacings known.
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
from particles.integral.positive import switched
from studies.build import variants
from studies.build.answers import answer
from studies.build.scenes import SOUND, Start, TaylorGreen
from studies.build.stable import BODIES
from studies.hardcases.extremes import BEGIN, SPEED, U
from studies.hardcases.impacts import PROBLEMS, Bow, Frictionless, Ripple, Strip, radii
from studies.hardcases.runs import GRID, Course, Question, Row, copied, fate
from studies.hardcases.tubes import EOS, GAMMA

#: methods that have the entropy-stable flux, too
EDGES = LATTICE, JITTERED, CARRIED = "fixed-lattice", "fixed-jittered-delaunay", "moving-delaunay"
PAIRS = {name: f"{name}-entropy-stable" for name in EDGES}
STABLE = tuple(PAIRS.values())
BLENDED = f"{LATTICE}-entropy-stable-blended"
#: points on plates, or on a body
HELD = "fixed-jittered-plates-entropy-stable"
COLD = 1e-6         # of what is as good as no temperature


@dataclass(frozen=True, kw_only=True)
class Sedov(Frictionless):
    """A disc of two spacings is hot in a cold gas, until the shock has come 0.35 L far at speed 1."""
    eos: Any = EOS
    hot: float = 2.0

    @property
    def radius(self) -> float:
        return 0.35*self.L

    @property
    def time(self) -> float:
        """R = D t (d + 2)/2."""
        return self.radius/2

    @property
    def T(self) -> float:
        return 4*blast(GAMMA).alpha*self.radius**2/(pi*self.hot**2*EOS.cv)

    @property
    def fastest(self) -> float:
        """Sound of the hot disc, and gas that leaves it as fast."""
        return 2*float(GAMMA*self.T)**0.5

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.zeros((len(x), 2)), np.where(np.hypot(*x.T) < self.hot, self.T, COLD)

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Radius by the mean radius of the energy, less that of the energy at the start."""
        heat, now = (f.rho*f.V*(EOS.cv*f.T + (f.v**2).sum(axis=1)/2) for f in (first, at))
        should = (heat.sum()*self.time**2/blast(GAMMA).alpha)**0.25
        has = now@radii(at)/now.sum()/blast(GAMMA).radius
        return {"measured": abs(has - should), "plateau": has/should - 1}


@dataclass(frozen=True, kw_only=True)
class Noh(Frictionless):
    """A cold gas that falls to the middle at speed 1 and rests behind a shock, rho = 16, P = 16/3, r < t/3;
    it starts from rest at the sides, 0.05 L away    [Noh 1987]"""
    eos: Any = IdealGas(cv=1.5)  # noqa: RUF009 (immutable)
    fastest: ClassVar[float] = 7/3      # sound behind the shock, sqrt(gamma P/rho) = 0.75, and ahead of it 1

    @property
    def time(self) -> float:
        return 0.3*self.L

    def fields(self, x: np.ndarray) -> Start:
        r = np.hypot(*x.T)
        inwards = -np.clip((0.5 - r/self.L)/0.05, 0, 1)/np.maximum(r, 1e-12)
        return np.ones(len(x)), inwards[:, None]*x, COLD*np.ones(len(x))

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Radius by the heat, which is 8 in each place behind the shock."""
        here = radii(at) < 0.25*self.L/2
        heat = (at.rho*at.V*self.eos.cv*at.T)[here].sum()
        has, should = (heat/(8*pi))**0.5, self.time/3
        return {"measured": abs(has - should), "plateau": has/should - 1}


@dataclass(frozen=True, kw_only=True)
class Gresho(Frictionless):
    """A vortex of even density that its pressure holds together, at Mach 0.1, for its fastest turn."""
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
        """What is left of the flow, noise left out."""
        v, m = gresho.velocity(at.x/self.L)*self.speed, at.rho*at.V
        return {"measured": float(m@(at.v*v).sum(axis=1)/(m@(v**2).sum(axis=1)))}


@dataclass(frozen=True, kw_only=True)
class KelvinHelmholtz(Frictionless):
    """Waves on u = U sin ky for ten growth times, until they have broken: K stays, but for Mach squared."""
    fastest: ClassVar[float] = SOUND + U
    wide: ClassVar[int] = 2

    @property
    def time(self) -> float:
        k = 2*pi/self.L
        return 10/growing_wave(U, k, k/2)[0]

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, layer_with_wave(x, U, 2*pi/self.L, BEGIN), one

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        return left(first, at)


@dataclass(frozen=True, kw_only=True)
class Turns(TaylorGreen):
    """A vortex without viscosity, which keeps its K."""
    turns: float = 100.0
    mach: float = SPEED/SOUND
    law: ConstEta = ConstEta(0.0, 0.0)  # type: ignore[misc]  # noqa: RUF009 (immutable)
    fastest: ClassVar[float] = 1.1*SOUND

    @property
    def time(self) -> float:
        return self.turns*self.L/self.speed

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        return left(first, at)


def left(first: Fields, at: Fields) -> dict[str, float]:
    """Of K."""
    return {"measured": kinetic_energy(at)/kinetic_energy(first)}


class Column(NamedTuple):
    """A scene, its sizes, the number that decides, what it should be, how far off it may be, and why so far.

    only : who takes part, once, where runs are long.
    """
    scene: Any
    sizes: tuple[int, ...]
    number: str
    expected: float
    within: float
    because: str
    only: Mapping[str, Any] = MappingProxyType({})

    def right(self, value: float) -> bool:
        """Is a value what it should be?"""
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


# --- what is asked ------------------------------------------------------------------------------------------

def measured(scene: Any, course: Course) -> Row:
    """What a scene measures of a run that has come to its end."""
    numbers = scene.seen(course.seen[0], course.seen[-1]) if course.reached == 1 else {}
    return fate(course) | numbers


def halved(sums: Any, state: np.ndarray) -> int:
    """Parts of steps that were halved so far."""
    return sums.refused     # type: ignore[no-any-return]


def limited(sums: Any, state: np.ndarray) -> int:
    """Euler steps with limits so far."""
    return sums.limited     # type: ignore[no-any-return]


def switching(scene: Any, course: Course) -> Row:
    """The same, and how much the flux had to do."""
    if course.reached < 1:
        return measured(scene, course)
    share, halves, limits = (course.watched[name] for name, _ in WATCHED)
    return measured(scene, course) | {
        "switched": float(np.mean(share)), "halved": halves[-1], "limited": limits[-1]}


def smooth_error(scene: Any, course: Course) -> Row:
    """Rms error of velocities over the fastest of the start, of convection K."""
    first, last = course.seen[0], course.seen[-1]
    known, exact = (velocities(scene, at) for at in (first, last))
    if not known.any():
        return {"value": kinetic_energy(last)}
    rms = np.sqrt(((last.v - exact)**2).mean())
    return {"value": float(rms/np.abs(known).max())}


def velocities(scene: Any, at: Fields) -> np.ndarray:
    """(n, 2) of the answer, zero where it is not known."""
    known = answer(scene, at.x)
    return np.stack([known.get(name, np.zeros(len(at.x))) for name in ("vx", "vy")], axis=1)


WATCHED = ("switched", switched), ("halved", halved), ("limited", limited)
AT_END = Question(copied, measured, samples=1)
SWITCHING = Question(copied, switching, 30, WATCHED)
SMOOTHNESS = Question(copied, smooth_error, 30)
