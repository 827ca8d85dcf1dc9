"""Errors of kT over the step, compression, excess pressure: from the tables of the study dpd."""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.stats import Measured
from studies.kit.table import Tables

RHO, GAMMA = 3.0, 4.5
FEW = 100           # particles: a mean of ratios, as the configurational kT is, is off by about 1/n
SHORT = 3           # least steps of an order
SEEN = 2.0          # an error is no chance if it exceeds its half width so many times


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    states = tables["states"] if "states" in tables else pd.DataFrame()
    rows: dict[str, list[dict[str, Any]]] = {}
    if len(states):
        rows["errors"] = list(errors(states))
        rows["excess"] = list(excess(states))
        rows["compression"] = list(compression(states, tables.get("structure", pd.DataFrame())))
    return rows


def weighted(x: np.ndarray, y: np.ndarray, err: np.ndarray) -> list[Measured]:
    """Coefficients of y = x c by least squares with errors err (95 %), x (n, p)."""
    A = x/err[:, None]
    covariance = np.linalg.inv(A.T@A)
    c = covariance@A.T@(y/err)
    return [Measured(float(value), float(np.sqrt(variance))) for value, variance in zip(c, np.diag(covariance), strict=True)]


def standard(states: pd.DataFrame) -> pd.DataFrame:
    """Three dimensions, kT = 1, uniform noise, more than the few particles of print."""
    chosen = states[(states["d"] == 3) & (states["kT"] == 1) & (states["noise"] == "Uniform")]
    return chosen[chosen["n"] > FEW]


#: what forward friction adds to kT over dt, Lambda the matrix of friction, with covariances C = kT + delta of velocities:
#: d delta/dt = -Lambda delta - delta Lambda + dt kT Lambda^2. Points that stand still: delta = dt kT Lambda/2, of which the mean
#: is (rho gamma/2d) int w^2 dV. Points that mix at once: delta = dt kT <Lambda^2>/(2 <Lambda>). Of points without order, in 3D:
STILL = RHO*GAMMA/6*2*np.pi/15
MIXED = STILL + GAMMA/(2*np.pi/15)*4*np.pi/105


def errors(states: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row an integrator, repulsion and temperature."""
    chosen = standard(states)
    for (integrator, _), group in chosen[chosen["rho"] == RHO].groupby(["integrator", "a"]):
        a = float(group["a"].iloc[0])
        for temperature in ("kinetic", "configurational"):
            some = group[group[temperature].notna()]
            dt, off, err = some["dt"].to_numpy(), some[temperature].to_numpy() - 1, some[f"{temperature}_err"].to_numpy()
            if len(set(dt)) < 3:
                continue
            terms = [dt**p for p in (1, 2, 3)[:len(set(dt)) - 1]]
            linear, quadratic, cubic = [*weighted(np.stack(terms, axis=1), off, err), Measured(np.nan, np.nan)][:3]
            seen = np.abs(off) > SEEN*err
            order, short = slope(dt[seen], off[seen], err[seen]), slope(*shortest(dt[seen], off[seen], err[seen]))
            yield {"integrator": integrator, "a": a, "temperature": temperature, "still": STILL, "mixed": MIXED, "steps": len(dt),
                   "linear": linear.value,
                   "linear_err": linear.err, "quadratic": quadratic.value, "quadratic_err": quadratic.err,
                   "cubic": cubic.value, "cubic_err": cubic.err,
                   "used": int(seen.sum()), "order": order.value, "order_err": order.err, "short_order": short.value,
                   "short_order_err": short.err}


def shortest(dt: np.ndarray, *columns: np.ndarray) -> list[np.ndarray]:
    """The rows of the SHORT shortest steps."""
    few = dt <= np.append(np.unique(dt), [np.inf]*SHORT)[SHORT - 1]
    return [column[few] for column in (dt, *columns)]


def slope(dt: np.ndarray, off: np.ndarray, err: np.ndarray) -> Measured:
    """d ln |error|/d ln dt; unknown from less than SHORT steps."""
    if len(dt) < SHORT:
        return Measured(np.nan, np.nan)
    return weighted(np.stack([np.log(dt), np.ones(len(dt))], axis=1), np.log(np.abs(off)), err/np.abs(off))[0]


def excess(states: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Of the splitting at its shortest step, which errs least; the largest box of a state."""
    chosen = states[(states["d"] == 3) & (states["a"] > 0)]
    chosen = chosen[(chosen["integrator"] == "Shardlow") & (chosen["noise"] == "Uniform")]
    for _, group in chosen.groupby(["a", "kT", "rho"]):
        row = group.sort_values(["dt", "side"], ascending=[True, False]).iloc[0]
        a, kT, rho = (float(row[name]) for name in ("a", "kT", "rho"))
        yield {"a": a, "kT": kT, "rho": rho, "P": row["P"], "P_err": row["P_err"], "alpha": (row["P"] - rho*kT)/(a*rho**2),
               "alpha_err": row["P_err"]/(a*rho**2)}


def compression(states: pd.DataFrame, structure: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """dP/drho at rho = 3 and S(0)."""
    chosen = standard(states)
    near = chosen[(chosen["a"] == 25) & (chosen["integrator"] == "Shardlow") & (chosen["rho"].sub(3).abs() < 0.7)]
    near = near.sort_values("dt").drop_duplicates("rho")
    some = structure[(structure["a"] == 25) & (structure["k"] < 3)] if len(structure) else structure
    if len(near) < 3 or len(some) < 4:
        return
    x = near["rho"].to_numpy() - 3
    slope = weighted(np.stack([np.ones_like(x), x, x**2], axis=1), near["P"].to_numpy(), near["P_err"].to_numpy())[1]
    k = some["k"].to_numpy()
    S0 = weighted(np.stack([np.ones_like(k), k**2, k**4], axis=1), some["S"].to_numpy(), some["S_err"].to_numpy())[0]
    product = slope.value*S0.value
    yield {"a": 25.0, "slope": slope.value, "slope_err": slope.err, "S0": S0.value, "S0_err": S0.err, "product": product,
           "product_err": product*float(np.hypot(slope.err/slope.value, S0.err/S0.value))}
