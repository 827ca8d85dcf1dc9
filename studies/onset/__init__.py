"""At which Rayleigh number does convection begin, and is K linear in Ra^-1/2 from there?"""
from studies.kit.study import Study
from studies.onset import cases

STUDY = Study.of("onset", __doc__, (cases.PART,))
