"""What particles and mean fields at the end of runs tell: rows of `snapshots` and `field_errors`."""
from collections.abc import Iterable, Iterator, Sequence
from math import hypot, inf, nan, sqrt
from typing import Any

import numpy as np
import pandas as pd
from scipy.sparse import csr_array
from scipy.spatial import cKDTree
from scipy.special import stdtrit

from continuum.fluid import stress_tensor
from studies.build.measure import Fields, mirrored, upright
from studies.build.snapshot import RANGE, Snapshot
from studies.kit.ask import NoRows, rows
from studies.kit.stats import CannotTell, Measured, combine, over_seeds
from studies.kit.table import Tables
from studies.rb.runs.few_particles import lucy
from studies.rb.tables import POINT, SCENE

Point = dict[str, Any]


def snapshots(tables: Tables) -> Iterator[dict[str, Any]]:
    """One row for each point of `particles`, of the first seed that kept any."""
    frame = tables.get("particles", pd.DataFrame(columns=[*POINT, "seed"]))
    for key, runs in frame.groupby(POINT):
        point: Point = dict(zip(POINT, key, strict=True))
        run = first_seed(runs)
        fluid = run["kind"] == "fluid"
        at = snapshot(pd.concat([run[fluid], run[~fluid]]), fluid.sum())
        T = run["T"][fluid].to_numpy(float)
        columns = {"neighbours": at.neighbours, "spacing": at.spacing, "pairing": at.pairing,
                   "newtonian": newtonian(at, point, T)}
        yield point | with_errors(columns) | {"occupancy": at.occupancy, "fastest": at.fastest}


def first_seed(runs: pd.DataFrame) -> pd.DataFrame:
    """Rows of the first seed that kept any."""
    return runs[runs["seed"] == runs["seed"].min()]


def with_errors(columns: dict[str, Measured]) -> dict[str, float]:
    """Each column and its `_err`."""
    row: dict[str, float] = {}
    for name, (value, err) in columns.items():
        row |= {name: value, f"{name}_err": err}
    return row


def snapshot(run: pd.DataFrame, n: int) -> Snapshot:
    """Particles, the `n` of the fluid first."""
    height = float(run["resolution"].iloc[0])
    x = run[["x", "y"]].to_numpy(float)*height
    v = run[["vx", "vy"]].to_numpy(float)
    return Snapshot(x, v, int(n), height)


def newtonian(at: Snapshot, point: Point, T: np.ndarray) -> Measured:
    """Correlation of the accelerations with those of the potential 2 P n^-2 w    [KHP95, Sec. VII]

    Within layers of twice the range of the weight. Particles in range of each other are not independent, so
    each layer is one sample. For the ideal gas with Lucy's weight; not a number elsewhere, and where no two
    layers fit.
    """
    inner = at.height/2 - 3*RANGE
    if (point["variant"], point["eos"]) != ("printed", "ideal") or inner < 2*RANGE:
        return Measured(nan, nan)
    x, v = at.x[:at.n], at.v[:at.n]
    eta = at.height/sqrt(point["ra"])
    real, simple = accelerations(x, v, T, eta, 2*at.height)
    edges = np.arange(-inner, inner + 1e-9, 2*RANGE)
    layer = np.digitize(x[:, 1], edges)
    samples = []
    for number in range(1, layer.max()):
        inside = layer == number
        samples.append((correlation(real[inside], simple[inside]), 0.0))
    return combine(samples)


def accelerations(x: np.ndarray, v: np.ndarray, T: np.ndarray, eta: float,
                  width: float) -> tuple[np.ndarray, np.ndarray]:
    """(n, 2) each: -sum [(P/rho^2)_i + (P/rho^2)_j].grad w of the viscous ideal gas, and -sum 2 grad w (P = n
    = 1).

    Periodic in x, nothing beyond the plates: right from three ranges off them.
    """
    n = len(x)
    i, j, r = pairs_in_range(x, width)
    w, slope = lucy(r)
    rho = np.bincount(i, w, n)
    d = x[i] - x[j]
    d[:, 0] -= width*np.round(d[:, 0]/width)
    grad = [csr_array((slope*q, (i, j)), shape=(n, n)) for q in d.T]
    whole = np.stack([G@np.ones(n) for G in grad], axis=1)
    root = np.sqrt(rho)[:, None]
    grad_v = np.stack([(G@(v/root) - v*(G@(1/root)))/root for G in grad], axis=1)
    stress = stress_tensor(eta, 0.0, grad_v)
    P = ((rho*T)[:, None, None]*np.eye(2) - stress)/rho[:, None, None]**2
    own = np.einsum("iab,ib->ia", P, whole)
    force = own + sum(G@P[:, :, axis] for axis, G in enumerate(grad))
    return -force, -2*whole


def pairs_in_range(x: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Numbers i, j of both particles and their distance, each pair twice; periodic in x alone."""
    across, up = x.T
    height = np.ptp(up)
    inside = np.stack([np.mod(across, width), up - up.min()], axis=1)
    box = np.array([width, 10*height + 10*RANGE])
    tree = cKDTree(inside, boxsize=box)
    near = tree.sparse_distance_matrix(tree, RANGE, output_type="ndarray")
    return near["i"], near["j"], near["v"]


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Of two fields of vectors (n, 2) less their means: the mean upwards bears the weight of the fluid."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return float(np.sum(a*b)/sqrt(np.sum(a*a)*np.sum(b*b)))


#: plate -> how rows of places are counted from it
PLATES = {"lower": 1, "upper": -1}
EVERYWHERE = slice(None)
GRID = {"method": "compressible", "variant": "flux-form"}


def field_errors(tables: Tables, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row for each point of particles in `fields` of which the finest grid has the same flow."""
    frame = tables.get("fields", pd.DataFrame(columns=[*POINT, "seed"]))
    tables = Tables({**tables, "means": means})
    for key, runs in frame[frame["method"] == "spam"].groupby(POINT):
        point: Point = dict(zip(POINT, key, strict=True))
        run = first_seed(runs)
        grid: Point = {name: point[name] for name in SCENE} | GRID
        try:
            cells = rows(tables, "fields", **grid)
            ours = rows(tables, "kinetic_energy", **point, seed=run["seed"].iloc[0])
            theirs = rows(tables, "means", **grid, resolution=inf)
        except NoRows:
            continue
        finest = cells[cells["resolution"] == cells["resolution"].max()]
        same_flow = {*ours["rolls"]} == {*theirs["rolls"]}
        if same_flow and len(run) == len(finest):
            errors = errors_of(tables, point, fields(run), fields(finest))
            yield point | with_errors(errors)


def fields(run: pd.DataFrame) -> Fields:
    """rho, T, vx, vy (rows, columns) on the places of Fig. 12; warm fluid rises at column 0."""
    names = ["rho", "T", "vx", "vy"]
    places = run.pivot(index="y", columns="x", values=names)
    return upright({name: places[name].to_numpy(float) for name in names})


def errors_of(tables: Tables, point: Point, ours: Fields, theirs: Fields) -> dict[str, Measured]:
    """Rms differences over places: of velocities over the grid's rms velocity, of others over its range."""
    relative = one_seed(tables, point)
    span = {name: float(np.ptp(theirs[name])) for name in ("rho", "T")}
    speed = sqrt(np.mean(theirs["vx"]**2 + theirs["vy"]**2))

    def error(names: Sequence[str], size: float, at: slice = EVERYWHERE) -> Measured:
        apart = difference(ours, theirs, names, at)
        others = relative/2*from_rest(ours, names)
        return Measured(apart.value/size, hypot(apart.err, others)/size)
    at_plates = [error(["rho"], span["rho"], at) for at in (slice(1), slice(-1, None))]
    return {
        "velocity": error(["vx", "vy"], speed),
        "T": error(["T"], span["T"]),
        "rho": error(["rho"], span["rho"]),
        "rho_plates": worse(at_plates),
        "rho_layer": layer_error(tables, point, theirs),
    }


def worse(errors: Iterable[Measured]) -> Measured:
    """The largest value with the largest error."""
    values, errs = zip(*errors, strict=True)
    return Measured(max(values), max(errs))


def difference(one: Fields, other: Fields, names: Sequence[str], at: slice = EVERYWHERE) -> Measured:
    """Root mean square of one - other over places, in some rows of them, summed over the named fields.

    Both flows are symmetric in the mirror; what is not symmetric in the difference is noise, and as much of
    it is in the symmetric part: that is the error.
    """
    apart = {name: one[name] - other[name] for name in one}
    image = mirrored(apart)
    even, odd = 0.0, 0.0
    for name in names:
        here, there = apart[name][at], image[name][at]
        even += float(np.mean(((here + there)/2)**2))
        odd += float(np.mean(((here - there)/2)**2))
    return Measured(sqrt(even), sqrt(odd))


def from_rest(at: Fields, names: Sequence[str]) -> float:
    """Rms distance of fields from the motionless state, rho = 1, T = 1 - y/L, over places, summed over the
    fields.

    A relative error d of K moves velocities by d/2; what they carry is taken to move in proportion to this
    distance.
    """
    y = (np.arange(len(at["T"])) + 0.5)[:, None]/len(at["T"]) - 0.5
    rest = {"rho": 1.0, "T": 1 - y, "vx": 0.0, "vy": 0.0}
    return sqrt(sum(np.mean((at[name] - rest[name])**2) for name in names))


def one_seed(tables: Tables, point: Point) -> float:
    """Relative 95 % interval with which K of one seed, whose fields are kept, stands for the point.

    The scatter of Kg between seeds with its t factor, and the error of their mean, to which that of the time
    step belongs. Not a number with one seed.
    """
    whole = rows(tables, "means", **point).iloc[0]
    seeds = rows(tables, "kinetic_energy", **point)["ke_field"].dropna()
    if len(seeds) < 2:
        return nan
    scatter = float(stdtrit(len(seeds) - 1, 0.975)*seeds.std(ddof=1))
    return hypot(scatter, whole["ke_field_err"])/whole["ke_field"]


def layer_error(tables: Tables, point: Point, cells: Fields) -> Measured:
    """Largest |rho - rho_grid| within one spacing of a plate, horizontal mean, over the grid's range."""
    try:
        layers = rows(tables, "walls", **point)
        apart = []
        for plate, seeds in layers.groupby("plate"):
            beside = density_beside(cells, PLATES[str(plate)])
            apart.append(abs(over_seeds(seeds["rho_layer"] - beside)))
        largest = worse(apart)
    except CannotTell:
        return Measured(nan, nan)
    span = float(np.ptp(cells["rho"]))
    return Measured(largest.value/span, largest.err/span)


def density_beside(at: Fields, side: int) -> float:
    """The grid's mean density half a spacing of 50 rows from a plate, by a line through two places."""
    mean = at["rho"].mean(axis=1)[::side]
    places = len(mean)*0.5/50 - 0.5       # from the first place, in distances of places
    return float(mean[0] + places*(mean[1] - mean[0]))
