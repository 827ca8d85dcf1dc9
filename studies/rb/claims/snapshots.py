"""Particles at the end of a run and mean fields on a grid of places: what the tables `particles` and `fields` tell."""
from dataclasses import dataclass
from functools import cached_property
from math import hypot, sqrt

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree
from scipy.special import stdtrit

from studies.build.read import largest, mean, select
from studies.build.symmetry import Fields, mirrored, upright
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.lattices import LUCY, RANGE


@dataclass(frozen=True)
class Snapshot:
    """Positions and velocities (points, 2) in spacings, the `n` fluid particles first, then fixed ones and images."""
    x: np.ndarray
    v: np.ndarray
    n: int
    height: float

    @cached_property
    def tree(self) -> cKDTree:
        return cKDTree(self.x)

    @cached_property
    def bulk(self) -> np.ndarray:
        """Fluid particles farther than the range of the weight from the plates."""
        return np.flatnonzero(np.abs(self.x[:self.n, 1]) < self.height/2 - RANGE)

    @cached_property
    def smoothed(self) -> np.ndarray:
        """(n, 2): field velocity <v> = sum v_j w / sum w at the fluid particles    [KHP95, Sec. II]"""
        near = cKDTree(self.x[:self.n]).sparse_distance_matrix(self.tree, RANGE, output_type="ndarray")
        w = LUCY(near["v"])
        sums = [np.bincount(near["i"], w*q[near["j"]], self.n) for q in (*self.v.T, np.ones(len(self.x)))]
        return np.stack([sums[0]/sums[2], sums[1]/sums[2]], axis=1)

    @property
    def neighbours(self) -> Measured:
        """Mean number within the range; counts of particles that share neighbours are one sample."""
        counts = self.tree.query_ball_point(self.x[self.bulk], RANGE, return_length=True) - 1
        return Measured(float(counts.mean()), 1.96*counts.std()/sqrt(max(1.0, len(counts)/counts.mean())))

    @property
    def spacing(self) -> Measured:
        """Distance where the first peak of the pair distribution is, by bins of 0.1."""
        edges = np.arange(0.3, 2.01, 0.1)
        near = cKDTree(self.x[self.bulk]).sparse_distance_matrix(self.tree, 2.0, output_type="ndarray")["v"]
        counts, _ = np.histogram(near, edges)
        peak = np.argmax(counts/np.diff(edges**2))
        return Measured(float(edges[peak] + 0.05), 0.05)

    @property
    def pairing(self) -> Measured:
        """Median of second over first neighbour distance; partners of a pair are one sample."""
        distances, _ = self.tree.query(self.x[self.bulk], 3)
        _, first, second = np.transpose(distances)
        low, middle, high = np.quantile(second/first, 0.5 + 0.98/sqrt(len(first)/2)*np.array([-1, 0, 1]))
        return Measured(float(middle), float(high - low)/2)

    @property
    def occupancy(self) -> float:
        """Particles a site: bulk particles joined with those closer than half a spacing."""
        return 1 + float(np.median(self.tree.query_ball_point(self.x[self.bulk], 0.5, return_length=True) - 1))

    @property
    def noise(self) -> np.ndarray:
        """(n, 2): v - <v>."""
        return self.v[:self.n] - self.smoothed


def snapshot(tables: Tables, point: dict) -> Snapshot:
    """The particles of the first seed that kept them."""
    frame = select(tables, "particles", **point)
    frame = frame[frame["seed"] == frame["seed"].min()]
    frame = pd.concat([frame[frame["kind"] == "fluid"], frame[frame["kind"] != "fluid"]])
    height = float(point["resolution"])
    return Snapshot(frame[["x", "y"]].to_numpy(float)*height, frame[["vx", "vy"]].to_numpy(float),
                    int((frame["kind"] == "fluid").sum()), height)


# --- fields -----------------------------------------------------------------------------------------------

def fields(tables: Tables, point: dict, finest: bool = False) -> Fields:
    """rho, T, vx, vy (rows, columns) on the places of Fig. 12, shifted along x so that warm fluid rises at column 0."""
    where = {k: v for k, v in point.items() if not (finest and k == "resolution")}
    frame = select(tables, "fields", **where)
    frame = frame[(frame["resolution"] == frame["resolution"].max()) & (frame["seed"] == frame["seed"].min())]
    shape = frame["y"].nunique(), frame["x"].nunique()
    frame = frame.sort_values(["y", "x"])
    return upright({name: frame[name].to_numpy(float).reshape(shape) for name in ("rho", "T", "vx", "vy")})


def difference(one: Fields, other: Fields, names: tuple[str, ...]) -> Measured:
    """Root mean square of one - other over places, summed over the named fields.

    Both flows are symmetric in the mirror; what is not symmetric in the difference is noise, and as much of it is in
    the symmetric part: that is the error.
    """
    if one["T"].shape != other["T"].shape:
        raise CannotTell(f"fields are kept on {one['T'].shape} and {other['T'].shape} places: nothing to compare")
    a, b = ({name: at[name] - reference[name] for name in names}
            for at, reference in ((one, other), (mirrored(one), mirrored(other))))
    even, odd = (sqrt(sum(np.mean(((a[name] + sign*b[name])/2)**2) for name in names)) for sign in (1, -1))
    return Measured(even, odd)


def one_seed(tables: Tables, particles: dict) -> float:
    """Relative 95 % interval with which K of one seed, whose fields are kept, stands for the point.

    The scatter of Kg between seeds with its t factor, and the error of their mean, to which that of the time step belongs.
    """
    whole, seeds = mean(tables, particles, "ke_field"), select(tables, "kinetic_energy", **particles)["ke_field"].dropna()
    if len(seeds) < 2:
        raise CannotTell("one seed was run: there is no error bar without a second")
    return hypot(float(stdtrit(len(seeds) - 1, 0.975)*seeds.std(ddof=1)), whole.err)/whole.value


def moved(tables: Tables, particles: dict, at: Fields, names: tuple[str, ...]) -> float:
    """How far the named fields may lie in other seeds: rms over places, summed over the fields.

    A relative error d of K moves velocities by d/2; what they carry is taken to move in proportion to its distance from the
    motionless state, rho = 1, T = 1 - y/L.
    """
    y = (np.arange(len(at["T"])) + 0.5)[:, None]/len(at["T"]) - 0.5
    rest = {"rho": 1.0, "T": 1 - y, "vx": 0.0, "vy": 0.0}
    return one_seed(tables, particles)/2*sqrt(sum(np.mean((at[name] - rest[name])**2) for name in names))


def velocity_error(tables: Tables, particles: dict, grid: dict) -> Measured:
    """Rms difference of velocity fields over the grid's rms velocity."""
    one, other = fields(tables, particles), fields(tables, grid, finest=True)
    size, found = sqrt(np.mean(other["vx"]**2 + other["vy"]**2)), difference(one, other, ("vx", "vy"))
    return Measured(found.value/size, hypot(found.err, moved(tables, particles, one, ("vx", "vy")))/size)


def contour_error(tables: Tables, particles: dict, grid: dict, name: str) -> Measured:
    """Rms difference of a field over the range that the grid's has."""
    one, other = fields(tables, particles), fields(tables, grid, finest=True)
    size, found = float(np.ptp(other[name])), difference(one, other, (name,))
    return Measured(found.value/size, hypot(found.err, moved(tables, particles, one, (name,)))/size)


def along(at: Fields, row: int) -> Fields:
    """Only one row of places."""
    return {name: f[[row]] for name, f in at.items()}


def edge_error(tables: Tables, particles: dict, grid: dict, name: str) -> Measured:
    """The same over the places next to a plate, of both plates the worse one."""
    one, other = fields(tables, particles), fields(tables, grid, finest=True)
    size, seeds = float(np.ptp(other[name])), moved(tables, particles, one, (name,))
    found = [difference(along(one, row), along(other, row), (name,)) for row in (0, -1)]
    return largest([Measured(at.value/size, hypot(at.err, seeds)/size) for at in found])
