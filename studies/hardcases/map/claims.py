"""Claims about hard cases on points and grids."""
from collections.abc import Sequence

import numpy as np
import pandas as pd

from studies.build.read import Value, select
from studies.hardcases.map import ends as map_ends
from studies.hardcases.map.derive import LEAK, NEAR, SPURIOUS
from studies.hardcases.map.scenes import ROWS
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

HIGH = ("Ra 1e5", "Ra 1e6")
FLUCTUATES = 0.01       # of K, in a quarter of the time when a steady flow has long settled
ENDS, STILL = "a run ends or it does not", "K of flows that settle changes by less than 0.1 % then"
#: where a coarse grid is all that there is to hold flows against
COARSE = {"Prandtl 0.01": "; the grid has 32 rows, since that of 48 ends"}
TEN = "a tenth is what separates `right` from `wrong` on the map"


def ending(tables: Tables, case: str, method: str) -> str:
    """What is known of how a run ended, in words."""
    rows = tables.get("map_ends", pd.DataFrame())
    if case != map_ends.CASE or rows.empty:
        return ""
    same = rows[(rows["method"] == method) & (rows["pr"] == 0.01) & (rows["rows"] == ROWS)].set_index("step")
    if not {1.0, map_ends.HALF} <= set(same.index):
        return ""
    row, half = same.loc[1.0], same.loc[map_ends.HALF]["reached"]
    return (f": it ends after {row['reached']:.2f} of the time, with half of the step after {half:.2f}; before, its flow has "
            f"{row['speed']:.2f} of the speed of sound, v a/nu = {row['cell_re']:.0f} and a step {row['beyond']:.2f} times the "
            "limit")


def number(case: str, method: str) -> Value:
    """The number that decides, and the error of what it is held against; a run that did not end has none."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "map", case=case, method=method).iloc[0]
        if row["outcome"] in ("diverges", "refused") or not np.isfinite(row["measured"]):
            raise CannotTell(f"{method} in {case}: {row['outcome']}, nothing could be measured{ending(tables, case, method)}")
        return Measured(float(row["measured"]), float(row["measured_err"]))
    return value


def over(case: str, method: str, other: str) -> Value:
    """The number of one method over that of another."""
    return lambda tables: Measured(number(case, method)(tables).value/number(case, other)(tables).value, 0.0)


def reached(cases: Sequence[str], *methods: str) -> Value:
    """The least part of the time that was reached."""
    def value(tables: Tables) -> Measured:
        return Measured(min(float(select(tables, "hard_runs", case=case, method=method)["reached"].min())
                            for case in cases for method in methods), 0.0)
    return value


def drift(*methods: str) -> Value:
    """The largest change of mass, of runs that came to their end."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "hard_runs", reached=1.0)
        drifts = np.abs(rows["mass_drift"][rows["method"].isin(methods)].to_numpy(float))
        if not len(drifts):
            raise CannotTell("not run yet: table hard_runs has none of these methods")
        return Measured(float(drifts.max()), 0.0)
    return value


def swing(ra: float, rows: int) -> Value:
    """Largest less smallest K over the mean, late; the error: what the quarter before differs by, however much."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "steadiness", ra=ra, rows=rows, step=1.0).iloc[0]
        if not np.isfinite(row["swing"]):
            raise CannotTell(f"the grid of {rows} rows diverged at Ra {ra:g}, after {row['reached']:.2f} of the time")
        return Measured(float(row["swing"]), float(abs(row["swing"] - row["before"])))
    return value


def survived(ra: float) -> Value:
    """The least part of the time that a grid reached."""
    return lambda tables: Measured(float(select(tables, "steadiness", ra=ra, step=1.0)["reached"].min()), 0.0)


def sooner(ra: float, rows: int) -> Value:
    """Time reached with half of the step over the time with all of it."""
    def value(tables: Tables) -> Measured:
        whole, half = (float(select(tables, "steadiness", ra=ra, rows=rows, step=step)["reached"].iloc[0]) for step in (1.0, 0.5))
        if whole == 1:
            raise CannotTell(f"the grid of {rows} rows comes through at Ra {ra:g}")
        return Measured(half/whole, 1/240/whole)
    return value


def alike(ra: float, coarse: int, fine: int) -> Value:
    """Swing of the coarser over that of the finer grid, from both quarters."""
    def value(tables: Tables) -> Measured:
        one, other = (select(tables, "steadiness", ra=ra, rows=rows, step=1.0).iloc[0] for rows in (coarse, fine))
        late, before = one["swing"]/other["swing"], one["before"]/other["before"]
        if not np.isfinite(late):
            raise CannotTell(f"a grid diverged at Ra {ra:g}")
        return Measured(float(late), float(abs(late - before)))
    return value


def right(case: str, method: str, source: str, statement: str) -> Claim:
    """The flow is as the fine grid or the exact solution has it, to a tenth."""
    name = f"{case} {method}".lower().replace(" ", "-")
    return Claim(id=f"map-{name}", source=source, statement=statement + COARSE.get(case, ""), value=number(case, method),
                 expect=1.0, within=NEAR, because=TEN)


CLAIMS = (
    Claim(id="map-robust", source="KHP95 Sec. VI", value=reached(HIGH, "spam printed"), at_least=1.0,
          printed="the \"robust\" smooth-particle technique continues to provide solutions",
          statement="smooth particles as printed run to the end at Ra 1e5 and 1e6 on 16 rows", because=ENDS),
    Claim(id="map-grid-fluctuates", source="KHP95 Sec. VI", value=swing(3.5e5, 16), at_least=FLUCTUATES,
          printed="at higher Ra centered-difference regular-grid solutions begin to fluctuate",
          statement="the centred grid of 16 rows fluctuates at Ra 350 000", because=STILL),
    Claim(id="map-grid-fluctuates-fine", source="KHP95 Sec. VI", value=swing(3.5e5, 48), at_most=FLUCTUATES,
          statement="what fluctuates at Ra 350 000 on a coarse grid does not on 48 rows: it is of the grid, not of the flow",
          because=STILL),
    Claim(id="map-grid-steady", source="KHP95 Sec. VI", value=swing(1e5, 32), at_most=FLUCTUATES,
          statement="the centred grid of 32 rows is steady at Ra 100 000", because=STILL),
    # read later: at Ra 350 000 grids did not fluctuate but end, as soon with half of the step
    Claim(id="map-grid-ends", source="KHP95 Sec. VI", value=survived(3.5e5), at_least=1.0, because=ENDS,
          statement="centred grids of 16 to 48 rows come through 150 free-fall times at Ra 350 000: part of the time, the least "
          "[asked after they had ended]"),
    Claim(id="map-grid-ends-step", source="KHP95 Sec. VI", value=sooner(3.5e5, 24), expect=1.0, within=0.02,
          statement="where a centred grid of 24 rows ends at Ra 350 000 does not depend on its step: time with half of it "
          "over time with all [asked after it had ended]",
          because="runs are looked at 240 times: 1 % of the time at which they end"),
    Claim(id="map-grid-swings", source="KHP95 Sec. VI", value=alike(2e5, 32, 48), expect=1.0, within=0.25,
          statement="at Ra 200 000 K of 32 and of 48 rows swings alike: what is left is of the flow, not of the grid [asked "
          "after both had been seen]",
          because="swings of the grid fall at least as the square of its cells, 2.25 times"),
    *(right(case, "spam printed", "KHP95 Sec. VI", f"smooth particles as printed have the grid's flow, {case}, 16 rows")
      for case in (*HIGH, "Prandtl 0.01", "Prandtl 100", "high pressure")),
    *(right(case, "fixed lattice", "RR98 Eqs 34-36, 51", f"points on a lattice have the grid's flow, {case}, 16 rows")
      for case in (*HIGH, "Prandtl 0.01", "Prandtl 100", "high pressure", "zero viscosity")),
    *(right(case, "moving", "RR98 Eqs 46-48", f"moving points with closed faces have the grid's flow, {case}, 16 rows")
      for case in (*HIGH, "Prandtl 0.01", "Prandtl 100", "high pressure", "zero viscosity")),
    right("zero viscosity", "grid", "KHP95 Sec. V", "without viscosity the centred grid keeps a vortex for five turns, 16 rows"),
    right("vacuum", "grid", "KHP95 Sec. V", "on the centred grid gas that expands into a thousandth of its density has the "
          "kinetic energy of two rarefactions"),
    right("shear layer", "grid", "KHP95 Sec. V", "a wave on a shear flow without viscosity grows by linear theory, the centred "
          "grid, 16 cells to the flow's wavelength"),
    right("zero viscosity", "spam printed", "KHP95 Sec. II", "without viscosity smooth particles keep a vortex for five turns"),
    right("vacuum", "spam printed", "KHP95 Sec. II", "gas that expands into a vacuum has the kinetic energy of two rarefactions"),
    Claim(id="map-corner-spurious", source="KHP95 Sec. IV", value=number("wall corner", "spam printed"), at_most=SPURIOUS,
          statement="in a square box with four walls at rest smooth particles as printed come to rest",
          because="a thousandth of the speed of sound is a hundredth of what flows have"),
    # read later: particles without any wall move as much
    Claim(id="map-corner-of-walls", source="KHP95 Sec. IV", value=over("wall corner", "spam printed", "spam without walls"),
          at_least=2.0, because="what walls make is more than what there is without them",
          statement="what moves at rest in a square box is made by its walls: speed with four walls over speed without any "
          "[asked after they had been seen to move]"),
    # read later: what is left moves over two spacings, which gradients of gradients do not see
    Claim(id="map-corner-direct", source="KHP95 Sec. IV", value=number("wall corner", "spam direct"), at_most=SPURIOUS,
          statement="in a square box with four walls at rest smooth particles with direct friction come to rest [asked after "
          "the printed ones did not]",
          because="a thousandth of the speed of sound is a hundredth of what flows have"),
    right("shear layer", "spam printed", "KHP95 Sec. VI", "a wave on a shear flow without viscosity grows by linear theory, "
          "smooth particles as printed, 16 spacings to the flow's wavelength"),
    right("shear layer", "fixed lattice", "RR98 Eqs 34-36", "a wave on a shear flow without viscosity grows by linear theory, "
          "points on a lattice, 16 spacings to the flow's wavelength"),
    right("shear layer", "moving", "RR98 Eqs 46-48", "a wave on a shear flow without viscosity grows by linear theory, moving "
          "points with closed faces, 16 spacings to the flow's wavelength"),
    Claim(id="map-plain-disordered", source="RR98 Eqs 34-36", value=reached(("disordered points",), "fixed jittered plain"),
          at_most=0.999, because=ENDS, statement="the bracket by plain quadrature on jittered fixed points does not run to the "
          "end: sound grows"),
    Claim(id="map-conserved", source="RR98 Eqs 34-36", value=drift("fixed lattice", "fixed jittered", "fixed nested", "moving",
                                                                   "drift constant mass"), at_most=LEAK/1e3,
          statement="fixed points, moving points with closed faces and points of constant mass keep mass in all hard cases that "
          "they come through", because="sums of 1e4 steps of 1e3 terms leave 1e-9 of round-off at most, a wall that leaks 1e-3"),
)
