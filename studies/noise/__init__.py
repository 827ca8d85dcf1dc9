"""Which noise is the partner of which friction, and do dissipative particles have the temperature they should?"""
from studies.kit.part import study
from studies.noise.dpd import cases as dpd
from studies.noise.fluctuations import cases as fluctuations

STUDY = study("noise", fluctuations.PART, dpd.PART)
