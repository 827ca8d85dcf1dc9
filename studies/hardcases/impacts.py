"""Hard cases without viscosity in which a gas meets something: a body in its stream, another gas."""
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from studies.build.scenes import Scene, Start
from studies.build.stable import BODIES
from studies.hardcases.printed import BELOW, HEAVY, LIGHT, TALL, WIDTH, Impulse, impulse
from studies.hardcases.tubes import EOS, GAMMA

MACH = 3.0          # of the stream past a disc
STEEP = 0.25        # k a of the ripple before the shock
HOT = 0.7           # between the temperatures of the light gas, 1 and more, and the heavy one, 0.5 and less


def radii(at: Fields) -> np.ndarray:
    """(n,) from the middle of the box."""
    return np.hypot(*at.x.T)


@dataclass(frozen=True, kw_only=True)
class Frictionless(Scene):
    """A square of L rows of a gas without viscosity."""
    L: int
    law: ConstEta = ConstEta(0.0, 0.0)  # noqa: RUF009 (immutable)

    @property
    def width(self) -> int:  # type: ignore[override]
        return self.L


def pitot(mach: float, gamma: float) -> float:
    """Pressure where a supersonic stream stops behind its bow shock, over its own    [Rayleigh 1910]"""
    behind = 2*gamma/(gamma + 1)*mach**2 - (gamma - 1)/(gamma + 1)
    return float(((gamma + 1)/2*mach**2)**(gamma/(gamma - 1))/behind**(1/(gamma - 1)))


@dataclass(frozen=True, kw_only=True)
class Bow(Frictionless):
    """A disc at rest that is suddenly in a stream of Mach 3, a sixth of the channel wide. The shock has had 5
    R/c to settle, and no wave has come round the periodic box."""
    eos: Any = EOS
    speed: ClassVar[float] = MACH*GAMMA**0.5
    takes: ClassVar[dict] = BODIES

    @property
    def width(self) -> int:  # type: ignore[override]
        return 2*self.L

    @property
    def disc(self) -> float:
        return self.L/12

    @property
    def time(self) -> float:
        return 1.7*self.L/self.fastest

    @property
    def fastest(self) -> float:
        """|v| + c is largest where c = |v|/5, of a gas that spreads into the wake: v^2 + 5 c^2 stays."""
        return float((1.2*(self.speed**2 + 5*GAMMA))**0.5)

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.stack([self.speed*one, 0*one], axis=1), one

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Pressure at the foremost points of the disc."""
        edge = np.flatnonzero(np.isclose(radii(at), self.disc))
        front = edge[np.isclose(at.x[edge, 0], at.x[edge, 0].min())]
        return {"measured": float((at.rho*at.T)[front].mean()/pitot(MACH, GAMMA))}


@dataclass(frozen=True, kw_only=True)
class Ripple(Frictionless):
    """The rippled interface of KHP95's Fig. 11 and its mirror image, L rows in all: gases fall onto y = 0, a
    shock of Mach 1.5 comes back; cells that the interface cuts have their share of both."""
    eos: Any = IdealGas()  # noqa: RUF009 (immutable)

    @property
    def width(self) -> int:  # type: ignore[override]
        return round(WIDTH*self.scale)

    @property
    def scale(self) -> float:
        return self.L/(2*TALL)

    @property
    def theory(self) -> Impulse:
        return impulse(self.scale, STEEP)

    @property
    def time(self) -> float:
        """The reflected shock is at the mirror."""
        return self.theory.back

    @property
    def fastest(self) -> float:
        """|v| + c of the light gas that falls, and more than that of all that is shocked."""
        return float(self.theory.fall + (2*LIGHT.P/LIGHT.rho)**0.5)

    def fields(self, x: np.ndarray) -> Start:
        k = 2*np.pi/self.width
        height = BELOW*self.scale + STEEP/k*np.cos(k*x[:, 0])
        heavy = np.clip(np.abs(x[:, 1]) - height + 0.5, 0, 1)
        rho = LIGHT.rho + heavy*(HEAVY.rho - LIGHT.rho)
        return rho, np.stack([0*rho, -self.theory.fall*np.sign(x[:, 1])], axis=1), LIGHT.P/rho

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """How much the ripple has grown since the shock came, of columns of a lattice; theory's at L rows."""
        order = np.lexsort((at.x[:, 1], at.x[:, 0]))
        x, y, T = (q[order].reshape(self.width, self.L)[:, self.L//2:] for q in (*at.x.T, at.T))
        last, column = (T > HOT).cumsum(axis=1).argmax(axis=1), np.arange(self.width)
        inside, beyond = T[column, last], T[column, last + 1]
        height = y[column, last] + (inside - HOT)/(inside - beyond)
        ripple = 2*np.mean(height*np.cos(2*np.pi/self.width*x[:, 0]))
        expected = self.theory.growth*(self.time - self.theory.meets)
        return {"measured": float((ripple - self.theory.amplitude)/expected)}
