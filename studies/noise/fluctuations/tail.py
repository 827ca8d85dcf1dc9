"""Velocity autocorrelation of a fixed point of a gas at rest, with and without null modes, as cases    [RR98 Eqs 22, 37]

On a lattice, here of nearest neighbours, it is a sum over waves of what the linear scheme makes of each. In 2D the fluid's has
the tail kT/(8 pi rho nu t), from velocities across k. Sound takes 2 nu/(c^2 t) of that away until it has gone round the box, and
friction along edges nu/(c_T^2 t) for each of 3 corners of the zone, where it pushes density to and fro that no gradient sees.
Nested transport takes waves near a corner for long ones, and on even sides 3 waves of each component stay for ever.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.linalg import expm

from continuum.fluid import ConstEta, IdealGas
from particles.integral.covariance import jacobian
from particles.integral.dih import Dih, Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.points import lattice
from particles.run import Plan
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.matrices import factor, transport
from studies.noise.fluctuations.peaks import picked
from studies.noise.fluctuations.sampling import BATCHES, Linear, batches, check_length, over

FIELDS = 4      # rho, px, py, eps


def resting(side: int, share: float, eta: float) -> tuple[Edges, Dih, np.ndarray]:
    """Edges of a square lattice, the gas on it with kappa = eta, its state of rest."""
    edges = MAKERS["renormalised"](lattice((side, side)), Lucy.of(h=1.2))
    dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(eta, eta), transport=Mixed(share=share))
    return edges, dih, dih.state(np.ones(edges.n), np.zeros((edges.n, 2)), np.ones(edges.n))


def blocks(side: int, share: float, eta: float) -> np.ndarray:
    """J of all waves, (n, 4, 4) of (rho, px, py, eps), the mean first: from what one point does to the others."""
    _, dih, rest = resting(side, share, eta)
    columns = jacobian(dih.rates, rest, [0]).reshape(FIELDS, side, side, FIELDS)
    return np.moveaxis(np.fft.fft2(columns, axes=(1, 2)), 0, 2).reshape(-1, FIELDS, FIELDS)


def autocorrelation(steps: np.ndarray) -> float:
    """<v(0) v(t)> rho/kT of one component, averaged over both, at fixed total momentum, from exp(J t) (n, 4, 4) of each wave."""
    return float(np.einsum("kaa->", steps[1:, 1:3, 1:3]).real/(2*len(steps)))


@dataclass(frozen=True, kw_only=True)
class Tail(Case):
    """The exact autocorrelation at given nu t, in spacings squared; `share` of transport along edges."""
    side: int
    share: float
    nu_t: tuple[float, ...]
    eta: float = 1.0

    @property
    def cost(self) -> float:
        return 2e-4*self.side**2*len(self.nu_t)

    @property
    def label(self) -> str:
        return f"tail, side {self.side}, share {self.share:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        J = blocks(self.side, self.share, self.eta)
        return Outcome({"tail": [{"side": self.side, "share": self.share, "nu_t": x,
                                  "correlation": autocorrelation(expm(J*x/self.eta)),
                                  "continuum": 1/(8*np.pi*x)} for x in self.nu_t]})


@dataclass(frozen=True, kw_only=True)
class TailSampled(Case):
    """The same from samples by Crank-Nicolson, against its own propagator; null modes begin at their rms, and so should stay."""
    side: int
    share: float
    lags: tuple[int, ...]       # in steps
    steps: int
    dt: float = 0.5
    eta: float = 0.3
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1e-9*(FIELDS*self.side**2)**2*1.5 + 5

    @property
    def label(self) -> str:
        return f"tail sampled, side {self.side}, share {self.share:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        edges, dih, rest = resting(self.side, self.share, self.eta)
        n, J = edges.n, jacobian(dih.rates, rest)
        check_length(J, self.steps*self.dt)
        B = factor(edges, *transport(edges, self.share, self.eta, 0.0, self.eta, 1.0))
        modes = np.eye(FIELDS*n)[n:3*n]
        method = Linear(J=J, B=B, seed=self.seed, modes=modes, names=dih.names)
        plan = Plan(dt=self.dt, steps=self.steps, every=1, series={f"{i}": picked(i) for i in range(2*n)})
        legs = batches(method, self.begin(), plan, report)
        v = np.array([[leg.series[f"{i}"] for i in range(2*n)] for leg in legs])      # (batches, 2 n, steps)
        half = blocks(self.side, self.share, self.eta)*self.dt/2
        step = np.linalg.solve(np.eye(FIELDS) - half, np.eye(FIELDS) + half)
        rows = []
        for lag in self.lags:
            found = over((v[:, :, lag:]*v[:, :, :v.shape[2] - lag]).mean(axis=(1, 2)))
            rows.append({"side": self.side, "share": self.share, "lag": lag*self.dt, "measured": found.value,
                         "measured_err": found.err, "exact": autocorrelation(np.linalg.matrix_power(step, lag))})
        return Outcome({"tail_sampled": rows})

    def begin(self) -> np.ndarray:
        """Equilibrium at zero sums; velocities of the waves at corners of the zone with modulus 1, their rms."""
        state: np.ndarray = np.random.default_rng(self.seed).normal(size=(FIELDS, self.side, self.side))
        state[3] += state[0]
        for p in state[1:3]:
            wave = np.fft.fft2(p, norm="ortho")
            half = self.side//2
            for corner in ((half, 0), (0, half), (half, half)):
                wave[corner] /= abs(wave[corner])
            p[:] = np.fft.ifft2(wave, norm="ortho").real
        return (state - state.mean(axis=(1, 2), keepdims=True)).reshape(FIELDS, -1)
