"""Moving points that exchange over closed faces: the scheme and what it is made of, in any scene."""
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from particles.fields import kinetic
from particles.integral.closed_faces import FaceSums, Ingredients, Moving
from particles.integral.exchange import PRINTED
from particles.weights import WendlandC2
from studies.build.setting import Ready, check_spacings, check_taken, no_still_layer, shaken, stepped, walls


class FacesMotion(NamedTuple):
    """The scheme with its ingredients."""
    name: str
    ingredients: Ingredients = Ingredients()
    weight: Any = WendlandC2
    h: float = 3.0
    of_limit: float = 1.0

    def refuses(self, scene: Any) -> str:
        """Which part of a scene this cannot take; empty for none."""
        return no_still_layer(scene)

    def ready(self, scene: Any, seed: int = 1, x: np.ndarray | None = None,
              fields: tuple | None = None) -> Ready:
        """The method in a scene; from places x (n, 2) and fields (rho, v, T) there, if given."""
        fluid = method(scene, self)
        x = shaken(scene, seed) if x is None else x
        return stepped(fluid, fluid.state(x, *(fields or scene.fields(x))), self.of_limit)

    @property
    def series(self) -> dict[str, Any]:
        """Quantities of a run: K, and heat through both plates."""
        return {"ke": kinetic, "lower": partial(heat_in, side=-1), "upper": partial(heat_in, side=1)}


MOTIONS = {m.name: m for m in (
    FacesMotion("moving"),
    FacesMotion("moving-open-faces", Ingredients(iterations=0)),
    FacesMotion("moving-closer-faces", Ingredients(iterations=12)),
    FacesMotion("moving-no-shift", Ingredients(shift=0.0)),
    FacesMotion("moving-no-follow", Ingredients(follow=0.0)),
    FacesMotion("moving-no-spread", Ingredients(spread=0.0)),
    FacesMotion("moving-plain-spread", Ingredients(smooth=0.0)),
    FacesMotion("moving-whole-pressure", Ingredients(static=0.0)),
    FacesMotion("moving-printed-heat", Ingredients(transport=PRINTED)),
    FacesMotion("moving-half-step", of_limit=0.5),
)}


def method(scene: Any, motion: FacesMotion) -> Moving:
    """The method of unit spacing: a scene of L = rows spacings."""
    check_taken(motion, scene)
    check_spacings(scene)
    return Moving(weight=motion.weight.of(h=motion.h), eos=scene.eos, law=scene.law,
                  box=(scene.width, scene.L), g=scene.g, walls=walls(scene), ingredients=motion.ingredients)


def heat_in(sums: FaceSums, state: np.ndarray, side: int) -> float:
    """Heat per time that enters the fluid through a plate (-1: lower, 1: upper), over faces to images."""
    faces, half = sums.faces, sums.method.box[1]/2
    near = np.flatnonzero(side*state[1] > half - sums.method.weight.h)
    spans = zip(faces.first[near].astype(int), faces.taken[near], strict=True)
    entry = np.concatenate([np.arange(first, first + count) for first, count in spans])
    image = faces.near[entry]
    behind = (image >= sums.n) & (side*sums.around.y[image] > half)
    a = sums.points[np.repeat(near, faces.taken[near])[behind]]
    b, k = sums.points[image[behind]], faces.k[entry[behind]]
    return float(np.sum(k*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))
