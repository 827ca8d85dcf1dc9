"""Rows that follow from whole tables of KHP95's hard cases."""
from collections.abc import Callable, Iterator
from math import pi, sqrt
from typing import Any

import numpy as np
import pandas as pd

from studies.hardcases.interface.runs import Impulse, impulse
from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.ordering.derive import line

#: of moduli over h: 2 pi over the shortest vector of the reciprocal lattice, density 1
PERIODS = {"square": 1.0, "diagonal": 1.0, "hexagonal": sqrt(sqrt(3)/2)}
NARROWEST = 3.0         # range from which on an order is taken
assert abs(PERIODS["hexagonal"] - 2*pi/(4*pi/sqrt(3)/sqrt(2/sqrt(3)))) < 1e-12


ROUND_OFF = 2.0**-52
OFF = 0.1               # spacings: what is no return any more
QUIET, LATE = 1e-14, 1e-3       # distances between which twins part at their own rate
SETTLED = 0.3           # part of the time from the shock to its return that the ripple takes to grow steadily
ENOUGH = 0.65           # until which a run has to last: half of what is then left


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    makers: dict[str, tuple[Callable, tuple[str, ...]]] = {
        "modulus_orders": (modulus_orders, ("moduli",)), "returns": (returns, ("twins", "reversal")),
        "tube_orders": (tube_orders, ("tubes",)), "ripple_growth": (ripple_growth, ("ripples",))}
    return {name: list(make(*(tables[source] for source in sources))) for name, (make, sources) in makers.items()
            if all(source in tables for source in sources)}


def returns(twins: pd.DataFrame, reversal: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """The distance of a path that leapt there and back is round-off times exp(rate time): when is it a tenth of a spacing?"""
    for weight, group in reversal[reversal["integrator"] == "leapfrog"].groupby("weight"):
        pairs = twins[(twins["weight"] == weight) & twins["apart"].between(QUIET, LATE)]
        if len(pairs) < 3:
            continue
        rate, err = line(pairs["time"].to_numpy(), np.log(pairs["apart"].to_numpy()))
        for seed, one in group.groupby("seed"):
            one = one.sort_values("time")
            there = one["apart"].to_numpy() > OFF
            here = int(np.argmax(there))
            around = one.iloc[here - 1:here + 1]
            measured = (float(np.interp(np.log(OFF), np.log(around["apart"]), around["time"])) if there.any() and here > 0
                        else np.nan)
            yield {"weight": weight, "seed": seed, "rate": rate, "rate_err": err, "predicted": np.log(OFF/ROUND_OFF)/rate,
                   "measured": measured}


def tube_orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Over the lengths, means over seeds."""
    for eta, group in rows[rows["diverged"].isna()].groupby("eta"):
        means = group.groupby("L")[["rho_exact", "v_exact", "P_exact"]].mean()
        if len(means) > 2:
            for name in means:
                order, err = line(-np.log(means.index.to_numpy(float)), np.log(means[name].to_numpy()))
                yield {"eta": eta, "quantity": str(name).removesuffix("_exact"), "order": order, "order_err": err}


def ripple_growth(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Straight lines through heights before and behind the shock, and through amplitudes once growth is steady; a run that
    diverged late counts while it lasts.
    """
    for _, group in rows.groupby(["scale", "steep"]):
        scale, steep = (float(group[name].iloc[0]) for name in ("scale", "steep"))
        theory = impulse(scale, steep)
        lasted = theory.meets + ENOUGH*(theory.back - theory.meets)
        runs = [one.sort_values("time") for _, one in group.dropna(subset=["height"]).groupby("seed")]
        found = [ripple(one, theory) for one in runs if one["time"].iloc[-1] > lasted]
        if not found:
            continue
        kick, amplitude, growth = (combine([one[i] for one in found]) for i in range(3))
        yield {"scale": scale, "steep": steep, "seeds": len(found), "kick": kick.value, "kick_err": kick.err,
               "amplitude": amplitude.value, "amplitude_err": amplitude.err, "growth": growth.value, "growth_err": growth.err}


def ripple(one: pd.DataFrame, theory: Impulse) -> tuple[tuple[float, float], ...]:
    """(kick, its error), (amplitude, ...), (growth rate, ...) over those of theory, of one run."""
    steady = theory.meets + SETTLED*(theory.back - theory.meets)
    before, late = one[one["time"] < theory.meets], one[one["time"] > steady]
    (down, down_err), (up, up_err) = (line(part["time"].to_numpy(), part["height"].to_numpy()) for part in (before, late))
    growth, growth_err = line(late["time"].to_numpy(), late["amplitude"].to_numpy())
    begin = float(late["amplitude"].mean() - growth*(late["time"].mean() - theory.meets))
    return (((up - down)/theory.kick, float(np.hypot(up_err, down_err))/theory.kick),
            (begin/theory.amplitude, growth_err*float(late["time"].mean() - theory.meets)/theory.amplitude),
            (growth/theory.growth, growth_err/theory.growth))


def modulus_orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Moduli oscillate as h grows: the order is that of their rms over one period after the other."""
    for (kind, weight), group in rows[rows["h"] >= NARROWEST].groupby(["lattice", "weight"]):
        period = PERIODS[str(kind)]
        number = ((group["h"] - NARROWEST)/period).astype(int)
        whole = [part for _, part in group.groupby(number) if np.ptp(part["h"]) > 0.8*period]
        if len(whole) < 3:
            continue
        size = [float(np.sqrt(np.mean(part["exact"]**2))) for part in whole]
        order, err = line(-np.log([part["h"].mean() for part in whole]), np.log(size))
        yield {"lattice": kind, "weight": weight, "order": order, "order_err": err}
