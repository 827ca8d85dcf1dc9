"""Dissipative particles, judged    [RR98, Secs III A, III B; Groot & Warren 1997]"""
from math import hypot

import pandas as pd

from continuum.published import published
from studies.build.read import Value, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.noise.dpd.derive import GAMMA, MIXED, RHO, STILL

GOOD = {"GrootWarren": "Groot-Warren with lambda = 1/2", "GrootWarren65": "Groot-Warren with lambda = 0.65",
        "VelocityVerlet": "velocity-Verlet with friction evaluated again", "Shardlow": "Shardlow's splitting"}
#: kT, rho, a of each printed pressure
PRINTED = {"shardlow-2": (1.0, 2.0, 37.5), "shardlow-3": (1.0, 3.0, 25.0), "shardlow-4": (1.0, 4.0, 18.75),
           "shardlow-5": (1.0, 5.0, 15.0), "shardlow-cold": (0.5, 3.0, 12.5)}


def largest(tables: Tables, table: str, **where) -> pd.Series:
    """The row of the most particles, where the table counts them."""
    rows = select(tables, table, **where)
    return rows.sort_values("n").iloc[-1] if "n" in rows else rows.iloc[0]


def of(table: str, column: str, **where) -> Value:
    """A number and its error."""
    def value(tables: Tables) -> Measured:
        row = largest(tables, table, **where)
        found = Measured(float(row[column]), float(row.get(f"{column}_err", 0.0)))
        if found.value != found.value:
            raise CannotTell(f"table {table}: too few steps have a {column} that is no chance")
        return found
    return value


def error_of(integrator: str, temperature: str, dt: float = 0.02) -> Value:
    """|kT - 1| of one integrator and step."""
    def value(tables: Tables) -> Measured:
        row = largest(tables, "states", integrator=integrator, dt=dt, a=25.0, rho=RHO, d=3, kT=1.0, noise="Uniform")
        return Measured(abs(float(row[temperature] - 1)), float(row[f"{temperature}_err"]))
    return value


def worst(temperature: str) -> Value:
    """The largest |kT - 1| of the good integrators at dt = 0.02."""
    return lambda tables: max((error_of(integrator, temperature)(tables) for integrator in GOOD), key=lambda one: one.value)


def within_a_percent(integrator: str, temperature: str) -> Claim:
    """One of the good integrators at dt = 0.02."""
    return Claim(id=f"own-dpd-{temperature}-{integrator.lower()}", source="Groot & Warren 1997", printed="dt = 0.04 to 0.06",
                 at_most=0.01, value=error_of(integrator, temperature),
                 statement=f"{GOOD[integrator]} keeps the {temperature} kT within 1 % at dt = 0.02: |error|",
                 because="1 % is what the paper wants of a step of good integrators")


def difference(columns: tuple[str, str], **where) -> Value:
    """One column less another."""
    def value(tables: Tables) -> Measured:
        row = largest(tables, "states", **where)
        return Measured(float(row[columns[0]] - row[columns[1]]), hypot(*(row[f"{name}_err"] for name in columns)))
    return value


def from_print(tables: Tables) -> Measured:
    """The largest relative difference from a printed pressure, and its error."""
    found = []
    for name, (kT, rho, a) in PRINTED.items():
        row, print_ = select(tables, "excess", a=a, kT=kT, rho=rho).iloc[0], published(f"dpd-pressure-{name}")
        found.append(Measured(abs(row["P"]/print_.value - 1), hypot(row["P_err"], 1.96*print_.uncertainty)/print_.value))
    return max(found)


def drift(tables: Tables) -> Measured:
    """The largest mean velocity of any run."""
    return Measured(float(select(tables, "states")["drift"].max()), 0.0)


def of_hundred(tables: Tables) -> Measured:
    """Pressure of 100 particles."""
    row = select(tables, "states", n=100).iloc[0]
    return Measured(float(row["P"]), float(row["P_err"]))


def of_noise(tables: Tables) -> Measured:
    """kT with normal noise less kT with uniform noise, the rest being equal."""
    normal = select(tables, "states", noise="Normal").iloc[0]
    uniform = select(tables, "states", noise="Uniform",
                     **{name: normal[name] for name in ("integrator", "dt", "a", "kT", "rho", "d", "side")}).iloc[0]
    return Measured(float(normal["kinetic"] - uniform["kinetic"]), hypot(normal["kinetic_err"], uniform["kinetic_err"]))


def ratio(column: str, theory: float, table: str, **where) -> Value:
    """Measured over theory."""
    def value(tables: Tables) -> Measured:
        found = of(table, column, **where)(tables)
        return Measured(found.value/theory, found.err/theory)
    return value


DIFFUSION = published("dpd-diffusion").value/(GAMMA*RHO)
VISCOSITY = RHO*DIFFUSION/2 + published("dpd-friction-viscosity").value*GAMMA*RHO**2
CLAIMS = (
    *(Claim(id=f"{name}-two-step-dpd-order{short}", source="RR98 Eqs 40, 41", expect=1, within=0.1,
            value=of("errors", column, integrator="TwoStep", a=a, temperature="kinetic"),
            statement=f"the step of Eqs 40, 41 includes the fluctuations: order in dt of the error of kT, {words}",
            because="0.1 parts first from second order; the quadratic part is a tenth of the linear one at these steps")
      for name, short, column, a, words in (
          ("rr98", "", "order", 25.0, "a = 25"), ("rr98", "-gas", "order", 0.0, "without repulsion"),
          ("own", "-gas-short", "short_order", 0.0, "without repulsion, the three shortest steps, chosen after all of them"))),
    *(Claim(id=f"rr98-two-step-dpd-{name}", source="RR98 Eqs 40, 41", expect=STILL, within=0.05*STILL,
            value=of("errors", "linear", integrator="TwoStep", a=a, temperature="kinetic"),
            statement=f"relative error of kT over dt, for small steps {words}, is half of a particle's rate of friction, (rho "
                      "gamma/2d) int w^2 dV, as for points that stand still",
            because="5 %: the integral is over points without order")
      for name, a, words in (("fluid", 25.0, "at a = 25"), ("still", 0.0, "without repulsion"))),
    Claim(id="rr98-two-step-dpd-mixed", source="RR98 Eqs 40, 41", at_least=STILL, at_most=MIXED,
          value=of("errors", "linear", integrator="TwoStep", a=0.0, temperature="kinetic"),
          statement="relative error of kT over dt, for small steps without repulsion, lies between that of points that stand "
                    "still and that of points that mix at once, <Lambda^2>/(2 <Lambda>)",
          because="both limits of forward friction with points without order, 0.94 and 2.23"),
    Claim(id="rr98-two-step-dpd-percent", source="RR98 Eqs 40, 41", at_most=0.01,
          value=error_of("TwoStep", "kinetic"),
          statement="Eqs 40, 41 keep kT of dissipative particles at a = 25 within 1 % at dt = 0.02",
          because="1 % is what the paper wants of a step of good integrators"),
    *(Claim(id=f"own-dpd-{temperature}", source="Groot & Warren 1997", printed="dt = 0.04 to 0.06", at_most=0.01,
            value=worst(temperature), because="1 % is what the paper wants of a step of good integrators",
            statement="Groot-Warren with lambda 1/2 and 0.65, velocity-Verlet with friction evaluated again and splitting: the "
                      f"largest |error| of the {temperature} kT at dt = 0.02") for temperature in ("kinetic", "configurational")),
    *(within_a_percent(integrator, temperature) for integrator in GOOD for temperature in ("kinetic", "configurational")),
    Claim(id="own-dpd-flattered", source="Groot & Warren 1997", printed="lambda = 0.65", at_least=0.0,
          value=difference(("configurational", "kinetic"), integrator="GrootWarren65", dt=0.06, a=25.0, d=3, kT=1.0),
          statement="lambda = 0.65 keeps the kinetic kT better than that of the positions: configurational less kinetic kT at "
                    "dt = 0.06", because="any difference of this sign"),
    Claim(id="own-dpd-pressure", source="Allen & Tildesley 2017, example dpd", printed="23.635 to 23.637", expect=23.64,
          within=0.02, value=of("excess", "P", a=25.0, kT=1.0, rho=3.0),
          statement="pressure of dissipative particles at a = 25, rho = 3, kT = 1", because="0.1 %"),
    Claim(id="own-dpd-pressure-100", source="Allen & Tildesley 2017, example dpd", printed="23.635 to 23.637", expect=23.636,
          within=0.02, value=of_hundred,
          statement="pressure of the 100 particles that print has, a = 25, rho = 3, kT = 1, dt = 0.02", because="0.1 %"),
    Claim(id="own-dpd-pressures", source="Allen & Tildesley 2017, example dpd", printed="5 states", at_most=0.002,
          value=from_print,
          statement="largest relative difference from printed pressures at rho = 2 to 5, a = 75 kT/rho, kT = 0.5 and 1, the time "
                    "at rho = 2 raised from 60 to 240 because that left it open",
          because="0.2 %: errors of dt^2 at their steps and ours"),
    Claim(id="own-dpd-alpha-3", source="Groot & Warren 1997", printed="0.101 +- 0.001", expect=0.101, within=0.001,
          value=of("excess", "alpha", a=25.0, kT=1.0, rho=3.0),
          statement="P = rho kT + alpha a rho^2 with alpha = 0.101 at the density that is most used, rho = 3, a = 25",
          because="the printed uncertainty"),
    Claim(id="own-dpd-alpha-8", source="Groot & Warren 1997", printed="0.101 +- 0.001", expect=0.101, within=0.001,
          value=of("excess", "alpha", a=25.0, kT=1.0, rho=8.0),
          statement="P = rho kT + alpha a rho^2 with alpha = 0.101 in a dense fluid, rho = 8, a = 25",
          because="the printed uncertainty"),
    Claim(id="own-dpd-compression", source="RR98 Sec. III B", expect=1, within=0.05,
          value=of("compression", "product", a=25.0),
          statement="fluctuations of density are those of the equation of state: S(0) dP/drho / kT at a = 25, rho = 3, the time "
                    "raised from 300 to 1200 because that left it open",
          because="5 %: what chance leaves of long waves, twice"),
    Claim(id="own-dpd-noise", source="Groot & Warren 1997", expect=0, within=0.005, value=of_noise,
          statement="uniform numbers of unit variance serve as well as normal ones: kT with normal less kT with uniform numbers, "
                    "lambda = 0.65, dt = 0.04", because="half of 1 %"),
    Claim(id="rr98-dpd-momentum", source="RR98 Sec. III B", at_most=1e-12, value=drift,
          statement="with ij-symmetrised forms the conservation laws are guaranteed: largest mean velocity of dissipative "
                    "particles in any run", because="round-off of up to 30 000 steps of forces of 100"),
    Claim(id="own-dpd-diffusion-gas", source="Groot & Warren 1997", printed="45 kT/(2 pi gamma rho rc^3) = 0.5305", expect=1,
          within=0.1, value=ratio("D", DIFFUSION, "states", integrator="Shardlow", a=0.0, d=3),
          statement="self-diffusion without repulsion over kinetic theory, gamma = 4.5, rho = 3",
          because="10 %: the theory leaves out that friction is with neighbours that are dragged along"),
    Claim(id="own-dpd-diffusion", source="Groot & Warren 1997", printed="45 kT/(2 pi gamma rho rc^3) = 0.5305", expect=1,
          within=0.1, value=ratio("D", DIFFUSION, "states", integrator="Shardlow", a=25.0, rho=3.0, dt=0.02, d=3),
          statement="self-diffusion at a = 25 over kinetic theory without repulsion", because="10 %, as without repulsion"),
    Claim(id="own-dpd-viscosity-gas", source="Groot & Warren 1997", printed="0.957", expect=1, within=0.1,
          value=ratio("viscosity", VISCOSITY, "dpd_shear", a=0.0, rate=0.2),
          statement="viscosity without repulsion, in shear at rate 0.2, over kinetic theory, rho D/2 + 2 pi gamma rho^2/1575",
          because="10 %, as the theory's diffusion"),
    Claim(id="own-dpd-viscosity", source="Groot & Warren 1997", printed="0.957", expect=1, within=0.1,
          value=ratio("viscosity", VISCOSITY, "dpd_shear", a=25.0, rate=0.2),
          statement="viscosity at a = 25, in shear at rate 0.2, over kinetic theory without repulsion, the time raised from 100 "
                    "to 300 because that left it open", because="10 %, as without repulsion"),
)
