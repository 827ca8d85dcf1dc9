"""All figures of the study `rb`, from its tables alone; what the tables lack is left out."""
from studies.kit.figure import Drawings, Overview
from studies.rb.figures import changes, energy, errors, flow, main

#: tables that have energies and errors
ENERGIES = ("means", "kinetic_energy", "smoothed")
ERRORS = ("errors", "kinetic_energy")

figures = Drawings(
    Overview("main", (*ENERGIES, "errors"), main.main),
    Overview("fig2_3", ("particles",), flow.fig2_3),
    Overview("fig5", ("means", "kinetic_energy"), energy.fig5),
    Overview("fig6", ENERGIES, energy.fig6),
    Overview("fig7", ("particles",), flow.fig7),
    Overview("fig8", ("history",), energy.fig8),
    Overview("fig9", ("fields",), flow.fig9),
    Overview("fig12", ("particles",), flow.fig12),
    Overview("convergence", (*ERRORS, "smoothed"), errors.convergence),
    Overview("fixed_points", (*ERRORS, "means"), errors.fixed_points),
    Overview("variants", ERRORS, changes.variants),
    Overview("moving_points", ERRORS, changes.moving_points),
)
