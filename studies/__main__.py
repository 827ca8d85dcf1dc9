"""python -m studies NAME [run|figures|claims]: a study."""
import sys

from studies.kit.study import main, names, study_of

if __name__ == "__main__":
    name, *words = sys.argv[1:] or [""]
    if name not in names():
        sys.exit(f"no study {name!r}: there are {', '.join(names())}")
    main(study_of(name), words)
