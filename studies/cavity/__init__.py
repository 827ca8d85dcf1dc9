"""What heat passes a square cavity, to eight digits, and which printed numbers of it are right?"""
from studies.cavity.cases import TABLE, cases
from studies.cavity.claims import CLAIMS
from studies.kit.study import Study

STUDY = Study(name="cavity", question=__doc__, cases=cases, tables=(TABLE,), claims=CLAIMS)
