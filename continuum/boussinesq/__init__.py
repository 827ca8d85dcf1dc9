"""Boussinesq convection: one staggered discretisation (mac.py), two solvers; this is the public interface.

    du/dt + u.grad u = -grad p + nu Lap u + T e_y,    dT/dt + u.grad T = kappa Lap T,    div u = 0

in free-fall units (flow.py). `steady` uses Newton's method, `transient` integrates in time. Both share the
operators: a transient ends in a steady state of Newton's method on the same grid.

    state = steady(BoussinesqCase(ra=10_000, pr=1, box=HALF_LAYER, rows=64))
    state.K, state.rolls, state.observe()
"""
from continuum.boussinesq.flow import BoussinesqCase, State, rest, roll
from continuum.boussinesq.mac import HALF_LAYER, Box, BoxEdges, End
from continuum.boussinesq.newton import steady
from continuum.boussinesq.projection import transient
