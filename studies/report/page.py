"""results/index.html: one file that contains texts, tables, figures and films; no solver runs."""
import base64
import inspect
import io
import math
import os
import tomllib
from collections import Counter
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import pandas as pd
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from PIL import Image

from studies.build import names
from studies.kit.claim import paper_of, places
from studies.kit.csvfile import read
from studies.kit.figure import caption
from studies.report.equations import filled, short, signed, with_error
from studies.report.inventory import Folder, NoReport, Sheet, claims_of, folders
from studies.report.tables import FILMS
from studies.report.text import TEXTS, document, examples, opening, target

#: folder of template, style, script, and sentences on what each figure shows
PARTS = Path(__file__).with_name("page")
#: largest size of the page [bytes]
LIMIT = 7_800_000
VERDICTS = {"holds": "✓", "fails": "✗", "undecidable": "?"}
#: papers whose equations a reader can choose
PAPERS = ("KHP95", "RR98")


def text(out: Path) -> str:
    """The page of a folder. Raises NoReport: a source is missing or broken, or the page too large."""
    check_inside(out)
    whole = render(out, folders(out))
    size = len(whole.encode())
    if size > LIMIT:
        raise NoReport(f"the page has {size/1e6:.1f} MB, {LIMIT/1e6:.1f} are allowed: draw smaller figures")
    return whole


def render(out: Path, known: list[Folder]) -> str:
    """The page as text."""
    claims = claims_of(out)
    environment = Environment(
        loader=FileSystemLoader(PARTS), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("page.html").render(
        opening=opening(out),
        films=films(out), examples=examples(out),
        parts=known,
        figures={folder.name: figures(folder, claims) for folder in known},
        claims={study: rows.to_dict("records") for study, rows in in_order(claims).groupby("study")},
        places=cited(claims), papers=Counter(map(paper_of, claims["source"])),
        counts=Counter(claims["verdict"]), verdicts=VERDICTS, claims_made=Sheet(out/"claims.csv").made,
        texts={name: document(out/f"{name}.md", out) for name in TEXTS},
        words={kind: names.words(kind).values() for kind in ("method", "variation", "scene", "quantity")},
        paper=paper_of, value_of=value_of, short=short, embedded=embedded,
        leads=lambda name: target(name, out, out),
        style=(PARTS/"style.css").read_text(),
        script=(PARTS/"script.js").read_text())


def check_inside(out: Path) -> None:
    """Raise NoReport for a link that leads out of the folder: the page would publish other files."""
    for path in out.rglob("*"):
        shown = path.relative_to(out).parts[0] not in ("raw", "quick", "own")
        if shown and not path.resolve().is_relative_to(out.resolve()):
            raise NoReport(f"{path} leads out of {out}: the page holds only what is in there; copy it")


def in_order(claims: pd.DataFrame) -> pd.DataFrame:
    """Claims sorted by the places that they judge: paper, equation, figure, section."""
    order = claims["source"].map(lambda source: places(source)[0].order)
    return claims.loc[order.sort_values(kind="stable").index]


def cited(claims: pd.DataFrame) -> dict[str, int]:
    """Equation, figure or section of both papers -> how many claims judge it."""
    names = [name for cell in claims["equation"] for name in cell.split("; ") if name.startswith(PAPERS)]
    return dict(sorted(Counter(names).items(), key=lambda pair: places(pair[0])[0].order))


def value_of(value: float, err: float) -> str:
    """A measured value with its interval, as text; a dash for none."""
    if math.isnan(value):
        return "—"
    if 1e-3 <= abs(value) < 1e6 and err > 1e-6*abs(value):
        return with_error(value, err)
    return signed(f"{value:.3g}" + (f" ± {err:.1g}" if err > 0 else ""))


class Shown(NamedTuple):
    """A figure: file, size [pixels], what to see in it, caption, tables, file and function that draw it."""
    path: Path
    size: tuple[int, int]
    see: str
    caption: str
    sheets: list[Sheet]
    code: tuple[str, str]

    @property
    def name(self) -> str:
        """Name as study/figure."""
        return f"{self.path.parent.name}/{self.path.stem}"

    @property
    def wide(self) -> int:
        """Width [CSS pixels] at which its text is as large as the page's: figures have 150 pixels an inch."""
        return self.size[0]*96//150

    @property
    def made(self) -> str:
        """Commits of the tables."""
        commits = [commit for sheet in self.sheets for commit in sheet.commits]
        return ", ".join(dict.fromkeys(commits))


def figures(folder: Folder, claims: pd.DataFrame) -> list[Shown]:
    """Figures of a folder."""
    see = tomllib.loads((PARTS/"figures.toml").read_text()).get(folder.name, {})
    shown = []
    for png, drawing in folder.pictures.items():
        file = inspect.getsourcefile(drawing.draw) or ""
        code = os.path.relpath(file, png.parent.parent.resolve()), drawing.draw.__name__
        sheets = [sheet for sheet in folder.sheets if sheet.stem in drawing.tables]
        sentence = filled(see.get(png.stem, caption(drawing)), claims)
        shown.append(Shown(png, size_of(png), sentence, caption(drawing), sheets, code))
    return shown


def size_of(path: Path) -> tuple[int, int]:
    """Width and height of a picture [pixels]. Raises NoReport: the file is no picture."""
    try:
        with Image.open(path) as picture:
            picture.load()
            return picture.size
    except OSError as error:
        raise NoReport(f"{path} is no picture ({error}): make figures-{path.parent.name} draws it") from error


def embedded(path: Path) -> str:
    """Data URL of a PNG file."""
    return address("image/png", path.read_bytes())


def address(kind: str, content: bytes) -> str:
    """Data URL of a content."""
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def ffmpeg() -> ModuleType:
    """Module that reads and writes films. Raises NoReport: it is not installed."""
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise NoReport(f"films need the package imageio-ffmpeg ({error}): make report installs it") from error
    return imageio_ffmpeg


def films(out: Path) -> list[dict]:
    """Rows of films.csv, each with the content of the film's file."""
    path = out/"films/films.csv"
    rows = read(path, [*FILMS.columns, "seed", "commit"]).to_dict("records") if path.exists() else []
    return [row | in_file(path.with_name(f"{row['method']}.mp4")) for row in rows]


def in_file(path: Path) -> dict[str, Any]:
    """Content, size and last picture of a film. Raises NoReport: the file is missing or is no film."""
    if not path.exists():
        raise NoReport(f"{path} is missing: make films makes it again")
    reader = ffmpeg()
    try:
        about, *_, last = reader.read_frames(path)
    except (OSError, RuntimeError, ValueError) as error:
        cause = str(error).splitlines()[0]
        raise NoReport(f"{path} is no film ({cause}): make films makes it again") from error
    still = io.BytesIO()
    Image.frombytes("RGB", about["size"], last).save(still, "webp", quality=60, method=4)
    return {"src": address("video/mp4", path.read_bytes()), "size": about["size"],
            "still": address("image/webp", still.getvalue())}
