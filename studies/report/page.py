"""results/index.html: one file with everything in it, from tables, figures and films; no solver is run."""
import base64
import gzip
import io
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from imageio_ffmpeg import read_frames
from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markupsafe import Markup
from PIL import Image, UnidentifiedImageError

from studies.kit.csvfile import write_atomic
from studies.kit.figure import caption
from studies.kit.table import Table
from studies.report import cost
from studies.report.chart import HEIGHT, WIDTH, chart
from studies.report.findings import Known, answer, claims_of, findings
from studies.report.inventory import Folder, NoReport, Sheet, check_columns, drawings, folders, rows_of
from studies.report.numbers import short, signed, with_error

QUESTION = ("Do fluid particles converge on the continuum equations, at what error, at what cost, and where "
            "do they break?")
#: rows of a table that are in the page; the others are packed into it if the file is below EMBED [bytes]
ROWS, EMBED = 5, 60_000
#: what the page may weigh [bytes]
LIMIT = 7_800_000
VERDICTS = {"holds": "✓", "fails": "✗", "undecidable": "?"}
#: distance in RGB (441 from black to white) below which two colours are one: those of series are 60 apart and
#: more, nearer are blends along edges of lines and letters
NEAR = 24
#: films.csv says what is seen; films in the order of the page, others follow
FILMS = Table("films", key=["film"], columns=[
    "film", "title", "caption", "ra", "rows", "points", "grid_rows", "t_end", "frames", "last_ke",
    "last_ke_grid"])
ORDER = ("particles", "closed_faces", "as_printed")


def write_page(out: Path) -> Path:
    """Write index.html, all or nothing; its path.

    Raises NoReport: Something is missing or broken, or too large; an older page stays as it is.
    """
    known = folders(out)
    for folder in known:
        check_columns(folder)
    text = render(out, known, webp)
    size = len(text.encode())
    if size > LIMIT:
        raise NoReport(f"the page has {size/1e6:.1f} MB, {LIMIT/1e6:.1f} are allowed: draw smaller, or take "
                       f"out of {out}, what is large, {', '.join(largest(out, known))}")
    write_atomic(out/"index.html", text)
    return out/"index.html"


def largest(out: Path, known: list[Folder]) -> list[str]:
    """Figures and films that weigh most."""
    paths = [*(path for folder in known for path in folder.pictures), *out.glob("films/*.mp4")]
    heavy = sorted(paths, key=lambda path: -path.stat().st_size)[:5]
    return [f"{path.relative_to(out)} ({path.stat().st_size/1000:.0f} kB)" for path in heavy]


def render(out: Path, known: list[Folder], encode: Callable[[Path], str]) -> str:
    """The page as text; ``encode`` makes the address of a figure from its PNG."""
    claims, panels = claims_of(out), cost.panels(known)
    knowledge = Known(out, claims, panels)
    shown = {folder.name: figures(folder, encode) for folder in known}
    env = Environment(loader=PackageLoader("studies.report", "page"), autoescape=select_autoescape(),
                      undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    env.filters |= {"short": short, "signed": signed}
    return env.get_template("page.html").render(
        question=QUESTION, answer=answer(knowledge), findings=findings(knowledge), verdicts=VERDICTS,
        claims=claim_rows(claims), claims_made=" ".join(Sheet(out/"claims.csv").commits),
        counts=claims["verdict"].value_counts().to_dict(), papers=sorted(set(map(paper, claims["source"]))),
        panels=[(panel, chart(panel)) for panel in panels], size=(WIDTH, HEIGHT), levels=cost.LEVELS,
        parts=known, figures=shown, films=films(out),
        main=next((one for one in shown.get("rb", []) if one.name == "main"), None),
        tables={sheet.name: table(sheet) for folder in known for sheet in folder.sheets},
        style=file("style.css"), script=file("script.js"))


def file(name: str) -> Markup:
    """A file of the page as it is."""
    return Markup(Path(__file__).with_name("page").joinpath(name).read_text())


# --- claims ---------------------------------------------------------------------------------------


def paper(source: str) -> str:
    """The paper that a source names."""
    year = re.match(r"KHP95|RR98|.*?\b(?:1[89]|20)\d\d\b", source)
    return year.group(0) if year else source


def claim_rows(claims: pd.DataFrame) -> list[dict[str, Any]]:
    """Claims with numbers as people read them."""
    rows = [{str(name): value for name, value in row.items()} for row in claims.to_dict("records")]
    return [{**row, "paper": paper(row["source"]), "accepted": accepted(row["low"], row["high"]),
             "value": value_of(row["measured"], row["err"])} for row in rows]


def accepted(low: float, high: float) -> str:
    """A range in words."""
    if math.isnan(low) and math.isnan(high):
        return ""
    if math.isinf(high):
        return f"≥ {short(low)}"
    return f"≤ {short(high)}" if math.isinf(low) else f"{short(low)} to {short(high)}"


def value_of(value: float, err: float) -> str:
    """A measured value with its interval; none."""
    if math.isnan(value):
        return "—"
    if 1e-3 <= abs(value) < 1e6 and err > 1e-6*abs(value):
        return with_error(value, err)
    return signed(f"{value:.3g}" + (f" ± {err:.1g}" if err > 0 else ""))


# --- figures, tables ------------------------------------------------------------------------------


class Shown(NamedTuple):
    """A figure: its address, size in pixels, words, and the tables that it is drawn from."""
    study: str
    name: str
    src: str
    size: tuple[int, int]
    caption: str
    sheets: list[Sheet]

    @property
    def made(self) -> str:
        """Commits of these tables."""
        return ", ".join(dict.fromkeys(commit for sheet in self.sheets for commit in sheet.commits))


def figures(folder: Folder, encode: Callable[[Path], str]) -> list[Shown]:
    """Figures of a study, `main` first; of one that its study does not list the tables are all there are."""
    listed, shown = drawings(folder), []
    for png in sorted(folder.pictures, key=lambda path: (path.stem != "main", path.stem)):
        one = listed.get(png.stem)
        sheets = [sheet for sheet in folder.sheets if one is None or sheet.path.stem in one.tables]
        words = caption(one) if one else f"{png.stem.replace('_', ' ')}: {folder.question}"
        shown.append(Shown(folder.name, png.stem, encode(png), opened(png).size, words, sheets))
    return shown


def table(sheet: Sheet) -> dict[str, Any]:
    """A table: its head, its first rows, and, of one that is not too large, all of it packed."""
    content, frame = sheet.path.read_bytes(), sheet.frame.head(ROWS)
    packed = gzip.compress(content, 9, mtime=0) if len(content) <= EMBED else b""
    return {"sheet": sheet, "bytes": len(content), "rows": len(sheet.frame), "columns": list(frame.columns),
            "first": [[short(value) for value in row] for row in frame.itertuples(index=False)],
            "packed": base64.b64encode(packed).decode()}


# --- pictures -------------------------------------------------------------------------------------


def opened(path: Path) -> Image.Image:
    """A picture; NoReport where the file is none."""
    try:
        return Image.open(path)
    except (UnidentifiedImageError, OSError) as error:
        again = f"make figures-{path.parent.name} draws it again"
        raise NoReport(f"{path} is no picture ({error}): {again}") from error


def webp(path: Path) -> str:
    """A PNG as an address, a third smaller by having fewer colours."""
    packed = io.BytesIO()
    fewer(opened(path)).convert("RGB").save(packed, "webp", lossless=True, method=4)
    return address("image/webp", packed.getvalue())


def fewer(picture: Image.Image) -> Image.Image:
    """Each colour becomes the nearest one kept; kept are those that are NEAR no more frequent one."""
    if picture.mode != "P":     # as kit.figure does
        picture = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)
    colours = np.reshape(picture.getpalette("RGB") or [], (-1, 3)).astype(float)
    frequent = np.argsort(-np.array(picture.histogram()[:len(colours)]), kind="stable")
    kept: list[int] = []
    for one in frequent:
        if not kept or np.linalg.norm(colours[kept] - colours[one], axis=1).min() > NEAR:
            kept.append(int(one))
    nearest = np.linalg.norm(colours[:, None] - colours[kept], axis=2).argmin(1)
    picture = picture.copy()
    picture.putpalette(colours[kept][nearest].astype(np.uint8).tobytes())
    return picture


def address(kind: str, content: bytes) -> str:
    """An address that holds its content."""
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def films(out: Path) -> list[dict[str, Any]]:
    """Films with their last picture and what films.csv says of them; NoReport where one is missing."""
    rows = rows_of(out/"films/films.csv", (*FILMS.columns, "seed", "commit")).to_dict("records")
    made = []
    for row in sorted(rows, key=lambda row: ORDER.index(row["film"]) if row["film"] in ORDER else len(ORDER)):
        path = out/"films"/f"{row['film']}.mp4"
        if not path.exists():
            raise NoReport(f"{path} is missing: make films makes it again")
        content = base64.b64encode(path.read_bytes()).decode()
        made.append({**{str(name): value for name, value in row.items()}, **still(path), "content": content})
    return made


def still(path: Path) -> dict[str, Any]:
    """The last picture of a film, and its size; NoReport where the file is no film."""
    try:
        about, *_, last = read_frames(path)
    except (OSError, RuntimeError, ValueError) as error:
        cause = str(error).splitlines()[0]
        raise NoReport(f"{path} is no film ({cause}): make films makes it again") from error
    packed = io.BytesIO()
    Image.frombytes("RGB", about["size"], last).save(packed, "webp", quality=60, method=4)
    return {"still": address("image/webp", packed.getvalue()), "size": about["size"]}
