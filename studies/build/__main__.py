"""python -m studies.build [TEXT]: what names of methods, scenes and quantities mean."""
import sys

from studies.build.names import explained

print(explained(" ".join(sys.argv[1:])))
