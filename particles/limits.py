"""The largest stable time step: eigenvalues of a linearised method, and RK4's stability region.

On a square lattice at rest, at uniform rho and e, small waves exp(ik.r) of displacement u, velocity v and
energy e' obey, with p = P/rho^2, S(k) = sum_r grad w sin k.r, D(k) = sum_r (grad grad w) (1 - cos k.r),

    rho' = i m S.u                                   p' = P'/rho^2 - 2 P rho'/rho^3
    du/dt = v    dv/dt = i m S p' - 2 m p D u - (eta/rho) k2 v    de'/dt = i m p S.v - (k/rho) k2 T'

where k2 replaces the squared wave number: |m S/rho|^2 in `Nested` sums, (2 m/rho) sum_r (-w'/r)(1 - cos k.r)
in `Direct` ones. S gives sound, D the stiffness of pairs. Walls and gravity are neglected. Particles off the
lattice oscillate faster: by 1 (Wendland C2) to 21 % (B-spline) once settled, by up to 40 % at random places.
"""
from collections import namedtuple
from collections.abc import Callable
from functools import cache, singledispatch
from typing import Any

import numpy as np

from continuum.fluid import check_state, conductivity, pressure, pressure_slopes, temperature, viscosity
from particles.integrators import RK4
from particles.plan import Run
from particles.smooth.spam import Spam
from particles.threads import Threads
from particles.weights import value_and_slope

TRIALS = 40         # evaluations of the rates of a method without a formula
TINY = 1e-7         # relative change of a state in a difference quotient of its rates


#: Lattice sums: density; at wave vectors S (k, 2), D (k, 2, 2), k2 of `Nested` and `Direct` sums (k,).
Symbols = namedtuple("Symbols", "rho S D nested direct")


@singledispatch
def limit_of(method: Any, start: np.ndarray) -> float:
    """The largest stable time step of a method at a start (fields, n).

    From the formula registered for this type of method, else from its own `limit(start)`, else from its rates
    for RK4. Raises TypeError: the integrator is not RK4 and the method has no `limit`.
    """
    if hasattr(method, "limit"):
        return float(method.limit(start))
    if getattr(method, "integrator", RK4) is not RK4:
        raise TypeError(f"the longest step of {type(method).__name__} is not known, as its integrator is not "
                        "RK4: write its limit(start)")
    return largest_step(by_trial(method, start))


@limit_of.register
def _(method: Spam, start: np.ndarray) -> float:
    return step_limit(method, start[4])


def by_trial(method: Any, start: np.ndarray) -> np.ndarray:
    """Estimate the outermost eigenvalues of d(rates)/d(state) at a start, the largest within some 2 %.

    Raises ValueError: rates of one state differ between two calls.
    """
    now = Run(state=start.copy(), ids=np.arange(start.shape[1]))
    sums = method.start(start.shape[1], Threads(1))
    sums.make_ready(now, TINY)
    small, rest = TINY*float(np.linalg.norm(start)), rates_of(sums, now.state)
    if not np.array_equal(rest, rates_of(sums, now.state)):
        raise ValueError(f"rates of {type(method).__name__} differ between two calls with one state: leave "
                         "noise out of them, or write its limit(start)")
    return outermost(lambda wave: (rates_of(sums, now.state + small*wave) - rest)/small, start.shape)


def outermost(product: Callable[[np.ndarray], np.ndarray], shape: tuple, trials: int = TRIALS) -> np.ndarray:
    """Estimate the outermost eigenvalues of a matrix from its products with vectors    [Arnoldi 1951]"""
    pushed, waves, H = np.random.default_rng(1).standard_normal(shape), [], np.zeros((trials + 1, trials))
    for k in range(trials):
        waves.append(pushed/np.linalg.norm(pushed))
        pushed = product(waves[k])
        for i, wave in enumerate(waves):
            H[i, k] = np.vdot(wave, pushed)
            pushed -= H[i, k]*wave
        H[k + 1, k] = np.linalg.norm(pushed)
        if H[k + 1, k] <= TINY*np.abs(H).max():
            return np.linalg.eigvals(H[:k + 1, :k + 1])
    return np.linalg.eigvals(H[:-1])


def rates_of(sums: Any, state: np.ndarray) -> np.ndarray:
    """d(state)/dt. Raises FloatingPointError: it is not finite."""
    out = np.full_like(state, np.nan)
    sums.rates(state, out)
    if not np.isfinite(out).all():
        row = int(np.argwhere(~np.isfinite(out))[0, 0])
        raise FloatingPointError(f"rates leave row {row} of out unwritten, or not finite: write d(state)/dt "
                                 "into all of out")
    return out


def step_limit(method: Spam, e: Any, rho: float = 1.0) -> float:
    """The largest dt at which no lattice wave grows in RK4. Raises ValueError: the eos excludes (rho, e)."""
    check_state(method.eos, rho, e)
    symbols = lattice_sums(method.weight, method.m, rho, zone(np.sqrt(method.m/rho)))
    return min(largest_step(waves(method, symbols, float(extreme))) for extreme in {np.min(e), np.max(e)})


def zone(a: float, points: int = 33) -> np.ndarray:
    """Wave vectors (k, 2) in an eighth of the Brillouin zone of a square lattice; symmetry gives the rest."""
    return np.array([(i, j) for i in range(points) for j in range(i + 1)])*np.pi/a/(points - 1)


def lattice_sums(weight: Any, m: float, rho: float, k: np.ndarray) -> Symbols:
    """Sums over the square lattice at wave vectors (k, 2). Raises ValueError: no neighbour is in range."""
    a = np.sqrt(m/rho)
    x = a*np.arange(-int(weight.h/a) - 1, int(weight.h/a) + 2)
    x, y = (q.ravel() for q in np.meshgrid(x, x))
    r = np.hypot(x, y)
    x, y, r = (q[(0 < r) & (r < weight.h)] for q in (x, y, r))
    if not len(r):
        raise ValueError(f"particles {a:.4g} apart do not see each other within the weight's range h = "
                         f"{weight.h:.4g}: take a larger h or more particles (Eq. 45: several spacings)")
    w, f, curvature = (np.array(q) for q in zip(*(_derivatives(weight, s) for s in r)))
    phase, n = k@np.stack([x, y]), np.stack([x, y], axis=1)/r[:, None]
    S, slow = np.sin(phase)@(n*(r*f)[:, None]), 1 - np.cos(phase)
    hessian = f[:, None, None]*np.eye(2) + (curvature - f)[:, None, None]*n[:, :, None]*n[:, None, :]
    rho = m*(w.sum() + value_and_slope(weight, 0.0)[0])
    D = np.einsum("kr,rab->kab", slow, hessian)
    return Symbols(rho, S, D, nested=(m/rho)**2*(S**2).sum(axis=1), direct=2*m/rho*(slow@-f))


def _derivatives(weight, r: float) -> tuple[float, float, float]:
    """w, w'/r and w'' at r; w'' by a central difference, accurate to 1e-9."""
    step = 1e-5*weight.h
    after, before = ((r + d)*value_and_slope(weight, r + d)[1] for d in (step, -step))
    return *value_and_slope(weight, r), (after - before)/(2*step)


def waves(method: Spam, symbols: Symbols, e: float) -> np.ndarray:
    """Eigenvalues lambda of the linearised method, (k, 5); waves vary as exp(lambda t)."""
    rho, S, D, *_ = symbols
    k2 = symbols._asdict()[method.transport.symbol]
    eos, m, T = method.eos, method.m, temperature(method.eos, symbols.rho, e)
    P, (P_rho, P_e), d = pressure(eos, rho, e), pressure_slopes(eos, rho, e), 1e-6
    T_rho = (temperature(eos, rho + d, e) - temperature(eos, rho - d, e))/(2*d)
    T_e = (temperature(eos, rho, e + d) - temperature(eos, rho, e - d))/(2*d)
    # `LessStatic` subtracts the static pressure of a height, here of the one where it is nearest to P
    static, half = method.static, method.static.rho0*method.g*method.box[1]/2
    less = P - static.fraction*float(np.clip(P, static.P0 - abs(half), static.P0 + abs(half)))
    nu, chi = viscosity(method.law, rho, T)/rho, conductivity(method.law, rho, T)/rho
    A = np.zeros((len(S), 5, 5), complex)
    A[:, :2, 2:4] = np.eye(2)
    A[:, 2:4, :2] = -m**2*(P_rho/rho**2 - 2*less/rho**3)*S[:, :, None]*S[:, None, :] - 2*m*less/rho**2*D
    A[:, 2:4, 2:4] = -nu*k2[:, None, None]*np.eye(2)
    A[:, 2:4, 4] = 1j*m*P_e/rho**2*S
    A[:, 4, :2], A[:, 4, 2:4] = -1j*m*chi*T_rho*k2[:, None]*S, 1j*m*P/rho**2*S
    A[:, 4, 4] = -chi*T_e*k2
    return np.linalg.eigvals(A)


def largest_step(eigenvalues: np.ndarray) -> float:
    """The step at which a first eigenvalue leaves RK4's stability region; growing waves count as neutral."""
    decay, omega = np.maximum(-eigenvalues.real, 0), np.abs(eigenvalues.imag)
    size = np.hypot(decay, omega)
    return float(np.min(np.interp(np.arctan2(decay, omega), *_edge())/np.maximum(size, 1e-300)))


@cache
def _edge() -> tuple[np.ndarray, np.ndarray]:
    """Edge of RK4's stability region: angles from imaginary to negative real axis, and |lambda dt|."""
    angle, r = np.linspace(0, np.pi/2, 181), np.arange(1, 3200)*0.001
    z = 1j*r*np.exp(1j*angle[:, None])
    growth = abs(1 + z + z**2/2 + z**3/6 + z**4/24)
    return angle, r[np.argmax(growth > 1 + 1e-12, axis=1)] - 0.001
