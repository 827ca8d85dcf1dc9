"""python -m studies.judge MODULE:CLASS [--rows 16 25 35]: how good a method of your own is, on one page."""
import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from studies.build import variant
from studies.judge.ladder import climb, verdicts
from studies.judge.page import write_page
from studies.kit.store import RESULTS
from studies.kit.study import parsed, say


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; 0 if a rung is passed, 1 if none is or there is no such method, 130 if stopped."""
    parser = argparse.ArgumentParser(prog="python -m studies.judge", description=__doc__,
                                     epilog=f"Ends with {(main.__doc__ or '').partition('; ')[2]}")
    parser.add_argument("method", help="module:Class, a class that takes a scene; or a name such as grid")
    parser.add_argument("--rows", type=int, nargs="+", default=[16, 25, 35],
                        help="points or cells over the height; a small ladder has 8 12")
    parser.add_argument("--minutes", type=float, default=10.0, help="what would take longer is left out")
    parser.add_argument("--out", type=Path, default=RESULTS/"own", help="folder of the page (results/own)")
    words = parsed(parser, arguments)
    try:
        method = found(words.method)
    except (ValueError, ImportError) as error:
        where = ": write FILE:CLASS, with FILE.py in this folder"*isinstance(error, ModuleNotFoundError)
        return say(f"{error}{where}", 1)
    name = words.method.rpartition(":")[2]
    try:
        takes = climb(method, sorted(words.rows), words.minutes)
        told = verdicts(takes)
        print(*(f"{rung.name}: {verdict.words}" for rung, verdict in told), sep="\n")
        print(write_page(name, takes, words.out))
    except KeyboardInterrupt:
        return say("stopped: there is no page", 130)
    except OSError as error:
        return say(str(error), 1)
    return 0 if any(verdict.good for _, verdict in told) else 1


def found(words: str) -> Any:
    """The class for module:Class, or the name of a method. Raises ValueError, ImportError: there is none."""
    file, colon, name = words.partition(":")
    if not colon:
        variant(words)
        return words
    sys.path.insert(0, str(Path.cwd()))
    module = import_module(file.removesuffix(".py").replace("/", "."))
    if not isinstance(method := getattr(module, name, None), type):
        classes = ", ".join(one for one, kind in vars(module).items() if isinstance(kind, type))
        raise ValueError(f"{words} is none: name a class that takes a scene; {file} has {classes or 'none'}")
    return method


if __name__ == "__main__":
    sys.exit(main())
