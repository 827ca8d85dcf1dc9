"""python -m studies.noise [run|figures|claims]"""
from studies.kit.study import main
from studies.noise import STUDY

main(STUDY)
