"""What RR98 says of transport in the discretized equations, judged    [RR98 Eqs 34-38, 51]"""
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from continuum.exact.waves import Gas, quantities
from particles.weights import Lucy
from studies.build.read import Value, exact, select
from studies.build.symbols import lattice_waves
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

LATTICE: dict[str, Any] = {"maker": "renormalised", "weight": "Lucy", "h": 3.0, "points": "lattice", "direction": "axis"}
IRREGULAR: dict[str, Any] = {"maker": "delaunay", "weight": "Lucy", "h": 3.0, "points": "jittered-0.3", "direction": "axis"}
NESTED: dict[str, Any] = {"transport": "nested", "zeta": 0.2}
PAIRWISE: dict[str, Any] = {"transport": "pairwise", "zeta": 0.2}
COEFFICIENTS = ("viscosity", "bulk viscosity", "conductivity", "sound speed")


def symbol(transport: str) -> Value:
    """Largest |measured less symbol|, over the continuum's value, of all waves on lattices; the error of that one."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "coefficients", points="lattice", transport=transport)
        worst = rows.sort_values("from_lattice", key=np.abs).iloc[-1]
        return Measured(abs(float(worst["from_lattice"])), float(worst["error_err"]))
    return value


def order(quantity: str, **where) -> Value:
    """Order of an error in 1/wavelength."""
    return told("order", quantity, **where)


def told(column: str, quantity: str, **where) -> Value:
    """A column of `orders` with its error."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "transport_orders", quantity=quantity, **where).iloc[0]
        if np.isnan(row[column]):
            raise CannotTell(f"not run yet: {column} of the {quantity} needs three wavelengths of 16 spacings and more")
        return Measured(float(row[column]), float(row[f"{column}_err"]))
    return value


def farthest(quantities: tuple[str, ...], **where) -> Value:
    """Largest |error| for endless waves among some quantities."""
    def value(tables: Tables) -> Measured:
        found = [told("long", quantity, **where)(tables) for quantity in quantities]
        return Measured(max(abs(one.value) for one in found), max(one.err for one in found))
    return value


def apart(tables: Tables) -> Measured:
    """Bulk viscosity for endless waves along a diagonal less that along an axis, over the continuum's; Eq. 51 on the lattice."""
    one, other = (told("long", "bulk viscosity", **{**LATTICE, **PAIRWISE, "direction": way})(tables)
                  for way in ("diagonal", "axis"))
    return Measured(abs(one.value - other.value), one.err + other.err)


def identified(maker: str) -> Value:
    """Largest relative difference between viscosities put in and measured, longest waves on points jittered by 0.3 a; Eq. 51."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "coefficients", **{**IRREGULAR, "maker": maker}, **PAIRWISE)
        rows = longest(rows[rows["quantity"].isin(["viscosity", "bulk viscosity"])])
        return Measured(float(rows["error"].abs().max()), float(rows["error_err"].max()))
    return value


def anisotropy(h: float) -> float:
    """Largest relative error of the two viscosities of forces along edges, waves of 5000 a along an axis, by the symbol."""
    k, gas = 2*np.pi/5000, Gas(0.3, 0.2, 0.4)
    found = quantities(lattice_waves(gas, Lucy.of(h=h), np.array([k, 0.0]), nested=False), k)
    return max(abs(found["viscosity"]/gas.eta - 1), abs(found["bulk viscosity"]/gas.zeta - 1))


def longest(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of the longest wave."""
    return rows[rows["wavelength"] == rows["wavelength"].max()]


def shear_order(flow: str, points: str, norm: str = "rms") -> Value:
    """Order of an error in 1/rows at 0.1 height^2/nu."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "shear_orders", flow=flow, points=points, time=0.1, norm=norm).iloc[0]
        return Measured(float(row["order"]), float(row["order_err"]))
    return value


def neglected(column: str) -> Callable[[Tables], Measured]:
    """The largest of what the series leave out, on lattices."""
    return lambda tables: Measured(float(select(tables, "shear", points="lattice")[column].max()), 0.0)


SECOND = "second order; the next one, (h/lambda)^4, changes slopes over 16 to 64 spacings by 0.02"
CLAIMS = (
    Claim(id="rr98-transport-symbol-nested", source="RR98 Eqs 34-38", at_most=1e-4, value=symbol("nested"),
          statement="waves on a lattice with nested transport: viscosities, conductivity, speed and damping of sound and decay "
                    "of heat measured in time are those of the lattice symbol, largest relative difference",
          because="four digits; time steps leave 4e-6"),
    Claim(id="rr98-transport-symbol-pairwise", source="RR98 Eq. 51", at_most=1e-4, value=symbol("pairwise"),
          statement="waves on a lattice with forces along edges: viscosities, conductivity, speed and damping of sound and decay "
                    "of heat measured in time are those of the lattice symbol, largest relative difference",
          because="four digits; time steps leave 4e-6"),
    Claim(id="rr98-transport-eq34-36-sound", source="RR98 Eqs 34-36", printed="correct up to second order", expect=2, within=0.1,
          value=order("sound speed", **LATTICE, **NESTED), because=SECOND,
          statement="the speed of sound is that of the gas but for an error of second order in 1/wavelength: order on a lattice, "
                    "h = 3 a"),
    Claim(id="rr98-transport-eq37-viscosity", source="RR98 Eq. 37", printed="eta", expect=2, within=0.1, because=SECOND,
          value=order("viscosity", **LATTICE, **NESTED),
          statement="eta of Eq. 37 is the shear viscosity but for an error of second order: order on a lattice, h = 3 a"),
    Claim(id="rr98-transport-eq37-bulk", source="RR98 Eq. 37", printed="zeta", expect=2, within=0.1, because=SECOND,
          value=order("bulk viscosity", **LATTICE, **NESTED),
          statement="zeta of Eq. 37, with 2/d in place of 2/3, is the bulk viscosity but for an error of second order: order on "
                    "a lattice, h = 3 a"),
    Claim(id="rr98-transport-eq38-conductivity", source="RR98 Eq. 38", printed="kappa", expect=2, within=0.1, because=SECOND,
          value=order("conductivity", **LATTICE, **NESTED),
          statement="kappa of Eq. 38 is the conductivity but for an error of second order: order on a lattice, h = 3 a"),
    Claim(id="rr98-transport-eq37-38-limit", source="RR98 Eqs 34-38", printed="unambiguously identified", at_most=1e-3,
          value=farthest(COEFFICIENTS, **LATTICE, **NESTED), because="what waves of 48 and 64 spacings extrapolate to",
          statement="all coefficients of nested transport are those put in: largest relative difference for endless waves on a "
                    "lattice, h = 3 a"),
    Claim(id="rr98-transport-eq51-identified", source="RR98 Eq. 51", printed="cannot independently identify", at_least=0.1,
          value=identified("exact"), because="a tenth would be no identification",
          statement="the two viscosities of forces along edges cannot be identified one by one: largest relative difference "
                    "between those put in by A, B of eta, zeta and those measured, edges of a weight, h = 3 a, on points "
                    "jittered by 0.3 a, waves of 32 a"),
    Claim(id="rr98-transport-eq51-delaunay", source="RR98 Eq. 51", at_most=0.1, value=identified("delaunay"),
          statement="the two viscosities of forces along Delaunay edges are those put in: largest relative difference, points "
                    "jittered by 0.3 a, waves of 32 a",
          because="a tenth; six edges a point are no average over directions, as Eq. 51 takes with zeta > 0"),
    Claim(id="rr98-transport-eq51-eq45", source="RR98 Eq. 45", printed="(dV)^(1/3) < r0", at_most=0.01,
          value=exact(lambda: anisotropy(8.0)), because="1 %",
          statement="with many points in the range of the weight, h = 8 a, forces along edges with zeta > 0 have the viscosities "
                    "put in: largest relative error for endless waves along an axis of a lattice, by its symbol"),
    Claim(id="rr98-transport-eq51-long-h2", source="RR98 Eq. 51", at_most=0.01,
          value=farthest(("viscosity", "bulk viscosity"), **{**LATTICE, "h": 2.0}, **PAIRWISE),
          statement="forces along edges with zeta > 0 give lap v and grad div v for endless waves: largest relative error of the "
                    "two viscosities, lattice, waves along an axis, h = 2 a",
          because="1 %; sums of W x^4/r^3 over few neighbours are not averages over directions, however long the wave"),
    Claim(id="rr98-transport-eq51-long-h3", source="RR98 Eq. 51", at_most=0.01,
          value=farthest(("viscosity", "bulk viscosity"), **LATTICE, **PAIRWISE),
          statement="forces along edges with zeta > 0 give lap v and grad div v for endless waves: largest relative error of the "
                    "two viscosities, lattice, waves along an axis, h = 3 a",
          because="1 %; sums of W x^4/r^3 over few neighbours are not averages over directions, however long the wave"),
    Claim(id="rr98-transport-eq51-isotropic", source="RR98 Eq. 51", at_most=0.01, value=apart,
          statement="the bulk viscosity of forces along edges is the same along an axis and along a diagonal of the lattice: "
                    "difference for endless waves over zeta, h = 3 a", because="1 %"),
    Claim(id="rr98-transport-eq51-shear", source="RR98 Eq. 51", expect=2, within=0.1, because=SECOND,
          value=order("viscosity", **LATTICE, transport="pairwise", zeta=0.0),
          statement="without bulk viscosity forces along edges give eta lap v in 2D with an error of second order: order on a "
                    "lattice, h = 3 a"),
    Claim(id="rr98-transport-irregular-sound", source="RR98 Sec. III", at_most=0.01,
          value=farthest(("sound speed",), **IRREGULAR, **NESTED), because="1 %",
          statement="on points jittered by 0.3 a with Delaunay edges the speed of sound is right for endless waves: relative "
                    "difference"),
    Claim(id="rr98-transport-irregular-nested", source="RR98 Eqs 37, 38", at_most=0.01,
          value=farthest(("viscosity", "conductivity"), **IRREGULAR, **NESTED), because="1 %",
          statement="on points jittered by 0.3 a with Delaunay edges nested transport has the viscosity and the conductivity put "
                    "in for endless waves: largest relative difference"),
    Claim(id="rr98-transport-irregular-delaunay", source="RR98 Eq. 51", expect=2, within=0.2, because="second order",
          value=order("conductivity", **IRREGULAR, transport="pairwise", zeta=0.0),
          statement="heat along Delaunay edges on points jittered by 0.3 a: order of the conductivity's error in 1/wavelength"),
    Claim(id="rr98-transport-irregular-exact", source="RR98 Eq. 51", expect=2, within=0.2, because="second order",
          value=order("conductivity", **{**IRREGULAR, "maker": "exact"}, transport="pairwise", zeta=0.0),
          statement="heat along edges of a weight, made exact on linear fields, h = 3 a, on points jittered by 0.3 a: order of "
                    "the conductivity's error in 1/wavelength"),
    Claim(id="rr98-transport-couette", source="RR98 Sec. III A", printed="a host of procedures", expect=2, within=0.1,
          value=shear_order("couette", "lattice"), because="second order; 8 rows are worth 0.03",
          statement="Couette flow from rest between mirror plates on a lattice, forces along edges: order of its rms error in "
                    "1/rows at 0.1 H^2/nu"),
    Claim(id="rr98-transport-poiseuille", source="RR98 Sec. III A", printed="a host of procedures", expect=2, within=0.1,
          value=shear_order("poiseuille", "lattice"), because="second order; 8 rows are worth 0.03",
          statement="Poiseuille flow from rest between mirror plates on a lattice, forces along edges: order of its rms error in "
                    "1/rows at 0.1 H^2/nu"),
    *(Claim(id=f"rr98-transport-{flow}-jittered{short}", source="RR98 Sec. III A", expect=2, within=0.1,
            value=shear_order(flow, f"jittered-0.2{points}", norm), because="second order, as on the lattice",
            statement=f"{flow.capitalize()} flow from rest between {words} on points jittered by 0.2 a, Delaunay edges: order of "
                      f"its {norm} error in 1/rows at 0.1 H^2/nu")
      for flow, (short, points, words, norm) in product(("couette", "poiseuille"), (
          ("", "", "mirror plates", "largest"), ("-plates-largest", ", plates", "rows of held points", "largest"),
          ("-plates", ", plates", "rows of held points", "rms")))),
    Claim(id="rr98-transport-neglected", source="RR98 Sec. III A", at_most=1e-6, value=neglected("heating"),
          statement="viscous heating in these shear flows, which their series leave out: largest |T - 1|",
          because="speeds of 1e-3: its square"),
)
