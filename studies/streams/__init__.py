"""Where do points that move beat those that stand still, in streams up to ten times as fast as the flow?"""
from studies.kit.study import Study
from studies.streams.cases import cases
from studies.streams.findings import CLAIMS, FIGURES
from studies.streams.tables import TABLES, derive

STUDY = Study(name="streams", question=__doc__, cases=cases, tables=TABLES, derive=derive, figures=FIGURES,
              claims=CLAIMS)
