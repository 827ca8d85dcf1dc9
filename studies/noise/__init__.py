"""Which noise is the partner of which friction, and do dissipative particles keep their temperature?"""
from studies.kit.part import Part
from studies.kit.study import Study
from studies.noise import cases, claims, derive, figures, step_claims, tables

STUDY = Study.of("noise", __doc__, [
    Part(cases=cases.cases, tables=tables.ALL, derive=derive.derive, figures=figures.FIGURES,
         claims=(*claims.CLAIMS, *step_claims.CLAIMS))])
