"""Quantities that a run of any method records in a scene, and the numbers that follow from them.

K is the kinetic energy per mass, for smooth particles that of the smoothed field; Nu is the heat transport
through the fluid over that of conduction alone. If a scene has an exact answer, `error` is the root mean
square difference from it, over the root mean square difference of a fluid at rest from it.
"""
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from continuum.fluid import Fields, energy, pressure
from continuum.scene import RayleighBenard
from continuum.sides import HeatPath
from particles.fields import kinetic
from particles.observe import fields_at
from particles.smooth.spam import Spam
from studies.build import answer
from studies.build.measure import heat_at_rest
from studies.kit.fits import line
from studies.kit.stats import Measured, settled

LATE = 0.6          # fraction of a run after which averages begin
STEADY = 1e-3       # relative change in the last two fifths of a run, below which a series is steady
FEW = 20            # least number of samples for an error from their two halves
AGREE = 0.3         # fraction of the mean: halves that differ by more are no steady state


def heating(scene: Any) -> HeatPath | None:
    """Path of the heat between two plates; None if no two plates differ in temperature."""
    if isinstance(scene, RayleighBenard):
        return HeatPath(1, scene.dT, scene.L)
    return getattr(scene, "heating", None)


def nusselt(at: Fields, scene: Any, heat: HeatPath) -> float:
    """1 + <rho v (e + P/rho + v^2/2 + g y)>/(k dT/length), v along the heat; work of friction is left out.

    Holds for steady flows and constant conductivity, where mean conduction is k dT/length.
    """
    e = energy(scene.eos, at.rho, at.T)
    head = e + pressure(scene.eos, at.rho, e)/at.rho + (at.v**2).sum(axis=1)/2 + scene.g*at.x[:, 1]
    carried = at.V@(at.rho*at.v[:, heat.axis]*head)/at.V.sum()
    return 1 + float(carried)*heat.length/(scene.law.k*heat.dT)


def recorded(scene: Any, variant: Any) -> dict[str, Callable]:
    """Quantities of a run by their names in its history: K, Nu if heat passes, and the scene's own.

    Nu of convection is from the variant's own series: the heat transport in the volume of smooth particles,
    or through the plates.
    """
    own, heat = getattr(variant, "series", {}), heating(scene)
    of_fields = dict(getattr(scene, "quantities", {}))
    record: dict[str, Callable] = {"K": kinetic}
    if "kg" in own:
        record = {"K": own["kg"], "K_particles": own["kp"]}
    if heat and own and isinstance(scene, RayleighBenard):
        unit = heat_at_rest(scene)
        record["Nu"] = ((lambda *at: own["heat"](*at)*scene.width/unit) if "heat" in own else
                        lambda *at: (own["lower"](*at) - own["upper"](*at))/2/unit)
    elif heat:
        of_fields["Nu"] = partial(nusselt, scene=scene, heat=heat)
    for name, quantity in of_fields.items():
        record[name] = lambda sums, state, of=quantity: of(sums.method.fields(state))
    return record


def seen(method: Any, state: np.ndarray) -> Fields:
    """Fields of a final state; for smooth particles the smoothed fields, as particles have noise."""
    if not isinstance(method, Spam):
        return method.fields(state)
    sums, ordered, _ = method.look(state)
    at = fields_at(sums, ordered, *state[:2])
    return Fields(state[:2].T, np.stack([at.vx, at.vy], axis=1), at.rho, at.T, method.m/at.rho)


def numbers(scene: Any, history: pd.DataFrame, at: Fields) -> dict[str, Measured]:
    """K and Nu at the end with their errors; `error` if the scene has an answer, growth if it has a wave."""
    at_last = at_end if heating(scene) else lambda series: Measured(float(series[-1]))
    found = {name: at_last(history[name].to_numpy(float)) for name in ("K", "K_particles", "Nu")
             if name in history}
    if exact := answer(scene, at.x):
        at_rest = Fields(at.x, 0*at.v, 0*at.rho + 1, 0*at.T + 1, at.V)
        found["error"] = Measured(apart(at, exact)/apart(at_rest, exact))
    if "wave" in history:
        found["growth"] = Measured(*line(history["t"].to_numpy(), np.log(history["wave"])).slope)
    return found


def at_end(series: np.ndarray) -> Measured:
    """Last value of a steady series, else the mean over the last two fifths of the run, with its error.

    For fewer than FEW samples, of a short run, the error is their whole range.
    """
    late = series[int(LATE*len(series)):]
    if np.ptp(late) <= STEADY*abs(late[-1]):
        return Measured(float(late[-1]), float(np.ptp(late[-max(2, len(late)//4):])))
    return settled(late, AGREE)[0] if len(late) >= FEW else Measured(float(late.mean()), float(np.ptp(late)))


def apart(at: Fields, exact: dict[str, np.ndarray]) -> float:
    """Root mean square over the volume of the difference from the exact answer."""
    have = {"rho": at.rho, "vx": at.v[:, 0], "vy": at.v[:, 1], "T": at.T}
    wrong = sum(at.V@(have[name] - value)**2 for name, value in exact.items())
    return float(np.sqrt(wrong/at.V.sum()))
