"""Limits of the time step, predicted and measured, as a part of the study."""
from studies.hardcases.limits import cases as limits_cases
from studies.hardcases.limits import claims as limits_claims
from studies.hardcases.limits import figures as limits_figures
from studies.kit.study import Part
from studies.kit.table import Table

#: largest stable steps in units of spacing over (P/rho)^(1/2). predicted : by the method's own formula, smaller by `margin` for
#: disorder; exact : by eigenvalues of the rates of the same points, of one step of dissipative particles; measured : by trial. Of
#: these eta is gamma, k is kT. measured_err : half of the last interval of the search, and how far beyond the limit growth
#: stays unseen in so many steps, told by eigenvalues alone: what was measured does not enter it
LIMITS = Table("limits", key=["method", "scene"], columns=["method", "scene", "eta", "k", "integrator", "predicted", "margin",
                                                           "exact", "measured", "measured_err"])
#: the shorter one of the steps that sound alone and diffusion alone allow, by the operators in use
SHORTER = Table("shorter", key=["method", "scene"], columns=["method", "scene", "shorter"])
#: forward Euler's largest step of waves between plates some rows apart, by linear theory, and (eta + k/2)/(rho c^2)
STRIPS = Table("strips", key=["scene", "rows", "plates"], columns=["scene", "eta", "k", "rows", "plates", "formula", "step"])

PART = Part(cases=limits_cases.cases, tables=(LIMITS, SHORTER, STRIPS), claims=limits_claims.CLAIMS,
            figures=limits_figures.figures)
