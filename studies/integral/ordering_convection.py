"""Rayleigh-Benard on fixed points, a case of the error surface: K by range, disorder and rows    [RR98 Eqs 34-38]"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.scene import RayleighBenard
from particles.integrators import RK4
from particles.run import Run
from studies.convection.dih import SCHEMES, DihRun, Scheme
from studies.convection.points import Setting
from studies.kit.case import Outcome, Report

RA = 1e4
#: kinds of irregular points between rows of points on the plates, edges of a triangulation
PLATES = {"jittered-0.3": SCHEMES["fixed-jittered-plates"], "random": SCHEMES["fixed-random-plates"],
          "relaxed": SCHEMES["relaxed-plates"]}


def on_lattice(h: float) -> Scheme:
    """Lucy's weight of another range."""
    return Scheme(f"fixed-lattice-h{h:g}", h=h)


@dataclass(frozen=True, kw_only=True)
class Convection(DihRun):
    """One run at Ra = 10 000; `kind`: of its points, as the tables of this study have it."""
    kind: str

    def values(self, setting: Setting, done: Run) -> dict:
        """Those of the scene, and exchanges over edges, to images among them."""
        edges, beyond = setting.method.edges, getattr(setting.method, "beyond", None)
        number = len(edges.i) + (len(beyond.i) if beyond else 0)
        return {**super().values(setting, done), "exchanges": RK4.evaluations*done.step*number}

    def run(self, report: Report, folder: Path) -> Outcome:
        """A row of `convection` in place of one of `kinetic_energy`."""
        row = super().run(report, folder).rows["kinetic_energy"][0]
        weight, h = ("none", 0.0) if self.scheme.held else (self.scheme.weight.__name__, self.scheme.h)
        same = {name: row[name] for name in ("seed", "ke", "ke_err", "nu", "nu_err", "rolls", "converged")}
        return Outcome({"convection": [{
            "maker": self.scheme.make.__name__, "weight": weight, "h": h, "points": self.kind, "rows": row["resolution"], **same,
            "exchanges": row.get("exchanges", np.nan)}]})


def convection(kind: str, scheme: Scheme, rows: int, seed: int = 1) -> Convection:
    """The case of so many rows."""
    return Convection(scene=RayleighBenard(ra=RA, L=float(rows)), scheme=scheme, seed=seed, kind=kind)
