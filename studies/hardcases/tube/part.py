"""Sod's shock tube by other methods than smooth particles, as a part of the study."""
from studies.hardcases.tube import claims as tube_claims
from studies.hardcases.tube import figures as tube_figures
from studies.hardcases.tube import runs as tubes
from studies.kit.study import Part

PART = Part(cases=tubes.cases, tables=tubes.TABLES, claims=tube_claims.CLAIMS, derive=tubes.derive, figures=tube_figures.figures)
