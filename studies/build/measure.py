"""Run any method in the layer heated from below, and measure its flow.

Separates the symmetric part of a flow from noise, and smooths the grid's field with a weight.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from math import sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.signal import oaconvolve
from scipy.spatial import cKDTree

from continuum.gas import fields as gas
from continuum.scene import Periodic
from particles.run import Divergence, Plan, Run, run
from particles.weights import value_and_slope
from studies.build.setting import Ready
from studies.kit.csvfile import read
from studies.kit.stats import Measured
from studies.kit.store import RESULTS

FINE = 240     # places over the height where fields are smoothed: a range at 100 rows covers 7
RANGE = 3.0     # range of the printed weights, in spacings
RA = 1e4        # of `limit`
Fields = dict[str, np.ndarray]


@cache
def limit(column: str) -> float:
    """A column of the grid of the study rb at Ra 10 000, Pr 1, extrapolated."""
    rows = read(RESULTS/"rb"/"means.csv").query(
        "method == 'compressible' and variant == 'flux-form' and eos == 'ideal' and transport == 'const-eta' "
        "and sides == 'periodic' and ra == @RA and pr == 1 and resolution == inf")
    return float(rows[column].iloc[0])


class Ended(NamedTuple):
    """K per mass and Nu at the end of a run; errors are the changes over its last tenth."""
    ke: float
    ke_err: float
    nu: float
    nu_err: float
    converged: bool


def followed(scene: Any, variant: Any, seed: int, t_end: float, often: int,
             report: Any = None, checkpoint: Path | None = None,
             **more: Any) -> tuple[Ready, int, Run | None]:
    """(setup, steps, run) of a run until t_end, in free-fall times; if it diverged: the step where, and None.

    `variant.series` is recorded `often` times per free-fall time. more : further arguments of `Plan`.
    """
    ready, unit = variant.ready(scene, seed), scene.L/scene.free_fall
    plan = Plan(dt=ready.dt, steps=round(t_end*unit/ready.dt), series=variant.series,
                every=max(1, round(unit/often/ready.dt)), checkpoint=checkpoint, **more)
    try:
        return ready, plan.steps, run(ready.method, ready.start, plan, report)
    except Divergence as error:
        return ready, error.step, None


def heat_at_rest(scene: Any) -> float:
    """Heat per time conducted through a plate at rest: the unit of Nu."""
    return scene.k*scene.dT/scene.L*scene.width


def ended(scene: Any, done: Run) -> Ended:
    """From series ke, lower, upper; the error of Nu includes the difference of heat between the plates."""
    ke, lower, upper = (np.array(done.series[name]) for name in ("ke", "lower", "upper"))
    unit, late = heat_at_rest(scene), slice(-max(2, len(ke)//10), None)
    nu, err = (lower - upper)/2/unit, float(np.ptp(ke[late]))
    nu_err = float(np.ptp(nu[late]) + abs(lower[-1] + upper[-1])/2/unit)
    return Ended(ke[-1], err, nu[-1], nu_err, bool(err < 1e-3*ke[-1] + 1e-7))


def rolls(scene: Any, x: np.ndarray, vy: np.ndarray) -> int:
    """Number of rolls: twice the strongest harmonic along x of vy (n,) at mid-height, x (n, 2); 0 at rest."""
    middle = np.abs(x[:, 1]) < scene.L/8
    vy = vy[middle]
    if np.abs(vy).max() < 1e-4*scene.free_fall:
        return 0
    size = [abs(np.mean(vy*np.exp(-2j*np.pi*m*x[middle, 0]/scene.width))) for m in range(1, 7)]
    return 2*(1 + int(np.argmax(size)))


def turns(scene: Any, vy: np.ndarray) -> int:
    """Number of rolls: changes of sign of mean vy (rows, columns) along mid-height where |vy| > max/5."""
    mid = vy[len(vy)//2 - 1:len(vy)//2 + 1].mean(axis=0)
    if np.abs(mid).max() < 5e-3*scene.free_fall:
        return 0
    up = mid[np.abs(mid) > 0.2*np.abs(mid).max()] > 0
    return int(np.sum(up[1:] != up[:-1]) + (isinstance(scene.sides, Periodic) and up[-1] != up[0]))


def upright(at: Fields) -> Fields:
    """A periodic flow, shifted along x so that the first harmonic of vy has its crest at column 0."""
    columns = at["vy"].shape[1]
    shift = np.angle(np.fft.rfft(at["vy"].mean(axis=0))[1])
    turn = np.exp(-1j*shift*np.arange(columns//2 + 1))
    return {name: np.fft.irfft(np.fft.rfft(f, axis=1)*turn, columns, axis=1) for name, f in at.items()}


def mirrored(at: Fields) -> Fields:
    """The flow reflected at column 0; two equal rolls stay the same."""
    return {name: (-1 if name == "vx" else 1)*np.roll(f[:, ::-1], 1, axis=1) for name, f in at.items()}


def turned(at: Fields) -> Fields:
    """The flow rotated by half a turn; one roll in a box stays the same. The density is not rotated."""
    return {name: -f[::-1, ::-1] if name in ("vx", "vy") else f for name, f in at.items()}


def flowing(at: Fields, periodic: bool) -> Measured:
    """Kinetic energy per mass of the symmetric part of mean velocities (rows, columns): that of rolls.

    The error is the energy of the antisymmetric part: noise, of which the symmetric part has as much, and in
    a box effects of compressibility. If rolls drift during the average, the value is a lower bound.
    """
    if periodic:
        at = upright(at)
    other = mirrored(at) if periodic else turned(at)
    return Measured(kinetic(at, other, 1), kinetic(at, other, -1))


def kinetic(at: Fields, other: Fields, sign: int) -> float:
    """Kinetic energy per mass of half the sum (sign 1) or difference (-1) of flows, at density of `at`."""
    v2 = sum(((at[name] + sign*other[name])/2)**2 for name in ("vx", "vy"))
    return 0.5*float(np.mean(at["rho"]*v2))/float(np.mean(at["rho"]))


class Smoothing(NamedTuple):
    """A weight of `particles.weights` with range h spacings, `rows` spacings over the height."""
    weight: Any
    h: float
    rows: int


def smoothed_energy(fields: gas.NodeFields, smoothing: Smoothing) -> tuple[float, float]:
    """(K, K of <v> = sum m v w/sum m w) of a field, with particles as dense as the fluid.

    Behind walls the density is mirrored and the velocity zero, as of the printed images    [KHP95, Fig. 3]
    """
    width, L = fields.scene.width, fields.scene.L
    columns = round(FINE*width/L)
    x, y = ((np.arange(n) + 0.5)/n*size - size/2 for n, size in ((columns, width), (FINE, L)))
    at, w = gas.interpolate(fields, *np.meshgrid(x, y)), kernel(smoothing)
    mirror, rest = ("wrap", "wrap") if fields.periodic else ("symmetric", "constant")
    margin = len(w)//2
    rho = oaconvolve(padded(at.rho, margin, mirror, "symmetric"), w, mode="valid")
    px, py = (oaconvolve(padded(at.rho*v, margin, rest, "constant"), w, mode="valid") for v in (at.vx, at.vy))
    plain, smooth = (0.5*np.sum(at.rho*v2)/np.sum(at.rho)
                     for v2 in (at.vx**2 + at.vy**2, (px**2 + py**2)/rho**2))
    return float(plain), float(smooth)


def kernel(smoothing: Smoothing) -> np.ndarray:
    """Values of the weight on places L/FINE apart, (2n + 1, 2n + 1)."""
    weight, finer = smoothing.weight.of(smoothing.h), smoothing.rows/FINE
    n = np.arange(-int(smoothing.h/finer), int(smoothing.h/finer) + 1)*finer
    return np.array([[value_and_slope(weight, float(np.hypot(a, b)))[0] for a in n] for b in n])


def padded(q: np.ndarray, margin: int, along: str, across: str) -> np.ndarray:
    """A field with `margin` more places beyond sides and plates; along, across : modes of `np.pad`."""
    wide = np.pad(q, ((0, 0), (margin, margin)), along)  # type: ignore[call-overload]
    return np.pad(wide, ((margin, margin), (0, 0)), across)  # type: ignore[call-overload]


def smoothed_rows(point: dict, fields: gas.NodeFields, smoothings: tuple[Smoothing, ...]) -> Iterator[dict]:
    """Rows of the table `smoothed`; `point` has the key columns of the grid's row."""
    for smoothing in smoothings:
        plain, smooth = smoothed_energy(fields, smoothing)
        yield {**point, "weight": smoothing.weight.__name__, "h": smoothing.h, "rows": smoothing.rows,
               "ke": plain, "ke_smoothed": smooth}


@dataclass(frozen=True)
class Snapshot:
    """Positions and velocities (points, 2) in spacings: `n` fluid particles, then fixed ones and images."""
    x: np.ndarray
    v: np.ndarray
    n: int
    height: float

    @cached_property
    def tree(self) -> cKDTree:
        """Search tree of all points."""
        return cKDTree(self.x)

    @cached_property
    def bulk(self) -> np.ndarray:
        """Indices of fluid particles farther from the plates than the range of the weight."""
        return np.flatnonzero(np.abs(self.x[:self.n, 1]) < self.height/2 - RANGE)

    def near(self, distance: float) -> np.ndarray:
        """Number of other points within a distance of each bulk particle."""
        return self.tree.query_ball_point(self.x[self.bulk], distance, return_length=True) - 1

    @property
    def neighbours(self) -> Measured:
        """Mean number of neighbours within the range; particles that share neighbours count as one sample."""
        counts = self.near(RANGE)
        samples = max(1.0, len(counts)/counts.mean())
        return Measured(float(counts.mean()), float(1.96*counts.std()/sqrt(samples)))

    @property
    def spacing(self) -> Measured:
        """Distance of the highest peak of the pair distribution below 2, in bins of 0.1."""
        edges = np.arange(0.3, 2.01, 0.1)
        bulk = cKDTree(self.x[self.bulk])
        pairs = bulk.sparse_distance_matrix(self.tree, 2.0, output_type="ndarray")
        counts, _ = np.histogram(pairs["v"], edges)
        peak = np.argmax(counts/np.diff(edges**2))
        return Measured(float(edges[peak] + 0.05), 0.05)

    @property
    def pairing(self) -> Measured:
        """Median of second over first neighbour distance; both particles of a pair count as one sample."""
        distances, _ = self.tree.query(self.x[self.bulk], 3)
        _, first, second = np.transpose(distances)
        around = 0.98/sqrt(len(first)/2)*np.array([-1, 0, 1])
        low, middle, high = np.quantile(second/first, 0.5 + around)
        return Measured(float(middle), float(high - low)/2)

    @property
    def occupancy(self) -> float:
        """Particles per site: 1 + median number of others within half a spacing of a bulk particle."""
        return 1 + float(np.median(self.near(0.5)))

    @property
    def fastest(self) -> float:
        """Largest v^2 of the fluid particles."""
        return float((self.v[:self.n]**2).sum(axis=1).max())
