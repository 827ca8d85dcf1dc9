"""Tables of cost, the names of methods in them, which `studies.build.names` explains, and derived rows.

CPU seconds of one thread; errors relative; `_err`: half width of a 95 % interval. resolution: points to the
wavelength (taylor-green, sound) or rows to the height.
"""
from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.fits import crossing, power_law
from studies.kit.stats import Measured, seed_means, with_errors
from studies.kit.store import RESULTS
from studies.kit.table import Row, Rows, Table, Tables, groups, read

GRID = "grid"
MAC = "mac"
PYPDE = "py-pde"
SPECTRAL = "spectral-gas"
NEAREST = "fixed-lattice-h1.2"
LATTICE = "fixed-lattice"
WIDE = "fixed-lattice-h3"
FIXED = NEAREST, LATTICE, WIDE, "fixed-jittered-plates"
LUCY = "spam"
MOVING = "moving"
CARRIED = "moving-delaunay"
#: scene of another fluid, which `bench` runs; LAMMPS' styles there -> their names here
BOUSSINESQ, LAMMPS = "boussinesq", {"sph": "LAMMPS sph", "rheo": "LAMMPS RHEO"}
METHODS = (GRID, MAC, PYPDE, SPECTRAL, *FIXED, "fixed-jittered-delaunay", "fixed-jittered-0.2-plates", LUCY,
           "spam-monaghan", "spam-wendland-c2", "spam-less-static-50", "spam-corrected", "spam-sumB", CARRIED,
           MOVING, *LAMMPS.values())

RUN = "scene method resolution seed"
SERIES = "scene quantity method"
COUNT = {"points": ("number of points, of cells or of functions", ""),
         "resolution": ("points to the wavelength (taylor-green, sound) or rows to the height, of "
                        "spectral-gas functions along an axis", "")}
SECONDS = {"cpu_s": ("CPU seconds of all steps and of setting up; of LAMMPS 90 free-fall times", "s")}
POINTS = Table.of(
    "points", f"{SERIES} resolution", "points seeds error error_err cpu_s cpu_s_err setup_s",
    means=COUNT | SECONDS, about="Error against cost, means over seeds; boussinesq is from bench.")
TABLES = (
    Table.of("runs", RUN, "points of_limit dt steps run_s run_s_err setup_s setup_s_err", means=COUNT,
             about="The run at the method's own best step (py-pde's by formula)."),
    Table.of("errors", f"{RUN} quantity", "error error_err share", about="An error of that run.",
             means=COUNT | {"share": ("share of the steps that this quantity needs", "")}),
    Table.of("steps", f"{RUN} quantity of_limit", "time_error space_error accepted", large=True, means=COUNT,
             about="A trial of a step; of steps longer than one that is accepted the errors are from the "
                   "half of that one."),
    POINTS,
    Table.of("needed", f"{SERIES} level", "reached cpu_s low high points error",
             about="What it costs to come below a level of error and stay there.",
             means=COUNT | SECONDS | {
                 "reached": ("yes; at most: the coarsest run is below already; no", ""),
                 "error": ("the level; of those that do not reach it the least error", "")}),
    Table.of("rivals", "scene quantity", "rival error points points_err seconds seconds_err",
             about="The printed particles where their error is least, over the grid with that error.",
             means={"points": ("number of points over that of the rival with the same error", "")}),
    Table.of("growth", "method points threads clock", "step_s step_s_err", means=COUNT,
             about="Seconds of a step by number of particles."),
    Table.of("memory", "method points", "resident", about="Memory of a process by number of particles.",
             means=COUNT | {"resident": ("resident bytes in a step", "B")}),
    Table.of("growth_laws", "method what least", "most value value_err", about="How these seconds grow.",
             means={"what": ("exponent: d ln(seconds of a step)/d ln(particles); two threads: how much "
                             "faster than one", "")}),
)

# --- what follows from them ------------------------------------------------------------------------------

#: main quantity of each scene
FIELD = {
    "convection": "K",
    "taylor-green": "velocity",
    "sound": "velocity",
    "conduction": "temperature",
    "couette": "velocity",
}
LEVELS = (0.1, 0.03, 0.01, 0.001)
LEAST = 3           # least number of sizes for an exponent
A_RUN, A_SERIES = RUN.split(), SERIES.split()
RUNG = ["scene", "method", "resolution"]
MEANS = ("error", "cpu_s", "setup_s", "points")


def derived(tables: Tables) -> Rows:
    """Derived rows of the study."""
    rows: dict[str, list[Any]] = {}
    if "growth" in tables:
        rows["growth_laws"] = list(growth_laws(tables["growth"]))
    if {"errors", "runs"} <= tables.keys():
        ours = over_seeds(tables["errors"], tables["runs"], tables.get("steps", pd.DataFrame()))
        points = pd.concat([ours, pd.DataFrame(lammps())])
        rows |= {"points": points.to_dict("records"), "needed": list(needed(points)),
                 "rivals": list(rivals(points))}
    return rows


def over_seeds(errors: pd.DataFrame, runs: pd.DataFrame, steps: pd.DataFrame) -> pd.DataFrame:
    """Means over seeds, at resolutions where no seed diverged. Their intervals include the error of time."""
    diverged = errors.quantity.eq("diverged").groupby([errors[name] for name in RUNG]).transform("any")
    rows = with_steps(errors[~diverged], steps).merge(runs, on=A_RUN)
    rows = rows.assign(error=rows.error.abs(), cpu_s=rows.share*rows.run_s + rows.setup_s,
                       cpu_s_err=np.hypot(rows.share*rows.run_s_err, rows.setup_s_err))
    means = seed_means(rows, [*A_SERIES, "resolution"], MEANS)
    return pd.DataFrame(means, columns=list(POINTS.columns))


def with_steps(errors: pd.DataFrame, steps: pd.DataFrame) -> pd.DataFrame:
    """Errors whose intervals include the change when the chosen step is halved."""
    if steps.empty:
        return errors
    key = [*A_RUN, "quantity"]
    good = steps.query("accepted == 1").sort_values("of_limit")
    chosen = good.drop_duplicates(key, keep="last")
    rows = errors.merge(chosen[[*key, "time_error"]], on=key, how="left")
    err = np.hypot(rows.error_err, rows.time_error.fillna(0))
    return rows.assign(error_err=err).drop(columns="time_error")


def lammps() -> Iterator[Row]:
    """K of LAMMPS' convection of a Boussinesq fluid, against that of the spectral one; one seed."""
    if not (path := RESULTS/"bench"/"lammps.csv").exists():
        return
    table = read(path)
    table = table[table["style"].isin(LAMMPS) & table.quantity.isin(["K", "seconds"])]
    for (style, rows), pair in groups(table, ["style", "rows"]):
        if len(pair) == 2:
            (_, K), (_, seconds) = pair.sort_values("quantity").iterrows()
            error = Measured(K.value, K.err)/K.expected - 1
            yield {"scene": BOUSSINESQ, "quantity": "K", "method": LAMMPS[style], "resolution": rows,
                   "points": 2*rows**2, "seeds": 1, "setup_s": 0.0,
                   **with_errors(error=abs(error), cpu_s=Measured(seconds.value, seconds.err))}


def needed(points: pd.DataFrame) -> Iterator[Row]:
    """What every level of error costs with every method."""
    for (key, group), level in product(groups(points, A_SERIES), LEVELS):
        yield {**dict(zip(A_SERIES, key)), "level": level, **reached(group.sort_values("resolution"), level)}


def reached(group: pd.DataFrame, level: float) -> Row:
    """Cost at which errors of rising resolutions fall below a level for good, by a power law between two.

    An error smaller than its uncertainty is replaced by it: an error that changes sign is small by chance.
    """
    group = group.assign(error=group[["error", "error_err"]].max(axis=1), points_err=0.0)
    below = (group.error <= level)[::-1].cummin().sum()
    if below == 0:
        return {"reached": "no", "error": group.error.min()}
    if below == len(group):
        first = group.iloc[0]
        most = first.cpu_s + first.cpu_s_err
        return {"reached": "at most", "low": 0.0, "high": most} | dict(first[["cpu_s", "points", "error"]])
    pair = group.iloc[-below - 1:].head(2)
    seconds, half = crossing(pair, "cpu_s", level)
    points, _ = crossing(pair, "points", level)
    low, high = seconds*np.exp([-half, half])
    return {"reached": "yes", "cpu_s": seconds, "low": low, "high": high, "points": points, "error": level}


def rivals(points: pd.DataFrame) -> Iterator[Row]:
    """Cost of printed particles over that of the grid of each scene; no row where they beat all grids."""
    for scene, quantity in FIELD.items():
        here = points.query("scene == @scene and quantity == @quantity").sort_values("error")
        grids, particles = (here[here.method == method] for method in (GRID, LUCY))
        if particles.error.min() >= grids.error.min():      # false where there are none of them
            row = particles.iloc[0]
            number, seconds = (over_rival(row, grids, column) for column in ("points", "cpu_s"))
            yield {"scene": scene, "quantity": quantity, "rival": GRID, "error": row.error,
                   **with_errors(points=number, seconds=seconds)}


def over_rival(best: pd.Series, grids: pd.DataFrame, column: str) -> Measured:
    """`column` of a run over that of a grid with the same error, by a power law between its resolutions.

    Where already the coarsest grid is better, over that of the coarsest grid: a lower bound of the ratio.
    """
    x, y = np.log(grids[["error", column]].to_numpy(float)).T
    rival = np.interp(np.log(best.error), x, y)
    slope = np.gradient(y, x).min() if len(x) > 1 else 0.0
    ratio = float(best[column]/np.exp(rival))
    return Measured(ratio, abs(ratio*slope*best.error_err/best.error))


def growth_laws(growth: pd.DataFrame) -> Iterator[Row]:
    """Exponents of the seconds of a step over the number of points, and speed-ups by two threads."""
    for method, group in groups(growth.query("clock == 'cpu'"), "method"):
        if len(group) >= LEAST:
            yield growth_law(method, "exponent", group, power_law(group.points, group.step_s).slope)
    wall = growth.query("clock == 'wall'").sort_values("threads")
    for (method, _), group in groups(wall, ["method", "points"]):
        if list(group.threads) == [1, 2]:
            one, two = map(Measured, group.step_s, group.step_s_err)
            yield growth_law(method, "two threads", group, one/two)


def growth_law(method: str, what: str, group: pd.DataFrame, law: Measured) -> Row:
    """A row of the table `growth_laws`."""
    return {"method": method, "what": what, "least": group.points.min(), "most": group.points.max(),
            **with_errors(value=law)}
