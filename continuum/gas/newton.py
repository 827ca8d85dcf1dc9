"""Steady states of the compressible grid by Newton's method, and growth rates of disturbances at rest.

Between periodic sides the flow is taken as mirror-symmetric about the middles of rising and falling streams:
one half of the box remains, and the place of the rolls is fixed. The Jacobian comes from central differences:
no rate depends on two unknowns five nodes apart, so that a hundred pairs of evaluations give all of it.

The grid conserves two sums of densities: the mass, and the sum with signs that alternate as on a chessboard,
which no node sees. Both are constraints of Newton's method.
"""
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigs, splu

from continuum.fluid import energy
from continuum.gas.fields import NodeFields, block, count_rolls, initial, kinetic_energy, onto, unblock
from continuum.gas.ghosts import RHO, VX, VY, E, FluxForm, box_of, fill, in_loop
from continuum.gas.loop import rates
from continuum.scene import Periodic
from continuum.steady import WITHIN, largest, newton

REACH = 2       # rows and columns over which a rate depends on nodes and cells
STEP = 1e-5     # of the differences: their error is about STEP^2 + round-off/STEP
# K of the initial rolls in free-fall units: KHP95's, cold and stronger, may lead to other steady states
WEAK = 5e-4
NEAR = 0.3
STILL = 1e-10   # share of v in |disturbance|^2 below which the disturbance is a change of mass only


class SteadyState(NamedTuple):
    """A steady state: fields, kinetic energy per mass, rolls."""
    fields: NodeFields
    ke: float
    rolls: int


class Discrete:
    """Rates of one scene on one grid as a function of q, the deviations from the state at rest."""

    def __init__(self, scene, rows: int):
        self.scene, self.rest = scene, block(initial(scene, rows, 0.0))
        columns = self.rest.shape[2] - 2
        self.laws = (in_loop(scene.sides), scene.eos, scene.law, FluxForm(), box_of(scene, rows))
        self.scratch = np.zeros((2, 8, columns + 2))
        self.places, self.mirrors, self.signs = self._unknowns(rows, columns)

    def _unknowns(self, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(3, n) = field, row, column of unknowns, the same of their mirror images, signs of the images."""
        half = isinstance(self.scene.sides, Periodic)
        last = columns//2 + 1 if half else columns
        inner, nodes = range(2, rows + 1), range(1 if half else 2, last + 1)
        layout = ((VX, inner, range(2, last) if half else nodes), (VY, inner, nodes), (E, inner, nodes),
                  (RHO, range(1, rows + 1), range(1, last if half else last + 1)))
        places = np.array([(f, j, i) for f, js, is_ in layout for j in js for i in is_]).T
        mirrors, signs = places.copy(), np.where(places[0] == VX, -1.0, 1.0)
        if half:
            mirrors[2] = columns + np.where(places[0] == RHO, 1, 2) - places[2]
            mirrors[2, mirrors[2] == columns + 1] = 1       # the last column of nodes is the first
        return places, mirrors, signs

    def state(self, q: np.ndarray) -> np.ndarray:
        """The block S of the deviations q, without ghosts."""
        S = self.rest.copy()
        S[tuple(self.mirrors)] = self.rest[tuple(self.mirrors)] + self.signs*q
        S[tuple(self.places)] = self.rest[tuple(self.places)] + q
        return S

    def unknowns(self, S: np.ndarray) -> np.ndarray:
        """The deviations q of a block from the state at rest."""
        return (S - self.rest)[tuple(self.places)]

    def rates(self, q: np.ndarray) -> np.ndarray:
        out = np.zeros_like(self.rest)
        rates(*self.laws, self.state(q), self.scratch, out)
        return out[tuple(self.places)]

    @property
    def kept(self) -> list[np.ndarray]:
        """Weights of the conserved sums of densities; with mirror symmetry the chessboard sum is zero."""
        field, j, i = self.places
        mass, chess = 1.0*(field == RHO), (field == RHO)*(-1.0)**(i + j)
        return [mass] if isinstance(self.scene.sides, Periodic) else [mass, chess]

    @cached_property
    def pattern(self) -> sparse.csc_array:
        """Sparsity pattern of the Jacobian, an upper bound."""
        fields, height, width = self.rest.shape
        meet = sparse.kron(np.ones((fields, fields)), sparse.kron(near(height), near(width))).tocsr()
        places, mirrors = (np.ravel_multi_index(tuple(at), self.rest.shape)
                           for at in (self.places, self.mirrors))
        return ((meet[places][:, places] + meet[places][:, mirrors]) > 0).tocsc()

    @cached_property
    def groups(self) -> list[np.ndarray]:
        """Groups of unknowns of which no rate depends on two."""
        period = 2*REACH + 1
        f, j, i = self.places
        colour = (f*period + j % period)*period + i % period
        return [np.flatnonzero(colour == c) for c in np.unique(colour)]

    def jacobian(self, q: np.ndarray) -> sparse.csc_array:
        """Jacobian of the rates, by central differences."""
        rows, columns, values = [], [], []
        for group in self.groups:
            shift = np.zeros_like(q)
            shift[group] = STEP
            slope = (self.rates(q + shift) - self.rates(q - shift))/(2*STEP)
            part = self.pattern[:, group].tocoo()
            rows.append(part.row)
            columns.append(group[part.col])
            values.append(slope[part.row])
        return sparse.csc_array((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                self.pattern.shape)


def near(n: int) -> sparse.coo_array:
    """Matrix (n, n): 1 where two of n rows or columns are within REACH of each other."""
    distance = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    return sparse.coo_array(1.0*(distance <= REACH))


def heat_of_rolls(scene, vy: np.ndarray) -> np.ndarray:
    """Temperature deviation T' of slow rolls as wide as high: kappa (2 pi^2/L^2) T' = v_y dT/L. In a gas both
    sides are halved, by the isobaric heat capacity and by the adiabatic gradient: the factors cancel."""
    return vy*scene.dT*scene.L/(2*np.pi**2*scene.kappa)


def warm_rolls(scene, rows: int, ke: float) -> NodeFields:
    """KHP95's initial rolls of kinetic energy `ke` per mass, with the temperature of slow rolls."""
    fields = initial(scene, rows, ke)
    T = fields.at.T + heat_of_rolls(scene, fields.at.vy)
    return replace(fields, at=fields.at._replace(T=T, e=energy(scene.eos, fields.at.rho, T)))


def steady(scene, rows: int, start: NodeFields | None = None) -> SteadyState:
    """Steady state by Newton's method from `start`, on any grid and at any Ra; by default from weak rolls.

    Implicit steps of the inverse of the largest rate of change lengthen and become Newton's. Below onset it
    is at rest. Raises NewtonFailed: no convergence.
    """
    equations, unit = Discrete(scene, rows), scene.L/scene.free_fall
    start = warm_rolls(scene, rows, WEAK*scene.free_fall**2) if start is None else onto(scene, rows, start)

    def relaxed(q: np.ndarray) -> np.ndarray:
        rates = equations.rates(q)
        return step(equations, q, rates, unit/max(largest(rates)*unit, WITHIN**2))
    q, _ = newton(equations.unknowns(block(start)), relaxed, f"Ra = {scene.ra:g} on {rows} rows")
    S = equations.state(q)
    fill(*equations.laws, S)
    fields = unblock(scene, S)
    return SteadyState(fields, kinetic_energy(S), count_rolls(fields))


def step(equations: Discrete, q: np.ndarray, rates: np.ndarray, dt: float) -> np.ndarray:
    """Change of q in an implicit step; dt = inf makes it Newton's.

    For each conserved sum one rate of a density follows from the others. Its row becomes "no change of this
    density". Then multiples of `free`, the response to unit changes of these densities, conserve the sums.
    """
    kept = np.array(equations.kept)
    spare = np.flatnonzero(equations.places[0] == RHO)[:len(kept)]
    mask = np.ones(len(q))
    mask[spare] = 0
    units = np.zeros((len(q), len(spare)))
    units[spare, range(len(spare))] = 1
    slopes = sparse.diags_array(mask)@equations.jacobian(q)
    lu = splu((sparse.diags_array(np.where(mask, 1/dt, 1.0)) - slopes).tocsc())
    change, free = lu.solve(mask*rates), lu.solve(units)
    return change - free@np.linalg.solve(kept@free, kept@(q + change))


def growth_rate(scene, rows: int) -> float:
    """Largest growth rate of a disturbance with flow of the fluid at rest, per unit of time.

    It is sought around NEAR per free-fall time, which lies above it. Between periodic sides disturbances of
    any width count that have the mirror planes of the box's pair of rolls. Changes of mass alone do not.
    """
    equations = Discrete(scene, rows)
    q = np.zeros(equations.places.shape[1])
    first = np.sin(1.0 + np.arange(len(q)))     # any vector will do, but it must be the same each time
    rates, modes = eigs(equations.jacobian(q), 8, sigma=NEAR*scene.free_fall/scene.L, v0=first)
    moves = (np.abs(modes[equations.places[0] <= VY])**2).sum(axis=0) > STILL*(np.abs(modes)**2).sum(axis=0)
    return float(rates.real[moves].max())
