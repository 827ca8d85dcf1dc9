"""Claims of KHP95 on critical Rayleigh numbers, judged by the study `onset`.

A quantity of the table critical_ra has three parts: the box, how the gas differs from the ideal one with
constant eta and dT = 1, and in brackets how it was found: "ra_c periodic aspect 2, const-nu (growth rates)".
"""
from collections.abc import Callable
from functools import partial
from typing import Any

from studies.build.names import as_printed
from studies.kit.ask import Value, largest, of, one, power
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

LAYER, SQUARE, INFINITE = "ra_c periodic aspect 2", "ra_c square conducting", "ra_c infinite layer rigid"
GROWTH, LINE_L2 = " (growth rates)", " (K line, L^-2 extrapolated)"


def linear(place: str) -> Value:
    """Critical Ra of linear theory."""
    return one("critical_ra", "value", err="err", method="linear", quantity=place)


def of_gas(quantity: str) -> Value:
    """Critical Ra of the compressible gas."""
    return one("critical_ra", "value", err="err", method="compressible", quantity=quantity)


def deviation(differs: str = "", how: str = GROWTH) -> Value:
    """Relative difference of the gas's Ra_c from that of the Boussinesq fluid in the same box."""
    return of_gas(f"{LAYER}{differs}{how}")/linear(LAYER) - 1


def bracket(how: str) -> Value:
    """Product of the deviations of constant eta and of constant nu, with the sum of errors."""
    def product(tables: Tables) -> Measured:
        eta, nu = deviation("", how)(tables), deviation(", const-nu", how)(tables)
        err = abs(eta.value)*nu.err + abs(nu.value)*eta.err + eta.err*nu.err
        return Measured(eta.value*nu.value, err)
    product.__doc__ = f"product of the deviations of const-eta and const-nu{how}, errors added"
    return of(product)


def twice(name: str, printed: str, value: Callable[[str], Value], words: str, **more: Any) -> list[Claim]:
    """A statement judged by zeros of lines, the paper's procedure, and by growth rates, a better one."""
    asked = partial(Claim, source="KHP95 Sec. IV", **more)
    return [asked(id=f"khp95-{name}", printed=printed, value=value(LINE_L2),
                  statement=f"{words}, zeros of lines of K, the paper's procedure"),
            asked(id=f"own-{name}-growth", value=value(GROWTH), statement=f"{words}, zeros of growth rates")]


def off_growth_rates(place: str) -> Value:
    """Relative difference of the extrapolated line's Ra_c from that of growth rates of the same solver."""
    return abs(of_gas(place + LINE_L2)/of_gas(place + GROWTH) - 1)


FIVE = "five figures are half of 1e-4"
ONSET_CLAIMS = (
    Claim(id="khp95-chandrasekhar", source="KHP95 Sec. IV", printed="1708",
          statement="critical Rayleigh number of the infinite layer between rigid plates",
          value=linear(INFINITE), **as_printed("ra-critical"), because="the last printed digit"),
    Claim(id="khp95-box-corresponds", source="KHP95 Sec. IV", printed="corresponds closely", at_most=1e-3,
          statement="the periodic box of aspect 2 corresponds closely to the infinite layer: Ra_c over "
                    "Ra_c, less 1", value=abs(linear(LAYER)/linear(INFINITE) - 1),
          because="four figures are printed of 1708"),
    *twice("ra-bracket", "bracketing", bracket, at_most=0,
           because="on different sides the product is negative",
           words="critical Ra of constant eta and of constant nu bracket the Boussinesq one: product of "
                 "their deviations"),
    *(Claim(id=f"khp95-ra-close{name}", source="KHP95 Sec. IV", printed="close to", expect=0, within=0.05,
            value=deviation(differs), because='"close" and "small" have no number: 5 %',
            statement=f"critical Ra of constant {law} is close to the Boussinesq one: relative deviation")
      for name, differs, law in (("", "", "eta"), ("-const-nu", ", const-nu", "nu"))),
    Claim(id="khp95-ra-deviation", source="KHP95 Sec. IV", printed="small but definite", at_least=1e-5,
          at_most=0.05,
          statement="compressible results deviate from the Boussinesq critical Ra, constant eta: relative "
                    "deviation", value=abs(deviation()),
          because='"definite" is told from zero, "small" is 5 % at most'),
    *twice("small-dt", "only small changes", at_least=0.5,
           value=lambda how: deviation(", dT 0.1", how)/deviation("", how),
           words="calculations with a much smaller dT change the deviation little: deviation at dT = 0.1 "
                 "over dT = 1",
           because='"small changes" leave half of it at least; terms of order dT/T are what the Boussinesq '
                   "approximation drops: of growth rates the deviation vanishes with dT, of lines it is that "
                   "of a curve from its line"),
    Claim(id="khp95-intermediate-capacity", source="KHP95 Sec. IV", printed="intermediate", at_least=1,
          at_most=2,
          statement="an intermediate heat capacity is appropriate: the one that makes Ra_c of the ideal gas "
                    "the Boussinesq one lies between C_V and C_P", value=linear(LAYER)/of_gas(LAYER + GROWTH),
          because="C_V = 1, C_P = 2; with C_P and the adiabatic gradient subtracted, Ra is as with C_V"),
    Claim(id="khp95-ra-figures", source="KHP95 Sec. V", printed="five significant figures", at_most=0.5e-4,
          headline=True, evidence="onset/line.png",
          because=FIVE,
          statement="the line of K extrapolated in L^-2 gives five figures of the critical Ra: difference "
                    "from growth rates", value=off_growth_rates(LAYER)),
    Claim(id="khp95-ra-figures-square", source="KHP95 Sec. V, Fig. 6", printed="five significant figures",
          at_most=0.5e-4, because=FIVE,
          statement="the line of K extrapolated in L^-2 gives five figures of the critical Ra of the "
                    "square: difference from growth rates", value=off_growth_rates(SQUARE)),
    Claim(id="own-onset-branch-root", source="KHP95 Sec. V", expect=0.5, within=1e-3,
          value=power("branch", "sqrt(ke)", "above", "0 < above < 1e-3", width=2, pr=1),
          because="rolls that rise or sink at x = 0 are alike; the next term is as large as Ra/Ra_c - 1",
          statement="the branch of rolls leaves rest with the square root of Ra - Ra_c: exponent of their "
                    "velocity, Boussinesq fluid, Ra within 0.1 % of the onset"),
    Claim(id="own-onset-branch-linear", source="KHP95 Sec. IV", at_most=1e-10,
          value=largest("branch", "abs(off_linear)", "arc == 0", err="0"),
          because="half of the tenth digit of a number that begins with five",
          after="a test had found ten digits with 12 functions",
          statement="the spectral method gives ten digits of the onset: distance from linear theory, pairs "
                    "of rolls 2 and 1 wide, relative"),
)
