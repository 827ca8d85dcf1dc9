"""Long runs at the usual step: kT of velocities and of positions, pressure; judged below.

Runs of 240 left open whether kT is off by less than 1 %, and so did one of 500 with Shardlow's splitting; the pressure has the
noise of the velocities in it. Here the configurational kT is one ratio of means, which is not off by 1/n, and the pressure has
rho kT with the kT that is asked for, as that of Allen & Tildesley has.
"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import hypot
from pathlib import Path

import numpy as np

from particles.dissipative import shadow_hamiltonian as shadow
from particles.dissipative.integrators import GrootWarren, GrootWarren65, Shardlow, VelocityVerlet
from particles.dissipative.observe import kinetic_temperature, pressure
from particles.integral.splitting import KickDriftFrictionDriftKick
from particles.run import run
from studies.build.read import Value, select
from studies.kit.case import Outcome, Report
from studies.kit.claim import Claim
from studies.kit.stats import Measured, mean
from studies.kit.table import Table, Tables
from studies.noise.dpd.runs import Fluid

KEY = ["integrator", "a", "rho", "side", "dt"]
#: kinetic and configurational kT, and P with rho kT as it is asked for
LONG = Table("long", key=KEY, columns=[*KEY, "n", "time", "kinetic", "kinetic_err", "configurational", "configurational_err",
                                       "P", "P_err"])
GOOD = {Shardlow: "Shardlow's splitting", KickDriftFrictionDriftKick: "kick, drift, friction, drift, kick",
        GrootWarren: "Groot-Warren with lambda = 1/2", GrootWarren65: "Groot-Warren with lambda = 0.65",
        VelocityVerlet: "velocity-Verlet with friction evaluated again"}
#: decided by the first length; all others have the longer one
DECIDED = (KickDriftFrictionDriftKick,)


@dataclass(frozen=True, kw_only=True)
class Long(Fluid):
    """A fluid at rest, for a long time."""

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.method(), self.settled(self.method())
        n, V = start.shape[1], method.volume
        series: dict[str, Callable] = {"kinetic": kinetic_temperature, "F2": shadow.forces_squared, "lap": shadow.laplacian,
                                       "P": pressure}
        done = run(method, start, self.plan(series=series), report)
        kinetic, F2, lap, P = (np.array(done.series[name]) for name in series)
        ratio = F2.mean()/lap.mean()
        found = {"kinetic": mean(kinetic), "configurational": Measured(ratio, mean((F2 - ratio*lap)/lap.mean()).err),
                 "P": mean(P - n/V*(kinetic - self.kT))}
        row = {"integrator": self.integrator.__name__, "a": self.a, "rho": n/V, "side": self.side, "dt": self.dt, "n": n,
               "time": self.time, "seed": self.seed, "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        for name, (value, err) in found.items():
            row |= {name: value, f"{name}_err": err}
        return Outcome({"long": [row]})


def cases(*, side: float, time: float, longer: float) -> Iterator[Long]:
    """All, for the time that decided them."""
    yield from (Long(integrator=integrator, side=side, time=time if integrator in DECIDED else longer) for integrator in GOOD)


def why(integrator: type) -> str:
    """What the length of a run comes from."""
    if integrator in (*DECIDED, Shardlow):
        return "runs twice as long as those that left it open"
    return "the length raised to 1500 because runs of 240 left it open"


# --- judged -----------------------------------------------------------------------------------------------------------------


def off(temperature: str, integrator: type) -> Value:
    """|kT - 1| at dt = 0.02."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "long", integrator=integrator.__name__, dt=0.02).iloc[0]
        return Measured(abs(float(row[temperature]) - 1), float(row[f"{temperature}_err"]))
    return value


def asked(tables: Tables) -> Measured:
    """P of the order of parts whose positions err least."""
    row = select(tables, "long", integrator=KickDriftFrictionDriftKick.__name__).iloc[0]
    return Measured(float(row["P"]), float(row["P_err"]))


def over_verlet(tables: Tables) -> Measured:
    """Error of the configurational kT with friction in the middle over that with friction first, dt = 0.06."""
    one, other = (select(tables, "states", integrator=integrator.__name__, dt=0.06, a=25.0, rho=3.0, d=3, kT=1.0).iloc[0]
                  for integrator in (KickDriftFrictionDriftKick, Shardlow))
    a, b = (float(row["configurational"]) - 1 for row in (one, other))
    return Measured(abs(a/b), hypot(one["configurational_err"], a/b*other["configurational_err"])/abs(b))


CLAIMS = (
    *(Claim(id=f"own-dpd-long-{temperature}-{integrator.__name__.lower()}", source="Groot & Warren 1997",
            printed="dt = 0.04 to 0.06", at_most=0.01, value=off(temperature, integrator),
            statement=f"{words} keeps the {temperature} kT within 1 % at dt = 0.02: |error|, {why(integrator)}",
            because="1 % is what the paper wants of a step of good integrators")
      for integrator, words in GOOD.items() for temperature in ("kinetic", "configurational")),
    Claim(id="own-dpd-middle", source="Leimkuhler & Matthews 2013", at_most=0.5, value=over_verlet,
          statement="with friction and noise in the middle of the step positions know their kT better than with Verlet's rule "
                    "after friction: error of the configurational kT over that of Shardlow's splitting, dt = 0.06",
          because="a half: of one harmonic frequency nothing is left, and repulsion is harmonic but for its end at rc and for "
                  "the turning of pairs"),
    Claim(id="own-dpd-pressure-asked", source="Allen & Tildesley 2017, example dpd", printed="23.635 to 23.637", expect=23.64,
          within=0.02, value=asked,
          statement="pressure of dissipative particles at a = 25, rho = 3, kT = 1, with rho kT as it is asked for, which print "
                    "has, friction in the middle of the step, dt = 0.02; the same pressure with the velocities' kT had been "
                    "left open", because="0.1 %"),
)
ALL = (LONG,)
