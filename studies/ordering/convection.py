"""Rayleigh-Benard on fixed points, a case of the error surface: K by range, disorder and rows    [RR98 Eqs 34-38]"""
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from continuum.scene import RayleighBenard
from particles.integral.edge_makers import MAKERS, exact
from particles.integrators import RK4
from particles.weights import Lucy, WendlandC2
from studies.build.fixed import SCHEMES, Scheme, hard_core, settled
from studies.build.measure import ended, followed, rolls
from studies.build.setting import positions
from studies.kit.case import Case, Outcome, Report

RA = 1e4
#: kinds of irregular points between rows of points on the plates, edges of a triangulation
PLATES = {"jittered-0.3": SCHEMES["fixed-jittered-plates"], "random": SCHEMES["fixed-random-plates"],
          "relaxed": SCHEMES["relaxed-plates"]}
#: makers of edges and ranges of the weight between mirror images; exact ones need the wider
MADE = (*product(("plain", "renormalised", "closed"), (2.0, 3.0)), ("exact", 3.0))
#: columns of a run without an end
NOTHING = {**dict.fromkeys(("ke", "ke_err", "nu", "nu_err", "exchanges"), np.nan), "rolls": 0,
           "converged": False}
RECORDS = 4         # a free-fall time


@cache
def moved_apart(width: float, height: float, size: float, seed: int) -> np.ndarray:
    """`settled`, once for all makers of edges."""
    return settled(width, height, size, seed)


#: the same kinds of points between mirror images: makers and size of their disorder, in spacings
POINTS: dict[str, tuple[Callable, float]] = {"jittered-0.3": (positions, 0.3), "random": (hard_core, 0.5),
                                             "relaxed": (moved_apart, 0.5)}


def on_lattice(h: float) -> Scheme:
    """Lucy's weight of another range."""
    return Scheme(f"fixed-lattice-h{h:g}", h=h)


def between_images(kind: str, maker: str, h: float, weight: Any = Lucy) -> Scheme:
    """Edges of a weight over irregular points and their mirror images."""
    points, size = POINTS[kind]
    return Scheme(f"images-{kind}-{maker}-{weight.__name__}-h{h:g}", MAKERS[maker], weight, h, size,
                  points=points)


@dataclass(frozen=True, kw_only=True)
class Convection(Case):
    """One run at Ra = 10 000 until nothing changes any more; `kind`: of its points."""
    scene: RayleighBenard
    scheme: Scheme
    seed: int = 1
    t_end: float = 150.0
    kind: str

    @property
    def cost(self) -> float:
        """Points that move apart take the longer the more there are."""
        L, h = self.scene.L, self.scheme.h
        steps = self.t_end*L/self.scene.free_fall/max(0.2, 1.1 - L/100)
        apart = 0.04*L**2 if self.kind == "relaxed" else 0.0
        return steps*4*self.scene.width*(L + self.scheme.held)*100e-9*(h/2)**2 + 5 + apart

    @property
    def label(self) -> str:
        points = round(self.scene.width)*(round(self.scene.L) + self.scheme.held)
        return f"dih {self.scheme.name} Ra {self.scene.ra:g}, {points} points, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        """A row of `convection`; without exchanges where the points have no such edges."""
        try:
            values = self.measured(report, folder)
        except ArithmeticError:
            if self.scheme.make is not exact:       # others exist on all points
                raise
            values = NOTHING | {"exchanges": 0.0}
        return Outcome({"convection": [self.row_key | values]})

    @property
    def row_key(self) -> dict[str, Any]:
        """The key of its row; triangles between points on the plates have no weight."""
        weight, h = ("none", 0.0) if self.scheme.held else (self.scheme.weight.__name__, self.scheme.h)
        return {"maker": self.scheme.make.__name__, "weight": weight, "h": h, "points": self.kind,
                "rows": round(self.scene.L), "seed": self.seed}

    def measured(self, report: Report, folder: Path) -> dict[str, Any]:
        """K, Nu, rolls at the end, and exchanges over edges, to images among them."""
        ready, _, done = followed(self.scene, self.scheme, self.seed, self.t_end, RECORDS, report,
                                  folder/"run.h5")
        if done is None:
            return NOTHING
        method, flow = ready.method, ready.method.fields(done.state)
        beyond = getattr(method, "beyond", None)
        number = len(method.edges.i) + (len(beyond.i) if beyond else 0)
        return {**ended(self.scene, done)._asdict(), "rolls": rolls(self.scene, flow.x, flow.v[:, 1]),
                "exchanges": RK4.evaluations*done.step*number}


def convection(kind: str, scheme: Scheme, rows: int, seed: int = 1) -> Convection:
    """The case of so many rows."""
    return Convection(scene=RayleighBenard(ra=RA, L=float(rows)), scheme=scheme, seed=seed, kind=kind)


def irregular_layers(rows: dict[str, tuple[int, ...]], seeds: tuple[int, ...]) -> Iterator[Convection]:
    """Triangulated irregular points between rows of points on the plates."""
    for kind, numbers in rows.items():
        yield from (convection(kind, PLATES[kind], number, seed) for number, seed in product(numbers, seeds))


def images(rows: tuple[int, ...], seeds: tuple[int, ...]) -> Iterator[Convection]:
    """Edges of a weight between mirror images; plain ones of the weight that the points moved apart with, too."""
    schemes = [(kind, between_images(kind, maker, h)) for kind, (maker, h) in product(POINTS, MADE)]
    schemes.append(("relaxed", between_images("relaxed", "plain", 3.0, WendlandC2)))
    for (kind, scheme), number, seed in product(schemes, rows, seeds):
        yield convection(kind, scheme, number, seed)
