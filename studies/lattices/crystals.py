"""Small motions of inviscid smooth particles on a lattice: sums and runs    [KHP95, Secs II, III, VI]

About rest at summed density rho, without conduction, displacements u exp(ik.r) obey d2u/dt2 = -M u,

    M(k) = (m/rho)^2 (c^2 - 2 P/rho) S S^T + (2 m P/rho^2) D
    S = sum_r grad w sin k.r
    D = sum_r (grad grad w)(1 - cos k.r)

The sums are over the neighbours r of a particle; c is the isentropic speed of sound. A motion with a negative
eigenvalue of M grows: with some weights lattices turn into pairs; fluids under negative pressure clump.
"""
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from continuum.fluid import energy, pressure, pressure_slopes
from particles.limits import step_limit
from particles.observe import particle_kinetic
from particles.run import STUDIES, Divergence, Plan, run
from particles.weights import value_and_slope
from studies.build.spam import at_rest, fluid
from studies.kit.case import Case, Report
from studies.kit.table import Row


class Lattice(NamedTuple):
    """A lattice of density 1: size (2,) of its rectangular cells, particles inside a cell over this size."""
    name: str
    size: tuple[float, float]
    inside: tuple[tuple[float, float], ...]

    def box(self, cells: tuple[int, int]) -> tuple[float, float]:
        """Sides of a box of so many cells along x and y."""
        return self.size[0]*cells[0], self.size[1]*cells[1]

    def places(self, cells: tuple[int, int]) -> np.ndarray:
        """Places (n, 2) of particles in a box centred on the origin."""
        corners = whole_numbers(cells).reshape(-1, 1, 2)
        x = (corners + self.inside)*self.size
        return x.reshape(-1, 2) - np.array(self.box(cells))/2

    def neighbours(self, reach: float) -> np.ndarray:
        """Vectors (n, 2) to the neighbours nearer than `reach`, the same for all particles."""
        columns, rows = (int(2*reach/side) + 4 for side in self.size)
        x = self.places((columns, rows))
        r = x - x[np.argmin(np.hypot(*x.T))]
        distance = np.hypot(*r.T)
        return r[(distance < reach) & (distance > 0)]

    def vectors(self, cells: tuple[int, int]) -> np.ndarray:
        """Wave vectors (n, 2) that fit into a box, without those that move all particles alike."""
        turns = whole_numbers(len(self.inside)*np.array(cells))
        k = 2*np.pi*turns/self.box(cells)
        phase = k@self.neighbours(2.0).T
        return k[np.abs(np.sin(phase/2)).max(axis=1) > 1e-9]


def whole_numbers(counts: Any) -> np.ndarray:
    """All pairs (n, 2) of whole numbers below two counts."""
    grids = np.meshgrid(*map(np.arange, counts), indexing="ij")
    return np.stack(grids, axis=-1).reshape(-1, 2)


WIDTH = float(np.sqrt(2/np.sqrt(3)))
LATTICES = {lattice.name: lattice for lattice in (
    Lattice("square", (1.0, 1.0), ((0.25, 0.25),)),
    Lattice("hexagonal", (WIDTH, float(np.sqrt(3))*WIDTH), ((0.25, 0.25), (0.75, 0.75))))}


class LatticeMotion(NamedTuple):
    """Displacements a cos k.r, |a| = 1. square : omega^2. rate : of growth, or minus the frequency."""
    k: np.ndarray
    a: np.ndarray
    square: float
    rate: float


def sums(weight: Any, lattice: Lattice, k: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Density, S (n, 2) and D (n, 2, 2) of unit masses at wave vectors k (n, 2), as `particles.limits` has
    them for the square lattice."""
    x = lattice.neighbours(weight.h)
    r = np.hypot(*x.T)
    w, slope, curvature = np.array([derivatives(weight, one) for one in r]).T
    n = x/r[:, None]
    along = np.einsum("ra,rb->abr", n, n)
    hessian = slope*(np.eye(2)[..., None] - along) + curvature*along
    phase = k@x.T
    S = np.sin(phase)@(slope[:, None]*x)
    D = np.einsum("kr,abr->kab", 1 - np.cos(phase), hessian)
    return float(w.sum() + value_and_slope(weight, 0.0)[0]), S, D


def derivatives(weight: Any, r: float) -> tuple[float, float, float]:
    """w, w'/r and w'' at r; w'' by a central difference, good to 1e-9."""
    step = 1e-5
    after, before = (value_and_slope(weight, at)[1]*at for at in (r + step, r - step))
    return *value_and_slope(weight, r), (after - before)/(2*step)


# --- a lattice of some fluid ------------------------------------------------------------------------

SHIFT = 1e-8                    # displacements at the start, spacings
GROWN = 100.0                   # factor of the energy that counts as growth in the search for the onset
PATIENCE = 200.0                # duration of runs of a search: ln 10/200 is a rate of 0.012
HALVINGS = 8
SMALL = 1e-3                    # wave number that counts as zero
C2 = 2.0                        # of the ideal gas at T = 1
DIRECTIONS = np.linspace(0, np.pi, 24, endpoint=False)


@dataclass(frozen=True, kw_only=True)
class Crystal:
    """A lattice of inviscid particles at rest. rho : density, also the mass of a particle."""
    lattice: Lattice
    cells: tuple[int, int]
    weight: Any
    h: float
    eos: Any
    T: float = 1.0
    rho: float = 1.0

    @property
    def e(self) -> float:
        return float(energy(self.eos, self.rho, self.T))

    def matrices(self, k: np.ndarray) -> np.ndarray:
        """M (n, 2, 2) at wave vectors k (n, 2)."""
        n, S, D = sums(self.weight.of(h=self.h), self.lattice, k)
        m, rho = self.rho, self.rho*n
        P = pressure(self.eos, rho, self.e)
        by_rho, by_e = pressure_slopes(self.eos, rho, self.e)
        c2 = float(by_rho + P/rho**2*by_e)      # negative where the fluid itself is unstable
        SS = np.einsum("ka,kb->kab", S, S)
        return (m/rho)**2*(c2 - 2*P/rho)*SS + 2*m*P/rho**2*D

    def squares(self, k: np.ndarray) -> np.ndarray:
        """omega^2 (n, 2) of both motions at wave vectors k (n, 2), the slower one first."""
        return np.linalg.eigvalsh(self.matrices(k))

    @property
    def motion(self) -> LatticeMotion:
        """The motion that grows fastest by lattice sums, or the slowest one if none grows."""
        k = self.lattice.vectors(self.cells)
        squares, a = np.linalg.eigh(self.matrices(k))
        i = int(np.argmin(squares[:, 0]))
        square = float(squares[i, 0])
        return LatticeMotion(k[i], a[i, :, 0], square, float(-np.sign(square)*np.sqrt(abs(square))))

    @property
    def columns(self) -> dict[str, Any]:
        """Key columns of its rows."""
        return {"lattice": self.lattice.name, "weight": self.weight.__name__, "h": self.h,
                "eos": type(self.eos).__name__, "T": self.T, "rho": self.rho}

    def energies(self, time: float, shifts: Callable) -> tuple[np.ndarray, np.ndarray]:
        """Times and kinetic energies per mass until the run diverges. shifts : x -> shifts over SHIFT."""
        x, energies = self.lattice.places(self.cells), list[float]()

        def kinetic(sums: Any, state: np.ndarray) -> float:
            energies.append(particle_kinetic(sums, state))      # kept also when the run diverges
            return energies[-1]
        method = fluid(self.weight.of(h=self.h), self.lattice.box(self.cells), self.eos, m=self.rho)
        dt = STUDIES*step_limit(method, self.e, self.rho)
        plan = Plan(dt=dt, steps=round(time/dt), series={"k": kinetic}, every=2)
        with suppress(Divergence):
            run(method, at_rest(x + SHIFT*shifts(x), self.e), plan)
        times = 2*dt*(1 + np.arange(len(energies)))
        return times, np.array(energies)


# --- cases ----------------------------------------------------------------------------------------


class Debye(Case, table="debye"):
    """Numbers of long waves of a lattice, from their speeds, over those of Debye's continuum.

    In 2D there are omega^2/(4 pi n c^2) waves per particle below omega, of each kind. A fluid has one kind,
    sound, in which the density fluctuates. A lattice has shear waves, too.    [KHP95, Sec. VII]
    """
    crystal: Crystal

    def measure(self, report: Report) -> Iterator[Row]:
        k = SMALL*np.stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)], axis=1)
        long = self.crystal.squares(k)
        shear, sound = np.where(long > 0, C2*SMALL**2/long, np.nan).mean(axis=0)
        yield {**self.crystal.columns, "sound": sound, "shear": shear}


class Onset(Case, table="onsets", same="parameter seed"):
    """The value of h or T at which motions begin to grow, by halving [stable, unstable]."""
    crystal: Crystal
    parameter: str
    stable: float
    unstable: float
    seed: int = 1

    def measure(self, report: Report) -> Iterator[Row]:
        stable, unstable = self.stable, self.unstable
        predicted = brentq(lambda value: self.at(value).motion.rate, stable, unstable, xtol=1e-6)
        middle = (stable + unstable)/2
        for number in range(HALVINGS):
            report(number/HALVINGS)
            stable, unstable = (stable, middle) if self.grows(middle) else (middle, unstable)
            middle = (stable + unstable)/2
        yield {**self.crystal.columns, self.parameter: 0.0, "predicted": predicted, "measured": middle,
               "measured_err": abs(stable - unstable)/2}

    def at(self, value: float) -> Crystal:
        """The crystal with this value of the parameter."""
        changed: dict[str, Any] = {self.parameter: value}
        return replace(self.crystal, **changed)

    def grows(self, value: float) -> bool:
        """Whether the mean energy of the last tenth of a run exceeds GROWN times that of the second."""
        rng = np.random.default_rng(self.seed)
        _, energies = self.at(value).energies(PATIENCE, lambda x: rng.standard_normal(x.shape))
        tenth = max(1, len(energies)//10)
        early, late = energies[tenth:2*tenth].mean(), energies[-tenth:].mean()
        return bool(late > GROWN*early)
