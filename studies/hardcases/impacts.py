"""Hard cases without viscosity: two gases that meet, or a stream that meets a body.

Riemann problems: gases meet in the middle of a periodic strip of four units; near its ends one gas changes
linearly into the other. Waves from there do not reach the quarter of the strip that is compared.
`cells` : spacings in Toro's unit of length.
"""
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.exact.riemann import GasState, middle, solution
from continuum.fluid import ConstEta, IdealGas
from particles.fields import Fields
from studies.build.scenes import Scene, Start
from studies.hardcases.printed import BELOW, HEAVY, LIGHT, TALL, WIDTH, Impulse, impulse, jittered

EOS, GAMMA = IdealGas(cv=2.5), 1.4
DENSE, THIN = GasState(1.0, 0.0, 1.0), GasState(0.125, 0.0, 0.1)       # of Sod's tube
HEIGHT = 9.0
SHIFT = 0.05        # largest shift over the cell: a perfect lattice keeps its rows in such a flow
WINDOW, EVEN, CLOSED = 0.5, 1.8, 2.0        # ends of window, uniform gas, strip: units from the middle
MACH = 3.0          # of the stream past a disc
STEEP = 0.25        # k a of the ripple before the shock
HOT = 0.7           # temperature between those of the light gas, 1 or more, and of the heavy gas, 0.5 or less


def radii(at: Fields) -> np.ndarray:
    """Distances (n,) from the middle of the box."""
    return np.hypot(*at.x.T)


@dataclass(frozen=True, kw_only=True)
class Frictionless(Scene):
    """A square of L rows of a gas without viscosity."""
    L: int
    law: ConstEta = ConstEta(0.0, 0.0)  # noqa: RUF009 (immutable)
    wide: ClassVar[int] = 1         # width over L

    @property
    def width(self) -> int:  # type: ignore[override]
        return self.wide*self.L


def pitot(mach: float, gamma: float) -> float:
    """Stagnation pressure behind a bow shock over the pressure of the stream    [Rayleigh 1910]"""
    behind = 2*gamma/(gamma + 1)*mach**2 - (gamma - 1)/(gamma + 1)
    return float(((gamma + 1)/2*mach**2)**(gamma/(gamma - 1))/behind**(1/(gamma - 1)))


@dataclass(frozen=True, kw_only=True)
class Bow(Frictionless):
    """A disc at rest, suddenly in a stream of Mach 3; its diameter is a sixth of the channel. At the end the
    shock has settled for 5 R/c, and no wave has come around the periodic box."""
    eos: Any = EOS
    speed: ClassVar[float] = MACH*GAMMA**0.5
    wide: ClassVar[int] = 2

    @property
    def disc(self) -> float:
        return self.L/12

    @property
    def time(self) -> float:
        return 1.7*self.L/self.fastest

    @property
    def fastest(self) -> float:
        """Largest |v| + c, at c = |v|/5 in gas that expands into the wake: v^2 + 5 c^2 is constant there."""
        return float((1.2*(self.speed**2 + 5*GAMMA))**0.5)

    def fields(self, x: np.ndarray) -> Start:
        one = np.ones(len(x))
        return one, np.stack([self.speed*one, 0*one], axis=1), one

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Pressure at the foremost points of the disc over the exact stagnation pressure."""
        edge = np.flatnonzero(np.isclose(radii(at), self.disc))
        front = edge[np.isclose(at.x[edge, 0], at.x[edge, 0].min())]
        return {"measured": float((at.rho*at.T)[front].mean()/pitot(MACH, GAMMA))}


@dataclass(frozen=True, kw_only=True)
class Ripple(Frictionless):
    """The rippled interface of KHP95's Fig. 11 and its mirror image, L rows in all: gases fall onto y = 0,
    from where a shock of Mach 1.5 comes back. Cells that the interface cuts hold a share of both gases."""
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
        """Time at which the reflected shock reaches the mirror."""
        return self.theory.back

    @property
    def fastest(self) -> float:
        """|v| + c of the falling light gas, which is more than in shocked gas."""
        return float(self.theory.fall + (2*LIGHT.P/LIGHT.rho)**0.5)

    def fields(self, x: np.ndarray) -> Start:
        k = 2*np.pi/self.width
        height = BELOW*self.scale + STEEP/k*np.cos(k*x[:, 0])
        heavy = np.clip(np.abs(x[:, 1]) - height + 0.5, 0, 1)
        rho = LIGHT.rho + heavy*(HEAVY.rho - LIGHT.rho)
        return rho, np.stack([0*rho, -self.theory.fall*np.sign(x[:, 1])], axis=1), LIGHT.P/rho

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Growth of the ripple since the shock over that of theory, from the columns of a lattice."""
        order = np.lexsort((at.x[:, 1], at.x[:, 0]))
        x, y, T = (q[order].reshape(self.width, self.L)[:, self.L//2:] for q in (*at.x.T, at.T))
        last, column = (T > HOT).cumsum(axis=1).argmax(axis=1), np.arange(self.width)
        inside, beyond = T[column, last], T[column, last + 1]
        height = y[column, last] + (inside - HOT)/(inside - beyond)
        ripple = 2*np.mean(height*np.cos(2*np.pi/self.width*x[:, 0]))
        expected = self.theory.growth*(self.time - self.theory.meets)
        return {"measured": float((ripple - self.theory.amplitude)/expected)}


# --- Riemann problems ---------------------------------------------------------------------------------------

class Problem(NamedTuple):
    """Both gases, and the time at the end, when waves have gone half a unit at most."""
    left: GasState
    right: GasState
    time: float


def collision(mach: float) -> Problem:
    """Gases that collide and rest behind shocks of a Mach number, until these are 0.25 units away."""
    c = GAMMA**0.5
    v = 2*c/(GAMMA + 1)*(mach - 1/mach)
    return Problem(GasState(1.0, v, 1.0), GasState(1.0, -v, 1.0), 0.25/(mach*c - v))


def wiggles(v: np.ndarray, truth: np.ndarray) -> float:
    """Total variation of a velocity over that of the exact one, less 1."""
    variation, expected = np.abs(np.diff([v, truth])).sum(axis=1)
    return float(variation/expected - 1)


#: Toro's problems, their times with two digits; a near vacuum of density 1e-6
PROBLEMS = {
    "Sod": Problem(DENSE, THIN, 0.2),
    "Toro 1": Problem(GasState(1.0, 0.75, 1.0), GasState(0.125, 0.0, 0.1), 0.2),
    "Toro 2": Problem(GasState(1.0, -2.0, 0.4), GasState(1.0, 2.0, 0.4), 0.15),
    "Toro 3": Problem(GasState(1.0, 0.0, 1000.0), GasState(1.0, 0.0, 0.01), 0.012),
    "Toro 4": Problem(GasState(5.99924, 19.5975, 460.894), GasState(5.99242, -6.19633, 46.095), 0.035),
    "Toro 5": Problem(GasState(1.0, -19.59745, 1000.0), GasState(1.0, -19.59745, 0.01), 0.012),
    "vacuum 1e-6": Problem(GasState(1.0, 0.0, 1.0), GasState(1e-6, 0.0, 1e-6), 0.08),
    "Mach 10": collision(10.0),
    "Mach 100": collision(100.0),
}


@dataclass(frozen=True, kw_only=True)
class Strip(Scene):
    """A Riemann problem in a strip of four units; gases meet at x = 0; densities are over the left gas's."""
    problem: Problem
    cells: int
    eos: object = EOS
    law: ConstEta = ConstEta(0.0, 0.0)  # noqa: RUF009 (immutable)
    L: float = HEIGHT

    counted = "cells"

    @property
    def width(self) -> float:  # type: ignore[override]
        return 2*CLOSED*self.cells

    @property
    def time(self) -> float:
        return self.problem.time*self.cells

    @property
    def fastest(self) -> float:
        """Largest |v| + c of both gases and of the states between the waves."""
        left, right, _ = self.problem
        v, P, *densities = middle(left, right, GAMMA)
        states = (left, right, *(GasState(rho, v, P) for rho in densities))
        return max(abs(gas.v) + (GAMMA*gas.P/gas.rho)**0.5 for gas in states)

    def fields(self, x: np.ndarray) -> Start:
        along, unit = x[:, 0], self.problem.left.rho
        left, right = (np.array(gas)[:, None] for gas in self.problem[:2])
        over = np.clip((np.abs(along)/self.cells - EVEN)/(CLOSED - EVEN), 0, 1)/2
        own, other = np.where(along < 0, left, right), np.where(along < 0, right, left)
        rho, v, P = (own + over*(other - own))/np.array([[unit], [1.0], [unit]])
        return rho, np.stack([v, 0*v], axis=1), P/rho

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        """Places of particles of one mass, in columns and rows by the density of each gas, and fields."""
        rng, parts = np.random.default_rng(seed), []
        for gas, left in ((self.problem.left, -CLOSED), (self.problem.right, 0.0)):
            number = 2*self.cells*HEIGHT*gas.rho/self.problem.left.rho
            rows = max(1, round((number*HEIGHT/2/self.cells)**0.5))
            counts = round(number/rows), rows
            cell = 2*self.cells/max(counts[0], 1), HEIGHT/rows
            parts.append(jittered(counts, cell, (left*self.cells, -HEIGHT/2), SHIFT, rng).T)
        x = np.concatenate(parts)
        return x, self.fields(x)

    def seen(self, first: Fields, at: Fields) -> dict[str, float]:
        """Mean errors of density, velocity, pressure over their ranges; `measured`: the largest, in spacings;
        variation of v beyond the exact one; largest error of the states between the waves."""
        left, right, time = self.problem
        here = np.abs(at.x[:, 0]) < WINDOW*self.cells
        x, V = at.x[here, 0], at.V[here]
        exact = solution(left, right, GAMMA, x/self.cells/time)
        has = np.array([at.rho*left.rho, at.v[:, 0], at.rho*at.T*left.rho])[:, here]
        errors = np.abs(has - exact)@V/V.sum()/np.ptp(exact, axis=1)
        order = np.argsort(x, kind="stable")
        rows = int(self.L)
        level = [q[order][:len(x)//rows*rows].reshape(-1, rows).mean(axis=1) for q in (has[1], exact[1])]
        between = middle(left, right, GAMMA)
        flat = [np.isclose(exact[0], rho) & np.isclose(exact[2], between.P) for rho in between[2:]]
        off = [np.median(q[side])/q_exact[side][0] - 1 for q, q_exact in zip(has[::2], exact[::2])
               for side in flat if side.any()]
        return {"measured": float(errors.max()*self.cells), "wiggles": wiggles(*level),
                "plateau": float(np.abs(off).max(initial=0)),
                **dict(zip(("rho_exact", "v_exact", "P_exact"), map(float, errors)))}
