"""Rayleigh-Benard convection: do particles converge on the gas, and what does KHP95 print that holds?"""
from studies.kit.study import Own, Part, Study
from studies.rb import cases, own
from studies.rb.runs.arithmetic import SUBJECTS, WithoutFlow

NUMBERS = Part(cases=lambda size: [WithoutFlow(numbers=subject) for subject in SUBJECTS], tables=())
STUDY = Study.of("rb", __doc__, (cases.PART, NUMBERS), Own(own.cases, own.beside))
