"""python -m studies.hardcases [run|figures|claims]"""
from studies.hardcases import STUDY
from studies.kit.study import main

main(STUDY)
