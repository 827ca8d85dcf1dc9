"""Limits of the time step, predicted and measured, as a part of the study."""
from studies.hard import limits_cases, limits_claims, limits_figures
from studies.hard.part import Part
from studies.kit.table import Table

#: largest stable steps in units of spacing over (P/rho)^(1/2). predicted : by the method's own formula, smaller by `margin` for
#: disorder; exact : by eigenvalues of the rates of the same points; measured : by trial
LIMITS = Table("limits", key=["method", "scene"], columns=["method", "scene", "eta", "k", "integrator", "predicted", "margin",
                                                           "exact", "measured", "measured_err"])

PART = Part(cases=limits_cases.cases, tables=(LIMITS,), claims=limits_claims.CLAIMS, figures=limits_figures.figures)
