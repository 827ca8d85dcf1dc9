"""Verdicts in plain words: (rows, numbers) of a rung -> words, and whether they are good ones."""
from typing import NamedTuple

import numpy as np

from studies.judge.measures import Numbers

LEAST = 0.5         # order below which errors do not fall with rows
ROUNDING = 1e-10    # a sum over thousands of steps and points
NOISE = 1e-3        # of sound: of a fluid that is at rest on average
WARM = 1e-6         # of T
ALIKE = 0.1
RIGHT = 0.002       # of K: what it still changes by after 90 free-fall times
LIMIT = 0.98        # of the claimed step: growth just above the limit takes more than 300 steps to be seen


class Verdict(NamedTuple):
    """good : None where there is nothing to praise or blame."""
    words: str
    good: bool | None


Taken = list[tuple[int, Numbers]]


def meets(taken: Taken) -> Verdict:
    """There is no verdict of `contract` but what it raises."""
    return Verdict("has all that a run asks for", True)


def stays(taken: Taken) -> Verdict:
    """Of `rest`."""
    speed, heating = taken[0][1]["speed"], taken[0][1]["heating"]
    if speed < ROUNDING:
        words = "stays at rest"
    elif speed < NOISE:
        words = f"trembles at rest, by {speed:.1g} of the speed of sound"
    else:
        words = f"sets a fluid at rest in motion, by {speed:.1g} of the speed of sound"
    if abs(heating) > WARM:
        words += f"; {'heats' if heating > 0 else 'cools'} it by {abs(heating):.1g}"
    return Verdict(words, speed < NOISE and abs(heating) < WARM)


def keeps(taken: Taken) -> Verdict:
    """Of `kept`."""
    lost = [f"{name} (drift {drift:.1g})" for name, drift in taken[0][1].items() if not drift < ROUNDING]
    if not lost:
        return Verdict("keeps mass, momentum and energy to round-off", True)
    return Verdict(f"does not keep {', '.join(lost)}", False)


def same_frames(taken: Taken) -> Verdict:
    """Of `frames`."""
    ratio = taken[0][1]["ratio"]
    if abs(ratio - 1) < ALIKE:
        return Verdict("is as good in a moving frame", True)
    return Verdict(f"its error is {ratio:.2g} times as large in a moving frame", ratio < 1)


def repeats(taken: Taken) -> Verdict:
    """Of `repeated`."""
    difference = taken[0][1]["difference"]
    if difference == 0:
        return Verdict("repeats itself bit by bit", True)
    return Verdict(f"is not deterministic: two runs of one seed differ by {difference:.1g}", False)


def holds(taken: Taken) -> Verdict:
    """Of `longest`."""
    share = taken[0][1]["share"]
    if np.isnan(share):
        when = "all steps" if taken[0][1]["grows"] else "no step"
        return Verdict(f"shows no limit: a vortex gains energy at {when} within a factor of 60", None)
    words = f"is stable up to {share:.2f} of the step that it claims"
    if share < LIMIT:
        return Verdict(f"claims too long a step: {words}", False)
    return Verdict(words if share < 2 else f"claims less than it could: {words}", True)


def order(taken: Taken) -> float:
    """Slope of log |error| over log rows, with its sign turned."""
    rows, errors = [count for count, _ in taken], [abs(numbers["error"]) for _, numbers in taken]
    return -float(np.polyfit(np.log(rows), np.log(errors), 1)[0])


def convergence(taken: Taken) -> Verdict:
    """Of `error`, from few rows to many."""
    rows, error = taken[-1][0], abs(taken[-1][1]["error"])
    told = f"{percent(error)} off with {rows} rows"
    if len(taken) < 2:
        return Verdict(told, None)
    if order(taken) < LEAST:
        fewer, first = taken[0]
        return Verdict(f"does not converge: {told}, {percent(abs(first['error']))} with {fewer}", False)
    return Verdict(f"converges with order {order(taken):.1f}: {told}", True)


def energy(taken: Taken) -> Verdict:
    """Of `convection`, from few rows to many."""
    rows, last = taken[-1]
    errors = [numbers["error"] for _, numbers in taken]
    told = f"K is {percent(abs(last['error']))} {'high' if last['error'] > 0 else 'low'} with {rows} rows"
    if all(abs(numbers["error"]) < max(numbers["error_err"], RIGHT) for _, numbers in taken[-2:]):
        return Verdict(f"is right: {told}", True)
    if len(taken) < 2:
        return Verdict(told, None)
    if min(errors) < 0 < max(errors):
        most = percent(max(map(abs, errors)))
        return Verdict(f"has no order, as its errors change sign: {told}, {most} off at most",
                       abs(errors[-1]) < abs(errors[0]))
    if order(taken) < LEAST:
        return Verdict(f"does not converge: {told}", False)
    return Verdict(f"converges with order {order(taken):.1f}: {told}", True)


def percent(share: float) -> str:
    """In two digits or more."""
    return f"{100*share:.2g} %" if share < 0.1 else f"{100*share:.0f} %"
