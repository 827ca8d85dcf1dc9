"""Sampled plane waves of a gas at rest, as cases: their variances against equilibrium, k = 1    [RR98 Eqs 20-25]"""
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy import sparse

from continuum.fluid import ConstEta, IdealGas
from particles.covariance import jacobian
from particles.edges import Edges
from particles.makers import MAKERS
from particles.methods.dih import Dih
from particles.methods.fluctuating import Partners
from particles.methods.thermal import Mixed
from particles.points import Points, jittered
from particles.run import Plan
from studies.fluctuating.fluct_flows import ETA, KAPPA, ZETA, equilibrium, noise, transport
from studies.fluctuating.fluct_sampling import BATCHES, Linear, batches, check_length, over
from studies.kit.case import Case, Outcome, Report


@dataclass(frozen=True, kw_only=True)
class Equipartition(Case):
    """Variances of plane waves of rho, v and T in a gas at rest on irregular points, over their exact values.

    turns : wave vectors, whole waves along x and y; each has a cosine and a sine.
    """
    counts: tuple[int, int]
    turns: tuple[tuple[int, int], ...]
    share: float
    steps: int
    dt: float = 1.0
    seed: int = 1

    @property
    def cost(self) -> float:
        return BATCHES*self.steps*1e-9*(4*np.prod(self.counts))**2*1.5 + 10

    @property
    def label(self) -> str:
        return f"equipartition {self.counts}, share {self.share:g}"

    @cached_property
    def points(self) -> Points:
        return jittered(self.counts, 0.3, self.seed)

    def run(self, report: Report, folder: Path) -> Outcome:
        edges = MAKERS["delaunay"](self.points, None)
        dih = Dih(edges=edges, eos=IdealGas(), law=ConstEta(ETA, KAPPA), zeta=ZETA, transport=Mixed(share=self.share))
        J = jacobian(dih.rates, dih.state(np.ones(edges.n), np.zeros((edges.n, 2)), np.ones(edges.n)))
        C = equilibrium(edges.V, 2)
        names, F = plane_waves(self.points, edges.V, self.turns)
        parts = transport(edges, self.share, ETA, ZETA, KAPPA, 1.0)
        check_modes(F, C, noise(edges.V, *(part.Q for part in parts)), names)
        F /= np.sqrt(np.einsum("mi,ij,mj->m", F, C, F))[:, None]
        method = Linear(J=J, B=factor(edges, *parts), seed=self.seed, modes=F, fields=("rho", "px", "py", "eps"))
        check_length(J, self.steps*self.dt)
        start = np.random.default_rng(self.seed).normal(size=(4, edges.n))/np.sqrt(edges.V)        # rho, v, T of equilibrium
        start[3] += start[0]
        start -= (start@edges.V/edges.V.sum())[:, None]
        plan = Plan(dt=self.dt, steps=self.steps, every=1, means={"modes": lambda sums, state: sums.found**2,
                                                                  "all": lambda sums, state: whole(edges.V, state)})
        legs = batches(method, start, plan, report)
        powers, total = np.array([leg.means["modes"] for leg in legs]), over(np.array([leg.means["all"] for leg in legs]))
        key = {"points": "jittered-0.3", "share": self.share}
        rows = [{**key, "field": "all", "turns_x": 0, "turns_y": 0, "phase": "-", "wavenumber": np.nan, "ratio": total.value,
                 "ratio_err": total.err}]
        for (field, m, n, phase), power in zip(names, powers.T, strict=True):
            found, k = over(power), 2*np.pi*np.hypot(m/self.counts[0], n/self.counts[1])
            rows.append({**key, "field": field, "turns_x": m, "turns_y": n, "phase": phase, "wavenumber": k,
                         "ratio": found.value, "ratio_err": found.err})
        return Outcome({"modes": rows})


def whole(V: np.ndarray, state: np.ndarray) -> float:
    """Mean over all degrees of freedom but the conserved sums of what is 1 in equilibrium."""
    rho, px, py, eps = state
    return float(V@(rho**2 + px**2 + py**2 + (eps - rho)**2)/(4*(len(V) - 1)))


def factor(edges: Edges, stress: Partners, heat: Partners) -> sparse.csr_array:
    """B of a state of densities (rho, p, eps) from that of momenta and energies."""
    per = sparse.diags_array(np.tile(1/edges.V, edges.d + 1))
    below = per@sparse.block_diag([stress.B, heat.B])
    return sparse.csr_array(sparse.vstack([sparse.csr_array((edges.n, below.shape[1])), below]))


def plane_waves(points: Points, V: np.ndarray, turns: tuple[tuple[int, int], ...]) -> tuple[list[tuple], np.ndarray]:
    """(field, turns, phase) and rows (m, 4 n) of cosines and sines of rho, u, v and T = eps - rho."""
    names, rows, none = [], [], np.zeros(len(V))
    for m, n in turns:
        at = points.x@(2*np.pi*np.array([m, n])/points.box)
        for phase, wave in (("cos", V*np.cos(at)), ("sin", V*np.sin(at))):
            names += [(field, m, n, phase) for field in ("rho", "u", "v", "T")]
            rows += [np.concatenate(parts) for parts in ((wave, none, none, none), (none, wave, none, none),
                                                         (none, none, wave, none), (-wave, none, none, wave))]
    return names, np.array(rows)


def check_modes(F: np.ndarray, C: np.ndarray, Q: sparse.csr_array, names: list[tuple]) -> None:
    """Refuse a list of modes that are all conserved, or that no noise reaches and nothing damps.

    Raises
    ------
    ValueError
        There is no mode in the list that relaxes.
    """
    n = C.shape[0]//4
    size = (F**2).sum(axis=1).max(initial=0)        # a sine may be zero at every point, to round-off
    moves = np.einsum("mi,ij,mj->m", F, C, F) > 1e-12*size*np.diag(C).max()
    driven = np.einsum("mi,mi->m", F[:, n:], (Q[n:, n:]@F[:, n:].T).T) > 1e-12*size*Q.diagonal().max()
    if not len(F) or not (moves & driven).any():
        raise ValueError(f"all {len(F)} modes in the list are null modes ({'; '.join(map(str, names[:4]))} ...): they are "
                         "conserved, or nothing drives and damps them, so samples say nothing; take waves that are no "
                         "corner of the zone, or a share of transport along edges")
