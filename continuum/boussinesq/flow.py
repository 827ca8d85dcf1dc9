"""Boussinesq convection: cases, rates of change, states, initial states, measured quantities.

Free-fall units: height H, temperature difference dT and velocity sqrt(g alpha dT H) are 1, so that
nu = sqrt(Pr/Ra), kappa = 1/sqrt(Pr Ra); T is in (-1/2, 1/2); K is kinetic energy per mass.
"""
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.interpolate import RectBivariateSpline
from scipy.ndimage import label

from continuum.boussinesq.mac import HALF_LAYER, Box, End, Mac, mac
from continuum.linear import critical_ra
from continuum.scene import positive
from continuum.steady import STILL


@dataclass(frozen=True, kw_only=True)
class BoussinesqCase:
    """Fluid, box and grid; by default `columns` is the even number that makes cells most nearly square."""
    ra: float
    pr: float
    box: Box = HALF_LAYER
    rows: int = 64
    columns: int = 0

    def __post_init__(self):
        positive(ra=self.ra, pr=self.pr)
        object.__setattr__(self, "columns", self.columns or 2*round(self.box.width*self.rows/2))
        for name in ("rows", "columns"):
            if (cells := getattr(self, name)) < 8 or cells % 2:
                raise ValueError(f"{name} must be even and at least 8, got {cells}: the middle of the box is "
                                 "a face")

    @property
    def nu(self) -> float:
        """Kinematic viscosity."""
        return float(np.sqrt(self.pr/self.ra))

    @property
    def kappa(self) -> float:
        """Thermal diffusivity."""
        return float(1/np.sqrt(self.pr*self.ra))

    @property
    def mac(self) -> Mac:
        """Operators, shared by all cases with this box and grid."""
        return mac(self.box, self.rows, self.columns)


class Equations:
    """Rates of change of one case, without the pressure."""

    def __init__(self, case: BoussinesqCase):
        self.case, self.mac = case, case.mac
        thin = np.where(np.arange(self.mac.ends[-1]) < self.mac.ends[1], case.nu, case.kappa)
        self.diffusion = (sparse.diags_array(thin)@self.mac.lap).tocsr()
        self.supply = thin*self.mac.wall

    def diffuse(self, q: np.ndarray) -> np.ndarray:
        """Viscosity and conduction."""
        return self.diffusion@q + self.supply

    def drive(self, q: np.ndarray) -> np.ndarray:
        """Buoyancy and advection."""
        m = self.mac
        return m.lift@q - m.D@((m.A@q)*(m.B@q))


class Observed(NamedTuple):
    """K, and Nusselt numbers: mean heat flux in at the bottom, out at the top, in at the left side."""
    K: float
    nu_bottom: float
    nu_top: float
    nu_left: float


@dataclass(frozen=True, kw_only=True)
class State:
    """Velocities on faces and temperature in cells of a case's grid, in one vector q; see `parts`."""
    case: BoussinesqCase
    q: np.ndarray = field(repr=False)
    t: float = 0.0
    changes: tuple[float, ...] = ()         # largest change in each of Newton's steps

    def __post_init__(self):
        if self.q.shape != (self.case.mac.ends[-1],):
            raise ValueError(f"state has shape {self.q.shape}, its grid has {self.case.mac.ends[-1]} "
                             "numbers: use state.on(case) to change grids")
        if not np.isfinite(self.q).all():
            bad = next(name for name, a in zip("uvT", self.parts) if not np.isfinite(a).all())
            raise ValueError(f"{bad} is not finite at t = {self.t:.6g}: start from finite fields, with a "
                             "step that is stable")

    @cached_property
    def parts(self) -> list[np.ndarray]:
        """u (faces in x, rows), v (columns, faces in y), T (columns, rows), without faces in walls."""
        return self.case.mac.split(self.q)

    @property
    def psi(self) -> np.ndarray:
        """Streamfunction on corners (faces in x, faces in y): u = dpsi/dy, v = -dpsi/dx, 0 on the bottom."""
        return np.cumsum(self.parts[0], axis=1)[:, :-1]*self.case.mac.y.h

    @property
    def K(self) -> float:
        """Kinetic energy per mass."""
        return 0.5*self.case.mac.cell*float(np.sum(self.q[:self.case.mac.ends[1]]**2))

    @property
    def rolls(self) -> int:
        """Number of rolls, 0 at rest: regions of one sign with |psi| above 10 % of its largest value."""
        if self.K < STILL:
            return 0
        psi = self.psi
        least = 0.1*np.max(np.abs(psi))
        return int(label(psi > least)[1] + label(psi < -least)[1])

    def observe(self) -> Observed:
        """K and the Nusselt numbers."""
        walls = (1, 0), (1, -1), (0, 0)     # axis, end
        bottom, top, left = (enters(self.case.mac, self.parts[2], *wall) for wall in walls)
        return Observed(self.K, bottom, -top, left)

    def on(self, case: BoussinesqCase) -> "State":
        """The same fields on another grid or at another Ra, Pr, by cubic splines."""
        if case.box != self.case.box:
            raise ValueError(f"state is of {self.case.box}, the case has {case.box}: resample only within "
                             "one box")
        if (case.rows, case.columns) == (self.case.rows, self.case.columns):
            return replace(self, case=case, changes=())
        old, new = self.case.mac, case.mac
        parts = [resample(f, a, b, old) for f, a, b in zip(self.parts, old.points, new.points)]
        return State(case=case, q=np.concatenate([f.ravel() for f in parts]), t=self.t)


def enters(mac: Mac, T: np.ndarray, axis: int, end: int) -> float:
    """Mean outward gradient of T at one wall, (T_wall - T_cell)/(h/2); 0 at an insulated one."""
    edges, across, along = ((mac.box.sides, mac.x, mac.y), (mac.box.plates, mac.y, mac.x))[axis]
    if edges.heat is not End.WALL:
        return 0.0
    wall = (edges.low if end == 0 else edges.high) + edges.ramp*along.centre
    return float(np.mean((wall - np.take(T, end, axis=axis))*2/across.h))


def resample(f: np.ndarray, old: tuple, new: tuple, mac: Mac) -> np.ndarray:
    """Interpolate f from points old = (x, y) to new; normal velocities are 0 in walls."""
    x, y = old
    if len(x) == mac.x.faces:
        x, f = np.r_[0, x, mac.box.width], np.pad(f, ((1, 1), (0, 0)))
    if len(y) == mac.y.faces:
        y, f = np.r_[0, y, 1], np.pad(f, ((0, 0), (1, 1)))
    return RectBivariateSpline(x, y, f)(*new)


def rest(case: BoussinesqCase) -> State:
    """State at rest with the temperature of conduction: linear between the plates, or the sides."""
    mac, plates = case.mac, case.box.plates
    x, y = np.meshgrid(mac.x.centre/case.box.width, mac.y.centre, indexing="ij")
    T = 0.5 - (y if plates.heat is End.WALL else x)
    return State(case=case, q=np.r_[np.zeros(mac.ends[1]), T.ravel()])


def roll(case: BoussinesqCase, rolls: int = 1) -> State:
    """Rolls that rise at the left side, from the Lorenz model (free plates) at Ra/Ra_c of at least 1.1."""
    if rolls < 1:
        raise ValueError(f"{rolls} rolls do not fit: a box has at least 1")
    mac, a = case.mac, rolls/case.box.width
    r = max(case.ra/critical_ra(np.pi*a), 1.1)
    swing = np.sqrt(8*(r - 1)/(1 + a**2))
    x, y = np.pi*a*mac.x.face[:, None], np.pi*mac.y.face
    psi = -case.kappa*(1 + a**2)/a*swing*np.sin(x)*np.sin(y)**2
    x, y = np.pi*a*mac.x.centre[:, None], np.pi*mac.y.centre
    warm = (swing*np.cos(x)*np.sin(y) - (r - 1)*np.sin(2*y))/(np.pi*r)
    T = rest(case).parts[2] + warm*(case.box.plates.heat is End.WALL)
    return State(case=case, q=np.r_[mac.curl@psi.ravel(), T.ravel()])
