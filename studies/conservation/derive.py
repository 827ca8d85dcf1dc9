"""Means over sets of points; limits of long waves, of steps, of fine points."""
from collections.abc import Callable, Iterator
from math import hypot
from typing import Any

import numpy as np
import pandas as pd

from studies.conservation.tables import FRAME, SOUND_KEY, SUMS
from studies.kit import fits
from studies.kit.stats import Measured, seed_means
from studies.kit.table import Rows, Tables

Derived = Iterator[dict[str, Any]]

LONG = (16, 24, 32)     # wavelengths from which sound is extrapolated
LEAST = 3               # sizes of a limit
WIDE = 4.0              # spacings: a circle of a smaller radius is too coarse a polygon
SMOOTH = ("surface", "surface-unfiltered")      # drags that err as rows^-2; staircases as 1/rows


def derive(tables: Tables) -> Rows:
    """Derived rows of the study, of the tables there are."""
    rows = {name: list(make(tables[source])) for name, (source, make) in DERIVED.items() if source in tables}
    return {name: made for name, made in rows.items() if made}


def frame_means(frames: pd.DataFrame) -> Derived:
    """Over sets of points."""
    return seed_means(frames, FRAME, SUMS[:3])


def sound_means(sound: pd.DataFrame) -> Derived:
    """The same; errors of eigenvalues are below the scatter."""
    return seed_means(sound.drop(columns="growth_err"), SOUND_KEY, ("growth", "ln_energy"))


def long_sound(sound: pd.DataFrame) -> Derived:
    """Speeds of long waves: what the weight does to them is proportional to wavelength^-2.

    The error is the difference of two extrapolations.
    """
    for (motion, weight), group in sound.groupby(["motion", "weight"]):
        numbers = group[["wavelength", "speed", "speed_err"]].to_numpy()
        speeds = {int(wavelength): Measured(speed, err) for wavelength, speed, err in numbers}
        if set(LONG) <= set(speeds):
            short, middle, long = LONG
            speed = extrapolated(speeds, middle, long)
            change = speed - extrapolated(speeds, short, middle)
            err = hypot(change, 3*speeds[long].err, 3*speeds[middle].err)
            yield {"motion": motion, "weight": weight, "speed": speed, "speed_err": err}


def extrapolated(speeds: dict[int, Measured], a: int, b: int) -> float:
    """Speed at 1/wavelength^2 = 0 from two wavelengths."""
    return (b*b*speeds[b].value - a*a*speeds[a].value)/(b*b - a*a)


def euler_limits(euler: pd.DataFrame) -> Derived:
    """Zero of the parabola through growth at 1/2, 1 and 3/2 times the predicted limit."""
    for wavelength, group in euler.groupby("wavelength"):
        if len(group) >= LEAST:
            parabola = np.polyfit(group["dt_over_limit"], group["growth"], 2)
            zeros = np.roots(parabola)
            limit = float(zeros[np.argmin(abs(zeros - 1))].real)
            slope = float(np.polyval(np.polyder(parabola), limit))
            yield {"wavelength": wavelength, "limit": limit, "limit_err": group["growth_err"].max()/slope}


def accuracy(steps: pd.DataFrame) -> Derived:
    """Errors of two integrators at the shortest step; they share a reference, whose errors add up."""
    for (motion, flow), group in steps.groupby(["motion", "flow"]):
        finest = group[group["steps"] == group["steps"].max()].set_index("integrator")
        new, old = finest.loc["two-step"], finest.loc["euler"]
        ratio = new["error"]/old["error"]
        relative = new["error_err"]/new["error"] + old["error_err"]/old["error"]
        yield {"motion": motion, "flow": flow, "ratio": ratio, "ratio_err": ratio*relative}


def drag_limits(drags: pd.DataFrame) -> Derived:
    """Drags of infinitely fine points."""
    for (variant, fraction), group in drags[drags["radius"] > WIDE].groupby(["variant", "fraction"]):
        if len(group) >= LEAST:
            rows, published = group["rows"].to_numpy(float), group[["published", "published_err"]].iloc[0]
            spacing = rows**-2 if variant in SMOOTH else 1/rows
            unsteady = Measured(0.0, group["drag_err"].max())
            limit = fits.line(spacing, group["drag"].to_numpy()).intercept + unsteady
            error = limit/Measured(*published) - 1
            slope = fits.power_law(rows, group["error"].to_numpy()).slope
            yield {"variant": variant, "fraction": fraction, "sizes": len(group), "limit": limit.value,
                   "limit_err": limit.err, "error": error.value, "error_err": error.err, "slope": slope.value,
                   "slope_err": slope.err}


#: table -> the one it follows from, and how
DERIVED: dict[str, tuple[str, Callable[[pd.DataFrame], Derived]]] = {
    "frame_means": ("frames", frame_means), "sound_means": ("sound", sound_means),
    "long_sound": ("moving_sound", long_sound), "euler_limits": ("euler", euler_limits),
    "accuracy": ("steps", accuracy), "drag_limits": ("drag", drag_limits)}
