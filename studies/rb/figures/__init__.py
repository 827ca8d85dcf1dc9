"""All figures of the study `rb`, from its tables alone; what the tables lack is left out."""
from studies.kit.drawing import Drawings, Overview
from studies.rb.figures import energy, errors, fields, points, time, variants
from studies.rb.figures import main as first

#: tables that have energies and errors
ENERGIES = ("means", "kinetic_energy", "smoothed")
ERRORS = ("errors", "kinetic_energy")
ON_POINTS = ("errors", "kinetic_energy", "means")

figures = Drawings(
    Overview("main", (*ENERGIES, "errors"), first.main),
    Overview("fig2_3", ("particles",), fields.fig2_3),
    Overview("fig5", ("means", "kinetic_energy"), energy.fig5),
    Overview("fig6", ENERGIES, energy.fig6),
    Overview("fig7", ("particles",), fields.fig7),
    Overview("fig8", ("history",), time.fig8),
    Overview("fig9", ("fields",), fields.fig9),
    Overview("fig12", ("particles",), fields.fig12),
    Overview("convergence", (*ERRORS, "smoothed"), errors.convergence),
    Overview("variants", ERRORS, variants.variants),
    Overview("fixed_points", ON_POINTS, points.fixed),
    Overview("moving_points", ON_POINTS, points.moving),
)
