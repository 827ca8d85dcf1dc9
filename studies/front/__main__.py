"""python -m studies.front SCENE METHOD [METHOD ...] [--rows 16 25]: K, Nu and a picture."""
import argparse
import sys
from collections.abc import Sequence
from contextlib import suppress
from inspect import signature
from pathlib import Path
from typing import Any

from particles.run import Divergence
from studies.build import SCENES
from studies.front.solving import compare, solve
from studies.kit.key import digest
from studies.kit.store import RESULTS
from studies.kit.study import parsed, say


def main(arguments: Sequence[str] | None = None) -> int:
    """Command line; returns 0, 1 (a run diverged or an argument is wrong) or 130 (interrupted)."""
    parser = argparse.ArgumentParser(prog="python -m studies.front", description=__doc__)
    parser.add_argument("scene", help=", ".join(SCENES))
    parser.add_argument("methods", nargs="+", help="such as grid, fixed-lattice, moving, spam")
    parser.add_argument("--rows", type=int, nargs="+", default=[16], help="points or cells over the height")
    parser.add_argument("--numbers", nargs="+", default=[], metavar="NAME=VALUE", type=number,
                        help="of the scene, such as ra=5000 pr=0.7")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time", type=float, help="length of the run, for convection in free-fall times")
    parser.add_argument("--out", type=Path, default=RESULTS/"own", help="folder of the picture (results/own)")
    words = parsed(parser, arguments)
    path = words.out/f"{words.scene}-{'-'.join(words.methods)}.png"
    resume = path.with_name(f"{path.stem}-{digest(repr(words))[:8]}.run.h5")    # of these arguments alone
    more = {**dict(words.numbers), "seed": words.seed, "time": words.time}
    try:
        if len(words.methods) == len(words.rows) == 1:
            done: Any = solve(words.scene, *words.methods, rows=words.rows[0], resume=resume, **more)
        else:
            done = compare(words.scene, words.methods, words.rows, **more)
        print(done)
        done.plot(path)
    except (ValueError, TypeError, OSError, MemoryError, Divergence) as error:
        return say(str(error), 1)
    except KeyboardInterrupt:
        kept = f"goes on from {resume}" if resume.exists() else "starts anew, nothing is kept"
        return say(f"interrupted: the same command {kept}", 130)
    resume.unlink(missing_ok=True)
    print(path)
    return 0


def number(words: str) -> tuple[str, float]:
    """(name, value) of a scene's number typed as NAME=VALUE."""
    name, _, value = words.partition("=")
    with suppress(ValueError):
        if name not in signature(solve).parameters:
            return name, float(value)
    raise argparse.ArgumentTypeError(f"{words!r} is no number of a scene: write them as ra=5000 pr=0.7")


if __name__ == "__main__":
    sys.exit(main())
