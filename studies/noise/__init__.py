"""Which noise is the partner of which friction, and do dissipative particles keep their temperature?"""
from studies.kit.study import Study
from studies.noise import cases, claims, figures

STUDY = Study(name="noise", question=__doc__, cases=cases.cases, tables=cases.TABLES,
              figures=figures.FIGURES, claims=claims.CLAIMS)
