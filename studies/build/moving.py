"""Moving points that exchange over closed faces: the scheme and what it is made of, in any scene."""
from typing import Any, NamedTuple

import numpy as np

from particles.integral.closed_faces import EXCHANGED, FaceSums, Ingredients, Moving
from particles.integral.exchange import PRINTED
from particles.weights import WendlandC2
from studies.build.setting import Ready, check_open, check_spacings, check_still, shaken, stepped, walls


class Motion(NamedTuple):
    """The scheme with its ingredients."""
    name: str
    ingredients: Ingredients = Ingredients()
    weight: Any = WendlandC2
    h: float = 3.0
    of_limit: float = 1.0

    def ready(self, scene: Any, seed: int = 1, x: np.ndarray | None = None, fields: tuple | None = None) -> Ready:
        """The method in a scene; from places x (n, 2) and fields (rho, v, T) there, if given."""
        fluid, x = method(scene, self), shaken(scene, seed) if x is None else x
        rho, v, T = fields or scene.fields(x)
        return stepped(fluid, fluid.state(x, v, rho, T), self.of_limit)

    @property
    def series(self) -> dict[str, Any]:
        """Quantities of a run: K, and heat through both plates."""
        return {"ke": kinetic, "lower": PlateHeat(-1), "upper": PlateHeat(1)}


MOTIONS = {m.name: m for m in (
    Motion("moving"),
    Motion("moving-open-faces", Ingredients(iterations=0)),
    Motion("moving-closer-faces", Ingredients(iterations=12)),
    Motion("moving-no-shift", Ingredients(shift=0.0)),
    Motion("moving-no-follow", Ingredients(follow=0.0)),
    Motion("moving-no-spread", Ingredients(spread=0.0)),
    Motion("moving-plain-spread", Ingredients(smooth=False)),
    Motion("moving-whole-pressure", Ingredients(static=False)),
    Motion("moving-printed-heat", Ingredients(transport=PRINTED)),
    Motion("moving-half-step", of_limit=0.5),
)}


def method(scene: Any, motion: Motion) -> Moving:
    """The method of unit spacing: a scene of L = rows spacings."""
    check_open(scene, "moving")
    check_still(scene)
    check_spacings(scene)
    return Moving(weight=motion.weight.of(h=motion.h), eos=scene.eos, law=scene.law, box=(scene.width, scene.L), g=scene.g,
                  walls=walls(scene), ingredients=motion.ingredients)


def kinetic(sums: FaceSums, state: np.ndarray) -> float:
    """K per mass."""
    px, py, m, _, _ = state[EXCHANGED]
    return float(0.5*np.sum((px**2 + py**2)/m)/m.sum())


class PlateHeat(NamedTuple):
    """Heat that enters the fluid through a plate (-1: lower, 1: upper), per time."""
    side: int

    def __call__(self, sums: FaceSums, state: np.ndarray) -> float:
        """Over all faces to images behind the plate."""
        faces, points, n, half = sums.faces, sums.points, sums.n, sums.method.box[1]/2
        near = np.flatnonzero(self.side*state[1] > half - sums.method.weight.h)
        row = np.repeat(near, faces.taken[near])
        offset = np.arange(len(row)) - np.repeat(np.cumsum(faces.taken[near]) - faces.taken[near], faces.taken[near])
        entry = (np.repeat(faces.first[near].astype(np.int64), faces.taken[near]) + offset.astype(np.int64))
        image = faces.near[entry]
        behind = (image >= n) & (self.side*sums.around.y[image] > half)
        a, b, k = points[row[behind]], points[image[behind]], faces.k[entry[behind]]
        return float(np.sum(k*(a["k"] + b["k"])/2*(b["Td"] - a["Td"])))
