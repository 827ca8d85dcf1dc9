"""Long runs on fixed points [RR98 Eqs 34-38] and on moving points [Eqs 39-49]."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.closed_faces import EXCHANGED, Ingredients, Moving
from particles.integral.edges import NONE_BEYOND, Edges, between_plates
from particles.integral.layer import Layer
from particles.integral.nested import mixed
from particles.integral.points import Points, of_positions
from particles.integral.rr98_moving_plain import Motion
from particles.integrators import RK4
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.setting import DISORDERS, Disorder
from studies.conservation.motions import moving
from studies.conservation.sums import (
    EVERYTHING,
    WatchedRun,
    compiled,
    exact_sums,
    in_numpy,
    random_fields,
    sizes,
)
from studies.kit.case import Outcome, Report

SIDE = 8                # of the box, in spacings
H = 3.0                 # range of the weights, in spacings
FROM_PLATE = 0.25       # least distance of irregular points from a plate, in spacings
FEW, NARROW = 6, 2.7    # side of the box and range of the weights for RR98's moving points


class Mode(NamedTuple):
    """Transport of a run: eta = kappa, share of it along edges; mended : as in `dih.Pairwise`.

    size : rms of the random fields at the start. Without friction short waves grow at rates of about this
    size, and have to stay small for 10 000 steps.
    """
    name: str
    eta: float = 0.1
    share: float = 1.0
    mended: bool = True
    size: float = 0.1


PAIRWISE = Mode("pairwise")
MODES = (PAIRWISE, Mode("unmended", mended=False), Mode("nested", share=0.0), Mode("mixed", share=0.1),
         Mode("ideal", eta=0.0, size=1e-4))


class Wall(NamedTuple):
    """Sides above and below: periodic, or plates at T = 1; gravity g."""
    name: str
    plates: bool = False
    g: float = 0.0


OPEN = Wall("periodic")
PLATES = Wall("plates", plates=True)
UNDER_GRAVITY = Wall("plates, gravity", plates=True, g=0.01)


def around(disorder: Disorder, seed: int, plates: bool) -> Points:
    """SIDE^2 points in the box, FROM_PLATE or more away from plates."""
    points = disorder.make((SIDE, SIDE), disorder.size, seed)
    if not plates:
        return points
    x, y = points.x.T
    edge = SIDE/2 - FROM_PLATE
    inside = np.clip(y, -edge, edge)
    return of_positions(np.stack([x, inside], axis=1), points.box)


@dataclass(frozen=True, kw_only=True)
class LayerDrift(WatchedRun):
    """Long run on fixed points of unit spacing in a periodic box or between mirror plates.

    make : edge maker of `edge_makers.MAKERS`, maker : its name there. weight : class.
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

    def run(self, report: Report, folder: Path) -> Outcome:
        wall, between, g = self.wall
        points = around(self.disorder, self.seed, between)
        try:
            method = self.method(points)
        except ArithmeticError:         # no such edges exist on these points
            return Outcome({})
        state = method.state(*random_fields(points, self.mode.size, self.seed, between))

        def totals(now: np.ndarray) -> np.ndarray:
            """Mass, momentum (between plates only along them), energy with m g y."""
            rho, px, py, energy = now
            whole = np.stack([rho, px, py*(not between), energy + g*method.x[:, 1]*rho])
            return exact_sums(method.edges.V, whole)
        # plates with friction exchange momentum and heat; gravity does not work on the discrete mass flux
        taken = g or (between and self.mode.eta)
        return self.watched(
            compiled(method, state), state, totals, sizes(method.eos, method.fields(state)), report,
            mode=self.mode.name, maker=self.maker, weight=self.weight.__name__, h=H, n=points.n,
            points=self.disorder.name, wall=wall, claimed="mass" if taken else EVERYTHING)

    def method(self, points: Points) -> Layer:
        """The compiled scheme on these points. Raises ArithmeticError: no such edges exist on them."""
        weight, eta = self.weight.of(h=H), self.mode.eta
        if self.wall.plates:
            edges, beyond = between_plates(self.make, points.x, SIDE, SIDE, weight)
        else:
            edges, beyond = self.make(points, weight), NONE_BEYOND
        return Layer(x=points.x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(eta, eta),
                     T_plates=(1.0, 1.0), g=self.wall.g, transport=mixed(self.mode.share, self.mode.mended))


@dataclass(frozen=True, kw_only=True)
class MovingDrift(WatchedRun):
    """Long run on SIDE^2 moving points with closed faces. name : what `ingredients` leave out, if any."""
    name: str = "pairwise"
    ingredients: Ingredients = Ingredients()  # noqa: RUF009 (immutable)
    weight: Any = WendlandC2
    disorder: Disorder = DISORDERS["jittered-0.3"]
    wall: Wall = OPEN
    scheme = "moving"

    @property
    def cost(self) -> float:
        return 4e-4*self.steps

    def run(self, report: Report, folder: Path) -> Outcome:
        between, eta = self.wall.plates, PAIRWISE.eta
        points = around(self.disorder, self.seed, between)
        inside = plates(SIDE, 1.0, 1.0) if between else periodic(SIDE, 1)
        method = Moving(weight=self.weight.of(h=H), eos=IdealGas(), law=ConstEta(eta, eta), box=(SIDE, SIDE),
                        walls=(*inside, *periodic(SIDE)), ingredients=self.ingredients)
        state = method.state(points.x, *random_fields(points, PAIRWISE.size, self.seed, between))

        def totals(now: np.ndarray) -> np.ndarray:
            """Mass, momentum (between plates only along them), energy, volume."""
            px, py, m, V, E = exact_sums(np.ones(1), now[EXCHANGED])
            return np.array([m, px, py*(not between), E, V])
        return self.watched(
            compiled(method, state), state, totals,
            np.append(sizes(method.eos, method.fields(state)), SIDE**2), report,
            mode=self.name, maker="faces", weight=self.weight.__name__, h=H, n=points.n,
            points=self.disorder.name, wall=self.wall.name,
            claimed="mass volume" if between else f"{EVERYTHING} volume")


# --- points that move as RR98 prints it -------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class MotionDrift(WatchedRun):
    """Long run of RR98's moving points: vortices and sound on a stream of viscous gas, recorded every step.

    kind : class of `rr98_moving_plain.MOTIONS`, motion : its name there. integrator, weight : classes.
    """
    motion: str
    kind: type[Motion]
    integrator: Any = RK4
    weight: Any = Lucy
    disorder: Disorder = DISORDERS["jittered-0.1"]
    dt: float = 0.2
    claimed: str = EVERYTHING
    scheme = "motions"

    @property
    def cost(self) -> float:
        return 5e-4*self.steps*self.integrator.evaluations

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make((FEW, FEW), self.disorder.size, self.seed)
        method = moving(self.kind, points, self.weight.of(h=NARROW), ConstEta(0.2, 0.2))
        X, Y = (2*np.pi*points.x/points.box).T
        v = 0.1*np.stack([0.5 + np.sin(X)*np.cos(Y), 0.3 - np.cos(X)*np.sin(Y)], axis=1)
        state = method.state(points.x, 1 + 0.05*np.cos(X + Y), v, 1 + 0.05*np.sin(Y))
        mass, *_, total = method.conserved(state)
        fields = method.fields(state)
        momenta = fields.rho*fields.V@np.abs(fields.v)
        return self.watched(
            in_numpy(method, state, self.dt, self.integrator), state, method.conserved,
            np.array([mass, *momenta, total]), report, records=self.steps,
            mode=f"{self.motion}, {self.integrator.__name__}", maker="renormalised", h=NARROW, n=points.n,
            weight=self.weight.__name__, points=self.disorder.name, claimed=self.claimed)
