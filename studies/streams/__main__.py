"""python -m studies.streams [run|figures|claims]"""
from studies.kit.study import main
from studies.streams import STUDY

main(STUDY)
