"""The differentially heated cavity of de Vahl Davis (1983), with a gas in place of his Boussinesq fluid.

    scene = cavity(rows=32, ra=1e4)
    compared(scene, fields)         # Nu and largest velocities beside the printed numbers
"""
import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from continuum.domain import Domain
from continuum.fluid import Fields, IdealGas, energy, expansivity, sound_speed
from continuum.published import table
from continuum.sides import Plate

NEAR = 16           # nearest points to which a quadratic, with six coefficients, is fitted
FINE = 4            # places on a mid-plane per row of points
PRINTED = {"nu_hot": "nu-wall", "nu_middle": "nu-middle", "u_max": "u-max", "v_max": "v-max"}
KNOWN = ("1e3", "1e4", "1e5", "1e6")        # Ra, at Pr 0.71


def cavity(rows: int = 32, ra: float = 1e4, pr: float = 0.71, mach: float = 0.03, dT: float = 0.3) -> Domain:
    """A square of gas of mean temperature 1, hot on the left, cold on the right, adiabatic below and above.

    ra, pr : with kappa = k/(rho c_P), as the pressure is almost uniform. mach : free-fall velocity over the
    speed of sound. A rising gas cools by (mach/dT)^2 of dT over the height: this, not the compressibility of
    the flow, makes the difference to a liquid. With 64 rows at Ra 1e4, Nu of the mid-plane and v_max differ
    from the Boussinesq values by about 28 (mach/dT)^2 per cent, u_max by 38, while these are small; dT itself
    has no visible effect up to 0.3. So take mach = dT/10 for 0.3 %; the cost of a run grows as 1/mach. Points
    that stay have a further error of about (dT/mach)^2/rows^2, as they exchange P(rho_a, T_b): 13 % of Nu at
    mach = dT/3 with 16 rows, 45 % at dT/10.

    Raises ValueError: a number is not positive, or dT is not below 2.
    """
    if not (min(ra, pr, mach) > 0 and 0 < dT < 2):
        raise ValueError(f"Ra, Pr, mach and dT must be positive and dT below 2, got {ra}, {pr}, {mach}, "
                         f"{dT}: the mean temperature is 1")
    eos, L = IdealGas(), float(rows)
    alpha, free_fall = expansivity(eos, 1.0, 1.0), mach*float(sound_speed(eos, 1.0, energy(eos, 1.0, 1.0)))
    nu = free_fall*L*(pr/ra)**0.5
    return Domain(L=L, left=Plate(T=1 + dT/2), right=Plate(T=1 - dT/2), eta=nu, k=nu/pr*(eos.cv + 1),
                  g=free_fall**2/(alpha*dT*L), eos=eos)


def diffusivity(scene: Domain) -> float:
    """kappa = k/(rho c_P) at density 1, c_P = C_V + 1."""
    return scene.k/(scene.eos.cv + 1)


def observed(scene: Domain, at: Fields) -> dict[str, float]:
    """Nu of the hot side and of the vertical mid-plane; largest u there and v on the horizontal one.

    at : fields at points or nodes, as `fields` of a method returns them. Velocities are in kappa/L, each the
    mean of the largest ones in both directions, which are equal in a liquid.
    """
    s = (np.arange(FINE*round(scene.L)) + 0.5)/(FINE*round(scene.L)) - 0.5
    upright, level = (scene.L*np.stack(pair, axis=1) for pair in ((0*s, s), (s, 0*s)))
    *_, hot_slope = fitted(at, upright - [scene.L/2, 0.0])
    rho, u, v, T, T_x = fitted(at, upright)
    _, _, rising, *_ = fitted(at, level)
    enthalpy = (scene.eos.cv + 1)*(T - scene.T_mean) + (u**2 + v**2)/2 + scene.g*upright[:, 1]
    unit = scene.dT/scene.L     # enthalpy counts from T_mean: the net mass flux is zero
    heat = np.mean(rho*u*enthalpy/scene.k - T_x)
    speeds = [np.ptp(q)/2*scene.L/diffusivity(scene) for q in (u, rising)]
    return dict(zip(PRINTED, map(float, (-hot_slope.mean()/unit, heat/unit, *speeds))))


def fitted(at: Fields, places: np.ndarray) -> np.ndarray:
    """(rho, u, v, T, dT/dx), each (m,), at places (m, 2): quadratics fitted to the points nearest to each."""
    _, near = cKDTree(at.x).query(places, NEAR)
    x, y = np.moveaxis(at.x[near] - places[:, None], 2, 0)
    terms = np.stack([np.ones_like(x), x, y, x*x, x*y, y*y], axis=2)
    values = np.stack([at.rho, *at.v.T, at.T], axis=1)[near]
    best = np.linalg.pinv(terms)@values
    return np.stack([*best[:, 0].T, best[:, 1, 3]])


def compared(scene: Domain, at: Fields) -> pd.DataFrame:
    """A row per number: found, printed with uncertainty, spectral; the last three nan at other Ra, Pr."""
    kappa, alpha = diffusivity(scene), expansivity(scene.eos, 1.0, scene.T_mean)
    ra, pr = scene.g*alpha*scene.dT*scene.L**3/(scene.eta*kappa), scene.eta/kappa
    of = next((word for word in KNOWN if np.allclose((ra, pr), (float(word), 0.71))), "none")
    known = table("devahldavis").set_index("id")[["value", "uncertainty", "spectral"]]
    rows = known.reindex([f"devahldavis-{name}-{of}" for name in PRINTED.values()])
    found = pd.Series(observed(scene, at), name="found")
    return pd.concat([found, rows.set_index(found.index)], axis=1).rename_axis("number")
