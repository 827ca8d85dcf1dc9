"""When does a fluid of smooth particles behave as a lattice, and what does that cost its convection?

KHP95, Secs II-IV: when lattices pair, clump or melt, and how fast sound is on them; at which pressure
convection freezes, against the printed criteria; which stress lattices bear when they are sheared, and what
it does to K. Lengths are in spacings: particles have unit mass at mean density 1.
"""
from studies.kit.study import Study
from studies.lattices import cases, claims, figures, loss

STUDY = Study(name="lattices", question=__doc__.split("\n")[0], cases=cases.cases, tables=cases.TABLES,
              derive=loss.derive, figures=figures.FIGURES, claims=claims.CLAIMS)
