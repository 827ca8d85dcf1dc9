"""Sod's shock tube by other methods than smooth particles, as a part of the study."""
from studies.hard import tube_claims, tube_figures, tubes
from studies.kit.part import Part

PART = Part(cases=tubes.cases, tables=tubes.TABLES, claims=tube_claims.CLAIMS, derive=tubes.derive, figures=tube_figures.figures)
