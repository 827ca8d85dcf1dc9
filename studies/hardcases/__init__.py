"""Where do methods break, and was it to be expected?

KHP95, Secs II, V, VI, Figs 10, 11: shock tubes and a shocked interface against exact and linear theory; the
square of Fig. 10; the highest Ra that 16 rows bear; and a map of all methods over thirty hard cases.
Particles and points have unit spacing at mean density 1. Paper size takes an hour.
"""
from studies.hardcases import cases, claims, derive, figures, tables
from studies.kit.study import Study

STUDY = Study(name="hardcases", question=__doc__.split("\n")[0], cases=cases.cases, tables=tables.TABLES,
              derive=derive.derive, figures=figures.figures, claims=claims.CLAIMS)
