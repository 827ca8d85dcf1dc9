"""results/index.html: one file with everything in it, from tables, figures and films; no solver is run."""
import base64
import io
import math
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from PIL import Image, UnidentifiedImageError

from studies.kit.csvfile import write_atomic
from studies.kit.figure import caption
from studies.kit.source import paper_of
from studies.kit.table import Table
from studies.report import cost
from studies.report.chart import HEIGHT, WIDTH, chart
from studies.report.findings import Known, answer, claims_of, findings
from studies.report.inventory import Folder, NoReport, Sheet, check_columns, drawings, folders, place, rows_of
from studies.report.numbers import percent, seconds, short, signed, with_error

QUESTION = ("Do fluid particles converge on the continuum equations, at what error, at what cost, and where "
            "do they break?")
#: template, style and script of the page
PARTS = Path(__file__).with_name("page")
#: what the page may weigh [bytes]
LIMIT = 7_800_000
VERDICTS = {"holds": "✓", "fails": "✗", "undecidable": "?"}
#: distance in RGB (441 from black to white) below which two colours are one: those of series are 60 apart and
#: more, nearer are blends along edges of lines and letters
NEAR = 24
#: films.csv says what is seen; films in the order of the page, others follow
FILMS = Table("films", key=["film"], columns=[
    "film", "title", "caption", "ra", "rows", "points", "grid_rows", "t_end", "frames", "last_ke",
    "last_ke_grid"], about="A film of convection beside the grid.", means={
        "points": ("number of particles", ""), "t_end": ("free-fall times that it shows", "")})
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
                       f"out of {out}, what is large, {', '.join(largest(out))}")
    path = out/"index.html"
    write_atomic(path, text)
    return path


def largest(out: Path) -> list[str]:
    """Figures and films that weigh most."""
    paths = [*out.glob("*/*.png"), *out.glob("*/*.mp4")]
    sizes = {path: path.stat().st_size for path in paths}
    heavy = sorted(paths, key=lambda path: -sizes[path])
    return [f"{path.relative_to(out)} ({sizes[path]/1000:.0f} kB)" for path in heavy[:5]]


def render(out: Path, known: list[Folder], encode: Callable[[Path], str]) -> str:
    """The page as text; ``encode`` makes the address of a figure from its PNG."""
    claims = claims_of(out)
    panels = cost.panels(known)
    knowledge = Known(out, claims, panels)
    environment = Environment(
        loader=FileSystemLoader(PARTS), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("page.html").render(
        question=QUESTION,
        answer=answer(knowledge),
        findings=findings(knowledge),
        panels=panels, chart=chart, size=(WIDTH, HEIGHT), levels=cost.LEVELS,
        films=films(out),
        claims=claims.to_dict("records"),
        claims_made=Sheet(out/"claims.csv").made,
        papers=sorted({paper_of(source) for source in claims["source"]}),
        counts=claims["verdict"].value_counts(), verdicts=VERDICTS,
        paper=paper_of, accepted=accepted, value_of=value_of,
        parts=known,
        figures={folder.name: figures(folder, encode) for folder in known},
        short=short, percent=percent, seconds=seconds,
        style=(PARTS/"style.css").read_text(),
        script=(PARTS/"script.js").read_text())


def accepted(low: float, high: float) -> str:
    """A range in words."""
    if math.isnan(low) and math.isnan(high):
        return ""
    if math.isinf(high):
        return f"≥ {short(low)}"
    if math.isinf(low):
        return f"≤ {short(high)}"
    return f"{short(low)} to {short(high)}"


def value_of(value: float, err: float) -> str:
    """A measured value with its interval; none."""
    if math.isnan(value):
        return "—"
    if 1e-3 <= abs(value) < 1e6 and err > 1e-6*abs(value):
        return with_error(value, err)
    return signed(f"{value:.3g}" + (f" ± {err:.1g}" if err > 0 else ""))


class Shown(NamedTuple):
    """A figure: its address, size in pixels, words, and the tables that it is drawn from."""
    name: str
    src: str
    size: tuple[int, int]
    caption: str
    sheets: list[Sheet]

    @property
    def made(self) -> str:
        """Commits of these tables."""
        commits = [commit for sheet in self.sheets for commit in sheet.commits]
        return ", ".join(dict.fromkeys(commits))


def figures(folder: Folder, encode: Callable[[Path], str]) -> list[Shown]:
    """Figures of a study; of one that its study does not list the tables are all there are."""
    listed = drawings(folder)
    shown = []
    for png in folder.pictures:
        name = png.stem
        words = f"{name.replace('_', ' ')}: {folder.question}"
        sheets = folder.sheets
        if name in listed:
            words = caption(listed[name])
            sheets = [sheet for sheet in sheets if sheet.stem in listed[name].tables]
        shown.append(Shown(name, encode(png), opened(png).size, words, sheets))
    return shown


def opened(path: Path) -> Image.Image:
    """A picture; NoReport where the file is none."""
    try:
        return Image.open(path)
    except (UnidentifiedImageError, OSError) as error:
        again = f"make figures-{path.parent.name} draws it again"
        raise NoReport(f"{path} is no picture ({error}): {again}") from error


def webp(path: Path) -> str:
    """A PNG as an address, a third smaller by having fewer colours."""
    picture = fewer(opened(path)).convert("RGB")
    packed = io.BytesIO()
    picture.save(packed, "webp", lossless=True, method=4)
    return address("image/webp", packed.getvalue())


def fewer(picture: Image.Image) -> Image.Image:
    """Each colour becomes the nearest one kept; kept are those that are NEAR no more frequent one."""
    if picture.mode != "P":     # as kit.figure does
        picture = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)
    palette = picture.getpalette("RGB") or []
    colours = np.reshape(palette, (-1, 3)).astype(float)
    apart = np.linalg.norm(colours[:, None] - colours, axis=2)
    counts = np.array(picture.histogram()[:len(colours)])
    kept: list[int] = []
    for one in np.argsort(-counts, kind="stable"):
        if (apart[one, kept] > NEAR).all():
            kept.append(int(one))
    nearest = apart[:, kept].argmin(axis=1)
    left = colours[kept][nearest].astype(np.uint8)
    picture = picture.copy()
    picture.putpalette(left.tobytes())
    return picture


def address(kind: str, content: bytes) -> str:
    """An address that holds its content."""
    text = base64.b64encode(content).decode()
    return f"data:{kind};base64,{text}"


def ffmpeg() -> ModuleType:
    """What reads and writes films. Raises NoReport: It is not installed."""
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise NoReport(f"films need the package imageio-ffmpeg ({error}): make report installs it") from error
    return imageio_ffmpeg


def films(out: Path) -> list[dict]:
    """What films.csv says of films, and what is in their files."""
    columns = (*FILMS.columns, "seed", "commit")
    rows = rows_of(out/"films/films.csv", columns).to_dict("records")
    rows.sort(key=lambda row: place(row["film"], ORDER))
    return [row | in_file(out/"films"/f"{row['film']}.mp4") for row in rows]


def in_file(path: Path) -> dict[str, Any]:
    """A film's content, size and last picture; NoReport where the file is missing or is no film."""
    if not path.exists():
        raise NoReport(f"{path} is missing: make films makes it again")
    try:
        about, *_, last = ffmpeg().read_frames(path)
    except (OSError, RuntimeError, ValueError) as error:
        cause = str(error).splitlines()[0]
        raise NoReport(f"{path} is no film ({cause}): make films makes it again") from error
    size = about["size"]
    still = io.BytesIO()
    Image.frombytes("RGB", size, last).save(still, "webp", quality=60, method=4)
    content = base64.b64encode(path.read_bytes()).decode()
    return {"content": content, "size": size,
            "still": address("image/webp", still.getvalue())}
