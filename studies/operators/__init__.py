"""Which equations of RR98 hold against exact derivatives, and which transport coefficients do they give?"""
from studies.kit.study import Study
from studies.operators import cases
from studies.operators.nested import cases as nested
from studies.operators.transport import cases as transport

STUDY = Study.of("operators", __doc__, (cases.PART, transport.PART, nested.PART,))
