"""Steady states and disturbances of the compressible grid: Newton's method on the rates of the loop.

Between periodic sides the flow is taken as its own mirror image about the middle of a rising and of a falling
stream, which leaves one half of the box and fixes the rolls. Slopes of the rates come from their differences:
unknowns five nodes apart meet in no rate, so that a hundred pairs of evaluations give the sparse matrix.

The grid keeps two sums of densities: the mass, and the sum with signs that alternate like the squares of a
chessboard, which no node sees. Both are constraints of Newton's method.
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

REACH = 2       # of a node or cell in rates, in rows and columns
STEP = 1e-5     # of the differences: their error is about its square, and round-off over it
# the implicit steps that lead to Newton's are RELAX/(largest rate of change) free-fall times long
RELAX = 1.0
# K of rolls to start from, in free-fall units: from KHP95's, cold and stronger, it may end in other states
WEAK = 5e-4
NEAR = 0.3
STILL = 1e-10   # square of the share of the velocity below which a disturbance is a change of mass only


class SteadyState(NamedTuple):
    """A steady state: fields, kinetic energy per mass, number of rolls, largest change in each step."""
    fields: NodeFields
    ke: float
    rolls: int
    changes: tuple[float, ...]


class Discrete:
    """The rates of one scene on one grid as a function of q, deviations from the state at rest."""

    def __init__(self, scene, rows: int):
        self.scene, self.rest = scene, block(initial(scene, rows, 0.0))
        columns = self.rest.shape[2] - 2
        self.laws = (in_loop(scene.sides), scene.eos, scene.law, FluxForm(), box_of(scene, rows))
        self.scratch = np.zeros((2, 8, columns + 2))
        self.places, self.mirrors, self.signs = self._unknowns(rows, columns)

    def _unknowns(self, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Places (3, n) = field, row, column of the unknowns, of their mirror images, and signs."""
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
        """The block of the loop, without ghosts."""
        S = self.rest.copy()
        S[tuple(self.mirrors)] = self.rest[tuple(self.mirrors)] + self.signs*q
        S[tuple(self.places)] = self.rest[tuple(self.places)] + q
        return S

    def unknowns(self, S: np.ndarray) -> np.ndarray:
        """The deviations of a block from rest."""
        return (S - self.rest)[tuple(self.places)]

    def rates(self, q: np.ndarray) -> np.ndarray:
        out = np.zeros_like(self.rest)
        rates(*self.laws, self.state(q), self.scratch, out)
        return out[tuple(self.places)]

    @property
    def kept(self) -> list[np.ndarray]:
        """Weights of the kept sums of densities; between mirrors the chessboard is zero."""
        field, j, i = self.places
        mass, chess = 1.0*(field == RHO), (field == RHO)*(-1.0)**(i + j)
        return [mass] if isinstance(self.scene.sides, Periodic) else [mass, chess]

    @cached_property
    def pattern(self) -> sparse.csc_array:
        """Which rate depends on which unknown, at most."""
        fields, height, width = self.rest.shape
        meet = sparse.kron(np.ones((fields, fields)), sparse.kron(near(height), near(width))).tocsr()
        places, mirrors = (np.ravel_multi_index(tuple(at), self.rest.shape)
                           for at in (self.places, self.mirrors))
        return ((meet[places][:, places] + meet[places][:, mirrors]) > 0).tocsc()

    @cached_property
    def groups(self) -> list[np.ndarray]:
        """Unknowns that meet in no rate, together."""
        period = 2*REACH + 1
        f, j, i = self.places
        colour = (f*period + j % period)*period + i % period
        return [np.flatnonzero(colour == c) for c in np.unique(colour)]

    def jacobian(self, q: np.ndarray) -> sparse.csc_array:
        """Slopes of the rates, by central differences."""
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

    def fields(self, q: np.ndarray) -> tuple[NodeFields, np.ndarray]:
        """Fields, and the block with its ghosts."""
        S = self.state(q)
        fill(*self.laws, S)
        return unblock(self.scene, S), S


def near(n: int) -> sparse.coo_array:
    """Which of n rows or columns are within reach of which."""
    distance = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    return sparse.coo_array(1.0*(distance <= REACH))


def heat_of_rolls(scene, vy: np.ndarray) -> np.ndarray:
    """Temperature of slow rolls as wide as high: kappa (2 pi^2/L^2) T' = v_y dT/L. Gas carries half of it
    (adiabatic gradient) and conducts as much less (isobaric heat): the factors cancel."""
    return vy*scene.dT*scene.L/(2*np.pi**2*scene.kappa)


def warm_rolls(scene, rows: int, ke: float) -> NodeFields:
    """KHP95's initial rolls of kinetic energy `ke` per mass, with their heat."""
    fields = initial(scene, rows, ke)
    T = fields.at.T + heat_of_rolls(scene, fields.at.vy)
    return replace(fields, at=fields.at._replace(T=T, e=energy(scene.eos, fields.at.rho, T)))


def steady(scene, rows: int, start: NodeFields | None = None) -> SteadyState:
    """The steady state by Newton's method from a start, of any grid or Ra; by default from weak rolls.

    At rest below onset. Raises NewtonFailed: no convergence.
    """
    equations, unit = Discrete(scene, rows), scene.L/scene.free_fall
    start = warm_rolls(scene, rows, WEAK*scene.free_fall**2) if start is None else onto(scene, rows, start)

    def relaxed(q: np.ndarray) -> np.ndarray:
        rates = equations.rates(q)
        return step(equations, q, rates, RELAX*unit/max(largest(rates)*unit, WITHIN**2))
    q, changes = newton(equations.unknowns(block(start)), relaxed, f"Ra = {scene.ra:g} on {rows} rows")
    fields, S = equations.fields(q)
    return SteadyState(fields, kinetic_energy(S), count_rolls(fields), changes)


def step(equations: Discrete, q: np.ndarray, rates: np.ndarray, dt: float) -> np.ndarray:
    """The change of q in an implicit step; dt = inf makes it Newton's.

    Of the rates of densities one follows from the others for each kept sum. It gives way to "no change of
    this density", and what such a change alone would do, `free`, is added so that the sums are kept.
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
    """Growth rate of the fastest disturbance of the fluid at rest that moves it, per unit of time.

    Looked for around NEAR per free-fall time, which is above it. Between periodic sides disturbances of all
    widths count that have the mirror planes of the box's pair of rolls. A change of mass does not count.
    """
    equations = Discrete(scene, rows)
    q = np.zeros(equations.places.shape[1])
    first = np.sin(1.0 + np.arange(len(q)))     # any will do, but the same each time
    rates, modes = eigs(equations.jacobian(q), 8, sigma=NEAR*scene.free_fall/scene.L, v0=first)
    moves = (np.abs(modes[equations.places[0] <= VY])**2).sum(axis=0) > STILL*(np.abs(modes)**2).sum(axis=0)
    return float(rates.real[moves].max())
