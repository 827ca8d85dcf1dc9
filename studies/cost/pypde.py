"""py-pde's solvers, compiled at each call: of the gas in all flows, of the Boussinesq fluid in convection.

Steps are at the limit of its own formula, an eighth longer than which ends in the vortex (in convection the driver's
0.8 of it); compiling is not counted, nor what py-pde does around the steps. Each component of the velocity is compared
where the staggered grid has it.
"""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.vortex import solved as gas_of_mach
from continuum.exact.vortex import velocities
from continuum.fluid import energy, sound_speed, temperature
from continuum.pypde import solve as pypde
from continuum.pypde.gas import RK4_DECAY, RK4_WAVE, Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.fields import Fields
from studies.build.grid import started
from studies.build.names import START_ENERGY
from studies.cost.direct import Solved
from studies.cost.flows import Plates, Vortex, Wave
from studies.cost.layer import END, OFTEN, PR, RA, Followed, Rules, Sizes, boussinesq_reference, reference, scene_of
from studies.cost.problem import Price, Residuals
from studies.cost.timing import Laps, array_bytes, of_calls

SAMPLES = 5         # of the seconds, which are those of as many equal parts of the run
#: (rho, u, v, T) at places x, y
Start = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]
#: residuals of a state (4, columns, rows) of a gas in a contest
Held = Callable[["Still", Any, np.ndarray], Residuals]


class Still(Gas):
    """The gas of scenes without gravity at temperatures and densities about 1; `fastest`: of its velocities."""

    def __init__(self, scene: Any, rows: int, fastest: float, slide: float = 0.0):
        super().__init__(scene, rows, slide)
        self.fastest = fastest

    def step_limit(self) -> float:
        """As that of convection."""
        eos, law = self.scene.eos, self.scene.law
        wave = (2*np.sqrt(2)*float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0))) + self.fastest)/self.h
        decay = 8*max(law.eta, law.k/eos.cv)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_WAVE))

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """v^2/2 per volume, as cheap as it gets: samples are there for their times."""
        return float((data[VX]**2 + data[VY]**2).mean()/2), np.nan, 1.0

    def nusselt(self, data: np.ndarray) -> tuple[float, float, float]:
        """No heat is driven through it."""
        return np.nan, np.nan, np.nan

    def begun(self, start: Start) -> np.ndarray:
        """The state (4, columns, rows) of a start, each field where it is."""
        at = [start(*self.mesh(field)) for field in range(4)]
        data = np.array([at[RHO][0], at[VX][1], at[VY][2], energy(self.scene.eos, at[E][0], at[E][3])])
        if not self.box.torus:
            data[VY, :, -1] = 0
        return data


def places(gas: Gas, field: int) -> np.ndarray:
    """(n, 2) of a field's points."""
    return np.stack([q.ravel() for q in gas.mesh(field)], axis=1)


# --- flows with exact answers -----------------------------------------------------------------------------------


class InFlow(NamedTuple):
    """The gas in a contest. held : residuals of its state."""
    name: str
    contest: Any
    price: Price
    held: Held

    def solve(self, size: int) -> Solved:
        """At a resolution."""
        scene, laps = self.contest.scene(size), Laps()

        def make() -> Still:
            return Still(scene, round(scene.L), fastest(scene), scene.slide)
        gas, start = make(), partial(started, scene)
        done = pypde.solve(gas, until=Time(scene.time, SAMPLES), start=gas.begun(start), dt=gas.step_limit(),
                           progress=laps)
        return Solved(self.held(gas, self.contest, done.state), {}, done.state[0].size, done.steps,
                      array_bytes(done.state, gas), self.contest.known, laps.total(SAMPLES), done.compile_s,
                      of_calls(lambda: make().begun(start)), 1.0)


def fastest(scene: Any) -> float:
    """The largest velocity that the formula counts: twice that of a vortex, that of a plate, none of small waves."""
    return float(2*scene.speed if hasattr(scene, "speed") else scene.slide)


def vortex(gas: Still, contest: Vortex, data: np.ndarray) -> Residuals:
    """Both components where they are."""
    scene, answer = gas.scene, gas_of_mach(contest.mach)
    exact = np.stack([velocities(answer, places(gas, f)/scene.L)[:, f - VX] for f in (VX, VY)], axis=1)
    v = data[[VX, VY]].reshape(2, -1).T
    return contest.against(scene, np.ones(len(v)), exact, v)


def sound(gas: Still, contest: Wave, data: np.ndarray) -> Residuals:
    """The velocity on the sides of cells, the temperature in them."""
    T = temperature(gas.scene.eos, data[RHO], data[E]).ravel()
    u, x = data[VX].ravel(), places(gas, E)[:, 0]
    return contest.against(gas.scene, np.ones(T.size), (places(gas, VX)[:, 0], u), (x, T))


def between(gas: Still, contest: Plates, data: np.ndarray) -> Residuals:
    """Velocities along plates at the heights of the cells, where they are."""
    T, s = temperature(gas.scene.eos, data[RHO], data[E]).ravel(), places(gas, E)[:, 1]/gas.scene.L + 0.5
    return contest.against(gas.scene, np.ones(T.size), s, data[VX].ravel(), T)


# --- convection -------------------------------------------------------------------------------------------------


class InLayer(NamedTuple):
    """Convection at the driver's own step: the gas, or Boussinesq where `gas` is False."""
    name: str
    gas: bool
    price: Price = Price(4, 2e-4, 3)
    sizes: Sizes = Sizes()

    def solve(self, rows: int) -> Solved:
        """At a resolution."""
        laps, samples, scene = Laps(), round(END*OFTEN), scene_of(rows)
        unit = scene.L/scene.free_fall if self.gas else 1.0
        options: dict[str, Any] = {"until": Time(END*unit, samples), "start": pypde.Rolls(START_ENERGY),
                                   "progress": laps}
        done = (pypde.solve_gas(scene, rows, **options) if self.gas
                else pypde.solve_boussinesq(ra=RA, pr=PR, rows=rows, **options))
        rules = Rules(reference(self.sizes) if self.gas else boussinesq_reference(self.sizes))
        followed = Followed(done.series.t/unit, done.series.ke, done)
        residuals = rules.residuals(followed, seen(scene, done) if self.gas else None)
        if not self.gas:
            residuals.pop("K(t)")     # its rolls at the start are not KHP95's, which are not free of divergence
        return Solved(residuals, rules.share(followed, residuals), done.state[0].size, done.steps,
                      array_bytes(done.state, done.equation), rules.against.known, laps.total(samples), done.compile_s)


def seen(scene: RayleighBenard, done: pypde.PdeSolution) -> Fields:
    """Fields of a solution, places in heights."""
    x, y, vx, vy, T = (done.fields[name].ravel() for name in ("x", "y", "v_x", "v_y", "T"))
    one = np.ones_like(T)
    return Fields(np.stack([x, y], axis=1)/scene.L, np.stack([vx, vy], axis=1), one, T, one)
