"""python -m studies.onset [run|figures|claims]"""
from studies.kit.study import main
from studies.onset import STUDY

main(STUDY)
