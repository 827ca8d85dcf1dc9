"""What disorder does to convection, edges of a weight beside triangles, judged    [RR98 Eq. 45, Sec. III]

Order of K and what 1 % costs are asked as they were of the vortex, with its limits (`ordering_flows_claims`).
"""
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from particles.integral.edge_makers import closed
from particles.weights import Lucy
from studies.build.read import Value, ratio, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured, combine
from studies.kit.table import Tables
from studies.ordering.convection import MADE
from studies.ordering.flows import LEAST, WANTED
from studies.ordering.flows_claims import IRREGULAR, KINDS, LATTICE, LAYER, ROUGH, WIDTH, cost, error, slope
from studies.build.disorder import DISORDERS

LARGEST = 32        # rows between images
PLACES = (32, 32)   # points of which the share that closed edges miss is told
RANGES = (2.0, 3.0)


def runs(tables: Tables, makers: tuple[str, ...], points: tuple[str, ...], least: float = 0.0) -> pd.DataFrame:
    """Runs with Lucy's weight on irregular points, r0 above so many spacings."""
    rows = select(tables, "convection", weight="Lucy")
    rows = rows[rows["maker"].isin(makers) & rows["points"].isin(points) & (WIDTH*rows["h"] > least)]
    if rows.empty:
        raise CannotTell("no convection on irregular points has such edges: a larger SIZE of the study runs some")
    return rows


def ordered(tables: Tables) -> Measured:
    """Share of layers with RR98's bracket on irregular points, a < r0 < lambda, whose K ends within a tenth of the grid's."""
    rows = runs(tables, ("plain", "renormalised"), IRREGULAR, 1.0)
    known = select(tables, "reference", flow="convection")["ke"].iloc[0]
    near = (rows["rolls"] == 2) & ((rows["ke"]/known - 1).abs() < ROUGH)
    return Measured(float(near.mean()), 0.0)


def survived(maker: str, points: tuple[str, ...] = IRREGULAR) -> Value:
    """Share of runs that come to their end, in the two rolls that they start with."""
    return lambda tables: Measured(float((runs(tables, (maker,), points)["rolls"] == 2).mean()), 0.0)


def share(points: str, h: float) -> Measured:
    """1 - gamma: gradients of linear fields by closed edges are gamma times too small in the mean over points, three sets."""
    made = [closed(DISORDERS[points].make(PLACES, DISORDERS[points].size, seed), Lucy.of(h=h)) for seed in (1, 2, 3)]
    return combine([(1 - float(np.einsum("i,iaa->", edges.V, edges.linear)/edges.V.sum()/2), 0.0) for edges in made])


def floor(points: str) -> Value:
    """|error| of K with closed edges at the largest number of rows over the share foretold, the smaller of both ranges."""
    def value(tables: Tables) -> Measured:
        found = [ratio(error(tables, LAYER, maker="closed", weight="Lucy", points=points, h=h, resolution=LARGEST),
                       share(points, h)) for h in RANGES]
        return min(found, key=lambda one: one.value)
    return value


def ended(row: Mapping[Any, Any]) -> str:
    """How many runs of one point of the surface came to their end, and how far off."""
    off = f", {row['error']:.2f} +- {row['error_err']:.2f} off" if row["lost"] < row["seeds"] else ""
    return f"{row['resolution']:.0f} rows: {row['seeds'] - row['lost']:.0f} of {row['seeds']:.0f} runs end{off}"


def order(maker: str, points: str) -> Value:
    """Order of K at h = 3 a.

    Raises
    ------
    CannotTell
        Sets of points were lost, or their errors are not told from zero, at too many numbers of rows.
    """
    where = {"maker": maker, "weight": "Lucy", "points": points}

    def value(tables: Tables) -> Measured:
        try:
            return slope(LAYER, "h/a", 3.0, **where)(tables)
        except CannotTell:
            rows = select(tables, "flows", **LAYER, **where, h=3.0)
            told = "; ".join(ended(row) for row in rows.sort_values("resolution").to_dict("records"))
            raise CannotTell(f"errors are told from zero at fewer than {LEAST} numbers of rows ({told})") from None
    return value


def triangles_cost(points: str) -> Value:
    """Exchanges of 1 % in K on triangulated points over those on a lattice with its nearest neighbours."""
    return lambda tables: ratio(cost(tables, LAYER, maker="delaunay", weight="none", points=points, h=0.0),
                                cost(tables, LAYER, **LATTICE, h=1.2))


def cheapest_triangles(tables: Tables) -> Measured:
    """Exchanges of the cheapest 1 % of K on irregular points by edges of a weight over those by triangles, same points.

    Raises
    ------
    CannotTell
        Edges of a weight reach 1 % on no irregular points, or at all resolutions.
    """
    rows = select(tables, "cheapest", **LAYER)
    rows = rows[rows["points"].isin(IRREGULAR) & rows["exchanges"].notna() & (rows["bound"] == 0)]
    weighed = rows[rows["maker"] != "delaunay"].sort_values("exchanges")
    if weighed.empty:
        raise CannotTell(f"1 % of K is not reached by any of {len(MADE)} edges of a weight on any irregular points, up to "
                         f"{LARGEST} rows")
    best = weighed.iloc[0]
    return ratio(cost(tables, LAYER, **{name: best[name] for name in ("maker", "weight", "points", "h")}),
                 cost(tables, LAYER, maker="delaunay", weight="none", points=best["points"], h=0.0))


CLAIMS = (
    Claim(id="rr98-eq45-convection-irregular", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0 < lambda", at_least=1,
          value=ordered, because="every run: the ordering is all that RR98 asks for",
          statement="the ordering is enough: share of Rayleigh-Benard runs, Ra 10 000, with RR98's bracket on fixed irregular "
                    "points between mirror images, h = 3 a, r0 above the spacing, whose K ends within a tenth of the grid's"),
    *(Claim(id=f"rr98-convection-plain-{name.split('-')[0]}", source="RR98 Sec. III", printed="continuum limit", at_least=1,
            value=survived("plain", (name,)), because="every run: one that ends early has no limit",
            statement="plain quadrature runs off a lattice: share of Rayleigh-Benard runs, Ra 10 000, 16 to 32 rows, h = 2 a and "
                      f"3 a, that come to their end in two rolls, {kind}") for name, kind in KINDS.items()),
    Claim(id="own-convection-closed-runs", source="RR98 Sec. III", at_least=1, value=survived("closed"),
          because="every run: edges that close push no fluid at rest and let no sound grow",
          statement="closing the edges (A') is enough to run: share of Rayleigh-Benard runs on irregular points between mirror "
                    "images that come to their end in two rolls"),
    *(Claim(id=f"own-convection-exact-{name.split('-')[0]}", source="RR98 Sec. III", at_least=1, value=order("exact", name),
            because="first order at least, as is asked of triangles: images off a lattice leave an error of first order",
            statement="edges of a weight that close and are exact on linear fields give the continuum limit: order of K in "
                      f"Rayleigh-Benard on {kind} between mirror images, h = 3 a") for name, kind in KINDS.items()),
    *(Claim(id=f"own-convection-closed-{name.split('-')[0]}", source="RR98 Sec. III", at_least=0.5, value=order("closed", name),
            because="an error that falls at least as the square root of the spacing, as is asked of the vortex",
            statement="closing the edges (A') is enough for the continuum limit: order of K in Rayleigh-Benard on "
                      f"{kind} between mirror images, h = 3 a") for name, kind in KINDS.items()),
    *(Claim(id=f"own-convection-closed-floor-{name.split('-')[0]}", source="RR98 Sec. III", at_least=1, value=floor(name),
            because="a gas whose gradients and diffusion both are gamma of their own has an error of 1 - gamma and more: K = "
                    "k(Ra/gamma)/gamma",
            statement="what closed edges (A') miss stays: |error| of K at 32 rows over 1 - gamma, the mean share that they take "
                      f"from gradients of linear fields, the smaller of h = 2 a and 3 a, {KINDS[name]}")
      for name in ("jittered-0.3", "random")),
    Claim(id="own-convection-closed-error", source="RR98 Sec. III", at_most=WANTED,
          value=lambda tables: error(tables, LAYER, maker="closed", weight="Lucy", points="jittered-0.3", h=2.0,
                                     resolution=LARGEST),
          because="1 %, the error at which resolutions are compared",
          statement="closing the edges (A') is enough: |error| of K in Rayleigh-Benard at 32 rows, h = 2 a, "
                    f"{KINDS['jittered-0.3']}; asked after no order could be told, as runs with h = 3 a diverge"),
    *(Claim(id=f"own-convection-triangles-cost-{name.split('-')[0]}", source="RR98 Sec. III", at_most=10,
            value=triangles_cost(name), because="an order of magnitude, as is asked of the vortex",
            statement="irregular points cost little: exchanges over edges for 1 % of K in Rayleigh-Benard, Ra 10 000, on "
                      f"{kind}, triangulated, over those on a lattice with its nearest neighbours")
      for name, kind in KINDS.items()),
    Claim(id="own-convection-cheapest-irregular", source="RR98 Sec. III", at_least=1, value=cheapest_triangles,
          because="triangles are the cheaper ones if the ratio is above one",
          statement="off a lattice triangles are the cheapest edges: exchanges of the cheapest 1 % of K by edges of a weight "
                    "over those by triangles on points of that kind"),
)
