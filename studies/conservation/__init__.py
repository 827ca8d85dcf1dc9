"""What do the schemes keep over 10 000 steps, on points that stay, on points that move, and around bodies?"""
from studies.conservation.cases import PART
from studies.kit.study import Study

STUDY = Study.of("conservation", __doc__, (PART,))
