"""What does an error of 10, 3, 1, 0.1 % cost with each method, and what does each term cost?"""
from studies.cost import cases
from studies.cost.scenes import cases as scenes
from studies.kit.study import Study

STUDY = Study.of("cost", __doc__, (cases.PART, scenes.PART,))
