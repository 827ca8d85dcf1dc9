"""Methods as strangers may bring them: one with steps of its own, and some that are wrong."""
import numpy as np

from examples.your_method import Cells
from particles.limits import limit_of
from particles.method import LatticeRates, OwnRates, Stepping


class Heun(Stepping):
    """Cells in steps of Heun's."""
    names = Cells.names

    def __init__(self, scene):
        super().__init__(scene)
        self.cells = Cells(scene)
        self.x, self.state, self.fields = self.cells.x, self.cells.state, self.cells.fields

    def limit(self, start):
        return 0.3*limit_of(self.cells, start)

    def advance(self, state, dt, steps):
        first, second = np.empty((2, *state.shape))
        for _ in range(steps):
            self.cells.rates(state, first)
            self.cells.rates(state + dt*first, second)
            state = state + dt/2*(first + second)
        return state


class NoFields(OwnRates):
    """Nobody can see what it does."""
    names, x, state = LatticeRates.names, LatticeRates.x, LatticeRates.state

    def rates(self, state, out):
        out[:] = 0


class Transposed(Cells):
    """Velocities in rows."""

    def fields(self, state):
        at = super().fields(state)
        return at._replace(v=at.v.T)

    def rates(self, state, out):
        out[:] = 0


class Hasty(Cells):
    """Claims a step that is ten times too long."""

    def limit(self, start):
        return 20.0


class Dicing(Cells):
    """Rates with a little noise, from no seed."""

    def limit(self, start):
        return 1.0

    def rates(self, state, out):
        super().rates(state, out)
        out += 1e-9*np.random.default_rng().standard_normal(out.shape)


class Unwritten(Cells):
    """Returns its rates."""

    def rates(self, state, out):
        return np.zeros_like(state)
