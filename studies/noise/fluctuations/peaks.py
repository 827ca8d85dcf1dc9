"""Brillouin and Rayleigh peaks of sampled density waves, as cases    [RR98 Eqs 20-25]"""
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import stdtrit

from continuum.fluid import ConstEta, IdealGas
from particles.integral.covariance import crank_nicolson, jacobian
from particles.integral.dih import Dih, Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.points import lattice
from particles.run import Plan
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.matrices import ETA, KAPPA, factor, states_of_fields, transport
from studies.noise.fluctuations.sampling import BATCHES, Linear, batches, check_length
from studies.noise.fluctuations.steps import gas


@dataclass(frozen=True, kw_only=True)
class Brillouin(Case):
    """Peaks of the dynamic structure factor on a line of points: from sampled waves, against the symbols of the lattice.

    Waves (rho, u, T) after a lag are U times what they were, U = <x' x^*><x x^*>^-1; its eigenvalues are exp(lambda lag), and
    sound has the peak at Im lambda, of half width -Re lambda. Crank-Nicolson's z = (1 + lambda dt/2)/(1 - lambda dt/2) is undone.
    """
    points: int
    turns: tuple[int, ...]
    steps: int
    dt: float = 0.25
    lag: int = 4
    bins: int = 60
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1e-4

    @property
    def label(self) -> str:
        return f"Brillouin, {self.points} points"

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = MAKERS["renormalised"](lattice((self.points,)), Lucy.of(h=2.0, d=1))
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(0.0, KAPPA), zeta=ETA, transport=Mixed(share=1.0))
        v = np.zeros((edges.n, 1))
        J, to_state = jacobian(dih.rates, dih.state(np.ones(edges.n), v, np.ones(edges.n))), states_of_fields(v)
        B = factor(edges, *transport(edges, 1.0, 0.0, ETA, KAPPA, 1.0))
        method = Linear(J=J, B=B, seed=self.seed, modes=self.waves()@np.linalg.inv(to_state), names=("rho", "p", "eps"))
        check_length(J, self.steps*self.dt)
        series = {f"{number}": picked(number) for number in range(6*len(self.turns))}
        state = np.random.default_rng(self.seed).normal(size=(3, self.points))
        state = (to_state@state.ravel()).reshape(state.shape)
        state -= state.mean(axis=1, keepdims=True)
        legs = batches(method, state, Plan(dt=self.dt, steps=self.steps, every=1, series=series), report)
        rows, spectrum = [], []
        for number, turns in enumerate(self.turns):
            x = np.array([[np.array(leg.series[f"{6*number + 2*f}"]) + 1j*np.array(leg.series[f"{6*number + 2*f + 1}"])
                           for f in range(3)] for leg in legs])
            rows += self.peaks(x, turns)
            spectrum += self.spectrum(x, turns)
        return Outcome({"peaks": rows, "spectrum": spectrum})

    def waves(self) -> np.ndarray:
        """Rows: real and imaginary part of rho, u and T at each wave number, variance 1 in equilibrium."""
        rows = []
        for turns in self.turns:
            wave = np.exp(-2j*np.pi*turns*np.arange(self.points)/self.points)/np.sqrt(self.points)
            rows += [np.kron(field, w) for field in np.eye(3) for w in (wave.real, wave.imag)]
        return np.array(rows)

    def peaks(self, x: np.ndarray, turns: int) -> list[dict[str, Any]]:
        """Position and half width of the Brillouin peak, half width of the Rayleigh peak; errors by jackknife over batches."""
        after, before = x[:, :, self.lag:], x[:, :, :-self.lag]
        moments = [np.einsum("bft,bgt->bfg", q, before.conj()) for q in (after, before)]
        whole = self.rates(*(m.sum(axis=0) for m in moments))
        without = np.array([self.rates(*(m.sum(axis=0) - m[b] for m in moments)) for b in range(len(x))])
        b = len(x)
        err = stdtrit(b - 1, 0.975)*np.sqrt((b - 1)/b*((without - without.mean(axis=0))**2).sum(axis=0))
        k = 2*np.pi*turns/self.points
        symbol = sorted_rates(np.linalg.eigvals(gas(k)[0]))
        return [{"points": self.points, "turns": turns, "wavenumber": k, "peak": name,
                 "measured": value, "measured_err": e, "symbol": s}
                for name, value, e, s in zip(PEAKS, whole, err, symbol, strict=True)]

    def rates(self, after: np.ndarray, before: np.ndarray) -> np.ndarray:
        """(position, half width, Rayleigh half width) from summed products."""
        z = np.linalg.eigvals(after@np.linalg.inv(before))
        z = np.exp(np.log(z)/self.lag)
        return sorted_rates(2/self.dt*(z - 1)/(z + 1))

    def spectrum(self, x: np.ndarray, turns: int) -> list[dict[str, Any]]:
        """Spectrum of the density over its integral, in bins up to twice the peak, and what these steps should give."""
        J, Q = gas(2*np.pi*turns/self.points)
        A, Qd = crank_nicolson(J, Q, self.dt)
        omega = 2*np.pi*np.fft.fftfreq(x.shape[2], self.dt)
        power = (np.abs(np.fft.fft(x[:, 0], axis=1))**2).mean(axis=0)/x.shape[2]*self.dt
        edge = np.linspace(0, 2*abs(np.linalg.eigvals(J).imag).max(), self.bins + 1)
        found = []
        for low, high in pairwise(edge):
            inside = (np.abs(omega) >= low) & (np.abs(omega) < high)
            some = omega[inside][::1 + np.count_nonzero(inside)//20]
            if inside.any():
                theory = [spectral(A, Qd, w*self.dt)*self.dt for w in some]
                found.append({"turns": turns, "points": self.points, "omega": (low + high)/2, "measured": power[inside].mean(),
                              "predicted": float(np.mean(theory))})
        return found


def spectral(A: np.ndarray, Q: np.ndarray, angle: float) -> float:
    """Spectrum of the first field of x' = A x + noise."""
    G = np.linalg.inv(np.eye(len(A))*np.exp(1j*angle) - A)
    return float((G@Q@G.conj().T)[0, 0].real)


PEAKS = ("position", "half width", "Rayleigh half width")


def sorted_rates(eigen: np.ndarray) -> np.ndarray:
    """Position and half width of sound, both averaged, half width of heat, which lies between them."""
    low, heat, high = eigen[np.argsort(eigen.imag)]
    return np.array([(high.imag - low.imag)/2, -(high.real + low.real)/2, -heat.real])


def picked(number: int) -> Callable[[Any, np.ndarray], float]:
    """One mode as a series."""
    return lambda sums, state: sums.found[number]
