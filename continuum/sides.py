"""Sides of a box: kinds of all four together, kinds of one; `axes` : is the box periodic in x, in y?"""
from contextlib import suppress
from math import isfinite, nan
from numbers import Real
from typing import Any, NamedTuple

import numpy as np


def of_one_kind(kind: type) -> type:
    """Let objects of a NamedTuple of numbers equal only those of their class: as tuples all empty ones are
    equal. Its constructor raises TypeError: not a number, an unknown name, a missing number."""
    plain, names = kind.__new__, kind._fields      # type: ignore[attr-defined]

    def alike(one: tuple, other: object) -> bool:
        return type(one) is type(other) and tuple.__eq__(one, other)

    def new(cls: type, *given: Any, **named: Any) -> Any:
        with suppress(TypeError):
            made: tuple = plain(cls, *given, **named)
            if all(isinstance(number, Real) for number in made):
                return made
        values = ", ".join([*map(repr, given), *(f"{name}={value!r}" for name, value in named.items())])
        raise TypeError(f"{kind.__name__}({values}): its numbers are {', '.join(names) or 'none'}; write "
                        f"{kind.__name__}({', '.join(f'{name}=1.0' for name in names[:1])})")
    for name, method in (("__new__", new), ("__eq__", alike), ("__ne__", lambda *pair: not alike(*pair))):
        setattr(kind, name, method)
    return kind


@of_one_kind
class Periodic(NamedTuple):
    """Periodic in x with period aspect L; rolls come in pairs. One of four sides: joined to the opposite."""

    @property
    def axes(self) -> tuple[bool, bool]:
        return True, False

    def rolls(self, x, y, width, L, count):
        """Velocities of KHP95, Sec. VI (count = 2, aspect 2); as printed they are not free of divergence."""
        if count < 2 or count % 2:
            raise ValueError(f"rolls between periodic sides come in pairs, got {count}: give an even number")
        k = np.pi*count/width
        return np.sin(k*x)*np.sin(2*np.pi*y/L), np.cos(k*x)*np.cos(np.pi*y/L)


@of_one_kind
class Torus(NamedTuple):
    """Periodic along both axes, without plates: for flows other than convection."""

    @property
    def axes(self) -> tuple[bool, bool]:
        return True, True


@of_one_kind
class Walls(NamedTuple):
    """No-slip walls also at x = -+ aspect L/2, with temperature linear in y    [KHP95, Fig. 6]"""

    @property
    def axes(self) -> tuple[bool, bool]:
        return False, False

    def rolls(self, x, y, width, L, count):
        """v = (psi_y, -psi_x), psi = cos(a) sin(count (a + pi/2)) cos^2(pi y/L), a = pi x/width: no slip."""
        if count < 1:
            raise ValueError(f"a box with four walls holds at least one roll, got {count}")
        a, b = np.pi*x/width, np.pi*y/L
        s, c = np.sin(count*(a + np.pi/2)), np.cos(count*(a + np.pi/2))
        slope = np.pi/width*(count*np.cos(a)*c - np.sin(a)*s)
        return -np.pi/L*np.cos(a)*s*np.sin(2*b), -slope*np.cos(b)**2


@of_one_kind
class Plate(NamedTuple):
    """No-slip side of temperature T, or with heat q into the fluid per area and time; default: adiabatic."""
    T: float = nan
    q: float = 0.0


@of_one_kind
class Slip(NamedTuple):
    """Impermeable side without friction, like a plane of symmetry; T and q as of a plate."""
    T: float = nan
    q: float = 0.0


@of_one_kind
class Sliding(NamedTuple):
    """A plate that slides along itself with velocity v: along x, or along y at the left and right side."""
    v: float
    T: float = nan
    q: float = 0.0


class Sides(NamedTuple):
    """Four sides of any kinds; opposite sides are both periodic or neither."""
    left: Any
    right: Any
    bottom: Any
    top: Any

    @property
    def axes(self) -> tuple[bool, bool]:
        return isinstance(self.left, Periodic), isinstance(self.bottom, Periodic)


class HeatPath(NamedTuple):
    """Axis of the heat flux (0: x, 1: y), temperature by which its left or lower side is hotter, length."""
    axis: int
    dT: float
    length: float


SOLID = (Plate, Slip, Sliding)


def warm(side: Any) -> bool:
    """True if the side has a given temperature."""
    return isinstance(side, SOLID) and not np.isnan(side.T)


def adiabatic(side: Any) -> bool:
    """True if no heat passes the side; through periodic sides none does, on average."""
    return isinstance(side, Periodic) or (np.isnan(side.T) and side.q == 0)


def check_sides(sides: Sides) -> None:
    """Check kinds, numbers and pairs of periodic sides. Raises TypeError: no side. ValueError: the others."""
    for name, side in sides._asdict().items():
        if type(side) not in (Periodic, *SOLID):
            raise TypeError(f"{name} must be Periodic(), Plate(...), Slip(...) or Sliding(v, ...), "
                            f"got {side!r}")
        if warm(side) and not (0 < side.T < np.inf and side.q == 0):
            raise ValueError(f"{name} = {side}: T must be positive and finite, and a side of given T takes "
                             "what heat the fluid brings: leave out q, or T")
        if not all(isfinite(getattr(side, number, 0.0)) for number in ("q", "v")):
            raise ValueError(f"{name} = {side}: heat and velocity must be finite numbers")
    for one, other in (("left", "right"), ("bottom", "top")):
        pair = getattr(sides, one), getattr(sides, other)
        if sum(isinstance(side, Periodic) for side in pair) == 1:
            raise ValueError(f"{one} = {pair[0]}, {other} = {pair[1]}: periodic sides come in pairs, make "
                             "both or none Periodic()")
