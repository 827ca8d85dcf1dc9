"""Tables of the study conservation, and rows derived from them.

Lengths in spacings a, gas at rho = T = 1, gamma = 2, so that c^2 = 2; `_err` are half of 95 % intervals.
"""
from collections.abc import Iterator
from math import hypot

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.stats import Measured, with_errors
from studies.kit.table import Row, Rows, Table, Tables

SOUND = {"speed": ("speed of sound over c", "")}
SIZE = {"rows": ("points along the side of the cell", ""), "variant": ("how the body is made", ""),
        "error": ("drag/published - 1", "")}
TORQUE = {"exchange": ("of momentum: an equation, or halves of the ends' own", ""),
          "viscosity": ("viscosity of nested friction", ""),
          "torque": ("|sum x cross f| over sum |x| |f|, x the edge or the place of the point", "")}
RINGS = {"rows": ("points along the side of the box", "")}

ALL = (
    Table.of("drift", "scheme mode d maker weight h points wall zeta seed",
             "n steps reached claimed mass momentum energy err",
             about="A long run of a scheme: the largest change of each sum until its end.",
             means={"reached": ("steps until it diverged or heated so much that sound outran its step, or "
                                "all", ""),
                    "energy": ("largest change of energy over energy", ""),
                    "err": ("round-off of the sums themselves", "")}),
    Table.of("losses", "maker points seed", "steps reached lost",
             about="A long run without the second kernel of Eq. 14.",
             means={"reached": ("steps when it was looked at last", ""),
                    "lost": ("change of momentum over the sum of its sizes", "")}),
    Table.of("patterns", "motion h wavelength", "speed speed_err",
             about="A density pattern on a stream.",
             means={"speed": ("speed of the pattern over that of the stream", "")}),
    Table.of("moving_sound", "motion weight h wavelength", "speed speed_err", means=SOUND,
             about="A sound wave on moving points."),
    Table.of("long_sound", "motion weight", "speed speed_err", means=SOUND,
             about="The same of endless waves, extrapolated."),
    Table.of("accuracy", "motion flow", "ratio ratio_err", about="Positions at the end of a run.",
             means={"ratio": ("error with new velocities [Eq. 41] over that with old ones [Eq. 40]", "")}),
    Table.of("identity", "transport reynolds", "convective",
             about="Accelerations of two forms of the momentum equation for one set of random fields."),
    Table.of("signs", "equation wavelength", "factor",
             about="What an equation adds to a rate of change, by sums over a lattice."),
    Table.of("brackets", "a b", "force", about="The bracket of Eq. 50 in a wave without entropy.",
             means={"force": ("force over -grad P", "")}),
    Table.of("beside", "a b", "start end volumes",
             about="Eq. 50 beside smooth particles, from one state: relative rms differences.",
             means={"start": ("of accelerations at the start", ""), "end": ("of velocities after 5 t0", ""),
                    "volumes": ("of volumes then from 1 over the summed density", "")}),
    Table.of("torques", "exchange maker points seed", "torque", means=TORQUE,
             about="What an exchange over edges does to angular momentum, random fields, points that stay."),
    Table.of("motion_torques", "motion viscosity", "torque", means=TORQUE,
             about="The same of all forces on a disc of moving points with a free rim."),
    Table("drag", key=["variant", "fraction", "rows", "reynolds"], columns=[
        "variant", "fraction", "rows", "radius", "drag", "drag_err", "published", "published_err", "error",
        "error_err", "reynolds", "mach", "dt", "steps"], means=SIZE,
        about="A slow stream past a cylinder in a square array, on points that stay; the error of the drag "
              "is what still changed."),
    Table.of("drag_limits", "variant fraction", "sizes limit limit_err error error_err",
             means=SIZE | {"limit": ("drag over viscosity and speed", "")},
             about="The same of infinitely fine points on the surface, by a line in rows^-2."),
    Table.of("shear", "rows", "stress heating profile mass_drift momentum_drift steps", means=RINGS,
             about="Homogeneous shear between sliding sides."),
    Table.of("wave", "rows", "error steps", about="A wave that the shear turns.",
             means=RINGS | {"error": ("relative rms error of the velocity without divergence", "")}))

LONG = (16, 24, 32)     # wavelengths from which sound is extrapolated
LEAST = 3               # least number of sizes for an extrapolation
WIDE = 4.0              # spacings: the polygon of a smaller circle is too coarse


def derive(tables: Tables) -> Rows:
    """Rows of the derived tables whose source is among the tables."""
    return {name: list(follows(tables[source])) for name, (source, follows) in DERIVED.items()
            if source in tables}


def long_sound(sound: pd.DataFrame) -> Iterator[Row]:
    """Speeds of infinitely long waves, extrapolated: the error of the weight goes as wavelength^-2.

    The error of the limit is the difference of two extrapolations.
    """
    h = 1/np.array(LONG)
    for (motion, weight), group in sound.groupby(["motion", "weight"]):
        waves = group[group["wavelength"].isin(LONG)].sort_values("wavelength")
        if len(waves) == len(LONG):
            speeds, errs = waves[["speed", "speed_err"]].to_numpy().T
            speed = fits.eliminate(speeds[1:], h[1:], 2.0)
            change = speed - fits.eliminate(speeds[:2], h[:2], 2.0)
            err = hypot(change, *3*errs[1:])
            yield {"motion": motion, "weight": weight, "speed": speed, "speed_err": err}


def drag_limits(drags: pd.DataFrame) -> Iterator[Row]:
    """Drags of points on the surface extrapolated to infinitely fine ones; their errors have second order."""
    known = drags[(drags["variant"] == "surface") & (drags["radius"] > WIDE)]
    for (variant, fraction), group in known.groupby(["variant", "fraction"]):
        if len(group) >= LEAST:
            rows = group["rows"].to_numpy(float)
            unsteady = Measured(0.0, group["drag_err"].max())
            limit = fits.line(rows**-2, group["drag"].to_numpy()).intercept + unsteady
            published = Measured(*group[["published", "published_err"]].iloc[0])
            yield {"variant": variant, "fraction": fraction, "sizes": len(group),
                   **with_errors(limit=limit, error=limit/published - 1)}


#: derived table -> its source, and the function that derives it
DERIVED = {"long_sound": ("moving_sound", long_sound), "drag_limits": ("drag", drag_limits)}
