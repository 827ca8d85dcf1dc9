"""The differentially heated cavity of de Vahl Davis (1983), with a gas in place of his Boussinesq fluid.

    scene = cavity(rows=32, ra=1e4)
    compared(scene, fields)         # Nu and largest velocities beside the printed numbers
"""
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from continuum.domain import Domain
from continuum.fluid import Fields, IdealGas, energy, expansivity, pressure, sound_speed
from continuum.published import table
from continuum.sides import Plate

NEAR = 16           # points that a quadratic, which has six coefficients, is fitted to
FINE = 4            # places on a mid-plane to a row of points
PRINTED = {"nu_hot": "nu-wall", "nu_middle": "nu-middle", "u_max": "u-max", "v_max": "v-max"}
KNOWN = ("1e3", "1e4", "1e5", "1e6")        # Ra, at Pr 0.71


def cavity(rows: int = 32, ra: float = 1e4, pr: float = 0.71, mach: float = 0.03, dT: float = 0.3) -> Domain:
    """A square of gas of mean temperature 1, hot on the left, cold on the right, adiabatic below and above.

    ra, pr : with kappa = k/(rho c_P), as pressure is all but even. mach : free-fall velocity over sound's.
    A gas that rises cools: by (mach/dT)^2 of dT over the height. That, not the compression of the flow, is
    what differs from a liquid. On 64 rows at Ra 1e4, Nu of the middle and v_max differ from the Boussinesq
    ones, 2.251 and 19.64, by

        mach    dT 0.3            dT 0.1            dT 0.03         in per cent
        0.3     +26    -25        +114   -71        +237   -93
        0.1     +3.1   -2.9       +26    -24        +134   -73
        0.05    +0.7   -0.5       +7.0   -7.0       +60    -47

    which is some 28 (mach/dT)^2 per cent while that is small; dT itself does not show up to 0.3. So take mach
    = dT/10 for 0.3 %; the time for a run goes as 1/mach. Held points err by some (dT/mach)^2/rows^2 besides,
    as they exchange P(rho_a, T_b): by 13 % of Nu at mach = dT/3 with 16 rows, by 45 % at dT/10.

    Raises ValueError: a number is not positive, or dT is not below 2.
    """
    if not (min(ra, pr, mach) > 0 and 0 < dT < 2):
        raise ValueError(f"Ra, Pr, mach and dT must be positive and dT below 2, got {ra}, {pr}, {mach}, "
                         f"{dT}: the mean temperature is 1")
    eos, L = IdealGas(), float(rows)
    alpha, free_fall = expansivity(eos, 1.0, 1.0), mach*float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0)))
    nu = free_fall*L*(pr/ra)**0.5
    return Domain(L=L, left=Plate(T=1 + dT/2), right=Plate(T=1 - dT/2), eta=nu, k=nu/pr*heat_capacity(eos),
                  g=free_fall**2/(alpha*dT*L), eos=eos)


def heat_capacity(eos: IdealGas) -> float:
    """c_P = C_V + 1 per mass."""
    return eos.cv + 1


def diffusivity(scene: Domain) -> float:
    """kappa = k/(rho c_P) at density 1."""
    return scene.k/heat_capacity(scene.eos)


def rayleigh(scene: Domain) -> float:
    """Ra of a cavity."""
    alpha = expansivity(scene.eos, 1.0, scene.T_mean)
    return float(scene.g*alpha*scene.dT*scene.L**3/(scene.eta*diffusivity(scene)))


class CavityNumbers(NamedTuple):
    """Nu of the hot side and of the vertical mid-plane; largest u on that plane and v on the level one, in
    kappa/L: the mean of both directions, which are equal in a liquid."""
    nu_hot: float
    nu_middle: float
    u_max: float
    v_max: float


def observed(scene: Domain, at: Fields) -> CavityNumbers:
    """From fields at points or nodes, as `fields` of a method gives them."""
    s = (np.arange(FINE*round(scene.L)) + 0.5)/(FINE*round(scene.L)) - 0.5
    upright, level = (scene.L*np.stack(pair, axis=1) for pair in ((0*s, s), (s, 0*s)))
    hot, middle = fitted(at, upright - [scene.L/2, 0.0]), fitted(at, upright)
    unit, velocity = scene.k*scene.dT/scene.L, diffusivity(scene)/scene.L
    return CavityNumbers(float(-hot.T_x.mean())*scene.k/unit, heat_through(scene, middle, upright[:, 1])/unit,
                         float(np.ptp(middle.u))/2/velocity, float(np.ptp(fitted(at, level).v))/2/velocity)


def heat_through(scene: Domain, at: "Quadratics", y: np.ndarray) -> float:
    """Mean flux of enthalpy and heat along x. What an even temperature would carry is left out: no mass
    passes."""
    e = energy(scene.eos, at.rho, at.T)
    enthalpy = e + pressure(scene.eos, at.rho, e)/at.rho + (at.u**2 + at.v**2)/2 + scene.g*y
    return float(np.mean(at.rho*at.u*(enthalpy - heat_capacity(scene.eos)*scene.T_mean) - scene.k*at.T_x))


class Quadratics(NamedTuple):
    """Density, velocity, temperature and its slope along x at places."""
    rho: np.ndarray
    u: np.ndarray
    v: np.ndarray
    T: np.ndarray
    T_x: np.ndarray


def fitted(at: Fields, places: np.ndarray) -> Quadratics:
    """By least squares through the points nearest to each place (m, 2): exact for quadratic fields."""
    _, near = cKDTree(at.x).query(places, NEAR)
    x, y = np.moveaxis(at.x[near] - places[:, None], 2, 0)
    terms = np.stack([np.ones_like(x), x, y, x*x, x*y, y*y], axis=2)
    values = np.stack([at.rho, *at.v.T, at.T], axis=1)[near]
    best = np.linalg.pinv(terms)@values
    rho, u, v, T = best[:, 0].T
    return Quadratics(rho, u, v, T, best[:, 1, 3])


def compared(scene: Domain, at: Fields) -> pd.DataFrame:
    """A row a number: found, printed with its uncertainty, spectral; the last three nan at other Ra, Pr."""
    found, ra, pr = observed(scene, at), rayleigh(scene), scene.eta/diffusivity(scene)
    known = table("devahldavis").set_index("id")
    of = next((word for word in KNOWN if np.allclose((ra, pr), (float(word), 0.71))), "none")
    rows = [known.reindex([f"devahldavis-{PRINTED[name]}-{of}"]).iloc[0] for name in found._fields]
    columns = {name: [row[name] for row in rows] for name in ("value", "uncertainty", "spectral")}
    return pd.DataFrame({"found": found, **columns}, index=pd.Index(found._fields, name="number"))
