"""Long runs of the compiled schemes: on fixed points [RR98 Eqs 34-38], on moving points with closed faces."""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Ingredients, Moving
from particles.integral.edges import NONE_BEYOND, Edges, between_plates
from particles.integral.layer import Layer
from particles.integral.nested import mixed
from particles.integral.points import Points, of_positions
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.setting import DISORDERS, Disorder
from studies.conservation.sums import EVERYTHING, WatchedRun, exact_sums, random_fields, sizes

SIDE = 8                # of the box, in spacings
H = 3.0                 # range of the weights
FROM_PLATE = 0.25       # of a spacing: irregular points come no nearer to a plate


class Mode(NamedTuple):
    """Transport of a run: eta = kappa, share along edges, whether its heating is mended.

    size : rms of the random start. Without friction it feeds short waves at rates of the order of itself,
    which 10 000 steps are to leave small.
    """

    name: str
    eta: float = 0.1
    share: float = 1.0
    mended: bool = True
    size: float = 0.1


PAIRWISE = Mode("pairwise")
MODES = (
    PAIRWISE,
    Mode("unmended", mended=False),
    Mode("nested", share=0.0),
    Mode("mixed", share=0.1),
    Mode("ideal", eta=0.0, size=1e-4))


class Wall(NamedTuple):
    """What is above and below: the box again, or plates at T = 1 under gravity."""

    name: str
    plates: bool = False
    g: float = 0.0


OPEN = Wall("periodic")
PLATES = Wall("plates", plates=True)
UNDER_GRAVITY = Wall("plates, gravity", plates=True, g=0.01)


def around(disorder: Disorder, seed: int, plates: bool) -> Points:
    """SIDE^2 points in the box, away from plates."""
    points = disorder.make((SIDE, SIDE), disorder.size, seed)
    if not plates:
        return points
    x, y = points.x.T
    edge = SIDE/2 - FROM_PLATE
    inside = np.clip(y, -edge, edge)
    return of_positions(np.stack([x, inside], axis=1), points.box)


@dataclass(frozen=True, kw_only=True)
class LayerDrift(WatchedRun):
    """Fixed points of unit spacing in a periodic box or between mirror plates.

    make : of `edge_makers.MAKERS`, `maker` its name there. weight : class.
    """

    mode: Mode
    maker: str
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    weight: Any = Lucy
    wall: Wall = OPEN
    scheme = "layer"

    @property
    def cost(self) -> float:
        return self.steps*(1.9e-4 if self.mode.share < 1 else 0.7e-4)

    def columns(self) -> dict[str, Any]:
        """Plates with friction take momentum and heat. Gravity works on no discrete mass flux."""
        taken = self.wall.g or (self.wall.plates and self.mode.eta)
        return {"mode": self.mode.name, "maker": self.maker, "weight": self.weight.__name__, "h": H,
                "points": self.disorder.name, "wall": self.wall.name,
                "claimed": "mass" if taken else EVERYTHING}

    def points(self) -> Points:
        return around(self.disorder, self.seed, self.wall.plates)

    def method(self, points: Points) -> Layer:
        """The scheme; without plates there are no images."""
        weight, eta = self.weight.of(h=H), self.mode.eta
        if self.wall.plates:
            edges, beyond = between_plates(self.make, points.x, SIDE, SIDE, weight)
        else:
            edges, beyond = self.make(points, weight), NONE_BEYOND
        return Layer(x=points.x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(eta, eta),
                     T_plates=(1.0, 1.0), g=self.wall.g, transport=mixed(self.mode.share, self.mode.mended))

    def start(self, method: Layer, points: Points) -> np.ndarray:
        return method.state(*random_fields(points, self.mode.size, self.seed, self.wall.plates))

    def totals(self, method: Layer, state: np.ndarray) -> np.ndarray:
        """With the energy of height; between plates momentum along them only."""
        whole = state.copy()
        whole[3] += self.wall.g*method.x[:, 1]*state[0]
        sums = super().totals(method, whole)
        sums[2] *= not self.wall.plates
        return sums


@dataclass(frozen=True, kw_only=True)
class MovingDrift(WatchedRun):
    """SIDE^2 points that move and exchange over closed faces; `name`: what is left out of the scheme."""

    name: str = "pairwise"
    ingredients: Ingredients = Ingredients()  # noqa: RUF009 (immutable)
    weight: Any = WendlandC2
    disorder: Disorder = DISORDERS["jittered-0.3"]
    wall: Wall = OPEN
    scheme = "moving"

    @property
    def cost(self) -> float:
        return 4e-4*self.steps

    def columns(self) -> dict[str, Any]:
        return {"mode": self.name, "maker": "faces", "weight": self.weight.__name__, "h": H,
                "points": self.disorder.name, "wall": self.wall.name,
                "claimed": "mass volume" if self.wall.plates else f"{EVERYTHING} volume"}

    def points(self) -> Points:
        return around(self.disorder, self.seed, self.wall.plates)

    def method(self, points: Points) -> Moving:
        inside = plates(SIDE, 1.0, 1.0) if self.wall.plates else periodic(SIDE, 1)
        law = ConstEta(PAIRWISE.eta, PAIRWISE.eta)
        return Moving(weight=self.weight.of(h=H), eos=IdealGas(), law=law, box=(SIDE, SIDE),
                      walls=(*inside, *periodic(SIDE)), ingredients=self.ingredients)

    def start(self, method: Moving, points: Points) -> np.ndarray:
        return method.state(points.x, *random_fields(points, PAIRWISE.size, self.seed, self.wall.plates))

    def totals(self, method: Moving, state: np.ndarray) -> np.ndarray:
        """Mass, momentum (between plates along them only), energy, volume."""
        px, py, m, V, E = exact_sums(np.ones(1), state[EXCHANGED])
        return np.array([m, px, 0.0 if self.wall.plates else py, E, V])

    def sizes(self, method: Moving, state: np.ndarray) -> np.ndarray:
        return np.append(sizes(method.eos, method.fields(state)), SIDE**2)

    def changes(self, worst: np.ndarray) -> dict[str, float]:
        return {**super().changes(worst[:-1]), "volume": worst[-1]}
