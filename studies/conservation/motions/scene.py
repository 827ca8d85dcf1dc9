"""Waves on a lattice whose points move, and what is read from series of their amplitudes."""
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from particles.integral.dih import Pairwise
from particles.integral.interpolants import f, reach
from particles.integral.points import Points, lattice
from particles.integral.rr98_moving_plain import scale_of
from particles.integrators import RK4
from particles.limits import lattice_sums
from particles.threads import Team
from studies.kit.stats import Measured

ALONG = Pairwise(mended=False)
GAS, STILL, C = IdealGas(), ConstEta(0.0, 0.0), np.sqrt(2.0)      # c^2 = gamma P/rho = 2 at rho = T = 1
AMPLITUDE = 1e-4        # of waves: what is quadratic in it is 1e-4 of what is linear, and does not have the wave's length
BREADTH = 8             # spacings across a wave: more than twice the widest weight


def strip(wavelength: int, breadth: int = BREADTH) -> Points:
    """Lattice that is one wavelength long, or more waves where one is too short."""
    return lattice((wavelength*max(1, -(-breadth//wavelength)), breadth))


def moving(kind: Any, at: Points, weight: Any, law: Any = STILL, **more: Any) -> Any:
    """A motion of `motions` on points, edges renormalised on them; transport along edges, whose heating most runs do not need."""
    settings = {"transport": ALONG, **more}
    return kind(box=tuple(at.box), weight=weight, eos=GAS, law=law, scale=scale_of(at, weight), **settings)


def march(method: Any, state: np.ndarray, dt: float, steps: int, look: Any, integrator: Any = RK4) -> list[Any]:
    """look(state) before the first and after every step."""
    stepper, seen = integrator(state.shape, Team(1)), [look(state)]
    for _ in range(steps):
        stepper.step(method, state, dt)
        seen.append(look(state))
    return seen


def amplitude(q: np.ndarray, x: np.ndarray, k: float) -> complex:
    """Mean of q exp(-ikx)."""
    return complex(np.mean(q*np.exp(-1j*k*x)))


def roots(series: np.ndarray) -> np.ndarray:
    """The two factors a sample by which a series s_n = sum of two powers grows, by least squares."""
    known = np.stack([series[:-2], series[1:-1]], axis=1)
    b, c = np.linalg.lstsq(known, series[2:], rcond=None)[0]
    return np.roots([1.0, -c, -b])


def rate(series: np.ndarray, dt: float) -> complex:
    """Growth rate and i omega, omega > 0, of a wave that stands."""
    found = np.log(np.asarray(roots(series), complex))/dt
    return complex(found[np.argmax(found.imag)])


def by_halves(series: np.ndarray, measure: Any) -> Measured:
    """A number from the whole series; its error is what the two halves differ by."""
    one, other = (measure(half) for half in np.array_split(series, 2))
    return Measured(float(measure(series)), float(abs(one - other)))


def seen_slope(weight: Any, at: Points, k: float) -> float:
    """Wave number that gradients see on the lattice, over k: sum over the lattice, with the scale of `renormalised`."""
    return float(scale_of(at, weight)*np.abs(lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])).S[0, 0])/k)


def seen_stiffness(weight: Any, at: Points, k: float) -> float:
    """(1/k^2) sum_r w_xx (1 - cos kx): how a moved lattice under uniform pressure answers, 1 in the continuum."""
    return float(scale_of(at, weight)*lattice_sums(weight, 1.0, 1.0, np.array([[k, 0.0]])).D[0, 0, 0]/k**2)


def transform(weight: Any, k: float) -> float:
    """f^(k) of a compact weight in the plane: integral of f cos kx, by midpoints."""
    n = 400
    x = (np.arange(n) + 0.5)/n*reach(weight)
    x, y = np.meshgrid(x, x)
    r = np.hypot(x, y)
    inside = r < reach(weight)
    return float(4*np.sum(f(weight, r[inside])*np.cos(k*x[inside]))*(reach(weight)/n)**2)
