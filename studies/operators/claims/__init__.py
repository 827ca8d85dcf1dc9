"""What RR98 says of its equations on fixed points, judged    [RR98 Eqs 1-19, 21, 26-38, 40, 51]

Here: weights, kernels and their discretisation, Eqs 1-33; areas of today's smooth particles, exact on linear
fields and of second order as papers have it. `scheme.py`: brackets, friction, steps, transport.
"""
from math import log
from typing import Any

from studies.kit.ask import Value, largest, largest_of, largest_per, least, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.operators.claims.scheme import SCHEME, number, second_order

GIVEN = ("Exponential", "Gaussian")      # whose integrals are known in closed form and not made to be 1
WEIGHTS = "seven weights, 1 to 3 dimensions"
QUADRATURE = "quadrature to 1e-12, nine digits in the table"
CRKSPH = "Frontiere, Raskin & Owen 2017"
LONG = "0.4 to 0.8 % are (k h)^2 of a wave 64 spacings long"


def on_line(r0: float) -> Value:
    """Moments 1 to 4 of the exponential weight along a line in 3D, over the integral."""
    return one("lattice", "value/predicted", how="line", weight="Exponential", d=3, r0=r0, n=(1, 2, 3, 4))


@of
def doubling(tables: Tables) -> Measured:
    """[M_0(r0 = 8 a) - M_0(4 a)]/2 ln 2 along a line in 3D, exponential weight; error: from 4 a and 2 a"""
    line = rows(tables, "lattice", how="line", weight="Exponential", d=3, n=0,
                need=3).set_index("r0")["value"]
    last, before = ((line[2*r0] - line[r0])/(2*log(2)) for r0 in (4.0, 2.0))
    return Measured(last, abs(last - before))


def literally(name: str, source: str, quantity: str, statement: str, **more: Any) -> Claim:
    """A sum read literally is what it stands for."""
    return Claim(id=f"rr98-{name}", source=f"RR98 {source}", expect=1, within=0.02, because=LONG,
                 value=number(quantity), statement=statement, **more)


INTERPOLANT = (
    Claim(id="rr98-eq1-symbol", source="RR98 Eq. 1", printed="grad A", at_most=1e-9, because=QUADRATURE,
          headline=True, value=largest("continuum", "abs(value)", err="value_err", quantity="symbol"),
          statement="the interpolant of grad A is the exact gradient of A smoothed with f, symbol i k f^(k): "
                    f"largest difference over k at k r0 = 0.3 to 4, {WEIGHTS}"),
    Claim(id="rr98-eq2-first-moment", source="RR98 Eq. 2", printed="3", at_most=1e-9, headline=True,
          because="quadrature to 1e-12", value=number("first moment"),
          statement="W = -f' of a normalised f has M_1 = d: all weights, 1 to 3 dimensions, largest relative "
                    "difference"),
    Claim(id="rr98-eq2-moments", source="RR98 Eqs 2, 3", printed="all its moments exist", at_most=1e-9,
          headline=True, because=QUADRATURE,
          value=largest("continuum", "abs(value/predicted - 1)", err="value_err",
                        quantity=("moment 1", "moment 2", "moment 3", "moment 4")),
          statement="moments of W exist and are those of f, M_n = (n + d - 1) <r^(n-1)>/r0^(n-1): largest "
                    f"relative difference for n = 1 to 4, {WEIGHTS}; M_3 = (d + 2) <r^2>/r0^2"),
    Claim(id="rr98-eq4-integral", source="RR98 Eqs 4, 30", printed="delta(r)/(4 pi r^2)", at_most=1e-9,
          headline=True,
          value=largest_of(largest("continuum", "abs(value - predicted)", err="value_err",
                                   quantity="integral", weight=GIVEN),
                           largest("continuum", "abs(value - predicted)", err="0", quantity="counted")),
          because="quadrature to 1e-12; counting to (a/r0)^4 = 6e-10; nine digits in the table",
          statement="f has the integral 1 in d dimensions: largest difference, exponential weight by "
                    "quadrature, the others counted over the points of lattices with 200 spacings (Gaussian: "
                    "20) to r0; 1 to 3 dimensions"),
    Claim(id="rr98-eq5-factor", source="RR98 Eq. 5", printed="1/2", expect=1/2, within=1e-3, headline=True,
          value=number("third derivatives"),
          because="the next term is 1e-4; Taylor's factor is 1/6, so that the error is M_3 r0^2/30",
          statement="the factor before the third derivatives in the gradient's expansion: from the transform "
                    "of Lucy's weight in 3D at small k"),
    Claim(id="rr98-eq6-continuum", source="RR98 Eq. 6", printed="r0^2", at_most=0.05, headline=True,
          value=largest("continuum", "abs(value - 2)", err="value_err", quantity="order"),
          because="0.01 is what k r0 = 0.05 leaves of the next order for the exponential weight",
          statement=f"the interpolant's error is of second order in r0: largest |order - 2|, {WEIGHTS}, "
                    "before anything is discretised"),
    Claim(id="rr98-eq13-symmetrised", source="RR98 Eq. 13", printed="we need the symmetrization",
          headline=True, at_least=1e-3, value=least("one_kernel", "lost"), because="round-off would be 1e-15",
          statement="the kernel P(rho(r), T(r')) is not symmetric, so that one alone would not conserve: "
                    "least momentum lost over what is exchanged, random rho and T, jittered and random "
                    "points, 1 to 3 dimensions"),
)
KERNELS = (
    *(second_order(f"eq14-pressure-{d}d", "Eq. 14", "pressure",
                   "the pressure's kernel, van der Waals fluid,", d)
      for d in (1, 2, 3)),
    Claim(id="rr98-eq15-size", source="RR98 Eq. 15", printed="-grad P", at_most=1e-3, headline=True,
          value=largest("orders", "abs(ratio - 1)", err="ratio_err", operator="pressure"),
          because="extrapolated in the spacing to 4e-5",
          statement="sign and size of the pressure's kernel: its projection on -(dP/drho) grad rho - (dP/dT) "
                    "grad T, extrapolated to no spacing, less 1"),
    Claim(id="rr98-eq16-trace-3d", source="RR98 Eqs 16, 37", printed="2/3", expect=0, within=1e-9,
          value=number("dilation in 3D"), headline="Eq. 16", because="round-off of sums over a lattice",
          statement="a uniform dilation in 3D meets the bulk viscosity only: what the trace factor 2/3 adds "
                    "to zeta, over eta"),
    *(second_order(f"eq17-viscous-{d}d", "Eq. 17", "viscous nested",
                   "the nested viscous force, trace factor 2/d, eta(T) and zeta,", d)
      for d in (1, 2, 3)),
    *(second_order(f"eq19-heat-{d}d", "Eqs 18, 19", "heat nested", "nested conduction, kappa(T),", d)
      for d in (1, 2, 3)),
    Claim(id="rr98-eq21-sign", source="RR98 Eq. 21", printed="-", expect=1, within=1e-6, headline=True,
          value=number("linearised mass, Eq. 21"), because="a quadratic form, differentiated exactly",
          statement="the linearised continuity equation follows from Eq. 10: projection of the printed "
                    "right-hand side on the derivative of Eq. 34; it is -1, the overall sign is wrong"),
)
DISCRETE = (
    literally("eq26-velocity", "Eq. 26", "mass, v_i = v dV", printed="v dV", headline=True,
              statement="v_i stands for v dV: rate of the mass by Eq. 34 over -div(rho v) dV where dV = 1/4; "
                        "it is dV"),
    literally("eq26-field-velocity", "Eq. 26", "mass, v_i = v",
              printed="the field velocity becomes the velocity",
              statement="v_i must be the field velocity itself: rate of the mass by Eq. 34 with it over "
                        "-div(rho v) dV where dV = 1/4"),
    literally("eq26-momentum", "Eqs 26, 35", "momentum, p_i = m_i v_i, v_i = v dV", printed="p_i = m_i v_i",
              statement="p_i = m_i v_i, as is used for Eq. 49, with v_i = v dV in both: momentum that Eq. 35 "
                        "convects over -div(rho v v) dV where dV = 1/4; it is dV^2"),
    literally("eq27-pressure", "Eq. 27", "pressure, P_ij = P dV", printed="P dV", headline=True,
              statement="with P_ij = P dV the force in Eq. 35 is -grad P dV: their ratio where dV = 1/4"),
    Claim(id="rr98-eq28-sums", source="RR98 Eq. 28", printed="summing over cells directly", at_most=0.02,
          headline=True,
          value=largest("lattice", "abs(value/predicted - 1)", how="plain", weight="Lucy", r0=6.0),
          because="steps of a/h = 1/6 in a smooth integrand leave less than (a/h)^2",
          statement="sums over cells times dV stand for integrals: first moment of Lucy's weight on "
                    "lattices, h = 6 a, 1 to 3 dimensions, largest relative error"),
    Claim(id="rr98-eq29-moments-3d", source="RR98 Eq. 29", printed="correct moments", expect=1, within=0.02,
          headline=True, because="2 %: lattice sums with h = 3 a are good to that",
          value=one("lattice", "value/d", how="printed", weight="Lucy", d=3, r0=3.0, n=1),
          statement="the printed discretisation of W gives the right first moment: gradient of a linear "
                    "field, 3D lattice"),
    Claim(id="rr98-eq31-wave", source="RR98 Eqs 31, 45", printed="a good representation of the gradients",
          at_most=0.01, value=least("exponential", "plain", d=2, wavelength=128.0),
          because="one per cent is what a < r0 < lambda by such margins would promise",
          statement="a < r0 < lambda gives good gradients with the exponential weight: least error over r0 = "
                    "2 to 8 a of a wave of 128 a, 2D, plain sums"),
    *(Claim(id=f"rr98-plain-quadrature-{r0:.0f}", source="RR98 Sec. III, Eq. 31",
            printed="cannot simply change", headline=True, at_least=0.1,
            value=one("lattice", "1 - value/3", how="plain", weight="Exponential", d=3, r0=r0,
                      n=1),
            because="a tenth would be a reason not to",
            statement="one cannot put W(r_ij) dV for W dr, the moments would be wrong: first moment that the "
                      f"exponential weight loses on a lattice in 3D, r0 = {r0:.0f} a")
      for r0 in (2.0, 4.0)),
    Claim(id="rr98-eq32-zeroth", source="RR98 Eq. 32", printed="but the zeroth", expect=1, within=0.1,
          headline=True, value=doubling, because="the first order in a/r0 takes 0.05 at r0 = 8 a",
          statement="the zeroth discrete moment is not well defined: what it grows by along a line when the "
                    "spacing is halved, over 2 ln 2/r0"),
    Claim(id="rr98-eq32-moments", source="RR98 Eq. 32", printed="well defined", at_most=0.01, headline=True,
          value=largest_per("n", abs(2*on_line(8.0) - on_line(4.0) - 1)),
          because="extrapolated in a/r0; (a/r0)^2/12 is left",
          statement="all moments but the zeroth are well defined: largest relative difference of M_1 to M_4 "
                    "along a line and the integrals, r0 = 4 and 8 a extrapolated"),
    literally("eq33-direction", "Eq. 33", "divergence, Eq. 33 in Eq. 1", printed="(r_i - r_j)/|r_i - r_j|",
              headline=True,
              statement="with e_ij from j to i, -sum_j W e_ij A_j is grad A, as Eq. 1 has it: projection on "
                        "the exact gradient of a wave"),
)

# --- areas of today's smooth particles ----------------------------------------------------------------

MAKERS = (
    Claim(id="own-makers-linear", source="Bonet & Lok 1999", at_most=1e-10,
          because="round-off of sums of 30 terms, of matrices with condition numbers of 10",
          value=largest("makers", "linear", err="0",
                        maker=("sumB", "corrected", "closed faces", "delaunay")),
          statement="gradients of sumB are exact on linear fields on all points, as are those of closed "
                    "faces and Delaunay triangles: largest rms error"),
    Claim(id="own-makers-open", source="Monaghan 1992", at_least=1e-3,
          because="what a tenth of a spacing of jitter leaves in sums of 28 terms of a tenth",
          value=least("makers", "closure", err="0", points=("jittered-0.3", "random", "flowed"),
                      maker=("sph", "sumB", "RKGC", "bonet-lok", "CRKSPH", "MFM")),
          statement="areas of all smooth particles stay open off a lattice: least rms of sum_j S_ij/V_i"),
    Claim(id="own-makers-reproducing", source=CRKSPH, at_most=1e-10,
          because="round-off of sums of 30 terms, of matrices with condition numbers of 10",
          value=largest("makers", "linear", err="0", maker="CRKSPH"),
          statement="areas of CRKSPH, of kernels that reproduce linear fields, are exact on them though made "
                    "antisymmetric: largest rms error"),
    *(Claim(id=f"own-makers-{maker.lower()}-{points}", source=source, expect=2, within=0.4,
            because="second order, as the paper has it; seeds and longer errors change slopes over 16 to 48 "
                    "cells by 0.4",
            value=one("maker_orders", "order", quantity="divergence", maker=maker, points=points),
            statement=f"pressures of {maker} push to second order, points {points}: order, waves of "
                      "16 to 48 spacings",
            after="three sizes of a lattice had left MFM open: a fourth was run"*(points == "lattice"))
      for maker, source in (("CRKSPH", CRKSPH), ("MFM", "Hopkins 2015")) for points in ("lattice", "flowed")),
    Claim(id="own-makers-laplacian", source="Brookshaw 1985", at_most=0.5,
          because="half an order: conductances along pairs are right on lattices only",
          value=largest("maker_orders", "order", err="order_err", quantity="laplacian", maker=("sph", "sumB"),
                        points=("jittered-0.1", "jittered-0.3", "random")),
          statement="heat along pairs does not converge on points at rest that are jittered: largest order"),
    Claim(id="own-makers-wall-heat", source="Ng et al. 2020", at_most=1.0,
          because="order 0 to 1, as the paper has it of images and of dummy particles",
          after="errors of 16 rows on two sets of points had been seen",
          value=largest("wall_orders", "order", err="order_err", maker=("sph", "corrected", "delta-plus"),
                        points=("jittered-0.1", "jittered-0.3", "random")),
          statement="heat through plates with images is of first order at most on irregular points: largest "
                    "order of its error, 16 to 64 rows"),
)
CLAIMS = (*INTERPOLANT, *KERNELS, *DISCRETE, *SCHEME, *MAKERS)
