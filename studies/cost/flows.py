"""Flows with exact answers as contests: a scene of a size, and how far fields at the end are from the answer.

taylor-green   a vortex of Mach 0.05 and Re 100 that decays by e; against the gas of that Mach number
sound          a wave of small amplitude for two periods
conduction, couette   between plates, from smooth starts; nothing depends on x
"""
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from continuum.exact.plates import COARSER, FLOWS
from continuum.exact.plates import fields as answer_between
from continuum.exact.vortex import DECAYS, solved, velocities
from particles.integral.points import lattice
from particles.observe import fields_at
from particles.smooth.spam import Spam
from studies.build.names import START_JITTER
from studies.build.scenes import BetweenPlates, Sound, TaylorGreen, between_plates
from studies.build.setting import shifted
from studies.cost.problem import Residuals, relative

#: uncertainty of the Fourier sums by Mach number, from the study ordering: velocities of 33 against 29 points
KNOWN = {0.05: 1.4e-6, 0.2: 2.9e-5}
KNOWN_SOUND = 1e-4


#: where smooth particles start, (n, 2), and (rho, v, T) of them
Places = tuple[np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray]]


class Vortex(NamedTuple):
    """The Taylor-Green vortex; `velocity` and the `decay` of K."""
    mach: float = 0.05

    @property
    def known(self) -> float:
        return KNOWN[self.mach]

    def scene(self, size: int) -> TaylorGreen:
        return TaylorGreen(L=size, mach=self.mach)

    def residuals(self, scene: TaylorGreen, at: Any) -> Residuals:
        """Of fields at the end."""
        return self.against(scene, at.V, velocities(solved(self.mach), at.x/scene.L), at.v)

    def against(self, scene: TaylorGreen, V: np.ndarray, exact: np.ndarray, v: np.ndarray) -> Residuals:
        """Velocities (n, 2) of volumes V against exact ones in units of the speed."""
        measured = v/scene.speed
        scale = np.sqrt(2*len(V)/(V@(exact**2).sum(axis=1)))
        start = float(V.sum()/2)        # of v^2 in units of the speed, at the start
        decay = np.log(start/float(V@(measured**2).sum(axis=1)))/(2*DECAYS)
        return {"velocity": (np.sqrt(V)[:, None]*(measured - exact)*scale).ravel(),
                "decay": np.array([decay/solved(self.mach).decay - 1])}

    def places(self, scene: TaylorGreen, seed: int) -> Places:
        """A jittered lattice."""
        x = shifted(scene.L, scene.L, START_JITTER, seed)
        return x, scene.fields(x)

    def particles(self, method: Spam, state: np.ndarray) -> Any:
        """The smoothed field where the particles are: they tremble    [KHP95, Sec. VI]"""
        sums, ordered, _ = method.look(state)
        at = fields_at(sums, ordered, *state[:2])
        return alike(method, state)._replace(v=np.stack([at.vx, at.vy], axis=1))


class Wave(NamedTuple):
    """Sound; `velocity` and `temperature`."""
    known: float = KNOWN_SOUND

    def scene(self, size: int) -> Sound:
        return Sound(width=size)

    def residuals(self, scene: Sound, at: Any) -> Residuals:
        """Of fields at the end."""
        x = at.x[:, 0]
        return self.against(scene, at.V, (x, at.v[:, 0]), (x, at.T))

    def against(self, scene: Sound, V: np.ndarray, u: tuple, T: tuple) -> Residuals:
        """Velocities and temperatures, each (x, values): a staggered grid has them at different places."""
        exact_u, exact_T = scene.exactly(scene.time, u[0])[1], scene.exactly(scene.time, T[0])[2]
        return {"velocity": relative(V, u[1] - exact_u, exact_u),
                "temperature": relative(V, T[1] - 1 - exact_T, exact_T)}

    def places(self, scene: Sound, seed: int) -> Places:
        """A lattice that is displaced as the density at the start wants it, with the fields of the lattice."""
        x = lattice((scene.width, scene.L)).x
        fields = scene.fields(x)
        x[:, 0] -= scene.amplitude/scene.k*np.sin(scene.k*x[:, 0])
        return x, fields

    def particles(self, method: Spam, state: np.ndarray) -> Any:
        return alike(method, state)


class Plates(NamedTuple):
    """Heat or shear between plates: the `velocity` along them, or the `temperature` relative to what differs from 1."""
    name: str

    @property
    def known(self) -> float:
        return uncertainty(self.name)

    def scene(self, size: int) -> BetweenPlates:
        return between_plates(self.name, size)

    def residuals(self, scene: BetweenPlates, at: Any) -> Residuals:
        """Of fields at the end."""
        return self.against(scene, at.V, at.x[:, 1]/scene.L + 0.5, at.v[:, 0], at.T)

    def against(self, scene: BetweenPlates, V: np.ndarray, s: np.ndarray, u: np.ndarray, T: np.ndarray) -> Residuals:
        """At heights s from 0 to 1."""
        _, _, exact_u, exact_T = answer_between(scene.flow, s)
        if scene.slide:
            return {"velocity": relative(V, u - exact_u, exact_u)}
        return {"temperature": relative(V, T - exact_T, exact_T - 1)}

    def places(self, scene: BetweenPlates, seed: int) -> Places:
        """A lattice whose rows are as far apart as the density at the start wants them."""
        x, s = lattice((scene.width, scene.L)).x, np.linspace(0, 1, 2001)
        rho = scene.flow.start(s)[0]
        mass = np.r_[0, np.cumsum((rho[1:] + rho[:-1])/2*np.diff(s))]
        heights = np.interp((np.arange(scene.L) + 0.5)/scene.L*mass[-1], mass, s)
        row = np.round(x[:, 1] + scene.L/2 - 0.5).astype(int)
        x[:, 1] = scene.L*(heights[row] - 0.5)
        return x, scene.fields(x)

    def particles(self, method: Spam, state: np.ndarray) -> Any:
        return alike(method, state)


@cache
def uncertainty(name: str) -> float:
    """Of the answer between plates: what fewer Chebyshev points make of the velocity or the temperature."""
    flow, s = FLOWS[name], np.linspace(0, 1, 200)
    row = 2 if flow.U else 3
    fine, coarse = answer_between(flow, s)[row], answer_between(flow, s, COARSER)[row]
    return float(np.sqrt(np.mean((fine - coarse)**2)/np.mean((fine - fine.mean())**2)))


def alike(method: Spam, state: np.ndarray) -> Any:
    """Fields of particles, each of which counts as much."""
    return method.fields(state)._replace(V=np.ones(state.shape[1]))
