"""python -m studies.ordering [run|figures|claims]"""
from studies.kit.study import main
from studies.ordering import STUDY

main(STUDY)
