"""What RR98 says of its scheme on fixed points, judged: brackets, transport, steps, forces along edges    [RR98 Eqs 34-40, 51]"""
import pandas as pd

from studies.kit.claim import Claim
from studies.operators.read import cell, column, error_ratio, least, most, off, relative, size, step_of_fastest

ROUND_OFF = "round-off: sums of some 30 terms, edges from solves with a condition number of 1e3"
CLOSED = ("closed", "exact", "delaunay")
RANGE = {1: 3.0, 2: 3.0, 3: 2.0}


def misses(rows: pd.DataFrame) -> pd.Series:
    """Largest difference of the two viscosities from M_A, M_B, over the size of both."""
    wrong = pd.concat([(rows[name] - rows[f"{name}_predicted"]).abs() for name in ("eta", "zeta")], axis=1).max(axis=1)
    return wrong/(rows["eta_predicted"].abs() + rows["zeta_predicted"].abs())


def off_diagonal(rows: pd.DataFrame) -> pd.Series:
    """|eta along axes/eta along diagonals - 1|."""
    return (rows["eta"]/rows["eta_diagonal"] - 1).abs()


BRACKETS = (
    *(Claim(id=f"rr98-eq{n}-order-{d}d", source=f"RR98 Eq. {n}", expect=2, within=0.05,
            value=cell("orders", "order", d=d, h=RANGE[d], operator=what),
            because="the next order, (k h)^4, takes 0.01 to 0.03 of the slope at these wavelengths",
            statement=f"the discrete equation for {what}, stress and heat current nested with the trace factor 2/d, is right to "
                      f"second order in {d}D on a lattice: slope of the error against exact derivatives of a smooth flow")
      for n, what in ((34, "mass"), (35, "momentum"), (36, "energy")) for d in (1, 2, 3)),
    Claim(id="rr98-eq34-36-conserved", source="RR98 Eqs 34-36", printed="are conserved", at_most=1e-12, because=ROUND_OFF,
          value=most("invariance", column("lost")),
          statement="mass, momentum and energy are conserved by construction: largest loss over what is exchanged, six makers of "
                    "edges, nested, printed and pairwise transport, lattice, jittered and random points, 1 to 3 dimensions"),
    Claim(id="rr98-eq34-uniform", source="RR98 Eq. 34", at_most=1e-12, because=ROUND_OFF,
          value=least("work", column("mass")),
          statement="a uniform stream keeps its uniform density: least over point sets of the largest rate of the mass, rho U/a, "
                    "renormalised edges, jittered and random points, 1 to 3 dimensions"),
    Claim(id="rr98-eq35-rest", source="RR98 Eq. 35", at_most=1e-12, because=ROUND_OFF,
          value=cell("growth_means", "closure", maker="plain", points="jittered-0.3", d=2, viscosity=0.0),
          statement="a fluid of uniform pressure stays at rest: largest acceleration over P/(rho a), plain edges, points "
                    "jittered by 0.3 a"),
    *(Claim(id=f"rr98-eq34-36-{maker}-uniform", source="RR98 Eqs 34-36", at_most=1e-12, because=ROUND_OFF,
            value=most("invariance", column("uniform"), maker=maker),
            statement=f"on edges '{maker}' a uniform fluid in a wind stays as it is: largest rate, nested, printed and pairwise "
                      "transport, lattice, jittered and random points, 1 to 3 dimensions") for maker in CLOSED),
    Claim(id="rr98-eq34-36-closed-galilean", source="RR98 Eqs 34-36", at_most=1e-12, because=ROUND_OFF,
          value=most("invariance", column("wind"), maker=CLOSED),
          statement="on edges that close a wind carries a random state and changes nothing else: largest other rate over the "
                    "largest of all, nested, printed and pairwise transport without mended heating, all points, 1 to 3 "
                    "dimensions"),
    Claim(id="rr98-eq34-35-closed-skew", source="RR98 Eqs 34, 35", at_most=1e-12, because=ROUND_OFF,
          value=most("invariance", column("skew"), maker=CLOSED),
          statement="on edges that close divergence and gradient are adjoint: largest |D + D^T|/|D|, lattice, jittered and "
                    "random points, 1 to 3 dimensions"),
    *(Claim(id=f"rr98-eq34-35-sound{name}", source="RR98 Eqs 34, 35", at_most=1e-12, because=ROUND_OFF,
            value=cell("growth_means", "rate", maker="plain", points="jittered-0.3", d=d, viscosity=eta),
            statement=f"small sound waves in a fluid at rest {words} do not grow off a lattice: largest growth rate a/c, the "
                      f"bracket + in both equations, plain edges, points jittered by 0.3 a in {d}D")
      for name, d, eta, words in (("", 2, 0.0, "without viscosity"), ("-viscous", 2, 0.1, "with the viscosity 0.1 rho c a"),
                                  ("-1d", 1, 0.0, "without viscosity"), ("-3d", 3, 0.0, "without viscosity"))),
    Claim(id="rr98-eq34-35-sound-closed", source="RR98 Eqs 34, 35", at_most=1e-12, because=ROUND_OFF,
          value=most("growth_means", column("largest"), maker=CLOSED),
          statement="on edges that close sound does not grow: largest growth rate a/c, jittered, random and relaxed points and "
                    "lattice, 1 to 3 dimensions, with and without viscosity"),
    Claim(id="rr98-eq36-work", source="RR98 Eq. 36", at_most=1e-12, because=ROUND_OFF, value=most("work", column("work")),
          statement="a uniform stream does no work of pressure on any points, whatever the pressure: largest heating over P U/a, "
                    "random rho and T, jittered and random points, renormalised edges, which do not close, 1 to 3 dimensions"),
)
TRANSPORT = (
    Claim(id="rr98-eq37-null", source="RR98 Eqs 37, 38", at_least=0.1, value=most("nulls", column("nested")),
          because="pairwise forces damp these waves at rates above 0.2 in the same units",
          statement="nested friction and conduction see every wave that points can carry: largest |gradient| a of the waves at "
                    "the 2^d - 1 Nyquist corners, seven weights, 1 to 3 dimensions"),
    Claim(id="rr98-eq37-symbol", source="RR98 Eqs 37, 38", at_most=1e-8, because="nine digits in the table",
          value=most("symbols", lambda rows: (rows["nested"] - rows["gradient"]**2).abs()),
          statement="gradients of gradients see a wave with the square of the gradient's symbol, so that of f^: largest "
                    "difference of -grad grad A/(k^2 A), summed twice over a lattice, and (symbol/k)^2, seven weights, 1 to 3 "
                    "dimensions, up to the Nyquist wave"),
    Claim(id="rr98-eq51-quarter", source="RR98 Eqs 37, 51", expect=4, within=0.1, value=error_ratio,
          because="both are of the same sum of w x^4/r; (k h)^2 = 0.15 of the longest wave leaves 0.01 to 0.02 of it",
          statement="Laplacians along edges err four times less than nested ones: ratio of both errors, wave of 48 a along an "
                    "axis, h = 3 a, five weights, 1 to 3 dimensions, that which is farthest from 4"),
    *(Claim(id=f"rr98-eq{n}-uniform", source=f"RR98 Eq. {n}", at_most=1e-12, because=ROUND_OFF,
            value=cell("stream_means", what, points="jittered-0.3", inner="printed"), statement=statement)
      for n, what, statement in (
          (37, "force", "a uniform stream feels no friction (Galilean invariance): rms force over eta U/a^2, inner sum as "
                        "printed, points jittered by 0.3 a"),
          (38, "heat", "no heat flows at uniform temperature: rms heating over kappa T/a^2, inner sum as printed, points "
                       "jittered by 0.3 a"))),
    *(Claim(id=f"rr98-eq{n}-differences", source=f"RR98 Eq. {n}", at_most=1e-12, because=ROUND_OFF,
            value=most("stream_means", size(what), inner="differences"), statement=statement)
      for n, what, statement in (
          (37, "force", "with v_k - v_j in the inner sum a uniform stream feels no friction: largest rms force over eta U/a^2, "
                        "all points off a lattice"),
          (38, "heat", "with T_k - T_j in the inner sum no heat flows at uniform temperature: largest rms heating over kappa "
                       "T/a^2, all points off a lattice"))),
    Claim(id="rr98-eq37-symmetric", source="RR98 Eqs 37, 38", at_most=1e-12, because=ROUND_OFF,
          value=cell("stream_means", "asymmetry", points="jittered-0.3", inner="printed"),
          statement="friction and conduction act alike both ways (Onsager): |K - K^T|/|K| of the nested operator as printed, "
                    "points jittered by 0.3 a"),
    Claim(id="rr98-eq37-differences-symmetric", source="RR98 Eqs 37, 38", at_most=1e-12, because=ROUND_OFF,
          value=most("stream_means", size("asymmetry"), inner="differences"),
          statement="with differences in the inner sum the nested operator is symmetric: largest |K - K^T|/|K|, all points off a "
                    "lattice"),
    Claim(id="rr98-eq38-growth", source="RR98 Eq. 38", at_most=1e-12, because=ROUND_OFF,
          value=cell("stream_means", "growth", points="random", inner="printed"),
          statement="conduction makes no temperature grow: largest growth rate over kappa/a^2 of the nested operator as printed, "
                    "random points"),
    *(Claim(id=f"rr98-eq{n}-volume", source=f"RR98 Eqs 26, {n}", expect=1, within=0.05,
            value=cell("volumes", "ratio", quantity=name), statement=statement,
            because="twice the 0.4 % that the gradient loses of a wave 64 spacings long")
      for n, name, statement in (
          (37, "stress, v_i = v", "with the field velocity in Eq. 37 the force of Eq. 35 is div Pi dV: their ratio where dV = "
                                  "1/4; a dV is missing"),
          (38, "heat", "with Eq. 38 the heating of Eq. 36 is div(kappa grad T) dV: their ratio where dV = 1/4; a dV is missing "
                       ""))),
    Claim(id="rr98-eq37-volume-literal", source="RR98 Eqs 26, 37", expect=1, within=0.05,
          value=cell("volumes", "ratio", quantity="stress, v_i = v dV"),
          because="twice the 0.4 % that the gradient loses of a wave 64 spacings long",
          statement="with v_i = v dV, as Eq. 26 has it, the force of Eqs 35, 37 is div Pi dV: their ratio where dV = 1/4"),
    Claim(id="rr98-eq40-euler", source="RR98 Eq. 40", at_most=1e-3,
          value=most("euler", relative("limit", "predicted"), transport="nested", mode=tuple(range(1, 16))),
          because="damping squared over frequency squared: below 1e-4 for these coefficients",
          statement="forward Euler of the 2D gas is stable only for dt < (eta + zeta + kappa/2)/(rho c^2), whatever the wave "
                    "number: largest relative difference of the limit from eigenvalues of the scheme, nested transport, 15 wave "
                    "numbers, three fluids"),
    Claim(id="rr98-eq40-pairwise", source="RR98 Eq. 40", at_least=1,
          value=least("euler", lambda rows: rows["limit"]/rows["predicted"], transport="pairwise"),
          because="forces along edges damp short waves more than nested ones, long ones alike",
          statement="pairwise transport allows forward Euler no shorter step: least limit over (eta + zeta + kappa/2)/(rho c^2), "
                    "16 wave numbers, three fluids"),
)
ALONG = (
    Claim(id="rr98-eq51-identify", source="RR98 Eq. 51", printed="one cannot independently identify", at_least=0.1,
          value=most("friction", misses, h=6.0), because="a tenth would leave them unidentified",
          statement="the two viscosities cannot be told from A and B (A alone enters both): largest difference of eta, zeta of "
                    "long waves on a lattice from M_A/2d(d+2) + M_B/2d, M_A/d(d+2) - (1 - 2/d) eta over their size, five forms, "
                    "2 and 3 dimensions, h = 6 a"),
    Claim(id="rr98-eq51-isotropic", source="RR98 Eq. 51", at_most=0.02,
          value=most("friction", off_diagonal, h=3.0),
          because="2 %: other lattice sums at h = 3 a are good to that",
          statement="forces along e_ij on a lattice have one shear viscosity: largest difference of shear along axes and along "
                    "diagonals, five forms of A and B, 2 and 3 dimensions, h = 3 a"),
    Claim(id="rr98-eq51-isotropic-wide", source="RR98 Eq. 51", at_most=0.02, value=most("friction", off_diagonal, h=6.0),
          because="2 %: as at h = 3 a",
          statement="wide weights make them isotropic: largest difference of shear along axes and along diagonals, five forms of "
                    "A and B, 2 and 3 dimensions, h = 6 a"),
    *(Claim(id=f"rr98-eq51-{name}", source="RR98 Eq. 51", expect=2, within=0.05,
            value=cell("orders", "order", d=2, h=3.0, operator=operator), because="the next order, (k h)^4, takes 0.01 of the "
                                                                                  "slope",
            statement=f"forces along edges are right to second order in 2D, {words}: slope of the error at h = 3 a, lattice")
      for name, operator, words in (
          ("order", "friction, zeta 0", "constant eta and zeta = 0"),
          ("order-bulk", "friction, zeta 0.01", "constant eta and zeta = eta/2"),
          ("order-varying", "friction, eta(T)", "eta(T) and zeta = 0"),
          ("order-varying-foretold", "friction, eta(T), foretold",
           "eta(T) and zeta = 0, against div Pi without d_b eta d_a v_b - d_a eta div v, which they lack"),
          ("order-varying-mended", "friction, eta(T), mended", "eta(T) and zeta = 0, with the stress that they lack"))),
    Claim(id="rr98-eq51-order-3d", source="RR98 Eq. 51", expect=2, within=0.05,
          value=cell("orders", "order", d=3, h=2.0, operator="friction, zeta 0"),
          because="the next order, (k h)^4, takes 0.01 to 0.03 of the slope",
          statement="forces along edges are right to second order in 3D, constant eta and zeta = 0: slope of the error at h = 2 "
                    "a, lattice"),
    Claim(id="rr98-eq51-rotation", source="RR98 Eq. 51", expect=0, within=1e-9,
          value=cell("rotation", "heating", d=2, zeta=0.0, mended="no"), because="round-off over omega^2",
          statement="the work of forces along edges, zeta = 0, does not heat a rigid rotation: heating over eta omega^2, 2D; "
                    "central ones, zeta = (1 + 2/d) eta, do not"),
    Claim(id="rr98-eq51-rotation-foretold", source="RR98 Eq. 51", at_most=1e-9, because="round-off over omega^2",
          value=most("rotation", off("heating", "predicted"), mended="no"),
          statement="it heats it by (1 + 2/d) eta - zeta times omega^2: largest difference over eta omega^2, 2D with zeta = 0 "
                    "and eta/2, 3D"),
    Claim(id="rr98-eq51-rotation-mended", source="RR98 Eq. 51", at_most=1e-9,
          value=most("rotation", size("heating"), d=2, zeta=0.0, mended="yes"), because="round-off over omega^2",
          statement="with the flux F added a rigid rotation is not heated: largest over eta omega^2, 2D, zeta = 0"),
    Claim(id="rr98-eq51-rotation-mended-general", source="RR98 Eq. 51", at_most=1e-9,
          value=most("rotation", size("heating"), mended="yes"), because="round-off over omega^2",
          statement="with the flux F added a rigid rotation is not heated, whatever d and zeta: largest over eta omega^2, 2D "
                    "with zeta = 0 and eta/2, 3D"),
)
SOUND = (
    *(Claim(id=f"own-eq34-35-fastest-{h:.0f}", source="RR98 Eqs 34, 35", expect=D, within=5e-4,
            value=cell("fastest", "fastest", weight="Lucy", h=h, rows=48), because="three digits were foretold",
            statement=f"the fastest sound on a square lattice has the frequency {D:.3f} c/a with Lucy's weight, h = {h:.0f} a")
      for h, D in ((2.0, 1.000), (3.0, 0.666), (4.0, 0.498))),
    Claim(id="own-eq34-35-step", source="RR98 Eqs 34, 35", expect=8**0.5, within=1e-3, value=step_of_fastest,
          because="RK4 is stable up to sqrt 8 on the imaginary axis; a growth of 1e-9 a step is told from round-off",
          statement="RK4 is stable up to the step 2.828 over that frequency: longest stable step, by eigenvalues of the scheme, "
                    "times it, h = 2, 3 and 4 a, that which is farthest from 2.828"),
)
POINTS = (
    Claim(id="own-points-relaxed", source="RR98 Sec. III", at_least=0.5, value=least("distances", column("off_lattice"),
                                                                                      points="relaxed"),
          because="half way from a lattice, 0, to points without its order, 1",
          statement="points that are relaxed until they are surrounded evenly have not become a lattice again: least 1 - |mean "
                    "of exp(4 i angle) over bonds to the four nearest|, three sizes, three seeds"),
)
CLAIMS = (*BRACKETS, *TRANSPORT, *ALONG, *SOUND, *POINTS)
