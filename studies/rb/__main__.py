"""python -m studies.rb [run|figures|claims]"""
from studies.kit.study import main
from studies.rb import STUDY

main(STUDY)
