"""Measures of the ladder's rungs, (scene, method) -> numbers by name, and verdicts on these numbers.

Errors of the method are passed on. A verdict on all numbers of rows takes (rows, numbers), few rows first.
"""
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import Fields, energy
from particles.fields import kinetic, kinetic_energy
from particles.run import Divergence, Plan, run
from studies.build import answer
from studies.build.measure import limit
from studies.build.scenes import SOUND, TaylorGreen
from studies.build.setting import Unguarded, bisected
from studies.front.observed import apart
from studies.front.solving import named, planned, prepared, solve

Numbers = dict[str, float]
Taken = list[tuple[int, Numbers]]
FEW = 50            # steps after which two runs of one seed are compared
TRIED = 300         # steps of a run whose time step may be too long
FED = 1.1           # growth of kinetic energy that shows instability: that of a vortex can only decay
LIMIT = 0.98        # tolerance on the claimed step: just above the limit growth takes more than 300 steps
LEAST = 0.5         # order below which errors do not fall with rows
ROUNDING = 1e-10    # round-off of a sum over thousands of steps and points
NOISE = 1e-3        # rms speed over that of sound, of a fluid that is at rest on average
WARM = 1e-6         # relative change of T that is heating
ALIKE = 0.1         # relative difference of errors in two frames that are alike
RIGHT = 0.002       # relative change of K that remains after 90 free-fall times
LOOSE = 0.05        # relative error of K that leaves no verdict: methods of the README differ by less


class Verdict(NamedTuple):
    """A verdict in words. good : None if it is neither good nor bad."""
    words: str
    good: bool | None


def meets(numbers: Numbers) -> Verdict:
    """Verdict on a method that passed `contract`, which raises Breach otherwise."""
    return Verdict("has all that a run asks for", True)


def rest(scene: Any, method: Any) -> Numbers:
    """Fluid that starts at rest at T = 1: rms speed over that of sound, and rise of mean T, at the end."""
    at = solve(scene, method).at
    m = at.rho*at.V/(at.rho@at.V)
    return {"speed": float(m@(at.v**2).sum(axis=1))**0.5/SOUND, "heating": float(m@at.T) - 1}


def stays(numbers: Numbers) -> Verdict:
    speed, heating = numbers["speed"], numbers["heating"]
    of_sound = f", by {speed:.1g} of the speed of sound"
    words = ("stays at rest" if speed < ROUNDING else f"trembles at rest{of_sound}" if speed < NOISE else
             f"sets a fluid at rest in motion{of_sound}")
    if abs(heating) > WARM:
        words += f"; {'heats' if heating > 0 else 'cools'} it by {abs(heating):.1g}"
    return Verdict(words, speed < NOISE and abs(heating) < WARM)


def kept(scene: TaylorGreen, method: Any) -> Numbers:
    """Largest drift of mass, momentum, energy over initial mass, mass times vortex speed, initial energy."""
    chosen = named(method)
    ready = prepared(scene, chosen)
    first, drift = total(scene, ready.method.fields(ready.start)), np.zeros(4)

    def look(sums: Any, state: np.ndarray) -> float:
        drift[:] = np.maximum(drift, np.abs(total(scene, sums.method.fields(state)) - first))
        return 0.0
    run(ready.method, ready.start, replace(planned(scene, chosen, ready.dt), series={"total": look}))
    mass, px, py, heat = drift/first[[0, 0, 0, 3]]
    return {"mass": float(mass), "momentum": float(max(px, py))/scene.speed, "energy": float(heat)}


def total(scene: Any, at: Fields) -> np.ndarray:
    """Total mass, momentum along both axes, and energy, (4,)."""
    m = at.rho*at.V
    e = energy(scene.eos, at.rho, at.T) + (at.v**2).sum(axis=1)/2
    return np.array([m.sum(), *(m@at.v), m@e])


def keeps(numbers: Numbers) -> Verdict:
    lost = [f"{name} (drift {drift:.1g})" for name, drift in numbers.items() if not drift < ROUNDING]
    if not lost:
        return Verdict("keeps mass, momentum and energy to round-off", True)
    return Verdict(f"does not keep {', '.join(lost)}", False)


def frames(scene: Any, method: Any) -> Numbers:
    """Errors of velocity over the vortex's speed, for the vortex at rest and in a wind, and their ratio."""
    both = (solve(one, method) for one in (TaylorGreen(L=scene.L, mach=scene.mach), scene))
    still, carried = (apart(done.at, answer(done.scene, done.at.x))/scene.speed for done in both)
    return {"at_rest": still, "carried": carried, "ratio": carried/still}


def same_frames(numbers: Numbers) -> Verdict:
    ratio = numbers["ratio"]
    if abs(ratio - 1) < ALIKE:
        return Verdict("is as good in a moving frame", True)
    return Verdict(f"its error is {ratio:.2g} times as large in a moving frame", ratio < 1)


def repeated(scene: Any, method: Any) -> Numbers:
    """Largest difference between the final states of two runs of one seed."""
    first, second = (prepared(scene, named(method)) for _ in range(2))
    plan = Plan(dt=first.dt, steps=FEW)
    one, other = (run(ready.method, ready.start, plan).by_id() for ready in (first, second))
    return {"difference": float(np.abs(one - other).max())}


def repeats(numbers: Numbers) -> Verdict:
    if numbers["difference"] == 0:
        return Verdict("repeats itself bit by bit", True)
    return Verdict("is not deterministic: two runs of one seed differ by "
                   f"{numbers['difference']:.1g}", False)


def longest(scene: TaylorGreen, method: Any) -> Numbers:
    """Longest step at which a vortex gains no energy, over the claimed one; nan: no limit was found."""
    ready = prepared(scene, named(method))
    free, first = Unguarded(ready.method), kinetic_energy(ready.method.fields(ready.start))

    def grows(dt: float) -> bool:
        plan = Plan(dt=dt, steps=TRIED, every=TRIED//10, series={"K": kinetic})
        try:
            K = run(free, ready.start, plan).series["K"]
        except (Divergence, ArithmeticError):
            return True
        return not max(K) < FED*first
    stable, _ = bisected(grows, ready.limit)
    share = stable/ready.limit
    return {"claimed": ready.limit, "share": share, "grows": float(grows(ready.limit))}


def holds(numbers: Numbers) -> Verdict:
    share = numbers["share"]
    if np.isnan(share) and numbers["grows"]:
        return Verdict("is unstable at any step: a vortex gains energy at 1/64 of the claimed one", False)
    if np.isnan(share):
        return Verdict("shows no limit: no step up to 64 times the claimed one feeds a vortex", None)
    words = f"is stable up to {share:.2f} of the step that it claims"
    if share < LIMIT:
        return Verdict(f"claims too long a step: {words}", False)
    return Verdict(words if share < 2 else f"claims less than it could: {words}", True)


def error(scene: Any, method: Any) -> Numbers:
    """Relative difference from the exact answer, and CPU seconds."""
    done = solve(scene, method)
    return {"error": done.error.value, "cpu_s": done.cpu_s}


def order(taken: Taken) -> float:
    """Order of convergence: minus the slope of log error over log rows."""
    logs = np.log([(rows, abs(numbers["error"])) for rows, numbers in taken])
    rows, errors = logs.T
    return -float(np.polyfit(rows, errors, 1)[0])


def convergence(taken: Taken) -> Verdict:
    rows, error = taken[-1][0], abs(taken[-1][1]["error"])
    told = f"{percent(error)} off with {rows} rows"
    if len(taken) < 2:
        return Verdict(told, None)
    fewer, first = taken[0]
    return falling(taken, told, f", {percent(first['error'])} with {fewer}")


def falling(taken: Taken, told: str, begins: str = "") -> Verdict:
    """Verdict on the order of errors of one sign."""
    if order(taken) < LEAST:
        return Verdict(f"has no order on these rows, its errors fall too slowly: {told}{begins}", False)
    return Verdict(f"converges with order {order(taken):.1f}: {told}", True)


def convection(scene: Any, method: Any) -> Numbers:
    """K and Nu with errors; the relative difference of K from the grid's limit at Ra 10 000, Pr 1."""
    done = solve(scene, method)
    off = done.K/limit("ke") - 1
    return {"K": done.K.value, "K_err": done.K.err, "Nu": done.Nu.value, "Nu_err": done.Nu.err,
            "error": off.value, "error_err": off.err, "cpu_s": done.cpu_s}


def right(taken: Taken) -> Verdict:
    rows, last = taken[-1]
    errors = [numbers["error"] for _, numbers in taken]
    told = f"K is {percent(last['error'])} {'high' if last['error'] > 0 else 'low'} with {rows} rows"
    if not last["error_err"] < LOOSE:
        return Verdict(f"cannot be told, as K is uncertain by {percent(last['error_err'])}: {told}", None)
    if all(abs(numbers["error"]) < max(numbers["error_err"], RIGHT) for _, numbers in taken[-2:]):
        return Verdict(f"is right: {told}", True)
    if len(taken) < 2:
        return Verdict(told, None)
    if min(errors) < 0 < max(errors):
        most = percent(max(errors, key=abs))
        return Verdict(f"has no order, as its errors change sign: {told}, {most} off at most",
                       abs(errors[-1]) < abs(errors[0]))
    return falling(taken, told)


def percent(share: float) -> str:
    """Absolute value in per cent, with two digits or more."""
    size = 100*abs(share)
    return f"{size:.2g} %" if size < 10 else f"{size:.0f} %"
