"""Rows that follow from other rows: grids extrapolated, means over seeds, errors against the reference."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.build.names import one_energy
from studies.build.spam import variant_of
from studies.kit import fits
from studies.kit.stats import Measured, combine, with_errors
from studies.kit.table import Rows, Tables
from studies.rb.snapshots import field_errors, snapshots
from studies.rb.tables import POINT, SCENE, STILL
from studies.rb.tables import rows as rows_of

Row = dict[Any, Any]
GRIDS = ("compressible", "boussinesq", "pypde-compressible")
#: smooth particles that may have a limit
CORRECTED = ("sumB", "corrected", "CRKSPH", "MFM", "MFM-adiabatic", "sph-less-static",
             "transport-velocity-hydrostatic")
SERIES = [name for name in POINT if name != "resolution"]
ENERGIES = ["ke", "ke_field", "ke_mean", "nu"]
HALF = "-half-step"
#: ratio of finest to coarsest size above which a limit of points fits 1/rows^3, too: that of 80 and 25. Both
#: were set after a look: at 12 to 40 rows of moving points, then at lattices at rest, whose K has that power
COARSEST = 3.2
SAME_PATTERN = 0.1     # of the weaker over the stronger wave
#: columns of the finest run that an extrapolated row takes over, and sums of all
SAME = ["rolls", "free_fall", "converged", "threads"]
SPENT = ["cpu_s", "compile_s"]


def derive(tables: Tables) -> Rows:
    """All derived rows of the study."""
    if "kinetic_energy" not in tables:
        return {}
    every = pd.concat([tables[name] for name in ("kinetic_energy", "makers") if name in tables])
    runs = finite(every).dropna(subset="ke")
    limits = list(extrapolated(runs))
    all_runs = pd.concat([runs, pd.DataFrame(limits)], ignore_index=True)
    means = pd.DataFrame(over_seeds(all_runs))
    return {
        "kinetic_energy": limits,
        "means": means.to_dict("records"),
        "errors": errors(runs, means, tables).to_dict("records"),
        "snapshots": list(snapshots(tables)),
        "field_errors": list(field_errors(tables, means)),
        "three_dimensions": list(in_space(tables)),
    }


def finite(frame: pd.DataFrame) -> pd.DataFrame:
    """Rows that are not extrapolated."""
    return frame[np.isfinite(frame.resolution.astype(float))]


def extrapolated(runs: pd.DataFrame) -> Iterator[Row]:
    """Limits, rows `resolution = inf`, of series of three settled sizes or more with one number of rolls.

    Grids and lattices involve no chance. Where sets of points differ by chance, each run counts by itself.
    """
    settled = runs[runs.converged.astype(str) == "True"].sort_values("resolution")
    series = settled[settled.method.isin([*GRIDS, "dih"]) | settled.variant.isin(CORRECTED)]
    for point, group in series.groupby(SERIES, dropna=False):
        if group.resolution.nunique() < 3 or group.rolls.nunique() > 1:
            continue
        limit = grid_limit if group.resolution.is_unique else line_limit
        yield {**dict(zip(SERIES, point)), "resolution": np.inf, "seed": 0, "particles": 0,
               **one_energy(*limit(group, "ke")), **with_errors(nu=limit(group, "nu")),
               **group[SAME].iloc[-1], **group[SPENT].sum()}


def grid_limit(group: pd.DataFrame, name: str) -> Measured:
    """Extrapolated value; its error has a part of the grid and one of the values' own (in time)."""
    even = (group.method == "boussinesq").all()     # of others errors have odd powers, too
    limit = (fits.four_grids if even else fits.grid_limit)(group.resolution, group[name])
    return limit + Measured(0.0, 2*group[f"{name}_err"].max())


def line_limit(group: pd.DataFrame, name: str) -> Measured:
    """Value at 1/rows = 0 of c + c_2/rows^2 through all runs, with c_3/rows^3 over a wide range of rows; its
    error: of the fit, of the runs, and twice what the coarsest change.

    K of sets of points scatters as 1/rows^2 or faster, 0.6 % to 0.04 % from 25 to 50 rows: hence weights of
    rows^2. One scatter stands for all that is left over, which three runs of one size tell badly. A lattice
    at rest has the third power, too: less it K of moving points falls as 1/rows^2, `own-rb-carried-lattice`.
    """
    sizes = group.resolution.to_numpy(float)
    weight, finer, wide = sizes**2, sizes > sizes.min(), sizes.max() > COARSEST*sizes.min()
    X = (1/sizes[:, None])**np.array([0, 2, 3] if wide else [0, 2])
    limit = fits.linear(X, group[name], weight=weight, err=group[f"{name}_err"]).intercept
    without, *_ = np.linalg.lstsq((weight[:, None]*X)[finer], (weight*group[name])[finer])[0]
    return limit + Measured(0.0, 2*(limit.value - without))


def over_seeds(runs: pd.DataFrame) -> Iterator[Row]:
    """Means over those seeds of each point that have its commonest number of rolls; rows of grids stay.

    The error of smooth particles contains twice what half of the time step changes, as the walls make an
    error of first order. The change is that of their own variant if it was run, else of the printed one.
    """
    changes = step_changes(runs)
    for point, group in runs.groupby(POINT, dropna=False):
        row: Row = dict(zip(POINT, point))
        same = group[group.rolls == group.rolls.mode().iloc[0]]
        for name, change in step_change(changes, row).items():
            value, err = combine(list(zip(same[name], same[f"{name}_err"])))
            row |= {name: value, f"{name}_err": np.hypot(err, 2*value*change)}
        yield {**row, **same[["particles", "rolls"]].iloc[0], "seeds": len(same),
               "mixed": len(group) - len(same), "ke_fluctuation": same.ke_fluctuation.mean()}


def step_changes(runs: pd.DataFrame) -> pd.DataFrame:
    """Relative change of each energy with half of the step, by variant, scene and rows, the finest first."""
    spam = runs[runs.method == "spam"]
    halves = spam[spam.variant.str.endswith(HALF)]
    halves = halves.assign(variant=halves.variant.str.removesuffix(HALF))
    half, whole = (some.groupby(["variant", *SCENE, "resolution"], dropna=False)[ENERGIES].mean()
                   for some in (halves, spam))
    changes = (half/whole - 1).abs().dropna().reset_index()
    return changes.sort_values("resolution", ascending=False, kind="stable")


def step_change(changes: pd.DataFrame, row: Row) -> pd.Series:
    """The change at the same Ra with the next fewer rows; without such runs that of the same fluid and box,
    else of any. Grids and points have none.
    """
    if row["method"] != "spam":
        return pd.Series(0.0, ENERGIES)
    known = row["variant"] if (changes.variant == row["variant"]).any() else "printed"
    coarser = changes[(changes.resolution <= row["resolution"]) & (changes.variant == known)]
    alike = coarser[(coarser.eos == row["eos"]) & (coarser.sides == row["sides"])]
    own = alike[(alike.resolution == alike.resolution.max()) & (alike.ra == row["ra"])]
    nothing = pd.DataFrame(0.0, [0], ENERGIES)
    return next(some for some in (own, alike, coarser, nothing) if len(some))[ENERGIES].iloc[0]


def in_space(tables: Tables) -> Iterator[Row]:
    """Limits of three sizes or more in one pattern: of a lattice over 1/rows^2, of the spectral gas the
    finest run.
    """
    by = "method variant start ra".split()
    runs = finite(rows_of(tables, "three_dimensions"))
    for key, group in runs.sort_values("resolution").groupby(by):
        if len(group) < 3 or np.ptp(group.across) > SAME_PATTERN:
            continue
        limit = grid_limit if "dih" in key else finest
        yield {**dict(zip(by, key)), **with_errors(ke=limit(group, "ke"), nu=limit(group, "nu")),
               **group.iloc[-1][["across", "converged"]], "resolution": np.inf, "particles": 0}


def finest(group: pd.DataFrame, name: str) -> Measured:
    """The value of the finest run; its error is what the last step of sizes changed, and the values' own."""
    *_, before, value = group[name]
    return Measured(value, abs(value - before)) + Measured(0.0, 2*group[f"{name}_err"].max())


def errors(runs: pd.DataFrame, means: pd.DataFrame, tables: Tables) -> pd.DataFrame:
    """Relative errors of K and Nu against the compressible limit of the scene, with what they cost.

    Kp, of all particles, is compared with the grid's K; Kg, of the smoothed field, with K of the grid's field
    smoothed by the same weight: smoothing alone is no error of the flow.
    """
    grid = means.query("method == 'compressible' and variant == 'flux-form'")
    limits = grid[np.isinf(grid.resolution) & (grid.ke > STILL)]
    rows = finite(means.query("method != 'spectral-gas'"))
    rows = rows.merge(limits, on=SCENE, suffixes=("", "_limit"))
    rows = rows.query("method == 'spam' or rolls == rolls_limit")
    rows = rows.merge(spent(runs), on=POINT)
    whole, field = rows.assign(left=1.0), with_smoothing(rows, tables)
    return pd.concat([compared(whole, "Nu", "nu", "nu"), compared(whole, "Kp", "ke", "ke"),
                      compared(field, "Kg", "ke_field", "ke")])


def compared(rows: pd.DataFrame, energy: str, column: str, limit: str) -> pd.DataFrame:
    """Rows of `errors`: a column against the grid's limit, of which smoothing leaves the share `left`."""
    ke, ke_err = rows[column], rows[column + "_err"]
    reference, reference_err = (rows.left*rows[limit + end] for end in ("_limit", "_err_limit"))
    ratio = ke/reference
    return rows[[*POINT, "particles", "cpu_s"]].assign(
        energy=energy, ke=ke, ke_err=ke_err, reference=reference, reference_err=reference_err,
        error=ratio - 1, error_err=np.hypot(ke_err, ratio*reference_err)/reference)


def with_smoothing(rows: pd.DataFrame, tables: Tables) -> pd.DataFrame:
    """Rows of particles, with the share of the K of the grid's field that their weight leaves."""
    spam = rows.query("method == 'spam'")
    seen = rows_of(tables, "smoothed").astype({"h": float})
    seen = seen.assign(left=seen.ke_smoothed/seen.ke, resolution=seen.rows, h=seen.h.round(6))
    views = list(map(variant_of, spam.variant, spam.resolution))
    spam = spam.assign(weight=[view.weight.__name__ for view in views],
                       h=[round(view.h, 6) for view in views]).astype({"weight": str, "h": float})
    key = [*SCENE, "weight", "h", "resolution"]
    return spam.merge(seen.drop_duplicates(key, keep="last")[[*key, "left"]], on=key)


def spent(runs: pd.DataFrame) -> pd.DataFrame:
    """CPU seconds that a mean takes: of all seeds, and for grids of the coarser ones, too. Other runs shared
    the machine, which those of the study `cost` had for themselves.
    """
    seconds = runs.groupby(POINT, dropna=False).cpu_s.sum().reset_index()
    grids = seconds.method.isin(GRIDS)
    series = seconds[grids].groupby(SERIES, dropna=False)
    seconds.loc[grids, "cpu_s"] = series.cpu_s.cumsum()
    return seconds
