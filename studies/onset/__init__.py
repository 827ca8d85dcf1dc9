"""At which Rayleigh number does convection begin, and is K linear in Ra^-1/2 from there?"""
from studies.kit.study import Study
from studies.onset import cases, claims, figures, tables

STUDY = Study(name="onset", question=__doc__, cases=cases.cases, tables=tables.ALL, derive=tables.derive,
              figures=figures.FIGURES, claims=claims.ONSET_CLAIMS)
