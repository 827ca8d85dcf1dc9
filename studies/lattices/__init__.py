"""Is a fluid of smooth particles a lattice, or one of molecules?    [KHP95, Secs II-IV]

How stiff lattices are, when they pair, clump or melt, what that does to sound, by lattice sums and by runs; at which pressure
convection freezes, against the printed criteria; whether paths are those of molecules and run back. Particles have unit mass
at mean density 1, so lengths are in spacings. Paper size takes a quarter of an hour.
"""
from studies.kit.study import Study
from studies.lattices.cases import cases
from studies.lattices.claims import CLAIMS
from studies.lattices.figures import figures
from studies.lattices.tables import ALL, derive

STUDY = Study(name="lattices", cases=cases, tables=ALL, derive=derive, figures=figures, claims=CLAIMS)
