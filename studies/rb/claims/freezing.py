"""Claims about particles that stop: at high pressure, and at Ra 2500    [KHP95, Secs III, IV, VI, VII]

The eta of Fig. 4 is not printed: Ra 3000 is taken with kappa = k/(rho C_V) and eta = k, so nu/kappa = 1.5.
Pressure is added as a negative fraction of the static one that a variant subtracts, with the gravity that
balances it: the continuum does not feel it. The paper does not say from what its runs at Ra 2500 started:
judged is the start that leaves them more flow.
"""
from contextlib import suppress
from functools import partial
from math import inf
from typing import Any

import numpy as np

from studies.build.spam import STEPS
from studies.kit import fits
from studies.kit.ask import Value, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured, over_seeds
from studies.kit.table import Tables
from studies.rb.claims.questions import (
    ALIKE,
    PLAIN,
    against_alike,
    alike,
    diverged,
    limit,
    mean,
    over_runs,
    rolls,
    said,
)
from studies.rb.runs.few_particles import LUCY
from studies.rb.tables import Point, grid, particles

DENSE: dict[str, Any] = {"eos": "dense"}
#: variant -> its pressure, that of the ideal gas at density and temperature 1 being 1
PRESSURES = {"more-static-400": 5.0, "more-static-100": 2.0, "printed": 1.0, "less-static-50": 0.5,
             "less-static-90": 0.1}
MELTING = LUCY(0.9) - LUCY(1.0)


def flows(ra: float, height: int = 16, variant: str = "printed", **where) -> Value:
    """K of the particles' mean flow over the grid's smoothed alike: 1 if they flow, 0 if they rattle."""
    point = particles(ra, height, variant, **where)
    return mean(point, "ke_mean")/alike(point)


def rattling(tables: Tables) -> Measured:
    """K of 512 particles of dense fluid, Lucy, Ra 3000, over the grid's K: c_0 of c_0 + c_1 dt + c_2 dt^2

    For a step that vanishes, through runs of five steps, each half of the one before. First order is that of
    the turns at the plates.
    """
    names = ("printed", "printed-half-step", *STEPS)
    runs = rows(tables, "kinetic_energy", need=15, **particles(3000, 16, names, **DENSE))
    known = fits.polynomial(runs.dt, runs.ke, 2, weight=1/runs.ke_err, err=runs.ke_err)
    return known.intercept/limit(3000, **DENSE)(tables)


def mean_square(ra: float, P: float, **where) -> Value:
    """m<v^2> = 2K of the grid over 2 P n^-2 [w(0.9) - w(1)]."""
    return limit(ra, **where)/(P*MELTING)


def threshold(tables: Tables) -> Measured:
    """m<v^2> of the grid over 2 P n^-2 [w(0.9) - w(1)] where Kg is half of the grid's, Ra 5000."""
    ratios, left = list[float](), list[float]()
    for name, P in PRESSURES.items():
        point, ratio = particles(5e3, variant=name), mean_square(5e3, P)(tables)
        with suppress(CannotTell):
            left.append((mean(point, "ke_field")/alike(point))(tables).value)
            ratios.append(ratio.value)
    if len(left) < 3 or not min(left) < 0.5 < max(left):
        raise CannotTell("the particles' K does not fall to half of the grid's at the pressures that were "
                         "run: the more-static variants of SIZE=fine are to reach it")
    half = np.array(left) >= 0.5
    here = int(half.argmax())
    if here == 0 or not half[here:].all():
        raise CannotTell("the particles' K crosses half of the grid's more than once: no threshold")
    pair = slice(here - 1, here + 1)
    middle = np.exp(np.interp(0.5, left[pair], np.log(ratios[pair])))
    return Measured(middle, np.ptp(ratios[pair])/2)


def no_trouble(tables: Tables) -> Measured:
    """Mean K over the second half of a dense run over its maximum before, over seeds; inf if one diverged."""
    point = particles(3000, 16, **DENSE)
    if diverged(tables, point).any():
        return Measured(inf)
    frame = rows(tables, "history", **point)
    late = frame.t > frame.t.max()/2
    return over_seeds(frame[late].groupby("seed").ke.mean()/frame[~late].groupby("seed").ke.max())


def fastest(tables: Tables) -> Measured:
    """m v^2 of the fastest particle over 2 P n^-2 [w(0.9) - w(1)], of several seeds or moments"""
    seen = one("snapshots", "fastest", **particles(1e4))(tables).value/(2*MELTING)
    raise CannotTell("which particle is the fastest is chance, and one moment of one seed was kept: "
                     f"{seen:.2f} times the criterion then, without an error")


def sites(variant: str) -> Value:
    """Particles a site at the end of dense runs at Ra 3000."""
    return one("snapshots", "occupancy", **particles(3000, 16, variant, **DENSE))


def most_flow(tables: Tables) -> tuple[Point, Measured]:
    """5000 particles at Ra 2500 from weak rolls or the grid's flow, which may go on where it does not begin:
    the larger Kg, over the grid's.
    """
    points = (particles(2500, variant=name) for name in ("printed", "printed-from-flow"))
    return max(((point, against_alike(point)(tables)) for point in points), key=lambda one: one[1].value)


def settled(tables: Tables, point: Point) -> bool:
    """Whether the halves of K agree in all runs of a point that did not diverge."""
    runs = rows(tables, "kinetic_energy", "ke == ke", **point)
    return bool((runs.converged.astype(str) == "True").all())


def flow_left(tables: Tables) -> Measured:
    """Kg at Ra 2500 over the grid's smoothed alike, the larger of two starts; 0 to it if it still changes."""
    point, left = most_flow(tables)
    most = left.value + left.err
    return left if settled(tables, point) else Measured(most/2, most/2)


def noisier(tables: Tables) -> Measured:
    """Noise over Kg of 5000 particles at Ra 2500, of the start with the larger Kg, over that at Ra 10 000."""
    near, far = (over_seeds(rows(tables, "kinetic_energy", **point).ke_fluctuation.dropna())
                 / over_runs(point)(tables) for point in (most_flow(tables)[0], particles(1e4)))
    return near/far


def relative_err(tables: Tables) -> Measured:
    """Statistical error of Kg at Ra 2500, all seeds, over the grid's K; of the start with the larger Kg."""
    point, _ = most_flow(tables)
    if not settled(tables, point):
        raise CannotTell(f"{point['variant']}: K still drifts at Ra 2500, so that its error is no measure of "
                         "fluctuations")
    return Measured(over_runs(point)(tables).err/limit(2500)(tables).value)


FROZEN = f'"frozen" is a tenth of the energy that the grid has, {ALIKE}'
BOTH = "of both starts, weak rolls and the grid's flow, the one that leaves more"
WHOLE = "a whole number"
FREEZES = partial(Claim, source="KHP95 Fig. 4", headline=True, at_most=0.1, because=FROZEN)
GOOD = partial(Claim, printed="good description", at_least=0.5,
               because=f'"a good description" is half of the energy at least, {ALIKE}')
MELTS = partial(Claim, source="KHP95 Sec. IV", printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]",
                because="the printed inequality")
CLAIMS = (
    *(FREEZES(id=f"khp95-freeze-{weight.lower()}", printed=printed,
              value=flows(3000, variant=variant, **DENSE),
              statement=f"512 particles of dense fluid, {weight}, Ra 3000, freeze: K of their mean flow over "
                        "the grid's")
      for weight, variant, printed in (("Monaghan", "printed-monaghan", "freezing"),
                                       ("Lucy", "printed", "similar results"))),
    *(GOOD(id=f"khp95-freeze-not-{eos}", source="KHP95 Sec. IV", value=flows(3000, eos=eos),
           statement=f"the {words} does not freeze under the conditions of Fig. 4: K of its mean flow over "
                     "the grid's")
      for eos, words in (("ideal", "ideal gas"), ("vdw", "van der Waals fluid"))),
    *(GOOD(id=f"khp95-subsonic-{eos}", source="KHP95 Secs IV, VII", value=flows(1e4, 50, eos=eos),
           statement="at low pressure particles describe a subsonic flow well: K of the mean flow over the "
                     f"grid's, {words}, Ra 10 000")
      for eos, words in (("ideal", "ideal gas, P = 1"), ("vdw", "van der Waals, P = 1.5"))),
    *(said(f"freeze-{weight.lower()}-sites", f"Sec. IV{figure}", printed, sites(variant),
           f"frozen states of {weight}'s weight have {printed} particle{'s'*(expect > 1)} a site, in the "
           "run", WHOLE, expect=expect, within=0)
      for weight, variant, figure, printed, expect in (
          ("Lucy", "printed", "", "one", 1), ("Monaghan", "printed-monaghan", ", Fig. 4", "two", 2))),
    MELTS(id="khp95-melting-rule", value=mean_square(1e4, 1.0), at_least=1,
          statement="where particles flow m<v^2> exceeds the melting criterion: 2K of the ideal gas at Ra "
                    "10 000"),
    MELTS(id="khp95-melting-rule-largest", at_least=1, value=of(fastest),
          statement="where particles flow m v^2 of the fastest exceeds the melting criterion: ideal gas at "
                    "Ra 10 000"),
    MELTS(id="khp95-melting-rule-frozen", value=mean_square(3000, 5.0, **DENSE), at_most=1,
          statement="where particles freeze m<v^2> is below the melting criterion: 2K of the grid, dense "
                    "fluid at Ra 3000, P = 5"),
    said("freeze-static", "Secs III, IV, Fig. 4", "static", of(rattling),
         "frozen particles of dense fluid, Lucy, Ra 3000, are static: kinetic energy of the particles, "
         "their rattling included, over the grid's K, extrapolated to a time step of zero",
         f'"static" is a tenth of the energy that the grid has, {PLAIN}; most of it is an error of the step',
         at_most=0.1,
         after="steps down to an eighth had left it open; a sixteenth and more seeds were run; then a fit "
               "without weights, which one unsteady run of an eighth drew above all runs of a sixteenth"),
    said("freeze-grid", "Fig. 4", "two rolls", rolls(grid(3000, **DENSE)),
         "the grid finds two rolls of the dense fluid at Ra 3000", WHOLE, expect=2, within=0, headline=True),
    said("freeze-grid-flows", "Sec. IV, Fig. 4", "convecting",
         one("means", "ke/ke_err", err="0", **grid(3000, **DENSE)),
         "the grid easily gives convecting flows of the dense fluid at Ra 3000: K over its error",
         "ten errors away from rest", at_least=10),
    said("freeze-pressure", "Secs III, IV", "does affect",
         mean(particles(5e3, variant="more-static-400"), "ke_field")/mean(particles(5e3), "ke_field"),
         "pressure that the continuum does not feel slows particles down: K at Ra 5000 with five times the "
         "static pressure over K as printed",
         '"does affect" has no number: half; on the grid it is exactly 1', at_most=0.5),
    said("freeze-range", "Sec. III", "vanish", flows(3000, variant="range-6", **DENSE),
         "freezing vanishes as the range of the weight grows: K of the dense fluid at Ra 3000 with h = 6 "
         "over the grid's", f"10 % is the paper's error of K; {ALIKE}", at_least=0.9),
    MELTS(id="khp95-melting-threshold", headline=True, evidence="rb/variants.png", at_least=0.5, at_most=2,
          statement="the criterion tells where freezing begins: its ratio for the grid's <v^2> where "
                    "particles keep half of K", value=of(threshold),
          because=f"a criterion from a rule of thumb is good to a factor of two at best; half of K {ALIKE}"),
    said("newtonian-trajectories", "Sec. VII", "essentially Newtonian",
         one("snapshots", "newtonian", **particles(1e4)),
         "particles move as molecules of potential 2 P n^-2 w: correlation of accelerations, less their "
         "means over layers, which bear the weight of the fluid, Ra 10 000, ideal gas",
         '"essentially" has no number: four fifths of the mean square', at_least=0.9),
    said("subsonic", "Sec. VII", "v^2 << c^2", flows(3000, **DENSE),
         "high-pressure subsonic problems cannot be solved reliably: K of the mean flow over the grid's, "
         "dense fluid, P = 5, Ra 3000", f"unreliable is half of the energy lost, {ALIKE}", at_most=0.5),
    said("dense-no-trouble", "Sec. IV", "no apparent trouble", of(no_trouble),
         "the inconsistent dense fluid causes particles no trouble: late K over the largest K before, Ra "
         "3000", "what diverges exceeds its past", at_most=1),
    said("ra2500-flows", "Sec. VI", "relatively large fluctuations", of(flow_left),
         "particles convect at Ra 2500, where only fluctuations are said to be in the way: K of the field "
         "of 5000 particles over the grid's", f"half of the energy, {ALIKE}; {BOTH}", at_least=0.5),
    said("ra2500-fluctuations", "Sec. VI", "relatively large", of(noisier),
         "fluctuations at Ra 2500 are relatively large: their energy over the field's, over the same at Ra "
         "10 000", f'"relatively large" has no number: twice; {BOTH}', at_least=2),
    said("ra2500-usable", "Sec. VI", "abandoned", of(relative_err),
         "fluctuations prevent a comparison at Ra 2500: error of the mean K of the particles' field over "
         "the grid's K",
         f"smaller than the 10 % that they find at higher Ra, a comparison is possible; {PLAIN}; {BOTH}",
         at_least=0.1),
)
