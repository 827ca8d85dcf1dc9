"""Eq. 41 where points stand still: the scheme of moving points held, against Eq. 40 written out    [RR98 Eqs 40, 41]"""
import numpy as np

from continuum.fluid import ConstEta
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.points import lattice
from particles.integral.rr98_moving_plain import Literal
from particles.integrators import TwoStep
from particles.threads import Team
from particles.weights import Lucy
from studies.conservation.motions.scene import ALONG, GAS, moving


class Still(Literal):
    """Points of the moving scheme that do not move: edges are made again from positions at every evaluation."""

    def velocity(self, state: np.ndarray) -> np.ndarray:
        """(2, n): none."""
        return np.zeros_like(state[:self.places])


def not_moved() -> float:
    """Largest difference of fields after 20 steps of Eqs 40, 41 by `Still`, and of Eq. 40 alone, written out, on fixed points."""
    points, weight, law, dt = lattice((8, 7)), Lucy.of(h=3.0), ConstEta(0.1, 0.1), 0.05
    still, dih = moving(Still, points, weight, law), Dih(edges=renormalised(points, weight), eos=GAS, law=law, transport=ALONG)
    fields = np.ones(points.n), 0.1*np.sin(2*np.pi*points.x/points.box), np.ones(points.n)
    moved, fixed = still.state(points.x, *fields), dih.state(*fields)
    stepper, rates = TwoStep(moved.shape, Team(1)), np.empty_like(fixed)
    for _ in range(20):
        stepper.step(still, moved, dt)
        dih.rates(fixed, rates)
        fixed += dt*rates
    return float(np.abs(moved[still.places:] - fixed).max())
