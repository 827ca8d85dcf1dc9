"""Long runs whose sums are watched: the compiled scheme on fixed points, moving points with closed faces."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Ingredients, Moving
from particles.integral.edges import NONE_BEYOND, Edges, between_plates
from particles.integral.layer import Layer
from particles.integral.nested import mixed
from particles.integral.points import Points, of_positions
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.starts import Overlap
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.disorder import DISORDERS, Disorder
from studies.conservation.sums import ROUND_OFF, Watch, exact_sums, kinetic, parts, random_fields, sizes
from studies.kit.case import Case, Outcome, Report

OF_LIMIT = 0.5          # of the step to its limit
SIDE = 8                # of the box, in spacings
FROM_PLATE = 0.25       # of a spacing: irregular points come no nearer to a plate
EVERYTHING = "mass momentum energy"


class Mode(NamedTuple):
    """Transport of a run: eta = kappa, share along edges, whether its heating is mended, chi of the filter.

    size : rms of the random start. Without friction it feeds short waves at rates of the order of itself,
    which 10 000 steps are to leave small.
    """

    name: str
    eta: float = 0.1
    share: float = 1.0
    mended: bool = True
    size: float = 0.1
    chi: float = 0.0


MODES = {mode.name: mode for mode in (
    Mode("pairwise"),
    Mode("unmended", mended=False),
    Mode("nested", share=0.0),
    Mode("mixed", share=0.1),
    Mode("ideal", eta=0.0, size=1e-4))}
FILTERED = Mode("filtered", chi=0.1)


class Wall(NamedTuple):
    """What is above and below: the box again, or plates at T = 1 under gravity."""

    name: str
    plates: bool = False
    g: float = 0.0


WALLS = {wall.name: wall for wall in (
    Wall("periodic"),
    Wall("plates", plates=True),
    Wall("plates, gravity", plates=True, g=0.01))}


@dataclass(frozen=True, kw_only=True)
class Drift(Case):
    """A run of one scheme on fixed points of unit spacing.

    make : of `edge_makers.MAKERS`. weight : class, its range h in spacings.
    """

    mode: Mode
    maker: str
    make: Callable[[Points, Any], Edges]
    weight: Any
    h: float
    disorder: Disorder
    wall: Any = WALLS["periodic"]
    steps: int = 10_000
    seed: int = 1
    scheme: ClassVar[str]

    @property
    def label(self) -> str:
        edges = f"{self.maker} {self.weight.__name__} h {self.h:g}"
        where = f"{self.disorder.name}, {self.wall.name}"
        return f"{self.scheme} {self.mode.name} {edges}, {where}, seed {self.seed}"

    @property
    def claimed(self) -> str:
        """Sums that should stay."""
        return EVERYTHING

    def points(self) -> Points:
        """Where the points are."""
        raise NotImplementedError

    def method(self, points: Points) -> Any:
        """The scheme on them; ArithmeticError where no such edges exist."""
        raise NotImplementedError

    def start(self, method: Any, points: Points) -> np.ndarray:
        """A random state."""
        return method.state(*random_fields(points, self.mode.size, self.seed))

    def totals(self, method: Any, state: np.ndarray) -> np.ndarray:
        """Mass, momentum along both axes, energy."""
        return exact_sums(method.edges.V, state[:4])

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.points()
        try:
            method = self.method(points)
        except ArithmeticError:
            return Outcome({})
        state = self.start(method, points)
        first = method.fields(state)
        watch, begin = Watch(lambda now: self.totals(method, now), sizes(method.eos, first)), kinetic(first)
        state, reached = in_parts(method, state, self.steps, watch, report)
        return drift_row(
            watch, scheme=self.scheme, mode=self.mode.name, maker=self.maker, weight=self.weight.__name__,
            h=self.h, points=self.disorder.name, wall=self.wall.name, seed=self.seed, n=len(first.rho),
            steps=self.steps, reached=reached, claimed=self.claimed,
            motion=kinetic(method.fields(state))/begin)


def drift_row(watch: Watch, **columns: Any) -> Outcome:
    """A row of the table `drift`: the largest changes of mass, of momentum in any direction, of energy."""
    mass, *momentum, energy = watch.worst
    usual = {"d": 2, "zeta": 0.0, "volume": np.nan, "err": ROUND_OFF}
    changes = {"mass": mass, "momentum": max(momentum), "energy": energy}
    return Outcome({"drift": [{**usual, **changes, **columns}]})


def in_parts(method: Any, state: np.ndarray, steps: int, watch: Watch,
             report: Report) -> tuple[np.ndarray, int]:
    """(state, steps done) of a run that is watched; it ends early if it diverges, heats too far or pairs."""
    dt = OF_LIMIT*limit_of(method, state)
    watch(state)
    for before, number in parts(steps):
        if dt > limit_of(method, state):        # it has heated: sound outruns the step
            return state, before
        try:
            state = run(method, state, Plan(dt=dt, steps=number)).state
        except Divergence as end:
            return state, before + end.step
        except Overlap:     # points have paired until they lie in one place
            if not before:
                raise
            return state, before
        watch(state)
        report((before + number)/steps)
    return state, steps


def around(disorder: Disorder, seed: int, plates: bool) -> Points:
    """SIDE^2 points in the box, away from plates."""
    points = disorder.make((SIDE, SIDE), disorder.size, seed)
    if not plates:
        return points
    x, y = points.x.T
    edge = SIDE/2 - FROM_PLATE
    return of_positions(np.stack([x, np.clip(y, -edge, edge)], axis=1), points.box)


@dataclass(frozen=True, kw_only=True)
class LayerDrift(Drift):
    """The compiled scheme on SIDE^2 points, in a periodic box or between mirror plates    [RR98 Eqs 34-38]"""

    scheme = "layer"

    @property
    def cost(self) -> float:
        return self.steps*(1.9e-4 if self.mode.share < 1 else 0.7e-4)

    @property
    def claimed(self) -> str:
        """Plates with friction take momentum and heat. Gravity works on no discrete mass flux."""
        taken = self.wall.g or (self.wall.plates and self.mode.eta)
        return "mass" if taken else EVERYTHING

    def points(self) -> Points:
        return around(self.disorder, self.seed, self.wall.plates)

    def method(self, points: Points) -> Layer:
        """The scheme; without plates there are no images."""
        weight, eta = self.weight.of(h=self.h), self.mode.eta
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
class MovingDrift(Case):
    """SIDE^2 points that move and exchange over closed faces; `name`: what is left out of the scheme."""

    name: str = "pairwise"
    ingredients: Ingredients = Ingredients()  # noqa: RUF009 (immutable)
    weight: Any = WendlandC2
    disorder: Disorder = DISORDERS["jittered-0.3"]
    wall: Wall = WALLS["periodic"]
    steps: int = 10_000
    seed: int = 1

    @property
    def cost(self) -> float:
        return 4e-4*self.steps

    @property
    def label(self) -> str:
        where = f"{self.disorder.name}, {self.wall.name}"
        return f"moving {self.name} {self.weight.__name__}, {where}, seed {self.seed}"

    def run(self, report: Report, folder: Path) -> Outcome:
        mode = MODES["pairwise"]
        points = around(self.disorder, self.seed, self.wall.plates)
        inside = plates(SIDE, 1.0, 1.0) if self.wall.plates else periodic(SIDE, 1)
        method = Moving(weight=self.weight.of(h=3.0), eos=IdealGas(), law=ConstEta(mode.eta, mode.eta),
                        box=(SIDE, SIDE), walls=(*inside, *periodic(SIDE)), ingredients=self.ingredients)
        rho, v, T = random_fields(points, mode.size, self.seed, self.wall.plates)
        state = method.state(points.x, v, rho, T)
        watch, begin = self.watch(method, state), kinetic(method.fields(state))
        state, reached = in_parts(method, state, self.steps, watch, report)
        watch.worst, volume = watch.worst[:-1], watch.worst[-1]
        return drift_row(
            watch, scheme="moving", mode=self.name, maker="faces", weight=self.weight.__name__, h=3.0,
            points=self.disorder.name, wall=self.wall.name, seed=self.seed, n=SIDE**2, steps=self.steps,
            reached=reached, claimed="mass volume" if self.wall.plates else f"{EVERYTHING} volume",
            volume=volume, motion=kinetic(method.fields(state))/begin)

    def watch(self, method: Moving, state: np.ndarray) -> Watch:
        """Mass, momentum along both axes (between plates along them only), energy, volume."""
        rows = [2, 0, 4, 3] if self.wall.plates else [2, 0, 1, 4, 3]
        mass, momentum, _, total = sizes(method.eos, method.fields(state))
        size = np.array([momentum, momentum, mass, SIDE**2, total])
        return Watch(lambda now: exact_sums(np.ones(1), now[EXCHANGED][rows]), size[rows])
