"""Your own method: central fluxes between square cells; `make judge METHOD=examples.your_method:Cells`."""
import numpy as np

from continuum.fluid import energy, pressure
from continuum.scene import Torus
from particles.fields import from_densities
from particles.integral.dih import densities
from particles.integral.points import lattice
from particles.method import OwnRates


class Cells(OwnRates):
    names = ("rho", "px", "py", "eps")

    def __init__(self, scene):
        super().__init__(scene)
        self.x = lattice((round(scene.width), round(scene.L))).x

    def state(self, rho, v, T):
        return densities(self.eos, rho, v, T)

    def fields(self, state):
        return from_densities(self.eos, self.x, np.ones(len(self.x)), state[0], state[1:3], state[3])

    def rates(self, state, out):
        scene, at, torus, ends = self.scene, self.fields(state), isinstance(self.scene.sides, Torus), [0, -1]
        f = np.array([at.rho, *at.v.T, at.T]).reshape(4, round(scene.width), round(scene.L))
        f = np.pad(f, ((0, 0), (1, 1), (0, 0)), "wrap")
        rho, u, v, T = np.pad(f, ((0, 0), (0, 0), (1, 1)), "wrap" if torus else "symmetric")
        e, none = energy(self.eos, rho, T), 0*rho
        P = pressure(self.eos, rho, e)
        if not torus:       # images behind plates: nothing passes, the pressure goes on
            v[:, ends], P[:, ends] = -v[:, ends], P[:, ends] + scene.g*rho[:, ends]*[1, -1]
        q = np.array([rho, rho*u, rho*v, rho*(e + (u**2 + v**2)/2)])
        x, y = u*q + np.array([none, P, none, P*u]), v*q + np.array([none, none, P, P*v])
        if not torus:       # friction and heat see the plates' velocity and temperature in between
            u[:, ends] = [0, 2*scene.slide] - u[:, ends]
            T[:, ends] = [2*scene.T_hot, 2*scene.T_cold] - T[:, ends]
        eta, k = scene.law.eta, scene.law.k
        spread = np.array([none, eta*u, eta*v, eta*(u**2 + v**2)/2 + k*T])
        x = (x[:, 1:] + x[:, :-1])/2 - np.diff(spread, axis=1)
        y = (y[..., 1:] + y[..., :-1])/2 - np.diff(spread)
        out[:] = -(np.diff(x, axis=1)[..., 1:-1] + np.diff(y)[:, 1:-1]).reshape(4, -1)
        out[2:] -= scene.g*state[[0, 2]]
