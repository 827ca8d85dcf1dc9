"""Which equations of RR98 hold against exact derivatives, and which transport coefficients do they give?"""
from studies.kit.part import study
from studies.operators import cases
from studies.operators.nested import cases as nested
from studies.operators.transport import cases as transport

STUDY = study("operators", cases.PART, transport.PART, nested.PART)
