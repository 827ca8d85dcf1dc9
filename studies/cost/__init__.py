"""What does an error of 10, 3, 1, 0.1 % cost with each method, and what does each term cost?"""
from studies.cost import cases, claims, derive, figures, left_out, tables
from studies.kit.study import Part, Study

ERRORS = Part(cases=cases.cases, tables=tables.ERRORS_OF, derive=derive.errors, figures=figures.ERRORS,
              claims=claims.ERRORS)
TERMS = Part(cases=left_out.cases, tables=tables.TERMS, derive=derive.terms, figures=figures.TERMS,
             claims=claims.TERMS)
STUDY = Study.of("cost", __doc__, (ERRORS, TERMS))
