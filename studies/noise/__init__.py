"""Which noise is the partner of which friction, and do dissipative particles have the temperature they should?"""
from studies.kit.study import Study
from studies.noise.dpd import cases as dpd
from studies.noise.fluctuations import cases as fluctuations

STUDY = Study.of("noise", __doc__, (fluctuations.PART, dpd.PART,))
