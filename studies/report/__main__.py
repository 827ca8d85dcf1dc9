"""python -m studies.report [page|films]: results/index.html from the tables, or the films that it shows."""
import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.kit.study import say
from studies.kit.sweep import RESULTS
from studies.report.inventory import NoReport
from studies.report.page import write_page


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; 0, or 1 where the page cannot be made."""
    parser = argparse.ArgumentParser(prog="python -m studies.report")
    parser.add_argument("command", nargs="?", default="page", choices=["page", "films"])
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder with the tables (default: results)")
    parser.add_argument("--only", default="", metavar="TEXT", help="only films with this text in their name")
    words = parser.parse_args(arguments)
    try:
        paths = films(words.out, words.only) if words.command == "films" else [write_page(words.out)]
    except (NoReport, ValueError) as error:
        return say(f"report: {error}", 1)
    for path in paths:
        say(f"{path}  {path.stat().st_size/1e6:.2f} MB")
    return 0


def films(out: Path, only: str) -> list[Path]:
    """The films with this text in their name; loaded here, as they alone need the solvers."""
    from studies.report.films import make_all
    return make_all(out, only)


if __name__ == "__main__":
    sys.exit(main())
