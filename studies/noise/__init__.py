"""Which noise is the partner of which friction, and do dissipative particles keep their temperature?"""
from studies.kit.study import Study
from studies.noise import cases, claims, figures, tables

STUDY = Study(name="noise", question=__doc__, cases=cases.cases, tables=tables.ALL, derive=tables.derive,
              figures=figures.FIGURES, claims=claims.CLAIMS)
