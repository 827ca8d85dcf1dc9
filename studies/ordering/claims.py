"""What RR98 says of range, spacing and wavelength, judged on gradients and whole flows    [Eqs 1, 6, 14, 45]

Limits of gradients in printed form are those of gradients by differences, a form that RR98 does not print.
"""
from itertools import product

from studies.kit.ask import Value, first, of, one, per_seed, rows, share
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.ordering.cases import IRREGULAR, WAVE
from studies.ordering.tables import WANTED, WIDTH

VORTEX, LAYER = "taylor-green", "convection"
LATTICE = {"maker": "renormalised", "points": "lattice"}
KINDS = {"jittered-0.3": "points jittered by 0.3 a", "random": "random points half a spacing apart and more",
         "relaxed": "random points relaxed"}
FORMS = {"single": "f_j alone under the sum, Eq. 1", "sum": "f_i + f_j, Eqs 14 and 34-36"}
JITTERED = "points jittered by 0.3 a, plain quadrature"
ROUGH = 0.1         # an error beyond which a flow is another one


def gradient(maker: str, h: float) -> Value:
    """Error of the gradient of a wave of 32 spacings on a lattice."""
    return one("means", "gradient", maker=maker, points="lattice", h=h, wavelength=WAVE)


def slope(fixed: str, at: float) -> Value:
    """Of the gradient's error in h/lambda, on a lattice."""
    return one("slopes", "slope", maker="renormalised", operator="gradient", points="lattice", fixed=fixed,
               at=at)


def form_error(form: str, h: float = 3.0) -> Value:
    """The gradient's error in one of three forms, plain quadrature on jittered points."""
    return one("bracket_means", "error", points="jittered-0.3", form=form, h=h, wavelength=WAVE)


def order(flow: str, at: float, maker: str, points: str) -> Value:
    """Order of the error of a flow in the spacing, at a range."""
    return one("flow_slopes", "slope", flow=flow, maker=maker, points=points, fixed="h/a", at=at)


def cost(h: float, maker: str, points: str) -> Value:
    """Exchanges of the layer that 1 % takes, cubic in the resolution: points and, for sound, steps."""
    return one("cheapest", "exchanges", "bound == 0", err="3*exchanges*needed_err/needed", flow=LAYER, h=h,
               maker=maker, points=points)


@of
def near_grid(tables: Tables) -> Measured:
    """share(rolls = 2 and |ke/K - 1| < 0.1) in convection, K of reference, plain and renormalised, r0 > a"""
    known = one("reference", "ke", flow="convection")(tables).value
    runs = rows(tables, "convection", f"{WIDTH}*h > 1", maker=("plain", "renormalised"), points=IRREGULAR)
    near = (runs.rolls == 2) & ((runs.ke/known - 1).abs() < ROUGH)
    return Measured(float(near.mean()))


RATIO = "r0, the rms width, is 1.27 a and 0.51 a: if the ordering governs, the wider weight is better"
HALF = "an error that falls at least as the square root of h/lambda"
NEXT = "the next order, (h/lambda)^4, takes 0.01 to 0.02"
WIDER = "a tenth, as with h = 3 a; the r0 of Eq. 30 is"
REACHES = (     # name, range over the spacing, reason of the limit
    ("enough", 3.0, "a tenth is not asking for much: lambda = 25 rms widths of 1.27 a; the r0 of Eq. 30, "
                    "whose rms width is sqrt 2 r0, is then 0.90 a, below the spacing"),
    ("4", 4.0, f"{WIDER} 1.20 a"), ("5", 5.0, f"{WIDER} 1.50 a"), ("wide", 6.0, f"{WIDER} 1.80 a"))
OPEN = "three seeds had left it open, and more were run"
SPACING = "the spacing must be smaller than r0: error of"
WAVES = (
    Claim(id="rr98-eq6-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.05, headline=True,
          evidence="ordering/surface.png", value=slope("h/a", 3.0),
          because=f"{NEXT} of the slope at h/lambda <= 0.2",
          statement="the gradient's error is of second order in r0/lambda on a lattice: slope at h = 3 a, "
                    "renormalised"),
    Claim(id="rr98-eq45-lattice", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", headline=True, at_most=1,
          value=gradient("plain", 3.0)/gradient("plain", 1.2), because=RATIO, evidence="ordering/makers.png",
          statement=f"{SPACING} the gradient with h = 3 a over that with h = 1.2 a, lattice, plain "
                    "quadrature, wavelength 32 a"),
    Claim(id="own-eq45-lattice-renormalised", source="RR98 Eq. 45", at_most=1, because=RATIO,
          value=gradient("renormalised", 3.0)/gradient("renormalised", 1.2), evidence="ordering/makers.png",
          statement=f"{SPACING} the gradient with h = 3 a over that with h = 1.2 a, lattice, weight "
                    "normalised by its sums there, wavelength 32 a"),
    Claim(id="rr98-eq45-lambda", source="RR98 Eq. 45", printed="r0 < lambda", expect=2, within=0.1,
          headline=True, evidence="ordering/surface.png", value=slope("a", 64.0),
          because="0.1: weights of 2 to 6 spacings, whose sums differ by some per cent from integrals",
          statement="r0 must be smaller than lambda: slope of the gradient's error in r0/lambda at fixed "
                    "spacing, lattice, ranges from 2 to 6 spacings, weights normalised by its sums"),
)
BRACKETS = (
    *(Claim(id=f"rr98-eq45-jittered-{form}", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", at_most=1,
            value=form_error(form, 3.0)/form_error(form, 1.2), because=RATIO,
            statement=f"{SPACING} the gradient ({words}) with h = 3 a over that with h = 1.2 a, {JITTERED}, "
                      "wavelength 32 a")
      for form, words in FORMS.items()),
    *(Claim(id=f"rr98-eq45-jittered-{form}-{name}", source="RR98 Eq. 45",
            printed="a good representation of the gradients", at_most=0.1, value=form_error(form, h),
            because=because, after=OPEN*(h > 4),
            statement=f"a < r0 < lambda gives a good gradient: its error ({FORMS[form]}) with h = {h:g} a, "
                      f"{JITTERED}, wavelength 32 a")
      for form, (name, h, because) in product(FORMS, REACHES)),
    *(Claim(id=f"rr98-continuum-limit-jittered-{form}", source="RR98 Sec. III", printed="continuum limit",
            at_least=0.5, value=one("bracket_slopes", "slope", points="jittered-0.3", form=form),
            because=HALF, headline=True, evidence="ordering/makers.png",
            statement="r0 -> 0 with a < r0 gives the continuum limit also off a lattice: slope of the "
                      f"gradient's error ({words}) in h/lambda at h = 3 a, {JITTERED}")
      for form, words in FORMS.items()),
    Claim(id="own-eq1-differences", source="RR98 Eq. 1", at_most=0.5,
          value=form_error("difference")/form_error("single"),
          because="a half would be worth the subtraction",
          statement="differences mend that: error of the gradient with f_j - f_i over that with f_j alone, h "
                    f"= 3 a, {JITTERED}, wavelength 32 a"),
)
VORTICES = (
    Claim(id="rr98-eq45-vortex-lambda", source="RR98 Eq. 45", printed="r0 < lambda", expect=2, within=0.1,
          value=one("flow_slopes", "slope", flow=VORTEX, fixed="a", at=64.0, **LATTICE),
          because="0.1: sums over a few neighbours differ from integrals",
          statement="r0 must be smaller than lambda: slope of a Taylor-Green vortex's error in r0/lambda at "
                    "fixed spacing, lattice, h = 2 a to 4 a"),
    Claim(id="rr98-eq45-vortex-irregular", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0 < lambda",
          headline=True, evidence="ordering/flows_points.png", at_least=1,
          value=share("vortices", f"velocity < {ROUGH}", f"{WIDTH:.3f}*h > 1",
                      maker=("plain", "renormalised"), points=IRREGULAR),
          because="every run: the ordering is all that RR98 asks for",
          statement="the ordering is enough: share of Taylor-Green vortices with RR98's bracket on fixed "
                    "irregular points, r0 above the spacing, that end with an error below a tenth"),
    Claim(id="rr98-eq6-vortex-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.05,
          value=order(VORTEX, 2.0, **LATTICE), because=NEXT,
          statement="errors are of second order in r0/lambda: slope of a Taylor-Green vortex's, lattice, h = "
                    "2 a"),
    *(Claim(id=f"own-vortex-triangles-{points.split('-')[0]}", source="RR98 Sec. III", at_least=1.95,
            value=order(VORTEX, 0.0, "delaunay", points),
            because="second order, within the 0.05 that slopes of compact weights are given; faster is no "
                    "fault",
            statement="a triangulation gives the continuum limit without weights, to second order: order of "
                      f"a Taylor-Green vortex's error on {words}, no filter")
      for points, words in KINDS.items()),
    Claim(id="own-vortex-closed-error", source="RR98 Sec. III", at_most=WANTED,
          value=first("flows", "error", "points != 'relaxed' and error == error", by="error", maker="closed",
                      flow=VORTEX, resolution=48),
          because="1 %, the error at which resolutions are compared",
          statement="closing the edges is enough: least error of a Taylor-Green vortex over jittered and "
                    "random points and three ranges at the largest wavelength"),
)
CONVECTION = (
    Claim(id="rr98-eq6-convection-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.2,
          headline=True, evidence="ordering/flows_range.png", value=order(LAYER, 2.0, **LATTICE),
          because="0.2: 12 rows hold boundary layers of three spacings",
          statement="errors are of second order in r0/lambda: slope of that of K in Rayleigh-Benard, "
                    "lattice, h = 2 a"),
    Claim(id="rr98-eq45-convection-irregular", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0 < lambda",
          at_least=1, value=near_grid, because="every run: the ordering is all that RR98 asks for",
          statement="the ordering is enough: share of Rayleigh-Benard runs, Ra 10 000, with RR98's bracket "
                    "on fixed irregular points between mirror images, h = 3 a, r0 above the spacing, whose K "
                    "ends within a tenth of the grid's"),
    *(Claim(id=f"rr98-convection-plain-{points.split('-')[0]}", source="RR98 Sec. III",
            printed="continuum limit", at_least=1,
            value=per_seed(share("convection", "rolls == 2", maker="plain", points=points)),
            because="every run: one that ends early has no limit",
            statement="plain quadrature runs off a lattice: share of Rayleigh-Benard runs, Ra 10 000, 16 to "
                      f"32 rows, h = 2 a and 3 a, that come to their end in two rolls, {words}")
      for points, words in KINDS.items()),
    Claim(id="own-convection-closed-error", source="RR98 Sec. III", at_most=WANTED,
          value=abs(one("flows", "error", flow=LAYER, resolution=32, h=2.0, maker="closed",
                        points="jittered-0.3")),
          because="1 %, the error at which resolutions are compared",
          statement="closing the edges is enough: |error| of K in Rayleigh-Benard at 32 rows, h = 2 a, "
                    f"{KINDS['jittered-0.3']}", after="no order could be told, as runs with h = 3 a diverge"),
    *(Claim(id=f"own-convection-triangles-cost-{points.split('-')[0]}", source="RR98 Sec. III", at_most=10,
            value=cost(0.0, "delaunay", points)/cost(1.2, **LATTICE),
            because="an order of magnitude, as is asked of the vortex",
            statement="irregular points cost little: exchanges over edges for 1 % of K in Rayleigh-Benard, "
                      f"Ra 10 000, on {words}, triangulated, over those on a lattice with its nearest "
                      "neighbours")
      for points, words in KINDS.items()),
)
CLAIMS = (*WAVES, *BRACKETS, *VORTICES, *CONVECTION)
