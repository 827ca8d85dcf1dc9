"""Methods by name, for any scene that is a layer or a box: ready to run, and what of a state moves."""
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from studies.build import fixed as fixed_points
from studies.build import moving, rr98_moving, spam
from studies.build.names import START_JITTER
from studies.build.setting import positions
from studies.hardcases.scenes import THIN, Open, Strip, Vortex

SPACINGS = 4            # of a cell over which velocities are averaged: what is left of them is flow, the rest noise


class Body(NamedTuple):
    """Places (n, 2), velocities (n, 2) and masses (n,)."""
    x: np.ndarray
    v: np.ndarray
    m: np.ndarray


class Built(NamedTuple):
    """A method ready to run. body(state) is what moves."""
    method: Any
    start: np.ndarray
    dt: float
    body: Callable[[np.ndarray], Body]


def moved(method: Any) -> Callable[[np.ndarray], Body]:
    """What moves of a method's states."""
    def body(state: np.ndarray) -> Body:
        at = method.fields(state)
        return Body(at.x, at.v, at.rho*at.V)
    return body


def kinetic(body: Body) -> float:
    """K per mass."""
    return float(0.5*body.m@(body.v**2).sum(axis=1)/body.m.sum())


def flow(body: Body, box: tuple[float, float]) -> float:
    """The same of mean velocities in cells of SPACINGS, which have no noise between neighbours."""
    cells = np.maximum(1, np.round(np.array(box)/SPACINGS)).astype(int)
    at = np.clip(((body.x/np.array(box) + 0.5)*cells).astype(int), 0, cells - 1)
    cell = at[:, 0]*cells[1] + at[:, 1]
    mass = np.bincount(cell, body.m, cells.prod())
    p = np.stack([np.bincount(cell, body.m*u, cells.prod()) for u in body.v.T])
    return float(0.5*np.sum(p**2/np.maximum(mass, 1e-300))/mass.sum())


# --- families -------------------------------------------------------------------------------------


def places(scene: Any) -> np.ndarray:
    """Where points that move start."""
    return positions(scene.width, scene.L, START_JITTER, 1)


def smooth(scene: Any, variant: spam.Variant, open_box: bool = False) -> Built:
    """Smooth particles, none where the gas is thin; plates that slip are left out, their flow is periodic."""
    if open_box or isinstance(scene, Vortex | Strip):
        scene = Open(scene)
    x = places(scene)
    x = x[scene.fields(x)[0] > THIN]
    ready = variant.ready(scene, x=x)
    return Built(ready.method, ready.start, variant.step*ready.limit, moved(ready.method))


def fixed(scene: Any, scheme: fixed_points.Scheme) -> Built:
    """Points that stay."""
    method, start, dt = scheme.ready(scene)
    return Built(method, start, dt, moved(method))


def drifting(scene: Any, motion: rr98_moving.DriftMotion | moving.FacesMotion) -> Built:
    """RR98's own motions, and moving points with closed faces."""
    method, start, dt = motion.ready(scene, x=places(scene))
    return Built(method, start, dt, moved(method))


# --- names ----------------------------------------------------------------------------------------


SPAM = {"spam printed": partial(smooth, variant=spam.PRINTED),
        "spam Wendland": partial(smooth, variant=spam.VARIANTS["wendland-c2"])}
MOVING = {"drift literal": partial(drifting, motion=rr98_moving.DRIFT_MOTIONS["moving-literal"]),
          "drift constant mass": partial(drifting, motion=rr98_moving.DRIFT_MOTIONS["moving-constant-mass"]),
          "moving": partial(drifting, motion=moving.MOTIONS["moving"])}
FIXED = {name: partial(fixed, scheme=fixed_points.SCHEMES[scheme]) for name, scheme in (
    ("fixed lattice", "fixed-lattice"), ("fixed nested", "fixed-lattice-nested-only"),
    ("fixed jittered", "fixed-jittered-delaunay"), ("fixed random", "fixed-random-delaunay"),
    ("fixed jittered plain", "fixed-jittered-plain"), ("fixed jittered closed", "fixed-jittered-closed"))}
LATTICE = fixed_points.SCHEMES["fixed-lattice"]

#: those that are tried on all layers and on the vortex
USUAL = {**SPAM, **{name: FIXED[name] for name in ("fixed lattice",
                                                   "fixed nested", "fixed jittered")}, **MOVING}
DISORDERED = {name: build for name, build in FIXED.items() if name != "fixed nested"}
RANGES = (0.9, 1.2, 1.5, 2.0)
NARROW = {**{f"spam h {h:g}": partial(smooth, variant=spam.PRINTED._replace(h=h)) for h in RANGES},
          **{f"fixed h {h:g}": partial(fixed, scheme=LATTICE._replace(h=h)) for h in RANGES}}
CORNERS = {**SPAM, "spam without walls": partial(smooth, variant=spam.PRINTED, open_box=True),
           **{name: partial(smooth, variant=spam.VARIANTS[variant]) for name, variant in (
               ("spam odd images", "walls-odd"), ("spam images' own pressure", "walls-own-pressure"),
               ("spam direct", "direct"))}}
#: points on the shear flow keep away from where plates would be
SHEARED = {**SPAM, **MOVING, "fixed lattice": FIXED["fixed lattice"], "fixed jittered": partial(
    fixed, scheme=fixed_points.SCHEMES["fixed-jittered-delaunay"]._replace(points=partial(positions)))}
#: which methods take which case; a strip in a vacuum has no points outside but smooth particles'
TAKES: dict[str, dict[str, partial]] = {
    **dict.fromkeys(("Ra 1e5",
                     "Ra 1e6",
"Prandtl 0.01", "Prandtl 100", "high pressure", "zero viscosity", "vacuum"), USUAL),
    "disordered points": DISORDERED, "narrow weight": NARROW, "wall corner": CORNERS}
