"""Claims about the grid's flow in the square    [KHP95, Sec. VI, Fig. 10]"""
import numpy as np
import pandas as pd

from studies.build.read import STILL, Value, moving
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.grid import finished
from studies.rb.claims.printed import as_printed


def in_square(tables: Tables, variant: str, **where) -> pd.Series:
    """The finest grid of a variant in the square."""
    frame = finished(tables, variant=variant, sides="walls", **where)
    frame = frame[np.isfinite(frame["resolution"])].sort_values("resolution")
    if frame.empty:
        raise CannotTell(f"variant {variant} of the grid has extrapolated rows only")
    return frame.iloc[-1]


def square_rolls(variant: str, **where) -> Value:
    """Its rolls, if it flows."""
    return lambda tables: moving(in_square(tables, variant, **where))


def rolls_left(tables: Tables) -> Measured:
    """Rolls at Ra 7000 after a start with two; two tell nothing while they still change, or where motion has died.

    Two equal rolls are symmetric, and a grid keeps that: they may die where the least asymmetry would make them one.
    """
    row = in_square(tables, "two-rolls", ra=7000.0)
    if row["rolls"] == 2 and str(row["converged"]) != "True":
        raise CannotTell(f"the two rolls of the start are still there at t = {row['t_end']:.0f}, but not steady")
    return moving(row)


def hot_dense(tables: Tables) -> Measured:
    """K of the dense fluid between the temperatures of Fig. 10."""
    try:
        row = in_square(tables, "fig10", eos="dense")
    except CannotTell as why:
        raise CannotTell(f"{why}; T = 10 is far outside of the equation of state, a fit about T = 1 whose T(n, u) does not "
                         "invert its u(n, T) there, and the gravity that gives Ra 350 000 is not the one of Sec. IV") from None
    return Measured(float(row["ke"]), float(row["ke_err"]))


CLAIMS = (
    Claim(id="khp95-two-rolls-square", source="KHP95 Sec. VI, Fig. 10", printed="two rolls",
          statement="the ideal gas of Fig. 10 in the square convects with two rolls, on the grid",
          value=square_rolls("fig10", eos="ideal"), **as_printed("fig10-rolls"), because="a whole number"),
    Claim(id="khp95-fig10-dense", source="KHP95 Sec. VI, Fig. 10", printed="dense fluid", at_least=STILL, value=hot_dense,
          statement="the dense fluid flows in the square between temperatures 10 and 0.5: K of the grid at the Ra of the "
                    "ideal gas", because="above what is left of rest"),
    Claim(id="khp95-one-roll-square", source="KHP95 Sec. VI, Fig. 10", printed="one",
          statement="two rolls in the square give way to one near onset: rolls at Ra 7000 after a start with two",
          value=rolls_left, expect=1, within=0, because="a whole number"),
)
