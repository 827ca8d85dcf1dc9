"""Which equations of RR98 hold against exact derivatives, and which transport coefficients do they give?"""
from studies.kit.study import Part, Study
from studies.operators.cases import cases
from studies.operators.claims import CLAIMS
from studies.operators.figures import FIGURES
from studies.operators.tables import ALL, derive

STUDY = Study.of("operators", __doc__, (Part(cases=cases, tables=ALL, derive=derive, figures=FIGURES,
                                             claims=CLAIMS),))
