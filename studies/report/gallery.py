"""The gallery: what the examples draw, small, beside their scripts."""
import ast
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from studies.kit.key import ROOT
from studies.report.inventory import NoReport

#: of a picture [pixels], and how many colours it keeps
WIDTH, COLOURS = 960, 64


class Example(NamedTuple):
    """A script, what it says of itself, and its picture."""
    name: str
    about: str
    script: str
    picture: Path


def examples(out: Path) -> list[Example]:
    """All scripts that have a picture."""
    known = [example(path, out) for path in scripts()]
    return [one for one in known if one.picture.exists()]


def example(path: Path, out: Path) -> Example:
    """The first paragraph of a script's docstring says what it is about."""
    script = path.read_text()
    about = (ast.get_docstring(ast.parse(script)) or path.stem).split("\n\n")[0].split("\n`")[0]
    return Example(path.stem, " ".join(about.split()), script, out/"gallery"/f"{path.stem}.png")


def write_gallery(out: Path) -> list[Path]:
    """Pictures of examples in out/own made small; their paths. Raises NoReport: none is there."""
    drawn = [out/"own"/f"{path.stem}.png" for path in scripts()]
    there = [path for path in drawn if path.exists()]
    if not there:
        raise NoReport(f"no example has a picture in {out/'own'}: run one, python -m examples.convection")
    return [smaller(path, out/"gallery") for path in there]


def scripts() -> list[Path]:
    """Of all examples."""
    return sorted((ROOT/"examples").glob("[!_]*.py"))


def smaller(path: Path, folder: Path) -> Path:
    """A copy of a picture in another folder."""
    folder.mkdir(exist_ok=True)
    picture = Image.open(path).convert("RGB")
    picture.thumbnail((WIDTH, WIDTH))
    picture.quantize(COLOURS, dither=Image.Dither.NONE).save(folder/path.name, optimize=True)
    return folder/path.name
