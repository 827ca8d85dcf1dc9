"""Errors of kT over the step, drag of the cylinder: from the tables of dissipative particles"""
from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from continuum.exact.cylinder import drag_of
from studies.kit.fits import weighted
from studies.kit.stats import Measured
from studies.kit.table import Rows, Tables
from studies.noise.dissipative import DEPTH, FRACTION, RADIUS

RHO, GAMMA = 3.0, 4.5
FEW = 100           # particles: a mean of ratios, as the configurational kT is, is off by about 1/n
LEAST = 3           # steps of an order
SEEN = 2.0          # an error is no chance if it exceeds its half width so many times
NONE = Measured(np.nan, np.nan)

#: what forward friction adds to kT over dt, Lambda the matrix of friction, with covariances C = kT + delta of
#: velocities: d delta/dt = -Lambda delta - delta Lambda + dt kT Lambda^2. Points that stand still have
#: delta = dt kT Lambda/2, of which the mean is (rho gamma/2d) int w^2 dV; points that mix at once have
#: delta = dt kT <Lambda^2>/(2 <Lambda>). Of points without order, in 3D:
STILL = RHO*GAMMA/6*2*np.pi/15
MIXED = STILL + GAMMA/(2*np.pi/15)*4*np.pi/105


def derive(tables: Tables) -> Rows:
    """Derived rows, as far as the tables allow."""
    states, shear, cylinder = (tables.get(name, pd.DataFrame()) for name in ("states", "shear", "cylinder"))
    rows: dict[str, list[dict[str, Any]]] = {}
    if len(states):
        rows["errors"] = list(errors(states))
    if len(shear) and len(cylinder):
        rows["drag"] = [drag(cylinder.iloc[0], shear.iloc[0])]
    return rows


def errors(states: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row an integrator, repulsion and temperature."""
    groups = states[states["n"] > FEW].groupby(["integrator", "a"])
    for ((integrator, a), group), temperature in product(groups, ("kinetic", "configurational")):
        rows = group[group[temperature].notna()]
        if rows["dt"].nunique() >= LEAST:
            dt, kT, err = (rows[name].to_numpy() for name in ("dt", temperature, f"{temperature}_err"))
            yield {"integrator": integrator, "a": a, "temperature": temperature, "steps": len(rows),
                   **series(dt, kT - 1, err), **order(dt, kT - 1, err)}


def series(dt: np.ndarray, error: np.ndarray, err: np.ndarray) -> dict[str, float]:
    """Coefficients of dt, dt^2, dt^3: one fewer than there are steps."""
    degree = min(3, len(set(dt)) - 1) - 1
    fit = weighted(dt, error/dt, err/dt, degree)
    known = [fit.along(unit) for unit in np.eye(degree + 1)]
    named = zip(("linear", "quadratic", "cubic"), [*known, NONE, NONE])
    return {f"{name}{part}": value for name, pair in named for part, value in zip(("", "_err"), pair)}


def order(dt: np.ndarray, error: np.ndarray, err: np.ndarray) -> dict[str, float]:
    """d ln|error|/d ln dt of the steps whose error is no chance."""
    seen = np.abs(error) > SEEN*err
    x, y, e = np.log(dt[seen]), np.log(np.abs(error[seen])), err[seen]/np.abs(error[seen])
    slope = weighted(x, y, e).slope if seen.sum() >= LEAST else NONE
    return {"used": int(seen.sum()), "order": slope.value, "order_err": slope.err}


def drag(stream: pd.Series, shear: pd.Series) -> dict[str, float]:
    """Drag over eta U and depth: force on what is free, with the mean pressure gradient's on the body."""
    U = Measured(stream["speed"], stream["speed_err"])
    eta = Measured(shear["viscosity"], shear["viscosity_err"])
    force = float(stream["force"]*stream["n"]/(stream["n"] - stream["held"]))
    value = force/DEPTH/(eta*U)
    ratio = value/drag_of(FRACTION).value
    density = stream["n"]/(stream["side"]**2*DEPTH)
    reynolds = 2*RADIUS*density*U.value/eta.value
    return {"side": stream["side"], "dt": stream["dt"], "reynolds": reynolds, "drag": value.value,
            "drag_err": value.err, "ratio": ratio.value, "ratio_err": ratio.err}
