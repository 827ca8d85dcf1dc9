"""What decides the drag of a body of frozen particles: its surface changed one thing at a time, on a cylinder and a flat wall

Surfaces: as frozen; `turned back`, by which nothing enters; `dense`, frozen from a denser fluid, which pushes all out.
A stream between flat walls of each says how far the fluid slips along it, by the shape of its profile, without a viscosity and
without a drag. Then `dpd_derive_surfaces` has the drag that hydrodynamics gives to a cylinder along which the fluid slips so.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import stdtrit

from particles.dissipative.dpd import Dpd
from particles.dissipative.stream import DpdStream, speed
from particles.run import Run, run
from studies.kit.case import Outcome, Report
from studies.kit.stats import Measured, mean
from studies.kit.table import Table
from studies.noise.dpd.cylinder import SETTLED, Cylinder, Inside
from studies.noise.dpd.frozen import DEPTH, ETA, Frozen, free_temperature
from studies.noise.dpd.runs import BATCHES

ARRAY = ["surface", "radius", "asked"]
#: streams past cylinders, solid fraction 0.2, at about the Reynolds number `asked`: momentum of the fluid along x, its part in
#: the cylinder over all of it (carried), density farther than a range outside (far), of free particles in the cylinder (inside),
#: of frozen ones (frozen), force on what is frozen over push less 1 (balance)
ARRAYS = Table("arrays", key=ARRAY, columns=[
    *ARRAY, "dt", "side", "depth", "n", "held", "frozen", "time", "push", "momentum", "momentum_err", "carried", "carried_err",
    "balance", "balance_err", "inside", "far", "kinetic", "kinetic_err"])
#: streams between flat walls |y| = height/2: slip length there, and viscosity at the density `far` from them, from a parabola
#: through velocities farther than a range from the walls; inside: density of free particles in the wall
SLABS = Table("slabs", key=["surface"], columns=[
    "surface", "dt", "height", "thick", "side", "depth", "n", "held", "frozen", "time", "push", "slip", "slip_err", "viscosity",
    "viscosity_err", "inside", "far", "momentum", "momentum_err", "kinetic", "kinetic_err"])
#: density and velocity of free particles across the stream; nan where there are none
PROFILE = Table("profile", key=["surface", "y"], columns=["surface", "y", "rho", "u", "u_err"])
ALL = (ARRAYS, SLABS, PROFILE)

DENSER = 2.0        # of the dense surface over the fluid
FAST = 3.5          # Reynolds number that surfaces are compared at: what chance leaves of a speed is as one over the force
BIN = 0.25          # of the profile
LEGS = BATCHES      # runs of a slab, for errors


@dataclass(frozen=True, kw_only=True)
class Surface(Frozen):
    """A stream along a body that is `denser` times as dense as the fluid."""
    denser: float = 1.0

    @property
    def surface(self) -> str:
        return "dense" if self.denser != 1 else "turned back" if self.turns else "frozen"

    def filled(self, still: Dpd, inside: Callable) -> np.ndarray:
        """Particles of the whole box (9, n), those inside of a denser fluid, settled apart."""
        state = super().filled(still, inside)
        if self.denser == 1:
            return state
        other = replace(self, rho=self.denser*self.rho).settled(still)
        return np.concatenate([state[:, ~inside(state[:3])], other[:, inside(other[:3])]], axis=1)


@dataclass(frozen=True, kw_only=True)
class Array(Surface, Cylinder):
    """A stream past cylinders."""
    seed: int = 2       # not the freezing of the first runs

    @property
    def label(self) -> str:
        return f"Surface {self.surface} of a cylinder of radius {self.radius:g}, Re {self.reynolds:g}"

    @property
    def settling(self) -> float:
        """As `SETTLED` for radius 2; mass over drag grows as the square."""
        return SETTLED*(self.radius/2)**2

    def watched(self, inside: Inside) -> dict[str, Any]:
        """What is recorded."""
        return {**super().watched(inside), "far": inside.far, "carried": inside.carried}

    def run(self, report: Report, folder: Path) -> Outcome:
        method, n, done = self.streamed(report)
        free, body, cell = n - len(method.held), np.pi*self.radius**2*DEPTH, self.cell**2*DEPTH
        (U, U_err), (carried, carried_err), (kinetic, kinetic_err) = (mean(done.series[name])
                                                                      for name in ("speed", "carried", "kinetic"))
        pushed = method.push*free
        return Outcome({"arrays": [{
            "surface": self.surface, "radius": self.radius, "asked": self.reynolds, "dt": self.dt, "side": self.cell,
            "depth": DEPTH, "n": n, "held": len(method.held), "frozen": len(method.held)/body, "time": self.time,
            "push": method.push, "momentum": n*U, "momentum_err": n*U_err, "carried": carried/(n*U),
            "carried_err": carried_err/(n*U), "balance": float(np.mean(done.series["force"]))/pushed - 1,
            # momentum at the start and at the end: two of variance free kT
            "balance_err": 1.96*np.sqrt(2*free*self.kT)/(pushed*self.time), "inside": np.mean(done.series["inside"])/body,
            "far": np.mean(done.series["far"])/(cell - body*(1 + 1/self.radius)**2), "kinetic": kinetic,
            "kinetic_err": kinetic_err, "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}]})


class Beyond:
    """Whether particles are in a wall beyond |y| = height/2 of each period."""

    def __init__(self, height: float, period: float):
        self.height, self.period = height, period

    def place(self, x: np.ndarray) -> np.ndarray:
        """y (n,) in the period."""
        return x[1] - self.period*np.round(x[1]/self.period)

    def __call__(self, x: np.ndarray) -> np.ndarray:
        return np.abs(self.place(x)) > self.height/2

    def turned(self, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Inside and on the way in."""
        return self(x) & (self.place(x)*v[1] > 0)

    def across(self) -> np.ndarray:
        """Middles of the bins."""
        return (np.arange(round(self.period/BIN)) + 0.5)*BIN - self.period/2

    def profile(self, sums, state: np.ndarray) -> np.ndarray:
        """Free particles and their momentum along x in bins (2, bins)."""
        free = ~sums.is_held[sums.now.ids]
        y, bins, ends = self.place(state[:, free]), round(self.period/BIN), (-self.period/2, self.period/2)
        return np.array([np.histogram(y, bins, ends)[0], np.histogram(y, bins, ends, weights=state[3, free])[0]])


@dataclass(frozen=True, kw_only=True)
class Slab(Surface):
    """A stream between flat walls, of about this shear rate at them.

    thick : of the wall, so that fluid on one side knows nothing of that on the other.
    """
    rate: float = 0.3
    height: float = 8.0
    thick: float = 3.0
    side: float = 6.0

    @property
    def label(self) -> str:
        return f"Surface {self.surface} of a flat wall"

    @property
    def cost(self) -> float:
        return 1e-6*self.rho*self.side*(self.height + self.thick)*DEPTH*(self.time + self.settling)/self.dt

    @property
    def settling(self) -> float:
        """Six times height^2/(pi^2 nu), in which a profile is forgotten."""
        return 6*self.rho*self.height**2/(np.pi**2*ETA)

    def run(self, report: Report, folder: Path) -> Outcome:
        period = self.height + self.thick
        inside = Beyond(self.height, period)
        method, start = self.stream((self.side, period), inside, push=2*ETA*self.rate/(self.height*self.rho),
                                    U=self.rate*self.height/6)
        legs = self.legs(method, inside, start, report)
        return Outcome({"slabs": [self._row(method, inside, legs)], "profile": self._profile(inside, legs)})

    def legs(self, method: DpdStream, inside: Beyond, state: np.ndarray, report: Report) -> list[Run]:
        """Runs, one after the other."""
        found = list[Run]()
        plan = self.records(self.time/LEGS, series={"speed": speed, "kinetic": free_temperature},
                            means={"profile": inside.profile})
        for leg in range(LEGS):
            found.append(run(self.again(method, leg), state, plan))
            state = found[-1].by_id()
            report((leg + 1)/LEGS)
        return found

    def layer(self) -> float:
        """Volume of a bin."""
        return BIN*self.side*DEPTH

    def _row(self, method: DpdStream, inside: Beyond, legs: list[Run]) -> dict[str, Any]:
        counts = np.array([leg.means["profile"] for leg in legs])
        y, n = inside.across(), method.held.size
        far, wall = np.abs(y) < self.height/2 - 1, np.abs(y) > self.height/2
        rho = counts[:, 0].mean(axis=0)/self.layer()

        def of(parts: np.ndarray) -> np.ndarray:
            return parabola(y[far], parts[:, 1, far].sum(axis=0)/parts[:, 0, far].sum(axis=0), self.height/2)
        (slip, slip_err), (bend, bend_err) = jackknife(of, counts)
        (U, U_err), (kinetic, kinetic_err) = (mean(np.concatenate([leg.series[name] for leg in legs]))
                                              for name in ("speed", "kinetic"))
        particles = legs[0].state.shape[1]
        viscosity = method.push*rho[far].mean()/bend
        return {"surface": self.surface, "dt": self.dt, "height": self.height, "thick": self.thick, "side": self.side,
                "depth": DEPTH, "n": particles, "held": n, "frozen": n/(self.side*self.thick*DEPTH), "time": self.time,
                "push": method.push, "slip": slip, "slip_err": slip_err, "viscosity": viscosity,
                "viscosity_err": viscosity*bend_err/bend, "inside": rho[wall].mean(), "far": rho[far].mean(),
                "momentum": particles*U, "momentum_err": particles*U_err, "kinetic": kinetic, "kinetic_err": kinetic_err,
                "seed": self.seed, "cpu_s": sum(leg.cpu_s for leg in legs), "compile_s": legs[0].compile_s}

    def _profile(self, inside: Beyond, legs: list[Run]) -> list[dict[str, Any]]:
        counts = np.array([leg.means["profile"] for leg in legs])
        rho = counts[:, 0].mean(axis=0)/self.layer()
        with np.errstate(invalid="ignore"):
            found = [jackknife(lambda parts, k=k: parts[:, 1, [k]].sum(axis=0)/parts[:, 0, [k]].sum(axis=0), counts)[0]
                     for k in range(len(rho))]
        return [{"surface": self.surface, "y": at, "rho": density, "u": u.value, "u_err": u.err}
                for at, density, u in zip(inside.across(), rho, found, strict=True)]


def parabola(y: np.ndarray, u: np.ndarray, wall: float) -> np.ndarray:
    """Slip length at y = wall and the bend -u'' of u = u_0 - bend y^2/2 through velocities u at y."""
    u_0, half = np.linalg.lstsq(np.stack([np.ones_like(y), -y**2], axis=1), u, rcond=None)[0]
    return np.array([(u_0 - half*wall**2)/(2*half*wall), 2*half])


def jackknife(of: Any, parts: np.ndarray) -> list[Measured]:
    """Numbers of all parts (b, ...) together; errors from those without each part in turn."""
    b = len(parts)
    without = np.array([of(np.delete(parts, k, axis=0)) for k in range(b)])
    err = stdtrit(b - 1, 0.975)*np.sqrt((b - 1)/b*((without - without.mean(axis=0))**2).sum(axis=0))
    return [Measured(float(value), float(e)) for value, e in zip(of(parts), err, strict=True)]
