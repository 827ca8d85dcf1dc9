"""Which equations of RR98 hold against exact derivatives, and which transport coefficients do they give?"""
from studies.kit.study import Study
from studies.operators import cases, claims, figures, tables

STUDY = Study(name="operators", question=__doc__, cases=cases.cases, tables=tables.ALL, derive=tables.derive,
              figures=figures.FIGURES, claims=claims.CLAIMS)
