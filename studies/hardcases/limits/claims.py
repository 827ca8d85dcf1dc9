"""Claims about limits of the time step.

Accepted everywhere: 10 %, asked of limits beforehand. Trials see limits to 1 %.
"""
from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from studies.build.read import Value, select
from studies.hardcases.limits.euler import WEAK
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

NEAR, SOUND = 0.10, "zero viscosity"
SPREAD = ("Prandtl 0.01", "Prandtl 100")


def chosen(tables: Tables, methods: Sequence[str], scenes: Sequence[str] = ()) -> pd.DataFrame:
    """Rows of some methods, in some or all scenes, that have a measured limit."""
    rows = select(tables, "limits")
    rows = rows[rows["method"].isin(methods) & (rows["scene"].isin(scenes) if scenes else True) & (rows["predicted"] > 0)]
    rows = rows.dropna(subset=["measured"])
    if rows.empty:
        raise CannotTell(f"not run yet: table limits has no row of {', '.join(methods)}; a larger SIZE of the study may run it")
    return rows


def farthest(methods: Sequence[str], scenes: Sequence[str] = (), column: str = "predicted") -> Value:
    """The largest |measured/formula - 1|, what a formula leaves for disorder given back."""
    def value(tables: Tables) -> Measured:
        rows = chosen(tables, methods, scenes)
        if column == "shorter":
            rows = rows.merge(select(tables, "shorter")[["method", "scene", "shorter"]], on=["method", "scene"])
        rows = rows.dropna(subset=[column])
        if rows.empty:
            raise CannotTell(f"table limits has no {column} of {', '.join(methods)}: run their cases again")
        formula = rows[column]*(rows["margin"] if column == "predicted" else 1)
        off, err = (np.array(q) for q in ((rows["measured"]/formula - 1).abs(), rows["measured_err"]/formula))
        return Measured(float(off.max()), float(err[off.argmax()]))
    return value


def least(methods: Sequence[str], scenes: Sequence[str] = ()) -> Value:
    """The smallest measured/predicted."""
    return extreme(methods, scenes, np.argmin)


def most(methods: Sequence[str], scenes: Sequence[str] = ()) -> Value:
    """The largest measured/predicted."""
    return extreme(methods, scenes, np.argmax)


def extreme(methods: Sequence[str], scenes: Sequence[str], which: Callable) -> Value:
    """measured/predicted where it is smallest or largest."""
    def value(tables: Tables) -> Measured:
        rows = chosen(tables, methods, scenes)
        ratio, err = (np.array(rows[column]/rows["predicted"]) for column in ("measured", "measured_err"))
        return Measured(float(ratio[which(ratio)]), float(err[which(ratio)]))
    return value


def strips(plates: str, rows: int) -> Value:
    """The largest |step/formula - 1| of linear theory with some plates, weak conduction left out."""
    def value(tables: Tables) -> Measured:
        some = select(tables, "strips", plates=plates, rows=rows)
        some = some[some["scene"] != WEAK]
        return Measured(float((some["step"]/some["formula"] - 1).abs().max()), 0.0)
    return value


def strips_and_sums(tables: Tables) -> Measured:
    """The largest |step by eigenvalues/step by theory - 1|."""
    theory = select(tables, "strips", plates="holding", rows=10).set_index("scene")["step"]
    sums = chosen(tables, ("fixed Euler",)).set_index("scene")["exact"]
    return Measured(float((sums/theory - 1).abs().max()), 0.0)


def weak_strips(tables: Tables) -> Measured:
    """The largest |step/((1 - 4/N) formula) - 1|."""
    some = select(tables, "strips", plates="holding", scene=WEAK)
    return Measured(float((some["step"]/some["formula"]/(1 - 4/some["rows"]) - 1).abs().max()), 0.0)


DPD = ("DPD 2D", "DPD 3D")
POINTS = ("fixed lattice", "fixed jittered")
LINEAR = ("spam Lucy", "spam Wendland", "spam direct", *POINTS, "fixed nested", "fluctuating", "drift literal",
          "drift constant mass")
RUNGE_KUTTA = ("grid", *LINEAR, "moving")
GIVEN_BACK = "the largest stable step on a lattice is the formula's, what it leaves for disorder given back"


def near(name: str, source: str, statement: str, methods: Sequence[str], scenes: Sequence[str] = (),
         column: str = "predicted") -> Claim:
    """Measured limits are those of the methods' own formulas, or of another column, to 10 %."""
    return Claim(id=f"limit-step-{name}", source=source, statement=statement, value=farthest(methods, scenes, column),
                 at_most=NEAR, because="limits are to be known to 10 %: what takes 0.9 of a formula is then safe and gives away "
                                       "little")


CLAIMS = (
    near("spam", "KHP95 Sec. II", "smooth particles on a lattice under RK4: noise begins to grow at the step that lattice sums "
         "give, from zero viscosity to Prandtl 0.01 and 100", LINEAR[:3]),
    near("grid-sound", "KHP95 Sec. V", "compressible grid without viscosity: the largest stable step is the formula's for sound",
         ("grid",), (SOUND,)),
    near("grid-spread", "KHP95 Sec. V", "compressible grid at Prandtl 0.01 and 100, limited by diffusion: the largest "
         "stable step is the formula's", ("grid",), SPREAD),
    near("points-sound", "RR98 Eqs 34-36", "fixed points without viscosity, on a lattice and jittered: the largest stable step "
         "is the one from the largest singular value of the gradient", POINTS, (SOUND,)),
    near("points-spread", "RR98 Eq. 51", "fixed points at Prandtl 0.01 and 100, limited by diffusion along edges: the largest "
         "stable step is the one from the largest eigenvalue of the Laplacian", POINTS, SPREAD),
    near("points-nested", "RR98 Eqs 37, 38", "fixed points with gradients of gradients: the largest stable step is the "
         "formula's, which has the Laplacian along edges", ("fixed nested",)),
    near("points-both", "RR98 Eq. 51", "fixed points with sound and diffusion alike: the largest stable step is the formula's, "
         "the inverse sum of both", POINTS, ("balanced",)),
    near("fluctuating", "RR98 Sec. II D", "fixed points under the three stages of fluctuating hydrodynamics: the largest stable "
         "step is the formula's", ("fluctuating",)),
    near("literal", "RR98 Eqs 34-36, 39", f"points that move while their volumes stay, as printed: {GIVEN_BACK}",
         ("drift literal",)),
    near("constant-mass", "RR98 Eq. 49", f"points that move with constant mass: {GIVEN_BACK}", ("drift constant mass",)),
    near("moving", "RR98 Eqs 46-48", f"moving points with closed faces: {GIVEN_BACK}", ("moving",)),
    near("euler", "RR98 Eq. 40", "forward Euler on ten fixed points a side: noise begins to grow at dt = (eta + zeta + kappa/2)"
         "/(rho c^2)", ("fixed Euler",), ("Euler 1/2", "Euler 1", "Euler heat")),
    Claim(id="limit-step-boussinesq", source="KHP95 Sec. V", value=least(("Boussinesq grid",)), at_least=1.0,
          statement="Boussinesq grid, advection extrapolated from two steps: noise about a steady roll does not grow at the CFL "
          "number that is allowed, 0.8", because="0.8 is meant to be safe: how much it gives away is in the table"),
    # read later: forward Euler between plates falls short by a third, and its formula knows no plates
    near("euler-periodic", "RR98 Eq. 40", "forward Euler on a lattice without plates, which the formula does not know: noise "
         "begins to grow at dt = (eta + zeta + kappa/2)/(rho c^2) [asked after it fell short by a third between plates]",
         ("fixed Euler, periodic",), ("Euler 1/2", "Euler 1", "Euler heat")),
    near("euler-strip", "RR98 Eqs 37-40", "forward Euler between plates: noise begins to grow at the step of linear theory of a "
         "strip whose friction and heat see images [asked after the formula without plates had failed]",
         ("fixed Euler, strip",)),
    Claim(id="limit-step-euler-theory", source="RR98 Eqs 37-40", at_most=NEAR, value=strips_and_sums,
          statement="theory of a strip has the limit that eigenvalues of the compiled sums have, ten rows: largest relative "
                    "difference",
          because="10 %, asked of limits beforehand"),
    Claim(id="limit-step-euler-images", source="RR98 Eqs 37-40", at_most=NEAR, value=strips("insulating, slipping", 10),
          statement="in theory of a strip it is the images that friction and heat see that shorten the step: with plates that "
                    "slip and insulate it is that of the formula without plates, ten rows",
          because="10 %, asked of limits beforehand"),
    Claim(id="limit-step-euler-rows", source="RR98 Eqs 37-40", at_most=0.01, value=weak_strips,
          statement="in theory of a strip heat conduction that is weak allows (1 - 4/N) k/(2 rho c^2) between plates N rows "
                    "apart, two rows of N doing nothing at the crests of a gradient [derived here]: largest relative "
                    "difference, N 10 to 40",
          because="sound is damped by 3 % within a period"),
    Claim(id="limit-step-edges-alone", source="RR98 Eq. 51", value=least(("fixed jittered, edges alone",)), at_least=0.99,
          statement="a formula that leaves images behind plates out, as points between plates once had, is not above the step at "
                    "which noise on jittered points begins to grow: they are nearest to their own images",
          because="formulas are read off stability regions to 0.4 %, trials find limits to 1 %"),
    # read later: sound and diffusion do not add, as methods' own formulas have it
    *(near(f"{name}-shorter", source, f"{words}: the largest stable step is the shorter one of those of sound alone and of "
           "diffusion alone [asked after the inverse sum had failed]", methods, column="shorter")
      for name, source, words, methods in (
          ("grid", "KHP95 Sec. V", "compressible grid", ("grid",)),
          ("points", "RR98 Eq. 51", "fixed points, friction along edges, on a lattice and jittered", POINTS),
          ("points-nested", "RR98 Eqs 37, 38", "fixed points, diffusion by gradients of gradients", ("fixed nested",)),
          ("fluctuating", "RR98 Sec. II D", "fixed points under three stages, friction eta and not 2 eta", ("fluctuating",)),
          ("literal", "RR98 Eqs 34-36, 39", "points that move while their volumes stay", ("drift literal",)),
          ("constant-mass", "RR98 Eq. 49", "points that move with constant mass, their sound that of smooth particles",
           ("drift constant mass",)),
          ("moving", "RR98 Eqs 46-48", "moving points with closed faces, diffusion over these at 2.9 chi and not 4",
           ("moving",)))),
    near("dpd", "RR98 Eqs 39-41, 51", "dissipative particles that rest at kT = 0, a = 25, gamma = 4.5, rho = 3, two and three "
         "dimensions: noise begins to grow at their formula, 2/omega of a uniform fluid", DPD),
    near("dpd-settled", "RR98 Eqs 39-41, 51", "dissipative particles that rest at kT = 0, two and three dimensions: noise begins "
         "to grow where an eigenvalue of the step's linear map about settled particles leaves the unit circle", DPD,
         column="exact"),
    Claim(id="limit-step-safe", source="RR98 Eqs 34-51", value=least(RUNGE_KUTTA), at_least=0.99,
          statement="no method's own formula of the largest step is above the step at which noise begins to grow",
          because="formulas are read off stability regions to 0.4 %, trials find limits to 1 %"),
    Claim(id="limit-step-slack", source="RR98 Eqs 34-51", value=most(RUNGE_KUTTA), at_most=2.0,
          statement="no method's own formula of the largest step gives away more than a factor of 2",
          because="sound and diffusion, each at its limit, halve the step if their fastest waves are added though they differ"),
    Claim(id="limit-step-eigenvalues", source="KHP95 Sec. II", value=farthest(LINEAR, column="exact"), at_most=0.02,
          statement="noise begins to grow where an eigenvalue of the linearised sums leaves the integrator's region of "
          "stability, in all methods and scenes", because="trials see growth that is 1 % beyond its limit, and as much again"),
)
