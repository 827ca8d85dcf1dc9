"""Boundaries that RR98 leaves open, judged    [RR98, Secs III, IV]"""
from studies.build.read import Value, off, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables


def cell(tables: Tables, table: str, column: str, **where) -> Measured:
    """A number and its error, where the table has one."""
    row = select(tables, table, **where).iloc[0]
    return Measured(float(row[column]), float(row[f"{column}_err"]) if f"{column}_err" in row else 0.0)


def of(table: str, column: str, **where) -> Value:
    """The same as a value function."""
    return lambda tables: cell(tables, table, column, **where)


def largest_of(table: str, columns: tuple[str, ...], **where) -> Value:
    """The largest number of some columns."""
    return lambda tables: Measured(float(select(tables, table, **where)[list(columns)].abs().max().max()), 0.0)


def of_size(table: str, column: str, **where) -> Value:
    """The size of a number of either sign."""
    return lambda tables: off(cell(tables, table, column, **where), 0.0)


def drag_error(variant: str, fraction: float) -> Value:
    """|error| of the drag at 48 rows."""
    return lambda tables: off(cell(tables, "drag", "error", variant=variant, fraction=fraction, rows=48), 0.0)


def creeping(tables: Tables) -> Measured:
    """Change of the drag in the last tenth of the time without filter over that with it."""
    with_, without = (float(select(tables, "drag", variant=name, fraction=0.1, rows=32)["drag_err"].min())
                      for name in ("surface", "surface-unfiltered"))
    return Measured(without/with_, 0.0)


def inertia(tables: Tables) -> Measured:
    """Relative change of the drag when the stream is four times as fast."""
    rows = select(tables, "drag", variant="surface", fraction=0.1, rows=24).sort_values("reynolds")
    if len(rows) < 2:
        raise CannotTell("one speed was run: a larger SIZE of the study has two")
    slow, fast = rows["drag"].iloc[0], rows["drag"].iloc[-1]
    return Measured(abs(fast/slow - 1), float(rows["drag_err"].sum()/slow))


PERCENT = "1 %, the error at which resolutions are compared in this repository"
CLAIMS = (
    Claim(id="rr98-sliding-exact", source="RR98 Sec. IV", printed="can be used", at_most=1e-9,
          value=largest_of("shear", ("stress", "heating", "profile"), kind="sliding sides"),
          statement="Lees-Edwards sides can be used: homogeneous shear between them, largest relative error of stress (eta "
                    "rate), heating (eta rate^2) and profile while the images slide two boxes",
          because="an exact solution: round-off of 400 to 1600 steps, of an energy of which friction adds 0.4 %"),
    Claim(id="rr98-sliding-conserves", source="RR98 Sec. IV", printed="can be used", at_most=1e-12,
          value=largest_of("shear", ("mass_drift", "momentum_drift"), kind="sliding sides"),
          statement="Lees-Edwards sides can be used: drift of mass and momentum in homogeneous shear between them",
          because="round-off of 400 to 1600 steps"),
    Claim(id="rr98-sliding-order", source="RR98 Sec. IV", printed="can be used", expect=2, within=0.15,
          value=of("body_orders", "order", what="turning wave"),
          statement="Lees-Edwards sides can be used: order of the error of a plane wave that the shear turns by a right angle",
          because="0.15: at 16 rows, a seventh of a radian to the spacing, the next order is a tenth of the error"),
    Claim(id="own-bodies-moving-rows", source="RR98 Sec. III", at_most=1e-8,
          value=largest_of("shear", ("stress", "heating", "profile"), kind="fixed rows"),
          statement="rows of fixed points that move are plates that lie on the first of these rows: Couette flow between "
                    "them, largest relative error of stress, heating and profile",
          because="an exact solution of the exchange with nearest neighbours; what the start leaves after 20 times of friction"),
    Claim(id="rr98-fixed-rows-plate", source="RR98 Sec. III", expect=0, within=0.05,
          value=of("walls", "offset", maker="renormalised", h=2.0, rows=32),
          statement="fixed rows from half a spacing behind a plate on [KHP95, Fig. 2] are a wall there for fixed points too: "
                    "how far behind the plate driven flow stops, in spacings, h = 2 a",
          because="a twentieth of a spacing: less than 1 % of the flow through 32 rows"),
    Claim(id="own-bodies-wall-on-row", source="RR98 Sec. III", expect=0.5, within=1e-3,
          value=of("walls", "offset", maker="renormalised", h=2.0, rows=32),
          statement="edges to nearest neighbours put the wall on the first fixed row, half a spacing behind the plate: where "
                    "driven flow stops", because="exact for a parabola, but for the compression of the gas"),
    Claim(id="rr98-frozen-body", source="RR98 Sec. IV", at_most=0.01, value=drag_error("frozen", 0.1),
          statement="'freezing' a number of points simulates a rigid body: |error| of the drag of a cylinder in a square "
                    "array, solid fraction 0.1, lattice points within the circle frozen, 17 spacings across", because=PERCENT),
    Claim(id="own-bodies-frozen-offset", source="RR98 Sec. IV", at_most=-0.1,
          value=of("drag_limits", "offset", variant="frozen", fraction=0.1),
          statement="lattice points frozen within a circle make a smaller body: radius that the drag tells less the true one, in "
                    "spacings, mean over 13 sizes",
          because="a tenth of a spacing, 2 % of the drag at 8 spacings: more than points on the surface err by"),
    Claim(id="own-bodies-grown-offset", source="RR98 Sec. IV", expect=0, within=0.1,
          value=of("drag_limits", "offset", variant="frozen-grown", fraction=0.1),
          statement="freezing all within half a spacing of the circle mends that: radius that the drag tells less the true one, "
                    "in spacings, mean over 13 sizes",
          because="a fifth of what is added"),
    Claim(id="own-bodies-surface-0.1", source="Sangani & Acrivos 1982, Table 1", printed="24.83",
          value=drag_error("surface", 0.1), at_most=0.01,
          statement="points on the surface, Delaunay edges: |error| of the drag, solid fraction 0.1, 17 spacings across",
          because=PERCENT),
    Claim(id="own-bodies-surface-0.3", source="Sangani & Acrivos 1982, Table 1", printed="102.90", at_most=0.01,
          value=drag_error("surface", 0.3),
          statement="points on the surface, Delaunay edges: |error| of the drag, solid fraction 0.3, 30 spacings across",
          because=PERCENT),
    Claim(id="own-bodies-limit-0.1", source="Sangani & Acrivos 1982, Table 1", printed="24.83", expect=0, within=0.003,
          value=of("drag_limits", "error", variant="surface", fraction=0.1),
          statement="points on the surface: drag extrapolated to infinitely fine points against print, relative, solid "
                    "fraction 0.1",
          because="0.3 %, as for other limits of second order here"),
    Claim(id="own-bodies-limit-0.3", source="Sangani & Acrivos 1982, Table 1", printed="102.90", expect=0, within=0.003,
          value=of("drag_limits", "error", variant="surface", fraction=0.3),
          statement="points on the surface: drag extrapolated to infinitely fine points against print, relative, solid "
                    "fraction 0.3",
          because="0.3 %, as for other limits of second order here"),
    Claim(id="own-bodies-surface-order", source="RR98 Sec. IV", expect=-2, within=0.5,
          value=of("drag_limits", "slope", variant="surface", fraction=0.1),
          statement="points on the surface: slope of the drag's error over the rows, solid fraction 0.1",
          because="0.5 parts second from first and third order"),
    Claim(id="own-bodies-balance", source="RR98 Sec. IV", at_most=1e-4,
          value=largest_of("drag", ("balance",), variant="surface"),
          statement="the force that edges carry to the body is that which drives the fluid: largest relative difference, "
                    "points on the surface", because="1e-4: what was not steady yet; the exchange itself is exact to round-off"),
    Claim(id="own-bodies-torque", source="RR98 Sec. IV", printed="moving boundaries", at_most=0.01,
          value=of_size("torque", "turned", rows=48),
          statement="held points can simulate moving boundaries: |error| of the torque on a cylinder that turns in one at rest, "
                    "from all its edges, those inside too, 17 spacings across",
          because=PERCENT),
    Claim(id="own-bodies-torque-order", source="RR98 Sec. IV", expect=2, within=0.5,
          value=of("body_orders", "order", what="turning cylinder"),
          statement="order of the error of that torque", because="0.5 parts second from first and third order"),
    Claim(id="own-bodies-torque-balance", source="RR98 Sec. IV", at_most=1e-4,
          value=largest_of("torque", ("balance",)),
          statement="the cylinder at rest takes the torque that drives the one which turns: largest relative difference",
          because="1e-4: what is not steady yet; the forces along edges are not central, so nothing makes it exact"),
    Claim(id="own-bodies-filter", source="RR98 Sec. IV", at_least=10, value=creeping,
          statement="without a filter of the density slow flow around a body creeps on: change of the drag in the last tenth "
                    "of the time over that with the filter, points on the surface, 32 rows",
          because="ten times: no matter of chance"),
    Claim(id="own-bodies-inertia", source="Sangani & Acrivos 1982, Table 1", at_most=1e-4, value=inertia,
          statement="inertia and compression do not count: change of the drag when the stream is four times as fast, 24 rows",
          because="1e-4, below the last digit of print"),
)
