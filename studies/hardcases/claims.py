"""Claims about where methods break."""
from collections.abc import Callable

from continuum.fluid import DenseFluid, IdealGas
from studies.hardcases import survives
from studies.hardcases.tubes import BARELY, CELL_NUMBER, STEPS
from studies.kit.ask import (
    Value,
    farthest_of,
    last,
    least,
    of,
    one,
    over_seeds,
    rows,
    total,
)
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables

# --- the square of Fig. 10 ------------------------------------------------------------------------

FIG_10 = "KHP95 Sec. VI, Fig. 10"
ALIVE = 0.1         # of K at the start: below, what is left of the mean flow says how it began
SINGLE = "single particles have 1.3, pairs 2 or more"


def rolls(ra: float) -> Value:
    """Number of rolls of Monaghan's particles in the gas, if the mean flow is not a remnant of the start."""
    def value(tables: Tables) -> Measured:
        run = rows(tables, "squares", eos="IdealGas", weight="Monaghan", ra=ra).iloc[0]
        left = run["flow"]/run["begun"]
        if left < ALIVE:
            raise CannotTell(f"the flow has stopped, K of the mean flow is {left:.2g} of that at the start "
                             f"and not {ALIVE:g} at least, and {100*run['shared']:.0f} % of the particles "
                             f"are paired, of one seed at Ra {ra:g}: its {run['rolls']:.0f} rolls are what "
                             "is left of the start")
        return Measured(float(run["rolls"]))
    value.__doc__ = ("rolls in squares where eos = IdealGas, weight = Monaghan, "
                     f"ra = {ra:g}, flow/begun >= {ALIVE:g}")
    return of(value)


def pairs(eos: str, key: str, fluid: str, ra: float) -> tuple[Claim, Claim]:
    """Monaghan's particles move in pairs, Lucy's do not."""
    ratio = "median of second over first neighbour distance"
    return (
        Claim(id=f"khp95-hard-fig10-{key}pairs-monaghan", source=FIG_10, because=SINGLE, at_least=2,
              headline=not key,
              printed="common to both" if key else "pairs",
              value=one("squares", "ratio", eos=eos, weight="Monaghan", ra=ra),
              statement=f"in the {fluid} of Fig. 10 Monaghan's particles move in pairs: {ratio}"),
        Claim(id=f"khp95-hard-fig10-{key}pairs-lucy", source=FIG_10, because=SINGLE, at_most=1.6,
              headline=not key,
              printed="no such pairing", value=one("squares", "ratio", eos=eos, weight="Lucy", ra=ra),
              statement=f"in the {fluid} of Fig. 10 Lucy's particles do not pair: {ratio}"))


SQUARES = (
    *pairs("IdealGas", "", "gas", 67150.0),
    *pairs("DenseFluid", "dense-", "dense fluid", 511200.0),
    Claim(id="khp95-hard-fig10-two-rolls", source=FIG_10, printed="two rolls", expect=2, within=0,
          headline=True,
          value=rolls(67150.0), because="a whole number",
          statement="2500 particles of the gas of Fig. 10 have two rolls, after a start with two"),
    Claim(id="khp95-hard-fig10-one-roll", source=FIG_10, printed="one", expect=1, within=0,
          value=rolls(1e4), because="a whole number",
          statement="2500 particles of the gas of Fig. 10 have one roll at twice the critical Ra, after a "
                    "start with two"),
    *(Claim(id=f"khp95-hard-fig10-rayleigh-{name}", source=FIG_10, printed="350 000", expect=1, within=0.05,
            # Ra of a scene, whose kappa is k/(rho C_V), with kappa = k
            value=last("squares", f"ra/{eos.cv:g}/350000", by="ra", eos=type(eos).__name__,
                       weight="Monaghan"),
            because="two printed digits",
            statement=f"printed viscosities and a static density of 1 give the printed Ra, alpha that of the "
                      f"{fluid} at mid-height, kappa = k: Ra of the {kind} {fluid} over 350 000")
      for name, eos, kind, fluid in (("dense", DenseFluid(), "dense", "fluid"),
                                     ("gas-own", IdealGas(), "ideal", "gas"))),
)

# --- shocks ---------------------------------------------------------------------------------------

METHODS = {"grid": "compressible grid", "fixed-lattice": "fixed points on a lattice",
           "fixed-jittered-delaunay": "fixed points, jittered", "moving": "moving points with closed faces",
           "moving-delaunay": "points that move with their triangulation"}
VISCOUS, LONG, SHORT = 0.5, *STEPS
OPEN = {"moving": "three starts had left it open, and more were run"}


def longest(method: str, value: str, eta: float) -> Value:
    """Of a method's longest tube; over seeds where points lie as a seed says."""
    ask: Callable = one if method in ("grid", "fixed-lattice") else over_seeds
    return ask("method_tubes", value, method=method, eta=eta, step=LONG, L=96)


def of_method(method: str, words: str) -> tuple[Claim, ...]:
    """What is asked of each method."""
    fields = [longest(method, f"{name}_grid", VISCOUS) for name in ("rho", "v", "P")]
    return (
        Claim(id=f"own-sod-{method}-grid", source="Sod 1978", at_most=0.01,
              value=farthest_of(*fields, centre=0.0), because="1 %, as is asked of smooth particles",
              after=OPEN.get(method, ""),
              statement=f"{words}, eta = k = {VISCOUS:g}: density, velocity and pressure are those of a fine "
                        "grid as viscous: largest mean difference over its range, longest tube"),
        Claim(id=f"own-sod-{method}-rings", source="Sod 1978", at_most=0.1,
              value=longest(method, "wiggles", BARELY),
              statement=f"{words}: nothing rings if v a/nu of the contact's velocity behind the shock is "
                        f"{CELL_NUMBER:g}: variation of v beyond that of the exact solution, over it, "
                        "longest tube",
              because="central differences keep order below a cell number of 2; a tenth is no ringing, as "
                      "for smooth particles"),
        Claim(id=f"own-sod-{method}-robust-short", source="Sod 1978", at_most=0, because="none",
              value=total("method_tubes", "reached < 1", method=method, eta=0.0, step=SHORT),
              statement=f"{words}: Sod's shock is taken without any viscosity in steps of an eighth of the "
                        "limit at the start: tubes that ended before their time",
              after="runs had ended at four times this step"))


SHOCKS = (
    *(claim for method, words in METHODS.items() for claim in of_method(method, words)),
    Claim(id="khp95-hard-sod-robust",
          source="KHP95 Sec. VI", printed="robust, highly stable", at_most=0, because="none",
          value=total("method_tubes", "reached < 1", method="spam"),
          statement="smooth particles take Sod's shock, with viscosity and without: tubes that diverged"),
    Claim(id="own-hard-sod-grid-v", source="KHP95 Sec. II", at_most=0.01,
          value=over_seeds("method_tubes", "v_grid", method="spam", eta=VISCOUS, L=192),
          statement="the longest viscous tube has the v of a grid as viscous: mean difference over its range",
          after="three seeds had left the ringing of this tube near its limit, and thirteen more were run",
          because="1 %, what KHP95 say that fluctuations disguise"),
    Claim(id="khp95-hard-ripple-robust",
          source="KHP95 Sec. VI", printed="robust, highly stable", at_most=0, because="none",
          value=total("ripples", "height != height"),
          statement="gases that fall onto a mirror are taken, however they lie at the start: interfaces "
                    "whose run diverged", after="one had"),
    Claim(id="khp95-hard-ripple-growth", source="KHP95 Sec. VI, Fig. 11", printed="2%", expect=1, within=0.02,
          headline=True, evidence="hardcases/shocks.png",
          value=last("ripple_growth", "growth", by="scale", steep=0.25),
          because="the printed 2 %; impulsive theory is itself an approximation",
          statement="a shocked ripple grows as theory says, density ratio 4, Mach 1.5 from the light side, k "
                    "a = 0.25, all of it four times as large as printed: growth rate over the impulsive one"),
)

# --- the highest Ra -------------------------------------------------------------------------------

HIGH_RA = tuple(
    Claim(id=f"own-high-ra-{method}-foretold", source="KHP95 Sec. VI", at_most=2*CELL_NUMBER,
          after=OPEN.get(method, ""),
          value=one("high_ra_summary", "cell_number", method=method, kind="wrong", step=1.0),
          statement=f"{words}, 16 rows: as Ra is raised a cell number of 2 foretells what ends or goes "
                    "wrong: v a/nu of the fastest flow, where K is off by a factor of 1.25 or runs end",
          because="no formula is known for the end of a run; a rule of thumb is worth a factor of 2")
    for method, words in METHODS.items())

# --- the map --------------------------------------------------------------------------------------

CARRIED = "moving-delaunay"
ENDS = "a run ends or it does not"


def right(case: str, method: str, source: str, number: str, statement: str) -> Claim:
    """The flow is as the fine grid or the exact solution has it, to a tenth."""
    name = f"{case} {method}".lower().replace(" ", "-")
    return Claim(id=f"own-map-{name}", source=source, expect=1.0, within=0.1, statement=statement,
                 value=one("map", "measured", case=case, method=method, number=number),
                 because="a tenth is what separates `right` from `wrong` on the map")


WAVE = "a wave on a shear flow without viscosity grows by linear theory"
MAP = (
    right("zero viscosity", "grid", "KHP95 Sec. V", "flow/start",
          "without viscosity the centred grid keeps a vortex for five turns, 16 rows"),
    right("zero viscosity", "fixed-lattice", "RR98 Eqs 34-36, 51", "flow/start",
          "points on a lattice have the grid's flow, zero viscosity, 16 rows"),
    Claim(id="khp95-map-robust", source="KHP95 Sec. VI", at_least=1.0, because=ENDS,
          value=least("hard_runs", "reached", case=("Ra 1e5", "Ra 1e6"), method="spam"),
          printed="the \"robust\" smooth-particle technique continues to provide solutions",
          statement="smooth particles as printed run to the end at Ra 1e5 and 1e6 on 16 rows"),
    right("shear layer", CARRIED, "RR98 Sec. III", "growth/linear",
          f"{METHODS[CARRIED]} know Kelvin-Helmholtz: {WAVE}"),
    *(Claim(id=f"own-map-{case.replace(' ', '-')}-{CARRIED}", source="RR98 Sec. III", at_most=at_most,
            value=one("map", "measured", case=case, method=CARRIED), because=because,
            statement=f"{METHODS[CARRIED]} {words}")
      for case, at_most, because, words in (
          ("long rest", 1e-8, "1e-16 of the energy: round-off of a sum over all steps",
           "come to rest below onset, and nothing grows in 10 000 free-fall times: speed over sound's"),
          ("alternating densities", 0.1, "a tenth is what separates `right` from `wrong`",
           "hide no density that alternates: what is left of one after sound has gone to and fro 35 times"))),
    Claim(id="own-high-ra-moving-delaunay-stable", source="KHP95 Sec. VI", at_least=1e7, because=ENDS,
          value=one("high_ra_summary", "ra_low", method=CARRIED, kind="ends", step=1.0),
          statement=f"{METHODS[CARRIED]} come to their end up to Ra 1e7, 16 rows: the least Ra at which one "
                    "of all starts ended"),
    right("shear layer", "grid", "KHP95 Sec. V", "growth/linear",
          f"{WAVE}, the centred grid, 16 cells to the flow's wavelength"),
    right("shear layer", "fixed-lattice", "RR98 Eqs 34-36", "growth/linear",
          f"{WAVE}, points on a lattice, 16 spacings to the flow's wavelength"),
)

CLAIMS = (*SQUARES, *SHOCKS, *HIGH_RA, *MAP, *survives.CLAIMS)
