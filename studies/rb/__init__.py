"""Rayleigh-Benard convection: do particles converge on the equations of the gas, and what does KHP95 print that holds?"""
from studies.kit.study import Study
from studies.rb import cases

STUDY = Study.of("rb", __doc__, (cases.PART,))
