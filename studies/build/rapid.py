"""Two periodic test scenes: a shock tube, and a shear layer that rolls up."""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from continuum.exact.riemann import GasState, solution
from continuum.exact.shear import growing_wave, layer_with_wave
from continuum.fluid import ConstEta, Fields, IdealGas
from particles.integral.points import wrapped
from studies.build.scenes import SOUND, Answer, Scene, Start

GAMMA = 1.4
JITTER = 0.05       # displacement at the start, in spacings of the particles: a perfect lattice never mixes


@dataclass(frozen=True, kw_only=True)
class ShockTube(Scene):
    """Sod's shock tube and its mirror image: gas dense at |x| < half, thin beyond; shocks travel 0.7 half.

    Density and pressure have the ratios 1 to 0.125 and 1 to 0.1, the mean density is 1    [Sod 1978]
    eta : viscosity and conductivity; the default makes the cell Reynolds number 2 behind the shock, beyond
    which central differences oscillate. L : the height, which has no effect.
    """
    half: int
    eta: float = 0.22
    L: float = 12.0
    eos: IdealGas = IdealGas(cv=2.5)  # noqa: RUF009 (immutable)

    counted = "half"
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

    def answer(self, x: np.ndarray) -> Answer:
        """Exact fields without viscosity."""
        across = np.abs(x[:, 0])
        rho, v, P = solution(self.dense, self.thin, GAMMA, (across - self.half)/self.time)
        return {"rho": rho, "vx": np.sign(x[:, 0])*v, "T": P/rho}

    def of_one_mass(self, seed: int) -> tuple[np.ndarray, Start]:
        """Jittered rows, 3/4 of a spacing apart in the dense gas, 2 spacings in the thin one."""
        rng, parts = np.random.default_rng(seed), []
        for gas, rows, left in ((self.dense, 16, -self.half), (self.thin, 6, self.half)):
            columns = round(2*self.half*self.L*gas.rho/rows)
            cell = np.array([2*self.half/columns, self.L/rows])
            at = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2)
            parts.append(cell*(at + 0.5 + rng.uniform(-JITTER, JITTER, at.shape)) + (left, -self.L/2))
        x = wrapped(np.concatenate(parts), np.array([self.width, self.L]))
        return x, self.fields(x)


@dataclass(frozen=True, kw_only=True)
class ShearLayer(Scene):
    """Shear u = U sin ky without friction, and its fastest growing wave, twice as long, of amplitude U/100.

    The gas conducts heat: without it runs with drifting points fail at once. The unit of time is 1/rate of a
    fluid of constant density, so that the growth rate is 1, up to the square of the Mach number
    [Rayleigh 1880]
    """
    L: int
    mach: float = 0.1
    size: float = 0.01
    growths: float = 3.0        # length of the run, in 1/rate

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

    @property
    def duration(self) -> tuple[float, float]:
        return self.growths, 1/self.rate

    @property
    def quantities(self) -> dict[str, Callable]:
        return {"wave": self.wave}

    def wave(self, at: Fields) -> float:
        """Amplitude of the component exp(i k_x x) of v_y, weighted by mass."""
        m = at.rho*at.V
        return float(abs(np.sum(m*at.v[:, 1]*np.exp(-1j*np.pi/self.L*at.x[:, 0])))/m.sum())
