"""The study `onset` as cases: the eigenvalue problem, growth rates of grids and particles, energies near onset."""
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from continuum import boussinesq
from continuum.gas import newton as compressible_newton
from continuum.gas.fields import NodeFields, initial
from continuum.linear import layer as linear
from continuum.linear.square import DEGREE, critical_ra_square
from continuum.scene import Periodic, RayleighBenard
from studies.build.names import EOS_NAMES, TRANSPORT_NAMES
from studies.build.spam import PRINTED, Variant, step
from studies.kit.case import Case, Outcome, Report
from studies.onset.rates import RUNS, SOLVERS, spam_run

BOX_NAMES = {"periodic": "ra_c periodic aspect 2", "walls": "ra_c square conducting"}

#: straight lines of K: the largest share 1 - sqrt(Ra_c/Ra) -> shares of the points; 0.5 is KHP95's four times Ra_c
LINES = {0.5: (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5), 0.1: (0.02, 0.04, 0.06, 0.08, 0.1),
         0.02: (0.005, 0.01, 0.015, 0.02)}


def onset_of(scene: RayleighBenard) -> float:
    """Where Boussinesq fluid in the box begins to move."""
    return linear.critical_ra(np.pi) if isinstance(scene.sides, Periodic) else critical_ra_square()


def point(method: str, scene: RayleighBenard, resolution: float, variant: str = "") -> dict:
    """Columns that all rows share; a Boussinesq fluid has no equation of state."""
    gas = not method.endswith(("boussinesq", "linear"))
    return {"method": method, "variant": variant, "eos": EOS_NAMES[type(scene.eos).__name__] if gas else "",
            "transport": TRANSPORT_NAMES[scene.transport.__name__] if gas else "",
            "dT": scene.dT/scene.T_mean if gas else 0.0, "sides": type(scene.sides).__name__.lower(), "pr": float(scene.pr),
            "resolution": float(resolution)}


def words(method: str, scene: RayleighBenard) -> str:
    """A few words for labels."""
    at = point(method, scene, 0)
    return " ".join(filter(None, (method, at["eos"], at["transport"], f"dT {at['dT']:g}"*bool(at["dT"]), at["sides"])))


@dataclass(frozen=True, kw_only=True)
class LinearTheory(Case):
    """Critical Rayleigh numbers of the eigenvalue problem, each with what fewer trial functions change; growth rates."""
    ras: tuple[float, ...]
    prs: tuple[float, ...]

    @property
    def label(self) -> str:
        return "linear theory"

    def run(self, report: Report, folder: Path) -> Outcome:
        rigid, free = linear.critical(linear.PlateKind.RIGID), linear.critical(linear.PlateKind.FREE)
        found = [("ra_c infinite layer rigid", self._layer(rigid.k, linear.PlateKind.RIGID), "infinite"),
                 ("ra_c infinite layer free", self._layer(free.k, linear.PlateKind.FREE), "infinite"),
                 ("ra_c periodic aspect 2", self._layer(np.pi, linear.PlateKind.RIGID), "periodic"),
                 ("ra_c periodic aspect 2, two pairs", self._layer(2*np.pi, linear.PlateKind.RIGID), "periodic"),
                 ("ra_c square conducting", self._square(0), "walls"),
                 ("ra_c square conducting, two rolls", self._square(1), "walls")]
        return Outcome({"growth_rates": [self._growth(ra, pr) for pr in self.prs for ra in self.ras], "critical_ra": [
            {"method": "linear", "quantity": name, "value": value, "err": err, "variant": "", "eos": "", "transport": "",
             "dT": 0.0, "sides": sides, "pr": 1.0, "resolution": np.inf, "way": "eigenvalue", "reach": 0.0, "ke_start": 0.0}
            for name, (value, err), sides in found]})

    @staticmethod
    def _growth(ra: float, pr: float) -> dict:
        return {**point("linear", RayleighBenard(ra=ra, pr=pr), np.inf), "way": "eigenvalue", "ke_start": 0.0, "seed": 0,
                "ra": ra, "sigma": linear.growth_rate(ra=ra, pr=pr, k=np.pi), "err": 0.0, "ke_end": np.nan}

    @staticmethod
    def _layer(k: float, plates: linear.PlateKind) -> tuple[float, float]:
        value, other = (linear.critical_ra(k, plates, degree) for degree in (linear.DEGREE, linear.DEGREE - 4))
        return value, abs(value - other)

    @staticmethod
    def _square(number: int) -> tuple[float, float]:
        value, other = (critical_ra_square(number, degree) for degree in (DEGREE, DEGREE - 2))
        return value, abs(value - other)


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """Growth rates of a grid's own linearised rates at some Ra on some grids."""
    method: str
    scene: RayleighBenard
    sizes: tuple[int, ...]
    ras: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.ras)*sum(1e-5*rows**2.5 for rows in self.sizes) + 1

    @property
    def label(self) -> str:
        return f"growth rates of {words(self.method, self.scene)}, rows {self.sizes}"

    def run(self, report: Report, folder: Path) -> Outcome:
        rows = []
        for number, ra in enumerate(self.ras):
            for size in self.sizes:
                scene = replace(self.scene, ra=ra)
                sigma, err = SOLVERS[self.method](scene, size)
                rows.append({**point(self.method, scene, size), "way": "operator", "ke_start": 0.0, "seed": 0, "ra": ra,
                             "sigma": sigma, "err": err, "ke_end": np.nan})
            report((number + 1)/len(self.ras))
        return Outcome({"growth_rates": rows})


@dataclass(frozen=True, kw_only=True)
class GrowthRun(Case):
    """Growth rate of rolls in one run of a grid in time, from kinetic energy `ke`, after `after` free-fall times."""
    method: str
    scene: RayleighBenard
    rows: int
    ke: float = 1e-10
    after: float = 40.0
    until: float = 80.0

    @property
    def cost(self) -> float:
        return 1.5e-6*self.rows**3*self.until + 10*self.method.startswith("pypde")

    @property
    def label(self) -> str:
        return f"run of {words(self.method, self.scene)} Ra {self.scene.ra:g}, rows {self.rows}, K {self.ke:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        history = RUNS[self.method](self.scene, self.rows, self.ke, self.until, report)
        return Outcome({"growth_rates": [growth_row(point(self.method, self.scene, self.rows), self, history)]})


@dataclass(frozen=True, kw_only=True)
class SpamGrowth(Case):
    """Growth rate of rolls of kinetic energy `ke` among particles; the scene has L = rows of particles."""
    scene: RayleighBenard
    variant: Variant = PRINTED
    seed: int = 1
    ke: float = 1e-4
    after: float = 2.0
    until: float = 30.0

    @property
    def particles(self) -> int:
        return round(self.scene.width)*round(self.scene.L)

    @property
    def dt(self) -> float:
        """Step of the study rb."""
        return step(self.scene, self.variant)

    @property
    def cost(self) -> float:
        return self.until*self.scene.L/self.scene.free_fall/self.dt*4*self.particles*230e-9*(self.variant.h/3)**2 + 2

    @property
    def label(self) -> str:
        return (f"growth of rolls, spam {self.variant.name} Ra {self.scene.ra:g}, {self.particles} particles, "
                f"K {self.ke:g}, seed {self.seed}")

    def run(self, report: Report, folder: Path) -> Outcome:
        history = spam_run(self.scene, self.variant, self.seed, self.ke, self.until, self.dt, report, folder)
        at = point("spam", self.scene, round(self.scene.L), self.variant.name)
        return Outcome({"growth_rates": [growth_row(at, self, history)]})


def growth_row(at: dict, case: GrowthRun | SpamGrowth, history) -> dict:
    """Row of `growth_rates` of a run."""
    sigma, err = history.growth(case.after)
    return {**at, "way": "run", "ke_start": case.ke, "seed": getattr(case, "seed", 0), "ra": float(case.scene.ra),
            "sigma": sigma, "err": err, "ke_end": float(history.amplitude[-1]**2/4)}


@dataclass(frozen=True, kw_only=True)
class Energies(Case):
    """Steady K on one grid where 1 - sqrt(Ra_c/Ra) has the values `shares`, Ra_c being the grid's own."""
    method: str
    scene: RayleighBenard
    rows: int
    shares: tuple[float, ...]

    @property
    def cost(self) -> float:
        return len(self.shares)*2e-5*self.rows**3 + 2

    @property
    def label(self) -> str:
        return f"K near onset of {words(self.method, self.scene)}, rows {self.rows}"

    def run(self, report: Report, folder: Path) -> Outcome:
        own, state, rows = self.own_onset(), None, []
        for number, share in enumerate(sorted(self.shares, reverse=True)):
            ra = own/(1 - share)**2
            state, ke, rolls = STEADY[self.method](replace(self.scene, ra=ra), self.rows, state)
            rows.append({**point(self.method, self.scene, self.rows), "share": share, "ra": ra, "ke": ke, "rolls": rolls})
            report((number + 1)/len(self.shares))
        return Outcome({"energies": rows})

    def own_onset(self) -> float:
        """The grid's Ra_c; a tenth on either side of Boussinesq fluid's is enough for all scenes."""
        near = onset_of(self.scene)
        return float(brentq(lambda ra: SOLVERS[self.method](replace(self.scene, ra=ra), self.rows)[0], 0.9*near, 1.1*near,
                            xtol=1e-6*near))


def gas_state(scene: RayleighBenard, rows: int, before: NodeFields | None) -> tuple[NodeFields, float, int]:
    """Steady rolls of the compressible grid, from those at a higher Ra: weaker rolls have weaker velocity and heat."""
    found = compressible_newton.steady(scene, rows, before and faded(scene, rows, before))
    return found.fields, found.ke, found.rolls


def faded(scene: RayleighBenard, rows: int, fields: NodeFields) -> NodeFields:
    """Deviations from rest in the ratio of 1 - sqrt(Ra_c/Ra), which K is nearly proportional to."""
    near, old = onset_of(scene)/scene.ra, onset_of(scene)/fields.scene.ra
    factor = np.sqrt(max(1 - near**0.5, 0.005)/max(1 - old**0.5, 0.005))
    rest = initial(scene, rows, 0.0)
    at = fields.at._replace(**{name: getattr(rest.at, name) + factor*(getattr(fields.at, name) - getattr(rest.at, name))
                               for name in fields.at._fields})
    return replace(fields, at=at, cells=1 + factor*(fields.cells - 1))


def boussinesq_state(scene: RayleighBenard, rows: int, before: boussinesq.State | None) -> tuple[boussinesq.State, float, int]:
    """Steady rolls of the staggered grid; half of a pair is solved for."""
    half = isinstance(scene.sides, Periodic)
    box = boussinesq.HALF_LAYER if half else boussinesq.CONDUCTING_SQUARE
    state = boussinesq.steady(boussinesq.Case(ra=scene.ra, pr=scene.pr, box=box, rows=rows), before)
    return state, state.K, (1 + half)*state.rolls


STEADY: dict[str, Callable[..., tuple[Any, float, int]]] = {"compressible": gas_state, "boussinesq": boussinesq_state}
