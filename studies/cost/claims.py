"""What errors cost, judged: particles, points and grids    [KHP95 Secs I, II, VII; RR98 Sec. III]"""
import numpy as np
import pandas as pd

from studies.build.read import Value, ratio, select
from studies.cost import names
from studies.cost.derive import PARTS, of_part
from studies.kit.claim import CannotTell, Claim, judge
from studies.kit.stats import Measured
from studies.kit.table import Tables

FIXED = (names.NEAREST, names.LATTICE, names.WIDE, names.JITTERED, names.RELAXED)
STEADY = {"scene": "convection", "quantity": "K"}
#: quantities of the scenes that are fields
FIELD = {"convection": "K", "taylor-green": "velocity", "sound": "velocity", "conduction": "temperature", "couette": "velocity"}
MILLION = 0.95e6    # to one digit
#: N ln N from 1e3 to 1e6: ln(1e6)/ln(1e3) = 2 over three decades
N_LN_N = 1 + np.log10(2)/3


def seconds(tables: Tables, method: str, level: float, **where) -> Measured:
    """CPU seconds that a method takes to a level of error, its interval made symmetric by the wider half.

    Raises
    ------
    CannotTell
        The level was not reached, or already at the coarsest resolution.
    """
    row = select(tables, "needed", method=method, level=level, **where).iloc[0]
    if row["reached"] != "yes":
        more = f"its least error is {100*row['error']:.2g} %" if row["reached"] == "no" else "its coarsest run is below"
        raise CannotTell(f"{method} has no run on both sides of {100*level:g} % in {where['quantity']} of {where['scene']}: "
                         f"{more}")
    return Measured(float(row["cpu_s"]), float(max(row["high"] - row["cpu_s"], row["cpu_s"] - row["low"])))


def dearer(method: str, other: str, level: float, **where) -> Value:
    """Seconds of one over those of another."""
    return lambda tables: ratio(seconds(tables, method, level, **where), seconds(tables, other, level, **where))


def of_fixed(tables: Tables) -> Measured:
    """Seconds of the cheapest fixed points over those of the compressible grid in time, 1 % in K."""
    grid, found = seconds(tables, names.GRID, 0.01, **STEADY), []
    for name in FIXED:
        try:
            found.append(ratio(seconds(tables, name, 0.01, **STEADY), grid))
        except CannotTell:
            continue
    if not found:
        raise CannotTell("no fixed points have runs on both sides of 1 % in K: a larger SIZE of the study has")
    return min(found, key=lambda one: one.value)


def of_level(tables: Tables, grid: str, particles: str, column: str, **where) -> Measured:
    """`column` of the finest particles over that of the grid with the same error, by a power law between its resolutions.

    Where the coarsest grid is better already, over that of the coarsest grid: the ratio is then at least this.
    """
    both = {name: select(tables, "points", method=name, **where).sort_values("resolution") for name in (grid, particles)}
    best = both[particles].sort_values("error").iloc[0]
    known = both[grid].sort_values("error")
    x = np.log(known["error"].to_numpy(float))
    needed = float(np.exp(np.interp(np.log(best["error"]), x, np.log(known[column].to_numpy(float)))))
    if best["error"] < known["error"].min():
        raise CannotTell(f"{particles} are better than the finest {grid} of {where['scene']}")
    slope = np.gradient(np.log(known[column].to_numpy(float)), x).min() if len(known) > 1 else 0.0
    value = float(best[column])/needed
    return Measured(value, abs(value*slope*float(best["error_err"])/float(best["error"])))


def fewest(tables: Tables) -> Measured:
    """Least ratio, over the scenes, of the points of printed particles to those of a grid or lattice with the same error."""
    found = []
    for scene, quantity in FIELD.items():
        try:
            found.append(of_level(tables, rival(tables, scene), names.LUCY, "points", scene=scene, quantity=quantity))
        except CannotTell:
            continue
    if not found:
        raise CannotTell("not run yet: no scene has both printed particles and a grid or lattice")
    return min(found, key=lambda one: one.value)


def more_points(method: str, other: str, level: float) -> Value:
    """Points that a method needs for a level of error in K over those of another, between resolutions by power laws.

    Raises
    ------
    CannotTell
        One of the two has no run on both sides of the level.
    """
    def value(tables: Tables) -> Measured:
        for name in (method, other):
            seconds(tables, name, level, **STEADY)
        mine, others = (select(tables, "needed", method=name, level=level, **STEADY).iloc[0] for name in (method, other))
        return Measured(float(mine["points"])/float(others["points"]), 0.0)
    return value


def rival(tables: Tables, scene: str) -> str:
    """The grid of a scene, or the lattice with nearest neighbours that is one where no grid takes it."""
    for name in (names.GRID, names.MAC_IMEX, names.NEAREST):
        table: pd.DataFrame = tables.get("points", pd.DataFrame(columns=["scene", "method"]))
        if ((table["scene"] == scene) & (table["method"] == name)).any():
            return name
    raise CannotTell(f"not run yet: no grid in {scene}")


def exponent(method: str, **where) -> Value:
    """d ln(CPU seconds)/d ln(1/error)."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "exponents", method=method, **where).iloc[0]
        return Measured(float(row["exponent"]), float(row["exponent_err"]))
    return value


def growth(method: str, what: str, most: float) -> Value:
    """Exponent over the number of particles, or what two threads gain at the largest one; of `most` particles at least.

    Raises
    ------
    CannotTell
        There were not as many.
    """
    def value(tables: Tables) -> Measured:
        row = select(tables, "growth_laws", method=method, what=what).sort_values("most").iloc[-1]
        if row["most"] < most:
            raise CannotTell(f"{row['most']:.0f} particles at most were timed, not {most:.0f}: a larger SIZE of the study")
        return Measured(float(row["value"]), float(row["value_err"]))
    return value


def moved(tables: Tables) -> Measured:
    """How many of the other verdicts are others where the first, or the last, of the repeats of all seconds are all there are.

    Raises
    ------
    CannotTell
        None of them is decided yet, or the repeats are not known.
    """
    if "repeats" not in tables:
        raise CannotTell("not run yet: table repeats is not there")
    whole, *parts = (verdicts(one) for one in (tables, *(of_part(tables, part) for part in PARTS)))
    if not {"holds", "fails"} & set(whole.values()):
        raise CannotTell("not run yet: no verdict that a repeat could move")
    return Measured(float(max(sum(whole[name] != part[name] for name in whole) for part in parts)), 0.0)


def verdicts(tables: Tables) -> dict[str, str]:
    """By the ids of all claims on seconds."""
    return {row["id"]: row["verdict"] for row in judge(ON_SECONDS, tables, "speed")}


ON_SECONDS = (
    Claim(id="own-speed-fixed-points", source="RR98 Sec. III", at_most=2, value=of_fixed,
          statement="fixed points are no dearer than a grid: CPU seconds, setting up included, to the steady state of "
                    "Rayleigh-Benard at Ra 10 000 with 1 % in K, the cheapest fixed points' over the compressible grid's",
          because="a factor of 2 was asked for before anything was measured"),
    *(Claim(id=f"own-speed-fixed-points-5000{end}", source="RR98 Sec. III", at_most=2,
            value=dearer(names.NEAREST, names.GRID, 0.01, scene="convection-5000", quantity=quantity),
            statement="at half the Rayleigh number, 5000, fixed points are no dearer than a grid, either: CPU seconds of a "
                      f"lattice with h = 1.2 a for 1 % in {what} over the compressible grid's{asked}",
            because="the factor asked for at Ra 10 000")
      for end, quantity, what, asked in (
          ("", "K", "K, where their errors of second order happen to cancel,", ""),
          ("-velocity", "velocity", "velocity", " [asked after errors of K had been seen to cancel]"))),
    *(Claim(id=f"own-speed-fixed-points-{word}", source="RR98 Sec. III", at_most=2,
            value=dearer(names.NEAREST, names.GRID, 0.01, scene=scene, quantity="velocity"),
            statement=f"in {what} fixed points are no dearer than a grid: CPU seconds of a lattice with h = 1.2 a for 1 % in "
                      "velocity over the compressible grid's [asked after the grid's times had been seen]",
            because="the factor asked for in convection")
      for word, scene, what in (("vortex", "taylor-green", "a Taylor-Green vortex"), ("sound", "sound", "a sound wave"))),
    Claim(id="own-speed-fixed-points-staggered", source="RR98 Sec. III", at_most=2,
          value=dearer(names.NEAREST, names.PYPDE_GAS, 0.01, scene="taylor-green", quantity="velocity"),
          statement="in a Taylor-Green vortex fixed points are no dearer than a staggered grid, whose friction is between "
                    "nearest neighbours, too: CPU seconds of a lattice with h = 1.2 a for 1 % in velocity over py-pde's, at "
                    "the limit of its formula [asked after both had been seen]", because="the factor asked for in convection"),
    *(Claim(id=f"own-speed-moving-points-{word}", source="RR98 Sec. III", at_most=10,
            value=dearer(names.MOVING, names.GRID, 0.01, scene=scene, quantity="velocity"),
            statement=f"in {what} points that move and exchange over closed faces cost less than ten grids: CPU seconds for 1 % "
                      "in velocity over those of the compressible grid [asked after runs to 1.3 and 1.03 % had been seen]",
            because="an order of magnitude")
      for word, scene, what in (("vortex", "taylor-green", "a Taylor-Green vortex"), ("sound", "sound", "a sound wave"))),
    Claim(id="own-speed-lattice", source="RR98 Sec. III", at_most=2, value=dearer(names.LATTICE, names.GRID, 0.01, **STEADY),
          statement="a lattice with h = 2 a is no dearer than a grid: its CPU seconds for 1 % in K over the compressible grid's",
          because="a factor of 2 was asked for before anything was measured"),
    Claim(id="own-speed-moving-points", source="RR98 Sec. III", at_most=10,
          value=dearer(names.MOVING, names.GRID, 0.01, **STEADY),
          statement="points that move and exchange over closed faces cost less than ten grids: CPU seconds for 1 % in K over "
                    "those of the compressible grid", because="an order of magnitude"),
    Claim(id="own-speed-particles", source="KHP95 Sec. VII", printed="economically desirable", at_most=1,
          value=lambda tables: of_level(tables, names.GRID, names.LUCY, "cpu_s", **STEADY),
          statement="smooth particles are economical: CPU seconds of the printed scheme, at its least error in K at Ra 10 000, "
                    "over those of the compressible grid with that error (the coarsest one if it is better)",
          because="as cheap as the grid that the paper compares with"),
    Claim(id="own-speed-freedoms", source="KHP95 Sec. VII", printed="many fewer degrees of freedom", at_most=0.5, value=fewest,
          statement="in some cases particles need many fewer degrees of freedom than equally accurate grids: particles of the "
                    "printed scheme over points of a grid or lattice with the same error, least ratio over all scenes",
          because="half at most: many fewer"),
    Claim(id="own-speed-rk4-vortex", source="RR98 Eq. 40", at_most=1,
          value=dearer(names.TWO_STEP, names.LATTICE, 0.01, scene="taylor-green", quantity="velocity"),
          statement="forward Euler is enough: CPU seconds of the two-step scheme for 1 % in a Taylor-Green vortex over those of "
                    "fourth-order Runge-Kutta, each at its largest step", because="no dearer than the other"),
    Claim(id="own-speed-growth-spam", source="KHP95 Sec. II", printed="N ln N", at_most=round(N_LN_N, 3),
          value=growth(names.LUCY, "exponent", MILLION),
          statement="a step takes a time no worse than N ln N: exponent of its CPU seconds over a thousand to a million smooth "
                    "particles, lists included", because="N ln N over three decades has the exponent 1 + log10(2)/3 = 1.100"),
    Claim(id="own-speed-growth-fixed", source="RR98 Sec. III", at_most=round(N_LN_N, 3),
          value=growth(names.LATTICE, "exponent", MILLION),
          statement="a step over stored edges takes a time no worse than N ln N: exponent of its CPU seconds over a thousand to "
                    "a million fixed points", because="the same limit as for smooth particles"),
    Claim(id="own-speed-threads-spam", source="KHP95 Sec. I", printed="straightforward", at_least=1.7,
          value=growth(names.LUCY, "two threads", 1e5),
          statement="smooth particles are easily computed in parallel: time that passes with one thread over that with two, at "
                    "the largest number of particles", because="85 % of what two cores can give"),
    *(Claim(id=f"own-speed-exponent-{name}", source="RR98 Sec. III", expect=1.5, within=0.25, value=exponent(method, **where),
            statement=f"second order in space, steps as long as they are good: d ln(CPU seconds)/d ln(1/error) of {what}",
            because="points a^-2 times steps a^-1 over an error a^2; 0.25: set-up and short loops weigh at small sizes")
      for name, method, where, what in (
          ("grid", names.GRID, STEADY, "the compressible grid, K of convection"),
          ("grid-fall", names.GRID, STEADY | {"quantity": "K(t)"},
           "the compressible grid, K(t) of convection over 30 free-fall times, so that no run is longer for a smaller error"),
          ("vortex", names.LATTICE, {"scene": "taylor-green", "quantity": "velocity"}, "a lattice, h = 2 a, Taylor-Green"))),
)
#: RR98's r0, the rms width of Lucy's weight, is 1.27, 0.85, 0.51 spacings for h = 3, 2, 1.2
ON_POINTS = tuple(
    Claim(id=f"rr98-speed-points-{name}", source="RR98 Sec. IV", printed=printed, at_least=1, because="as many",
          value=more_points(method, names.GRID, 0.01),
          statement=f"one needs more particles than points in a grid, for Eq. 45: points of a lattice with {h} the spacing, over "
                    "those of the compressible grid, each with 1 % error in K of Rayleigh-Benard at Ra 10 000")
    for name, method, h, printed in (
        ("wide", names.WIDE, "h = 3 a, r0 = 1.27 a above", "more particles than points in a grid"),
        ("nearest", names.NEAREST, "h = 1.2 a, r0 = 0.51 a below", "")))
CLAIMS = (*ON_SECONDS, *ON_POINTS, Claim(
    id="own-speed-repeat", source="KHP95 Sec. VII", at_most=0, value=moved,
    statement="a repeat moves no verdict: verdicts on seconds that are others where the first, or the last, of the repeats of "
              "every timing are all there are", because="none is to change"))
