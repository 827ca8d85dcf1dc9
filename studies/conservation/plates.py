"""Sums of the scheme in one and three dimensions between plates over long runs, as cases    [RR98 Eqs 34-38]

Plates are across the last axis, at T = 1, with the images of `particles.integral.dih_plates`. Without friction they keep energy
and momentum along themselves, of which there is none on a line; with friction they take both, and mass stays.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from particles.integral.dih import Dih
from particles.integral.dih_plates import DihPlates
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import between_plates
from particles.integral.points import Points, of_positions
from particles.weights import Lucy
from studies.build.disorder import DISORDERS
from studies.conservation.dih import COUNTS, FORMS, DihDrift, limit_by
from studies.conservation.layers import FROM_PLATE
from studies.conservation.sums import exact_sums, random_fields

RANGE = {1: 3.0, 3: 1.9}
SETS = (("renormalised", "lattice"), ("closed", "jittered-0.1"), ("exact", "jittered-0.1"))


@dataclass(frozen=True, kw_only=True)
class PlatesDrift(DihDrift):
    """A long run from a random start between plates in d dimensions."""
    wall = "plates"

    @property
    def cost(self) -> float:
        return self.steps*{1: 2e-3, 3: 4e-3}[self.d]

    @property
    def label(self) -> str:
        return super().label.replace("dih", "dih plates", 1)

    @property
    def claimed(self) -> str:
        if self.form.eta:
            return "mass"
        return "mass energy" if self.d == 1 else self.form.claimed

    def points(self) -> Points:
        at = super().points()
        edge = COUNTS[self.d][-1]/2 - FROM_PLATE
        return of_positions(np.column_stack([at.x[:, :-1], np.clip(at.x[:, -1], -edge, edge)]), at.box)

    def method(self, points: Points) -> DihPlates:
        *along, height = points.box
        edges, beyond = between_plates(self.make, points.x, tuple(along), height, self.weight.of(h=self.h, d=self.d))
        return DihPlates(x=points.x, edges=edges, beyond=beyond, T_plates=(1.0, 1.0), **self.fluid)

    def start(self, points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """With no wind across the plates."""
        rho, v, T = random_fields(points, self.form.size, self.seed, plates=True)
        v[:, -1] -= v[:, -1].mean()
        return rho, v, T

    def totals(self, V: np.ndarray, state: np.ndarray) -> np.ndarray:
        """With momentum along the plates only, which is no number on a line."""
        found = exact_sums(V, state)
        found[-2] = np.nan if self.d == 1 else 0.0
        return found

    def limit(self, fluid: Dih, state: np.ndarray) -> float:
        assert isinstance(fluid, DihPlates)
        return limit_by(fluid, state, fluid.fastest, 2*self.form.eta + self.zeta)


def cases(**more: int) -> Iterator[PlatesDrift]:
    """Without friction on three sets of points; with friction along edges on two of them, nested on one."""
    for d, (number, (maker, points)) in product(RANGE, enumerate(SETS)):
        for form in ("ideal", "pairwise", "nested")[:1 + number]:
            yield PlatesDrift(form=FORMS[form], d=d, maker=maker, make=MAKERS[maker], weight=Lucy, h=RANGE[d],
                              disorder=DISORDERS[points], zeta=0.05*(form != "ideal"), **more)
