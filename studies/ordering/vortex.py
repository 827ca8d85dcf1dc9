"""The decaying Taylor-Green vortex on fixed points, one wavelength to the periodic box."""
from math import ceil
from typing import NamedTuple

import numpy as np

from continuum.exact.vortex import DECAYS, Vortex
from continuum.fluid import ConstEta, IdealGas
from particles.fields import kinetic_energy
from particles.integral.edges import NONE_BEYOND, Edges
from particles.integral.layer import Layer
from particles.integral.points import Points
from particles.limits import limit_of
from particles.run import Divergence, Plan, run
from studies.kit.case import Report

OF_LIMIT = 0.5      # of the step to its limit: half of it changes the errors by 2e-4 of themselves


def fluid(vortex: Vortex, points: Points, edges: Edges) -> Layer:
    """The gas on points; kappa = eta."""
    return Layer(x=points.x, edges=edges, beyond=NONE_BEYOND, eos=IdealGas(),
                 law=ConstEta(vortex.eta, vortex.eta),
                 T_plates=(1.0, 1.0), g=0.0)


def start(vortex: Vortex, method: Layer) -> np.ndarray:
    """State (4, n)."""
    rho = vortex.density(method.x)
    return method.state(rho, vortex.velocity(method.x), rho)


class Decayed(NamedTuple):
    """Velocities (n, 2) over the initial speed, ln(K at the start/K) over what friction alone makes of it.

    reached : share of the time; steps : of the whole run.
    """
    v: np.ndarray
    decay: float
    reached: float
    steps: int


def decayed(vortex: Vortex, points: Points, edges: Edges, report: Report | None = None) -> Decayed:
    """The vortex after `vortex.time`; where it diverges there are no velocities."""
    method = fluid(vortex, points, edges)
    first = start(vortex, method)
    steps = ceil(vortex.time/(OF_LIMIT*limit_of(method, first)))
    try:
        last = run(method, first, Plan(dt=vortex.time/steps, steps=steps), report).state
    except Divergence as end:
        return Decayed(np.full((points.n, 2), np.nan), np.nan, end.step/steps, steps)
    before, after = method.fields(first), method.fields(last)
    decay = float(np.log(kinetic_energy(before)/kinetic_energy(after)))/(2*DECAYS)
    return Decayed(after.v/vortex.speed, decay, 1.0, steps)
