"""Solvers that need no steps in time of ours: Newton on the Boussinesq equations, py-pde, linear theory.

They take the layer heated from below, Boussinesq the cavity, too; where they cannot take a scene they say so.
"""
from time import process_time
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from continuum.boussinesq import HALF_LAYER, BoussinesqCase, State, steady
from continuum.fluid import IdealGas, temperature
from continuum.linear.layer import critical_ra, growth_rate
from continuum.pypde.gas import Gas
from continuum.pypde.solve import PdeSolution
from continuum.pypde.solve import solve as solve_pde
from continuum.scene import Periodic, RayleighBenard
from studies.build.scenes import Slab
from studies.front.solution import Solution
from studies.kit.stats import Measured


class Refused(ValueError):
    """A method that cannot take a scene."""


def check_layer(name: str, scene: Any) -> None:
    """Refuse all but the layer between periodic sides."""
    if not isinstance(scene, RayleighBenard) or isinstance(scene, Slab):
        raise Refused(f"{name} solves Rayleigh-Benard convection, not {type(scene).__name__}: take grid")
    if not isinstance(scene.sides, Periodic):
        raise Refused(f"{name} takes periodic sides, got {scene.sides}: take grid or spam")


class PyPde(NamedTuple):
    """The compressible gas by py-pde, until it is steady."""
    name: str = "py-pde"

    def solved(self, scene: Any, name: str, seed: int) -> Solution:
        check_layer(name, scene)
        done = solve_pde(Gas(scene, round(scene.L)))
        apart = abs(done.nusselt[0] - done.nusselt[1])
        found = {"K": Measured(done.ke, done.ke_err), "Nu": Measured(done.nu, apart)}
        times = done.series.t*scene.free_fall/scene.L
        history = pd.DataFrame({"t": times, "K": done.series.ke, "Nu": done.series.nu})
        return Solution(scene=scene, method=name, rows=round(scene.L), seed=seed, numbers=found,
                        history=history, places=of_pde(done), dt=done.dt, steps=done.steps, cpu_s=done.cpu_s,
                        compile_s=done.compile_s)


def of_pde(done: PdeSolution) -> pd.DataFrame:
    """Fields in the middle of cells."""
    gas: Any = done.equation
    rho, vx, vy, e, *_ = gas.padded(done.state)
    u, v = (vx[:-1] + vx[1:])[:, 1:-1]/2, (vy[:, :-1] + vy[:, 1:])[1:-1]/2
    inner = [q[1:-1, 1:-1] for q in (rho, e)]
    x, y = gas.mesh(0)
    T = temperature(gas.scene.eos, *inner)
    return columns(x, y, u[:rho.shape[0] - 2], v[:, :rho.shape[1] - 2], inner[0], T, gas.h**2)


def columns(*values: Any) -> pd.DataFrame:
    """x, y, vx, vy, rho, T, V as columns."""
    names, same = ("x", "y", "vx", "vy", "rho", "T", "V"), np.broadcast_arrays(*values)
    return pd.DataFrame({name: np.array(value).ravel() for name, value in zip(names, same, strict=True)})


class Boussinesq(NamedTuple):
    """The Boussinesq fluid that a gas is nearest to, in a steady state, by Newton's method.

    A layer of gas has the adiabatic gradient g/c_P; the share s = 1 - g L/(c_P dT) of dT is left to
    convection. Heat spreads at constant pressure, gamma times slower than k/(rho C_V). So Ra is s gamma Ra,
    Pr is gamma Pr, K = s K' and Nu - 1 = s (Nu' - 1) of the fluid's K', Nu', good to some 5 % at dT = 1.
    """
    name: str = "boussinesq"

    def solved(self, scene: Any, name: str, seed: int) -> Solution:
        check_layer(name, scene)
        if not isinstance(scene.eos, IdealGas):
            raise Refused(f"{name} stands for an ideal gas, not for {type(scene.eos).__name__}: take grid")
        began, (share, gamma) = process_time(), left_to_convection(scene)
        case = BoussinesqCase(ra=share*gamma*scene.ra, pr=gamma*scene.pr, rows=round(scene.L),
                              box=half_of(scene))
        state = steady(case)
        seen = state.observe()
        apart = abs(seen.nu_top - seen.nu_bottom)
        found = {"K": Measured(share*seen.K*scene.free_fall**2),
                 "Nu": Measured(1 + share*(seen.nu_bottom - 1), share*apart)}
        return Solution(scene=scene, method=name, rows=round(scene.L), seed=seed, numbers=found,
                        history=pd.DataFrame({"t": [0.0]}), places=of_state(scene, state, share),
                        cpu_s=process_time() - began)


def half_of(scene: RayleighBenard) -> Any:
    """Half of a layer as wide as two rolls: one roll between planes of symmetry."""
    return HALF_LAYER if scene.aspect == 2 else type(HALF_LAYER)(width=scene.aspect/2)


def left_to_convection(scene: RayleighBenard) -> tuple[float, float]:
    """(s, gamma): the share of dT beyond the adiabatic gradient, and c_P/C_V."""
    cv = float(scene.eos.cv)
    return 1 - scene.g*scene.L/((cv + 1)*scene.dT), (cv + 1)/cv


def of_state(scene: RayleighBenard, state: State, share: float) -> pd.DataFrame:
    """Fields in cells, with the mirror image of the half that was solved; T is the gas's own."""
    u, v, T = state.parts
    u, v = np.pad(u, ((1, 1), (0, 0))), np.pad(v, ((0, 0), (1, 1)))     # walls and planes of symmetry
    u, v = (u[:-1] + u[1:])/2, (v[:, :-1] + v[:, 1:])/2
    x, y = np.meshgrid(*state.case.mac.points[2], indexing="ij")
    x, y, L, free_fall = x*scene.L, (y - 0.5)*scene.L, scene.L, scene.free_fall*np.sqrt(share)
    T = scene.T_mean + scene.dT*(share*T + (1 - share)*-y/L)
    cell = L**2*state.case.mac.cell*scene.aspect/2
    halves = [columns(sign*x, y, sign*free_fall*u, free_fall*v, 1.0, T, cell) for sign in (1, -1)]
    return pd.concat(halves, ignore_index=True)


class LinearTheory(NamedTuple):
    """Onset of the Boussinesq layer as wide as two rolls: where convection begins, and whether it does."""
    name: str = "linear-theory"

    def solved(self, scene: Any, name: str, seed: int) -> Solution:
        check_layer(name, scene)
        began, k = process_time(), 2*np.pi/scene.aspect
        share, gamma = left_to_convection(scene)
        rate = growth_rate(ra=share*gamma*scene.ra, pr=gamma*scene.pr, k=k)*np.sqrt(share)
        found = {"Ra_c": Measured(critical_ra(k)/(share*gamma)), "growth": Measured(rate)}
        return Solution(scene=scene, method=name, rows=round(scene.L), seed=seed, numbers=found,
                        history=pd.DataFrame({"t": [0.0]}), places=at_rest(scene),
                        cpu_s=process_time() - began)


def at_rest(scene: RayleighBenard) -> pd.DataFrame:
    """The layer without motion, on a lattice."""
    x, y = np.meshgrid(np.arange(scene.width) + 0.5 - scene.width/2, np.arange(scene.L) + 0.5 - scene.L/2)
    return columns(x, y, 0.0, 0.0, 1.0, scene.T(y), 1.0)


REFERENCES = {one.name: one for one in (PyPde(), Boussinesq(), LinearTheory())}
