"""Every method at rest with a little noise, on as few points as its range allows: what its step limit is tried on.

Units: spacing, mean density, T and P/rho are 1, so the speed of sound is sqrt 2 (ideal gas, C_V = 1).
"""
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import ConstEta, IdealGas
from continuum.gas.fields import block, initial
from continuum.gas.loop import FluxForm
from continuum.gas.solve import RK4_DECAY, RK4_SOUND, March, limits
from particles.integral.closed_faces import Moving
from particles.integral.edge_makers import renormalised
from particles.integral.edges import NONE_BEYOND, between_plates
from particles.integral.layer import Layer
from particles.integral.points import lattice
from particles.integral.rr98_moving import DRIFTS, Drift
from particles.integral.rr98_moving_plain import scale_of
from particles.integral.thermal import Thermal
from particles.integral.triangulation import delaunay
from particles.integrators import Euler
from particles.limits import lattice_sums, limit_of, zone
from particles.smooth.spam import Direct
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import Lucy, WendlandC2
from studies.build.periodic_box import at_rest, fluid
from studies.build.scenes import TINY, Slab
from studies.build.setting import positions
from studies.build.unguarded import GROWN, NOISE, Unguarded, noise_grows
from studies.hardcases.limits.euler import euler_step, strip_step

SIDE = 10               # points along each side: waves of 10, 5, ... 2 spacings
SMALL = 6               # of the scheme that is not compiled
JITTER = 0.3            # of disordered points, in spacings
DISORDER = 1.4          # by which limits of points that move leave room for disorder: see `limit_of` of each
EOS, SOUND = IdealGas(), np.sqrt(2)
STAGES_SOUND, STAGES_DECAY = 1.73, 2.51     # where the region of three stages ends
FACES = 2.9             # fastest diffusion over faces of a lattice, Wendland C2, h = 3; at it volumes follow: tests derive it


class Trial(NamedTuple):
    """A method at rest: start (fields, n), rows of the state that noise is looked for in, integrator by name.

    predicted : the largest step by the method's own formula. margin : what it leaves for disorder, by which it is smaller.
    shorter : the shorter one of the steps that sound alone and diffusion alone allow, by the operators in use.
    linear : whether eigenvalues of the rates say all, as they do not where faces are made and points drift between stages.
    """
    method: Any
    start: np.ndarray
    rows: tuple[int, ...]
    integrator: str
    predicted: float
    margin: float = 1.0
    linear: bool = True
    shorter: float = np.nan

    def grows(self, steps: int) -> Callable[[float], bool]:
        """Whether noise grows at a step, within so many of them."""
        free = Unguarded(self.method, Euler if self.integrator == "Euler" else None)
        return lambda dt: noise_grows(free, self.start, self.rows, steps, dt)


def shorter(law: ConstEta, sound: float, spread: float, wave: float = RK4_SOUND, decay: float = RK4_DECAY) -> float:
    """The shorter one of two limits, from what `fastest` tells of edges; wave, decay : where the integrator's region ends."""
    return float(min(wave/(SOUND*sound), decay/max(max(law.eta, law.k)*spread, TINY)))


def noise(*shape: int) -> np.ndarray:
    """Normal numbers of size NOISE; the same at each call."""
    return NOISE*np.random.default_rng(1).standard_normal(shape)


def spam(law: ConstEta, weight: Any, h: float, **more: Any) -> Trial:
    """Smooth particles on a square lattice that is stable by itself, in a periodic box."""
    x, e = lattice((SIDE, SIDE)).x, 1 + noise(SIDE**2)
    method = fluid(weight.of(h=h), (SIDE, SIDE), EOS, law, **more)
    start = at_rest(x, e)
    start[2:4] = noise(2, SIDE**2)
    return Trial(method, start, (2, 3, 4), "RK4", limit_of(method, start))


def fixed(law: ConstEta, make: Callable = renormalised, jitter: float = 0.0, share: float = 1.0) -> Trial:
    """Fixed points between plates, RK4."""
    x = positions(SIDE, SIDE, jitter, 1)
    edges, beyond = between_plates(make, x, SIDE, SIDE, Lucy.of(h=2.0))
    method = Layer(x=x, edges=edges, beyond=beyond, eos=EOS, law=law, T_plates=(1.0, 1.0), g=0.0, share=share)
    start = method.state(1 + noise(len(x)), noise(len(x), 2), 1 + noise(len(x)))
    sound, along = method.fastest
    spread = along if share == 1 else sound**2      # the divergence of nested currents is a second gradient
    return Trial(method, start, (0, 1, 2, 3), "RK4", limit_of(method, start), shorter=shorter(law, sound, spread))


def edges_alone(law: ConstEta) -> Trial:
    """Jittered points, their formula without images behind plates."""
    trial = fixed(law, delaunay, JITTER)
    sound, spread = trial.method.edges.fastest
    return trial._replace(predicted=1/(sound*SOUND/RK4_SOUND + max(law.eta, law.k)*spread/RK4_DECAY), shorter=np.nan)


def euler(law: ConstEta) -> Trial:
    """Fixed points with gradients of gradients and forward Euler, as printed    [RR98 Eqs 34-40]"""
    return fixed(law, share=0.0)._replace(integrator="Euler", predicted=euler_step(law))


def euler_periodic(law: ConstEta) -> Trial:
    """The same without plates."""
    points = lattice((SIDE, SIDE))
    method = Layer(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), beyond=NONE_BEYOND, eos=EOS, law=law,
                   T_plates=(1.0, 1.0), g=0.0, share=0.0)
    start = method.state(1 + noise(points.n), noise(points.n, 2), 1 + noise(points.n))
    return Trial(method, start, (0, 1, 2, 3), "Euler", euler_step(law))


def euler_strip(law: ConstEta) -> Trial:
    """Between plates, with the step of linear theory that knows them."""
    return euler(law)._replace(predicted=strip_step(law, SIDE, SIDE))


def thermal(law: ConstEta, share: float) -> Trial:
    """Fluctuating hydrodynamics without fluctuations, k = 0."""
    points = lattice((SMALL, SMALL))
    method = Thermal(edges=renormalised(points, Lucy.of(h=2.0)), eos=EOS, law=law, k=0.0, seed=1, share=share)
    start = method.dih.state(1 + noise(points.n), noise(points.n, 2), 1 + noise(points.n))
    sound, spread = method.edges.fastest
    return Trial(method, start, (0, 1, 2, 3), "ThreeStage", limit_of(method, start),
                 shorter=shorter(law, sound, share*spread + (1 - share)*sound**2, STAGES_SOUND, STAGES_DECAY))


def drifting(law: ConstEta, name: str) -> Trial:
    """Points that move in one of RR98's ways, between plates."""
    weight, points = WendlandC2.of(h=4.0), lattice((SIDE, SIDE))      # at h = 3 the lattice itself gives way
    method = Drift(motion=DRIFTS[name], weight=weight, scale=scale_of(lattice((12, 12)), weight), eos=EOS, law=law,
                   box=(SIDE, SIDE), walls=(*plates(SIDE, 1.0, 1.0), *periodic(SIDE)))
    start = method.state(points.x, 1.0, noise(points.n, 2), 1 + noise(points.n))
    # omega^2/c^2 with P = c^2/2: force changes by -c^2 S^2 rho' and 2 P D, but volumes that follow the flow take 2 P S^2 back
    sums, f = lattice_sums(weight, 1.0, 1.0, zone(1.0)), method.scale
    sound2 = f*np.linalg.eigvalsh(sums.D)[:, -1] + (f*f*(sums.S**2).sum(axis=1) if name == "literal" else 0.0)
    return Trial(method, start, (2, 3, 4, 5), "RK4", limit_of(method, start), DISORDER,
                 shorter=shorter(law, float(np.sqrt(sound2.max())), float(f*sums.k2[Direct].max())))


def moving(law: ConstEta) -> Trial:
    """Moving points that exchange over closed faces, between plates."""
    points = lattice((SIDE, SIDE))
    method = Moving(weight=WendlandC2.of(h=3.0), eos=EOS, law=law, box=(SIDE, SIDE),
                    walls=(*plates(SIDE, 1.0, 1.0), *periodic(SIDE)))
    start = method.state(points.x, noise(points.n, 2), 1.0, 1 + noise(points.n))
    both = shorter(law, 1.0, FACES, STAGES_SOUND, STAGES_DECAY)
    return Trial(method, start, (4, 5, 6, 7, 8), "ThreeStage", limit_of(method, start), DISORDER, linear=False,
                 shorter=min(both, STAGES_DECAY/FACES))      # volumes follow at the same rate of diffusion, without friction too


class OnGrid(NamedTuple):
    """The compressible grid at rest, cells of size 1: the attributes of a `Trial`."""
    scene: Slab
    start: np.ndarray
    predicted: float
    shorter: float
    integrator: str = "RK4"
    margin: float = 1.0

    def grows(self, steps: int) -> Callable[[float], bool]:
        """Whether noise grows at a step, within so many of them."""
        return lambda dt: self._noise(steps, dt)

    def _noise(self, steps: int, dt: float) -> bool:
        march = March(self.scene, self.start.copy(), FluxForm(), dt)
        try:
            march.go(steps//10)
            before = spread(march.S)
            march.go(steps - steps//10)
        except ArithmeticError:
            return True
        return spread(march.S) > GROWN*before


def spread(S: np.ndarray) -> float:
    """Rms deviation of all fields from their means, without ghosts."""
    return float(np.sqrt(S[:, 1:-1, 1:-1].var(axis=(1, 2)).sum()))


def on_grid(law: ConstEta) -> OnGrid:
    """Cells between plates, as many as points."""
    scene = Slab(L=float(SIDE), aspect=1.0, viscosity=law.eta, heat=law.k)
    S = block(initial(scene, SIDE, 0.0))
    S[:, 2:-1, 1:-1] += noise(*S[:, 2:-1, 1:-1].shape)
    found = limits(scene, S)
    return OnGrid(scene, S, found.both, min(found.sound, found.diffusion))


@dataclass(frozen=True)
class Maker:
    """A method by name."""
    make: Callable[..., Trial | OnGrid]
    more: tuple[tuple[str, Any], ...] = ()

    def __call__(self, law: ConstEta) -> Trial | OnGrid:
        return self.make(law, **dict(self.more))


#: by name; which weight and range each has is in its parameters
METHODS: dict[str, Maker] = {
    "grid": Maker(on_grid),
    "spam Lucy": Maker(spam, (("weight", Lucy), ("h", 2.5))),
    "spam Wendland": Maker(spam, (("weight", WendlandC2), ("h", 4.0))),
    "spam direct": Maker(spam, (("weight", Lucy), ("h", 2.5), ("transport", Direct))),
    "fixed lattice": Maker(fixed),
    "fixed nested": Maker(fixed, (("share", 0.0),)),
    "fixed jittered": Maker(fixed, (("make", delaunay), ("jitter", JITTER))),
    "fixed jittered, edges alone": Maker(edges_alone),
    "fixed Euler": Maker(euler),
    "fixed Euler, strip": Maker(euler_strip),
    "fixed Euler, periodic": Maker(euler_periodic),
    "fluctuating": Maker(thermal, (("share", 1.0),)),
    "drift literal": Maker(drifting, (("name", "literal"),)),
    "drift constant mass": Maker(drifting, (("name", "constant-mass"),)),
    "moving": Maker(moving),
}
