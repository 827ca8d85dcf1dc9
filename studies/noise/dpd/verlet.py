"""Why a step puts kT of positions off: the energy that Verlet's rule follows, from averages at a short step; kT at longer ones"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from particles.dissipative import shadow_hamiltonian as shadow
from particles.dissipative.observe import kinetic_temperature
from particles.run import run
from studies.kit.case import Outcome, Report
from studies.kit.stats import combine, mean
from studies.kit.table import Table
from studies.noise.dpd.runs import BATCHES, Fluid

#: averages in a short step, and what dt^2 multiplies in kT/kT_0 - 1 by these: `particles.dissipative.shadow_hamiltonian`; omega2 = <lap U>/(3 n)
STIFFNESS = Table("stiffness", key=["a", "rho", "side", "dt"], columns=[
    "a", "rho", "side", "dt", "n", "time", "omega2", "omega2_err", "friction", "friction_err", "bath", "bath_err", "kinetic",
    "kinetic_err", "configurational", "configurational_err", "batches"])
#: kinetic and configurational kT/kT_0, the latter as one ratio of means, which is not off by 1/n
STEPS = Table("dpd_steps", key=["integrator", "a", "rho", "side", "dt"], columns=[
    "integrator", "a", "rho", "side", "dt", "n", "time", "kinetic", "kinetic_err", "configurational", "configurational_err"])
#: kT/kT_0 - 1 = second dt^2 + fourth dt^4 through the STEPS of an integrator (`long`), or through these and those of the table
#: `states` up to 0.06 (`all`); predicted: from STIFFNESS
SECOND = Table("second", key=["integrator", "runs", "temperature"], columns=[
    "integrator", "runs", "temperature", "steps", "second", "second_err", "fourth", "fourth_err", "predicted", "predicted_err"])
ALL = (STIFFNESS, STEPS, SECOND)


@dataclass(frozen=True, kw_only=True)
class Stiffness(Fluid):
    """What the second order is made of."""

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.method(), self.settled(self.method())
        series = {"F2": shadow.forces_squared, "lap": shadow.laplacian, "FKF": shadow.forces_curved,
                  "KG": shadow.friction_curved, "G": shadow.friction}
        done, n = run(method, start, self.plan(series=series), report), start.shape[1]
        found = {name: np.array_split(done.series[name], BATCHES) for name in series}
        second = [shadow.second_order(n, self.kT, *parts) for parts in zip(*found.values(), strict=True)]
        row = {"a": self.a, "rho": n/method.volume, "side": self.side, "dt": self.dt, "n": n, "time": self.time,
               "seed": self.seed, "batches": BATCHES, "cpu_s": done.cpu_s, "compile_s": done.compile_s}
        for name, values in (("omega2", [part.mean()/3 for part in found["lap"]]),
                             ("friction", [part.mean()/3 for part in found["G"]]),
                             *((name, [getattr(one, name) for one in second]) for name in shadow.Second._fields)):
            row[name], row[f"{name}_err"] = combine([(float(value), 0.0) for value in values])
        return Outcome({"stiffness": [row]})


@dataclass(frozen=True, kw_only=True)
class Steps(Fluid):
    """kT at one step."""

    def run(self, report: Report, folder: Path) -> Outcome:
        method, start = self.method(), self.settled(self.method())
        series = {"kinetic": kinetic_temperature, "F2": shadow.forces_squared, "lap": shadow.laplacian}
        done = run(method, start, self.plan(series=series), report)
        F2, lap = np.array(done.series["F2"]), np.array(done.series["lap"])
        ratio = F2.mean()/lap.mean()
        (kinetic, kinetic_err), (_, err) = mean(done.series["kinetic"]), mean((F2 - ratio*lap)/lap.mean())
        return Outcome({"dpd_steps": [{
            "integrator": self.integrator.__name__, "a": self.a, "rho": start.shape[1]/method.volume, "side": self.side,
            "dt": self.dt, "n": start.shape[1], "time": self.time, "kinetic": kinetic/self.kT, "kinetic_err": kinetic_err/self.kT,
            "configurational": ratio/self.kT, "configurational_err": err/self.kT, "seed": self.seed, "cpu_s": done.cpu_s,
            "compile_s": done.compile_s}]})
