"""Fluctuations about given flows that move, as cases: a shear flow and a uniform stream    [RR98 Eqs 20-25]

The shear flow is u = U sin(q y), q = 2 pi/period, at rho = T = 1, held by constant sources; for waves k >> q it is a uniform
shear of the rate U q cos(q y). The scheme that runs is linearised by differences, and so is its noise. Velocities across the flow
of waves along it are enhanced: the shear turns waves, and their vorticity stays with them [as in Lutsko & Dufty 1985].
"""
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.integrate import quad

from continuum.fluid import ConstEta, IdealGas
from particles.integral.covariance import jacobian, steady, waves
from particles.integral.edge_makers import MAKERS
from particles.integral.points import Points, jittered, lattice
from particles.integral.thermal import Agitated, Thermal
from particles.limits import limit_of
from particles.run import Plan
from particles.threads import Team
from particles.weights import Lucy
from studies.kit.case import Case, Outcome, Report
from studies.noise.fluctuations.flows import lap_symbol, slope_symbol, slopes_symbol
from studies.noise.fluctuations.matrices import states_of_fields
from studies.noise.fluctuations.modes import plane_waves
from studies.noise.fluctuations.sampling import BATCHES, batches, check_length, over


class Stream(NamedTuple):
    """The same velocity U along x everywhere."""
    U: float

    def velocity(self, points: Points) -> np.ndarray:
        """(n, 2)."""
        return np.tile([self.U, 0.0], (points.n, 1))


class Shear(NamedTuple):
    """U sin(q y) along x, one period over the box."""
    U: float

    def velocity(self, points: Points) -> np.ndarray:
        """(n, 2)."""
        u = self.U*np.sin(2*np.pi*points.x[:, 1]/points.box[1])
        return np.stack([u, 0*u], axis=1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Sustained(Thermal):
    """A fluid with fluctuations that constant sources hold about a `given` state (2 + d, n)."""
    given: np.ndarray

    def start(self, n: int, team: Team) -> "Held":
        return Held(self, team)

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}, {float(np.abs(self.given).sum())!r})"


class Held(Agitated):
    """Its rates: those of the flow less what they are at the given state."""

    def __init__(self, method: Sustained, team: Team):
        super().__init__(method, team)
        self.source = np.empty_like(method.given)
        super().rates(method.given, self.source)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        super().rates(state, out)
        out -= self.source


def kicked(sums: Agitated, state: np.ndarray) -> sparse.csr_array:
    """B (N, normals) of dx = J x dt + B dW about a state: what each random number W_A of the scheme that runs does to it."""
    drawn = [normals for normals in (sums.of_points, sums.of_edges) if normals is not None]
    for normals in drawn:
        normals[:] = 0
    columns, out = [], np.empty_like(state)
    for normals in drawn:
        for number in np.ndindex(len(normals), normals.shape[1]//2):
            normals[number] = 1
            sums.kicks(state, 0.0, 1.0, out)
            normals[number] = 0
            columns.append(sparse.csr_array(out.reshape(1, -1)))
    return sparse.csr_array(sparse.vstack(columns).T)


# --- waves along a shear flow, by Lyapunov solves ---------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Sheared(Case):
    """<v_y v_y> of waves along a shear flow on a periodic lattice, less and over equilibrium; k per spacing."""
    period: int
    U: float
    k: tuple[float, ...]
    eta: float = 0.02
    kappa: float = 0.02

    @property
    def cost(self) -> float:
        return 3e-7*self.period**3*(1 + len(self.k)/4) + 2e-2*self.period

    @property
    def label(self) -> str:
        return f"shear flow, period {self.period}, U {self.U:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        counts, ny = (5, self.period), self.period      # five columns hold the reach of the weight
        points, first = lattice(counts), np.arange(self.period)
        method = Thermal(edges=MAKERS["renormalised"](points, Lucy.of(h=2.0)), eos=IdealGas(),
                         law=ConstEta(self.eta, self.kappa), k=1.0, seed=1, share=1.0)
        v, one = Shear(self.U).velocity(points), np.ones(points.n)
        sums, state = method.start(points.n, Team(1)), method.dih.state(one, v, one)
        J, B = jacobian(sums.rates, state, first), kicked(sums, state)
        columns = (np.arange(4)[:, None]*points.n + first).ravel()
        Q = (B@B[columns].T).toarray()
        pick = np.concatenate([np.zeros(2*ny), np.ones(ny), np.zeros(ny)])/np.sqrt(ny)      # rho = 1, v_y = 0: p_y is v_y
        found = []
        for done, k in enumerate(self.k):
            report(done/len(self.k))
            C = steady(waves(J, counts, k), waves(Q, counts, k))
            found.append({"period": self.period, "U": self.U, "wavenumber": k, "extra": float((pick@C@pick).real) - 1,
                          "vortical": self.vortical(k), "second": self.second(k), "uniform": self.uniform(k)})
        return Outcome({"shear": found})

    @property
    def q(self) -> float:
        """Wave number of the flow."""
        return 2*np.pi/self.period

    def second(self, k: float) -> float:
        """To second order in U, without sound: U^2 q^2/[2 nu^2 (2 k^2 + q^2)(k^2 + q^2)]."""
        return self.U**2*self.q**2/(2*self.eta**2*(2*k**2 + self.q**2)*(k**2 + self.q**2))

    def vortical(self, k: float, most: int = 24) -> float:
        """To all orders in U, without sound: waves (k, n q), n to +-most, of velocities across their own gradient symbols,

        v' = -nu K^2 v - u d_x v - x v_y d_y u on what has no divergence, noise 2 nu K^2, by the symbols of the lattice.
        """
        n = np.arange(-most, most + 1)
        s = np.array([slopes_symbol(k, m*self.q) for m in n])
        t = s@np.array([[0.0, 1.0], [-1.0, 0.0]])/np.hypot(*s.T)[:, None]        # (-s_y, s_x)/|s|
        decay = np.array([self.eta*lap_symbol(k, m*self.q) for m in n])
        J = np.diag(-decay)
        for b in (-1, 1):       # sin q y = -sum b exp(i b q y) i/2
            to, of = (n + b + most)[abs(n + b) <= most], (n + most)[abs(n + b) <= most]
            J[to, of] -= self.U/2*(b*s[of, 0]*(t[to]*t[of]).sum(axis=1) + slope_symbol(self.q)*t[to, 0]*t[of, 1])
        return float(steady(J, np.diag(2*decay))[most, most]) - 1

    def uniform(self, k: float) -> float:
        """Mean over y of that of a uniform shear g = U q cos(q y): 2 g^2 int s exp[-2 nu k^2 (s + g^2 s^3/3)] ds, k >> q."""
        decay = self.eta*lap_symbol(k, 0.0)

        def at(angle: float) -> float:
            g = self.U*self.q*np.cos(angle)*slope_symbol(k)/k/decay      # s in 1/decay
            return 2*g*g*quad(lambda s: s*np.exp(-2*(s + g*g*s**3/3)), 0, np.inf)[0]
        return float(np.mean([at(angle) for angle in 2*np.pi*np.arange(32)/32]))


# --- samples of the full equations about a given flow ------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class About(Case):
    """Plane waves of rho, v and T in the full equations about a given flow, jittered points, Delaunay edges: their variances over
    those of the Lyapunov solve.

    k : Boltzmann's, small, so that fluctuations are linear. time : of a batch.
    """
    flow: Stream | Shear
    counts: tuple[int, int]
    turns: tuple[tuple[int, int], ...]
    time: float
    share: float = 0.1
    k: float = 1e-5
    eta: float = 0.2
    kappa: float = 0.4
    of_limit: float = 0.6
    batches: int = BATCHES
    seed: int = 1

    @property
    def cost(self) -> float:
        return self.batches*self.time/0.15*4e-3

    @property
    def label(self) -> str:
        return f"samples about {type(self.flow).__name__} {self.flow.U:g}"

    @cached_property
    def points(self) -> Points:
        return jittered(self.counts, 0.2, self.seed)

    def run(self, report: Report, folder: Path) -> Outcome:
        edges, one = MAKERS["delaunay"](self.points, None), np.ones(self.points.n)
        fluid: dict[str, Any] = {"edges": edges, "eos": IdealGas(), "law": ConstEta(self.eta, self.kappa), "k": self.k,
                                 "seed": self.seed, "share": self.share}
        v = self.flow.velocity(self.points)
        given = Thermal(**fluid).dih.state(one, v, one)
        method = Sustained(**fluid, given=given)
        sums = method.start(edges.n, Team(1))
        J, B = jacobian(sums.rates, given), kicked(sums, given)
        check_length(J, self.time)
        C = steady(J, (B@B.T).toarray(), np.kron(np.eye(4), edges.V))
        names, F = plane_waves(self.points, edges.V, self.turns)
        of_fields = F@states_of_fields(0*v)     # plane_waves takes T from eps - rho, of a gas at rest
        F = of_fields@np.linalg.inv(states_of_fields(v))
        exact = np.einsum("mi,ij,mj->m", F, C, F)
        dt = self.of_limit*limit_of(method, given)
        steps = int(np.ceil(self.time/dt/5))*5
        plan = Plan(dt=dt, steps=steps, every=5, means={"modes": lambda sums, state: (F@(state - given).ravel())**2})
        legs = batches(method, given, plan, report, self.batches + 1)[1:]       # the first one forgets the start
        powers = np.array([leg.means["modes"] for leg in legs])/exact
        rest = self.k*of_fields**2@np.tile(1/edges.V, 4)
        rows = []
        for (field, turns, phase), power, due, still in zip(names, powers.T, exact, rest, strict=True):
            found = over(power)
            rows.append({"flow": type(self.flow).__name__, "U": self.flow.U, "field": field, "turns_x": turns[0],
                         "turns_y": turns[1], "phase": phase, "exact": due/still, "ratio": found.value, "ratio_err": found.err})
        return Outcome({"flows": rows})
