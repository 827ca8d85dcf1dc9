"""Two periodic scenes that try a method: a shock tube, and a shear layer that rolls up."""
from dataclasses import dataclass, replace

import numpy as np

from continuum.exact.riemann import GasState, solution
from continuum.exact.shear import growing_wave, layer_with_wave
from continuum.fluid import ConstEta, Fields, IdealGas
from studies.build.answers import answer, duration, of_one_mass, quantities, rows_of, with_rows
from studies.build.scenes import SOUND, Scene, Start

GAMMA = 1.4
JITTER = 0.05       # of particles at the start, in their own spacings: rows of a perfect lattice never mix


@dataclass(frozen=True, kw_only=True)
class ShockTube(Scene):
    """Sod's tube beside its mirror image: dense at |x| < half, thin beyond; the shock goes 0.7 half far.

    Density and pressure have the ratios 1 to 0.125 and 1 to 0.1, the mean density is 1    [Sod 1978]
    eta : viscosity and conductivity; the usual one makes the cell number 2 behind the shock, beyond which
    central differences ring. L : the height, of no moment.
    """
    half: int
    eta: float = 0.22
    L: float = 12.0
    eos: IdealGas = IdealGas(cv=2.5)  # noqa: RUF009 (immutable)

    dense = GasState(16/9, 0.0, 16/9)
    thin = GasState(2/9, 0.0, 1.6/9)

    @property
    def width(self) -> float:  # type: ignore[override]
        return 4.0*self.half

    @property
    def law(self) -> ConstEta:
        return ConstEta(self.eta, self.eta)

    @property
    def time(self) -> float:
        return 0.4*self.half

    def fields(self, x: np.ndarray) -> Start:
        dense, thin = (np.array(gas)[:, None] for gas in (self.dense, self.thin))
        rho, _, P = np.where(np.abs(x[:, 0]) < self.half, dense, thin)
        return rho, np.zeros((len(x), 2)), P/rho


rows_of.register(ShockTube, lambda scene: scene.half)
with_rows.register(ShockTube, lambda scene, rows: replace(scene, half=rows))


@answer.register
def _(scene: ShockTube, x: np.ndarray) -> dict[str, np.ndarray]:
    """Without viscosity."""
    across = np.abs(x[:, 0])
    rho, v, P = solution(scene.dense, scene.thin, GAMMA, (across - scene.half)/scene.time)
    return {"rho": rho, "vx": np.sign(x[:, 0])*v, "T": P/rho}


@of_one_mass.register
def _(scene: ShockTube, seed: int) -> tuple[np.ndarray, Start]:
    """Rows 3/4 of a spacing apart in the dense gas, 2 in the thin one."""
    rng, parts = np.random.default_rng(seed), []
    for gas, rows, left in ((scene.dense, 16, -scene.half), (scene.thin, 6, scene.half)):
        columns = round(2*scene.half*scene.L*gas.rho/rows)
        cell = np.array([2*scene.half/columns, scene.L/rows])
        numbers = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2)
        parts.append(cell*(numbers + 0.5 + rng.uniform(-JITTER, JITTER, numbers.shape)) + (left, -scene.L/2))
    x = np.concatenate(parts)
    x[:, 0] = (x[:, 0] + scene.width/2) % scene.width - scene.width/2
    return x, scene.fields(x)


@dataclass(frozen=True, kw_only=True)
class ShearLayer(Scene):
    """u = U sin ky without friction, and its fastest wave, twice as long, of a hundredth of U.

    The gas conducts heat, so that points which drift do not end at once. The rate is that of a fluid of
    constant density: times are in units of it, so that the growth is 1 but for the square of the Mach
    number    [Rayleigh 1880]
    """
    L: int
    mach: float = 0.1
    size: float = 0.01
    growths: float = 3.0        # of the run, in 1/rate

    @property
    def width(self) -> int:  # type: ignore[override]
        return 2*self.L

    @property
    def speed(self) -> float:
        return self.mach*SOUND

    @property
    def law(self) -> ConstEta:
        return ConstEta(0.0, 2*np.pi/self.L)

    @property
    def rate(self) -> float:
        """Growth rate of the wave, exact at Mach number 0."""
        k = 2*np.pi/self.L
        return growing_wave(self.speed, k, k/2)[0]

    @property
    def time(self) -> float:
        return self.growths/self.rate

    def fields(self, x: np.ndarray) -> Start:
        v = layer_with_wave(x, self.speed, 2*np.pi/self.L, self.size)
        return np.ones(len(x)), v, np.ones(len(x))


duration.register(ShearLayer, lambda scene: (scene.growths, 1/scene.rate))


@quantities.register
def _(scene: ShearLayer) -> dict:
    def wave(at: Fields) -> float:
        """Size of the part of v_y that goes as exp(i k_x x)."""
        m = at.rho*at.V
        return float(abs(np.sum(m*at.v[:, 1]*np.exp(-1j*np.pi/scene.L*at.x[:, 0])))/m.sum())
    return {"wave": wave}
