"""py-pde's solver of the gas where nothing convects: the vortex, sound, heat and shear between plates.

At the limit of its own formula, a step an eighth longer than which ends in the vortex; compiling, at each call, is not counted,
nor what py-pde does around the steps. Each component of the velocity is told where the staggered grid has it.
"""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.plates import FLOWS, Flow
from continuum.fluid import ConstEta, energy, sound_speed, temperature
from continuum.pypde.gas import RK4_DECAY, RK4_WAVE, Gas
from continuum.pypde.gas_loop import RHO, VX, VY, E
from continuum.pypde.solve import solve
from continuum.scene import Tile
from continuum.steady import Time
from studies.cost import names, waves
from studies.cost import plates as slabs
from studies.cost import vortex as vortices
from studies.cost.others import Solved
from studies.cost.problem import Residuals
from studies.cost.timing import Laps, array_bytes, of_calls

SAMPLES = 5         # of the seconds, which are those of as many equal parts of the run
#: (rho, u, v, T) at places x, y
Start = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, ...]]


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


def solved(make: Callable[[], Still], start: Start, time: float, residuals: Callable[[np.ndarray], Residuals],
           known: float) -> Solved:
    """What comes out at a time, and what it takes."""
    gas, laps = make(), Laps()
    done = solve(gas, until=Time(time, SAMPLES), start=gas.begun(start), dt=gas.step_limit(), progress=laps)
    return Solved(residuals(done.state), {}, done.state[0].size, done.steps, array_bytes(done.state, gas), known,
                  laps.total(SAMPLES), done.compile_s, of_calls(lambda: make().begun(start)), 1.0)


def places(gas: Gas, field: int) -> np.ndarray:
    """(n, 2) of a field's points."""
    return np.stack([q.ravel() for q in gas.mesh(field)], axis=1)


class OnVortex(NamedTuple):
    """The Taylor-Green vortex."""
    name: str = names.PYPDE_GAS
    mach: float = vortices.MACH

    def seconds(self, resolution: int) -> float:
        return 5 + 3e-5*resolution**3

    def solve(self, resolution: int) -> Solved:
        vortex = vortices.Vortex(self.mach, resolution)
        tile = Tile(width=resolution, L=resolution, law=ConstEta(vortex.eta, vortex.eta))

        def make() -> Still:
            return Still(tile, resolution, 2*vortex.speed)
        gas = make()

        def residuals(data: np.ndarray) -> Residuals:
            exactly = np.stack([vortices.exactly(vortex, places(gas, f))[:, f - VX] for f in (VX, VY)], axis=1)
            found = data[[VX, VY]].reshape(2, -1).T
            return vortices.told(vortex, np.ones(len(found)), exactly, found)
        return solved(make, partial(vortices.start_at, vortex), vortex.time, residuals, vortices.KNOWN[self.mach])


class OnWave(NamedTuple):
    """Sound along rows."""
    name: str = names.PYPDE_GAS

    def seconds(self, length: int) -> float:
        return 5 + 1e-4*length**2

    def solve(self, length: int) -> Solved:
        wave = waves.Wave(length)
        tile = Tile(width=length, L=waves.BREADTH, law=ConstEta(wave.eta, wave.eta))

        def make() -> Still:
            return Still(tile, waves.BREADTH, 0.0)
        gas = make()

        def residuals(data: np.ndarray) -> Residuals:
            T = temperature(gas.scene.eos, data[RHO], data[E]).ravel()
            return wave.compared(np.ones(T.size), places(gas, E)[:, 0], data[VX].ravel(), T, places(gas, VX)[:, 0])
        return solved(make, wave.start_at, wave.time, residuals, waves.KNOWN)


class OnSlab(NamedTuple):
    """Heat or shear between plates; velocities along them are told at the heights of the cells, where they are."""
    flow: Flow
    name: str = names.PYPDE_GAS

    def seconds(self, rows: int) -> float:
        return 5 + 2e-4*rows**2

    def solve(self, rows: int) -> Solved:
        flow = self.flow

        def make() -> Still:
            return Still(slabs.Slab(rows=rows), rows, flow.U, flow.U)
        gas = make()

        def start(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
            rho, v, u, T = (q.reshape(y.shape) for q in flow.start(y.ravel()/rows + 0.5))
            return rho, u, v, T

        def residuals(data: np.ndarray) -> Residuals:
            T, s = temperature(gas.scene.eos, data[RHO], data[E]).ravel(), places(gas, E)[:, 1]/rows + 0.5
            return slabs.compared(flow, np.ones(T.size), s, data[VX].ravel(), T)
        return solved(make, start, flow.time*rows, residuals, slabs.known(flow))


VORTEX, WAVE = OnVortex(), OnWave()
SLABS = {scene: OnSlab(flow) for scene, flow in FLOWS.items()}
