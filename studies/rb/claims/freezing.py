"""Claims about freezing at high pressure    [KHP95, Secs III, IV, VII]

The eta of Fig. 4 is not printed: Ra 3000 is taken with kappa = k/(rho C_V) and eta = k, so nu/kappa = 1.5.
Pressure is added as a negative fraction of the static one that a variant subtracts, with the gravity that
balances it: the continuum does not feel it.
"""
from contextlib import suppress
from math import hypot, inf, pi
from typing import Any

import numpy as np

from studies.kit.ask import Value, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables
from studies.rb.claims.flows import ALIKE, PLAIN, alike, diverged, limit, mean, over_runs, rolls
from studies.rb.tables import grid, particles

DENSE: dict[str, Any] = {"eos": "dense"}
#: variant -> its pressure, that of the ideal gas at density and temperature 1 being 1
PRESSURES = {"more-static-400": 5.0, "more-static-100": 2.0, "printed": 1.0, "less-static-50": 0.5,
             "less-static-90": 0.1}
#: of Lucy's weight 5/(9 pi) (1 + r)(1 - r/3)^3: phi(0) = 2 P n^-2 w(0), and w(0.9) - w(1)
BARRIER = 5/(9*pi)
MELTING = BARRIER*((1 + 0.9)*(1 - 0.3)**3 - 2*(1 - 1/3)**3)


def flows(ra: float, height: int = 16, variant: str = "printed", **where) -> Value:
    """K of the particles' mean flow over the grid's smoothed alike: 1 if they flow, 0 if they rattle."""
    point = particles(ra, height, variant, **where)
    return mean(point, "ke_mean")/alike(point)


def rattling(tables: Tables) -> Measured:
    """2 K(dt/2) - K(dt) of 512 particles of dense fluid, Lucy, Ra 3000, over the grid's K

    For a step that vanishes. First order is that of the turns at the plates. Nothing says that these steps
    are small enough for it, so what is extrapolated is the error, too.
    """
    names = "printed-half-step", "printed"
    half, whole = (over_runs(particles(3000, 16, name, **DENSE), "ke")(tables) for name in names)
    value = 2*half.value - whole.value
    err = hypot(2*half.err, whole.err, half.value - whole.value)
    return Measured(value, err)/limit(3000, **DENSE)(tables)


def mean_square(bracket: float, ra: float, P: float, **where) -> Value:
    """m<v^2> = 2K of the grid over 2 P n^-2 times a difference of w."""
    return limit(ra, **where)/(P*bracket)


def largest_square(bracket: float) -> Value:
    """The largest m v^2 of the particles at Ra 10 000, ideal gas, over 2 P n^-2 times a difference of w."""
    return one("snapshots", "fastest", **particles(1e4))/(2*bracket)


def kept(variant: str) -> Value:
    """Kg of 5000 particles over that of the grid smoothed alike, Ra 5000."""
    point = particles(5e3, variant=variant)
    return mean(point, "ke_field")/alike(point)


def threshold(tables: Tables) -> Measured:
    """m<v^2> of the grid over 2 P n^-2 [w(0.9) - w(1)] where Kg is half of the grid's, Ra 5000."""
    left: dict[str, float] = {}
    for name in PRESSURES:
        with suppress(CannotTell):
            left[name] = kept(name)(tables).value
    x = np.array([mean_square(MELTING, 5e3, PRESSURES[name])(tables).value for name in left])
    y = np.array([*left.values()])
    if len(x) < 3 or not y.min() < 0.5 < y.max():
        raise CannotTell("the particles' K does not fall to half of the grid's at the pressures that were "
                         "run: the more-static variants of SIZE=fine are to reach it")
    here = int(np.argmax(y >= 0.5))
    if here == 0 or (y[here:] < 0.5).any():
        raise CannotTell("the particles' K crosses half of the grid's more than once: no threshold")
    middle = float(np.interp(0.5, y[here - 1:here + 1], np.log(x[here - 1:here + 1])))
    return Measured(float(np.exp(middle)), float(x[here] - x[here - 1])/2)


def no_trouble(tables: Tables) -> Measured:
    """Mean K over the second half of dense runs over its maximum before; inf if one diverged."""
    point = particles(3000, 16, **DENSE)
    if diverged(tables, point).any():
        return Measured(inf)
    frame = rows(tables, "history", **point)
    late = frame["t"] > frame["t"].max()/2
    return Measured(float(frame[late]["ke"].mean()/frame[~late]["ke"].max()))


def sites(variant: str) -> Value:
    """Particles a site at the end of dense runs at Ra 3000."""
    return one("snapshots", "occupancy", **particles(3000, 16, variant, **DENSE))


FROZEN = f'"frozen" is a tenth of the energy that the grid has, {ALIKE}'
FLOWING = f'"a good description" is half of the energy at least, {ALIKE}'
CLAIMS = (
    Claim(id="khp95-freeze-monaghan", source="KHP95 Fig. 4", printed="freezing", at_most=0.1, because=FROZEN,
          headline=True,
          statement="512 particles of dense fluid, Monaghan, Ra 3000, freeze: K of their mean flow over the "
                    "grid's", value=flows(3000, variant="printed-monaghan", **DENSE)),
    Claim(id="khp95-freeze-lucy", source="KHP95 Fig. 4", printed="similar results", at_most=0.1,
          headline=True,
          because=FROZEN,
          statement="512 particles of dense fluid, Lucy, Ra 3000, freeze: K of their mean flow over the "
                    "grid's", value=flows(3000, **DENSE)),
    Claim(id="khp95-freeze-static", source="KHP95 Secs III, IV, Fig. 4", printed="static", at_most=0.1,
          statement="frozen particles of dense fluid, Lucy, Ra 3000, are static: kinetic energy of the "
                    "particles, their rattling included, over the grid's K, extrapolated to a time step of "
                    "zero", value=of(rattling),
          because=f'"static" is a tenth of the energy that the grid has, {PLAIN}; most of it is an error '
                  "of the step"),
    Claim(id="khp95-freeze-grid", source="KHP95 Fig. 4", printed="two rolls", expect=2, within=0,
          headline=True,
          because="a whole number", statement="the grid finds two rolls of the dense fluid at Ra 3000",
          value=rolls(grid(3000, **DENSE))),
    Claim(id="khp95-freeze-grid-flows", source="KHP95 Sec. IV, Fig. 4", printed="convecting", at_least=10,
          statement="the grid easily gives convecting flows of the dense fluid at Ra 3000: K over its error",
          value=one("means", "ke/ke_err", err="0", **grid(3000, **DENSE)),
          because="ten errors away from rest"),
    Claim(id="khp95-freeze-not-ideal", source="KHP95 Sec. IV", printed="good description", at_least=0.5,
          because=FLOWING,
          statement="the ideal gas does not freeze under the conditions of Fig. 4: K of its mean flow over "
                    "the grid's", value=flows(3000)),
    Claim(id="khp95-freeze-not-vdw", source="KHP95 Sec. IV", printed="good description", at_least=0.5,
          because=FLOWING,
          statement="the van der Waals fluid does not freeze under the conditions of Fig. 4: K of its mean "
                    "flow over the grid's", value=flows(3000, eos="vdw")),
    Claim(id="khp95-freeze-lucy-sites", source="KHP95 Sec. IV", printed="one", expect=1, within=0,
          because="a whole number",
          statement="frozen states of Lucy's weight have one particle a site, in the run",
          value=sites("printed")),
    Claim(id="khp95-freeze-monaghan-sites", source="KHP95 Sec. IV, Fig. 4", printed="two", expect=2, within=0,
          statement="frozen states of Monaghan's weight have two particles a site, in the run",
          value=sites("printed-monaghan"), because="a whole number"),
    Claim(id="khp95-freeze-pressure", source="KHP95 Secs III, IV", printed="does affect", at_most=0.5,
          value=mean(particles(5e3, variant="more-static-400"), "ke_field")/mean(particles(5e3), "ke_field"),
          statement="pressure that the continuum does not feel slows particles down: K at Ra 5000 with five "
                    "times the static pressure over K as printed",
          because='"does affect" has no number: half; on the grid it is exactly 1'),
    Claim(id="khp95-freeze-range", source="KHP95 Sec. III", printed="vanish", at_least=0.9,
          statement="freezing vanishes as the range of the weight grows: K of the dense fluid at Ra 3000 "
                    "with h = 6 over the grid's", value=flows(3000, variant="range-6", **DENSE),
          because=f"10 % is the paper's error of K; {ALIKE}"),
    Claim(id="khp95-barrier-rule", source="KHP95 Sec. IV", at_least=1,
          statement="where particles flow their typical energy exceeds the barrier: 2K of the ideal gas at "
                    "Ra 10 000 over 2 P n^-2 w(0)", value=mean_square(BARRIER, 1e4, 1.0),
          because="the printed inequality"),
    Claim(id="khp95-barrier-rule-largest", source="KHP95 Sec. IV", at_least=1,
          statement="where particles flow the energy of the fastest exceeds the barrier: largest v^2 of the "
                    "ideal gas at Ra 10 000 over 2 P n^-2 w(0)", value=largest_square(BARRIER),
          because="the printed inequality"),
    Claim(id="khp95-melting-rule", source="KHP95 Sec. IV", printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]", at_least=1,
          statement="where particles flow m<v^2> exceeds the melting criterion: 2K of the ideal gas at Ra "
                    "10 000", value=mean_square(MELTING, 1e4, 1.0), because="the printed inequality"),
    Claim(id="khp95-melting-rule-largest", source="KHP95 Sec. IV", printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]",
          at_least=1,
          statement="where particles flow m v^2 of the fastest exceeds the melting criterion: ideal gas at "
                    "Ra 10 000", value=largest_square(MELTING), because="the printed inequality"),
    Claim(id="khp95-melting-rule-frozen", source="KHP95 Sec. IV", printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]",
          at_most=1,
          statement="where particles freeze m<v^2> is below the melting criterion: 2K of the grid, dense "
                    "fluid at Ra 3000, P = 5", value=mean_square(MELTING, 3000, 5.0, **DENSE),
          because="the printed inequality"),
    Claim(id="khp95-melting-threshold", source="KHP95 Sec. IV", printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]",
          headline=True, evidence="rb/variants.png",
          at_least=0.5, at_most=2,
          statement="the criterion tells where freezing begins: its ratio for the grid's <v^2> where "
                    "particles keep half of K", value=of(threshold),
          because=f"a criterion from a rule of thumb is good to a factor of two at best; half of K {ALIKE}"),
    Claim(id="khp95-newtonian-trajectories", source="KHP95 Sec. VII", printed="essentially Newtonian",
          at_least=0.9,
          statement="particles move as molecules of potential 2 P n^-2 w: correlation of accelerations, "
                    "less their means over layers, which bear the weight of the fluid, Ra 10 000, ideal gas",
          value=one("snapshots", "newtonian", **particles(1e4)),
          because='"essentially" has no number: four fifths of the mean square'),
    Claim(id="khp95-subsonic", source="KHP95 Sec. VII", printed="v^2 << c^2", at_most=0.5,
          statement="high-pressure subsonic problems cannot be solved reliably: K of the mean flow over the "
                    "grid's, dense fluid, P = 5, Ra 3000", value=flows(3000, **DENSE),
          because=f"unreliable is half of the energy lost, {ALIKE}"),
    Claim(id="khp95-subsonic-ideal", source="KHP95 Secs IV, VII", printed="good description", at_least=0.5,
          statement="at low pressure particles describe a subsonic flow well: K of the mean flow over the "
                    "grid's, ideal gas, P = 1, Ra 10 000", value=flows(1e4, 50), because=FLOWING),
    Claim(id="khp95-subsonic-vdw", source="KHP95 Secs IV, VII", printed="good description", at_least=0.5,
          statement="at low pressure particles describe a subsonic flow well: K of the mean flow over the "
                    "grid's, van der Waals, P = 1.5, Ra 10 000", value=flows(1e4, 50, eos="vdw"),
          because=FLOWING),
    Claim(id="khp95-dense-no-trouble", source="KHP95 Sec. IV", printed="no apparent trouble", at_most=1,
          statement="the inconsistent dense fluid causes particles no trouble: late K over the largest K "
                    "before, Ra 3000", value=of(no_trouble), because="what diverges exceeds its past"),
)
