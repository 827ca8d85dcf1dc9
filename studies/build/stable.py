"""Entropy-stable methods with points on plates or with a blended pressure; methods around a disc."""
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import Torus
from particles.integral.bodies import held, with_disc
from particles.integral.entropy_fluxes import BlendedPressure, Dissipation, Logarithmic
from particles.integral.entropy_stable import StableLayer, StableStream
from particles.integral.layer import Layer
from particles.integral.moving_delaunay import MovingDelaunay
from particles.integral.moving_stable import StableDelaunay
from particles.integral.points import of_positions
from particles.integral.rings import rings
from particles.integral.stream import Stream
from particles.integral.triangulation import around, delaunay
from particles.pairs import pair_term, rate, sweep
from studies.build.fixed import OF_LIMIT, Scheme
from studies.build.moving import Carriage
from studies.build.setting import Ready, check_points, in_scene, no_still_layer, shifted, stepped

#: class of a method -> the same method with an entropy-stable flux
WITH_FLUX: dict[type, type] = {Stream: StableStream, Layer: StableLayer, MovingDelaunay: StableDelaunay}


def with_flux(made: Ready, of_limit: float = OF_LIMIT) -> Ready:
    """The same points, edges and start with an entropy-stable flux."""
    method = made.method
    given = {one.name: getattr(method, one.name) for one in fields(method)}
    return stepped(WITH_FLUX[type(method)](**given), made.start, of_limit)


class StableCarriage(Carriage):
    """Points that move with their triangulation, with an entropy-stable flux."""

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        return with_flux(super().ready(scene, seed), self.of_limit)


class StablePlates(Scheme):
    """A scheme with rows of points on the plates and an entropy-stable flux."""

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        return with_flux(super().ready(scene, seed))


def blended(eos: Any, **given: Any) -> StableLayer:
    """A layer with a blended pressure, which preserves contacts and is RR98's elsewhere."""
    terms = Logarithmic(eos), BlendedPressure(eos), Dissipation(eos)
    return StableLayer(eos=eos, flow=terms, **given)


class Around(NamedTuple):
    """Jittered points around an insulated disc of radius `scene.disc`, in a periodic box. Triangles end at
    points on its rim. flux : entropy-stable."""
    name: str
    flux: bool = False
    size: float = 0.3

    def refuses(self, scene: Any) -> str:
        if not isinstance(scene.sides, Torus):
            return f"sides = {scene.sides}"
        return "" if getattr(scene, "disc", 0) > 0 else "no disc"

    def ready(self, scene: Any, seed: int = 1) -> Ready:
        check_points(self, scene)
        box = scene.width, scene.L
        x, edge = with_disc(shifted(*box, self.size, seed), scene.disc)
        made = in_scene(self.around(scene, x, edge), scene, OF_LIMIT)
        return with_flux(made) if self.flux else made

    def around(self, scene: Any, x: np.ndarray, edge: np.ndarray) -> Any:
        """The method on points x (n, 2); edge : indices of those on the rim of the disc."""
        edges = around(of_positions(x, (scene.width, scene.L)), edge)
        return Stream(x=x, edges=edges, eos=scene.eos, law=scene.law, held=held(edge), solid=False)


class Past(Around):
    """Points that move past the disc with their triangulation."""

    def around(self, scene: Any, x: np.ndarray, edge: np.ndarray) -> Any:
        web = rings(x, (scene.width, scene.L), (False, False), edge)
        return MovingDelaunay(x=x, rings=web, held=held(edge), eos=scene.eos, law=scene.law)


STABLE = {one.name: one for one in (
    Scheme("fixed-lattice-entropy-stable-blended", kind=blended, lacks=no_still_layer),
    StablePlates("fixed-jittered-plates-entropy-stable", delaunay, size=0.3, held=True),
    StableCarriage("moving-delaunay-entropy-stable"),
)}
#: name of a method with points on plates -> the method around a disc that takes its place
BODIES = {one.name: one for one in (
    Around("fixed-jittered-plates"),
    Around("fixed-jittered-plates-entropy-stable", flux=True),
    Past("moving-delaunay"), Past("moving-delaunay-entropy-stable", flux=True),
)}


@pair_term(1, "term")
def Switched(term, a, b, ab):
    """Counts edges that dissipate."""
    m, px, py, e = rate(term.term, a, b, ab)
    return (1.0 if m != 0 or px != 0 or py != 0 or e != 0 else 0.0,)


def switched(sums: Any, state: np.ndarray) -> float:
    """Share of edges that dissipate, at the state last looked at: a quantity of a run."""
    term = next((one for one in sums.method.flow if isinstance(one, Dissipation)), None)
    if term is None:
        return 0.0
    count, edges = np.zeros((sums.n, 1)), sums.edges
    sums.threads(sweep, sums.n, Switched(term), sums.points, edges, count)
    return float(count.sum()/edges.taken.sum())
