"""python -m studies.cost [run|figures|claims]"""
from studies.cost import STUDY
from studies.kit.study import main

main(STUDY)
