"""The compressible gas of KHP95 as a py-pde equation, on another staggered grid than `continuum.gas`.

    drho/dt = -div(rho v)
    dv/dt   = -v.grad v + (div sigma - grad P)/rho - g e_y
    de/dt   = -v.grad e + (sigma:grad v - P div v - div Q)/rho

rho and e sit in cells, v_x on their right and v_y on their upper sides: mass needs no density at a plate and
is conserved to round-off. Only transport coefficients at a plate need a density, which is extrapolated. The
upper row of v_y lies on the cold plate and stays zero; on a torus, without plates, it is stepped.
"""
from typing import Any

import numpy as np
from pde import CartesianGrid, FieldCollection, PDEBase, ScalarField

from continuum.fluid import energy, sound_speed, valid
from continuum.pypde.gas_loop import RHO, VX, VY, E, Mesh, coefficients, fill, rate
from continuum.scene import ROLL_ENERGY, Periodic, Torus, columns_of
from continuum.steady import RK4_DECAY, RK4_SOUND

# offset (x, y) of each field from the centre of its cell, in cells
HALF_UP = np.array([[0, 0], [1, 0], [0, 1], [0, 0]])/2


class Gas(PDEBase):
    """A scene of `continuum.scene` between periodic sides, or on a torus, on `rows` rows of square cells."""

    explicit_time_dependence = False
    names = ("rho", "v_x", "v_y", "e")

    def __init__(self, scene: Any, rows: int):
        super().__init__()
        if not isinstance(scene.sides, (Periodic, Torus)):
            raise ValueError(f"sides are {scene.sides!r}: this grid is periodic, take continuum.gas.solve "
                             "for walls")
        columns, torus = columns_of(scene.aspect, rows), isinstance(scene.sides, Torus)
        self.scene, self.rows, self.h = scene, rows, scene.L/rows
        sides = [(-scene.width/2, scene.width/2), (-scene.L/2, scene.L/2)]
        self.grid = CartesianGrid(sides, (columns, rows), periodic=(True, torus))
        self.loop = scene.eos, scene.law, Mesh(self.h, scene.g, scene.T_hot, scene.T_cold, torus)

    def evolution_rate(self, state: Any, t: float = 0) -> Any:
        """Rates of change, as py-pde's own steppers call them."""
        return self.state(rate(self.loop, np.ascontiguousarray(state.data)))

    def state(self, data: np.ndarray) -> FieldCollection:
        """py-pde's fields from an array (fields, columns, rows)."""
        return FieldCollection([ScalarField(self.grid, f) for f in data], labels=list(self.names))

    def step_limit(self) -> float:
        """Largest stable time step of RK4 at density 1, from sound, advection and diffusion."""
        scene = self.scene
        c = max(sound_speed(scene.eos, 1.0, energy(scene.eos, 1.0, T)) for T in (scene.T_hot, scene.T_cold))
        wave = (2*np.sqrt(2)*c + scene.free_fall)/self.h
        decay = 8*max(scene.nu, scene.kappa)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_SOUND))

    def points(self, field: int) -> tuple[np.ndarray, np.ndarray]:
        """Grid coordinates x, y of a field, ghosts included."""
        return tuple(low + self.h*(np.arange(n + 2) - 0.5 + up) for (low, _), n, up in zip(
            self.grid.axes_bounds, self.grid.shape, HALF_UP[field]))

    def mesh(self, field: int) -> tuple[np.ndarray, ...]:
        """x and y of a field's values, each (columns, rows)."""
        return tuple(np.meshgrid(*(axis[1:-1] for axis in self.points(field)), indexing="ij"))

    def rolls(self, ke: float = ROLL_ENERGY) -> np.ndarray:
        """Initial rolls of kinetic energy `ke` per mass with linear temperature    [KHP95, Sec. VI]"""
        data = np.ones((4, *self.grid.shape))
        data[VX] = self.scene.flow(*self.mesh(VX), ke=ke)[0]
        data[VY] = self.scene.flow(*self.mesh(VY), ke=ke)[1]
        data[VY, :, -1] = 0
        data[E] = energy(self.scene.eos, data[RHO], self.scene.T(self.mesh(E)[1]))
        return data

    def padded(self, data: np.ndarray) -> np.ndarray:
        """(rho, v_x, v_y, e, T, eta, k) with ghosts, each (columns+2, rows+2)."""
        (eos, law, box), full = self.loop, np.empty((10, *(n + 2 for n in self.grid.shape)))
        fill(box, data, full)
        coefficients(eos, law, box, full)
        return full[:7]

    def repaired(self, data: np.ndarray) -> np.ndarray:
        """Restore mean density 1 and rest of the cold plate in an interpolated state, in place."""
        data[RHO] /= data[RHO].mean()
        data[VY, :, -1] = 0
        return data

    def trouble(self, data: np.ndarray) -> str:
        """Message on the first invalid cell of a state; empty if all are valid."""
        with np.errstate(all="ignore"):
            bad = ~(np.isfinite(data).all(axis=0) & valid(self.scene.eos, data[RHO], data[E]))
        if not bad.any():
            return ""
        i, j = np.argwhere(bad)[0]
        values = ", ".join(f"{name} = {value:.4g}" for name, value in zip(self.names, data[:, i, j]))
        return f"{values} in cell ({i}, {j}) is not a state of {type(self.scene.eos).__name__}"

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """K, Nusselt number of the lower plate, mean density."""
        rho, u, v = self.padded(data)[:3]
        right, up = (rho[1:] + rho[:-1])/2, (rho[:, 1:] + rho[:, :-1])/2
        twice = np.sum(right[1:, 1:-1]*u[1:-1, 1:-1]**2 + up[1:-1, 1:]*v[1:-1, 1:-1]**2)
        return float(twice/2/np.sum(data[RHO])), self.nusselt(data)[0], float(np.mean(data[RHO]))

    def nusselt(self, data: np.ndarray) -> tuple[float, float]:
        """Nusselt numbers of the lower and the upper plate, from the scheme's own heat flux. One-sided
        gradients of higher order would be worse, because of viscous heating near the plate."""
        *_, T, _, k = self.padded(data)
        down = ((k[:, 1:] + k[:, :-1])/2*(np.diff(T)/self.h))[1:-1].mean(axis=0)
        unit = self.scene.k*self.scene.dT/self.scene.L
        return -float(down[0])/unit, -float(down[-1])/unit
