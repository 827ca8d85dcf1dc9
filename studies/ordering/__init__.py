"""Does Eq. 45 of RR98, spacing < r0 < wavelength, govern the error of operators and of whole flows?"""
from studies.kit.study import Study
from studies.ordering import cases

STUDY = Study.of("ordering", __doc__, (cases.PART,))
