"""python -m studies.build [TEXT]: what names of methods, scenes and quantities mean."""
import signal
import sys

from studies.build.names import explained

signal.signal(signal.SIGPIPE, signal.SIG_DFL)       # a reader such as head may have enough
print(explained(" ".join(sys.argv[1:])))
