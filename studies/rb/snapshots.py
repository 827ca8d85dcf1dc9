"""What particles and mean fields at the end of runs tell: rows of `snapshots` and `field_errors`."""
from collections.abc import Iterator, Sequence
from math import hypot, inf, sqrt
from typing import Any

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree
from scipy.special import stdtrit

from continuum.fluid import stress_tensor
from studies.build.measure import Fields, mirrored, upright
from studies.build.snapshot import RANGE, Snapshot
from studies.kit.stats import Measured, combine, over_seeds
from studies.kit.table import Tables
from studies.rb.flows import grid
from studies.rb.runs.few_particles import lucy
from studies.rb.tables import POINT

Point = dict[str, Any]


def at_point(frame: pd.DataFrame, point: Point) -> pd.DataFrame:
    """Rows of a point, or of the columns of it that are named."""
    same = [frame[name] == value for name, value in point.items()]
    return frame[np.logical_and.reduce(same)]


def first_seed(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows of the first seed that kept any."""
    return frame[frame["seed"] == frame["seed"].min()]


def pair(name: str, found: Measured) -> dict[str, float]:
    """A column and its error."""
    return {name: found.value, f"{name}_err": found.err}


# --- particles ------------------------------------------------------------------------------------


def snapshots(tables: Tables) -> Iterator[dict[str, Any]]:
    """One row for each point of `particles`."""
    frame = tables.get("particles", pd.DataFrame(columns=POINT))
    for key, rows in frame.groupby(POINT):
        point = dict(zip(POINT, key, strict=True))
        fluid_first = first_seed(rows).sort_values("kind", key=lambda kind: kind != "fluid", kind="stable")
        at = snapshot(fluid_first)
        yield {**point, **pair("neighbours", at.neighbours), **pair("spacing", at.spacing),
               **pair("pairing", at.pairing), "occupancy": at.occupancy, "fastest": at.fastest,
               **pair("newtonian", newtonian(at, point, fluid_first))}


def snapshot(rows: pd.DataFrame) -> Snapshot:
    """Particles, the fluid's first."""
    height = float(rows["resolution"].iloc[0])
    x, v = rows[["x", "y"]].to_numpy(float)*height, rows[["vx", "vy"]].to_numpy(float)
    return Snapshot(x, v, int((rows["kind"] == "fluid").sum()), height)


def newtonian(at: Snapshot, point: Point, rows: pd.DataFrame) -> Measured:
    """Correlation of the accelerations with those of the potential 2 P n^-2 w    [KHP95, Sec. VII]

    Within layers of twice the range of the weight. Particles in range of each other are not independent, so each layer
    is one sample. For the ideal gas with Lucy's weight; not a number elsewhere, and where no two layers fit.
    """
    inner = at.height/2 - 3*RANGE
    if (point["variant"], point["eos"]) != ("printed", "ideal") or inner < 2*RANGE:
        return Measured(np.nan, np.nan)
    eta, T = at.height/sqrt(point["ra"]), rows["T"].to_numpy(float)[:at.n]
    real, simple = accelerations(at.x[:at.n], at.v[:at.n], T, eta, 2*at.height)
    layer = np.digitize(at.x[:at.n, 1], np.arange(-inner, inner + 1e-9, 2*RANGE))
    layers = [layer == i for i in range(1, layer.max())]
    return combine([(correlation(real[inside], simple[inside]), 0.0) for inside in layers])


def accelerations(x: np.ndarray, v: np.ndarray, T: np.ndarray, eta: float,
                  width: float) -> tuple[np.ndarray, np.ndarray]:
    """(n, 2) each: -sum [(P/rho^2)_i + (P/rho^2)_j].grad w of the viscous ideal gas, and -sum 2 grad w (P = n = 1).

    Periodic in x, nothing beyond the plates: right from three ranges off them.
    """
    n, tall = len(x), 10*np.ptp(x[:, 1]) + 10*RANGE
    at = np.stack([np.mod(x[:, 0], width), x[:, 1] - x[:, 1].min()], axis=1)
    tree = cKDTree(at, boxsize=np.array([width, tall]))
    near = tree.sparse_distance_matrix(tree, RANGE, output_type="ndarray")
    i, j = near["i"], near["j"]
    w, slope = lucy(near["v"])
    d = at[i] - at[j]
    d[:, 0] -= width*np.round(d[:, 0]/width)
    grad, rho = slope[:, None]*d, np.bincount(i, w, n)

    def total(terms: np.ndarray) -> np.ndarray:
        flat = terms.reshape(len(i), -1)
        sums = [np.bincount(i, column, n) for column in flat.T]
        return np.stack(sums, axis=1).reshape(n, *terms.shape[1:])

    dv = (v[j] - v[i])/np.sqrt(rho[i]*rho[j])[:, None]
    stress = stress_tensor(eta, 0.0, total(grad[:, :, None]*dv[:, None, :]))
    P = ((rho*T)[:, None, None]*np.eye(2) - stress)/rho[:, None, None]**2
    return -total(np.einsum("pab,pb->pa", P[i] + P[j], grad)), -total(2*grad)


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Of what two fields of vectors (n, 2) differ from their means: the mean upwards bears the weight of the fluid."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return float(np.sum(a*b)/sqrt(np.sum(a*a)*np.sum(b*b)))


# --- mean fields ----------------------------------------------------------------------------------


def field_errors(tables: Tables, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row for each point of particles in `fields` beside which the same flow of the finest grid stands."""
    frame = tables.get("fields", pd.DataFrame(columns=[*POINT, "seed"]))
    for key, rows in frame[frame["method"] == "spam"].groupby(POINT):
        point = dict(zip(POINT, key, strict=True))
        limit = {name: point[name] for name in ("eos", "transport", "sides", "ra", "pr")} | GRID
        cells = at_point(frame, limit)
        kept = first_seed(rows)
        if len(cells) and same_rolls(tables, means, point, int(kept["seed"].iloc[0]), limit):
            finest = cells["resolution"] == cells["resolution"].max()
            ours, theirs = fields(kept), fields(cells[finest])
            if ours["T"].shape == theirs["T"].shape:
                yield {**point, **errors_of(tables, means, point, ours, theirs)}


GRID = {name: grid(1.0)[name] for name in ("method", "variant")}


def same_rolls(tables: Tables, means: pd.DataFrame, point: Point, seed: int, limit: Point) -> bool:
    """Whether the run that kept its fields has the rolls of the grid's limit."""
    run = at_point(tables["kinetic_energy"], {**point, "seed": seed})
    cells = at_point(means, {**limit, "resolution": inf})
    return len(run) == len(cells) == 1 and int(run["rolls"].iloc[0]) == int(cells["rolls"].iloc[0])


def fields(rows: pd.DataFrame) -> Fields:
    """rho, T, vx, vy (rows, columns) on the places of Fig. 12, shifted along x so that warm fluid rises at column 0."""
    shape = rows["y"].nunique(), rows["x"].nunique()
    rows = rows.sort_values(["y", "x"])
    return upright({name: rows[name].to_numpy(float).reshape(shape) for name in ("rho", "T", "vx", "vy")})


def errors_of(tables: Tables, means: pd.DataFrame, point: Point, particles: Fields, cells: Fields) -> dict[str, float]:
    """Rms differences over places: of velocities over the grid's rms velocity, of the others over the grid's range."""
    seeds = one_seed(tables, means, point)
    speed = sqrt(np.mean(cells["vx"]**2 + cells["vy"]**2))
    span = float(np.ptp(cells["rho"]))

    def error(names: Sequence[str], size: float, rows: Sequence[int] = ()) -> Measured:
        apart = difference(along(particles, rows), along(cells, rows), names)
        others = seeds/2*from_rest(particles, names)
        return Measured(apart.value/size, hypot(apart.err, others)/size)
    at_plates = [error(["rho"], span, [row]) for row in (0, -1)]
    worse = Measured(max(one.value for one in at_plates), max(one.err for one in at_plates))
    return {**pair("velocity", error(["vx", "vy"], speed)), **pair("T", error(["T"], float(np.ptp(cells["T"])))),
            **pair("rho", error(["rho"], span)), **pair("rho_plates", worse),
            **pair("rho_layer", layer_error(tables, point, cells))}


def difference(one: Fields, other: Fields, names: Sequence[str]) -> Measured:
    """Root mean square of one - other over places, summed over the named fields.

    Both flows are symmetric in the mirror; what is not symmetric in the difference is noise, and as much of it is in
    the symmetric part: that is the error.
    """
    mirror_one, mirror_other = mirrored(one), mirrored(other)
    even, odd = 0.0, 0.0
    for name in names:
        a, b = one[name] - other[name], mirror_one[name] - mirror_other[name]
        even += np.mean(((a + b)/2)**2)
        odd += np.mean(((a - b)/2)**2)
    return Measured(sqrt(even), sqrt(odd))


def along(at: Fields, rows: Sequence[int]) -> Fields:
    """Only these rows of places; all if none is named."""
    return {name: f[list(rows)] if rows else f for name, f in at.items()}


def from_rest(at: Fields, names: Sequence[str]) -> float:
    """Rms distance of fields from the motionless state, rho = 1, T = 1 - y/L, over places, summed over the fields.

    A relative error d of K moves velocities by d/2; what they carry is taken to move in proportion to this distance.
    """
    y = (np.arange(len(at["T"])) + 0.5)[:, None]/len(at["T"]) - 0.5
    rest = {"rho": 1.0, "T": 1 - y, "vx": 0.0, "vy": 0.0}
    return sqrt(sum(np.mean((at[name] - rest[name])**2) for name in names))


def one_seed(tables: Tables, means: pd.DataFrame, point: Point) -> float:
    """Relative 95 % interval with which K of one seed, whose fields are kept, stands for the point.

    The scatter of Kg between seeds with its t factor, and the error of their mean, to which that of the time step
    belongs. Not a number with one seed.
    """
    whole = at_point(means, point).iloc[0]
    seeds = at_point(tables["kinetic_energy"], point)["ke_field"].dropna()
    if len(seeds) < 2:
        return np.nan
    scatter = float(stdtrit(len(seeds) - 1, 0.975)*seeds.std(ddof=1))
    return hypot(scatter, whole["ke_field_err"])/whole["ke_field"]


def layer_error(tables: Tables, point: Point, cells: Fields) -> Measured:
    """Largest |rho - rho_grid| within one spacing of a plate, horizontal mean, over the range of the grid's."""
    rows = at_point(tables["walls"], point) if "walls" in tables else pd.DataFrame()
    if rows.empty or rows["seed"].nunique() < 2:
        return Measured(np.nan, np.nan)
    rows = rows.assign(apart=rows["rho_layer"] - rows["plate"].map({plate: beside(cells, plate) for plate in PLATES}))
    plates = [abs(over_seeds(group["apart"])) for _, group in rows.groupby("plate")]
    span = float(np.ptp(cells["rho"]))
    return Measured(max(one.value for one in plates)/span, max(one.err for one in plates)/span)


PLATES = {"lower": 1, "upper": -1}


def beside(at: Fields, plate: str) -> float:
    """The grid's mean density half a spacing of 50 rows from a plate: the line through the two places next to it."""
    mean = at["rho"].mean(axis=1)[::PLATES[plate]]
    places = len(mean)*0.5/50 - 0.5       # from the first place, in distances of places
    return float(mean[0] + places*(mean[1] - mean[0]))
