"""What RR98 says of its scheme on fixed points, judged: brackets, transport, forces along edges    [Eqs 34-40, 51]"""
from typing import Any

from studies.kit.ask import Value, largest, largest_of, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables

EDGES = "round-off: sums of some 30 terms, edges from solves with a condition number of 1e3"
CLOSED = ("closed", "exact", "delaunay")
#: range of the weight by dimension in the table of terms
RANGE = {1: 3.0, 2: 3.0, 3: 2.0}
NEXT = "the next order, (k h)^4, takes 0.01 to 0.03 of the slope at these wavelengths"
LONG = "twice the 0.4 % that the gradient loses of a wave 64 spacings long"
SECOND = "second order; the next one, (h/lambda)^4, changes slopes over 16 to 64 spacings by 0.02"
#: growth rates c/a below it are zero: modes that stay have 1e-15, those that grow 5e-6 and more
STILL = 1e-9
LATTICE: dict[str, Any] = {"maker": "renormalised", "weight": "Lucy", "h": 3.0, "points": "lattice",
                           "direction": "axis"}
JITTERED: dict[str, Any] = {"weight": "Lucy", "h": 3.0, "points": "jittered-0.3", "direction": "axis"}
NESTED: dict[str, Any] = {"transport": "nested", "zeta": 0.2}
PAIRWISE: dict[str, Any] = {"transport": "pairwise", "zeta": 0.2}
BOTH = ("viscosity", "bulk viscosity")


def second_order(name: str, equation: str, operator: str, what: str, d: int, h: float = 0.0) -> Claim:
    """A term on a lattice is right to second order."""
    where = "sums fine enough to be integrals, h = 12 a" if h else f"lattice, h = {RANGE[d]:g} a"
    return Claim(id=f"rr98-{name}", source=f"RR98 {equation}", printed="" if h else "to lowest order",
                 expect=2, within=0.05,
                 because=NEXT, value=one("orders", "order", d=d, h=h or RANGE[d], operator=operator),
                 statement=f"{what} in {d}D is right to second order in r0/lambda: slope of the error "
                           f"against exact derivatives, {where}")


def off_lattice(maker: str, column: str, viscosity: float = 0.0) -> Value:
    """Mean over 2D points jittered by 0.3 a."""
    return one("growth_means", column, maker=maker, points="jittered-0.3", d=2, viscosity=viscosity)


def endless(quantity: str | tuple[str, ...], **where: Any) -> Value:
    """Largest |error| for endless waves among some quantities."""
    return largest("transport_orders", "abs(long)", err="long_err", quantity=quantity, **where)


def order(quantity: str, **where: Any) -> Value:
    """Order of an error in 1/wavelength."""
    return one("transport_orders", "order", quantity=quantity, **where)


def identified(maker: str) -> Value:
    """Largest relative difference between viscosities put in and measured, waves of 32 a on jittered points."""
    return largest("coefficients", "abs(error)", err="error_err", maker=maker, **JITTERED, **PAIRWISE,
                   quantity=BOTH,
                   wavelength=32.0)


def growth(**where: Any) -> Value:
    """Largest growth rate of a motionless layer; differences over 1e-4 to 1e-6 give the same four figures."""
    return largest("nested_growth", "growth", err="1e-4*abs(growth)", **where)


@of
def smallest_share(tables: Tables) -> Measured:
    """smallest share from which on growth < 1e-9 in nested_growth where h = 2; error: distance to the next one"""
    fastest = rows(tables, "nested_growth", h=2.0).groupby("share")["growth"].max()
    growing = fastest.index[fastest >= STILL]
    still = fastest.index[fastest < STILL]
    if not len(still) or (len(growing) and still.min() < growing.max()):
        raise CannotTell("no share from which on the layer is stable")
    return Measured(still.min(), still.min() - growing.max() if len(growing) else 0.0)


BRACKETS = (
    *(Claim(id=f"rr98-eq{n}-order-2d", source=f"RR98 Eq. {n}", expect=2, within=0.05, because=NEXT,
            value=one("orders", "order", d=2, h=RANGE[2], operator=what),
            statement=f"the discrete equation for {what}, stress and heat current nested with the trace "
                      "factor 2/d, is right to second order in 2D on a lattice: slope of the error against "
                      "exact derivatives of a smooth flow")
      for n, what in ((34, "mass"), (35, "momentum"), (36, "energy"))),
    Claim(id="rr98-eq34-36-conserved", source="RR98 Eqs 34-36", printed="are conserved", at_most=1e-12,
          because=EDGES,
          value=largest("invariance", "lost", "lost == lost"),
          statement="mass, momentum and energy are conserved by construction: largest loss over what is "
                    "exchanged, six makers of edges, nested, printed and pairwise transport, lattice, "
                    "jittered and random points, 1 to 3 dimensions"),
    Claim(id="rr98-eq35-rest", source="RR98 Eq. 35", at_most=1e-12, because=EDGES,
          value=off_lattice("plain", "closure"),
          statement="a fluid of uniform pressure stays at rest: largest acceleration over P/(rho a), plain "
                    "edges, points jittered by 0.3 a"),
    Claim(id="rr98-eq34-36-delaunay-uniform", source="RR98 Eqs 34-36", at_most=1e-12, because=EDGES,
          value=largest("invariance", "uniform", "uniform == uniform", maker="delaunay"),
          statement="on edges 'delaunay' a uniform fluid in a wind stays as it is: largest rate, nested, "
                    "printed and pairwise transport, lattice, jittered and random points, 1 to 3 dimensions"),
    Claim(id="rr98-eq34-35-sound", source="RR98 Eqs 34, 35", at_most=1e-12, because=EDGES,
          value=off_lattice("plain", "rate"),
          statement="small sound waves in a fluid at rest without viscosity do not grow off a lattice: "
                    "largest growth rate a/c, the bracket + in both equations, plain edges, points jittered "
                    "by 0.3 a in 2D"),
    Claim(id="rr98-eq34-35-sound-closed", source="RR98 Eqs 34, 35", at_most=1e-12, because=EDGES,
          value=largest("growth_means", "largest", maker=CLOSED),
          statement="on edges that close sound does not grow: largest growth rate a/c, jittered, random and "
                    "relaxed points and lattice, 1 to 3 dimensions, with and without viscosity"),
)
TRANSPORT = (
    Claim(id="rr98-eq37-null", source="RR98 Eqs 37, 38", at_least=0.1, value=largest("nulls", "nested"),
          because="pairwise forces damp these waves at rates above 0.2 in the same units",
          statement="nested friction and conduction see every wave that points can carry: largest |gradient| "
                    "a of the waves at the 2^d - 1 Nyquist corners, seven weights, 1 to 3 dimensions"),
    *(Claim(id=f"rr98-eq{n}-uniform", source=f"RR98 Eq. {n}", at_most=1e-12, because=EDGES,
            value=one("stream_means", column, points="jittered-0.3", inner="printed"), statement=statement)
      for n, column, statement in (
          (37, "force",
           "a uniform stream feels no friction (Galilean invariance): rms force over eta U/a^2, inner sum as "
                        "printed, points jittered by 0.3 a"),
          (38, "heat",
           "no heat flows at uniform temperature: rms heating over kappa T/a^2, inner sum as printed, points "
                       "jittered by 0.3 a"))),
    Claim(id="rr98-eq37-symmetric", source="RR98 Eqs 37, 38", at_most=1e-12, because=EDGES,
          value=one("stream_means", "asymmetry", points="jittered-0.3", inner="printed"),
          statement="friction and conduction act alike both ways (Onsager): |K - K^T|/|K| of the nested "
                    "operator as printed, points jittered by 0.3 a"),
    *(Claim(id=f"rr98-eq{n}-volume", source=f"RR98 Eqs 26, {n}", expect=1, within=0.05, because=LONG,
            value=one("volumes", "ratio", quantity=quantity), statement=statement)
      for n, quantity, statement in (
          (37, "stress, v_i = v",
           "with the field velocity in Eq. 37 the force of Eq. 35 is div Pi dV: their ratio where "
                                  "dV = 1/4; a dV is missing"),
          (38, "heat",
           "with Eq. 38 the heating of Eq. 36 is div(kappa grad T) dV: their ratio where dV = 1/4; a dV is "
                       "missing"))),
    Claim(id="rr98-eq40-euler", source="RR98 Eq. 40", at_most=1e-3,
          value=largest("euler", "abs(limit/predicted - 1)", "mode < 16", transport="nested"),
          because="damping squared over frequency squared: below 1e-4 for these coefficients",
          statement="forward Euler of the 2D gas is stable only for dt < (eta + zeta + kappa/2)/(rho c^2), "
                    "whatever the wave number: largest relative difference of the limit from eigenvalues of "
                    "the scheme, nested transport, 15 wave numbers, three fluids"),
)
ALONG = (
    Claim(id="rr98-eq51-identify", source="RR98 Eq. 51", printed="one cannot independently identify",
          at_least=0.1,
          value=largest_of(*(largest("friction",
                                     f"abs({x} - {x}_predicted)/(abs(eta_predicted) + abs(zeta_predicted))",
                                     h=6.0)
                             for x in ("eta", "zeta"))),
          because="a tenth would leave them unidentified",
          statement="the two viscosities cannot be told from A and B (A alone enters both): largest "
                    "difference of eta, zeta of long waves on a lattice from M_A/2d(d+2) + M_B/2d, "
                    "M_A/d(d+2) - (1 - 2/d) eta over their size, five forms, 2 and 3 dimensions, h = 6 a"),
    *(Claim(id=f"rr98-eq51-{name}", source="RR98 Eq. 51", expect=2, within=0.05,
            value=one("orders", "order", d=d, h=RANGE[d], operator=operator),
            because=f"the next order, (k h)^4, takes 0.01{' to 0.03'*(d == 3)} of the slope",
            statement=f"forces along edges are right to second order in {d}D, {words}: slope of the error at "
                      f"h = {RANGE[d]:g} a, lattice")
      for name, d, operator, words in (
          ("order", 2, "friction, zeta 0", "constant eta and zeta = 0"),
          ("order-3d", 3, "friction, zeta 0", "constant eta and zeta = 0"),
          ("order-bulk", 2, "friction, zeta 0.01", "constant eta and zeta = eta/2"),
          ("order-varying", 2, "friction, eta(T)", "eta(T) and zeta = 0"),
          ("order-varying-mended", 2, "friction, eta(T), mended",
           "eta(T) and zeta = 0, with the stress that they lack"))),
    Claim(id="rr98-eq51-rotation", source="RR98 Eq. 51", expect=0, within=1e-9,
          because="round-off over omega^2",
          value=one("rotation", "heating", d=2, zeta=0.0, mended="no"),
          statement="the work of forces along edges, zeta = 0, does not heat a rigid rotation: heating over "
                    "eta omega^2, 2D; central ones, zeta = (1 + 2/d) eta, do not"),
    Claim(id="rr98-eq51-rotation-mended", source="RR98 Eq. 51", at_most=1e-9,
          because="round-off over omega^2",
          value=abs(one("rotation", "heating", d=2, zeta=0.0, mended="yes")),
          statement="with the flux F added a rigid rotation is not heated: largest over eta omega^2, 2D, "
                    "zeta = 0"),
)
REST = ("a motionless layer between adjoint plates stays at rest: largest growth rate in c/a, Ra 200 and 1500, "
        "8 to 16 rows, ")
QUIET = "rates of what stays are 1e-15, of what grows 1e-5 and more"
LAYER = (
    Claim(id="rr98-eq37-layer-stable", source="RR98 Eqs 37, 38", value=growth(share=0.0), at_most=STILL,
          because=QUIET,
          statement=f"with nested stress and heat current {REST}h = 2 a and 3 a"),
    Claim(id="rr98-eq51-layer-stable", source="RR98 Eq. 51", value=growth(share=1.0, h=2.0), at_most=STILL,
          because=QUIET,
          statement=f"with transport along edges {REST}h = 2 a"),
    Claim(id="own-nested-share", source="RR98 Eqs 37, 38, 51", value=smallest_share, at_most=0.1,
          because="a tenth; the error is the distance to the next smaller share run",
          statement="a tenth of the transport along edges keeps the layer at rest at h = 2 a: the smallest "
                    "share that was run and is stable"),
)
COEFFICIENTS = (
    *(Claim(id=f"rr98-transport-{name}", source=f"RR98 {equation}", printed=printed, expect=2, within=0.1,
            because=SECOND,
            value=order(quantity, **LATTICE, **NESTED),
            statement=f"{words} but for an error of second order{more}: order on a lattice, h = 3 a")
      for name, equation, printed, quantity, words, more in (
          ("eq34-36-sound", "Eqs 34-36", "correct up to second order", "sound speed",
           "the speed of sound is that of the gas", " in 1/wavelength"),
          ("eq37-viscosity", "Eq. 37", "eta", "viscosity", "eta of Eq. 37 is the shear viscosity", ""),
          ("eq37-bulk", "Eq. 37", "zeta", "bulk viscosity",
           "zeta of Eq. 37, with 2/d in place of 2/3, is the bulk viscosity",
           ""),
          ("eq38-conductivity", "Eq. 38", "kappa", "conductivity", "kappa of Eq. 38 is the conductivity",
           ""))),
    Claim(id="rr98-transport-eq37-38-limit", source="RR98 Eqs 34-38", printed="unambiguously identified",
          at_most=1e-3,
          value=endless((*BOTH, "conductivity", "sound speed"), **LATTICE, **NESTED),
          because="what waves of 48 and 64 spacings extrapolate to",
          statement="all coefficients of nested transport are those put in: largest relative difference for "
                    "endless waves on a lattice, h = 3 a"),
    Claim(id="rr98-transport-eq51-identified", source="RR98 Eq. 51", printed="cannot independently identify",
          at_least=0.1,
          value=identified("exact"), because="a tenth would be no identification",
          statement="the two viscosities of forces along edges cannot be identified one by one: largest "
                    "relative difference between those put in by A, B of eta, zeta and those measured, edges "
                    "of a weight, h = 3 a, on points jittered by 0.3 a, waves of 32 a"),
    Claim(id="rr98-transport-eq51-delaunay", source="RR98 Eq. 51", at_most=0.1, value=identified("delaunay"),
          because="a tenth; six edges a point are no average over directions, as Eq. 51 takes with zeta > 0",
          statement="the two viscosities of forces along Delaunay edges are those put in: largest relative "
                    "difference, points jittered by 0.3 a, waves of 32 a"),
    Claim(id="rr98-transport-eq51-eq45", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", at_most=0.01,
          value=one("numbers", "value", quantity="viscosities, h = 8 a"), because="1 %",
          statement="with many points in the range of the weight, h = 8 a, forces along edges with zeta > 0 "
                    "have the viscosities put in: largest relative error for endless waves along an axis of "
                    "a lattice, by its symbol"),
    *(Claim(id=f"rr98-transport-eq51-long-h{h:.0f}", source="RR98 Eq. 51", at_most=0.01,
            value=endless(BOTH, **{**LATTICE, "h": h}, **PAIRWISE),
            because="1 %; sums of W x^4/r^3 over few neighbours are not averages over directions, however "
                    "long the wave",
            statement="forces along edges with zeta > 0 give lap v and grad div v for endless waves: largest "
                      f"relative error of the two viscosities, lattice, waves along an axis, h = {h:.0f} a")
      for h in (2.0, 3.0)),
    *(Claim(id=f"rr98-transport-{name}", source="RR98 Sec. III A", printed=printed, expect=2, within=0.1,
            because=because,
            value=one("shear_orders", "order", flow=name.split("-")[0], points=points, time=0.1, norm=norm),
            statement=f"{name.split('-')[0].capitalize()} flow from rest between {words}: order of its "
                      f"{norm} error in 1/rows at 0.1 H^2/nu")
      for name, points, norm, printed, because, words in (
          ("couette", "lattice", "rms", "a host of procedures", "second order; 8 rows are worth 0.03",
           "mirror plates on a lattice, forces along edges"),
          ("poiseuille", "lattice", "rms", "a host of procedures", "second order; 8 rows are worth 0.03",
           "mirror plates on a lattice, forces along edges"),
          ("couette-jittered", "jittered-0.2", "largest", "", "second order, as on the lattice",
           "mirror plates on points jittered by 0.2 a, Delaunay edges"),
          ("couette-jittered-plates", "jittered-0.2, plates", "rms", "", "second order, as on the lattice",
           "rows of held points on points jittered by 0.2 a, Delaunay edges"))),
)
CLAIMS = (*BRACKETS, *TRANSPORT, *ALONG, *LAYER, *COEFFICIENTS)
