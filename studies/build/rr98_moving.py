"""RR98's own moving points: motions by name, in any scene    [RR98 Eqs 39, 46-51]"""
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from particles.fields import kinetic
from particles.integral.drifts import DRIFTS, ConstantMassDrift, OverPairs
from particles.integral.exchange import PRINTED
from particles.integral.points import lattice
from particles.integral.rr98_moving import Drift, Drifts
from particles.integral.rr98_moving_plain import Powers, scale_of
from particles.integral.transposed_stress import MENDED
from particles.observe import pairs_behind
from particles.pairs import rate, sweep, zero
from particles.smooth.spam import LessStatic
from particles.weights import WendlandC2
from studies.build.setting import Ready, check_spacings, check_taken, no_still_layer, shaken, stepped, walls


class DriftMotion(NamedTuple):
    """A motion, as printed but for what is named; `less` : share of the static pressure left out."""
    name: str
    motion: Any
    mended: bool = True
    less: float = 0.0
    weight: Any = WendlandC2
    h: float = 3.0

    def refuses(self, scene: Any) -> str:
        """Which part of a scene this cannot take; empty for none."""
        return no_still_layer(scene)

    def ready(self, scene: Any, seed: int = 1, x: np.ndarray | None = None,
              fields: tuple | None = None) -> Ready:
        """The method in a scene; from places x (n, 2) and fields (rho, v, T) there, if given."""
        fluid = method(scene, self)
        x = shaken(scene, seed) if x is None else x
        return stepped(fluid, fluid.state(x, *(fields or scene.fields(x))), 1.0)

    @property
    def series(self) -> dict[str, Any]:
        """Quantities of a run: K, and heat through both plates."""
        return {"ke": kinetic, "lower": partial(heat_in, side=-1), "upper": partial(heat_in, side=1)}


DRIFT_MOTIONS = {m.name: m for m in (
    DriftMotion("moving-literal", DRIFTS["literal"]),
    DriftMotion("moving-literal-printed-heat", DRIFTS["literal"], mended=False),
    DriftMotion("moving-convective", DRIFTS["convective"]),
    DriftMotion("moving-carried", DRIFTS["carried"]),
    DriftMotion("moving-constant-mass", DRIFTS["constant-mass"]),
    DriftMotion("moving-constant-mass-printed-heat", DRIFTS["constant-mass"], mended=False),
    DriftMotion("moving-sph", ConstantMassDrift(Powers(1.0, -1.0))),
    DriftMotion("moving-less-static", DRIFTS["constant-mass"], less=1.0),
)}


def method(scene: Any, chosen: DriftMotion) -> Drift:
    """The method of unit spacing: a scene of L = rows spacings."""
    check_taken(chosen, scene)
    check_spacings(scene)
    weight = chosen.weight.of(h=chosen.h)
    return Drift(motion=chosen.motion, weight=weight, scale=scale(weight), eos=scene.eos, law=scene.law,
                 box=(scene.width, scene.L), g=scene.g, walls=walls(scene),
                 transport=MENDED if chosen.mended else PRINTED, static=LessStatic(chosen.less, scene.T_mean))


@cache
def scale(weight: Any) -> float:
    """Of plain quadrature, so that gradients are right on a lattice of the mean density."""
    return scale_of(lattice((12, 12)), weight)


class PairHeat(NamedTuple):
    """Heat that the first of two points gets from the other."""


zero.of(PairHeat)(lambda term: (0.0,))
rate.of(PairHeat)(lambda term, a, b, ab: (0.5*(a.k + b.k)*ab.k*(b.Td - a.Td),))


def heat_in(sums: Drifts, state: np.ndarray, side: int) -> float:
    """Heat per time that enters the fluid through a plate (-1: lower, 1: upper), from images behind it."""
    heat = np.zeros((sums.n, 1))
    sums.threads(sweep, sums.n, OverPairs(PairHeat()), sums.points, pairs_behind(sums, side), heat)
    return float(heat.sum())
