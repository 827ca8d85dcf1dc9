"""python -m studies.operators [run|figures|claims]"""
from studies.kit.study import main
from studies.operators import STUDY

main(STUDY)
