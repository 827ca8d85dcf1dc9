"""What grows at rest, and the step of forward Euler: from eigenvalues of the linearised scheme    [RR98 Eqs 34-40, 51]"""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.scene import RayleighBenard
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edge_makers import renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.threads import Team
from particles.weights import WendlandC2
from studies.build.disorder import Disorder
from studies.build.fixed import SCHEMES, fluid
from studies.kit.case import Case, Outcome, Report

STEP = 1e-4     # of central differences: rates are cubic, so errors are 1e-8 of them, round-off 1e-12
#: d -> points, range of the weight
BOXES: dict[int, tuple[tuple[int, ...], float]] = {1: ((40,), 3.0), 2: ((10, 10), 3.0), 3: ((6, 6, 6), 2.0)}
NULL = 1e-6     # rates that small belong to waves that the operators do not see


def sound(edges: Edges, eta: float = 0.0) -> np.ndarray:
    """Matrix of d/dt (P'/c, p) in a fluid at rest, times sqrt(V); rho = c = 1, friction eta lap v (in 2D that of zeta = 0).

    V P'_t = -c^2 D.p and V p_t = -D P': antisymmetric if D = -D^T, so where edges close.
    """
    n, d, root = edges.n, edges.d, 1/np.sqrt(edges.V)
    A = np.zeros(((d + 1)*n,)*2)
    friction = eta*root[:, None]*edges.laplacian.toarray()*root
    for a, D in enumerate(edges.D):
        p, scaled = slice((a + 1)*n, (a + 2)*n), root[:, None]*D.toarray()*root
        A[:n, p] = A[p, :n] = -scaled
        A[p, p] = friction
    return A


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """Largest growth rate of sound at rest on 40, 10 x 10 or 6 x 6 x 6 points; not a number where no edges of the kind exist."""
    maker: str
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    viscosities: tuple[float, ...]
    seed: int = 1
    d: int = 2

    @property
    def cost(self) -> float:
        return (0.1, 0.3, 3.0)[self.d - 1]*len(self.viscosities)

    def run(self, report: Report, folder: Path) -> Outcome:
        key = {"maker": self.maker, "points": self.disorder.name, "d": self.d, "seed": self.seed}
        counts, h = BOXES[self.d]
        at = self.disorder.make(counts, self.disorder.size, self.seed)
        try:
            edges = self.make(at, WendlandC2.of(h=h, d=self.d))
        except ArithmeticError:     # no such edges exist on these points: that is a result
            nothing = {"rate": np.nan, "closure": np.nan}
            return Outcome({"growth": [{**key, "viscosity": eta, **nothing} for eta in self.viscosities]})
        closure = float(np.abs(edges.closure/edges.V[:, None]).max())
        return Outcome({"growth": [{**key, "viscosity": eta, "rate": fastest(sound(edges, eta)),
                                    "closure": closure}
                                   for eta in self.viscosities]})


def fastest(A: np.ndarray) -> float:
    """Growth rate of the fastest growing solution of y' = A y."""
    return float(np.linalg.eigvals(A).real.max())


def response(dih: Dih, x: np.ndarray, k: float) -> np.ndarray:
    """The matrix (2 + d, 2 + d) by which the linearised scheme multiplies amplitudes of exp(ikx) at rest, rho = T = 1."""
    n, d = x.shape
    rest = dih.state(np.ones(n), np.zeros((n, d)), np.ones(n))
    wave = np.exp(1j*k*x[:, 0])
    matrix = np.empty((d + 2, d + 2), complex)
    for row in range(d + 2):
        real, imaginary = (linear_rate(dih, rest, row, part) for part in (wave.real, wave.imag))
        matrix[:, row] = ((real + 1j*imaginary)/wave).mean(axis=1)
    return matrix


def linear_rate(dih: Dih, rest: np.ndarray, row: int, shape: np.ndarray) -> np.ndarray:
    """Derivative of the rates along one row of the state."""
    rates = []
    for sign in (1, -1):
        state, out = rest.copy(), np.empty_like(rest)
        state[row] += sign*STEP*shape
        dih.rates(state, out)
        rates.append(out)
    return (rates[0] - rates[1])/(2*STEP)


def jacobian(sums: Any, state: np.ndarray, step: float = 1e-6) -> np.ndarray:
    """d rates/d state of a compiled scheme by central differences, (size, size); fields are of order 1."""
    J, out = np.empty((state.size, state.size)), np.empty((2, *state.shape))
    for column in range(state.size):
        for side, sign in enumerate((1, -1)):
            moved = state.copy()
            moved.ravel()[column] += sign*step
            sums.rates(moved, out[side])
        J[:, column] = ((out[0] - out[1])/(2*step)).ravel()
    return J


def euler_limit(eigenvalues: np.ndarray) -> float:
    """The largest dt with |1 + lambda dt| <= 1 for all that are no null modes; 0 if one grows by itself."""
    seen = eigenvalues[np.abs(eigenvalues) > NULL]
    return float(np.min(np.maximum(-2*seen.real/np.abs(seen)**2, 0), initial=np.inf))


@dataclass(frozen=True, kw_only=True)
class Euler(Case):
    """Largest stable step of Eq. 40 in the 2D gas, wave by wave on a lattice, transport nested or pairwise."""
    transport: NestedFluxes | Pairwise
    eta: float
    zeta: float
    kappa: float
    rows: int = 32

    def run(self, report: Report, folder: Path) -> Outcome:
        at = lattice((self.rows, 8))
        dih = Dih(edges=renormalised(at, WendlandC2.of(h=3.0)), eos=IdealGas(),
                  law=ConstEta(self.eta, self.kappa),
                  zeta=self.zeta, transport=self.transport)
        c2 = 2.0                        # gamma P/rho
        key = {"transport": type(self.transport).__name__.lower(), "eta": self.eta, "zeta": self.zeta,
               "kappa": self.kappa,
               "predicted": (self.eta + self.zeta + self.kappa/2)/c2}
        rows = []
        for mode in range(1, self.rows//2 + 1):
            k = 2*np.pi*mode/self.rows
            limit = euler_limit(np.linalg.eigvals(response(dih, at.x, k)))
            rows.append({**key, "mode": mode, "k": k, "limit": limit})
        return Outcome({"euler": rows})


# --- the layer between plates -------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class LayerGrowth(Case):
    """The fastest growing disturbance of a motionless layer between plates; `h` in spacings, rates in c/a.

    share : of transport along edges [Eq. 51], the rest is nested [Eqs 37, 38].
    """
    h: float
    rows: int
    ra: float
    share: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows), aspect=1.0)
        method = fluid(scene, SCHEMES["fixed-lattice"]._replace(h=self.h, share=self.share))
        y = method.x[:, 1]
        state = method.state(1.0, np.zeros_like(method.x), scene.T(y))
        values, vectors = np.linalg.eig(jacobian(method.start(len(y), Team(1)), state))
        worst = int(np.argmax(values.real))
        c = np.sqrt(2*scene.T_mean)
        return Outcome({"nested_growth": [{
            "h": self.h, "rows": self.rows, "ra": self.ra, "share": self.share,
            "growth": values[worst].real/c, "frequency": abs(values[worst].imag)/c,
            "nyquist": zigzag(vectors[:, worst], self.rows), "diffusion": scene.k/scene.L**2/c}]})


def zigzag(vector: np.ndarray, rows: int) -> float:
    """Share of a disturbance's square that is in waves shorter than three spacings along x or y."""
    power = np.abs(np.fft.fft2(vector.reshape(4, rows, rows)))**2
    k = np.abs(np.fft.fftfreq(rows))
    short = (k[:, None] > 1/3) | (k[None] > 1/3)
    return float(power[:, short].sum()/power.sum())
