"""Does Eq. 45 make gradients right off a lattice if they are taken as printed? Judged    [RR98 Eqs 1, 14, 45]

Written after the claims by differences (`ordering_claims`), whose limits they take over: those had been judged by a form that
RR98 do not print.
"""
from functools import partial

from studies.build.read import Value, ratio, select
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.ordering.brackets import WAVELENGTH

FORMS = {"single": "f_j alone under the sum, Eq. 1", "sum": "f_i + f_j, Eqs 14 and 34-36"}
JITTERED = "points jittered by 0.3 a, plain quadrature"


def error(tables: Tables, form: str, h: float = 3.0) -> Measured:
    """On jittered points, wavelength 32 a."""
    row = select(tables, "bracket_means", points="jittered-0.3", form=form, h=h, wavelength=WAVELENGTH).iloc[0]
    return Measured(float(row["error"]), float(row["error_err"]))


def wider(form: str) -> Value:
    """Error with h = 3 a over that with h = 1.2 a."""
    return lambda tables: ratio(*(error(tables, form, h) for h in (3.0, 1.2)))


def best(form: str, h: float, *others: float) -> Value:
    """Error with one range over that with another, the one for which this is largest."""
    def value(tables: Tables) -> Measured:
        return max((ratio(error(tables, form, h), error(tables, form, other)) for other in others), key=lambda found: found.value)
    return value


def slope(form: str) -> Value:
    """d ln error/d ln(h/lambda), h = 3 a."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "bracket_slopes", points="jittered-0.3", form=form).iloc[0]
        return Measured(float(row["slope"]), float(row["slope_err"]))
    return value


CLAIMS = (
    *(Claim(id=f"rr98-eq45-jittered-{form}", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", at_most=1, value=wider(form),
            statement=f"the spacing must be smaller than r0: error of the gradient ({words}) with h = 3 a over that with h = "
                      f"1.2 a, {JITTERED}, wavelength 32 a",
            because="r0, the rms width, is 1.27 a and 0.51 a: if the ordering governs, the wider weight is better")
      for form, words in FORMS.items()),
    *(Claim(id=f"rr98-eq45-jittered-{form}-enough", source="RR98 Eq. 45", printed="a good representation of the gradients",
            at_most=0.1, value=partial(error, form=form),
            statement=f"a < r0 < lambda gives a good gradient: its error ({words}) with h = 3 a, {JITTERED}, wavelength 32 a",
            because="a tenth is not asking for much: r0 = 1.27 a, lambda = 25 r0") for form, words in FORMS.items()),
    Claim(id="rr98-eq45-jittered-sum-wide", source="RR98 Eq. 45", printed="a good representation of the gradients", at_most=0.1,
          value=partial(error, form="sum", h=6.0),
          statement=f"a < r0 < lambda gives a good gradient: its error ({FORMS['sum']}) with h = 6 a, {JITTERED}, wavelength 32 "
                    "a",
          because="a tenth, as with h = 3 a"),
    Claim(id="own-eq45-jittered-sum-range", source="RR98 Eq. 45", at_most=1, value=best("sum", 6.0, 3.0, 4.0),
          statement="f_i + f_j wants a range of 6 a, the widest that was run: error with it over that with 3 and 4 a, the "
                    f"larger, {JITTERED}, wavelength 32 a", because="smaller than one is better"),
    Claim(id="own-eq45-jittered-difference-range", source="RR98 Eq. 45", at_most=1, value=best("difference", 4.0, 3.0, 6.0),
          statement=f"f_j - f_i wants a range of 4 a: error with it over that with 3 and 6 a, the larger, {JITTERED}, "
                    "wavelength 32 a", because="smaller than one is better"),
    *(Claim(id=f"rr98-continuum-limit-jittered-{form}", source="RR98 Sec. III", printed="continuum limit", at_least=0.5,
            value=slope(form),
            statement="r0 -> 0 with a < r0 gives the continuum limit also off a lattice: slope of the gradient's error "
                      f"({words}) in h/lambda at h = 3 a, {JITTERED}",
            because="an error that falls at least as the square root of h/lambda")
      for form, words in FORMS.items()),
    Claim(id="own-continuum-limit-jittered-foretold", source="RR98 Eq. 1", expect=-1, within=0.1, value=slope("single"),
          statement="off a lattice the sum of Eq. 1 adds c_i f, c_i = sum_j W V_j e_ji, to the gradient, however long the wave: "
                    f"its relative error grows as lambda/a; slope in h/lambda at h = 3 a, {JITTERED}",
          because="what smoothing adds at a wavelength of 16 a, 4 %, takes 0.02; scatter of c between sets of points as much"),
    Claim(id="own-eq1-differences", source="RR98 Eq. 1", at_most=0.5,
          value=lambda tables: ratio(error(tables, "difference"), error(tables, "single")),
          statement="differences mend that: error of the gradient with f_j - f_i over that with f_j alone, h = 3 a, "
                    f"{JITTERED}, wavelength 32 a", because="a half would be worth the subtraction"),
)
