"""Sod's shock tube by name of method: points and step, and what fields it has in cells of one spacing.

The tube and its mirror image of `shock_tube`, in a periodic strip; the grid has one tube between plates, which its waves do not
reach. One spacing, in both gases: the thin one has points of less mass. No method has artificial viscosity.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta
from continuum.gas.fields import Fields, Values, block, nodes, unblock
from continuum.gas.loop import FluxForm
from continuum.gas.solve import DivergedError, March, limits
from particles.integral.closed_faces import Moving
from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.layer import Layer
from particles.integral.points import Points, jittered
from particles.integral.triangulation import delaunay
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.names import START_JITTER
from studies.build.scenes import Slab
from studies.hardcases.tube.spam import DENSE, END, EOS, HEIGHT, THIN
from studies.kit.case import Report

JITTER = 0.3            # of disordered points, in spacings
PARTS = 16              # of a point, over which it is spread when it is put into cells


class Seen(NamedTuple):
    """rho, v, P (3, n) in cells of one spacing, 0 < x < 2 L; rms v across the tube; which part of the time was reached."""
    fields: np.ndarray
    across: float
    reached: float = 1.0


def ended(L: int, reached: float) -> Seen:
    """Nothing but when."""
    return Seen(np.full((3, 2*L), np.nan), np.nan, reached)


def gases(L: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """rho and T (n,) at the start, of both tubes."""
    dense = np.abs(x) < L
    return np.where(dense, DENSE.rho, THIN.rho), np.where(dense, DENSE.P/DENSE.rho, THIN.P/THIN.rho)


def binned(L: int, x: np.ndarray, V: np.ndarray, sums: np.ndarray) -> np.ndarray:
    """(3, 2 L) of points x (n,), V (n,), by volume; sums (4, n): mass, momenta, energy. Means over height and both tubes.

    A point is as wide as its volume and one spacing high: where the gas is thin rows of points lie farther apart than cells.
    """
    x = (x + V*((np.arange(PARTS) + 0.5)/PARTS - 0.5)[:, None]).ravel()
    cell, (m, px, py, E) = np.minimum(np.abs(x).astype(int), 2*L - 1), sums
    inner = E - (px**2 + py**2)/(2*m)
    volume, mass, p, e = (np.bincount(cell, q, 2*L) for q in (
        *(np.tile(q, PARTS) for q in (V, m)), np.sign(x)*np.tile(px, PARTS), np.tile(inner, PARTS)))
    with np.errstate(all="ignore"):
        return np.array([mass/volume, p/mass, e/volume/EOS.cv])


# --- points -----------------------------------------------------------------------------------------------------------


def fixed(L: int, law: ConstEta, seed: int, step: float, report: Report, make: Callable[[Points, Any], Edges],
          jitter: float) -> Seen:
    """Fixed points, friction along edges    [RR98 Eqs 34-36, 51]"""
    points = jittered((4*L, round(HEIGHT)), jitter, seed)
    edges = make(points, Lucy.of(h=2.0))
    method = Layer(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=EOS, law=law, T_plates=(1.0, 1.0), g=0.0)
    rho, T = gases(L, points.x[:, 0])
    state, reached = followed(method, method.state(rho, np.zeros_like(points.x), T), L, step, report)
    return seen(L, points.x[:, 0], edges.V, state*edges.V) if reached == 1 else ended(L, reached)


def moving(L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """Points that move with the gas and exchange over closed faces."""
    points = jittered((4*L, round(HEIGHT)), START_JITTER, seed)
    method = Moving(weight=WendlandC2.of(h=3.0), eos=EOS, law=law, box=(4*L, HEIGHT),
                    walls=(*periodic(4*L), *periodic(HEIGHT, axis=1)))
    rho, T = gases(L, points.x[:, 0])
    state, reached = followed(method, method.state(points.x, np.zeros_like(points.x), rho, T), L, step, report)
    if reached < 1:
        return ended(L, reached)
    px, py, m, V, E = state[4:9]
    return seen(L, state[0], V, np.array([m, px, py, E]))


def followed(method: Any, start: np.ndarray, L: int, step: float, report: Report) -> tuple[np.ndarray, float]:
    """The state at the end, and the part of the time that was reached; step : over the limit of the start."""
    steps = int(END*L/(step*limit_of(method, start))) + 1
    try:
        return run(method, start, Plan(dt=END*L/steps, steps=steps), report).by_id(), 1.0
    except Divergence as error:
        return start, error.step/steps


def seen(L: int, x: np.ndarray, V: np.ndarray, sums: np.ndarray) -> Seen:
    """Fields in cells, and the velocity across, rms over the mass."""
    return Seen(binned(L, x, V, sums), float(np.sqrt((sums[2]**2/sums[0]).sum()/sums[0].sum())))


# --- the grid ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Upright(Slab):
    """One tube without gravity, |y| < L/2, dense below; plates are as warm as the gas at them."""
    eos: Any = EOS
    T_hot: float = DENSE.P/DENSE.rho
    T_cold: float = THIN.P/THIN.rho

    @property
    def g(self) -> float:
        return 0.0


def grid(L: int, law: ConstEta, seed: int, step: float, report: Report) -> Seen:
    """The compressible grid as it is, cells of one spacing; it has no disorder, so that `seed` says nothing."""
    scene = Upright(L=float(2*L), aspect=2/L, viscosity=law.eta, heat=law.k)
    x, y = nodes(scene, 2*L)
    # the node on the diaphragm has the mean temperature
    T = np.where(y < 0, scene.T_hot, np.where(y > 0, scene.T_cold, scene.T_mean))[:, None]*np.ones(len(x))
    cells = np.where(np.arange(2*L) < L, DENSE.rho, THIN.rho)[:, None]*np.ones(len(x) - 1)
    start = Fields(scene, x, y, Values(0*T, 0*T, EOS.cv*T, T, np.ones_like(T)), cells)
    S = block(start)
    steps = int(END*L/(step*limits(scene, S).both)) + 1
    march = March(scene, S, FluxForm(), END*L/steps)
    try:
        march.go(steps)
    except DivergedError:
        return ended(L, march.steps/steps)
    done = unblock(scene, march.S)
    at = done.at
    v, T = ((q[1:] + q[:-1])[:, :-1].mean(axis=1)/2 for q in (at.vy, at.T))
    rho = done.cells.mean(axis=1)
    return Seen(np.array([rho, v, rho*T]), float(np.sqrt((at.vx**2).mean())))


METHODS: dict[str, Callable[[int, ConstEta, int, float, Report], Seen]] = {
    "grid": grid,
    "fixed lattice": partial(fixed, make=renormalised, jitter=0.0),
    "fixed jittered": partial(fixed, make=delaunay, jitter=JITTER),
    "moving": moving}
