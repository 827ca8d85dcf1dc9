"""Your own method: central differences between square cells; your_method.md says what each part is for."""
import numpy as np

from continuum.fluid import energy, pressure
from continuum.scene import Torus
from examples import picture, sized
from particles.method import LatticeRates
from studies.front import solve

ENDS = [0, -1]      # rows of images behind the lower and the upper plate


class Cells(LatticeRates):
    def rates(self, state, out):
        scene, at, plates = self.scene, self.fields(state), not isinstance(self.scene.sides, Torus)
        f = np.array([at.rho, *at.v.T, at.T]).reshape(4, round(scene.width), round(scene.L))
        f = np.pad(f, ((0, 0), (1, 1), (0, 0)), "wrap")
        rho, u, v, T = np.pad(f, ((0, 0), (0, 0), (1, 1)), "symmetric" if plates else "wrap")
        e, none = energy(self.eos, rho, T), 0*rho
        P = pressure(self.eos, rho, e)
        if plates:      # nothing passes, the pressure goes on
            v[:, ENDS], P[:, ENDS] = -v[:, ENDS], P[:, ENDS] + scene.g*rho[:, ENDS]*[1, -1]
        q = np.array([rho, rho*u, rho*v, rho*(e + (u**2 + v**2)/2)])
        x, y = u*q + np.array([none, P, none, P*u]), v*q + np.array([none, none, P, P*v])
        if plates:      # half-way to its image friction and heat see the plate
            u[:, ENDS] = [0, 2*scene.slide] - u[:, ENDS]
            T[:, ENDS] = [2*scene.T_hot, 2*scene.T_cold] - T[:, ENDS]
        s = scene.law.eta*np.array([none, u, v, (u**2 + v**2)/2])
        s[3] += scene.law.k*T
        net = (x[:, 2:, 1:-1] - x[:, :-2, 1:-1] + y[:, 1:-1, 2:] - y[:, 1:-1, :-2])/2
        around = s[:, 2:, 1:-1] + s[:, :-2, 1:-1] + s[:, 1:-1, 2:] + s[:, 1:-1, :-2]
        out[:] = (around - 4*s[:, 1:-1, 1:-1] - net).reshape(4, -1)
        out[2:] -= scene.g*state[[0, 2]]


if __name__ == "__main__":
    solve("rayleigh-benard", Cells, rows=sized(24, 8), time=sized(90, 5)).plot(picture("your_method"))
