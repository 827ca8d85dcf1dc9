"""Sampled plane waves of a gas at rest, as cases: their variances against equilibrium, k = 1    [RR98 Eqs 20-25]"""
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy import sparse

from continuum.fluid import ConstEta, IdealGas
from particles.integral.covariance import jacobian
from particles.integral.dih import Dih, Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.points import Points
from particles.run import Plan
from particles.weights import Lucy
from studies.build.disorder import DISORDERS, Disorder
from studies.kit.case import Case, Outcome, Report
from studies.kit.stats import over_seeds
from studies.noise.fluctuations.matrices import ETA, KAPPA, ZETA, equilibrium, factor, noise, transport
from studies.noise.fluctuations.sampling import BATCHES, Linear, batches, check_length

#: of the tables, by dimension
TABLE, AXES = {2: "modes", 3: "cubes"}, ("turns_x", "turns_y", "turns_z")


@dataclass(frozen=True, kw_only=True)
class Equipartition(Case):
    """Variances of plane waves of rho, v and T in a gas at rest on points of 2D or 3D, over their exact values.

    turns : wave vectors, whole waves along each axis; each has a cosine and a sine.
    """
    counts: tuple[int, ...]
    turns: tuple[tuple[int, ...], ...]
    share: float
    steps: int
    dt: float = 1.0
    maker: str = "delaunay"
    disorder: Disorder = DISORDERS["jittered-0.3"]
    h: float = 2.0
    seed: int = 1

    @property
    def d(self) -> int:
        """Dimension."""
        return len(self.counts)

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1e-9*((2 + self.d)*np.prod(self.counts))**2*1.5 + 10

    @property
    def label(self) -> str:
        return f"equipartition {self.disorder.name} {self.counts}, share {self.share:g}"

    @cached_property
    def points(self) -> Points:
        return self.disorder.make(self.counts, self.disorder.size, self.seed)

    def run(self, report: Report, folder: Path) -> Outcome:
        d, edges = self.d, MAKERS[self.maker](self.points, Lucy.of(h=self.h, d=self.d))
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, transport=Mixed(share=self.share))
        J = jacobian(dih.rates, dih.state(np.ones(edges.n), np.zeros((edges.n, d)), np.ones(edges.n)))
        C = equilibrium(edges.V, d)
        names, F = plane_waves(self.points, edges.V, self.turns)
        parts = transport(edges, self.share, ETA, ZETA, KAPPA, 1.0)
        check_modes(F, C, noise(edges.V, *(part.Q for part in parts)), names)
        F /= np.sqrt(np.einsum("mi,ij,mj->m", F, C, F))[:, None]
        method = Linear(J=J, B=factor(edges, *parts), seed=self.seed, modes=F, names=dih.names)
        check_length(J, self.steps*self.dt)
        start = np.random.default_rng(self.seed).normal(size=(2 + d, edges.n))/np.sqrt(edges.V)    # rho, v, T of equilibrium
        start[-1] += start[0]
        start -= (start@edges.V/edges.V.sum())[:, None]
        plan = Plan(dt=self.dt, steps=self.steps, every=1, means={"modes": lambda sums, state: sums.found**2,
                                                                  "all": lambda sums, state: whole(edges.V, state)})
        legs = batches(method, start, plan, report)
        powers, total = np.array([leg.means["modes"] for leg in legs]), over_seeds(np.array([leg.means["all"] for leg in legs]))
        key = {"points": self.disorder.name, "share": self.share}
        rows = [{**key, "field": "all", **dict.fromkeys(AXES[:d], 0), "phase": "-", "wavenumber": np.nan, "ratio": total.value,
                 "ratio_err": total.err}]
        for (field, turns, phase), power in zip(names, powers.T, strict=True):
            found, k = over_seeds(power), 2*np.pi*np.linalg.norm(np.array(turns)/self.counts)
            rows.append({**key, "field": field, **dict(zip(AXES, turns)), "phase": phase, "wavenumber": float(k),
                         "ratio": found.value, "ratio_err": found.err})
        return Outcome({TABLE[d]: rows})


def whole(V: np.ndarray, state: np.ndarray) -> float:
    """Mean over all degrees of freedom but the conserved sums of what is 1 in equilibrium."""
    rho, eps = state[0], state[-1]
    return float(V@((state[:-1]**2).sum(axis=0) + (eps - rho)**2)/(len(state)*(len(V) - 1)))


def plane_waves(points: Points, V: np.ndarray, turns: tuple[tuple[int, ...], ...]) -> tuple[list[tuple], np.ndarray]:
    """(field, turns, phase) and rows (m, (2 + d) n) of cosines and sines of rho, v and T = eps - rho."""
    names, rows, none = [], [], np.zeros(len(V))
    for m in turns:
        k = 2*np.pi*np.array(m)/points.box
        for phase, wave in (("cos", V*np.cos(points.x@k)), ("sin", V*np.sin(points.x@k))):
            for field, direction in directions(k).items():
                names.append((field, m, phase))
                rows.append(np.concatenate([none, *(q*wave for q in direction), none]))
            for field, of_rho, of_eps in (("rho", 1, 0), ("T", -1, 1)):
                names.append((field, m, phase))
                rows.append(np.concatenate([of_rho*wave, *[none]*points.d, of_eps*wave]))
    return names, np.array(rows)


def directions(k: np.ndarray) -> dict[str, np.ndarray]:
    """Velocities by name: along the axes of a plane, along and across k in space."""
    if len(k) == 2:
        return {"u": np.array([1.0, 0.0]), "v": np.array([0.0, 1.0])}
    frame = np.linalg.qr(np.column_stack([k if k.any() else np.eye(3)[0], np.eye(3)[np.argsort(np.abs(k))[:2]].T]))[0]
    return dict(zip(("along", "across", "across 2"), frame.T, strict=True))


def check_modes(F: np.ndarray, C: np.ndarray, Q: sparse.csr_array, names: list[tuple]) -> None:
    """Refuse a list of modes that are all conserved, or that no noise reaches and nothing damps.

    Raises
    ------
    ValueError
        There is no mode in the list that relaxes.
    """
    size = (F**2).sum(axis=1).max(initial=0)        # a sine may be zero at every point, to round-off
    moves = np.einsum("mi,ij,mj->m", F, C, F) > 1e-12*size*np.diag(C).max()
    driven = np.einsum("mi,mi->m", F, (Q@F.T).T) > 1e-12*size*Q.diagonal().max()
    if not len(F) or not (moves & driven).any():
        raise ValueError(f"all {len(F)} modes in the list are null modes ({'; '.join(map(str, names[:4]))} ...): they are "
                         "conserved, or nothing drives and damps them, so samples say nothing; take waves that are no "
                         "corner of the zone, or a share of transport along edges")
