"""KHP95's hard cases, judged: lattices, pairs and clumps, freezing, molecules, shocks"""
from collections.abc import Callable
from itertools import product
from math import hypot
from typing import Any

import pandas as pd

from studies.build.read import Value, over_seeds, select
from studies.hardcases.interface.runs import impulse
from studies.hardcases.read import column
from studies.hardcases.square.claims import SQUARES
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.lattices.freezing_claims import FREEZING

VISCOUS: dict[str, Any] = {"eta": 0.5}


def worst(table: str, **where) -> Value:
    """Largest |measured/predicted - 1| of some rows, with the largest relative error among them."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, table, **where)
        off = (rows["measured"]/rows["predicted"] - 1).abs()
        return Measured(float(off.max()), float((rows["measured_err"]/rows["predicted"].abs()).max()))
    return value


def clumping(T: float, rho: float) -> Value:
    """Largest temperature, among the weights, at which lattices of a van der Waals fluid begin to clump, over T."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "onsets", parameter="T", rho=rho)
        return Measured(float(rows["measured"].max())/T, float(rows["measured_err"].max())/T)
    return value


def pressureless(rho: float) -> float:
    """T at which P = rho T/(1 - rho/2) - rho^2/2 vanishes    [KHP95, Eq. 2]"""
    return rho*(1 - rho/2)/2


def spinodal(rho: float) -> float:
    """T at which (dP/drho)_T = T/(1 - rho/2)^2 - rho vanishes."""
    return rho*(1 - rho/2)**2


def summed_alike(tables: Tables) -> Measured:
    """Largest difference of moduli by compiled sums and by lattice sums."""
    rows = select(tables, "moduli").dropna()
    return Measured(float((rows["exact"] - rows["measured"]).abs().max()), 0.0)


def over(table: str, name: str, **where) -> Value:
    """Mean over seeds of a column."""
    return lambda tables: over_seeds(select(tables, table, **where)[name].tolist())


def foretold(tables: Tables) -> Measured:
    """Part of the runs whose median number of particles a site is that of the lattice of least energy, ranges alike."""
    rows = select(tables, "fates")
    right = (rows["sites"] == rows["predicted"]).groupby([rows["weight"], rows["h"]]).mean()
    return Measured(float(right.mean()), 0.0)


def equal_bits(tables: Tables) -> Measured:
    """Least part of the coordinates that come back to the last bit."""
    return Measured(float(select(tables, "reversal", integrator="whole numbers")["equal"].min()), 0.0)


def returned(tables: Tables) -> Measured:
    """Time there and back to a tenth of a spacing over what the rate of twins says, over seeds."""
    rows = select(tables, "returns").dropna()
    if rows.empty:
        raise CannotTell("no path that leapt was a tenth of a spacing off within the times that were run")
    seeds = over_seeds((rows["measured"]/rows["predicted"]).tolist())
    return Measured(seeds.value, hypot(seeds.err, float((rows["rate_err"]/rows["rate"]).max())))


def longest(name: str, **where) -> Value:
    """Mean over seeds of a column of the longest tubes."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "tubes", **where)
        return over_seeds(rows[rows["L"] == rows["L"].max()][name].dropna().tolist())
    return value


def kept_ripple(tables: Tables) -> Measured:
    """Amplitude of the ripple of k a = 0.75 when the shock comes over that at the start, means over five times, over seeds."""
    theory = impulse(1.0, 0.75)
    rows = select(tables, "ripples", scale=1.0, steep=0.75).sort_values("time")
    before = rows[rows["time"] < 0.95*theory.meets].groupby("seed")["amplitude"]
    return over_seeds((before.apply(lambda a: a.iloc[-5:].mean())/before.apply(lambda a: a.iloc[:5].mean())).tolist())


def fell(tables: Tables) -> Measured:
    """Tubes that diverged."""
    return Measured(float(select(tables, "tubes")["diverged"].notna().sum()), 0.0)


def lost(tables: Tables) -> Measured:
    """Interfaces whose run diverged."""
    return Measured(float(select(tables, "ripples")["height"].isna().sum()), 0.0)


def finest(name: str, steep: float = 0.25) -> Callable[[Tables], Measured]:
    """A column of the interfaces of the largest scale."""
    def value(tables: Tables) -> Measured:
        rows: pd.DataFrame = select(tables, "ripple_growth", steep=steep).sort_values("scale")
        return Measured(float(rows[name].iloc[-1]), float(rows[f"{name}_err"].iloc[-1]))
    return value


TENTH = "a tenth is asked of predicted limits"
#: order of the modulus in 1/h: two powers of h less than the weight's transform, (Kh)^-(n + 3/2) for w ~ (1 - q)^n at the range
ORDERS = {"Lucy": 2.5, "Monaghan": 2.5, "WendlandC2": 3.5}
LATTICES = (
    Claim(id="khp95-hard-modulus-summed", source="KHP95 Sec. II", value=summed_alike, at_most=1e-8,
          statement="the sums that run have the shear moduli of lattice sums: largest difference over the bulk modulus, three "
                    "weights, ranges to 6 spacings", because="second differences over strains of 1e-3: round-off of 1e-10, "
                                                            "times the number of neighbours"),
    *(Claim(id=f"khp95-hard-modulus-order-{kind}-{weight.lower()}", source="KHP95 Sec. II", expect=order, within=0.25,
            value=column("modulus_orders", "order", "order_err", lattice=kind, weight=weight),
            statement=f"the spurious shear modulus vanishes with the power of the range that the end of the weight has: order in "
                      f"1/h, ranges 3 to 24, {weight}, {kind} lattice",
            because="the next power of h is one less: a tenth of an order over this span, and as much for what is left of the "
                    "oscillation")
      for kind, (weight, order) in product(("hexagonal", "square"), ORDERS.items())),
    Claim(id="khp95-hard-growth", source="KHP95 Sec. III", value=worst("growth"), at_most=0.01,
          statement="lattices that are not stable melt as lattice sums say: largest relative difference of growth rates, ideal "
                    "gas and van der Waals", because="1 %: motions of up to a hundredth of a spacing are linear to that"),
    Claim(id="khp95-hard-pairing-onset", source="KHP95 Sec. VI, Fig. 10", value=worst("onsets", parameter="h"), at_most=0.1,
          statement="the range from which lattices are unstable, Monaghan's to pairing, is that of lattice sums: largest "
                    "relative difference", because=TENTH),
    Claim(id="khp95-hard-clumping-onset", source="KHP95 Sec. IV, Eq. 2", value=worst("onsets", parameter="T"), at_most=0.1,
          statement="the temperature below which van der Waals lattices clump is that of lattice sums: largest relative "
                    "difference", because=TENTH),
    Claim(id="khp95-hard-clumping-pressure", source="KHP95 Sec. IV, Eq. 2", value=clumping(pressureless(1.2), 1.2), expect=1,
          within=0.1, because=TENTH,
          statement="particles clump from where the pressure is negative: temperature over that of P = 0, density 1.2"),
    Claim(id="khp95-hard-clumping-stable", source="KHP95 Sec. IV, Eq. 2", value=clumping(spinodal(1.2), 1.2), at_most=1,
          statement="particles clump only where the van der Waals fluid itself is unstable: temperature over that of the "
                    "spinodal, density 1.2", because="beyond 1 it is the particles that clump, not the fluid"),
)


CHANCE = "of particles at random 0.54 have a neighbour within half a spacing"
PAIRS = (
    Claim(id="khp95-hard-pairs-monaghan", source="KHP95 Sec. VI", printed="closely associated pairs", at_least=0.8,
          statement="with Monaghan's weight, h = 3, particles end in pairs: part that has another within half a spacing, gas "
                    "left to rest", value=over("fates", "shared", weight="Monaghan", h=3.0), because=CHANCE),
    Claim(id="khp95-hard-pairs-lucy", source="KHP95 Sec. VI", printed="no such pairing", at_most=0.1, because=CHANCE,
          statement="with Lucy's weight, h = 3, particles do not end in pairs: part that has another within half a spacing, gas "
                    "left to rest", value=over("fates", "shared", weight="Lucy", h=3.0)),
    Claim(id="khp95-hard-sites-foretold", source="KHP95 Secs III, IV", value=foretold, at_least=0.9,
          statement="particles end as many a site as the hexagonal lattice of least energy has, 1 to 4: part of the runs, three "
                    "weights, ranges 2 to 4", because="a tenth may lie where two numbers have nearly the same energy"),
)
MOLECULES = (
    Claim(id="khp95-hard-molecules", source="KHP95 Sec. III", printed="identical", at_most=1e-11,
          statement="for P ~ rho^2 compiled smooth particles keep paths of molecules: rms distance at t = 10, 64 particles",
          value=column("twins", "apart", weight="Lucy", time=10.0),
          because="round-off of 1e-16 that grows by a factor of e in a time of 1 at the fastest"),
    Claim(id="khp95-hard-reversal", source="KHP95 Sec. III", printed="exact reversibility", expect=1, within=0, value=equal_bits,
          statement="paths run back exactly when velocities turn: part of the coordinates that come back to the last bit, in "
                    "whole numbers, times to 100", because="exact is all of them"),
    Claim(id="khp95-hard-reversal-time", source="KHP95 Sec. III", value=returned, expect=1, within=0.2,
          statement="with round-off paths come back as long as it has not grown to a tenth of a spacing: time of leapfrog over "
                    "ln(0.1/2^-52)/rate, the rate that of twins", because="a fifth: ln 1000 of ln(0.1/2^-52) = 34 is not known: "
                                                                          "round-offs of a path add up"),
)
SHOCKS = (
    Claim(id="khp95-hard-sod-robust", source="KHP95 Sec. VI", printed="robust, highly stable", at_most=0, value=fell,
          statement="smooth particles take Sod's shock, with viscosity and without: tubes that diverged", because="none"),
    *(Claim(id=f"khp95-hard-sod-order-{name}", source="KHP95 Sec. II", at_least=low, at_most=1.2, because=why,
            value=column("tube_orders", "order", "order_err", eta=0.5, quantity=name),
            statement=f"the tube with eta = k = 0.5 converges on the exact solution as it gets longer: order of the mean error "
                      f"of {name} in 1/L")
      for name, low, why in (("v", 0.8, "shocks are some spacings wide, however long the tube: first order, and 0.2 for heads of "
                                        "rarefactions"),
                             ("P", 0.8, "shocks are some spacings wide, however long the tube: first order, 0.2 for heads of "
                                        "rarefactions"),
                             ("rho", 0.5, "the contact is as wide as the root of the time: order 1/2 there, 1 elsewhere"))),
    *(Claim(id=f"khp95-hard-sod-grid-{name}", source="KHP95 Sec. II", at_most=0.01, value=longest(f"{name}_grid", **VISCOUS),
            statement=f"the longest viscous tube has the {name} of a grid as viscous: mean difference over its range",
            because="1 %, what KHP95 say that fluctuations disguise") for name in ("rho", "v", "P")),
    Claim(id="khp95-hard-sod-in-order", source="KHP95 Sec. II", at_most=3, value=longest("overlap", eta=0.0),
          statement="without viscosity, and none is artificial, both gases still do not pass through each other: overlap in "
                    "spacings, longest tube", because="the range, within which they push each other back"),
    Claim(id="khp95-hard-sod-rings", source="KHP95 Sec. II", at_most=0.1, value=longest("wiggles", eta=0.0),
          statement="the printed scheme, which has no artificial viscosity, takes a shock without ringing if the fluid has none: "
                    "variation of v beyond that of the exact solution, over it, longest tube", because="a tenth is no ringing"),
    Claim(id="khp95-hard-sod-rings-viscous", source="KHP95 Sec. II", at_most=0.1, value=longest("wiggles", **VISCOUS),
          statement="with eta = 0.5 the printed scheme takes a shock without ringing: variation of v beyond that of the exact "
                    "solution, over it, longest tube", because="a tenth is no ringing"),
    Claim(id="khp95-hard-ripple-kick", source="KHP95 Sec. VI, Fig. 11", value=finest("kick"), expect=1, within=0.02,
          statement="a shock of Mach 1.5 gives the interface the velocity of the exact solution: measured over exact",
          because="2 %, as printed for the growth"),
    Claim(id="khp95-hard-ripple-robust", source="KHP95 Sec. VI", printed="robust, highly stable", at_most=0, value=lost,
          statement="gases that fall onto a mirror are taken, however they lie at the start: interfaces whose run diverged "
                    "[asked after one had]", because="none"),
    Claim(id="khp95-hard-ripple-rest", source="KHP95 Sec. VI, Fig. 11", value=kept_ripple, at_least=0.95,
          statement="two gases of one pressure keep the ripple between them until the shock comes: amplitude then over that at "
                    "the start, printed size, k a = 0.75",
          because="a twentieth of 3.6 spacings is what strips tell; asked after growth had been seen to fall short"),
    Claim(id="khp95-hard-ripple-growth", source="KHP95 Sec. VI, Fig. 11", printed="2%", value=finest("growth"), expect=1,
          within=0.02, because="the printed 2 %; impulsive theory is itself an approximation",
          statement="a shocked ripple grows as theory says, density ratio 4, Mach 1.5 from the light side, k a = 0.25, all of it "
                    "four times as large as printed: growth rate over the impulsive one"),
    Claim(id="khp95-hard-ripple-steep", source="KHP95 Sec. VI, Fig. 11", value=column("ripple_growth", "growth", "growth_err",
                                                                                     scale=1.0, steep=0.75), at_least=0.5,
          statement="at the printed size a shocked ripple that stands out of the particles, k a = 0.75, grows at half of the "
                    "impulsive rate at least", because="what k a = 0.75 takes from linear growth is less than half"),
)
CLAIMS = (*LATTICES, *PAIRS, *SQUARES, *FREEZING, *MOLECULES, *SHOCKS)
