"""Does Eq. 45 of RR98, spacing < r0 < wavelength, govern the error of operators and of whole flows?"""
from studies.kit.study import Study
from studies.ordering import cases, claims, figures, tables

STUDY = Study(name="ordering", question=__doc__, cases=cases.cases, tables=tables.ALL, derive=tables.derive,
              figures=figures.FIGURES, claims=claims.CLAIMS)
