"""A case of Boussinesq convection, its equations, its states, and what is measured on them.

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
from continuum.linear.layer import positive
from continuum.steady import STILL


@dataclass(frozen=True, kw_only=True)
class BoussinesqCase:
    """Fluid, box and grid; without columns the cells are as square as even numbers allow."""
    ra: float
    pr: float
    box: Box = HALF_LAYER
    rows: int = 64
    columns: int = 0

    def __post_init__(self):
        positive(Ra=self.ra, Pr=self.pr)
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
        """The operators, shared by every case on this box and grid."""
        return mac(self.box, self.rows, self.columns)


class Equations:
    """The rates of change of one case, without the pressure."""

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
    """K, Nusselt numbers by five ways, and the dissipations; the Nusselt numbers of a steady layer are equal.

    In other boxes only two balances remain: nu_thermal is the heat that enters times its wall's temperature
    (`wall_power`), and kinetic dissipation is the work of buoyancy, nu_convective = nu_kinetic.
    """
    K: float
    nu_bottom: float
    nu_top: float
    nu_convective: float        # 1 + <vT>/kappa
    nu_thermal: float           # <grad T^2>
    nu_kinetic: float           # 1 + kinetic dissipation/kappa
    nu_left: float              # heat that enters through the left side, over the height
    wall_power: float           # sum over walls of T_wall times heat that enters, over kappa


@dataclass(frozen=True, kw_only=True)
class State:
    """Velocities on faces and temperature in cells of a case's grid, in one vector q; see `parts`."""
    case: BoussinesqCase
    q: np.ndarray = field(repr=False)
    t: float = 0.0
    changes: tuple[float, ...] = ()         # of Newton's steps, the largest one

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
        """u (faces in x, rows), v (columns, faces in y), T (columns, rows); faces in walls are left out."""
        return self.case.mac.split(self.q)

    @property
    def psi(self) -> np.ndarray:
        """Streamfunction on corners (x faces, y faces): u = dpsi/dy, v = -dpsi/dx, zero on the bottom."""
        return np.cumsum(self.parts[0], axis=1)[:, :-1]*self.case.mac.y.h

    @property
    def K(self) -> float:
        """Kinetic energy per mass."""
        return 0.5*self.case.mac.cell*float(np.sum(self.q[:self.case.mac.ends[1]]**2))

    @property
    def rolls(self) -> int:
        """How many rolls lie in the box, 0 at rest: regions of one sign of psi, above 10 % of its largest."""
        if self.K < STILL:
            return 0
        psi = self.psi
        least = 0.1*np.max(np.abs(psi))
        return int(label(psi > least)[1] + label(psi < -least)[1])

    def observe(self) -> Observed:
        """All that is measured on a state, see Observed."""
        mac, kappa = self.case.mac, self.case.kappa
        T = self.parts[2]
        flow = np.r_[self.q[:mac.ends[1]], 0*T.ravel()]
        friction = -self.case.nu*mac.cell*float(flow@(mac.lap@flow))
        work = mac.cell*float(flow@(mac.lift@self.q))
        bottom, top, left, _ = heat = [enters(mac, T, *wall) for wall in (BOTTOM, TOP, LEFT, RIGHT)]
        inner = mac.cell*float(np.sum((mac.x.grad@T)**2) + np.sum((mac.y.grad@T.T)**2))
        return Observed(K=self.K, nu_bottom=bottom.gradient, nu_top=-top.gradient, nu_left=left.gradient,
                        nu_convective=1 + work/kappa, nu_kinetic=1 + friction/kappa,
                        nu_thermal=inner + sum(h.dissipation for h in heat),
                        wall_power=sum(h.power for h in heat))

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


BOTTOM, TOP, LEFT, RIGHT = (1, 0), (1, -1), (0, 0), (0, -1)     # (axis, end)


class Entering(NamedTuple):
    """At a wall: mean gradient of T out of the box, dissipation in its half cells, power T_wall*flux."""
    gradient: float
    dissipation: float
    power: float


def enters(mac: Mac, T: np.ndarray, axis: int, end: int) -> Entering:
    """Heat that comes through one wall; (T_wall - T_cell)/(h/2) is its gradient."""
    edges, across, along = ((mac.box.sides, mac.x, mac.y), (mac.box.plates, mac.y, mac.x))[axis]
    if edges.heat is not End.WALL:
        return Entering(0.0, 0.0, 0.0)
    wall = (edges.low if end == 0 else edges.high) + edges.ramp*along.centre
    gradient = (wall - np.take(T, end, axis=axis))*2/across.h
    share = mac.cell/across.h       # length of a cell's side over the area of the box
    return Entering(gradient=float(np.mean(gradient)), dissipation=share*across.h/2*float(gradient@gradient),
                    power=share*float(wall@gradient))


def resample(f: np.ndarray, old: tuple, new: tuple, mac: Mac) -> np.ndarray:
    """f from the points old = (x, y) to new; zero in walls that its points leave out."""
    x, y = old
    if len(x) == mac.x.faces:
        x, f = np.r_[0, x, mac.box.width], np.pad(f, ((1, 1), (0, 0)))
    if len(y) == mac.y.faces:
        y, f = np.r_[0, y, 1], np.pad(f, ((0, 0), (1, 1)))
    return RectBivariateSpline(x, y, f)(*new)
