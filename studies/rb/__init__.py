"""Rayleigh-Benard convection: do particles converge on the equations of the gas, and what does KHP95 print that holds?"""
from studies.kit.part import study
from studies.rb import cases

STUDY = study("rb", cases.PART)
