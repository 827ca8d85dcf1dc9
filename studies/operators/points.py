"""What edges lose, let grow and produce: momentum, sound, entropy    [RR98 Eqs 13, 34-38, 51]

An edge that takes momentum f and energy e from i to j heats i by -(e - v_i.f) and j by e - v_j.f, so

    dS/dt = sum over edges [(e - v_j.f)/T_j - (e - v_i.f)/T_i]

Flow without friction over closed edges, which brings F of q = (rho, rho v, eps) to i and -F to j, has

    dS/dt = sum over edges [(w_i - w_j).F + S.(rho_j v_j - rho_i v_i)],  w = d(rho s)/dq   [Tadmor 1987]

Forces F along edges that heat by their work have F.(v_j - v_i)(1/T_i + 1/T_j)/2 + kappa k (T_j - T_i)^2
/(T_i T_j), never negative. The continuum has sigma : grad v/T + kappa (grad T)^2/T^2 at each place.
"""
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, ClassVar

import numpy as np
from scipy.optimize import Bounds, minimize

from continuum.fluid import ConstEta, IdealGas, stress_tensor
from continuum.scene import RayleighBenard
from particles.integral.dih import Dih, NestedFluxes, Pairwise
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.entropy_fluxes import Dissipation, Logarithmic, MeanPressure
from particles.integral.entropy_stable import StableLayer, StableSums
from particles.integral.exchange import Convection, Listing, Pressure
from particles.integral.points import Points, lattice
from particles.pairs import Faces, sweep
from particles.threads import Threads
from particles.weights import WendlandC2
from studies.build.fixed import SCHEMES, fluid
from studies.build.setting import Disorder, jacobian
from studies.kit.case import Case, Report
from studies.kit.table import Row
from studies.operators.equations import ALONG, ETA, KAPPA, Spectral, smooth_flow

VISCOSITIES = (0.0, 0.1)    # in rho c a


class PointSet(Case, same="maker points d seed"):
    """Base of measurements on the edges of one set of points.

    maker : one of `particles.integral.edge_makers.MAKERS`. h : range of the weight, in spacings.
    """
    maker: Callable[[Points, Any], Edges]
    points: Disorder
    counts: tuple[int, ...]
    h: float
    seed: int = 1

    weight: ClassVar[Any] = WendlandC2

    @property
    def d(self) -> int:
        return len(self.counts)

    def measure(self, report: Report) -> Iterator[Row]:
        points = self.points.make(self.counts, self.points.size, self.seed)
        return self.rows_of(points, self.maker(points, self.weight.of(h=self.h, d=self.d)))

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        """The rows measured on these points and edges."""
        raise NotImplementedError


class OneKernel(PointSet, table="one_kernel"):
    """Momentum lost if the pressure has the one kernel P(rho(r), T(r')), not both    [RR98 Eqs 13, 14]

    P = rho T, rho and T random: i gets -S P_ij/2, j gets S P_ji/2. lost : over the sum of sizes.
    """

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        rho, T = np.random.default_rng(self.seed).uniform(0.5, 1.5, (2, edges.n))
        i, j = edges.i, edges.j
        there, back = edges.S.T*rho[i]*T[j], edges.S.T*rho[j]*T[i]
        lost = np.abs((back - there).sum(axis=1))
        size = (np.abs(there) + np.abs(back)).sum(axis=1)
        yield {"lost": lost.max()/size.max()}


class SoundGrowth(PointSet, table="growth"):
    """Largest growth rate of sound in a fluid at rest."""

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        closure = np.abs(edges.closure/edges.V[:, None]).max()
        for eta in VISCOSITIES:
            rate = np.linalg.eigvals(sound(edges, eta)).real.max()
            yield {"viscosity": eta, "rate": rate, "closure": closure}


def sound(edges: Edges, eta: float = 0.0) -> np.ndarray:
    """Matrix of rates of sqrt(V) (P'/c, p) in a fluid at rest; rho = c = 1, friction eta lap v.

    V P'_t = -c^2 D.p and V p_t = -D P': antisymmetric if D = -D^T, that is, where edges close.
    """
    n, d, root = edges.n, edges.d, 1/np.sqrt(edges.V)
    A = np.zeros(((d + 1)*n,)*2)
    friction = eta*root[:, None]*edges.laplacian.toarray()*root
    for a, D in enumerate(edges.D, start=1):
        p = slice(a*n, (a + 1)*n)
        scaled = root[:, None]*D.toarray()*root
        A[:n, p] = A[p, :n] = -scaled
        A[p, p] = friction
    return A


class LayerGrowth(Case, table="nested_growth", same="h rows ra share"):
    """Growth rate (in c/a) of the fastest growing disturbance of a motionless layer; h in spacings.

    share : of transport along edges [Eq. 51]; the rest is nested [Eqs 37, 38].
    """
    h: float
    rows: int
    ra: float
    share: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def measure(self, report: Report) -> Iterator[Row]:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows), aspect=1.0)
        method = fluid(scene, SCHEMES["fixed-lattice"]._replace(h=self.h, share=self.share))
        y, c = method.x[:, 1], np.sqrt(2*scene.T_mean)
        state = method.state(1.0, np.zeros_like(method.x), scene.T(y))
        sums = method.start(len(y), Threads(1))
        growth = np.linalg.eigvals(jacobian(sums.rates, state)).real.max()
        yield {"growth": growth/c}


State = tuple[np.ndarray, np.ndarray, np.ndarray]       # rho (n,), v (n, 2), T (n,)
#: state -> entropy production of each edge (E,), and the size of the terms that cancel in it (E,)
Producer = Callable[[State], tuple[np.ndarray, np.ndarray]]
#: ways of transport by name
WAYS = {"along edges": ALONG, "along edges, mended": Pairwise(), "nested": NestedFluxes()}
GAS = IdealGas()
FLOWS = {"brackets": (Convection(), Pressure(GAS)), "crossed pressure": (Logarithmic(GAS), Pressure(GAS)),
         "mean pressure": (Logarithmic(GAS), MeanPressure(GAS)), "dissipation": (Dissipation(GAS),)}
ROUNDING = 1e-12        # destroyed entropy over the terms that cancel in it: below this it is round-off
DRAWS, STEPS = 200, 60  # number of random states; steps of a search
SPREAD, WIDEST, FAST = 0.5, np.log(3), 1.0      # rms ln T of random states; most |ln T|, |v| of sought ones


def produced(dih: Dih, state: State) -> tuple[np.ndarray, np.ndarray]:
    """Entropy production of each edge by stress and heat current, (E,), and its size."""
    edges, flow = dih.edges, dih.flow(dih.state(*state))
    (_, f, e), (v, T), i, j = dih.transport.fluxes(dih, flow), flow[1:3], edges.i, edges.j
    q = ((v[i]*f).sum(axis=1) - e)/T[i] + (e - (v[j]*f).sum(axis=1))/T[j]
    return q, np.abs(q)


def of_flow(sums: StableSums, terms: tuple, state: State) -> tuple[np.ndarray, np.ndarray]:
    """The same by listed terms of a flow, without images; pressures are not relative to a point's own."""
    method, edges = sums.method, sums.at.edges
    sums.look_at(method.state(*state))
    row, near = np.repeat(np.arange(sums.n), edges.taken), edges.near.astype(int)
    each = np.flatnonzero(row < near)
    i, j, count = row[each], near[each], len(each)
    points, alone = sums.points[np.concatenate([i, j])], np.arange(count)
    carries = not isinstance(terms[0], Dissipation)
    if carries:
        points["P"] = 0.0
    along = (getattr(edges, name)[each] for name in ("sx", "sy", "k", "dx", "dy"))
    gain = np.empty((count, 4))
    sweep(0, count, Listing(terms), points,
          Faces(alone.astype(edges.first.dtype), np.ones(count, edges.taken.dtype),
                (alone + count).astype(edges.near.dtype), *along), gain)
    rho, v, T = state
    of_rho = GAS.cv*(np.log(T) - 1) - np.log(rho) - 1 + (v**2).sum(axis=1)/(2*T)
    w = np.stack([of_rho, *(-v.T/T), 1/T], axis=1)
    S, p = 2*np.stack([edges.sx[each], edges.sy[each]], axis=1), rho[:, None]*v
    parts = (w[i] - w[j])*gain, carries*S*(p[j] - p[i])
    return sum(part.sum(axis=1) for part in parts), sum(np.abs(part).sum(axis=1) for part in parts)


def producer(way: str, points: Points, edges: Edges) -> Producer:
    """Function that gives the entropy production of a way of transport, or of the terms of a flow."""
    law = ConstEta(ETA, KAPPA)
    if way in WAYS:
        return partial(produced, Dih(edges=edges, eos=GAS, law=law, transport=WAYS[way]))
    layer = StableLayer(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=GAS, law=law, g=0.0,
                        T_plates=(1.0, 1.0), flow=FLOWS[way])
    return partial(of_flow, layer.start(points.n, Threads(1)), FLOWS[way])


def smooth(x: np.ndarray) -> State:
    """State with one wave along each axis of the unit box, T from 0.2 to 1.8."""
    rho, v, T = smooth_flow(x)
    return rho, v, 1 + 8*(T - 1)


def continuum() -> float:
    """Entropy production of that state in the continuum, zeta = 0; in 2D the size of the box drops out."""
    exact, (_, v, T) = Spectral((64, 64)), smooth(lattice((64, 64), 1/64).x)
    slope = exact.grad(v)
    friction = (stress_tensor(ETA*np.ones_like(T), 0*T, slope)*slope).sum(axis=(1, 2))
    return float(np.mean(friction/T + KAPPA*(exact.grad(T)**2).sum(axis=1)/T**2))


class Entropy(PointSet, table="entropy", same=f"{PointSet.same} transport state"):
    """Entropy production in a smooth state, in random ones, or in the worst one that a descent finds."""
    transport: str
    state: str

    cost = 3.0

    def rows_of(self, points: Points, edges: Edges) -> Iterator[Row]:
        made = producer(self.transport, points, edges)
        every, size = np.array([made(state) for state in self.states(made, points)]).swapaxes(0, 1)
        sums = every.sum(axis=1)
        yield {"cells": self.counts[0],
               "total": sums[0]/continuum() if self.state == "smooth" else np.nan,
               "least": (sums/size.sum(axis=1)).min(), "negative": np.mean(every < -ROUNDING*size)}

    def states(self, made: Producer, points: Points) -> Iterator[State]:
        """One smooth state, DRAWS random ones, or one that a descent from a random one finds."""
        n, rng = points.n, np.random.default_rng(self.seed)
        if self.state == "smooth":
            yield smooth(points.x/points.box)
        elif self.state == "sought":
            yield worst(made, np.repeat([WIDEST, FAST, FAST], n), rng)
        else:
            for _ in range(DRAWS):
                yield rng.uniform(0.5, 1.5, n), rng.normal(0, 0.3, (n, 2)), np.exp(rng.normal(0, SPREAD, n))


def worst(made: Producer, bounds: np.ndarray, rng: np.random.Generator) -> State:
    """State of density 1 with least entropy production over its size, by a descent over ln T and v."""
    def unpacked(fields: np.ndarray) -> State:
        log_T, *v = fields.reshape(3, -1)
        return np.ones_like(log_T), np.stack(v, axis=1), np.exp(log_T)

    def share(fields: np.ndarray) -> float:
        q, size = made(unpacked(fields))
        return float(q.sum()/size.sum())
    search: Any = minimize      # scipy's types lack options of one method
    found = search(share, rng.uniform(-bounds, bounds), bounds=Bounds(-bounds, bounds),
                   options={"maxiter": STEPS})
    return unpacked(found.x)
