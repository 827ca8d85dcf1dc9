"""Claims about the squares of Fig. 10    [KHP95, Sec. VI]"""
from continuum.fluid import DenseFluid, IdealGas
from studies.build.read import Value, select
from studies.hardcases.read import column
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables


def printed_ra(eos: str, alpha: float | None) -> Value:
    """g alpha L^3 dT/(eta k) of a square of Fig. 10 at its eta, alpha its own or as said, over the printed 350 000."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "squares", eos=eos, weight="Monaghan").sort_values("ra").iloc[-1]
        own = row["ra"]/HEAT[eos]       # scenes have kappa = k/(rho C_V)
        return Measured(float(own*(1 if alpha is None else alpha/row["alpha"])/350000), 0.0)
    return value


def kept_flowing(tables: Tables) -> Measured:
    """Least K of the mean flow over that at the start, squares of the dense fluid."""
    rows = select(tables, "squares", eos="DenseFluid")
    return Measured(float((rows["flow"]/rows["begun"]).min()), 0.0)


def rolls(ra: float) -> Value:
    """Number of rolls of Monaghan's particles, where the mean flow is not a remnant of the start.

    Raises
    ------
    CannotTell
        Less than ALIVE of the start's K is left: two rolls that stopped did not stay two.
    """
    def value(tables: Tables) -> Measured:
        row = select(tables, "squares", eos="IdealGas", weight="Monaghan", ra=ra).iloc[0]
        left = row["flow"]/row["begun"]
        if left < ALIVE:
            raise CannotTell(f"the flow has stopped, K of the mean flow is {left:.2g} of that at the start and not "
                             f"{ALIVE:g} at least, and {100*row['shared']:.0f} % of the particles are paired, of one seed at "
                             f"Ra {ra:g}: its {row['rolls']:.0f} rolls are what is left of the start")
        return Measured(float(row["rolls"]), 0.0)
    return value


ALIVE = 0.1         # of K at the start: below, what is left of the mean flow says how it began
HEAT = {"IdealGas": IdealGas().cv, "DenseFluid": DenseFluid().cv}
SINGLE = "single particles have 1.3, pairs 2 or more"
SQUARES = (
    Claim(id="khp95-hard-fig10-pairs-monaghan", source="KHP95 Sec. VI, Fig. 10", printed="pairs", at_least=2,
          value=column("squares", "ratio", "ratio_err", eos="IdealGas", weight="Monaghan", ra=67150.0),
          statement="in the gas of Fig. 10 Monaghan's particles move in pairs: median of second over first neighbour distance",
          because=SINGLE),
    Claim(id="khp95-hard-fig10-pairs-lucy", source="KHP95 Sec. VI, Fig. 10", printed="no such pairing", at_most=1.6,
          value=column("squares", "ratio", "ratio_err", eos="IdealGas", weight="Lucy", ra=67150.0),
          statement="in the gas of Fig. 10 Lucy's particles do not pair: median of second over first neighbour distance",
          because=SINGLE),
    Claim(id="khp95-hard-fig10-two-rolls", source="KHP95 Sec. VI, Fig. 10", printed="two rolls", expect=2, within=0,
          value=rolls(67150.0), because="a whole number",
          statement="2500 particles of the gas of Fig. 10 have two rolls, after a start with two"),
    Claim(id="khp95-hard-fig10-one-roll", source="KHP95 Sec. VI, Fig. 10", printed="one", expect=1, within=0,
          value=rolls(1e4), because="a whole number",
          statement="2500 particles of the gas of Fig. 10 have one roll at twice the critical Ra, after a start with two"),
    Claim(id="khp95-hard-fig10-dense-pairs-monaghan", source="KHP95 Sec. VI, Fig. 10", printed="common to both", at_least=2,
          value=column("squares", "ratio", "ratio_err", eos="DenseFluid", weight="Monaghan"), because=SINGLE,
          statement="in the dense fluid of Fig. 10 Monaghan's particles move in pairs: median of second over first neighbour "
                    "distance"),
    Claim(id="khp95-hard-fig10-dense-pairs-lucy", source="KHP95 Sec. VI, Fig. 10", printed="no such pairing", at_most=1.6,
          value=column("squares", "ratio", "ratio_err", eos="DenseFluid", weight="Lucy"), because=SINGLE,
          statement="in the dense fluid of Fig. 10 Lucy's particles do not pair: median of second over first neighbour distance"),
    Claim(id="khp95-hard-fig10-dense-flows", source="KHP95 Sec. VI, Fig. 10", at_least=1, value=kept_flowing,
          statement="the dense fluid, which freezes at Ra 3000, convects between 10 and 0.5: least K of the mean flow over that "
                    "at the start", because="rolls that do not convect have died out after 25 free-fall times"),
    *(Claim(id=f"khp95-hard-fig10-rayleigh-{name}", source="KHP95 Sec. VI, Fig. 10", printed="350 000", expect=1, within=0.05,
            value=printed_ra(eos, alpha), because="two printed digits",
            statement=f"printed viscosities and a static density of 1 give the printed Ra, alpha {words}, kappa = k: Ra of the "
                      f"{fluid} over 350 000")
      for name, eos, fluid, alpha, words in (("gas", "IdealGas", "ideal gas", 1.0, "taken as 1"),
                                             ("gas-own", "IdealGas", "ideal gas", None, "that of the gas at mid-height"),
                                             ("dense", "DenseFluid", "dense fluid", None, "that of the fluid at mid-height"))),
)
