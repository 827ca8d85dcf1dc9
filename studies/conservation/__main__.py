"""python -m studies.conservation [run|figures|claims]"""
from studies.conservation import STUDY
from studies.kit.study import main

main(STUDY)
