"""Long runs on fixed points [RR98 Eqs 34-38] and on moving points [Eqs 39-49]."""
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.edges import NONE_BEYOND, Edges, between_plates
from particles.integral.layer import Layer
from particles.integral.nested import mixed
from particles.integral.points import Points, of_positions
from particles.integral.rr98_moving_plain import MOTIONS
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.weights import Lucy
from studies.build.setting import DISORDERS, Disorder, inside
from studies.conservation.motions import moving
from studies.conservation.sums import (
    EVERYTHING,
    OF_LIMIT,
    Advance,
    WatchedRun,
    exact_sums,
    in_numpy,
    random_fields,
    sizes,
)
from studies.kit.case import Report
from studies.kit.table import Row

SIDE = 8                # of the box, in spacings
H = 3.0                 # range of the weights, in spacings
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
    """SIDE^2 points in the box, none too near to a plate."""
    points = disorder.make((SIDE, SIDE), disorder.size, seed)
    return of_positions(inside(SIDE, points.x), points.box) if plates else points


class LayerDrift(WatchedRun, table="drift"):
    """Long run of the compiled scheme on fixed points of unit spacing, periodic or between mirror plates.

    maker : of `edge_makers.MAKERS`. weight : class.
    """
    mode: Mode = PAIRWISE
    maker: Callable[[Points, Any], Edges]
    points: Disorder
    weight: Any = Lucy
    wall: Wall = OPEN
    scheme, h = "layer", H

    @property
    def cost(self) -> float:
        return self.steps*(1.9e-4 if self.mode.share < 1 else 0.7e-4)

    @property
    def claimed(self) -> str:
        """Plates with friction take momentum and heat; gravity does not work on the discrete mass flux."""
        return "mass" if self.wall.g or (self.wall.plates and self.mode.eta) else EVERYTHING

    def measure(self, report: Report) -> Iterator[Row]:
        between, points = self.wall.plates, around(self.points, self.seed, self.wall.plates)
        try:
            method = self.method(points)
        except ArithmeticError:         # no such edges exist on these points
            return
        state = method.state(*random_fields(points, self.mode.size, self.seed, between))

        def totals(now: np.ndarray) -> np.ndarray:
            """Mass, momentum (between plates only along them), energy with m g y."""
            rho, px, py, energy = now
            whole = np.stack([rho, px, py*(not between), energy + self.wall.g*method.x[:, 1]*rho])
            return exact_sums(method.edges.V, whole)
        yield from self.watched(compiled(method, state), state, totals,
                                sizes(method.eos, method.fields(state)), report)

    def method(self, points: Points) -> Layer:
        """The compiled scheme on these points. Raises ArithmeticError: no such edges exist on them."""
        weight, eta = self.weight.of(h=H), self.mode.eta
        if self.wall.plates:
            edges, beyond = between_plates(self.maker, points.x, SIDE, SIDE, weight)
        else:
            edges, beyond = self.maker(points, weight), NONE_BEYOND
        return Layer(x=points.x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(eta, eta),
                     T_plates=(1.0, 1.0), g=self.wall.g, transport=mixed(self.mode.share, self.mode.mended))


def compiled(method: Layer, first: np.ndarray) -> Advance:
    """Compiled steps, until the run diverges or sound in heated gas outruns the step."""
    dt = OF_LIMIT*limit_of(method, first)

    def advance(state: np.ndarray, steps: int) -> tuple[np.ndarray, int]:
        if dt > limit_of(method, state):
            return state, 0
        try:
            return run(method, state, Plan(dt=dt, steps=steps)).state, steps
        except Divergence as end:
            return state, end.step
    return advance


# --- points that move as RR98 prints it -------------------------------------------------------------


class MotionDrift(WatchedRun, table="drift"):
    """Long run of RR98's moving points: vortices and sound on a stream of viscous gas, recorded every step.

    motion : a name in `rr98_moving_plain.MOTIONS`. integrator, weight : classes.
    """
    motion: str
    integrator: Any = RK4
    weight: Any = Lucy
    points: Disorder = DISORDERS["jittered-0.1"]
    dt: float = 0.2
    claimed: str = EVERYTHING
    scheme, maker, h, wall = "motions", "renormalised", NARROW, "periodic"

    @property
    def cost(self) -> float:
        return 5e-4*self.steps*self.integrator.evaluations

    @property
    def mode(self) -> str:
        return f"{self.motion}, {self.integrator.__name__}"

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make((FEW, FEW), self.points.size, self.seed)
        method = moving(MOTIONS[self.motion], points, self.weight.of(h=NARROW), ConstEta(0.2, 0.2))
        X, Y = (2*np.pi*points.x/points.box).T
        v = 0.1*np.stack([0.5 + np.sin(X)*np.cos(Y), 0.3 - np.cos(X)*np.sin(Y)], axis=1)
        state = method.state(points.x, 1 + 0.05*np.cos(X + Y), v, 1 + 0.05*np.sin(Y))
        mass, *_, total = method.conserved(state)
        fields = method.fields(state)
        momenta = fields.rho*fields.V@np.abs(fields.v)
        return self.watched(in_numpy(method, state, self.dt, self.integrator), state, method.conserved,
                            np.array([mass, *momenta, total]), report, records=self.steps)
