"""What a run of any method records in a scene, and the numbers that come of it.

K is the kinetic energy per mass, of smooth particles that of the smoothed field; Nu is the heat that passes
through the fluid over what conduction alone would carry. Where a scene knows its answer, `error` is the root
of the mean square difference from it, over that of its own departure from rest.
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
from studies.build.answers import answer, quantities
from studies.build.measure import heat_at_rest
from studies.build.scenes import Slab
from studies.kit.fits import line
from studies.kit.stats import Measured, settled

LATE = 0.6          # of a run: averages are taken after this part of it
STEADY = 1e-3       # of K: what changes less in the last two fifths is steady, and its last value counts
FEW = 20            # samples, of which each half has an error of its own
AGREE = 0.3         # of the mean: halves that differ by more are no steady state


def heating(scene: Any) -> HeatPath | None:
    """None where no two plates have different temperatures."""
    if isinstance(scene, RayleighBenard):
        return None if isinstance(scene, Slab) else HeatPath(1, scene.dT, scene.L)
    return getattr(scene, "heating", None)


def nusselt(at: Fields, scene: Any, heat: HeatPath) -> float:
    """1 + <rho v (e + P/rho + v^2/2 + g y)>/(k dT/length), along the heat; friction's share is left out.

    Of steady flows and constant conductivity, where what plates conduct is k dT/length on average.
    """
    e = energy(scene.eos, at.rho, at.T)
    head = e + pressure(scene.eos, at.rho, e)/at.rho + (at.v**2).sum(axis=1)/2 + scene.g*at.x[:, 1]
    carried = at.V@(at.rho*at.v[:, heat.axis]*head)/at.V.sum()
    return 1 + float(carried)*heat.length/(scene.law.k*heat.dT)


def recorded(scene: Any, variant: Any) -> dict[str, Callable]:
    """Quantities of a run by their names in its history: K, Nu where heat passes, and the scene's own.

    Nu of convection is that of the variant's own series: of heat through the volume of smooth particles, or
    through the plates.
    """
    own, heat, of_fields = getattr(variant, "series", {}), heating(scene), dict(quantities(scene))
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
    """Fields at the end; of smooth particles the smoothed ones, as particles themselves tremble."""
    if not isinstance(method, Spam):
        fields: Fields = method.fields(state)
        return fields
    sums, ordered, _ = method.look(state)
    at = fields_at(sums, ordered, *state[:2])
    return Fields(state[:2].T, np.stack([at.vx, at.vy], axis=1), at.rho, at.T, method.m/at.rho)


def numbers(scene: Any, history: pd.DataFrame, at: Fields) -> dict[str, Measured]:
    """K and Nu of the steady end with their errors; `error` and rates where the scene knows them."""
    at_last = at_end if heating(scene) else last
    found = {name: at_last(history[name].to_numpy(float)) for name in ("K", "K_particles", "Nu")
             if name in history}
    if exact := answer(scene, at.x):
        at_rest = Fields(at.x, 0*at.v, 0*at.rho + 1, 0*at.T + 1, at.V)
        found["error"] = Measured(apart(at, exact)/apart(at_rest, exact))
    if "wave" in history:
        found["growth"] = Measured(*line(history["t"].to_numpy(), np.log(history["wave"])).slope)
    return found


def last(series: np.ndarray) -> Measured:
    """The last value, of what is not steady."""
    return Measured(float(series[-1]))


def at_end(series: np.ndarray) -> Measured:
    """The last value of what is steady, else the mean over the last two fifths, with its error.

    Few samples, of a short run, have their whole range for an error.
    """
    late = series[int(LATE*len(series)):]
    if np.ptp(late) <= STEADY*abs(late[-1]):
        return Measured(float(late[-1]), float(np.ptp(late[-max(2, len(late)//4):])))
    return settled(late, AGREE)[0] if len(late) >= FEW else Measured(float(late.mean()), float(np.ptp(late)))


def apart(at: Fields, exact: dict[str, np.ndarray]) -> float:
    """Root of the mean square over the volume of what differs from the answer."""
    have = {"rho": at.rho, "vx": at.v[:, 0], "vy": at.v[:, 1], "T": at.T}
    wrong = sum(at.V@(have[name] - value)**2 for name, value in exact.items())
    return float(np.sqrt(wrong/at.V.sum()))
