"""The compressible gas of KHP95 as an equation of py-pde, on a staggered grid of its own.

    drho/dt = -div(rho v)
    dv/dt   = -v.grad v + (div sigma - grad P)/rho - g e_y
    de/dt   = -v.grad e + (sigma:grad v - P div v - div Q)/rho

rho and e sit in cells, v_x on their right and v_y on their upper sides: no density is needed at a plate, and
mass is conserved to round-off. Only transport coefficients at a plate want a density: it is extrapolated. The
upper row of v_y lies on the cold plate and stays zero; on a torus, which has no plates, it moves.
"""
from typing import Any

import numpy as np

from continuum.fluid import conductivity, energy, pressure, sound_speed, stress, temperature, valid, viscosity
from continuum.pypde.gas_loop import BULK_VISCOSITY, RHO, VX, VY, E, GasLoop, Mesh
from continuum.scene import Periodic, Torus

# continuum.jit comes before everything that loads numba
# isort: split
from pde import CartesianGrid, FieldCollection, PDEBase, ScalarField, get_backend

NAMES = ("rho", "v_x", "v_y", "e")
RK4_DECAY, RK4_WAVE = 2.78, 2.82    # where RK4's stability region ends on the real and on the imaginary axis
# where a field sits, in cells from the centre: x, y
HALF_UP = np.array([[0, 0], [1, 0], [0, 1], [0, 0]])/2


class Gas(PDEBase):
    """A scene of `continuum.scene` between periodic sides, or on a torus, on `rows` rows of square cells.

    slide : velocity of the cold plate along itself.
    """

    explicit_time_dependence = False

    def __init__(self, scene: Any, rows: int, slide: float = 0.0):
        super().__init__()
        if not isinstance(scene.sides, (Periodic, Torus)):
            raise ValueError(f"sides are {scene.sides!r}: this grid is periodic, take continuum.gas.solve "
                             "for walls")
        columns = round(scene.aspect*rows)
        if rows < 8 or rows % 2 or not np.isclose(columns, scene.aspect*rows):
            raise ValueError(f"rows must be even, at least 8, and times aspect {scene.aspect} a whole "
                             f"number, got {rows}: rolls are counted at mid-height, cells are square")
        self.scene, self.rows, self.h, torus = scene, rows, scene.L/rows, isinstance(scene.sides, Torus)
        sides = [(-scene.width/2, scene.width/2), (-scene.L/2, scene.L/2)]
        self.grid = CartesianGrid(sides, (columns, rows), periodic=(True, torus))
        self.box = Mesh(self.h, scene.g, scene.T_hot, scene.T_cold, float(slide), torus)
        self.loop = GasLoop(scene.eos, scene.law, self.box)
        self._pad = [self._padding(*ghosts) for ghosts in (
            ({"curvature": 0},), ({"value": 0}, {"value": slide}), ({"virtual_point": 0},), ({"curvature": 0},
            ), ({"value": scene.T_hot}, {"value": scene.T_cold}))]

    def _padding(self, bottom: dict, top: dict | None = None):
        """py-pde's function that copies a field and sets its ghosts."""
        across = {"y": "periodic"} if self.box.torus else {"y-": bottom, "y+": top or bottom}
        bcs = self.grid.get_boundary_conditions({"x": "periodic", **across})
        return get_backend("numpy").make_full_data_setter(bcs)

    @property
    def ra(self) -> float:
        return self.scene.ra

    @property
    def pr(self) -> float:
        return self.scene.pr

    @property
    def viscous_time(self) -> float:
        """L^2/nu at density 1."""
        return self.scene.viscous_time

    @property
    def grid_box(self) -> tuple[float, float]:
        """Width and height."""
        return self.scene.width, self.scene.L

    def step_limit(self) -> float:
        """Largest stable step of RK4 at density 1: sound and advection, and decay."""
        scene = self.scene
        c = max(sound_speed(scene.eos, 1.0, energy(scene.eos, 1.0, T)) for T in (scene.T_hot, scene.T_cold))
        wave = (2*np.sqrt(2)*c + scene.free_fall)/self.h
        decay = 8*max(scene.nu, scene.kappa)/self.h**2
        return float(1/(decay/RK4_DECAY + wave/RK4_WAVE))

    def points(self, field: int) -> tuple[np.ndarray, np.ndarray]:
        """x and y of a field's points, the ghosts' included."""
        return tuple(low + self.h*(np.arange(n + 2) - 0.5 + up) for (low, _), n, up in zip(
            self.grid.axes_bounds, self.grid.shape, HALF_UP[field]))

    def mesh(self, field: int) -> tuple[np.ndarray, np.ndarray]:
        """x and y of a field's values, (columns, rows) each."""
        x, y = self.points(field)
        return np.repeat(x[1:-1, None], self.rows, axis=1), np.repeat(y[None, 1:-1], len(x) - 2, axis=0)

    def state(self, data: np.ndarray) -> FieldCollection:
        """Fields of py-pde from an array (4, columns, rows)."""
        return FieldCollection([ScalarField(self.grid, f) for f in data], labels=list(NAMES))

    def rolls(self, ke: float, number: int | None = None) -> np.ndarray:
        """Rolls of kinetic energy `ke` per mass at linear temperature    [KHP95, Sec. VI]"""
        data = np.ones((4, *self.grid.shape))
        data[VX] = self.scene.flow(*self.mesh(VX), ke=ke, rolls=number)[0]
        data[VY] = self.scene.flow(*self.mesh(VY), ke=ke, rolls=number)[1]
        data[VY, :, -1] = 0
        data[E] = energy(self.scene.eos, data[RHO], self.scene.T(self.mesh(E)[1]))
        return data

    def padded(self, data: np.ndarray) -> tuple[np.ndarray, ...]:
        """(rho, v_x, v_y, e, T), each (columns+2, rows+2)."""
        full = np.empty((5, *(n + 2 for n in self.grid.shape)))
        T = temperature(self.scene.eos, data[RHO], data[E])
        for pad, f, ghosts in zip(self._pad, (*data, T), full):
            pad(ghosts, f)
        full[:, [0, -1]] = full[:, [-2, 1]]     # py-pde leaves the corners as they were
        return tuple(full)

    def repaired(self, data: np.ndarray) -> np.ndarray:
        """An interpolated state with the mean density 1 and the cold plate at rest."""
        data[RHO] /= data[RHO].mean()
        data[VY, :, -1] = 0
        return data

    def trouble(self, data: np.ndarray) -> str:
        """What is wrong with a state, if anything, and where."""
        with np.errstate(all="ignore"):
            bad = ~(np.isfinite(data).all(axis=0) & valid(self.scene.eos, data[RHO], data[E]))
        if not bad.any():
            return ""
        i, j = np.argwhere(bad)[0]
        values = ", ".join(f"{name} = {value:.4g}" for name, value in zip(NAMES, data[:, i, j]))
        return f"{values} in cell ({i}, {j}) is not a state of {type(self.scene.eos).__name__}"

    def dx(self, f):
        """Difference of neighbours in x, between them."""
        return (f[1:] - f[:-1])/self.h

    def dy(self, f):
        """Difference of neighbours in y, between them."""
        return (f[:, 1:] - f[:, :-1])/self.h

    def evolution_rate(self, state: Any, t: float = 0) -> Any:
        """The rates in readable form: differences and means of neighbours alternate."""
        rho, u, v, e, T = self.padded(state.data)
        dx, dy, (eos, law) = self.dx, self.dy, (self.scene.eos, self.scene.law)
        P = pressure(eos, rho, e)[1:, 1:]
        eta, k = viscosity(law, rho, T)*np.ones_like(T), conductivity(law, rho, T)*np.ones_like(T)
        slope, strain = dx(v)[:, :-1], dy(u)[:-1]
        sxx, _, syy = stress(eta[1:, 1:], BULK_VISCOSITY, dx(u)[:, 1:], 0, 0, dy(v)[1:])
        sxy = mx(my(eta))*(slope + strain)
        work = ((sxx - P)*dx(u)[:, 1:] + (syy - P)*dy(v)[1:])[:-1, :-1] + mx(my(sxy*(slope + strain)))
        minus_div_q = dx(mx(k)*dx(T))[:, 1:-1] + dy(my(k)*dy(T))[1:-1]
        rate = np.empty_like(state.data)
        rate[RHO] = -dx(mx(rho)*u[:-1])[:, 1:-1] - dy(my(rho)*v[:, :-1])[1:-1]
        rate[VX] = ((dx(sxx - P)[:, :-1] + dy(sxy)[1:])/mx(rho)[1:, 1:-1]
                    - mx(mx(u)*dx(u))[:, 1:-1] - my(mx(v)[:, :-1]*strain)[1:])
        rate[VY] = ((dy(syy - P)[:-1] + dx(sxy)[:, 1:])/my(rho)[1:-1, 1:]
                    - my(my(v)*dy(v))[1:-1] - mx(my(u)[:-1]*slope)[:, 1:] - self.scene.g)
        if not self.box.torus:
            rate[VY, :, -1] = 0
        rate[E] = ((work + minus_div_q)/rho[1:-1, 1:-1]
                   - mx(u[:-1]*dx(e))[:, 1:-1] - my(v[:, :-1]*dy(e))[1:-1])
        return self.state(rate)

    def measure(self, data: np.ndarray) -> tuple[float, float, float]:
        """K, Nusselt number of the lower plate, mean density."""
        rho, u, v = self.padded(data)[:3]
        twice = np.sum(mx(rho)[1:, 1:-1]*u[1:-1, 1:-1]**2 + my(rho)[1:-1, 1:]*v[1:-1, 1:-1]**2)
        return float(twice/2/np.sum(data[RHO])), self.nusselt(data)[0], float(np.mean(data[RHO]))

    def rising(self, data: np.ndarray) -> np.ndarray:
        """v_y at mid-height."""
        return data[VY, :, self.rows//2 - 1]

    def nusselt(self, data: np.ndarray) -> tuple[float, float, float]:
        """Of the plates from the flux that the scheme sends through them, of the volume from the flux of
        energy. One-sided gradients of higher order would be worse: friction heats what is near the plate."""
        full, unit = self.padded(data), self.scene.k*self.scene.dT/self.scene.L
        flux = self._energy_flux(full).mean(axis=0)
        return float(flux[0])/unit, float(flux[-1])/unit, float(np.trapezoid(flux))/self.rows/unit

    def _energy_flux(self, full: tuple[np.ndarray, ...]) -> np.ndarray:
        """Upward flux of energy at the points of v_y: rho v_y (e + P/rho + v^2/2) - (sigma.v)_y - k dT/dy.

        Between periodic sides its mean over x is the same at every y when steady: no mass crosses any level.
        """
        rho, u, v, e, T = full
        eos, law, up = self.scene.eos, self.scene.law, v[1:-1, :-1]
        eta, k = viscosity(law, rho, T)*np.ones_like(T), conductivity(law, rho, T)*np.ones_like(T)
        v2 = mx(my(u))[:-1]**2 + up**2
        carried = up*(my(rho*e + pressure(eos, rho, e)) + 0.5*my(rho)*np.pad(v2, ((1, 1), (0, 0))))[1:-1]
        sxy = mx(my(eta))*(self.dx(v)[:, :-1] + self.dy(u)[:-1])
        _, _, syy = stress(eta[1:, 1:], BULK_VISCOSITY, self.dx(u)[:, 1:], 0, 0, self.dy(v)[1:])
        dragged = mx(sxy*my(u)[:-1]) + up*np.pad(my(syy)[:-1], ((0, 0), (1, 0)))
        return carried - dragged - (my(k)*self.dy(T))[1:-1]

    def fields(self, data: np.ndarray) -> dict[str, np.ndarray]:
        """x, y, rho, v_x, v_y, e, T in cells, each (columns, rows)."""
        rho, u, v, e, T = self.padded(data)
        x, y = self.mesh(RHO)
        inner = {name: f[1:-1, 1:-1] for name, f in (("rho", rho), ("e", e), ("T", T))}
        return {"x": x, "y": y, "v_x": mx(u)[:-1, 1:-1], "v_y": my(v)[1:-1, :-1], **inner}


def mx(f):
    """Mean of neighbours in x, between them."""
    return 0.5*(f[1:] + f[:-1])


def my(f):
    """Mean of neighbours in y, between them."""
    return 0.5*(f[:, 1:] + f[:, :-1])
