"""At which Rayleigh number does convection begin, and is K linear in Ra^-1/2 from there?"""
from studies.kit.part import study
from studies.onset import cases

STUDY = study("onset", cases.PART)
