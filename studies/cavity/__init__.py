"""What heat passes a square cavity, to eight digits, and which printed numbers of it are right?"""
from studies.cavity import cases, claims, tables
from studies.kit.study import Study

STUDY = Study(name="cavity", question=__doc__, cases=cases.cases, tables=tables.TABLES, derive=tables.limits,
              claims=claims.CLAIMS)
