"""What does an error of 10, 3, 1, 0.1 % cost with each method?"""
from studies.cost import cases, claims, figures, tables
from studies.kit.study import Study

STUDY = Study(name="cost", question=__doc__, cases=cases.cases, tables=tables.TABLES, derive=tables.derived,
              figures=figures.FIGURES, claims=claims.CLAIMS)
