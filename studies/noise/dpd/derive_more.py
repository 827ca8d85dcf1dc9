"""Second order of kT in the step; drag of a cylinder, and where its surface lies: from the tables of the study dpd."""
from collections.abc import Iterator
from math import hypot, nan
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from continuum.exact.cylinder import drag_of
from studies.kit.table import Tables
from studies.noise.dpd.derive import standard, weighted

FRACTIONS = (0.05, 0.1, 0.2, 0.3)       # of published drags
LONGEST = 0.06      # step of the fit through all runs


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of what `dpd_derive` leaves."""
    rows: dict[str, list[dict[str, Any]]] = {}
    steps, stiffness, cylinders, shear, inertia = (tables.get(name, pd.DataFrame()) for name in (
        "dpd_steps", "stiffness", "cylinders", "dpd_shear", "inertia"))
    if len(steps) and len(stiffness):
        states = standard(tables["states"]).query("a == 25 and rho == 3")
        both = pd.concat([steps, states[states["integrator"].isin(steps["integrator"]) & (states["dt"] <= LONGEST)]])
        rows["second"] = [*second(steps, stiffness, "long"), *second(both, stiffness, "all")]
    if len(cylinders) and len(shear) and len(inertia):
        rows["drag"] = list(drag(cylinders, shear, inertia))
    return rows


def second(steps: pd.DataFrame, stiffness: pd.DataFrame, runs: str) -> Iterator[dict[str, Any]]:
    """kT/kT_0 - 1 = second dt^2 + fourth dt^4 through the steps of an integrator; prediction from averages at the shortest."""
    said = stiffness.sort_values("dt").iloc[0]
    for integrator, group in steps.groupby("integrator"):
        dt = group["dt"].to_numpy()
        for temperature in ("kinetic", "configurational"):
            off, err = group[temperature].to_numpy() - 1, group[f"{temperature}_err"].to_numpy()
            two, four = weighted(np.stack([dt**2, dt**4], axis=1), off, err)
            yield {"integrator": integrator, "runs": runs, "temperature": temperature, "steps": len(dt), "second": two.value,
                   "second_err": two.err, "fourth": four.value, "fourth_err": four.err, "predicted": said[temperature],
                   "predicted_err": said[f"{temperature}_err"]}


def drag(cylinders: pd.DataFrame, shear: pd.DataFrame, inertia: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Drag over eta U and depth, with the viscosity at the same step; what inertia adds grows as Re^2."""
    for _, row in cylinders.iterrows():
        same = shear[(shear["a"] == 25) & (shear["rho"] == 3) & (shear["dt"] == row["dt"])
                     & (shear["integrator"] == "VelocityVerlet")]
        fixed = inertia[inertia["fraction"] == row["fraction"]].sort_values("reynolds")
        if not (len(same) and len(fixed)):
            continue
        eta, eta_err = (float(same.sort_values("time")[name].iloc[-1]) for name in ("viscosity", "viscosity_err"))
        known, free, U = drag_of(row["fraction"])[0], row["n"] - row["held"], row["speed"]
        reynolds = 2*row["radius"]*row["n"]/(row["side"]**2*row["depth"])*U/eta
        adds = 1 + (float(fixed["ratio"].iloc[0]) - 1)*(reynolds/float(fixed["reynolds"].iloc[0]))**2
        found = row["force"]*row["n"]/free/(eta*U*row["depth"])/adds
        relative = hypot(eta_err/eta, row["speed_err"]/U, row["balance_err"])
        # force and velocity are over all particles: over those of a cell full of the fluid outside
        outside = (row["fluid"]*row["side"]**2*row["depth"]/row["n"])**2
        yield {"variant": row["variant"], "fraction": row["fraction"], "radius": row["radius"], "reynolds": reynolds,
               "viscosity": eta, "viscosity_err": eta_err, "inertia": adds, "drag": found, "drag_err": found*relative,
               "published": known, **compared("", found/known, relative, row),
               **compared("outer_", found/known*outside, relative, row)}


def compared(name: str, ratio: float, relative: float, row: pd.Series) -> dict[str, float]:
    """A ratio of drags and the offset of the radius, with their errors."""
    low, at, high = (offset(ratio*by, row["fraction"], row["radius"]) for by in (1 - relative, 1, 1 + relative))
    return {f"{name}ratio": ratio, f"{name}ratio_err": ratio*relative, f"{name}offset": at, f"{name}offset_err": (high - low)/2}


def offset(ratio: float, fraction: float, radius: float) -> float:
    """By which the radius of a cylinder of so many times the drag exceeds this one in the same cell.

    ln F is the cubic in the root of the solid fraction through the published numbers, from 0.05 to 0.3; nan beyond.
    """
    root = np.sqrt(FRACTIONS)
    cubic = np.polynomial.Polynomial.fit(root, [np.log(drag_of(c)[0]) for c in FRACTIONS], 3)
    wanted = np.log(ratio) + cubic(np.sqrt(fraction))
    if not cubic(root[0]) <= wanted <= cubic(root[-1]):
        return nan
    return float(brentq(lambda r: cubic(r) - wanted, root[0], root[-1])/np.sqrt(fraction) - 1)*radius
