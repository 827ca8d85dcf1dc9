"""A box of gas between any four sides: a scene like `continuum.scene.RayleighBenard`."""
from collections.abc import Callable
from dataclasses import MISSING, dataclass, fields, replace
from difflib import get_close_matches
from functools import partial, wraps
from math import isfinite
from typing import Any

import numpy as np
from scipy.integrate import odeint

from continuum.fluid import ConstEta, IdealGas, check_eos, check_state, energy, pressure
from continuum.scene import Heated, positive
from continuum.sides import HeatPath, Periodic, Plate, Sides, Sliding, Torus, adiabatic, check_sides, warm

HEIGHTS, PASSES = 401, 8    # for the density at rest; for an ideal gas the second pass is exact
Start = tuple[np.ndarray, np.ndarray, np.ndarray]


def spelled(kind: Any) -> Any:
    """Let the constructor of a dataclass raise TypeError with similar keywords, or with all required ones."""
    names, plain = [field.name for field in fields(kind)], kind.__init__
    needed = [field.name for field in fields(kind) if field.default is MISSING]

    @wraps(plain)
    def start(self: Any, *placed: Any, **given: Any) -> None:
        for name in given:
            if name not in names:
                near = ", ".join(get_close_matches(name, names, 2, 0.4) or names)
                raise TypeError(f"{kind.__name__} has no {name!r}; near to it are {near}")
        if placed or not {*needed} <= {*given}:
            raise TypeError(f"{kind.__name__} takes its numbers by name and needs {', '.join(needed)}: write "
                            f"{kind.__name__}({', '.join(f'{name}=...' for name in needed)})")
        plain(self, **given)
    kind.__init__ = start
    return kind


@spelled
@dataclass(frozen=True, kw_only=True)
class Domain(Heated):
    """A box of gas of mean density 1 between four sides, centred at the origin.

    L : height in spacings, the units of length. aspect : width/height. left, right, bottom, top :
    Periodic(), Plate(T or q), Slip(T or q), Sliding(v, T or q). eta, k : viscosity and conductivity. g :
    gravity, downwards. start : x (n, 2) -> density (n,), velocity (n, 2), temperature (n,); by default the
    gas is at rest in hydrostatic equilibrium at T_mean, the mean temperature of the sides.
    """
    L: float
    eta: float
    k: float
    aspect: float = 1.0
    left: Any = Plate()     # noqa: RUF009  (immutable)
    right: Any = Plate()    # noqa: RUF009
    bottom: Any = Plate()   # noqa: RUF009
    top: Any = Plate()      # noqa: RUF009
    g: float = 0.0
    eos: Any = IdealGas()   # noqa: RUF009
    start: Callable[[np.ndarray], Start] | None = None

    def __post_init__(self):
        check_sides(self.four)
        positive(L=self.L, eta=self.eta, k=self.k, aspect=self.aspect)
        positive(**{"L^2/eta": self.L*self.L/self.eta, "aspect L": self.width})
        if not isfinite(self.g) or (self.g and isinstance(self.sides, Torus)):
            raise ValueError(f"g must be finite, and 0 where nothing stands below, got {self.g}: give the "
                             "box a bottom and a top")
        check_eos(self.eos)
        for T in (self.T_mean, *self.temperatures):
            check_state(self.eos, 1.0, energy(self.eos, 1.0, T))

    @property
    def four(self) -> Sides:
        """The four sides as given, their numbers as floats."""
        return Sides(*(side._make(map(float, side)) if hasattr(side, "_make") else side
                       for side in (self.left, self.right, self.bottom, self.top)))

    @property
    def sides(self) -> Any:
        """`Torus()` or, for a layer, `Periodic()`, which every method knows; else the four sides."""
        if self.four.axes == (True, True):
            return Torus()
        return Periodic() if self.layer else self.four

    @property
    def layer(self) -> bool:
        """True with periodic sides between plates of given temperatures, of which the upper one may slide."""
        kinds = isinstance(self.bottom, Plate) and isinstance(self.top, (Plate, Sliding))
        return isinstance(self.left, Periodic) and kinds and warm(self.bottom) and warm(self.top)

    @property
    def slide(self) -> float:
        """Velocity of the upper plate of a layer, else 0."""
        return float(getattr(self.top, "v", 0.0)) if self.layer else 0.0

    @property
    def temperatures(self) -> list[float]:
        """Given temperatures of the sides, lowest first."""
        return sorted(side.T for side in self.four if warm(side))

    @property
    def T_hot(self) -> float:
        """Temperature of the lower plate of a layer, else of the hottest side, or 1."""
        return self.four.bottom.T if self.layer else (self.temperatures or [1.0])[-1]

    @property
    def T_cold(self) -> float:
        """Temperature of the upper plate of a layer, else of the coldest side, or 1."""
        return self.four.top.T if self.layer else (self.temperatures or [1.0])[0]

    @property
    def law(self) -> ConstEta:
        return ConstEta(self.eta, self.k)

    @property
    def time(self) -> float:
        """Viscous time L^2/nu at density 1."""
        return self.L**2/self.eta

    @property
    def heating(self) -> HeatPath | None:
        """Heat path between opposite sides of different temperatures, if the others are adiabatic."""
        pairs = (self.four[:2], self.width), (self.four[2:], self.L)
        for axis, (ends, length) in enumerate(pairs):
            beside = pairs[1 - axis][0]
            if all(map(warm, ends)) and all(map(adiabatic, beside)) and ends[0].T != ends[1].T:
                return HeatPath(axis, ends[0].T - ends[1].T, length)
        return None

    def resized(self, L: float) -> "Domain":
        """The same flow with another number of rows L: quantities in units of spacings are scaled."""
        by = L/self.L
        start = self.start and partial(_from_other, self.start, by)
        return replace(self, L=L, eta=by*self.eta, k=by*self.k, g=self.g/by, start=start)

    def fields(self, x: np.ndarray) -> Start:
        """Initial density (n,), velocity (n, 2), temperature (n,) at positions (n, 2)."""
        if self.start is not None:
            return self.start(x)
        rho = at_rest(self.eos, self.T_mean, self.g, self.L, x[:, 1]) if self.g else np.ones(len(x))
        return rho, np.zeros((len(x), 2)), np.full(len(x), self.T_mean)


def _from_other(start: Callable, by: float, x: np.ndarray) -> Start:
    """The start of a box that is 1/by as high, at positions x of the resized one."""
    return start(x/by)


def at_rest(eos: Any, T: float, g: float, L: float, y: np.ndarray) -> np.ndarray:
    """Hydrostatic density at heights y of a gas of uniform temperature T, with mean 1 over -L/2..L/2."""
    heights, lowest = np.linspace(-L/2, L/2, HEIGHTS), 1.0

    def slope(rho: Any, _: float) -> Any:
        """-g rho over dP/drho at constant temperature, by central differences."""
        low, high = (pressure(eos, rho*s, energy(eos, rho*s, T)) for s in (1 - 1e-6, 1 + 1e-6))
        return -g*rho/((high - low)/(2e-6*rho))
    for _ in range(PASSES):
        rho = odeint(slope, lowest, heights, rtol=1e-10)[:, 0]
        lowest /= float(np.trapezoid(rho, heights))/L
    return np.interp(y, heights, rho)
