"""What RR98's ordering says of whole flows, judged    [RR98 Eq. 45, Sec. III]"""
import numpy as np

from particles.integral.interpolants import moment
from particles.weights import Lucy
from studies.build.read import Value, off, ratio, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.ordering.flows import MACH, WANTED
from studies.ordering.vortices import RE

LATTICE = {"maker": "renormalised", "weight": "Lucy", "points": "lattice"}
VORTEX = {"flow": "taylor-green", "quantity": "velocity"}
LAYER = {"flow": "convection", "quantity": "K"}
IRREGULAR = ("jittered-0.3", "random", "relaxed")
KINDS = {"jittered-0.3": "points jittered by 0.3 a", "random": "random points half a spacing apart and more",
         "relaxed": "random points relaxed"}
ROUGH = 0.1         # an error beyond which a flow is another one
#: rms width of Lucy's weight over its range, in 2D: RR98's r0
WIDTH = float(np.sqrt(moment(Lucy.of(h=1.0, d=2), 3, 2)/4))


def error(tables: Tables, flow: dict[str, str], **where) -> Measured:
    """Size of the mean error at one point of the surface.

    Raises
    ------
    CannotTell
        No seed has a number there.
    """
    row = select(tables, "flows", **flow, **where).iloc[0]
    if not np.isfinite(row["error"]):
        raise CannotTell(f"all {row['seeds']:.0f} runs with {row['maker']} edges on {row['points']} points diverged")
    return off(Measured(float(row["error"]), float(row["error_err"])), 0.0)


def wider(flow: dict[str, str], resolution: int) -> Value:
    """Error with h = 3 a over that with h = 1.2 a on a lattice: r0 = 1.27 a and 0.51 a."""
    return lambda tables: ratio(*(error(tables, flow, **LATTICE, h=h, resolution=resolution) for h in (3.0, 1.2)))


def slope(flow: dict[str, str], fixed: str, at: float, **where) -> Value:
    """One of the slopes."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "flow_slopes", **flow, **where, fixed=fixed, at=at).iloc[0]
        return Measured(float(row["slope"]), float(row["slope_err"]))
    return value


def of_triangles(flow: dict[str, str], points: str) -> Value:
    """Order on the triangulation of irregular points."""
    return slope(flow, "h/a", 0.0, maker="delaunay", weight="none", points=points)


def ordered(tables: Tables) -> Measured:
    """Share of vortices with RR98's bracket on irregular points, a < r0 < lambda, that end with an error below a tenth."""
    rows = select(tables, "vortices", mach=MACH)
    rows = rows[rows["maker"].isin(["plain", "renormalised"]) & rows["points"].isin(IRREGULAR) & (WIDTH*rows["h"] > 1)]
    if rows.empty:
        raise CannotTell("no vortex on irregular points has a wide weight: a larger SIZE of the study runs some")
    return Measured(float((rows["velocity"] < ROUGH).mean()), 0.0)


def smallest_loss(tables: Tables) -> Measured:
    """Least error of vortices with A' at the largest resolution, on points that were not relaxed."""
    rows = select(tables, "flows", **VORTEX, maker="closed")
    rows = rows[rows["resolution"] == rows["resolution"].max()]
    rows = rows[rows["points"] != "relaxed"]
    row = rows.sort_values("error").iloc[0]
    return Measured(float(row["error"]), float(row["error_err"]))


def cost(tables: Tables, flow: dict[str, str], **where) -> Measured:
    """Exchanges of the run that 1 % takes, cubic in the resolution: points and, for sound, steps.

    Raises
    ------
    CannotTell
        1 % was not reached, or already at the least resolution.
    """
    row = select(tables, "cheapest", **flow, **where).iloc[0]
    if not np.isfinite(row["exchanges"]) or row["bound"]:
        raise CannotTell(f"1 % is {'reached at every' if row['bound'] else 'not reached at any'} resolution that was run")
    return Measured(float(row["exchanges"]), float(3*row["exchanges"]*row["needed_err"]/row["needed"]))


def dearer(flow: dict[str, str]) -> Value:
    """Cost of 1 % with h = 3 a over that with h = 1.2 a, on a lattice."""
    return lambda tables: ratio(*(cost(tables, flow, **LATTICE, h=h) for h in (3.0, 1.2)))


def cheapest_width(flow: dict[str, str]) -> Value:
    """r0/a of the weight with which 1 % is the cheapest on a lattice."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "cheapest", **flow, **LATTICE).dropna(subset=["exchanges"])
        if len(rows) < 2:
            raise CannotTell("1 % was reached with one range at most")
        return Measured(WIDTH*float(rows.sort_values("exchanges")["h"].iloc[0]), 0.0)
    return value


def triangles_cost(tables: Tables) -> Measured:
    """Exchanges of 1 % on triangulated jittered points over those on a lattice with its nearest neighbours."""
    return ratio(cost(tables, VORTEX, maker="delaunay", weight="none", points="jittered-0.3", h=0.0),
                 cost(tables, VORTEX, **LATTICE, h=1.2))


def compressed(tables: Tables) -> Measured:
    """What the Mach number of the vortices changes."""
    row = select(tables, "compression", mach=MACH).iloc[0]
    return Measured(float(row["velocity"]), float(row["velocity_err"]))


SECOND = "nearer to second order than to first"
TWICE = "r0, the rms width, is 1.27 a and 0.51 a: if the ordering governs, the wider weight is better"
CLAIMS = (
    Claim(id="rr98-eq45-vortex-lattice", source="RR98 Eq. 45", at_most=1, value=wider(VORTEX, 32),
          statement="the spacing must be smaller than r0: error of a Taylor-Green vortex with h = 3 a over that with h = 1.2 a, "
                    "lattice, wavelength 32 a", because=TWICE),
    Claim(id="rr98-eq45-convection-lattice", source="RR98 Eq. 45", at_most=1,
          value=wider(LAYER, 24), because=TWICE,
          statement="the spacing must be smaller than r0: |error| of K in Rayleigh-Benard, Ra 10 000, with h = 3 a over that "
                    "with h = 1.2 a, lattice, 24 rows"),
    Claim(id="rr98-eq45-vortex-lambda", source="RR98 Eq. 45", printed="r0 < lambda", expect=2, within=0.1,
          value=slope(VORTEX, "a", 64.0, **LATTICE), because="0.1: sums over a few neighbours differ from integrals",
          statement="r0 must be smaller than lambda: slope of a Taylor-Green vortex's error in r0/lambda at fixed spacing, "
                    "lattice, h = 2 a to 4 a"),
    Claim(id="rr98-eq45-vortex-irregular", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0 < lambda", at_least=1, value=ordered,
          statement="the ordering is enough: share of Taylor-Green vortices with RR98's bracket on fixed irregular points, r0 "
                    "above the spacing, that end with an error below a tenth",
          because="every run: the ordering is all that RR98 asks for"),
    Claim(id="rr98-eq6-vortex-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.05,
          value=slope(VORTEX, "h/a", 2.0, **LATTICE), because="the next order, (h/lambda)^4, takes 0.01 to 0.02",
          statement="errors are of second order in r0/lambda: slope of a Taylor-Green vortex's, lattice, h = 2 a"),
    Claim(id="rr98-eq6-convection-order", source="RR98 Eq. 6", printed="r0^2", expect=2, within=0.2,
          value=slope(LAYER, "h/a", 2.0, **LATTICE), because="0.2: 12 rows hold boundary layers of three spacings",
          statement="errors are of second order in r0/lambda: slope of that of K in Rayleigh-Benard, lattice, h = 2 a"),
    Claim(id="rr98-eq45-cost-vortex", source="RR98 Eq. 45", at_most=1, value=dearer(VORTEX),
          statement="a weight wider than the spacing pays: exchanges over edges for 1 % in a Taylor-Green vortex with h = 3 a "
                    "over those with h = 1.2 a, lattice", because=TWICE),
    Claim(id="rr98-eq45-cheapest-vortex", source="RR98 Eq. 45", at_least=1,
          value=cheapest_width(VORTEX), because="the ordering itself, for the cheapest of six ranges",
          statement="the spacing must be smaller than r0: r0/a at the cheapest 1 % in a Taylor-Green vortex, lattice"),
    Claim(id="rr98-eq45-cheapest-convection", source="RR98 Eq. 45", at_least=1,
          value=cheapest_width(LAYER), because="the ordering itself, for the cheapest of six ranges",
          statement="the spacing must be smaller than r0: r0/a at the cheapest 1 % of K in Rayleigh-Benard, Ra 10 000, lattice"),
    *(Claim(id=f"own-vortex-triangles-{name.split('-')[0]}", source="RR98 Sec. III",
            at_least=1.95, value=of_triangles(VORTEX, name),
            because="second order, within the 0.05 that slopes of compact weights are given; faster is no fault",
            statement=f"a triangulation gives the continuum limit without weights, to second order: order of a Taylor-Green "
                      f"vortex's error on {kind}, no filter") for name, kind in KINDS.items()),
    *(Claim(id=f"own-convection-triangles-{name.split('-')[0]}", source="RR98 Sec. III", at_least=1,
            value=of_triangles(LAYER, name), because="first order at least: 12 rows are not yet in the range of the second",
            statement=f"a triangulation gives the continuum limit without weights: order of K in Rayleigh-Benard on {kind}")
      for name, kind in KINDS.items()),
    Claim(id="own-vortex-exact", source="RR98 Sec. III", at_least=1.5,
          value=slope(VORTEX, "h/a", 3.0, maker="exact", weight="Lucy", points="jittered-0.3"), because=SECOND,
          statement="edges of a weight that close and are exact on linear fields give the continuum limit: order of a "
                    "Taylor-Green vortex's error on points jittered by 0.3 a, h = 3 a"),
    *(Claim(id=f"own-vortex-exact-{name}", source="RR98 Sec. III", at_least=1.5, because=SECOND,
            value=slope(VORTEX, "h/a", 3.0, maker="exact", weight="Lucy", points=name),
            statement="edges of a weight that close and are exact on linear fields give the continuum limit: order of a "
                      f"Taylor-Green vortex's error on {KINDS[name]}, h = 3 a; asked after that of jittered points was known")
      for name in ("random", "relaxed")),
    *(Claim(id=f"own-vortex-closed-{name.split('-')[0]}", source="RR98 Sec. III", at_least=0.5,
            value=slope(VORTEX, "h/a", 3.0, maker="closed", weight="Lucy", points=name),
            statement=f"closing the edges (A') is enough for the continuum limit: order of a Taylor-Green vortex's error on "
                      f"{kind}, h = 3 a", because="an error that falls at least as the square root of the spacing")
      for name, kind in KINDS.items()),
    Claim(id="own-vortex-closed-error", source="RR98 Sec. III", at_most=WANTED, value=smallest_loss,
          statement="closing the edges (A') is enough: least error of a Taylor-Green vortex over jittered and random points and "
                    "three ranges at the largest wavelength", because="1 %, the error at which resolutions are compared"),
    Claim(id="own-vortex-triangles-cost", source="RR98 Sec. III", at_most=10, value=triangles_cost,
          statement="irregular points cost little: exchanges over edges for 1 % in a Taylor-Green vortex on triangulated points "
                    "jittered by 0.3 a over those on a lattice with its nearest neighbours", because="an order of magnitude"),
    Claim(id="own-vortex-compression", source="RR98 Sec. III", at_most=WANTED/10, value=compressed,
          statement=f"a Taylor-Green vortex at Mach {MACH:g}, Re {RE:g} stands for an incompressible one: relative rms of what "
                    "compression changes in its velocity", because="a tenth of the error at which resolutions are compared"),
)
