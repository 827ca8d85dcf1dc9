"""Images behind plates that do not keep gradient and divergence adjoint: does sound grow, does mass stay?    [RR98, Sec. III]

Convection and pressure are to see images without friction (`particles.integral.layer`). Here they see others: with the velocity
reversed, as friction does, with the temperature that conduction sees, or with both.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.edge_makers import renormalised
from particles.integral.edges import between_plates
from particles.integral.layer import Exchanging, Layer
from particles.integral.points import lattice
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build.fixed import SCHEMES, layer
from studies.build.read import Value, select
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Table, Tables
from studies.operators.stability import jacobian

C = np.sqrt(2.0)        # of sound at T = 1
TIMES = 20              # of free fall, until mass is looked at

#: largest growth rate in c/a of small disturbances of a gas at rest between plates, without gravity; viscosity = conductivity in
#: rho a; by eigenvalues, without chance
MIXED = Table("mixed_images", key=["images", "h", "rows", "viscosity"], columns=["images", "h", "rows", "viscosity", "growth"])
#: mass over that at the start, less 1, after so many free-fall times of convection, or where the run ended; one run each, whose
#: start has no chance in it
MASS = Table("image_mass", key=["images", "ra", "rows"], columns=["images", "ra", "rows", "times", "drift"])
TABLES = (MIXED, MASS)


@dataclass(frozen=True, kw_only=True)
class Mixed(Layer):
    """A layer whose convection and pressure see images with -v (reversed), with 2 T_w - T (opposite), or as they should."""
    reversed: bool = False
    opposite: bool = False
    fast: bool = False

    def start(self, n: int, team: Team) -> "MixedSums":
        """The sums over stored edges."""
        return MixedSums(self, team)


class MixedSums(Exchanging):
    """The sums of a layer, what images show changed before they are taken."""
    method: Mixed

    def look_at(self, state: np.ndarray) -> None:
        """Fields of all points and images; images show convection and pressure what friction and conduction see."""
        super().look_at(state)
        images = self.points[self.n:]
        if self.method.reversed:
            images["vx"], images["vy"] = images["ux"], images["uy"]
        if self.method.opposite:
            images["T"] = images["Td"]


#: reversed, opposite
IMAGES = {"adjoint": (False, False), "velocity reversed": (True, False), "temperature of conduction": (False, True),
          "both": (True, True)}


def mixed(fluid: Layer, images: str) -> Mixed:
    """The layer with such images."""
    turned, opposite = IMAGES[images]
    return Mixed(x=fluid.x, edges=fluid.edges, beyond=fluid.beyond, eos=fluid.eos, law=fluid.law, T_plates=fluid.T_plates,
                 g=fluid.g, reversed=turned, opposite=opposite)


@dataclass(frozen=True, kw_only=True)
class Rest(Case):
    """The fastest growing disturbance of a gas at rest, rho = T = 1, in a square of `rows` between plates at T = 1."""
    images: str
    h: float
    rows: int
    viscosity: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        x, side = lattice((self.rows, self.rows)).x, float(self.rows)
        edges, beyond = between_plates(renormalised, x, side, side, Lucy.of(h=self.h))
        fluid = mixed(Layer(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(self.viscosity, self.viscosity),
                            T_plates=(1.0, 1.0), g=0.0), self.images)
        state = fluid.state(1.0, 0*x, np.ones(len(x)))
        growth = np.linalg.eigvals(jacobian(fluid.start(len(x), Team(1)), state)).real.max()/C
        return Outcome({"mixed_images": [{"images": self.images, "h": self.h, "rows": self.rows, "viscosity": self.viscosity,
                                          "growth": float(growth)}]})


@dataclass(frozen=True, kw_only=True)
class Kept(Case):
    """Mass of convection between plates with such images, from the usual start, h = 2 a."""
    images: str
    ra: float
    rows: int

    @property
    def cost(self) -> float:
        return 1e-3*self.rows**3

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows))
        fluid = mixed(layer(scene, SCHEMES["fixed-lattice"], 1), self.images)
        first = fluid.state(*scene.fields(fluid.x))
        dt, times = 0.5*limit_of(fluid, first), float(TIMES)
        steps = round(TIMES*(scene.L/scene.free_fall)/dt)
        try:
            state = run(fluid, first.copy(), Plan(dt=dt, steps=steps)).state
        except Divergence as end:
            return Outcome({"image_mass": [{"images": self.images, "ra": self.ra, "rows": self.rows,
                                            "times": end.step*dt/(scene.L/scene.free_fall), "drift": np.nan}]})
        drift = float(fluid.edges.V@state[0]/(fluid.edges.V@first[0]) - 1)
        return Outcome({"image_mass": [{"images": self.images, "ra": self.ra, "rows": self.rows, "times": times,
                                        "drift": drift}]})


def cases(sizes: tuple[int, ...]) -> Iterator[Case]:
    """Rest at the smaller sizes, convection at two."""
    for images, h, rows in product(IMAGES, (2.0, 3.0), sizes[:2]):
        yield from (Rest(images=images, h=h, rows=rows, viscosity=eta) for eta in (0.0, 0.1))
    yield from (Kept(images=images, ra=5000.0, rows=2*rows) for images, rows in product(IMAGES, sizes[:2]))


WRONG = tuple(name for name in IMAGES if name != "adjoint")
NOISE = 1e-8        # of growth rates: differences of 1e-6 leave 1e-10 of each number in a matrix of some hundred rows


def largest(images: tuple[str, ...], viscosity: float) -> Value:
    """Largest growth rate of some images, over ranges and sizes."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "mixed_images", viscosity=viscosity)
        return Measured(float(rows.loc[rows["images"].isin(images), "growth"].max()), NOISE/10)
    return value


def least(images: str, h: float) -> Value:
    """Least growth rate of such images over sizes, without viscosity."""
    return lambda tables: Measured(float(select(tables, "mixed_images", images=images, h=h, viscosity=0.0)["growth"].min()),
                                   NOISE/10)


def lost(images: str) -> Value:
    """Mass gained or lost, as a share; of the larger layer."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "image_mass", images=images).sort_values("rows")
        return Measured(abs(float(rows["drift"].iloc[-1])), 0.0)
    return value


REST = "a gas at rest between plates, largest growth rate in c/a, h = 2 and 3 a, 8 and 12 rows"
CLAIMS = (
    Claim(id="own-images-adjoint", source="RR98 Eqs 34-36", at_most=NOISE, value=largest(("adjoint",), 0.0),
          because="differences of 1e-6 leave 1e-9 of eigenvalues",
          statement="images that show convection and pressure a mirror without friction let no sound grow, without any "
                    f"viscosity: {REST}"),
    *(Claim(id=f"own-images-{name.split()[0]}-{h:.0f}", source="RR98 Eqs 34-36", at_least=1e-3, value=least(name, h),
            because="by e in a thousand crossings of a spacing by sound; trials gave 0.008 and more",
            statement=f"images that are not adjoint ({name}) let sound grow where there is no viscosity: a gas at rest between "
                      f"plates, largest growth rate in c/a, h = {h:.0f} a, the less of 8 and 12 rows")
      for name, h in product(WRONG, (2.0, 3.0))),
    Claim(id="own-images-hidden", source="RR98 Eqs 34-36, 51", at_most=NOISE, value=largest(WRONG, 0.1),
          because="differences of 1e-6 leave 1e-9 of eigenvalues",
          statement=f"viscosity along edges, 0.1 rho a, hides what such images do: {REST}, all three kinds"),
    Claim(id="own-images-mass-kept", source="RR98 Eq. 34", at_most=1e-12, value=lost("adjoint"),
          because="round-off: some 1e3 steps of 1e-16 each",
          statement=f"images without friction keep the mass: change in {TIMES} free-fall times of convection, Ra 5000"),
    Claim(id="own-images-mass-lost", source="RR98 Eq. 34", at_most=1e-12, value=lost("velocity reversed"),
          because="as with images without friction",
          statement="images with the velocity reversed, which friction sees, keep the mass in convection, too: change in "
                    f"{TIMES} free-fall times, Ra 5000"),
)
