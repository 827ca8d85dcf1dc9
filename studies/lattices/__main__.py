"""python -m studies.lattices [run|figures|claims]"""
from studies.kit.study import main
from studies.lattices import STUDY

main(STUDY)
