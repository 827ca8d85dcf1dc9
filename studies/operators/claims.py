"""What RR98 says of weights, kernels and their discretisation, judged    [RR98 Eqs 1-33]; of its scheme: the module *_scheme"""
from math import exp, pi
from typing import Any

import numpy as np

from studies.build.read import Value, exact
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.operators import claims_scheme as operators_claims_scheme
from studies.operators.read import (
    cell,
    coefficient,
    column,
    doubling,
    finest_order,
    least,
    line_moments,
    most,
    off,
    relative,
    size,
    worst,
)

GIVEN = ("Exponential", "Gaussian")      # whose integrals are known in closed form and not made to be 1
QUADRATURE = "quadrature to 1e-12, nine digits in the table"
#: range of the weight by dimension in the table of terms
RANGE = {1: 3.0, 2: 3.0, 3: 2.0}
NEXT = "the next order, (k h)^4, takes 0.01 to 0.03 of the slope at these wavelengths"
LONG = "0.4 to 0.8 % are (k h)^2 of a wave 64 spacings long"


def order(name: str, equation: str, operator: str, what: str, d: int, h: float = 0.0) -> Claim:
    """Second order of a term on a lattice."""
    where = "sums fine enough to be integrals, h = 12 a" if h else f"lattice, h = {RANGE[d]:g} a"
    return Claim(id=f"rr98-{name}", source=f"RR98 {equation}", printed="" if h else "to lowest order", expect=2, within=0.05,
                 because=NEXT, value=cell("orders", "order", d=d, h=h or RANGE[d], operator=operator),
                 statement=f"{what} in {d}D is right to second order in r0/lambda: slope of the error against exact derivatives, "
                           + where)


def printed_weight() -> float:
    """Largest relative difference of the printed W(r) and -d/dr of exp(-r/r0)/(4 pi r^2 r0), by central differences."""
    def f(r: float) -> float:
        return exp(-r)/(4*pi*r*r)
    step, worst = 1e-5, 0.0
    for r in np.linspace(0.3, 5, 20):
        W = (2/r**3 + 1/r**2)*exp(-r)/(4*pi)
        worst = max(worst, abs((f(r - step) - f(r + step))/(2*step)/W - 1))
    return worst


def undecided(name: str, equation: str, statement: str, reason: str) -> Claim:
    return Claim(id=f"rr98-{name}", source=f"RR98 {equation}", statement=statement, undecidable=reason)


def printed_factor(d: int) -> Value:
    """First moment of Eq. 32 on a lattice over the prediction."""
    def value(tables: Tables) -> Measured:
        where: dict[str, Any] = {"how": "printed", "weight": "Exponential", "d": d, "r0": 4.0, "n": 1}
        return Measured(cell("lattice", "value", **where)(tables).value/cell("lattice", "predicted", **where)(tables).value, 0.0)
    return value


def plain_loss(r0: float) -> Value:
    """What W dV on a lattice takes from the first moment, 3, of the exponential weight in 3D, over it."""
    def value(tables: Tables) -> Measured:
        return Measured(1 - cell("lattice", "value", how="plain", weight="Exponential", d=3, r0=r0, n=1)(tables).value/3, 0.0)
    return value


LAWS = "the continuum's own laws, which the paper takes from elsewhere: exact derivatives of them are what its sums are judged by"
INTERPOLANT = (
    Claim(id="rr98-eq1-symbol", source="RR98 Eq. 1", printed="grad A", at_most=1e-9, because=QUADRATURE,
          value=most("continuum", size("value"), column("value_err"), quantity="symbol"),
          statement="the interpolant of grad A is the exact gradient of A smoothed with f, symbol i k f^(k): largest difference "
                    "over k at k r0 = 0.3 to 4, seven weights, 1 to 3 dimensions"),
    Claim(id="rr98-eq1-lattice", source="RR98 Eq. 1", at_most=0.02, because="lattice sums with h = 3 a are integrals to 1 or 2 %",
          value=most("symbols", off("gradient", "smoothed"), weight="Lucy", r0=3.0),
          statement="on a lattice the gradient keeps that symbol up to the Nyquist wave: largest |g(k)/k - f^(k)|, Lucy, h = 3 "
                    "a, 1 to 3 dimensions, first moment made right"),
    Claim(id="rr98-eq2-moments", source="RR98 Eq. 2", printed="all its moments exist", at_most=1e-9, because=QUADRATURE,
          value=most("continuum", relative("value", "predicted"), column("value_err"),
                     quantity=tuple(f"moment {n}" for n in (1, 2, 3, 4))),
          statement="moments of W exist and are those of f, M_n = (n + d - 1) <r^(n-1)>/r0^(n-1): largest relative difference "
                    "for n = 1 to 4, seven weights, 1 to 3 dimensions; M_3 = (d + 2) <r^2>/r0^2"),
    Claim(id="rr98-eq3-slope", source="RR98 Eq. 3", at_most=1e-6,
          value=worst(most("continuum", size("value"), quantity="slope", weight=GIVEN),
                      most("counted", relative("value", "predicted"), n=1)),
          statement="W is minus the slope of f: largest relative difference of the two, exponential and Gaussian weight, and of "
                    "the first moment of W from d, the other weights and the Gaussian one, counted over the points of lattices "
                    "with 200 and 20 spacings to r0; 1 to 3 dimensions",
          because="central differences over 1e-5 r0 are good to 1e-7, counting to (a/r0)^3 = 1e-7"),
    Claim(id="rr98-eq4-integral", source="RR98 Eq. 4", printed="delta(r)/(4 pi r^2)", at_most=1e-9,
          value=worst(most("continuum", off("value", "predicted"), column("value_err"), quantity="integral", weight=GIVEN),
                      most("counted", off("value", "predicted"), n=0)),
          because="quadrature to 1e-12; counting to (a/r0)^4 = 6e-10; nine digits in the table",
          statement="f has the integral 1 in d dimensions: largest difference, exponential weight by quadrature, the others "
                    "counted over the points of lattices with 200 spacings (Gaussian: 20) to r0; 1 to 3 dimensions"),
    Claim(id="rr98-eq5-coefficient", source="RR98 Eq. 5", at_most=1e-3,
          value=most("continuum", relative("value", "predicted"), column("value_err"), quantity="leading"),
          because="three wave numbers, extrapolated: the tail of the exponential weight leaves 2e-5",
          statement="with Taylor's 1/6 for the printed 1/2 the gradient loses (k r0)^2 M_3/(2 d (d + 2)), M_3 r0^2/30 in 3D: "
                    "largest relative difference of measured factor and this one, seven weights, 1 to 3 dimensions"),
    *(Claim(id=f"rr98-eq5-exponential-{d}d", source="RR98 Eqs 5, 31", expect=2.0*(d + 2), within=1e-8, because=QUADRATURE,
            value=cell("continuum", "value", weight="Exponential", d=d, quantity="moment 3"),
            statement=f"M_3 of the exponential weight in {d}D, which sets the error of the gradient: 2 (d + 2)") for d in (1, 2)),
    Claim(id="rr98-eq6-continuum", source="RR98 Eq. 6", printed="r0^2", at_most=0.05,
          value=most("continuum", off("value", 2.0), column("value_err"), quantity="order"),
          because="0.01 is what k r0 = 0.05 leaves of the next order for the exponential weight",
          statement="the interpolant's error is of second order in r0: largest |order - 2|, seven weights, 1 to 3 dimensions, "
                    "before anything is discretised"),
    *(undecided(f"eq{n}-law", f"Eq. {n}", f"conservation of {what} in the continuum", LAWS)
      for n, what in ((7, "mass"), (8, "momentum"), (9, "energy"))),
    *(order(f"eq{n}-integral", f"Eq. {n}", what, f"the integral form of the conservation of {what}", 1, h=12.0)
      for n, what in ((10, "mass"), (11, "momentum"), (12, "energy"))),
    Claim(id="rr98-eq13-symmetrised", source="RR98 Eq. 13", printed="we need the symmetrization", at_least=1e-3,
          value=least("work", column("one_kernel")), because="round-off would be 1e-15",
          statement="the kernel P(rho(r), T(r')) is not symmetric, so that one alone would not conserve: least momentum lost "
                    "over what is exchanged, random rho and T, jittered and random points, 1 to 3 dimensions"),
)
KERNELS = (
    *(order(f"eq14-pressure-{d}d", "Eq. 14", "pressure", "the pressure's kernel, van der Waals fluid,", d) for d in (1, 2, 3)),
    Claim(id="rr98-eq15-size", source="RR98 Eq. 15", printed="-grad P", at_most=1e-3,
          value=most("orders", off("ratio"), column("ratio_err"), operator="pressure"),
          because="extrapolated in the spacing to 4e-5",
          statement="sign and size of the pressure's kernel: its projection on -(dP/drho) grad rho - (dP/dT) grad T, "
                    "extrapolated to no spacing, less 1"),
    *(Claim(id=f"rr98-eq16-trace-{d}d", source="RR98 Eqs 16, 37", printed="2/3"*(d == 3), expect=0, within=1e-9,
            value=cell("dilation", "bulk", d=d, trace="2/3"), because="round-off of sums over a lattice",
            statement=f"a uniform dilation in {d}D meets the bulk viscosity only: what the trace factor 2/3 adds to zeta, over "
                      "eta")
      for d in (1, 2, 3)),
    Claim(id="rr98-eq16-mended", source="RR98 Eqs 16, 37", at_most=1e-9, value=most("dilation", off("bulk", "predicted")),
          because="round-off of sums over a lattice",
          statement="the trace factor must be 2/d: what a trace factor t adds to zeta over eta is 2/d - t, nothing for t = 2/d: "
                    "largest difference in 1, 2 and 3 dimensions"),
    *(order(f"eq17-viscous-{d}d", "Eq. 17", "viscous nested", "the nested viscous force, trace factor 2/d, eta(T) and zeta,", d)
      for d in (1, 2, 3)),
    Claim(id="rr98-eq18-current", source="RR98 Eq. 18", at_most=1e-3,
          value=most("orders", off("ratio"), column("ratio_err"), operator="heat kernel"),
          because="extrapolated in the spacing to 4e-5",
          statement="sign and size of the heat current's kernel: its projection on -kappa grad T, extrapolated to no spacing, "
                    "less 1"),
    *(order(f"eq19-heat-{d}d", "Eq. 19", "heat nested", "nested conduction, kappa(T),", d) for d in (1, 2, 3)),
    Claim(id="rr98-eq21-sign", source="RR98 Eq. 21", printed="-", expect=1, within=1e-6,
          value=cell("volumes", "ratio", quantity="linearised mass, Eq. 21"), because="a quadratic form, differentiated exactly",
          statement="the linearised continuity equation follows from Eq. 10: projection of the printed right-hand side on the "
                    "derivative of Eq. 34; it is -1, the overall sign is wrong"),
)
DISCRETE = (
    Claim(id="rr98-eq26-velocity", source="RR98 Eq. 26", printed="v dV", expect=1, within=0.02, because=LONG,
          value=cell("volumes", "ratio", quantity="mass, v_i = v dV"),
          statement="v_i stands for v dV: rate of the mass by Eq. 34 over -div(rho v) dV where dV = 1/4; it is dV"),
    Claim(id="rr98-eq26-field-velocity", source="RR98 Eq. 26", expect=1, within=0.02, because=LONG,
          value=cell("volumes", "ratio", quantity="mass, v_i = v"),
          statement="v_i must be the field velocity itself: rate of the mass by Eq. 34 with it over -div(rho v) dV where dV = "
                    "1/4"),
    *(Claim(id=f"rr98-eq26-{name}", source="RR98 Eqs 26, 35", printed=printed, expect=1, within=0.02, because=LONG,
            value=cell("volumes", "ratio", quantity=f"momentum, p_i = m_i v_i, v_i = {v}"),
            statement=f"p_i = m_i v_i, as is used for Eq. 49, with {words}: momentum that Eq. 35 convects over -div(rho v v) dV "
                      "where dV = 1/4" + more)
      for name, v, words, printed, more in (
          ("momentum", "v dV", "v_i = v dV in both", "p_i = m_i v_i", "; it is dV^2"),
          ("momentum-field", "v", "the field velocity for v_i", "", ""))),
    Claim(id="rr98-eq27-pressure", source="RR98 Eq. 27", printed="P dV", expect=1, within=0.02, because=LONG,
          value=cell("volumes", "ratio", quantity="pressure, P_ij = P dV"),
          statement="with P_ij = P dV the force in Eq. 35 is -grad P dV: their ratio where dV = 1/4"),
    Claim(id="rr98-eq28-sums", source="RR98 Eq. 28", at_most=0.02,
          value=most("lattice", relative("value", "predicted"), how="plain", weight="Lucy", r0=6.0),
          because="steps of a/h = 1/6 in a smooth integrand leave less than (a/h)^2",
          statement="sums over cells times dV stand for integrals: first moment of Lucy's weight on lattices, h = 6 a, 1 to 3 "
                    "dimensions, largest relative error"),
    Claim(id="rr98-eq29-line", source="RR98 Eq. 29", expect=3, within=0.06,
          value=cell("lattice", "value", how="line", weight="Lucy", d=3, r0=6.0, n=1), because="2 %: steps of a/h = 1/6",
          statement="along a half line from a point 4 pi r^2 a W(r) has the right first moment, which summed over all points "
                    "around it has not: Lucy, h = 6 a"),
    Claim(id="rr98-eq30-delta", source="RR98 Eq. 30", expect=1, within=1e-9, because=QUADRATURE,
          value=cell("continuum", "value", weight="Exponential", d=3, quantity="integral"),
          statement="exp(-r/r0)/r0 represents delta(r), so that f = delta(r)/(4 pi r^2) has the integral 1 in space"),
    Claim(id="rr98-eq31-slope", source="RR98 Eq. 31", at_most=1e-6, value=exact(printed_weight),
          because="central differences over 1e-5 r0 are good to 1e-8",
          statement="the printed W(r) is -f' of Eq. 30 in Eq. 4: largest relative difference, r = 0.3 to 5 r0"),
    *(Claim(id=f"rr98-eq31-order-{d}d", source="RR98 Eqs 28, 31", expect=p, within=0.1, value=finest_order(d),
            because="a singularity of r W at r = 0 is summed to first order, a kink to second; the next order takes 0.05",
            statement=f"plain sums of the exponential weight in {d}D are of order {p} in a/r0: slope of the first moment's error")
      for d, p in ((1, 2), (2, 1), (3, 1))),
    *(Claim(id=f"rr98-eq31-coefficient-{d}d", source="RR98 Eqs 28, 31", expect=1, within=0.01, value=coefficient(d),
            because="extrapolated from r0 = 2 a and wider to 1 %",
            statement=f"they lose {-z:.4f} a/r0 of gradients in {d}D, from Epstein's zeta function of the lattice: over that")
      for d, z in ((2, -0.310373), (3, -0.472893))),
    Claim(id="rr98-eq31-wave", source="RR98 Eqs 31, 45", printed="a good representation of the gradients", at_most=0.01,
          value=least("exponential", column("plain"), d=2, wavelength=128.0),
          because="one per cent is what a < r0 < lambda by such margins would promise",
          statement="a < r0 < lambda gives good gradients with the exponential weight: least error over r0 = 2 to 8 a of a wave "
                    "of 128 a, 2D, plain sums"),
    Claim(id="rr98-eq31-wave-mended", source="RR98 Eqs 31, 45", at_most=0.01,
          value=least("exponential", column("renormalised"), d=2, wavelength=128.0), because="as without mending",
          statement="with the discrete first moment made right the exponential weight gives good gradients: least error over r0 "
                    "= 2 to 8 a of a wave of 128 a, 2D"),
    *(Claim(id=f"rr98-eq32-factor-{d}d", source="RR98 Eqs 29, 32", expect=1, within=0.02,
            value=printed_factor(d), because="sums over a lattice stand for integrals to 2 % at r0 = 4 a",
            statement=f"the printed discretisation of the exponential weight multiplies gradients in {d}D by {factor}: over "
                      "that, r0 = 4 a") for d, factor in ((2, "pi M_2 r0/a"), (3, "(4 pi/3) M_3 (r0/a)^2 = 42 (r0/a)^2"))),
    *(Claim(id=f"rr98-plain-quadrature-{r0:.0f}", source="RR98 Sec. III, Eq. 31", printed="cannot simply change", at_least=0.1,
            value=plain_loss(r0), because="a tenth would be a reason not to",
            statement="one cannot put W(r_ij) dV for W dr, the moments would be wrong: first moment that the exponential weight "
                      f"loses on a lattice in 3D, r0 = {r0:.0f} a") for r0 in (2.0, 4.0)),
    Claim(id="rr98-eq32-zeroth", source="RR98 Eq. 32", printed="but the zeroth", expect=1, within=0.1, value=doubling,
          because="the first order in a/r0 takes 0.05 at r0 = 8 a",
          statement="the zeroth discrete moment is not well defined: what it grows by along a line when the spacing is halved, "
                    "over 2 ln 2/r0"),
    Claim(id="rr98-eq32-moments", source="RR98 Eq. 32", printed="well defined", at_most=0.01, value=line_moments,
          because="extrapolated in a/r0; (a/r0)^2/12 is left",
          statement="all moments but the zeroth are well defined: largest relative difference of M_1 to M_4 along a line and the "
                    "integrals, r0 = 4 and 8 a extrapolated"),
    Claim(id="rr98-eq33-direction", source="RR98 Eq. 33", expect=1, within=0.02, because=LONG,
          value=cell("volumes", "ratio", quantity="divergence, Eq. 33 in Eq. 1"),
          statement="with e_ij from j to i, -sum_j W e_ij A_j is grad A, as Eq. 1 has it: projection on the exact gradient of a "
                    "wave"),
)

CLAIMS = (*INTERPOLANT, *KERNELS, *DISCRETE, *operators_claims_scheme.CLAIMS)
