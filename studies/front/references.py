"""Reference solvers without our time stepping: Newton's method for two fluids, py-pde, linear theory.

Each takes the layer heated from below, by name or as a `Domain`, and returns parts of a `Solution`. All but
py-pde and spectral-gas solve the Boussinesq fluid nearest to the gas. Of the temperature difference of a
layer of gas only the share s = 1 - g L/(c_P dT), beyond the adiabatic gradient g/c_P, drives convection. Heat
diffuses at constant pressure, gamma times slower than k/(rho C_V). So the Boussinesq fluid has Ra' = s gamma
Ra, Pr' = gamma Pr, and the gas has K = s K', Nu - 1 = s (Nu' - 1), good to 5 % at dT = 1.
"""
from collections.abc import Callable
from dataclasses import dataclass
from time import process_time
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from continuum.boussinesq import BoussinesqCase, Box, State, steady
from continuum.domain import Domain
from continuum.fluid import Fields, IdealGas, conductivity, expansivity, temperature, viscosity
from continuum.linear import critical_ra, growth_rate
from continuum.pypde.gas import Gas
from continuum.pypde.solve import PdeSolution
from continuum.pypde.solve import solve as solve_pde
from continuum.scene import RayleighBenard
from continuum.spectral.laws import GasLaws
from continuum.spectral.newton import steady as spectral
from particles.integral.points import lattice
from studies.build.setting import no_still_layer
from studies.kit.stats import Measured

Parts = dict[str, Any]


def solved(name: str, scene: Any) -> Parts:
    """Parts of a solution by the named reference. Raises ValueError: it does not solve this scene."""
    if not isinstance(scene, (RayleighBenard, Domain)):
        raise ValueError(f"{name} solves Rayleigh-Benard convection, not {type(scene).__name__}: take grid")
    odd = no_still_layer(scene)
    if scene.dT <= 0 or not scene.g > 0:
        odd = odd or f"T_hot = {scene.T_hot}, T_cold = {scene.T_cold}, g = {scene.g}"
    if odd:
        raise ValueError(f"{name} takes a layer heated from below, periodic sides, not {odd}: take grid")
    if name != "py-pde" and not isinstance(scene.eos, IdealGas):
        raise ValueError(f"{name} stands for an ideal gas, not for {type(scene.eos).__name__}: take grid")
    began = process_time()
    parts = REFERENCES[name](scene)
    return {"cpu_s": process_time() - began, "history": pd.DataFrame({"t": [0.0]}), **parts}


@dataclass(frozen=True, kw_only=True)
class Weighted(RayleighBenard):
    """The layer with a gravity of its own, which need not balance the heating."""
    weight: float

    @property
    def g(self) -> float:
        return self.weight


def weighted(box: Domain) -> Weighted:
    """A layer from a box heated from below: it has a free-fall velocity and a viscous time."""
    kappa, alpha = box.k/float(box.eos.cv), float(expansivity(box.eos, 1.0, box.T_mean))
    ra = box.g*alpha*box.dT*box.L**3/(box.eta*kappa)
    return Weighted(ra=ra, pr=box.eta/kappa, eos=box.eos, L=box.L, aspect=box.aspect, T_hot=box.T_hot,
                    T_cold=box.T_cold, weight=box.g)


def py_pde(layer: Any) -> Parts:
    """The compressible gas by py-pde, from initial rolls to a steady state."""
    scene = weighted(layer) if isinstance(layer, Domain) else layer
    done = solve_pde(Gas(scene, round(scene.L)))
    numbers = {"K": Measured(done.ke, done.ke_err), "Nu": Measured(done.nu, abs(np.diff(done.nusselt)[0]))}
    times = done.series.t*scene.free_fall/scene.L
    history = pd.DataFrame({"t": times, "K": done.series.ke, "Nu": done.series.nu})
    return {"numbers": numbers, "history": history, "at": of_pde(done), "dt": done.dt, "steps": done.steps,
            "cpu_s": done.cpu_s}


def spectral_gas(layer: Any) -> Parts:
    """Steady state of the gas in as many waves and polynomials as the layer has rows; fields are at the
    quadrature points of one half, and their mirror image."""
    scene = weighted(layer) if isinstance(layer, Domain) else layer
    state = spectral(GasLaws(scene), round(scene.L))
    (x, y), (u, v, r, T) = (state.equations.x.points[:, None], state.equations.y.points), state.at[:, 0]
    L, T = scene.L, T + scene.T(scene.L*y)
    return {"numbers": {"K": Measured(state.K), "Nu": Measured(state.Nu)},
            "at": flat([L*x, -L*x], L*y, [u, -u], v, 1 + r, T, L**2*state.equations.weights)}


def of_pde(done: PdeSolution) -> Fields:
    """Fields at the centres of cells, from staggered velocities."""
    gas: Any = done.equation
    rho, vx, vy, e, *_ = gas.padded(done.state)
    u, v = (vx[:-1] + vx[1:])[:, 1:-1]/2, (vy[:, :-1] + vy[:, 1:])[1:-1]/2
    rho, e = rho[1:-1, 1:-1], e[1:-1, 1:-1]
    columns, rows = rho.shape
    return flat(*gas.mesh(0), u[:columns], v[:, :rows], rho, temperature(gas.scene.eos, rho, e), gas.h**2)


def flat(*fields: Any) -> Fields:
    """Fields from x, y, u, v, rho, T, V, arrays that are broadcast to one shape."""
    x, y, u, v, *others = map(np.ravel, np.broadcast_arrays(*fields))
    return Fields(np.stack([x, y], axis=1), np.stack([u, v], axis=1), *others)


def boussinesq(scene: Any) -> Parts:
    """Steady state by Newton's method: one roll between planes of symmetry, half of the layer."""
    near = nearest(scene)
    state = steady(BoussinesqCase(ra=near.ra, pr=near.pr, rows=round(scene.L), box=Box(width=scene.aspect/2)))
    seen = state.observe()
    numbers = {"K": Measured(seen.K*near.speed**2), "Nu": Measured(1 + near.share*(seen.nu_bottom - 1))}
    return {"numbers": numbers, "at": of_state(scene, state, near)}


class Nearest(NamedTuple):
    """Nearest Boussinesq fluid: share of dT that drives it, Ra, Pr, free-fall velocity; gamma of the gas."""
    share: float
    ra: float
    pr: float
    speed: float
    gamma: float


def nearest(scene: Any) -> Nearest:
    """Boussinesq fluid nearest to a layer of ideal gas with density 1 and thermal expansivity 1/T."""
    cp, eta = float(scene.eos.cv) + 1, float(viscosity(scene.law, 1.0, scene.T_mean))
    kappa = float(conductivity(scene.law, 1.0, scene.T_mean))/cp
    share = 1 - scene.g*scene.L/(cp*scene.dT)
    speed = np.sqrt(share*scene.g*scene.dT*scene.L/scene.T_mean)
    return Nearest(share, (speed*scene.L)**2/(eta*kappa), eta/kappa, speed, cp/(cp - 1))


def of_state(scene: Any, state: State, near: Nearest) -> Fields:
    """Fields in cells of the half that was solved and of its mirror image; T is that of the gas."""
    u, v, T = state.parts
    u, v = np.pad(u, ((1, 1), (0, 0))), np.pad(v, ((0, 0), (1, 1)))     # walls and planes of symmetry
    u, v = (u[:-1] + u[1:])/2, (v[:, :-1] + v[:, 1:])/2
    x, y = np.meshgrid(*state.case.mac.points[2], indexing="ij")
    y = y - 0.5
    T = scene.T_mean + scene.dT*(near.share*T - (1 - near.share)*y)
    L, speed, cell = scene.L, near.speed, state.case.mac.cell*scene.aspect/2
    return flat([L*x, -L*x], L*y, [speed*u, -speed*u], speed*v, 1.0, T, L**2*cell)


def linear_theory(scene: Any) -> Parts:
    """Critical Ra and growth rate of a pair of rolls as wide as the layer."""
    near, k = nearest(scene), 2*np.pi/scene.aspect
    numbers = {"Ra_c": Measured(critical_ra(k)/near.share/near.gamma),
               "growth": Measured(growth_rate(ra=near.ra, pr=near.pr, k=k)*np.sqrt(near.share))}
    x, y = lattice((round(scene.width), round(scene.L))).x.T
    T = scene.T_mean - scene.dT*y/scene.L
    return {"numbers": numbers, "at": flat(x, y, 0.0, 0.0, 1.0, T, 1.0)}


REFERENCES: dict[str, Callable] = {"py-pde": py_pde, "boussinesq": boussinesq, "linear-theory": linear_theory,
                                   "spectral-gas": spectral_gas}
