"""What do the schemes keep over 10 000 steps, on points that stay and on points that move?"""
from studies.conservation import cases
from studies.conservation.bodies import cases as bodies
from studies.conservation.motions import cases as motions
from studies.kit.study import Study

STUDY = Study.of("conservation", __doc__, (cases.PART, motions.PART, bodies.PART,))
