"""Rayleigh-Benard convection: do particles converge on the equations of the gas, and what does KHP95 print that holds?"""
from studies.kit.part import Part, study
from studies.rb import cases
from studies.rb.runs.arithmetic import SUBJECTS, Arithmetic

NUMBERS = Part(cases=lambda size: [Arithmetic(subject=subject) for subject in SUBJECTS], tables=())
STUDY = study("rb", cases.PART, NUMBERS)
