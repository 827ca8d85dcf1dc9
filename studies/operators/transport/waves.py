"""Transport coefficients measured from small waves that decay, in 2D, as cases    [RR98 Eqs 34-38, 51]

Density, velocities along and across k, and temperature get a wave each in turn; RK4 advances the full equations, and what all
four have become after equal times are propagators U_1, U_2, U_3 (4, 4) of the amplitudes. log(U_3 U_2^-1)/t is the matrix of
rates: on points off a lattice what is no plane wave has died out or rings by then.
"""
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
from scipy.linalg import logm

from continuum.exact.waves import QUANTITIES, Gas, Waves, continuum, quantities
from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Dih, Nested, Pairwise
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.integrators import RK4
from particles.threads import Team
from studies.build.disorder import Disorder
from studies.build.symbols import lattice_waves
from studies.kit.case import Case, Outcome, Report

AMPLITUDE = 1e-5    # squared, it is the share of waves that feed back on the first; round-off over it is 1e-11
STEPS = 10          # at least, in a radian of sound: RK4 is off by 5 (1/10)^4/120 of a rate
TRUNCATION = 5*STEPS**-4/120
MARGIN = 1.25       # of the step to its limit
#: of Eqs 37, 38 and of Eq. 51
TRANSPORT = {"nested": Nested(), "pairwise": Pairwise()}
ETA, KAPPA = 0.3, 0.4


def propagators(dih: Dih, points: Points, k: np.ndarray, time: float, phases: tuple[float, ...]) -> np.ndarray:
    """U (2 or 3, 4, 4) of amplitudes (rho, u along k, T, v across k) after `time`, twice and off a lattice three times that.

    phases : 0 alone where all places are alike, (0, pi/2) where they are not: exp(ik.r) by its real and imaginary part.
    """
    n = k/np.hypot(*k)
    frame, place, steps = np.array([n, [-n[1], n[0]]]), points.x@k, max(STEPS, ceil(MARGIN*time/step_limit(dih)))
    U = np.zeros((2 if len(phases) == 1 else 3, 4, 4), complex)
    for field in range(4):
        for phase in phases:
            wave = AMPLITUDE*np.cos(place - phase)
            state = start(dih, wave, field, frame)
            integrator = RK4(state.shape, Team(1))
            for part in range(len(U)):
                for _ in range(steps):
                    integrator.step(dih, state, time/steps)
                U[part, :, field] += np.exp(1j*phase)*amplitudes(dih, state, place, frame)*2/len(phases)
    return U/AMPLITUDE


def start(dih: Dih, wave: np.ndarray, field: int, frame: np.ndarray) -> np.ndarray:
    """Rest at rho = T = 1, with a wave in one of (rho, u, T, v)."""
    rho, u, T, v = (1.0*(number in (0, 2)) + wave*(number == field) for number in range(4))
    return dih.state(rho, u[:, None]*frame[0] + v[:, None]*frame[1], T)


def amplitudes(dih: Dih, state: np.ndarray, place: np.ndarray, frame: np.ndarray) -> np.ndarray:
    """Parts exp(ik.r) of (rho, u, T, v)."""
    flow, V = dih.flow(state), dih.edges.V
    fields = np.stack([flow.rho - 1, flow.v@frame[0], flow.T - 1, flow.v@frame[1]])
    return fields@(V*np.exp(-1j*place))/V.sum()


def step_limit(dih: Dih) -> float:
    """RK4: the fastest sound and the fastest diffusion that the edges know, at rho = T = 1."""
    sound, spread = dih.edges.fastest
    return 1/(np.sqrt(2)*sound/2.82 + (ETA + dih.zeta + KAPPA)*spread/2.78)


def rates(U: np.ndarray, time: float) -> list[Waves]:
    """From the last two of the times."""
    found, ends = [], [np.eye(4), *U]
    for before, after in (ends[-3:-1], ends[-2:]):
        M = logm(after@np.linalg.inv(before))/time
        found.append(Waves(M[:3, :3], float(-M[3, 3].real)))
    return found


def measured(dih: Dih, points: Points, k: np.ndarray, phases: tuple[float, ...]) -> dict[str, tuple[float, float]]:
    """Quantities and their errors: what the last two times differ by, and RK4's own."""
    size = float(np.hypot(*k))
    time = 1/float(np.abs(np.linalg.eigvals(continuum(Gas(ETA, dih.zeta, KAPPA), size).matrix)).max())
    before, last = (quantities(one, size) for one in rates(propagators(dih, points, k, time, phases), time))
    return {name: (last[name], abs(last[name] - before[name]) + TRUNCATION*abs(last[name])) for name in QUANTITIES}


@dataclass(frozen=True, kw_only=True)
class Decay(Case):
    """Waves of one length on one set of points.

    transport : name in TRANSPORT. make : of `particles.integral.edge_makers.MAKERS`. weight : class, its range h in spacings. counts : points
    along x and y. turns : whole waves along x and y, (1, 0) or (1, 1).
    """
    transport: str
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    counts: tuple[int, int]
    turns: tuple[int, int] = (1, 0)
    zeta: float = 0.0
    seed: int = 1

    @property
    def cost(self) -> float:
        points, edges = self.counts[0]*self.counts[1], 3 if self.maker == "delaunay" else 1.6*self.h**2
        return (320 if self.even else 1200)*(2e-4 + 3e-7*points*edges)

    @property
    def even(self) -> bool:
        """Are all places alike?"""
        return self.disorder.name == "lattice"

    @property
    def label(self) -> str:
        return (f"{self.transport} {self.maker} {self.weight.__name__} h {self.h:g}, {self.disorder.name}, {self.counts}, "
                f"zeta {self.zeta:g}, seed {self.seed}")

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        k, weight = 2*np.pi*np.array(self.turns)/np.array(self.counts), self.weight.of(h=self.h)
        size, gas = float(np.hypot(*k)), Gas(ETA, self.zeta, KAPPA)
        exactly = quantities(continuum(gas, size), size)
        symbol = quantities(lattice_waves(gas, weight, k, self.transport == "nested"), size) if self.even else {}
        try:
            edges = self.make(points, weight)
        except ArithmeticError:     # no such edges exist on these points: that is a result
            return Outcome({"waves": [self._row(name, size, (np.nan, np.nan), symbol, exactly) for name in QUANTITIES]})
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=self.zeta, transport=TRANSPORT[self.transport])
        found = measured(dih, points, k, (0.0,) if self.even else (0.0, np.pi/2))
        return Outcome({"waves": [self._row(name, size, found[name], symbol, exactly) for name in QUANTITIES]})

    def _row(self, quantity: str, k: float, found: tuple[float, float], symbol: dict, exactly: dict) -> dict[str, Any]:
        direction = "axis" if 0 in self.turns else "diagonal"
        return {"transport": self.transport, "maker": self.maker, "weight": self.weight.__name__, "h": self.h,
                "points": self.disorder.name, "direction": direction, "zeta": self.zeta, "wavelength": 2*np.pi/k,
                "seed": self.seed, "quantity": quantity, "measured": found[0], "measured_err": found[1],
                "lattice": symbol.get(quantity, np.nan), "continuum": exactly[quantity]}
