"""What do the schemes keep over 10 000 steps, on points that stay, on points that move, and around bodies?"""
from studies.conservation import cases, claims, figures, tables
from studies.kit.study import Study

STUDY = Study(name="conservation", question=__doc__, cases=cases.cases, tables=tables.ALL,
              derive=tables.derive, figures=figures.FIGURES, claims=claims.CLAIMS)
