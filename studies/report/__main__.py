"""python -m studies.report [page|films]: results/index.html from what is in results/, or the films that it shows."""
import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from studies.kit.sweep import RESULTS
from studies.report.found import NoReport


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; 0, or 1 where the page cannot be made."""
    parser = argparse.ArgumentParser(prog="python -m studies.report")
    parser.add_argument("command", nargs="?", default="page", choices=["page", "films"])
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder with the tables (default: results)")
    parser.add_argument("--only", default="", metavar="TEXT", help="only films with this text in their name")
    words = parser.parse_args(arguments)
    try:
        for path in films(words.out, words.only) if words.command == "films" else page(words.out):
            say(f"{path}  {path.stat().st_size/1e6:.2f} MB")
    except (NoReport, ValueError) as error:
        say(f"report: {error}")
        return 1
    return 0


def films(out: Path, only: str) -> list[Path]:
    """Loaded when it is asked for: films need the solvers, the page needs none."""
    from studies.report.films import make_all
    return make_all(out, only)


def page(out: Path) -> list[Path]:
    """The page alone."""
    from studies.report.page import write_page
    return [write_page(out, say)]


def say(text: str) -> None:
    """A message for the user."""
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
