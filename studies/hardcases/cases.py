"""Which cases, by size."""
from collections.abc import Iterator
from itertools import product

from continuum.fluid import DenseFluid, IdealGas
from particles.weights import Lucy, Monaghan
from studies.hardcases import high_ra, steps
from studies.hardcases.grids import OnGrid, OnTorus, Sheared, Steadiness
from studies.hardcases.high_ra import FineGrid, HighRa
from studies.hardcases.interface import Interface
from studies.hardcases.methods import SHEARED, TAKES
from studies.hardcases.points import Hard, Shear
from studies.hardcases.scenes import BOXES, LAYERS, ROWS
from studies.hardcases.sod import ShockTube
from studies.hardcases.square import Square
from studies.hardcases.steps import Limit
from studies.hardcases.tubes import ETAS, FINE, METHODS, STEPS, MethodTube
from studies.kit.case import Case

LENGTHS = (24.0, 36.0, 48.0, 72.0, 96.0, 144.0, 192.0)
MORE_SEEDS = 16         # of the longest viscous tube, whose ringing is near to what is asked
METHOD_LENGTHS = (24, 36, 48, 72, 96)
RANDOM = ("fixed jittered", "moving")       # whose points lie as a seed says
#: scale, k a, number of seeds
RIPPLES = ((1.0, 0.25, 3), (1.0, 0.75, 3), (2.0, 0.25, 8), (4.0, 0.25, 7))
#: viscosity and conductivity, spacing times speed of sound is 1.4: what the step is limited by
FLUIDS = {"zero viscosity": (0.0, 0.0), "balanced": (0.3, 0.3), "Prandtl 0.01": (0.05, 5.0), "Prandtl 100": (5.0, 0.05)}
SLOW = ("moving", "fluctuating", "spam direct")         # methods in two of them only
GRIDS = (ROWS, 2*ROWS, 3*ROWS)
#: where three left undecided what is a tenth off
MORE_GRIDS = {"Ra 1e5": (4*ROWS, 6*ROWS), "high pressure": (4*ROWS, 6*ROWS, 8*ROWS)}
#: Ra and rows on which it is asked whether the grid is steady
HIGH, FINER = (1e5, 2e5, 3.5e5), (16, 24, 32, 48)


def cases(size: str) -> Iterator[Case]:
    """All of them; `quick` is for trying the path out."""
    if size == "quick":
        yield from shocks((12.0, 15.0, 18.0), ((0.5, 0.25, 1),), 1)
        yield from method_tubes((12, 15, 18), 1)
        yield from (Limit(method=name, scene="balanced", eta=0.3, k=0.3) for name in ("grid",
                                                                                      "spam Lucy",
"fixed lattice"))
        scene, time = LAYERS["Prandtl 100"]
        yield Hard(case="Prandtl 100", method="fixed lattice",
                   scene=scene, time=time/10*scene.L/scene.free_fall)
        return
    yield from squares()
    yield from shocks(LENGTHS, RIPPLES, 3)
    yield from (ShockTube(L=max(LENGTHS), eta=0.5, seed=seed) for seed in range(4, MORE_SEEDS + 1))
    yield from method_tubes(METHOD_LENGTHS, 3)
    yield from highest()
    yield from limits()
    yield from hard()
    yield from (Shear(method=method) for method in SHEARED)
    yield Sheared()
    yield from (Steadiness(ra=ra, rows=rows) for ra, rows in product(HIGH, FINER))


def squares() -> Iterator[Case]:
    """Both weights and fluids with the printed viscosities; what pairs also nearer to onset, at 5012."""
    for (eos, ra), weight in product(((IdealGas(), 67150.0), (DenseFluid(), 511200.0)), (Monaghan, Lucy)):
        yield Square(eos=eos, weight=weight, ra=ra, t_end=25.0, mean_from=15.0)
    yield Square(weight=Monaghan, ra=1e4, t_end=40.0, mean_from=30.0)


def shocks(lengths: tuple[float, ...], ripples: tuple[tuple[float, float, int], ...], seeds: int) -> Iterator[Case]:
    """Tubes without and with viscosity, profiles of the longest; interfaces."""
    for L, eta, seed in product(lengths, (0.0, 0.5), range(1, seeds + 1)):
        yield ShockTube(L=L, eta=eta, seed=seed, keep=L == max(lengths) and seed == 1)
    for scale, steep, last in ripples:
        yield from (Interface(scale=scale, steep=steep, seed=seed) for seed in range(1, last + 1))


def method_tubes(lengths: tuple[int, ...], seeds: int) -> Iterator[Case]:
    """All methods, viscosities, lengths; several seeds of disordered points in the most viscous gas."""
    for method, eta, step, L in product(METHODS, ETAS, STEPS, lengths):
        many = method in RANDOM and eta == max(ETAS)
        for seed in range(1, seeds + 1 if many else 2):
            yield MethodTube(method=method, eta=eta, L=L, seed=seed, step=step, keep=L == max(lengths) and seed == 1)
    for eta, L in product(ETAS[1:], lengths):
        yield MethodTube(method=FINE, eta=eta, L=L, keep=L == max(lengths))


def highest() -> Iterator[Case]:
    """Five starts each, three of the moving points, which cost most."""
    yield from (FineGrid(rows=rows) for rows in (high_ra.FINE, high_ra.FINER))
    for method, step in product(high_ra.METHODS, high_ra.STEPS):
        yield from (HighRa(method=method, seed=seed, step=step) for seed in range(1, 4 if method == "moving" else 6))


def limits() -> Iterator[Case]:
    """Of the time step."""
    for method, (scene, (eta, k)) in product(steps.METHODS, FLUIDS.items()):
        if method not in SLOW or scene in ("balanced", "Prandtl 100"):
            yield Limit(method=method, scene=scene, eta=eta, k=k)


def hard() -> Iterator[Case]:
    """Layers and boxes."""
    for case, (scene, units) in LAYERS.items():
        time = units*scene.L/scene.free_fall
        for rows in (*GRIDS, *MORE_GRIDS.get(case, ())):
            yield OnGrid(case=case, scene=scene, time=time, rows=rows)
        yield from (Hard(case=case, method=method, scene=scene, time=time) for method in TAKES[case])
    for case, (scene, time) in BOXES.items():
        yield from (Hard(case=case, method=method, scene=scene, time=time) for method in TAKES[case])
    corner, time = BOXES["wall corner"]
    yield OnGrid(case="wall corner", scene=corner, time=time, rows=round(corner.L))
    yield from (OnTorus(case=case) for case in ("zero viscosity", "vacuum"))
