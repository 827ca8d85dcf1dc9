"""Rows of `snapshots` and `field_errors`, from particles and mean fields at the end of runs."""
from collections.abc import Iterator, Sequence
from math import hypot, inf, nan, sqrt
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from continuum.fluid import ConstEta
from particles.weights import Lucy
from studies.build.measure import RANGE, Fields, Snapshot, mirrored, upright
from studies.build.spam import fluid
from studies.kit.ask import picked, rows, top
from studies.kit.stats import CannotTell, Measured, combine, over_seeds, with_errors
from studies.kit.table import Tables
from studies.rb.looks import GRID, finest
from studies.rb.runs.few_particles import RHO_SQUARED, rates
from studies.rb.tables import POINT, SCENE, Point
from studies.rb.tables import rows as rows_of


def snapshots(tables: Tables) -> Iterator[dict[str, Any]]:
    """One row for each point of `particles`."""
    for point, run in kept(tables, "particles"):
        run = run.sort_values("kind", key=lambda kind: kind != "fluid", kind="stable")
        n, height = (run.kind == "fluid").sum(), run.resolution.iloc[0]
        x, v, T = height*run[["x", "y"]].to_numpy(), run[["vx", "vy"]].to_numpy(), run["T"].to_numpy()
        at = Snapshot(x, v, n, height)
        columns = with_errors(neighbours=at.neighbours, spacing=at.spacing, pairing=at.pairing,
                              newtonian=newtonian(at, point, T[:n]))
        yield point | columns | {"occupancy": at.occupancy, "fastest": at.fastest}


def kept(tables: Tables, name: str) -> Iterator[tuple[Point, pd.DataFrame]]:
    """Each point of a table, with the rows of the first seed that has any."""
    for key, runs in rows_of(tables, name).groupby(POINT):
        yield dict(zip(POINT, key)), runs[runs.seed == runs.seed.min()]


def newtonian(at: Snapshot, point: Point, T: np.ndarray) -> Measured:
    """Correlation of the accelerations with those of the potential 2 P n^-2 w    [KHP95, Sec. VII]

    Within layers of twice the range of the weight, three ranges off the plates, beyond which the box repeats.
    Particles in range of each other are not independent, so each layer is one sample. For the ideal gas with
    Lucy's weight; not a number elsewhere, and where no two layers fit.
    """
    inner = at.height/2 - 3*RANGE
    if (point["variant"], point["eos"]) != ("printed", "ideal") or inner < 2*RANGE:
        return Measured(nan, nan)
    eta, box = at.height/sqrt(point["ra"]), (2*at.height, at.height)
    gas = fluid(Lucy.of(RANGE), box, law=ConstEta(eta, eta))
    molecules = fluid(Lucy.of(RANGE), box, RHO_SQUARED)
    x, v = at.x[:at.n].T, at.v[:at.n].T
    real, simple = (rates(method, np.array([*x, *v, e]))[2:4].T
                    for method, e in ((gas, T), (molecules, 1e3*T)))
    layer = np.digitize(x[1], np.arange(-inner, inner + 1e-9, 2*RANGE))
    inside = (layer == number for number in range(1, layer.max()))
    return combine([(correlation(real[some], simple[some]), 0.0) for some in inside])


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Correlation of two vector fields (n, 2) less their means, which bear the weight of the fluid."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    return float(np.sum(a*b)/sqrt(np.sum(a*a)*np.sum(b*b)))


def field_errors(tables: Tables, means: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row for each point of particles in `fields` of which the finest grid has the same flow."""
    tables = Tables({**tables, "means": means})
    for point, run in kept(tables, "fields"):
        grid = {name: point[name] for name in SCENE} | GRID
        cells = finest(rows_of(tables, "fields", **grid))
        ours = rows_of(tables, "kinetic_energy", **point, seed=run.seed.iloc[0])
        theirs = rows_of(tables, "means", **grid, resolution=inf)
        alike = ours.rolls.isin(theirs.rolls).any() and len(run) == len(cells)
        if alike and point["method"] in ("spam", "dih"):
            yield point | with_errors(**errors_of(tables, point, fields(run), fields(cells)))


def fields(run: pd.DataFrame) -> Fields:
    """rho, T, vx, vy (rows, columns) on the places of Fig. 12; warm fluid rises at column 0."""
    places = run.pivot(index="y", columns="x")
    return upright({name: places[name].to_numpy(float) for name in ("rho", "T", "vx", "vy")})


def errors_of(tables: Tables, point: Point, ours: Fields, theirs: Fields) -> dict[str, Measured]:
    """Rms differences over places: of velocities over the grid's rms velocity, of others over its range."""
    relative = one_seed(tables, point)
    rho, T = (np.ptp(theirs[name]) for name in ("rho", "T"))
    speed = sqrt(np.mean(theirs["vx"]**2 + theirs["vy"]**2))

    def error(size: float, *names: str, at: Any = ...) -> Measured:
        of_seeds = Measured(0.0, relative/2*from_rest(ours, names))
        return (difference(ours, theirs, names, at) + of_seeds)/size
    return {
        "velocity": error(speed, "vx", "vy"), "T": error(T, "T"), "rho": error(rho, "rho"),
        "rho_plates": picked(top, [error(rho, "rho", at=at) for at in (slice(1), slice(-1, None))]),
        "rho_layer": layer_error(tables, point, theirs)}


def difference(one: Fields, other: Fields, names: Sequence[str], at: Any) -> Measured:
    """Root mean square of the mirror-symmetric part of one - other, over some rows, summed over named fields.

    Both flows are symmetric in the mirror: the other part of the difference is noise, of which the symmetric
    part holds as much. It is the error.
    """
    apart = {name: one[name] - other[name] for name in one}
    image = mirrored(apart)
    both = np.array([[apart[name][at], image[name][at]] for name in names])
    even, odd = both.sum(axis=1)/2, np.diff(both, axis=1)/2
    return Measured(sqrt(len(names)*np.mean(even**2)), sqrt(len(names)*np.mean(odd**2)))


def from_rest(at: Fields, names: Sequence[str]) -> float:
    """Rms distance of fields from the motionless state, rho = 1, T = 1 - y/L, over places, summed over them.

    A relative error d of K moves velocities by d/2; what they carry is taken to move in this proportion.
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
    seeds = rows(tables, "kinetic_energy", **point).ke_field.dropna()
    if len(seeds) < 2:
        return nan
    scatter = stdtrit(len(seeds) - 1, 0.975)*seeds.std()
    return hypot(scatter, whole.ke_field_err)/whole.ke_field


def layer_error(tables: Tables, point: Point, cells: Fields) -> Measured:
    """Largest |rho - rho_grid| within one spacing of a plate, horizontal mean, over the grid's range."""
    try:
        layers = rows(tables, "walls", "rho_layer == rho_layer", **point).groupby("plate").rho_layer
        apart = [abs(over_seeds(seeds - density_beside(cells, plate))) for plate, seeds in layers]
    except CannotTell:      # one seed, or points on a triangulation, which have a row on the plate
        return Measured(nan, nan)
    return picked(top, apart)/np.ptp(cells["rho"])


def density_beside(at: Fields, plate: Any) -> float:
    """The grid's mean density half a spacing of 50 rows from a plate, by a line through two places."""
    mean = at["rho"].mean(axis=1)[::1 if plate == "lower" else -1]
    places = len(mean)*0.5/50 - 0.5       # from the first place, in distances of places
    return mean[0] + places*(mean[1] - mean[0])  # type: ignore[no-any-return]
