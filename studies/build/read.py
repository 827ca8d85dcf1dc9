"""Rows of the study's tables, asked for in words. What no table has yet is said in a sentence (CannotTell).

KHP95's 5000 particles are 50 rows of 100, so `height=50`; grids extrapolated to infinitely fine have height inf.
"""
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from math import hypot, inf, pi

import pandas as pd

from continuum.linear.layer import critical_ra
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables

Value = Callable[[Tables], Measured]
STILL = 1e-6        # K of a grid whose onset lies a little higher: nothing flows, and rolls are of round-off
#: which K of the grid a claim takes, for its reason: two yardsticks are in use
PLAIN = "against the grid's K as it is, as the paper compares"
ALIKE = "against K of the grid's field smoothed by the same weight"
#: Prandtl number nu/kappa, kappa = k/(rho C_V), that KHP95's eta = k means
PRANDTL = {"ideal": 1.0, "vdw": 1.0, "dense": 1.5}


def exact(number: Callable[[], float], err: float = 0.0) -> Value:
    """A value that needs no table; computed when the claim is judged."""
    return lambda tables: Measured(float(number()), err)


def select(tables: Tables, name: str, need: str = "", **where) -> pd.DataFrame:
    """The rows of a table in which all columns are as said; `need` names a column that the table is to have besides.

    Raises
    ------
    CannotTell
        There are none.
    """
    wanted = ", ".join(f"{column} {value:g}" if isinstance(value, float | int) else f"{column} {value}"
                       for column, value in where.items())
    frame = tables.get(name, pd.DataFrame())
    if not set(where) <= set(frame.columns):
        raise CannotTell(f"not run yet: table {name} is to have {wanted}; make study-rb, or its SIZE=fine, fills it")
    for column, value in where.items():
        frame = frame[frame[column] == value]
    if frame.empty:
        raise CannotTell(f"not run yet: table {name} has no row of {wanted}; a larger SIZE of the study may run it")
    if need and need not in frame:
        raise CannotTell(f"table {name} was written without its column {need}: run the study again")
    return frame


def scene(ra: float, eos="ideal", transport="const-eta", sides="periodic", pr: float | None = None) -> dict:
    """The columns of a scene; KHP95's eta = k unless `pr` is given."""
    return {"eos": eos, "transport": transport, "sides": sides, "ra": float(ra), "pr": pr or PRANDTL[eos]}


def particles(ra: float, height: int = 50, variant="printed", **where) -> dict:
    """The columns of smooth particles, `height` rows of them."""
    return {"method": "spam", "variant": variant, "resolution": float(height), **scene(ra, **where)}


def grid(ra: float, height: float = inf, variant="flux-form", **where) -> dict:
    """The columns of the compressible grid."""
    return {"method": "compressible", "variant": variant, "resolution": float(height), **scene(ra, **where)}


def diverged(tables: Tables, point: dict, which: Callable[[Iterable[bool]], bool] = any) -> bool:
    """Whether any or all runs of a point diverged: their rows have no energy."""
    try:
        return which(select(tables, "kinetic_energy", **point)["ke"].isna())
    except CannotTell:
        return False


def mean(tables: Tables, point: dict, column: str = "ke") -> Measured:
    """A column of `means` at one point, with its error where it has one."""
    row = one_flow(tables, point)
    return Measured(float(row[column]), float(row.get(f"{column}_err", 0.0)))


def one_flow(tables: Tables, point: dict) -> pd.Series:
    """The row of `means` of one point.

    Raises
    ------
    CannotTell
        All runs diverged, or seeds ended in different flows: which one the point has is then a matter of chance.
    """
    if diverged(tables, point, all):
        raise CannotTell(f"all runs of {point['method']}, {point['variant']} at Ra {point['ra']:g} diverged")
    row = select(tables, "means", **point).iloc[0]
    if row.get("mixed", 0) > 0:
        raise CannotTell(f"{row['mixed']:.0f} of {row['mixed'] + row['seeds']:.0f} seeds of {point['variant']}, "
                         f"{point['resolution']:g} rows, ended with another number of rolls than the {row['rolls']:.0f} of the "
                         f"others at Ra {point['ra']:g}: which flow belongs to the point is not decided")
    return row


def alike(tables: Tables, point: dict) -> Measured:
    """K of the grid's field smoothed as the particles of `point` smooth theirs: what Kg is to be if the flow is right."""
    row = select(tables, "errors", energy="Kg", **point).iloc[0]
    return Measured(float(row["reference"]), float(row["reference_err"]))


def settled(tables: Tables, point: dict) -> bool:
    """Whether the halves of K agree in all runs of a point that did not diverge."""
    frame = select(tables, "kinetic_energy", **point)
    return bool(frame.loc[frame["ke"].notna(), "converged"].astype(str).eq("True").all())


def shared_height(tables: Tables, ra: float, *variants: str) -> int:
    """Most rows of particles that all these variants have at one Ra.

    Raises
    ------
    CannotTell
        One was not run, or they have no number in common.
    """
    points = [{k: v for k, v in particles(ra, variant=name).items() if k != "resolution"} for name in variants]
    shared = set.intersection(*(set(select(tables, "means", **point)["resolution"]) for point in points))
    if not shared:
        raise CannotTell(f"{' and '.join(variants)} were run with different numbers of particles only")
    return int(max(shared))


def rolls(tables: Tables, point: dict, seed: int | None = None) -> int:
    """Rolls of a flow: of one seed, or of the seeds of which the mean is made; none where motion has died."""
    row = one_flow(tables, point) if seed is None else select(tables, "kinetic_energy", **point, seed=seed).iloc[0]
    return int(row["rolls"]) if row["ke"] > STILL else 0


def rolls_of(point: dict) -> Value:
    """The same as a value function that refuses what has died."""
    return lambda tables: moving(one_flow(tables, point))


def moving(row: pd.Series) -> Measured:
    """Rolls in a row of `means` or `kinetic_energy`.

    Raises
    ------
    CannotTell
        Nothing moves.
    """
    if not row["ke"] > STILL:
        raise CannotTell(f"K is {row['ke']:.1g} at the end: the flow has died, rolls would be those of round-off")
    return Measured(float(row["rolls"]), 0.0)


def same_flow(tables: Tables, one: dict, other: dict, seed: int | None = None) -> None:
    """Refuse to compare two flows with different rolls; `seed` says which run of `one`, if not the mean.

    No rolls are no other flow: where motion has died, the energies tell.

    Raises
    ------
    CannotTell
        Their rolls differ.
    """
    a, b = rolls(tables, one, seed), rolls(tables, other)
    if a != b and min(a, b) > 0:
        raise CannotTell(f"{a} rolls against {b} at Ra {one['ra']:g}: another flow, whose energy and velocities say nothing "
                         "on errors")


def limit(tables: Tables, ra: float, column: str = "ke", **where) -> Measured:
    """The compressible grid extrapolated to infinitely fine: K, or another column of `means`."""
    return mean(tables, grid(ra, **where), column)


def limit_of(ra: float, column: str = "ke", **where) -> Value:
    """The same as a value function."""
    return lambda tables: limit(tables, ra, column, **where)


def mean_of(point: dict, column: str) -> Value:
    """A column of `means` at one point, as a value function."""
    return lambda tables: mean(tables, point, column)


def over_runs(tables: Tables, point: dict, energy: str) -> Measured:
    """Mean of the runs of a point that have its rolls, its error from statistics alone: in `means` that of the step is added."""
    frame = select(tables, "kinetic_energy", **point)
    frame = frame[frame["ke"].notna() & (frame["rolls"] == one_flow(tables, point)["rolls"])]
    return combine(list(zip(frame[energy], frame[f"{energy}_err"], strict=True)))


def over_seeds(values: Sequence[float]) -> Measured:
    """Mean and error over seeds.

    Raises
    ------
    CannotTell
        Only one.
    """
    if len(values) < 2:
        raise CannotTell("one seed was run: there is no error bar without a second")
    return combine([(value, 0.0) for value in values])


def ratio(a: Measured, b: Measured) -> Measured:
    """a/b with its error.

    Raises
    ------
    CannotTell
        b is not told from zero.
    """
    if abs(b.value) <= b.err:
        raise CannotTell(f"a ratio to {b.value:.3g} +- {b.err:.2g}, which is not told from zero")
    return Measured(a.value/b.value, hypot(a.err, a.value/b.value*b.err)/abs(b.value))


def off(a: Measured, centre: float = 1.0) -> Measured:
    """|a - centre|."""
    return Measured(abs(a.value - centre), a.err)


def largest(found: list[Measured], over: float = 1.0) -> Measured:
    """The largest, with the largest error among them, in units of `over`."""
    return Measured(max(m.value for m in found)/over, max(m.err for m in found)/over)


@cache
def onset(sides: str) -> float:
    """Critical Rayleigh number of the Boussinesq fluid in the box: of a pair of rolls, of one roll in the square."""
    return critical_ra(pi) if sides == "periodic" else SQUARE


#: square, sides conducting: Chebyshev eigenproblem, 14 to 22 points agree to 8 figures; study `onset` measures it again
SQUARE = 5011.71
