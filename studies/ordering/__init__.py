"""Does Eq. 45 of RR98, spacing < r0 < wavelength, govern the error of operators and of whole flows?"""
from studies.kit.study import Part, Study
from studies.ordering.cases import cases
from studies.ordering.claims import CLAIMS
from studies.ordering.figures import FIGURES
from studies.ordering.tables import ALL, derive

STUDY = Study.of("ordering", __doc__, (Part(cases=cases, tables=ALL, derive=derive, figures=FIGURES,
                                            claims=CLAIMS),))
