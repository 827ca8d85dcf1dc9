"""Methods by name, for any scene that is a layer: points, state, step, and what moves."""
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import energy
from particles.limits import limit_of
from particles.walls.periodic import periodic
from particles.weights import Lucy
from studies.build import fixed as dih
from studies.build import moving, spam
from studies.build import rr98_moving as drift
from studies.build.names import START_ENERGY, START_JITTER
from studies.build.setting import positions
from studies.hardcases.map.scenes import THIN, Vortex

SPACINGS = 4            # of a cell over which velocities are averaged: what is left of them is flow, the rest noise


class Body(NamedTuple):
    """Places (n, 2), velocities (n, 2) and masses (n,)."""
    x: np.ndarray
    v: np.ndarray
    m: np.ndarray


class Built(NamedTuple):
    """A method ready to run. body(state) tells what moves."""
    method: Any
    start: np.ndarray
    dt: float
    body: Callable[[np.ndarray], Body]


def kinetic(body: Body) -> float:
    """K per mass."""
    return float(0.5*body.m@(body.v**2).sum(axis=1)/body.m.sum())


def flow(body: Body, box: tuple[float, float]) -> float:
    """The same of velocities averaged over the mass in cells of SPACINGS: noise between neighbours is left out."""
    cells = np.maximum(1, np.round(np.array(box)/SPACINGS)).astype(int)
    at = np.clip(((body.x/np.array(box) + 0.5)*cells).astype(int), 0, cells - 1)
    cell = at[:, 0]*cells[1] + at[:, 1]
    mass = np.bincount(cell, body.m, cells.prod())
    p = np.stack([np.bincount(cell, body.m*u, cells.prod()) for u in body.v.T])
    return float(0.5*np.sum(p**2/np.maximum(mass, 1e-300))/mass.sum())


def fields(scene: Any, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Density, velocity (n, 2) and temperature of a scene at x (n, 2)."""
    rho = scene.density(x[:, 0]) if hasattr(scene, "density") else np.ones(len(x))
    return rho, np.stack(scene.flow(*x.T, START_ENERGY), axis=1), scene.T(x[:, 1])


# --- smooth particles -------------------------------------------------------------------------------------------------


def all_round(scene: Any) -> tuple:
    """Periodic along both axes."""
    return (*periodic(scene.width), *periodic(scene.L, axis=1))


def smooth(scene: Any, variant: spam.Variant) -> Built:
    """Smooth particles; between plates that slip lies one period, and what is thin is empty."""
    if isinstance(scene, Vortex) or hasattr(scene, "density"):
        variant = variant._replace(walls=all_round)
    method, x = spam.method(scene, variant), positions(scene.width, scene.L, START_JITTER, 1)
    rho, v, T = fields(scene, x)
    state = np.array([*x.T, *v.T, energy(scene.eos, 1.0, T)])[:, rho > THIN]
    return Built(method, state, variant.step*limit_of(method, state),
                 lambda state: Body(state[:2].T, state[2:4].T, np.ones(state.shape[1])))


# --- points of RR98 ---------------------------------------------------------------------------------------------------


def fixed(scene: Any, scheme: dih.Scheme) -> Built:
    """Points that stay, between plates."""
    method = dih.fluid(scene, scheme, 1)
    rho, v, T = fields(scene, method.x)
    start = method.state(rho, v, T)
    return Built(method, start, dih.OF_LIMIT*limit_of(method, start),
                 lambda state: Body(method.x, (state[1:3]/state[0]).T, state[0]*method.edges.V))


def drifting(scene: Any, motion: drift.DriftMotion, walls: Callable[[Any], tuple] | None = None) -> Built:
    """RR98's own motions; walls(scene) in place of plates."""
    method, x = drift.method(scene, motion), positions(scene.width, scene.L, START_JITTER, 1)
    method = replace(method, walls=walls(scene)) if walls else method
    rho, v, T = fields(scene, x)
    start = method.state(x, rho, v, T)
    return Built(method, start, limit_of(method, start),
                 lambda state: Body(state[:2].T, (state[2:4]/state[4]).T, state[4]*state[6]/method.motion.owned(state[6])))


def closed(scene: Any, motion: moving.Motion, walls: Callable[[Any], tuple] | None = None) -> Built:
    """Moving points with closed faces; walls(scene) in place of plates."""
    method, x = moving.method(scene, motion), positions(scene.width, scene.L, START_JITTER, 1)
    method = replace(method, walls=walls(scene)) if walls else method
    rho, v, T = fields(scene, x)
    start = method.state(x, v, rho, T)
    return Built(method, start, motion.of_limit*limit_of(method, start),
                 lambda state: Body(state[:2].T, (state[4:6]/state[6]).T, state[6]))


def narrow(h: float) -> dict[str, partial]:
    """Smooth particles and fixed points of one range."""
    return {f"spam h {h:g}": partial(smooth, variant=spam.PRINTED._replace(h=h)),
            f"fixed h {h:g}": partial(fixed, scheme=dih.SCHEMES["fixed-lattice"]._replace(h=h, weight=Lucy))}


#: those that are tried on all layers and on the vortex
USUAL: dict[str, partial] = {
    "spam printed": partial(smooth, variant=spam.PRINTED),
    "spam Wendland": partial(smooth, variant=spam.VARIANTS["wendland-c2"]),
    "fixed lattice": partial(fixed, scheme=dih.SCHEMES["fixed-lattice"]),
    "fixed nested": partial(fixed, scheme=dih.SCHEMES["fixed-lattice-nested-only"]),
    "fixed jittered": partial(fixed, scheme=dih.SCHEMES["fixed-jittered-delaunay"]),
    "drift literal": partial(drifting, motion=drift.DRIFT_MOTIONS["moving-literal"]),
    "drift constant mass": partial(drifting, motion=drift.DRIFT_MOTIONS["moving-constant-mass"]),
    "moving": partial(closed, motion=moving.MOTIONS["moving"])}
DISORDERED: dict[str, partial] = {f"fixed {name}": partial(fixed, scheme=dih.SCHEMES[scheme]) for name, scheme in (
    ("lattice", "fixed-lattice"), ("jittered plain", "fixed-jittered-plain"), ("jittered closed", "fixed-jittered-closed"),
    ("jittered", "fixed-jittered-delaunay"), ("random", "fixed-random-delaunay"))}
NARROW: dict[str, partial] = {name: build for h in (0.9, 1.2, 1.5, 2.0) for name, build in narrow(h).items()}
CORNERS: dict[str, partial] = {
    **{f"spam {name}": partial(smooth, variant=spam.VARIANTS[variant]) for name, variant in (
        ("printed", "printed"), ("Wendland", "wendland-c2"), ("odd images", "walls-odd"),
        ("images' own pressure", "walls-own-pressure"))},
    "spam direct": partial(smooth, variant=spam.VARIANTS["direct"]),
    "spam without walls": partial(smooth, variant=spam.PRINTED._replace(walls=all_round))}
#: which methods take which case; a strip in a vacuum has no points outside but smooth particles'
TAKES: dict[str, dict[str, partial]] = {
    **dict.fromkeys(("Ra 1e5", "Ra 1e6", "Prandtl 0.01", "Prandtl 100", "high pressure", "zero viscosity", "vacuum"), USUAL),
    "disordered points": DISORDERED, "narrow weight": NARROW, "wall corner": CORNERS}
