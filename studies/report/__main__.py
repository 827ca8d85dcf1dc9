"""python -m studies.report [page|equations|tables|gallery|films]: write a report on results, or films."""
import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.kit.csvfile import write_atomic
from studies.kit.study import say
from studies.kit.sweep import RESULTS
from studies.report import equations, page, tables
from studies.report.text import write_gallery

#: command -> the file that it writes, all or nothing, and its text
FILES = {"page": ("index.html", page.text), "equations": ("equations.md", equations.text),
         "tables": ("tables.md", tables.text)}


def main(arguments: Sequence[str] | None = None) -> int:
    """Command line; returns 0, or 1 if the files cannot be made."""
    parser = argparse.ArgumentParser(prog="python -m studies.report")
    parser.add_argument("command", nargs="?", default="page", choices=[*FILES, "gallery", "films"])
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder with the tables (default: results)")
    words = parser.parse_args(arguments)
    try:
        if words.command == "films":
            from studies.report.films import make_all  # only films need the solvers
            paths = make_all(words.out)
        elif words.command == "gallery":
            paths = write_gallery(words.out)
        else:
            name, text = FILES[words.command]
            paths = [words.out/name]
            write_atomic(paths[0], text(words.out))
    except ValueError as error:
        return say(f"report: {error}", 1)
    for path in paths:
        say(f"{path}  {path.stat().st_size/1e6:.2f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
