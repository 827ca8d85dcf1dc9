"""What RR98 says of its scheme on fixed points: brackets, transport, forces along edges    [Eqs 34-40, 51]"""
from typing import Any

from studies.kit.ask import Value, farthest, largest, least, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables

EDGES = "round-off: sums of some 30 terms, edges from solves with a condition number of 1e3"
TO_SECOND = "correct up to second order"
NEXT = "the next order, (k h)^4, takes 0.01 to 0.03 of the slope at these wavelengths"
LONG = "twice the 0.4 % that the gradient loses of a wave 64 spacings long"
SECOND = "second order; the next one, (h/lambda)^4, changes slopes over 16 to 64 spacings by 0.02"
#: growth rates c/a below it are zero: modes that stay have 1e-15, those that grow 5e-6 and more
STILL = 1e-9
LATTICE: dict[str, Any] = {"maker": "renormalised", "points": "lattice"}
NESTED: dict[str, Any] = {**LATTICE, "transport": "nested", "h": 3.0}
BOTH = ("viscosity", "bulk viscosity")
PLAIN: dict[str, Any] = {"maker": "plain", "points": "jittered-0.3", "d": 2, "viscosity": 0.0}


def number(quantity: str) -> Value:
    """One that needs no table of its own."""
    return one("numbers", "value", quantity=quantity)


def order(operator: str, d: int) -> Value:
    """Order of the error of a term."""
    return one("orders", "order", d=d, operator=operator)


def second_order(name: str, source: str, operator: str, what: str, d: int) -> Claim:
    """A term on a lattice is right to second order."""
    return Claim(id=f"rr98-{name}", source=f"RR98 {source}", printed="to lowest order", expect=2, within=0.05,
                 because=NEXT, value=order(operator, d), headline=True,
                 statement=f"{what} in {d}D is right to second order in r0/lambda: slope of the error "
                           f"against exact derivatives, lattice, h = {2 if d == 3 else 3} a")


def endless(quantity: str | tuple[str, ...], **where: Any) -> Value:
    """Largest |error| for endless waves among some quantities."""
    return largest("transport_orders", "abs(long)", err="long_err", quantity=quantity, **where)


def identified(maker: str) -> Value:
    """Largest relative error of both viscosities, waves of 32 a on jittered points, forces along edges."""
    return largest("coefficients", "abs(error)", err="error_err", maker=maker, points="jittered-0.3",
                   transport="pairwise", quantity=BOTH, wavelength=32.0)


@of
def smallest_share(tables: Tables) -> Measured:
    """smallest share from which on growth < 1e-9 in nested_growth, h = 2; error: distance to the next one"""
    fastest = rows(tables, "nested_growth", h=2.0).groupby("share")["growth"].max()
    growing = fastest.index[fastest >= STILL].max()
    still = fastest.index[fastest.index > growing]
    if still.empty:
        raise CannotTell("no share from which on the layer is stable")
    return Measured(still.min(), still.min() - growing)


def coefficient(name: str, source: str, printed: str, quantity: str, words: str, **more: Any) -> Claim:
    """A coefficient of nested transport on a lattice."""
    return Claim(id=f"rr98-transport-{name}", source=f"RR98 {source}", printed=printed, expect=2, within=0.1,
                 because=SECOND, value=one("transport_orders", "order", quantity=quantity, **NESTED),
                 statement=f"{words}: order on a lattice, h = 3 a", **more)


def shear(name: str, points: str, norm: str, words: str, printed: str = "",
          because: str = "second order, as on the lattice") -> Claim:
    """A flow between plates; its name begins with that of the flow."""
    flow = name.split("-")[0]
    return Claim(id=f"{'rr98' if printed else 'own'}-transport-{name}", source="RR98 Sec. III A",
                 printed=printed, expect=2, within=0.1, because=because,
                 headline=flow == "couette", evidence="operators/shear.png",
                 value=one("shear_orders", "order", flow=flow, points=points, time=0.1, norm=norm),
                 statement=f"{flow.capitalize()} flow from rest between {words}: order of its {norm} error "
                           "in 1/rows at 0.1 H^2/nu")


BRACKETS = (
    *(Claim(id=f"rr98-eq{n}-order-2d", source=f"RR98 Eqs {n - 24}, {n}", expect=2, within=0.05, because=NEXT,
            printed=TO_SECOND,
            value=order(what, 2), headline=True,
            statement=f"the discrete equation for {what}, stress and heat current nested with the trace "
                      "factor 2/d, is right to second order in 2D on a lattice: slope of the error against "
                      "exact derivatives of a smooth flow")
      for n, what in ((34, "mass"), (35, "momentum"), (36, "energy"))),
    Claim(id="own-eq35-rest", source="RR98 Eq. 35", at_most=1e-12, because=EDGES,
          value=one("growth_means", "closure", **PLAIN),
          statement="a fluid of uniform pressure stays at rest: largest acceleration over P/(rho a), plain "
                    "edges, points jittered by 0.3 a"),
    Claim(id="own-eq34-35-sound", source="RR98 Eqs 34, 35", at_most=1e-12, because=EDGES, headline=True,
          evidence="operators/growth.png", value=one("growth_means", "rate", **PLAIN),
          statement="small sound waves in a fluid at rest without viscosity do not grow off a lattice: "
                    "largest growth rate a/c, the bracket + in both equations, plain edges, points jittered "
                    "by 0.3 a in 2D"),
)
TRANSPORT = (
    Claim(id="rr98-eq37-volume", source="RR98 Eqs 26, 37", printed="found by discretizing Eq. (16)", expect=1,
          within=0.05, because=LONG, value=number("stress, v_i = v"),
          statement="with the field velocity in Eq. 37 the force of Eq. 35 is div Pi dV: their ratio where "
                    "dV = 1/4; a dV is missing"),
    Claim(id="own-eq40-euler", source="RR98 Eq. 40", at_most=1e-3, headline=True,
          value=largest("euler", "abs(limit/predicted - 1)", "mode < 16"),
          because="damping squared over frequency squared: below 1e-4 for these coefficients",
          statement="forward Euler of the 2D gas is stable only for dt < (eta + zeta + kappa/2)/(rho c^2), "
                    "whatever the wave number: largest relative difference of the limit from eigenvalues of "
                    "the scheme, nested transport, 15 wave numbers, three fluids"),
)
TRIED = "a trial on one set of points had been seen"
ENTROPY = (
    Claim(id="own-entropy-along", source="RR98 Eq. 51", at_most=0, after=TRIED,
          value=largest("entropy", "negative", transport="along edges"),
          because="a sum of squares over temperatures for each edge",
          statement="no edge destroys entropy by forces along it that heat as they work: largest share of "
                    "edges that do, smooth, random and worst states, three kinds of edges"),
    Claim(id="own-entropy-mended", source="RR98 Eq. 51", expect=1, within=0.005, after=TRIED,
          value=farthest("entropy", "total", transport="along edges, mended", state="smooth", cells=64),
          because="0.5 %: 64 cells to a wave leave 0.2 % of second order",
          statement="with their heating mended they produce the entropy of the continuum: over it, smooth "
                    "flow with T from 0.2 to 1.8, 64 cells, farthest of three kinds of edges"),
    Claim(id="own-entropy-nested", source="RR98 Eqs 37, 38", at_least=0, after=TRIED,
          value=least("entropy", "least", transport="nested"), because="the second law",
          statement="nested stress and heat current destroy entropy in no state: least production over the "
                    "sum of its sizes, smooth, random and sought states with T within a factor of 9"),
    Claim(id="own-entropy-brackets", source="RR98 Eqs 34-36", at_least=0, because="the second law",
          value=least("entropy", "least", transport="brackets"),
          statement="the brackets of mass, momentum and energy destroy entropy in no state: least production "
                    "over the sum of what cancels in it, smooth, random and sought states"),
    Claim(id="own-entropy-dissipated", source="Barth 1999", at_most=0,
          value=largest("entropy", "negative", transport="dissipation"),
          because="a sum of squares of jumps for each edge",
          statement="no edge destroys entropy by switched dissipation: largest share of edges that do, "
                    "smooth, random and worst states, lattice and irregular triangles"),
    Claim(id="own-entropy-conserved", source="Tadmor 1987", at_most=1e-12,
          value=largest("entropy", "abs(least)", transport=("crossed pressure", "mean pressure")),
          because="round-off of some hundred edges",
          statement="with logarithmic means and RR98's crossed pressure, or the mean one, closed edges keep "
                    "entropy in every state: largest production over the sum of what cancels in it"),
)
ALONG = (
    Claim(id="own-eq51-order", source="RR98 Eq. 51", expect=2, within=0.05, headline=True,
          value=order("friction, zeta 0", 2), because="the next order, (k h)^4, takes 0.01 of the slope",
          statement="forces along edges are right to second order in 2D, constant eta and zeta = 0: slope of "
                    "the error at h = 3 a, lattice"),
)
LAYER = (
    Claim(id="own-eq37-layer-stable", source="RR98 Eqs 37, 38", at_most=STILL, headline=True,
          value=largest("nested_growth", "growth", err="1e-4*abs(growth)", share=0.0),
          because="rates of what stays are 1e-15, of what grows 1e-5 and more; differences over 1e-4 to 1e-6 "
                  "give the same four figures",
          statement="with nested stress and heat current a motionless layer between adjoint plates stays at "
                    "rest: largest growth rate in c/a, Ra 200 and 1500, 8 to 16 rows, h = 2 a and 3 a"),
    Claim(id="own-nested-share", source="RR98 Eqs 37, 38, 51", value=smallest_share, at_most=0.1,
          because="a tenth; the error is the distance to the next smaller share run",
          statement="a tenth of the transport along edges keeps the layer at rest at h = 2 a: the smallest "
                    "share that was run and is stable"),
)
COEFFICIENTS = (
    coefficient("eq34-36-sound", "Eqs 34-36", TO_SECOND, "sound speed",
                "the speed of sound is that of the gas but for an error of second order in 1/wavelength"),
    coefficient("eq37-viscosity", "Eq. 37", "eta", "viscosity",
                "eta of Eq. 37 is the shear viscosity but for an error of second order", headline=True),
    coefficient("eq37-bulk", "Eq. 37", "zeta", "bulk viscosity",
                "zeta of Eq. 37, with 2/d in place of 2/3, is the bulk viscosity but for an error of second "
                "order"),
    coefficient("eq38-conductivity", "Eq. 38", "kappa", "conductivity",
                "kappa of Eq. 38 is the conductivity but for an error of second order", headline=True),
    Claim(id="rr98-transport-eq37-38-limit", source="RR98 Eqs 34-38", printed="unambiguously identified",
          at_most=1e-3, value=endless((*BOTH, "conductivity", "sound speed"), **NESTED),
          because="what waves of 48 and 64 spacings extrapolate to",
          statement="all coefficients of nested transport are those put in: largest relative difference for "
                    "endless waves on a lattice, h = 3 a"),
    Claim(id="rr98-transport-eq51-identified", source="RR98 Eq. 51", printed="cannot independently identify",
          headline=True, at_least=0.1, value=identified("exact"),
          because="a tenth would be no identification",
          statement="the two viscosities of forces along edges cannot be identified one by one: largest "
                    "relative difference between those put in by A, B of eta, zeta and those measured, edges "
                    "of a weight, h = 3 a, on points jittered by 0.3 a, waves of 32 a"),
    Claim(id="own-transport-eq51-delaunay", source="RR98 Eq. 51", at_most=0.1, value=identified("delaunay"),
          because="a tenth; six edges a point are no average over directions, as Eq. 51 takes with zeta > 0",
          statement="the two viscosities of forces along Delaunay edges are those put in: largest relative "
                    "difference, points jittered by 0.3 a, waves of 32 a"),
    Claim(id="rr98-transport-eq51-eq45", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", at_most=0.01,
          value=number("viscosities, h = 8 a"), because="1 %",
          statement="with many points in the range of the weight, h = 8 a, forces along edges with zeta > 0 "
                    "have the viscosities put in: largest relative error for endless waves along an axis of "
                    "a lattice, by its symbol"),
    *(Claim(id=f"rr98-transport-eq51-long-h{h:.0f}", source="RR98 Eq. 51", at_most=0.01,
            printed="terms proportional to lap v and grad(div v)",
            value=endless(BOTH, transport="pairwise", h=h, **LATTICE),
            because="1 %; sums of W x^4/r^3 over few neighbours are not averages over directions, however "
                    "long the wave",
            statement="forces along edges with zeta > 0 give lap v and grad div v for endless waves: largest "
                      f"relative error of the two viscosities, lattice, waves along an axis, h = {h:.0f} a")
      for h in (2.0, 3.0)),
    *(shear(flow, "lattice", "rms", "mirror plates on a lattice, forces along edges",
            printed="a host of procedures", because="second order; 8 rows are worth 0.03")
      for flow in ("couette", "poiseuille")),
    shear("couette-jittered", "jittered-0.2", "largest",
          "mirror plates on points jittered by 0.2 a, Delaunay edges"),
    shear("couette-jittered-plates", "jittered-0.2, plates", "rms",
          "rows of held points on points jittered by 0.2 a, Delaunay edges"),
)
SCHEME = (*BRACKETS, *TRANSPORT, *ENTROPY, *ALONG, *LAYER, *COEFFICIENTS)
