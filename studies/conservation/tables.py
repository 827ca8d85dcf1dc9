"""Tables of the study conservation, and the rows that follow from others.

Lengths in spacings a, gas at rho = T = 1, gamma = 2, so that c^2 = 2; `_err` 95 % half widths.
"""
from collections.abc import Iterator
from math import hypot
from typing import Any

import pandas as pd

from studies.kit import fits
from studies.kit.stats import Measured
from studies.kit.table import Rows, Table, Tables

RUN = ["scheme", "mode", "d", "maker", "weight", "h", "points", "wall", "zeta", "seed"]
SUMS = ["mass", "momentum", "energy", "volume"]
#: largest change of each sum: of mass, energy and volume over what they were, of momentum over the sum of its
#: sizes; err: round-off of the sums themselves; claimed: those that should stay; reached: steps until it
#: diverged or heated so much that sound outran its step, or all
DRIFT = Table("drift", key=RUN, columns=[*RUN, "n", "steps", "reached", "claimed", *SUMS, "err"])
#: lost: change of momentum over the sum of its sizes in so many steps, or when it was looked at last
#: (`reached`)
LOSSES = Table("losses", key=["maker", "points", "seed"],
               columns=["maker", "points", "seed", "steps", "reached", "lost"])

#: speed of a density pattern on a stream, over the stream's; predicted: by sums over the lattice
PATTERN = ["motion", "h", "wavelength"]
PATTERNS = Table("patterns", key=PATTERN, columns=[*PATTERN, "speed", "speed_err", "predicted"])
#: sound over c; predicted: from the wave number seen on the lattice and the stiffness of a lattice moved
MOVED = ["motion", "weight", "h", "wavelength"]
MOVING_SOUND = Table("moving_sound", key=MOVED, columns=[*MOVED, "speed", "speed_err", "predicted"])
#: the same of long waves, extrapolated
LONG_SOUND = Table("long_sound", key=["motion", "weight"], columns=["motion", "weight", "speed", "speed_err"])
#: rms error of positions after a fixed time over the rms displacement
PLACES = ["motion", "flow", "integrator", "steps"]
STEPS = Table("steps", key=PLACES, columns=[*PLACES, "dt", "error", "error_err"])
#: error with new velocities [Eq. 41] over that with old ones [Eq. 40], at the shortest step
ACCURACY = Table("accuracy", key=["motion", "flow"], columns=["motion", "flow", "ratio", "ratio_err"])
#: largest difference of accelerations of Eqs 46-48 from those of Eq. 49, over the largest, one set of random
#: fields
IDENTITY = Table("identity", key=["transport", "reynolds"], columns=["transport", "reynolds", "convective"])
#: v.grad as Eqs 46-48 add it, over the exact one; sums over a lattice, without chance
SIGNS = Table("signs", key=["equation", "wavelength"], columns=["equation", "wavelength", "factor"])
#: force of Eq. 50 in a wave without entropy, over -grad P, without chance
BRACKETS = Table("brackets", key=["a", "b"], columns=["a", "b", "force"])

DRAGS = ["variant", "fraction", "rows"]
#: F/(eta U) of a cylinder in a square array; drag_err: what still changed; published, error: against print,
#: relative
DRAG = Table("drag", key=[*DRAGS, "reynolds"], columns=[
    *DRAGS, "radius", "drag", "drag_err", "published", "published_err", "error", "error_err", "reynolds",
    "mach", "dt", "steps"])
#: extrapolated to infinitely fine points by a line in rows^-2 (points on the surface) or 1/rows (staircases),
#: error from the scatter about it; error: against print
DRAG_LIMITS = Table("drag_limits", key=["variant", "fraction"], columns=[
    "variant", "fraction", "sizes", "limit", "limit_err", "error", "error_err"])
#: homogeneous shear between sliding sides, errors: of stress and heating relative to eta rate and eta rate^2,
#: of the profile relative to the difference of speeds; drifts relative to mass, and to mass times speed
SHEAR = Table("shear", key=["rows"], columns=[
    "rows", "stress", "heating", "profile", "mass_drift", "momentum_drift", "steps"])
#: a wave that the shear turns: relative rms error of the velocity without divergence
WAVE = Table("wave", key=["rows"], columns=["rows", "error", "steps"])
#: a cylinder that turns inside of one at rest: errors of the torques on both, relative to the exact one
TORQUE = Table("torque", key=["rows"], columns=["rows", "radius", "turned", "fixed", "steps"])

ALL = (DRIFT, LOSSES, PATTERNS, MOVING_SOUND, LONG_SOUND, STEPS, ACCURACY, IDENTITY, SIGNS, BRACKETS, DRAG,
       DRAG_LIMITS, SHEAR, WAVE, TORQUE)

LONG = (16, 24, 32)     # wavelengths from which sound is extrapolated
LEAST = 3               # sizes of a limit
WIDE = 4.0              # spacings: a circle of a smaller radius is too coarse a polygon
SMOOTH = ("surface", "surface-unfiltered")      # drags that err as rows^-2; staircases as 1/rows
DERIVED = Iterator[dict[str, Any]]


def derive(tables: Tables) -> Rows:
    """Derived rows of the study, of the tables there are."""
    rows = {}
    for name, source, make in (("long_sound", "moving_sound", long_sound), ("accuracy", "steps", accuracy),
                               ("drag_limits", "drag", drag_limits)):
        if source in tables:
            rows[name] = list(make(tables[source]))
    return {name: some for name, some in rows.items() if some}


def long_sound(sound: pd.DataFrame) -> DERIVED:
    """Speeds of long waves: what the weight does to them is proportional to wavelength^-2.

    The error is the difference of two extrapolations.
    """
    short, middle, long = LONG
    for (motion, weight), group in sound.groupby(["motion", "weight"]):
        of_waves = group.set_index("wavelength")
        if set(LONG) <= set(of_waves.index):
            speeds, errs = of_waves["speed"], of_waves["speed_err"]
            speed = extrapolated(speeds, middle, long)
            change = speed - extrapolated(speeds, short, middle)
            err = hypot(change, 3*errs[long], 3*errs[middle])
            yield {"motion": motion, "weight": weight, "speed": speed, "speed_err": err}


def extrapolated(speeds: pd.Series, a: int, b: int) -> float:
    """Speed at 1/wavelength^2 = 0 from two wavelengths."""
    return float((b*b*speeds[b] - a*a*speeds[a])/(b*b - a*a))


def accuracy(steps: pd.DataFrame) -> DERIVED:
    """Errors of two integrators at the shortest step; they share a reference, whose errors add up."""
    for (motion, flow), group in steps.groupby(["motion", "flow"]):
        finest = group[group["steps"] == group["steps"].max()].set_index("integrator")
        new, old = finest.loc["two-step"], finest.loc["euler"]
        ratio = new["error"]/old["error"]
        relative = new["error_err"]/new["error"] + old["error_err"]/old["error"]
        yield {"motion": motion, "flow": flow, "ratio": ratio, "ratio_err": ratio*relative}


def drag_limits(drags: pd.DataFrame) -> DERIVED:
    """Drags of infinitely fine points."""
    for (variant, fraction), group in drags[drags["radius"] > WIDE].groupby(["variant", "fraction"]):
        if len(group) >= LEAST:
            rows = group["rows"].to_numpy(float)
            spacing = rows**-2 if variant in SMOOTH else 1/rows
            unsteady = Measured(0.0, group["drag_err"].max())
            limit = fits.line(spacing, group["drag"].to_numpy()).intercept + unsteady
            published = Measured(*group[["published", "published_err"]].iloc[0])
            error = limit/published - 1
            yield {"variant": variant, "fraction": fraction, "sizes": len(group), "limit": limit.value,
                   "limit_err": limit.err, "error": error.value, "error_err": error.err}
