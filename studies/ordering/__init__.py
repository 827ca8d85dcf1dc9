"""Does Eq. 45 of RR98, spacing < r0 < wavelength, govern the error of operators and of whole flows?"""
from studies.kit.part import study
from studies.ordering import cases

STUDY = study("ordering", cases.PART)
